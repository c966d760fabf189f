r"""Visible fraction of a limb-darkened disc behind occluders.

Discs are circles on the sphere of directions: the star, of angular radius α, and occluders of any
size. On the circle of radius ρ about the star's centre, an occluder of radius R at the separation δ
covers an arc of half width h,

.. math:: \sin^2\frac{h}{2} = \frac{\sin\frac{R + \rho - \delta}{2} \sin\frac{R - \rho + \delta}{2}}
                                   {\sin\rho \sin\delta}

by the cosine rule, without cancellation for small angles. The union of the arcs of several
occluders is subtracted. The fraction is the integral over the cosine μ of the angle of emergence,
sin ρ = sin α sqrt(1 - μ²), of the limb-darkening law times the free arc: direct normal irradiance,
exact for a sphere at any distance.
"""

from __future__ import annotations

from math import asin, pi, sin, sqrt
from typing import Final

import numpy as np
import numpy.typing as npt

from airlight.errors import ParameterError
from airlight.geometry.quadrature import gauss_legendre
from airlight.kernel import compiled_loop, kernel

FloatArray = npt.NDArray[np.float64]

#: Largest number of occluders.
MOST_OCCLUDERS: Final = 16
#: Quadrature points of a panel between two kinks of the free arc.
_POINTS: Final = 24
#: Ends of panels: of the disc, and two for each occluder.
_ENDS: Final = 2 + 2 * MOST_OCCLUDERS


@kernel
def covered_half_arc(rho, separation, radius):
    """Half width of the arc of a circle covered by an occluder. [rad]

    Parameters
    ----------
    rho : float
        Radius of the circle. [rad]
    separation, radius : float
        Distance of the occluder's centre from that of the circle, and its radius. [rad]

    Examples
    --------
    >>> covered_half_arc(0.001, 0.0, 0.002) == pi  # all of it
    True
    >>> covered_half_arc(0.001, 0.004, 0.002)
    0.0
    """
    if rho <= radius - separation:
        return pi
    if rho <= separation - radius or rho >= separation + radius:
        return 0.0
    across = sin(rho) * sin(separation)
    if across <= 0.0:
        return 0.0
    inner = sin(0.5 * (radius + rho - separation)) * sin(0.5 * (radius - rho + separation))
    return 2.0 * asin(sqrt(min(max(inner / across, 0.0), 1.0)))


@compiled_loop
def free_arc(rho, occluders, starts, ends):
    """Fraction of a circle not covered by any occluder. [1]

    Parameters
    ----------
    rho : float
        Radius of the circle. [rad]
    occluders : array, shape (n, 3)
        Separation, position angle and radius of each occluder. [rad]
    starts, ends : array, shape (2 n,)
        Workspace.
    """
    count = 0
    for k in range(occluders.shape[0]):
        half = covered_half_arc(rho, occluders[k, 0], occluders[k, 2])
        if half >= pi:
            return 0.0
        if half > 0.0:
            first = (occluders[k, 1] - half) % (2.0 * pi)
            last = first + 2.0 * half
            starts[count], ends[count] = first, min(last, 2.0 * pi)
            count += 1
            if last > 2.0 * pi:
                starts[count], ends[count] = 0.0, last - 2.0 * pi
                count += 1
    covered, reached = 0.0, 0.0
    for _ in range(count):
        # The arc that starts next: selection sort suffices for few arcs.
        following = -1
        for k in range(count):
            if starts[k] >= 0.0 and (following < 0 or starts[k] < starts[following]):
                following = k
        covered += max(ends[following] - max(starts[following], reached), 0.0)
        reached = max(reached, ends[following])
        starts[following] = -1.0
    return 1.0 - covered / (2.0 * pi)


