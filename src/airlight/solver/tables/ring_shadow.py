"""Rings of a planet in the form that kernels read, and their shadow at a point.

Restricted Python, as in ``march``. The shadow multiplies all light of the star at a point, also
what is scattered many times: light is carried sideways by no more than some scale heights, far less
than the width of the shadow. Where it is really blurred by these, some 100 km, its edge is sharp.
"""

from __future__ import annotations

from math import cos, exp, pi, sin, sqrt
from typing import TYPE_CHECKING, Annotated, Final, NamedTuple

import numpy as np
import numpy.typing as npt

from airlight.geometry.vectors import Vec3, dot
from airlight.kernel import compiled_loop, inlined, kernel
from airlight.kernel.shader_fields import scalars, spectra
from airlight.physics.optics.ring_layer import power_law_norm

if TYPE_CHECKING:
    from airlight.planets.rings import Ring

FloatArray = npt.NDArray[np.float64]

#: Radii of the table, and samples of the profile per radius, over which optical depth is averaged.
NODES: Final = 4096
_FINER: Final = 16
#: Least and most points over which the shadow of the rings is averaged; between, in the middle
#: three rows of the tables apart.
FEWEST: Final = 5.0
MOST: Final = 32.0


class Rings(NamedTuple):
    """Rings in the plane of the equator.

    Attributes
    ----------
    ringed : bool
        Whether there are rings.
    ring_inner, ring_outer, ring_rows : float
        Radii of the first and last row of the tables [m], and rows per radius [m⁻¹].
    ring_layers : array, shape (n, 5)
        By radius: normal optical depth, then the arguments of ``ring_phase`` after the angle.
    ring_albedo : array, shape (n, w)
        Single-scattering albedo by radius. [1]
    """

    ringed: bool
    ring_inner: float
    ring_outer: float
    ring_rows: float
    ring_layers: Annotated[FloatArray, scalars(2)]
    ring_albedo: Annotated[np.ndarray, spectra(1)]


def ring_tables(rings: tuple[Ring, ...], wavelengths: FloatArray) -> Rings:
    """Tables of rings, without lanes: shape (n, nl) of albedos.

    Parameters
    ----------
    rings : tuple of Ring
        Rings of a planet; may be empty.
    wavelengths : array, shape (nl,)
        Wavelengths. [nm]
    """
    if not rings:
        return Rings(False, 0.0, 0.0, 0.0, np.zeros((1, 5)), np.zeros((1, len(wavelengths))))
    step = 1.0 / (NODES - 3)
    low = min(ring.inner_radius for ring in rings)
    high = max(ring.outer_radius for ring in rings)
    # one row of zeros beyond either edge
    inner, outer = low - step * (high - low), high + step * (high - low)
    radii, spacing = np.linspace(inner, outer, NODES, retstep=True)
    layers, albedo = np.zeros((NODES, 5)), np.zeros((NODES, len(wavelengths)))
    offsets = (np.arange(_FINER) + 0.5) / _FINER - 0.5
    fine = radii[:, None] + offsets * spacing
    nearest = np.full(NODES, np.inf)
    for ring in rings:
        away = np.maximum(ring.inner_radius - radii, radii - ring.outer_radius)
        own = away < nearest
        nearest[own] = away[own]
        norm = power_law_norm(ring.exponent)
        layers[own, 1:] = ring.exponent, norm, ring.dust, ring.asymmetry
        layers[:, 0] += ring.depths(fine).mean(axis=1)
        relative = ring.relative_albedo(radii[own])[:, None]
        albedo[own] = np.minimum(ring.albedos(wavelengths) * relative, 1.0)
    return Rings(True, inner, outer, 1.0 / spacing, layers, albedo)


@kernel
def ring_row(radius, inner, outer, rows, count):
    """Row of the tables before a radius, and fraction of the step to the next; row -1 beyond them.

    Parameters
    ----------
    radius : float
        Distance from the centre of the planet. [m]
    inner, outer, rows : float
        Fields of ``Rings``.
    count : int
        Number of rows of the tables.
    """
    row, fraction = -1, 0.0
    if inner < radius < outer:
        at = (radius - inner) * rows
        row = min(int(at), count - 2)
        fraction = at - row
    return row, fraction


