"""Error of baked tables against their solution, at random points.

One sample is uniform in angle, for typical errors. Another is dense near the sun, at the horizon
and for a low sun, with a search for the largest error in each region.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.engines.baking.air_light import AirLight, lines_of_sight
from airlight.engines.baking.labelled_tables import transmittance
from airlight.geometry.shell import horizon_cosine
from airlight.kernel import vectorized
from airlight.solver.tables.layout import Positions
from airlight.solver.tables.scattered_light import ScatteredLight

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

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


#: Largest number of points at which the sky's irradiance is compared.
_SKIES: Final = 256


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
    return replace(positions, mu=mu, to_ground=np.zeros(len(mu), bool))


class Compared(NamedTuple):
    """Values of a table and of the solver at points, each of shape (n, nl).

    Attributes
    ----------
    positions : Positions
        Points.
    table, solver : array
        Values of both.
    whole : array or None
        What errors are relative to; None for absolute errors.
    """

    positions: Positions
    table: FloatArray
    solver: FloatArray
    whole: FloatArray | None


def judge(
    compared: Compared,
    medium: Medium,
    *,
    quantity: str,
    where: str,
    seed: int,
    floor: float = 0.0,
    sampled: int | None = None,
) -> TableErrors:
    """Errors of a table; relative ones only where the whole is above the floor.

    Statistics but the largest are of the first ``sampled`` points.
    """
    positions, table, solver, whole = compared
    judged = np.ones(solver.shape, bool) if whole is None else whole > floor
    error = table - solver
    if whole is not None:
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


class ErrorSample(NamedTuple):
    """Points at which errors are measured.

    Attributes
    ----------
    points, seed : int
        Number of random points, and seed.
    run : callable
        ``run(positions, make, message)``: values of ``make`` at all points, on all cores.
    """

    points: int
    seed: int
    run: Callable[[Positions, Callable[[Positions], list[FloatArray]], str], list[FloatArray]]


def measured_errors(
    air: AirLight, light: ScatteredLight, azimuth: float | None, sample: ErrorSample
) -> dict[str, TableErrors]:
    """Errors of baked tables by the name of what is compared.

    Parameters
    ----------
    air : AirLight
        Light of the solution.
    light : ScatteredLight
        Tables.
    azimuth : float or None
        Azimuth of tables that hold a single one. [deg]
    sample : ErrorSample
        Points.
    """
    medium, solution, seed = air.solution.medium, air.solution, sample.seed
    drawn = (
        "altitude: thickness times the square of an even x; zenith angles even, view 0 to 180, "
        f"sun 0 to {LOWEST_SUN:g} deg"
    )
    errors = {}
    for name, given in (("sky", None), ("sky at its azimuth", azimuth)):
        if name != "sky" and given is None:
            continue
        positions = random_positions(medium, sample.points, seed, given)
        exact, whole = sample.run(
            positions, lambda p: [*air.path_and_total_radiance(lines_of_sight(p, medium))], "errors"
        )
        turned = "even, 0 to 180 deg" if given is None else f"{given:g} deg"
        made = light.relative_radiance(positions)
        for of, rows, quantity in (
            ("", ~positions.to_ground, "path radiance in views of the sky; relative"),
            (
                " before the ground",
                positions.to_ground,
                "path radiance in views of the ground; relative to the ground's and its own",
            ),
        ):
            seen = Compared(positions[rows], made[rows], exact[rows], whole[rows])
            if not len(seen.positions):  # of a few points none may look that way
                continue
            where = f"{drawn}; azimuth {turned}"
            errors[name.replace("sky", "air") + of if of else name] = judge(
                seen, medium, quantity=quantity, seed=seed, floor=DARK, where=where
            )
    if azimuth is None:
        errors |= _peaked(air, light, sample)
    # Some solvers integrate the sky for each sun.
    positions = random_positions(medium, min(sample.points, _SKIES), seed)
    for name, r in (
        ("irradiance on the ground", np.full(len(positions), medium.bottom_radius)),
        ("irradiance aloft", positions.r),
    ):
        spots = Positions(r, positions.mu, positions.mu_s, positions.nu, positions.to_ground)
        sky = solution.relative_sky_irradiance(spots.r, spots.mu_s)
        errors[name] = judge(
            Compared(spots, light.tables["irradiance"].at(spots), sky, sky),
            medium,
            quantity="irradiance of level ground by the sky; relative",
            seed=seed,
            floor=DARK_GROUND,
            where=drawn,
        )
    up = above_horizon(random_positions(medium, sample.points, seed), medium)
    errors["transmittance"] = judge(
        Compared(up, light.tables["transmittance"].at(up), transmittance(solution, up), None),
        medium,
        quantity="transmittance to the top; absolute",
        seed=seed,
        where="altitude as for light; zenith angle even from 0 to the horizon",
    )
    return errors


def _peaked(air: AirLight, light: ScatteredLight, sample: ErrorSample) -> dict[str, TableErrors]:
    """Errors in regions of peaked radiance, with a search for the largest of each."""
    medium, seed = air.solution.medium, sample.seed
    shell = (medium.bottom_radius, medium.top_radius)

    def compared(where: Positions) -> list[FloatArray]:
        own, whole = air.path_and_total_radiance(lines_of_sight(where, medium))
        return [light.relative_radiance(where), own, whole]

    def size(made: FloatArray, exact: FloatArray, whole: FloatArray) -> FloatArray:
        off = np.abs(made - exact) / np.maximum(whole, DIM)
        return np.asarray(np.where(whole > DIM, off, 0.0).max(axis=-1))

    positions = peaked_positions(*shell, PEAKED * sample.points, seed)
    found = sample.run(positions, compared, "errors")
    errors = {}
    for name, rows in regions(positions, shell[0]).items():
        if not rows.any():
            continue

        def belongs(where: Positions, name: str = name) -> NDArray[np.bool_]:
            return regions(where, shell[0])[name]

        own = [values[rows] for values in found]
        worse = search_worst(
            positions[rows], size(*own), belongs, lambda where: size(*compared(where)), *shell, seed
        )
        values = (np.concatenate(both) for both in zip(own, compared(worse), strict=True))
        errors[name] = judge(
            Compared(positions[rows].joined(worse), *values),
            medium,
            quantity="path radiance; relative to all light",
            seed=seed,
            floor=DIM,
            sampled=int(rows.sum()),
            where="views dense about the sun and the horizon, half of the suns from 75 to "
            f"{LOWEST_SUN:g} deg; the largest error by a search about the worst",
        )
    return errors
