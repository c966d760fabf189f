"""Warnings of absorption bands of a planet's gases that its constituents omit."""

from __future__ import annotations

import contextlib
from typing import TYPE_CHECKING, Final

import numpy as np
import numpy.typing as npt

from airlight.errors import ParameterError, warn
from airlight.image.four_wavelengths import CHOSEN
from airlight.physics.units import values_in
from airlight.planets.gas_bands import AIRMASS, absorbs_lines, gas_columns, omitted_bands
from airlight.planets.picture_wavelengths import picture_wavelengths

if TYPE_CHECKING:
    from airlight.planets.planet import Planet

#: Bands without a table in airlight, by formula: where some thousandths of a gas are visible in the
#: spectrum of a planet. Goody & Yung (1989), Atmospheric Radiation, chapter 3; CH4: Karkoschka
#: (1998), Icarus 133, 134, and Irwin et al. (2006), Icarus 181, 309. Edges are rounded to 10 nm.
#: [nm]
BANDS: Final[dict[str, tuple[tuple[float, float], ...]]] = {
    "H2O": (
        (1080.0, 1200.0), (1300.0, 1500.0), (1750.0, 2000.0), (2500.0, 3600.0), (4800.0, 8500.0),
    ),
    "CO2": (
        (1040.0, 1060.0), (1200.0, 1220.0), (1420.0, 1460.0), (1520.0, 1660.0), (1930.0, 2090.0),
        (2650.0, 2870.0), (4150.0, 4500.0), (9100.0, 11_000.0), (12_000.0, 18_000.0),
    ),
    "CH4": (
        (830.0, 930.0), (970.0, 1030.0), (1100.0, 1240.0), (1300.0, 1520.0), (1620.0, 1860.0),
        (2150.0, 2600.0), (3100.0, 3900.0), (7000.0, 8500.0),
    ),
    "NH3": (
        (540.0, 560.0), (640.0, 660.0), (780.0, 800.0), (880.0, 930.0), (1000.0, 1080.0),
        (1200.0, 1300.0), (1440.0, 1570.0), (1900.0, 2100.0), (2200.0, 2400.0), (2800.0, 3200.0),
        (9000.0, 12_000.0),
    ),
    "O2": ((1240.0, 1300.0),),
    "O3": ((4700.0, 4800.0), (9300.0, 10_000.0)),
    "N2O": ((2850.0, 2900.0), (3850.0, 4120.0), (4430.0, 4600.0), (7600.0, 8000.0)),
    "CO": ((2300.0, 2420.0), (4450.0, 4900.0)),
    "SO2": ((3950.0, 4050.0), (7100.0, 7600.0), (8300.0, 9100.0)),
}  # fmt: skip
#: Smallest column whose bands are listed, a third of a centimetre of the gas at 0 °C and 101 325
#: Pa. [m⁻²]
LEAST: Final = 1e23
#: Loss of direct light from which a band of a known table is listed. [1]
WEAKEST: Final = 0.02


def omitted_absorption_bands(planet: Planet, wavelengths: npt.ArrayLike) -> list[str]:
    """Descriptions of absorption bands omitted at some wavelengths.

    Parameters
    ----------
    planet : Planet
        Planet, whose gases are those of ``gas_bands``.
    wavelengths : array, shape (nl,)
        Wavelengths of the spectrum. [nm]

    Returns
    -------
    list of str
        One line for bands of known strength, one for bands without a table; empty if there are
        none.

    Examples
    --------
    >>> from airlight.planets import load_planet
    >>> for line in omitted_absorption_bands(load_planet("earth"), [550.0, 764.0]):
    ...     print(line.partition(";")[0])
    absorption bands of O2 are omitted: up to 41 % of direct light at airmass 1.5, at 764 nm
    """
    nm = values_in(wavelengths, "nm", "wavelengths")
    lines = []
    remedy = "a bandwidth counts them" if planet.gases else "docs/planets.md has absorbers for them"
    for one in omitted_bands(planet, nm):
        loss = np.nan_to_num(one.loss)
        if loss.size and loss.max() >= WEAKEST:
            lines.append(
                f"absorption bands of {one.name} are omitted: up to {100.0 * loss.max():.0f} % of "
                f"direct light at airmass {AIRMASS:g}, at {nm[loss.argmax()]:g} nm; {remedy}"
            )
    columns = gas_columns(planet)
    met: dict[str, list[str]] = {}
    for formula, bands in BANDS.items():
        if columns.get(formula, 0.0) < LEAST or absorbs_lines(planet, formula):
            continue
        for low, high in bands:
            if ((nm >= low) & (nm <= high)).any():
                met.setdefault(formula, []).append(f"{low:g} to {high:g}")
    if met:
        named = "; ".join(f"{formula} {', '.join(spans)} nm" for formula, spans in met.items())
        lines.append(f"radiance is overestimated in absorption bands without data: {named}")
    return lines


def warn_of_omitted_bands(planet: Planet, wavelengths: npt.ArrayLike) -> None:
    """Warn about omitted absorption bands, one line for each kind.

    Wavelengths of pictures are exempt: bands contribute 0.3 % to colours of the Earth's sky.

    Parameters
    ----------
    wavelengths : array, shape (nl,)
        Wavelengths of the solution. [nm]
    """
    nm = np.asarray(wavelengths, dtype=np.float64)
    few = CHOSEN.get(nm.size, ())
    with contextlib.suppress(ParameterError):  # a planet without data at visible wavelengths
        if np.array_equal(np.sort(nm), np.sort(picture_wavelengths(planet, nm.size))):
            return
    if not np.array_equal(np.sort(nm), few):
        for line in omitted_absorption_bands(planet, nm):
            warn(f"{planet.name}: {line}")