@inlined
def ring_depth(radius, rings):
    """Normal optical depth of the rings at a radius [m]. [1]"""
    row, fraction = ring_row(
        radius, rings.ring_inner, rings.ring_outer, rings.ring_rows, rings.ring_layers.shape[0]
    )
    depth = 0.0
    if row >= 0:
        depth = rings.ring_layers[row, 0]
        depth += (rings.ring_layers[row + 1, 0] - depth) * fraction
    return depth


class RingShadow(NamedTuple):
    """Rings as what stands before the star, for Monte Carlo.

    Attributes
    ----------
    pole : Vec3
        Direction of the north pole. [1]
    rings : Rings
        Rings.
    """

    pole: Vec3
    rings: Rings


class RingLine(NamedTuple):
    """Line of sight among the rings.

    Attributes
    ----------
    square, along : float
        Square of the distance of its start from the centre of the rings [m²], and component of
        that distance towards the star [m].
    height : float
        Distance of the start from the plane of the rings, to the north. [m]
    rise, slope : float
        Component of the first distance along the line [m], and change of height along it [1].
    sun : float
        Cosine of the angle between the star and the north pole. [1]
    blur : float
        Distance over which the shadow is averaged, to either side. [m]
    """

    square: float
    along: float
    height: float
    rise: float
    slope: float
    sun: float
    blur: float


@kernel
def no_rings():
    """``RingLine`` where the shadow of rings is left out."""
    return RingLine(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@kernel
def ring_line(start, ray, pole, sun, blur):
    """``RingLine`` of a line of sight.

    Parameters
    ----------
    start : Vec3
        Its start, from the centre of the rings. [m]
    ray, pole, sun : Vec3
        Directions of the line, of the north pole, and of the star. [1]
    blur : float
        See ``RingLine``. [m]
    """
    return RingLine(
        dot(start, start),
        dot(start, sun),
        dot(start, pole),
        dot(start, ray),
        dot(ray, pole),
        dot(sun, pole),
        blur,
    )


@inlined
def ring_shade(square, along, height, sun, star_radius, blur, rings):
    """Transmittance of the rings between a point and the star. [1]

    The star's disc is five or more points on the line along which the radius of the crossing
    varies most: the Gauss-Chebyshev quadrature over the chords of a uniform disc. So is what
    ``blur`` adds, a pixel: without it the shadows of ringlets narrower than that would be moiré.

    Parameters
    ----------
    square, along : float
        Square of the distance of the point from the centre [m²], and component of that distance
        towards the star [m].
    height : float
        Signed distance of the point from the plane of the rings, to the north. [m]
    sun : float
        Cosine of the angle between the star and the north pole. [1]
    star_radius : float
        Angular radius of the star. [rad]
    blur : float
        Distance over which the shadow is averaged, to either side. [m]
    rings : Rings
        Rings.
    """
    left = 1.0
    if height * sun < 0.0:
        way = -height / sun
        across = along + way
        radius = sqrt(max(square + way * (along + across), 1.0))
        slope = across / (radius * sun)
        wide = star_radius * way
        wide = sqrt((wide * wide + blur * blur) * (1.0 + slope * slope))
        if radius > rings.ring_inner - wide and radius < rings.ring_outer + wide:
            steep = 1.0 / abs(sun)
            left = 0.0
            count = int(min(max(wide * rings.ring_rows, FEWEST), MOST))
            for k in range(1, count + 1):
                angle = pi * k / (count + 1.0)
                depth = ring_depth(radius + wide * cos(angle), rings)
                left += 2.0 * sin(angle) * sin(angle) / (count + 1.0) * exp(-depth * steep)
    return left


@compiled_loop
def ring_shades(square, along, height, sun, star_radius, rings, out):
    """Transmittance of the rings between points and the star.

    Parameters
    ----------
    square, along, height, sun : array, shape (n,)
        Arguments of ``ring_shade``.
    star_radius, rings :
        Arguments of ``ring_shade``.
    out : array, shape (n,)
        Receives the transmittance. [1]
    """
    for k in range(square.size):
        out[k] = ring_shade(square[k], along[k], height[k], sun[k], star_radius, 0.0, rings)
