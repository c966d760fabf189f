"""Error of baked tables against the solution they come from, at random points."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.shell import horizon_cosine
from airlight.kernel import vectorized
from airlight.planets.medium import Medium
from airlight.tables.layout import Positions

FloatArray = NDArray[np.float64]

#: Default number of points at which errors are measured.
ERROR_POINTS: Final = 8192
SEED: Final = 20130527
#: Radiance below which a value is not compared. [sr⁻¹]
DARK: Final = 1e-6
#: Irradiance, relative to the star's, below which a value is not compared. [1]
DARK_GROUND: Final = 1e-6
#: Largest zenith angle of the star. [deg]
LOWEST_SUN: Final = 96.0


@dataclass(frozen=True, kw_only=True)
class Errors:
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
        """Return the fields for a manifest."""
        return asdict(self)


def random_positions(
    medium: Medium, count: int, seed: int, azimuth: float | None = None
) -> Positions:
    """Random points and directions in the shell.

    Altitudes are the square of an even distribution over the shell, zenith angles of view and
    star even in angle, down to LOWEST_SUN; the azimuth is even from 0 to 180, or as given. [deg]
    """
    rng = np.random.default_rng(seed)
    x, view, sun, around = rng.random((4, count))
    r = medium.bottom_radius + medium.thickness * x**2
    mu, mu_s = np.cos(np.pi * view), np.cos(np.radians(LOWEST_SUN) * sun)
    turn = np.cos(np.pi * around if azimuth is None else np.full(count, np.radians(azimuth)))
    nu = np.clip(mu * mu_s + np.sqrt((1.0 - mu**2) * (1.0 - mu_s**2)) * turn, -1.0, 1.0)
    return Positions.of(r, mu, mu_s, nu, bottom_radius=medium.bottom_radius)


def above_horizon(positions: Positions, medium: Medium) -> Positions:
    """The same radii with views between the horizon and the zenith, evenly in angle."""
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
) -> Errors:
    """Compare values of a table with the solver's, both of shape (n, nl).

    Relative errors are per the solver's values, or per ``per`` of the same shape; only where that
    is above the floor.
    """
    whole = solver if per is None else per
    judged = whole > floor if relative else np.ones(solver.shape, bool)
    error = table - solver
    if relative:
        error = error / np.where(judged, whole, 1.0)
    values = error[judged]
    if not values.size:
        values = np.zeros(1)
    size = np.abs(np.where(judged, error, 0.0))
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
    return Errors(
        quantity=quantity,
        where=where,
        points=int(judged.sum()),
        seed=seed,
        floor=floor,
        median=float(np.median(np.abs(values))),
        rms=float(np.sqrt(np.mean(values**2))),
        percentile_95=float(np.percentile(np.abs(values), 95.0)),
        maximum=float(np.abs(values).max()),
        bias=float(values.mean()),
        worst={name: float(value) for name, value in worst.items()},
    )