@compiled_loop
def visible_disc(star_radius, occluders, darkening, nodes, weights, out):
    """Visible fraction of the irradiance of a disc behind occluders.

    Parameters
    ----------
    star_radius : float
        Angular radius of the star, above 0. [rad]
    occluders : array, shape (n, 3)
        Separation, position angle about the star's centre, and radius of each occluder. [rad]
    darkening : array, shape (nl, 6)
        Limb-darkening coefficients by powers of the cosine of emergence, of mean 1 over the disc.
    nodes, weights : array, shape (p,)
        Gauss-Legendre rule on 0 to 1.
    out : array, shape (nl,)
        Receives the fraction. [1]
    """
    count, size = occluders.shape[0], sin(star_radius)
    kinks = np.empty(_ENDS)
    starts, ends = np.empty(2 * MOST_OCCLUDERS), np.empty(2 * MOST_OCCLUDERS)
    kinks[0], kinks[1] = 0.0, 1.0
    total = 2
    for k in range(count):
        for end in range(2):
            side = occluders[k, 2] if end == 1 else -occluders[k, 2]
            rho = abs(occluders[k, 0] + side)
            if rho < star_radius:
                part = sin(rho) / size
                kinks[total] = sqrt((1.0 - part) * (1.0 + part))
                total += 1
    places = np.sort(kinks[:total])
    out[:] = 0.0
    for panel in range(total - 1):
        low, wide = places[panel], places[panel + 1] - places[panel]
        for k in range(nodes.size):
            # The substitution removes the square root of the free arc at a kink.
            turn = sin(0.5 * pi * nodes[k])
            step = wide * pi * turn * sqrt((1.0 - turn) * (1.0 + turn))
            mu = low + wide * turn * turn
            rho = asin(size * sqrt(max((1.0 - mu) * (1.0 + mu), 0.0)))
            part = free_arc(rho, occluders, starts, ends) * 2.0 * mu * step * weights[k]
            for w in range(out.size):
                radiance = 0.0
                for power in range(darkening.shape[1] - 1, -1, -1):
                    radiance = radiance * mu + darkening[w, power]
                out[w] += part * radiance


@compiled_loop
def visible_discs(star_radius, occluders, darkening, nodes, weights, out):
    """``visible_disc`` at m points.

    Parameters
    ----------
    star_radius : array, shape (m,)
        Angular radii of the star. [rad]
    occluders : array, shape (m, n, 3)
        Occluders at each point. [rad]
    darkening, nodes, weights :
        Arguments of ``visible_disc``.
    out : array, shape (m, nl)
        Receives the fractions. [1]
    """
    for k in range(star_radius.size):
        visible_disc(star_radius[k], occluders[k], darkening, nodes, weights, out[k])


def visible_light(
    star_radius: float,
    separation: npt.ArrayLike,
    radius: npt.ArrayLike,
    *,
    position: npt.ArrayLike = 0.0,
    darkening: npt.ArrayLike | None = None,
) -> FloatArray:
    """Visible fraction of the irradiance of a star's disc behind occluders.

    Parameters
    ----------
    star_radius : float
        Angular radius of the star; 0 for a point. [deg]
    separation, radius : array, shape (n,)
        Distances of the occluders' centres from the star's, and their angular radii. [deg]
    position : array, shape (n,)
        Position angles of the occluders about the star's centre, from any direction. [deg]
    darkening : array, shape (nl, 6), optional
        Limb-darkening law, see ``physics.spectra.limb_darkening``; default: a uniform disc.

    Returns
    -------
    array, shape (nl,)
        Fraction, 0 to 1. [1]

    Raises
    ------
    ParameterError
        If there are too many occluders, or an angle is out of its range.

    Examples
    --------
    >>> visible_light(0.25, [0.25], [0.25]).round(6)  # equal discs, half a diameter apart
    array([0.608997])
    """
    law = np.atleast_2d(np.ones((1, 1)) if darkening is None else np.asarray(darkening, float))
    given = np.broadcast_arrays(
        *(np.atleast_1d(np.asarray(x, float)) for x in (separation, position, radius))
    )
    occluders = np.radians(np.stack(given, axis=-1))
    if len(occluders) > MOST_OCCLUDERS:
        raise ParameterError("occluders", len(occluders), f"at most {MOST_OCCLUDERS}")
    for name, value, high in (
        ("star_radius", star_radius, 90.0),
        ("separation", given[0], 180.0),
        ("radius", given[2], 180.0),
    ):
        if not np.all((np.asarray(value) >= 0.0) & (np.asarray(value) <= high)):
            raise ParameterError(name, value, f"0 to {high:g} deg")
    if star_radius <= 0.0:
        hidden = bool(np.any(occluders[:, 0] < occluders[:, 2]))
        return np.full(law.shape[0], 0.0 if hidden else 1.0)
    rule = gauss_legendre(_POINTS)
    out = np.empty(law.shape[0])
    visible_disc(
        np.radians(star_radius), occluders, np.ascontiguousarray(law), rule.nodes, rule.weights, out
    )
    return np.clip(out, 0.0, 1.0)
