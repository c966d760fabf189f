r"""Star occulted by an airless sphere, from points near a planet: visible fraction as a table.

The fraction of ``disc_overlap`` is tabulated over the apparent radius of the occluder and the
separation of the discs, which both vary between points: the occluder is near, and so may be the
star. Separations δ have two intervals, each even in its own coordinate: from 0 to the inner contact
``|R - α|``, and from there to the outer contact R + α as

.. math:: \delta = |R - \alpha| + \min(R, \alpha) (1 - \cos \pi t)

which removes the powers 3/2 of the fraction at the contacts. The table holds cube roots, so that
thin crescents keep their relative accuracy.
"""

from __future__ import annotations

from math import acos, asin, pi, sqrt
from typing import Final, NamedTuple

import numpy as np
import numpy.typing as npt

from airlight.errors import ParameterError
from airlight.geometry.disc_overlap import visible_discs
from airlight.geometry.quadrature import gauss_legendre
from airlight.kernel import inlined
from airlight.kernel.lanes import LANES, lane_view

FloatArray = npt.NDArray[np.float64]
Float32Array = npt.NDArray[np.float32]

#: Nodes of the table: apparent radii, separations up to the inner contact, and beyond it.
_SIZES: Final = 9
_INNER: Final = 24
_OUTER: Final = 193
#: Points of the integral over the star's disc between two kinks.
_POINTS: Final = 24


class OccultedStar(NamedTuple):
    """Star and its occluder, in a frame around the centre of a planet.

    Attributes
    ----------
    x, y, z : float
        Centre of the occluder. [m]
    radius : float
        Radius of the occluder. [m]
    star_x, star_y, star_z : float
        Direction of the star from the centre of the planet. [1]
    nearness : float
        Inverse distance of the star; 0 for a star at infinity. [m⁻¹]
    star_radius : float
        Angular radius of the star. [rad]
    scale : float
        True length over length in the coordinates of points. [1]
    smallest, step : float
        First apparent radius of the table, and its step. [rad]
    lanes : int
        Number of lanes w.
    roots : array, shape (sizes, inner + outer, w)
        Cube roots of the fraction. [1]
    """

    x: float
    y: float
    z: float
    radius: float
    star_x: float
    star_y: float
    star_z: float
    nearness: float
    star_radius: float
    scale: float
    smallest: float
    step: float
    lanes: int
    roots: Float32Array

    def moved(self, axes: FloatArray, scale: float = 1.0) -> OccultedStar:
        """Star in another frame.

        Parameters
        ----------
        axes : array, shape (3, 3)
            Axes of that frame, as rows. [1]
        scale : float
            True length over length in the coordinates of points. [1]
        """
        x, y, z = (float(one) for one in axes @ [self.x, self.y, self.z])
        a, b, c = (float(one) for one in axes @ [self.star_x, self.star_y, self.star_z])
        return self._replace(x=x, y=y, z=z, star_x=a, star_y=b, star_z=c, scale=scale)

    @classmethod
    def whole(cls) -> OccultedStar:
        """Star without occluder, encoded by 0 lanes."""
        return cls(
            0.0,
            0.0,
            0.0,
            0.0,
            0.0,
            0.0,
            1.0,
            0.0,
            0.0,
            1.0,
            0.0,
            1.0,
            0,
            np.zeros((1, 1, 1), np.float32),
        )

    def lane(self, index: int) -> OccultedStar:
        """Star at one wavelength, for ``star_visible_fraction``."""
        roots = np.ascontiguousarray(self.roots[:, :, index : index + 1])
        return self._replace(lanes=1, roots=roots)


