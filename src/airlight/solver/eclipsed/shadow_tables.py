r"""Field of the scattering correction around a moon's shadow, and its frame.

The frame has its origin in the planet's centre, its third axis along the shadow's axis towards the
star, and its first towards the axis. Coordinates of a point are its altitude, its distance ρ from
the axis and its position angle about it, so that the shadow has the same coordinates at every
altitude, however oblique.

The field is the correction to local shadowing. If scattering were local, the multiple-scattering
radiance would be that of the unshadowed solution times the visible fraction F of the star; the
field d holds the difference,

.. math:: L(x, \omega) = F(x) L_0(x, \omega) + B_0(x) \sum_{lm} d_{lm}(x) Y_{lm}(\omega)

with B_0 the mean radiance of the unshadowed atmosphere. Far from the umbra, where F is nearly
linear over the mean free path, d vanishes; without an occluder it is 0 everywhere. Y are real
harmonics in the fixed frame, so that their values are constant along a line of sight.
"""

from __future__ import annotations

from math import asinh, atan2, cos, pi, sin, sqrt
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.occulted_star import OccultedStar
from airlight.kernel import inlined
from airlight.kernel.lanes import lane_view, splat
from airlight.solver.moments.harmonics import legendre_functions

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Range of the width of the dense middle of the grid, over the distance of its end.
_MIDDLE: Final = (0.02, 0.3)


class ShadowTables(NamedTuple):
    """Shadow of a moon and the field around it, in the shadow's frame.

    Attributes
    ----------
    star : OccultedStar
        Star and moon, with optical radii.
    axis : float
        Distance of the shadow's axis from the planet's centre. [m]
    umbra : float
        Radius of the umbra, where the discs are internally tangent. [m]
    middle, width : float
        Distance from the axis up to which the grid is dense [m], and its coordinate at the end.
    degree : int
        Degree N of the harmonics; K = (N + 1)².
    start, ahead, back : array
        Fields of ``Harmonics``.
    radii, distances, angles : int
        Numbers of altitudes, of distances from the axis, and of position angles, of which the last
        repeats the first.
    field : array, shape (radii·distances·angles, K, w)
        Correction d to local shadowing. [sr^½]
    sky : array, shape (distances·angles, w)
        Correction of the diffuse irradiance of the ground, over the unshadowed one. [1]
    """

    star: OccultedStar
    axis: float
    umbra: float
    middle: float
    width: float
    degree: int
    start: FloatArray
    ahead: FloatArray
    back: FloatArray
    radii: int
    distances: int
    angles: int
    field: Float32Array
    sky: Float32Array


class ShadowWorkspace(NamedTuple):
    """Workspace of one thread.

    Attributes
    ----------
    legendre : array, shape (k,)
        Legendre functions of a line of sight. [1]
    functions : array, shape (K,)
        Its harmonics. [1]
    parts : array, shape (8,)
        Weights of the eight nodes around a point. [1]
    nodes : array of int, shape (8,)
        Indices of the nodes.
    seen : array, shape (w,)
        Visible fraction of the star at a point, less ``offset``. [1]
    offset : array, shape (w,)
        Subtracted fraction. [1]
    """

    legendre: FloatArray
    functions: Float32Array
    parts: Float32Array
    nodes: NDArray[np.int64]
    seen: Float32Array
    offset: Float32Array


def new_shadow_workspace(shadow: ShadowTables) -> ShadowWorkspace:
    """Workspace of one thread, with the offset 0."""
    lanes = shadow.star.lanes
    return ShadowWorkspace(
        legendre=np.empty(shadow.ahead.size),
        functions=np.empty((shadow.degree + 1) ** 2, np.float32),
        parts=np.empty(8, np.float32),
        nodes=np.empty(8, np.int64),
        seen=np.empty(lanes, np.float32),
        offset=np.zeros(lanes, np.float32),
    )


def shadow_axes(star: OccultedStar) -> FloatArray:
    """Axes of a shadow's frame, as rows, shape (3, 3). [1]

    Parameters
    ----------
    star : OccultedStar
        Star and moon, in a frame around the planet.
    """
    moon = np.array([star.x, star.y, star.z])
    towards = np.array([star.star_x, star.star_y, star.star_z]) - moon * star.nearness
    towards /= np.linalg.norm(towards)
    beside = moon - (moon @ towards) * towards
    if np.linalg.norm(beside) < 1e-9 * np.linalg.norm(moon):
        beside = np.cross(towards, [0.0, 0.0, 1.0] if abs(towards[2]) < 0.9 else [1.0, 0.0, 0.0])
    beside /= np.linalg.norm(beside)
    return np.stack([beside, np.cross(towards, beside), towards])


def grid_spacing(umbra: float, end: float) -> tuple[float, float]:
    """Middle and width of a grid that ends at a distance from the axis. [m], [1]"""
    middle = float(np.clip(umbra, _MIDDLE[0] * end, _MIDDLE[1] * end))
    return middle, asinh(end / middle)


