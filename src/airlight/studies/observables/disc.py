r"""Disc-integrated reflectance of a planet, at any phase angle.

The reflectance, per irradiance of the star and area of the reference disc, is

.. math:: A(\alpha) = \frac{1}{R^2} \int \frac{L}{E}\, dA = A_g \Phi(\alpha),

relative to a flat white Lambertian disc of radius R at full phase: at phase angle 0 the geometric
albedo. Its integral over phase angles is the spherical albedo at that wavelength, the fraction of
incident power that is scattered or reflected,

.. math:: A_s = 2 \int_0^\pi A(\alpha) \sin \alpha\, d\alpha .

With polarised transfer the disc also has Q, referred to the plane of star, planet and observer; U
cancels by symmetry.

References
----------
Sobolev (1975), Light Scattering in Planetary Atmospheres, chapter 9; Seager (2010), Exoplanet
Atmospheres, section 3.4.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import Cancelled
from airlight.geometry.quadrature import gauss_legendre
from airlight.kernel.threads import Cancel, Progress
from airlight.solver.solution import Solution
from airlight.studies.observables.distant_lines import disc_lines, ground_edge

FloatArray = NDArray[np.float64]

#: Panel edges of the quadrature along the equator, as angles from the terminator and from the limb:
#: on the night side, where twilight fades, and on the day side. [deg]
_NIGHT: Final = (0.0, 3.0, 10.0, 30.0)
_DAY: Final = (0.0, 6.0, 25.0)
#: Panel edges of the quadrature over the limb, over the shell's thickness.
_SHELL: Final = (0.0, 0.06, 0.15, 0.3, 0.55, 1.0)
#: Panel edges of the quadrature around the limb, as position angles from the sun's side. [deg]
_AROUND: Final = (0.0, 60.0, 90.0, 120.0, 180.0)
#: Panel edges of the quadrature over phase angle: forward scattering is concentrated in the last
#: degrees. [deg]
_PHASES: Final = (0.0, 30.0, 90.0, 150.0, 174.0, 180.0)
#: Points per panel: of the result, and of the coarser rule for its error.
POINTS: Final = 8
_FEWER: Final = 5


@dataclass(frozen=True)
class DiscPoints:
    """Quadrature over the disc.

    Attributes
    ----------
    impact, position : array, shape (n,)
        Distance from the centre [m] and position angle from the sun's side [rad], of one half.
    area : array, shape (n,)
        Quadrature weight of each point, both halves together. [m²]
    """

    impact: FloatArray
    position: FloatArray
    area: FloatArray


def _panels(edges: FloatArray, points: int) -> tuple[FloatArray, FloatArray]:
    """Nodes and weights of a Gauss-Legendre rule on each of several intervals."""
    rule = gauss_legendre(points)  # on 0 to 1
    width = np.diff(edges)
    nodes = edges[:-1, None] + width[:, None] * rule.nodes
    return nodes.ravel(), (width[:, None] * rule.weights).ravel()


def _graded(
    length: float, from_start: tuple[float, ...], from_end: tuple[float, ...]
) -> FloatArray:
    """Edges from 0 to a length [rad], at given distances from both ends [deg] if they fit."""
    room = 0.45 * length
    first = [d for d in np.radians(from_start) if d < room]
    last = [length - d for d in np.radians(from_end) if d < room]
    return np.array([*first, *reversed(last)])


def disc_points(edge: float, top: float, phase: float, points: int = POINTS) -> DiscPoints:
    """Quadrature over the ground's disc, in longitude and latitude, and over the limb.

    Parameters
    ----------
    edge, top : float
        Radii of the ground's disc and of the top of the atmosphere. [m]
    phase : float
        Phase angle, 0 to π. [rad]
    points : int
        Points of a panel.

    Examples
    --------
    >>> made = disc_points(1.0, 1.1, 2.0)
    >>> f"{made.area.sum() / (np.pi * 1.1**2):.6f}"
    '1.000000'
    """
    terminator = phase - 0.5 * np.pi
    day, day_width = _panels(_graded(np.pi - phase, _DAY, _DAY), points)
    night, night_width = _panels(_graded(phase, _NIGHT, _DAY), points)
    longitude = np.concatenate([terminator + day, terminator - night])
    width = np.concatenate([day_width, night_width])
    latitude, height = _panels(np.radians([0.0, 45.0, 75.0, 90.0]), points)
    x = np.sin(longitude[:, None]) * np.cos(latitude)
    y = np.broadcast_to(np.sin(latitude), x.shape)
    # dx dy = cos(longitude) cos²(latitude) d(longitude) d(latitude)
    area = width[:, None] * height * np.cos(longitude[:, None]) * np.cos(latitude) ** 2
    height_fraction, thick = _panels(np.array(_SHELL), points)
    b = edge + (top - edge) * height_fraction
    around, turn = _panels(np.radians(_AROUND), points)
    ring = (b * thick * (top - edge))[:, None] * turn
    return DiscPoints(
        np.concatenate([edge * np.hypot(x, y).ravel(), np.repeat(b, around.size)]),
        np.concatenate([np.arctan2(y, x).ravel(), np.tile(around, b.size)]),
        2.0 * np.concatenate([edge**2 * area.ravel(), ring.ravel()]),
    )


def _reflected(solution: Solution, phase: float, points: int) -> FloatArray:
    """Integrals of I and Q over the disc, per irradiance of the star, shape (2, nl). [m²]"""
    medium = solution.medium
    bottom, top = medium.bottom_radius, medium.top_radius
    made = disc_points(ground_edge(solution.geometry), top, phase, points)
    lines = disc_lines(made.impact, made.position, phase, bottom, top)
    if not solution.polarised:
        whole = made.area @ solution.relative_radiance(lines)
        return np.stack([whole, np.zeros_like(whole)])
    # a line's e_θ is opposite to its position angle's side, its e_φ ahead of that
    i, q, u = np.moveaxis(solution.relative_stokes(lines), 1, 0)
    turn = 2.0 * made.position[:, None]
    return np.stack([made.area @ i, -(made.area @ (q * np.cos(turn) + u * np.sin(turn)))])


def disc_stokes(
    solution: Solution,
    phase_angles: FloatArray,
    radius: float,
    *,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> tuple[FloatArray, FloatArray]:
    """I and Q of the disc, relative to a white Lambertian disc at full phase.

    Parameters
    ----------
    phase_angles : array, shape (n,)
        Phase angles, 0 to 180. [deg]
    radius : float
        Radius of the reference disc. [m]

    Returns
    -------
    values : array, shape (n, 2, nl)
        Q > 0 is polarised perpendicular to the plane of star, planet and observer; 0 in scalar
        transfer. [1]
    errors : array, shape (n, 2, nl)
        Quadrature error: difference from a rule with fewer points. [1]
    """
    values, errors = [], []
    for done, angle in enumerate(phase_angles):
        if cancel is not None and cancel():
            raise Cancelled("disc integration")
        if progress is not None:
            progress(done, len(phase_angles), "light of the disc")
        phase = float(np.radians(angle))
        fine, coarse = (_reflected(solution, phase, n) / radius**2 for n in (POINTS, _FEWER))
        values.append(fine)
        errors.append(np.abs(fine - coarse))
    if progress is not None:
        progress(len(phase_angles), len(phase_angles), "light of the disc")
    return np.array(values), np.array(errors)


def disc_reflectance(
    solution: Solution,
    phase_angles: FloatArray,
    radius: float,
    *,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> tuple[FloatArray, FloatArray]:
    """Disc-integrated reflectance and its error, I of ``disc_stokes``, each shape (n, nl). [1]"""
    values, errors = disc_stokes(solution, phase_angles, radius, progress=progress, cancel=cancel)
    return values[:, 0], errors[:, 0]


def spherical_albedo(
    solution: Solution,
    radius: float,
    *,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> tuple[FloatArray, FloatArray]:
    """Spherical albedo: scattered and reflected fraction of the power on the reference disc.

    It includes forward scattering, but not the transmitted direct beam.

    Parameters
    ----------
    solution, radius, progress, cancel
        As for ``disc_reflectance``.

    Returns
    -------
    values, errors : array, shape (nl,)
        Albedo, and its quadrature error over the disc. [1]
    """
    phases, weights = _panels(np.radians(_PHASES), _FEWER)
    values, errors = disc_reflectance(
        solution, np.degrees(phases), radius, progress=progress, cancel=cancel
    )
    phase_weights = 2.0 * weights * np.sin(phases)
    return phase_weights @ values, phase_weights @ errors
