"""Error of baked tables against their solution, at random points.

One sample is uniform in angle, for typical errors. Another is dense near the sun, at the horizon
and for a low sun, with a search for the largest error in each region.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.shell import horizon_cosine
from airlight.kernel import vectorized
from airlight.planets.medium import Medium
from airlight.solver.tables.layout import Positions

FloatArray = NDArray[np.float64]

#: Default number of points at which errors are measured.
ERROR_POINTS: Final = 8192
SEED: Final = 20130527
#: Radiance below which a value is not compared. [sr⁻¹]
DARK: Final = 1e-6
#: Irradiance, relative to the star's, below which a value is not compared. [1]
DARK_GROUND: Final = 1e-6
#: Radiance below which a value of a region is not compared. [sr⁻¹]
DIM: Final = 1e-5
#: Largest zenith angle of the star. [deg]
LOWEST_SUN: Final = 96.0
#: Zenith angles between which the star counts as low, and above which twilight begins. [deg]
LOW_SUN: Final = (80.0, 92.0)
#: Number of points of the sample of peaked radiance, relative to the uniform one.
PEAKED: Final = 4
#: Number of worst points of a region from which the search for worse ones starts, points about
#: each, and steps of the search with their sizes: of the angles [deg], and of the altitude over the
#: thickness.
_WORST: Final = 32
_AROUND: Final = 32
_STEPS: Final = ((3.0, 0.03), (1.0, 0.01), (0.3, 0.003), (0.1, 0.001))
#: Distances from the sun and from the horizon that count as near. [deg]
_NEAR_SUN: Final = 45.0
_NEAR_HORIZON: Final = 10.0


@dataclass(frozen=True, kw_only=True)
class TableErrors:
    """Error of a table against the solution, at points between its texels.

    Attributes
    ----------
    quantity : str
        Compared quantity, and whether errors are relative.
    where : str
        Distribution of the points.
    points : int
        Number of values compared: points times wavelengths, without those below ``floor``.
    seed : int
        Seed of the random points.
    floor : float
        Lower limit of the values compared.
    median, rms, percentile_95, maximum : float
        Statistics of the absolute value of the error. [1]
    bias : float
        Mean of the signed error. [1]
    worst : dict
        Point of the largest error, and both values there.
    """

    quantity: str
    where: str
    points: int
    seed: int
    floor: float
    median: float
    rms: float
    percentile_95: float
    maximum: float
    bias: float
    worst: dict[str, float]

    def as_dict(self) -> dict[str, Any]:
        """Fields for a manifest."""
        return asdict(self)


def random_positions(
    medium: Medium, count: int, seed: int, azimuth: float | None = None
) -> Positions:
    """Random points and directions in the shell.

    Altitudes are squares of uniform numbers over the shell; zenith angles of view and star, down to
    LOWEST_SUN, and azimuths from 0 to 180 deg, unless given, are uniform.
    """
    rng = np.random.default_rng(seed)
    x, view, sun, around = rng.random((4, count))
    r = medium.bottom_radius + medium.thickness * x**2
    mu, mu_s = np.cos(np.pi * view), np.cos(np.radians(LOWEST_SUN) * sun)
    turn = np.cos(np.pi * around if azimuth is None else np.full(count, np.radians(azimuth)))
    nu = np.clip(mu * mu_s + np.sqrt((1.0 - mu**2) * (1.0 - mu_s**2)) * turn, -1.0, 1.0)
    return Positions.of(r, mu, mu_s, nu, bottom_radius=medium.bottom_radius)


def peaked_positions(bottom: float, top: float, count: int, seed: int) -> Positions:
    """Random points and directions, dense near the sun, at the horizon and for a low sun.

    A quarter of the views are uniform over the sphere, a quarter within 45° of the sun, half within
    20° of the horizon, half of these towards the sun. Half of the suns are between 75° and
    LOWEST_SUN.

    Parameters
    ----------
    bottom, top : float
        Radii of the ground and of the top of the shell. [m]
    """
    rng = np.random.default_rng(seed)
    height, low, near, share, turn, even = rng.random((6, count))
    kind = rng.integers(0, 4, count)
    r = bottom + (top - bottom) * height ** np.where(rng.random(count) < 0.3, 4.0, 2.0)
    sun = np.radians(np.where(low < 0.5, 75.0 + (LOWEST_SUN - 75.0) * even, LOWEST_SUN * even))
    horizon = np.pi - np.arcsin(bottom / r)
    away, around = np.radians(_NEAR_SUN) * near**2, 2.0 * np.pi * turn
    up = np.cos(away) * np.cos(sun) - np.sin(away) * np.sin(sun) * np.cos(around)
    ahead = np.cos(away) * np.sin(sun) + np.sin(away) * np.cos(sun) * np.cos(around)
    beside = np.sin(away) * np.sin(around)
    level = horizon + np.radians(20.0) * (2.0 * share - 1.0) ** 3
    view = np.choose(
        np.minimum(kind, 2),
        [np.arccos(2.0 * share - 1.0), np.arccos(np.clip(up, -1.0, 1.0)), np.clip(level, 0, np.pi)],
    )
    azimuth = np.choose(
        kind,
        [np.pi * turn, np.arctan2(beside, ahead), np.pi * turn, np.radians(60.0) * turn**2],
    )
    return _from_angles(r, view, sun, azimuth, bottom)


def _from_angles(
    r: FloatArray, view: FloatArray, sun: FloatArray, azimuth: FloatArray, bottom: float
) -> Positions:
    mu, mu_s = np.cos(view), np.cos(sun)
    nu = np.clip(mu * mu_s + np.sin(view) * np.sin(sun) * np.cos(azimuth), -1.0, 1.0)
    return Positions.of(r, mu, mu_s, nu, bottom_radius=bottom)


def regions(positions: Positions, bottom: float) -> dict[str, NDArray[np.bool_]]:
    """Masks of points in each region of the sky and of path radiance to the ground, by name."""
    sun = np.degrees(np.arccos(positions.mu_s))
    away = np.degrees(np.arccos(positions.nu))
    horizon = 180.0 - np.degrees(np.arcsin(np.minimum(bottom / positions.r, 1.0)))
    level = np.abs(np.degrees(np.arccos(positions.mu)) - horizon) < _NEAR_HORIZON
    sky, day, low = ~positions.to_ground, sun <= LOW_SUN[1], sun >= LOW_SUN[0]
    return {
        "sky near the sun": sky & day & (away < _NEAR_SUN),
        "sky near the horizon": sky & day & level,
        "sky at a low sun": sky & day & low,
        "sky in twilight": sky & ~day,
        "air before the ground at a low sun": ~sky & day & low,
    }


def search_worst(
    positions: Positions,
    size: FloatArray,
    belongs: Callable[[Positions], NDArray[np.bool_]],
    error: Callable[[Positions], FloatArray],
    bottom: float,
    top: float,
    seed: int,
) -> Positions:
    """Points near the largest errors of a sample, at which errors may be larger.

    Parameters
    ----------
    positions : Positions
        Sample, n points.
    size : array, shape (n,)
        Size of the error at each. [1]
    belongs : callable
        Whether points belong to the region.
    seed : int
        Seed of the steps.

    Returns
    -------
    Positions
        Points of the region, fewer than _AROUND for each of the largest errors.
    """
    rng = np.random.default_rng(seed)
    found = positions[np.argsort(-size)[:_WORST]]
    for degrees, altitude in _STEPS:
        many = found[np.repeat(np.arange(len(found)), _AROUND)]
        turned = np.radians(degrees) * rng.normal(size=(3, len(many)))
        turned[:, ::_AROUND] = 0.0  # the point itself stays among them
        view, sun = np.arccos(many.mu), np.arccos(many.mu_s)
        spread = np.maximum(np.sin(view) * np.sin(sun), 1e-9)
        cosine = np.clip((many.nu - many.mu * many.mu_s) / spread, -1.0, 1.0)
        r = many.r + altitude * (top - bottom) * rng.normal(size=len(many)) * (turned[0] != 0.0)
        moved = _from_angles(
            np.clip(r, bottom, top),
            np.clip(view + turned[0], 0.0, np.pi),
            np.clip(sun + turned[1], 0.0, np.radians(LOWEST_SUN)),
            np.arccos(cosine) + turned[2],
            bottom,
        )
        moved = moved[belongs(moved)]
        if not len(moved):
            break
        found = moved[np.argsort(-error(moved))[:_WORST]]
    return found


def above_horizon(positions: Positions, medium: Medium) -> Positions:
    """Points at the same radii with views uniform in angle between horizon and zenith."""
    horizon = np.arccos(vectorized(horizon_cosine)(positions.r, medium.bottom_radius))
    mu = np.cos(horizon * (np.arccos(positions.mu) / np.pi) * (1.0 - 1e-9))
    return Positions.of(
        positions.r, mu, positions.mu_s, positions.nu,
        bottom_radius=medium.bottom_radius, to_ground=False,
    )  # fmt: skip


def judge(
    table: FloatArray,
    solver: FloatArray,
    positions: Positions,
    medium: Medium,
    *,
    quantity: str,
    where: str,
    seed: int,
    floor: float = 0.0,
    relative: bool = True,
    per: FloatArray | None = None,
    sampled: int | None = None,
) -> TableErrors:
    """Errors of a table's values against the solver's, both of shape (n, nl).

    Relative errors are over the solver's values, or over ``per``, where above the floor. Statistics
    except the largest are those of the first ``sampled`` points.
    """
    whole = solver if per is None else per
    judged = whole > floor if relative else np.ones(solver.shape, bool)
    error = table - solver
    if relative:
        error = error / np.where(judged, whole, 1.0)
    largest = float(np.abs(error[judged]).max(initial=0.0))
    judged_all, judged = judged, judged[:sampled]
    values = error[:sampled][judged]
    if not values.size:
        values = np.zeros(1)
    size = np.abs(np.where(judged_all, error, 0.0))
    row, column = np.unravel_index(int(size.argmax()), size.shape)
    worst = {
        "altitude_m": positions.r[row] - medium.bottom_radius,
        "view_zenith_deg": np.degrees(np.arccos(positions.mu[row])),
        "sun_zenith_deg": np.degrees(np.arccos(positions.mu_s[row])),
        "view_to_sun_deg": np.degrees(np.arccos(positions.nu[row])),
        "wavelength_nm": medium.wavelengths[column],
        "table": table[row, column],
        "solver": solver[row, column],
    }
    return TableErrors(
        quantity=quantity,
        where=where,
        points=int(judged.sum()),
        seed=seed,
        floor=floor,
        median=float(np.median(np.abs(values))),
        rms=float(np.sqrt(np.mean(values**2))),
        percentile_95=float(np.percentile(np.abs(values), 95.0)),
        maximum=largest,
        bias=float(values.mean()),
        worst={name: float(value) for name, value in worst.items()},
    )