def occulted_star(
    occluder: npt.ArrayLike,
    radius: float,
    star: npt.ArrayLike,
    star_radius: float,
    *,
    darkening: FloatArray,
    reach: float,
    distance: float = np.inf,
) -> OccultedStar:
    """Star occulted by a sphere, for points around a planet's centre.

    Parameters
    ----------
    occluder : array, shape (3,)
        Centre of the sphere, from the centre of the planet. [m]
    radius : float
        Radius of the sphere. [m]
    star : array, shape (3,)
        Direction of the star from the centre of the planet. [1]
    star_radius : float
        Angular radius of the star there, above 0. [rad]
    darkening : array, shape (nl, 6)
        Limb-darkening law, see ``physics.spectra.limb_darkening``. [1]
    reach : float
        Largest distance of points from the centre of the planet. [m]
    distance : float
        Distance of the star; default: infinite. [m]

    Raises
    ------
    ParameterError
        If points can lie inside the sphere, or the star is a point.
    """
    centre = np.asarray(occluder, float)
    away = float(np.linalg.norm(centre))
    if not away > reach + radius:
        raise ParameterError("occluder", f"{away:.6g} m away", f"beyond {reach + radius:.6g} m")
    if not 0.0 < star_radius < 0.5 * pi:
        raise ParameterError("star_radius", star_radius, "above 0, below a quarter turn [rad]")
    sizes = np.linspace(asin(radius / (away + reach)), asin(radius / (away - reach)), _SIZES)
    rule = gauss_legendre(_POINTS)
    law = np.ascontiguousarray(np.atleast_2d(np.asarray(darkening, float)))
    lanes = -(-len(law) // LANES) * LANES
    roots = np.zeros((_SIZES, _INNER + _OUTER, lanes), np.float32)
    for row, size in enumerate(sizes):
        separations = _separations(float(size), star_radius)
        occluders = np.zeros((separations.size, 1, 3))
        occluders[:, 0, 0], occluders[:, 0, 2] = separations, size
        out = np.empty((separations.size, len(law)))
        visible_discs(
            np.full(separations.size, star_radius), occluders, law, rule.nodes, rule.weights, out
        )
        roots[row, :, : len(law)] = np.cbrt(np.clip(out, 0.0, 1.0))
        roots[row, -1] = 1.0
        if size >= star_radius:
            roots[row, : _INNER + 1] = 0.0
    towards = np.asarray(star, float) / np.linalg.norm(star)
    x, y, z = (float(one) for one in centre)
    a, b, c = (float(one) for one in towards)
    return OccultedStar(
        x=x, y=y, z=z, radius=float(radius), star_x=a, star_y=b, star_z=c,
        nearness=1.0 / distance, star_radius=float(star_radius), scale=1.0,
        smallest=float(sizes[0]), step=float(sizes[1] - sizes[0]), lanes=lanes,
        roots=roots,
    )  # fmt: skip


def _separations(size: float, star_radius: float) -> FloatArray:
    """Separations of the table's nodes for one apparent radius. [rad]"""
    inner = abs(size - star_radius)
    t = np.linspace(0.0, 1.0, _OUTER)
    outer = inner + min(size, star_radius) * (1.0 - np.cos(np.pi * t))
    return np.concatenate([np.linspace(0.0, inner, _INNER, endpoint=False), outer])


@inlined
def apparent_discs(x, y, z, star):
    """Separation of the discs from a point, and apparent radius of the occluder. [rad]

    Parameters
    ----------
    x, y, z : float
        Point, in the frame and scale of ``star``. [m]
    """
    px, py, pz = star.scale * x, star.scale * y, star.scale * z
    a = star.star_x - px * star.nearness
    b = star.star_y - py * star.nearness
    c = star.star_z - pz * star.nearness
    u, v, w = star.x - px, star.y - py, star.z - pz
    square = u * u + v * v + w * w
    p, q, s = v * c - w * b, w * a - u * c, u * b - v * a
    sine = sqrt((p * p + q * q + s * s) / (square * (a * a + b * b + c * c)))
    separation = asin(min(sine, 1.0))
    if u * a + v * b + w * c < 0.0:
        separation = pi - separation
    return separation, asin(min(star.radius / sqrt(square), 1.0))


@inlined
def table_place(separation, size, star):
    """Position in the table of fractions.

    Parameters
    ----------
    separation, size : float
        Results of ``apparent_discs``. [rad]

    Returns
    -------
    row, node : int
        Indices of the node before; row -1 for all of the star's light, -2 for none.
    e, f : float
        Fractions of the steps to the next separation and to the next apparent radius. [1]
    """
    alpha = star.star_radius
    if separation >= size + alpha:
        return -1, 0, 0.0, 0.0
    inner = abs(size - alpha)
    if separation <= inner:
        if size >= alpha:
            return -2, 0, 0.0, 0.0
        at = _INNER * separation / inner if inner > 0.0 else float(_INNER)
    else:
        half = 0.5 * (separation - inner) / min(size, alpha)
        at = _INNER + acos(min(max(1.0 - 2.0 * half, -1.0), 1.0)) / pi * (_OUTER - 1)
    node = min(int(at), _INNER + _OUTER - 2)
    line = min(max((size - star.smallest) / star.step, 0.0), _SIZES - 1.0)
    row = min(int(line), _SIZES - 2)
    return row, node, at - node, line - row


@inlined
def visible_fractions(row, node, e, f, star, at):
    """Visible fraction of the star at eight wavelengths. [1]

    Parameters
    ----------
    row, node, e, f : int, int, float, float
        Results of ``table_place``, ``row`` not negative.
    at : int
        Index of the first lane.
    """
    g, h = np.float32(e), np.float32(f)
    low, lower = np.float32(1.0) - g, np.float32(1.0) - h
    roots = lane_view(star.roots, at)
    root = (
        roots[row, node] * (lower * low)
        + roots[row, node + 1] * (lower * g)
        + roots[row + 1, node] * (h * low)
        + roots[row + 1, node + 1] * (h * g)
    )
    return root * root * root


@inlined
def star_visible_fraction(x, y, z, star):
    """Visible fraction of the star at a point, for one wavelength. [1]

    Parameters
    ----------
    x, y, z, star :
        Arguments of ``apparent_discs``; the star has one lane, see ``OccultedStar.lane``.
    """
    separation, size = apparent_discs(x, y, z, star)
    row, node, e, f = table_place(separation, size, star)
    if row == -1:
        return 1.0
    if row == -2:
        return 0.0
    roots = star.roots
    root = (1.0 - f) * ((1.0 - e) * roots[row, node, 0] + e * roots[row, node + 1, 0])
    root += f * ((1.0 - e) * roots[row + 1, node, 0] + e * roots[row + 1, node + 1, 0])
    return root * root * root