@inlined
def direction_functions(u, v, w, shadow, scratch):
    """Real harmonics of a direction, (l, m) at l(l + 1) + m, sines at negative m.

    Parameters
    ----------
    u, v, w : float
        Direction in the frame of the shadow. [1]
    shadow, scratch : ShadowTables, ShadowWorkspace
        The workspace receives the functions.
    """
    legendre_functions(
        w, (shadow.degree, shadow.start, shadow.ahead, shadow.back), scratch.legendre
    )
    level = sqrt(u * u + v * v)
    cosine, sine = 1.0, 0.0
    if level > 1e-12:
        cosine, sine = u / level, v / level
    even, odd = 1.0, 0.0
    for m in range(shadow.degree + 1):
        for l in range(m, shadow.degree + 1):
            value = scratch.legendre[l * (l + 1) // 2 + m]
            scratch.functions[l * (l + 1) + m] = value * even
            if m > 0:
                scratch.functions[l * (l + 1) - m] = value * odd
        even, odd = even * cosine - odd * sine, odd * cosine + even * sine


@inlined
def place_in_shadow(x, y, z, q, bottom, top, shadow, scratch):
    """Nodes around a point, and their weights.

    Parameters
    ----------
    x, y, z, q : float
        Point in the frame of the shadow, and its radius, both optical. [m]
    bottom, top : float
        Optical radii of the ground and of the top of the shell. [m]
    shadow, scratch : ShadowTables, ShadowWorkspace
        The workspace receives nodes, of altitude, distance and angle, and parts.

    Returns
    -------
    bool
        Whether the point lies in the grid.
    """
    a = shadow.star.scale * x - shadow.axis
    b = shadow.star.scale * y
    distance = sqrt(a * a + b * b)
    at = asinh(distance / shadow.middle) / shadow.width * (shadow.distances - 1)
    column = int(at)
    if column >= shadow.distances - 1:
        return False
    fraction = min(max((q - bottom) / (top - bottom), 0.0), 1.0)
    height = sqrt(fraction) * (shadow.radii - 1)
    row = min(int(height), shadow.radii - 2)
    turn = atan2(b, a) / (2.0 * pi)
    turn = (turn + 1.0 if turn < 0.0 else turn) * (shadow.angles - 1)
    angle = min(int(turn), shadow.angles - 2)
    f, g, h = height - row, at - column, turn - angle
    for k in range(8):
        up, out, on = k // 4, (k // 2) % 2, k % 2
        part = (f if up else 1.0 - f) * (g if out else 1.0 - g) * (h if on else 1.0 - h)
        scratch.parts[k] = part
        scratch.nodes[k] = (
            ((row + up) * shadow.distances + column + out) * shadow.angles + angle + on
        )
    return True


@inlined
def deviation(density, moments, constituents, shadow, scratch, at):
    """Correction of the multiple-scattering source along a line, over the mean radiance. [m⁻¹]

    Parameters
    ----------
    density : array, shape (nc,)
        Relative densities. [1]
    moments : lanes, shape (nc, N + 1)
        Scattering coefficient times Legendre moment. [m⁻¹]
    shadow, scratch : ShadowTables, ShadowWorkspace
        Field, and workspace after ``place_in_shadow`` and ``direction_functions``.
    at : int
        Index of the first lane.
    """
    field, total = lane_view(shadow.field, at), splat(0.0)
    for l in range(shadow.degree + 1):
        strength = splat(0.0)
        for c in range(constituents):
            strength = strength + moments[c, l] * density[c]
        part = splat(0.0)
        for index in range(l * l, (l + 1) * (l + 1)):
            value = splat(0.0)
            for k in range(8):
                value = value + scratch.parts[k] * field[scratch.nodes[k], index]
            part = part + scratch.functions[index] * value
        total = total + strength * part
    return total


@inlined
def sky_deviation(shadow, scratch, at):
    """Correction of the diffuse irradiance of the ground, over the unshadowed one. [1]

    Parameters
    ----------
    shadow, scratch, at :
        Arguments of ``deviation``, the point on the ground.
    """
    sky, value = lane_view(shadow.sky, at), splat(0.0)
    for k in range(8):
        node = scratch.nodes[k]
        if node < shadow.distances * shadow.angles:
            value = value + scratch.parts[k] * sky[node]
    return value


@inlined
def node_point(row, column, angle, bottom, top, shadow):
    """Point of a node, in the frame of the shadow: on the sunward side, or on the limb. [m]

    Parameters
    ----------
    row, column, angle : int
        Indices of altitude, distance and position angle.
    bottom, top : float
        Optical radii of the ground and of the shell's top. [m]
    """
    x = row / (shadow.radii - 1.0)
    q = bottom + (top - bottom) * x * x
    s = column * shadow.width / (shadow.distances - 1.0)
    distance = shadow.middle * 0.5 * (2.718281828459045**s - 2.718281828459045**-s)
    turn = 2.0 * pi * angle / (shadow.angles - 1.0)
    a = (shadow.axis + distance * cos(turn)) / shadow.star.scale
    b = distance * sin(turn) / shadow.star.scale
    square = a * a + b * b
    if square >= q * q:
        shrink = q / sqrt(square)
        return a * shrink, b * shrink, 0.0
    return a, b, sqrt((q - sqrt(square)) * (q + sqrt(square)))
