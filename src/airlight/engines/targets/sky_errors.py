"""Errors of a program's sky against the solution, at random points and directions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.engines.baking.air_light import AirLight, lines_of_sight
from airlight.engines.baking.labelled_tables import transmittance
from airlight.engines.baking.table_errors import SEED, above_horizon, random_positions
from airlight.engines.targets.bruneton_tables import SkyTables
from airlight.engines.targets.target import ErrorRow
from airlight.solver.solution import Solution
from airlight.solver.tables.layout import Positions

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]
#: Path radiance as a function of position, shape (n,) to (n, nl). [W m⁻² sr⁻¹ nm⁻¹]
Radiance = Callable[[Positions], FloatArray]

#: Radiance per irradiance of the star below which radiances are not compared. [sr⁻¹]
DARK: Final = 1e-5
#: Irradiance of horizontal ground, relative to the star's, below which it is not compared. [1]
DARK_GROUND: Final = 1e-5
#: Lowest cosine of the sun's zenith angle by day: 2 deg below the horizontal. [1]
DAY: Final = float(np.cos(np.radians(92.0)))
#: Range of angles from the sun of half of the views, uniform in the logarithm. [deg]
_NEAR: Final = (0.3, 60.0)
_POINTS: Final = 4096


def sky_positions(medium: Medium, count: int = _POINTS, seed: int = SEED) -> Positions:
    """Random points and directions: half of them uniform in angle, half dense near the sun.

    Altitudes are squares of uniform numbers over the shell; solar zenith angles are uniform from 0
    to 96 deg.
    """
    even = random_positions(medium, count - count // 2, seed)
    rng = np.random.default_rng(seed + 1)
    x, sun, away, roll = rng.random((4, count // 2))
    low, high = np.log(_NEAR)
    psi = np.radians(np.exp(low + (high - low) * away))
    zenith = np.radians(96.0 * sun)
    mu_s = np.cos(zenith)
    # Spherical triangle of zenith, sun and view, whose angle at the sun is 2 pi roll.
    mu = mu_s * np.cos(psi) + np.sin(zenith) * np.sin(psi) * np.cos(2.0 * np.pi * roll)
    near = Positions.of(
        medium.bottom_radius + medium.thickness * x**2,
        np.clip(mu, -1.0, 1.0),
        mu_s,
        np.cos(psi),
        bottom_radius=medium.bottom_radius,
    )
    return even.joined(near)


def sky_errors(
    solution: Solution, radiance: Radiance, *, name: str = "", count: int = _POINTS
) -> list[ErrorRow]:
    """Errors of path radiance to space and to the ground, by day and in twilight.

    Parameters
    ----------
    radiance : callable
        Path radiance by the program's look-up.
    name : str
        Text appended to the names of the rows.
    count : int
        Number of points.
    """
    medium = solution.medium
    air = AirLight(solution)
    positions = sky_positions(medium, count)
    irradiance = medium.lights[0].irradiance
    lines = lines_of_sight(positions, medium)
    own, whole = air.path_and_total_radiance(lines)
    error = (radiance(positions) / irradiance - own) / np.maximum(whole, 1e-300)
    bright = (whole > DARK).all(axis=-1)
    day = positions.mu_s > DAY
    ground = positions.to_ground
    drawn = "half of the views within 60 deg of the sun, dense near it"
    rows = []
    for label, rule, where in (
        ("sky", day & ~ground, f"sun above -2 deg; {drawn}"),
        ("air before the ground", day & ground, f"per all light; sun above -2 deg; {drawn}"),
        ("sky in twilight", ~day & ~ground, f"sun from -2 to -6 deg; {drawn}"),
    ):
        judged = rule & bright
        if judged.any():
            rows.append(ErrorRow.of(label + name, error[judged], where=where))
    return rows


def level_errors(
    solution: Solution, irradiance_at: Radiance, transmittance_at: Radiance, count: int = _POINTS
) -> list[ErrorRow]:
    """Errors of diffuse horizontal irradiance and of transmittance to the top."""
    medium = solution.medium
    positions = random_positions(medium, count, SEED)
    light = medium.lights[0].irradiance
    spots = replace(positions, r=np.full(count, medium.bottom_radius))
    exact = solution.relative_sky_irradiance(spots.r, spots.mu_s)
    day = (spots.mu_s > DAY) & (exact > DARK_GROUND).all(axis=-1)
    rows = []
    if day.any():
        error = (irradiance_at(spots) / light)[day] / exact[day] - 1.0
        where = "sun above -2 deg"
        rows.append(ErrorRow.of("irradiance of the ground by the sky", error, where=where))
    up = above_horizon(positions, medium)
    rows.append(
        ErrorRow.of(
            "transmittance to the top",
            transmittance_at(up) - transmittance(solution, up),
            where="zenith angles even from 0 to the horizon",
            measure="absolute",
        )
    )
    return rows


def table_errors(solution: Solution, tables: SkyTables) -> tuple[ErrorRow, ...]:
    """Errors of Bruneton's tables as a program looks them up."""
    level = level_errors(solution, tables.irradiance_at, tables.transmittance_at)
    return (*sky_errors(solution, tables.radiance), *level)


def half_losses(arrays: dict[str, NDArray[Any]]) -> tuple[str, ...]:
    """Notes on values below the range of half floats, 3e-8, which become 0."""
    notes = []
    for name, values in arrays.items():
        lost = int(((values != 0.0) & (values.astype(np.float16) == 0.0)).sum())
        if lost:
            share = 100.0 * lost / values.size
            notes.append(
                f"{name}: {lost} of {values.size} values ({share:.2g} %) are below 3e-8, where "
                "half floats end, and become 0"
            )
    return tuple(notes)
