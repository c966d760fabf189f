"""Bands of absorption that a planet's gases have and its file leaves out, with their size."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np
import numpy.typing as npt

from airlight.planets.matter.absorbers import CrossSectionAbsorption
from airlight.planets.matter.gas_mixture import GasMixture
from airlight.spectra.tables import read_spectrum
from airlight.units import values_in

if TYPE_CHECKING:
    from airlight.planets.constituent import Constituent
    from airlight.planets.planet import Planet

FloatArray = npt.NDArray[np.float64]

#: Tables of bands by formula; without any where a gas has bands in the visible of which none comes
#: with airlight.
TABLES: Final[dict[str, tuple[str, ...]]] = {
    "O2": ("oxygen-bands",),
    "H2O": ("water-vapour-bands",),
    "CH4": ("methane-bands",),
    "NH3": (),
}
#: Table of oxygen's pairs, whose number goes with the square of the density; and the density of
#: oxygen that it is made for: air at 288.15 K and 101 325 Pa. [m⁻³]
PAIRS: Final = "oxygen-pairs"
PAIR_DENSITY: Final = 5.3354e24
#: Way through the air, over the vertical one, at which the size is given. [1]
AIRMASS: Final = 1.5
#: Loss below which a line says 0. [1]
LEAST: Final = 5e-5
#: Wavelengths among which the strongest is looked for. [nm]
_VISIBLE: Final = np.arange(380.0, 781.0)
#: Steps of the integral of the squared density over altitude.
_STEPS: Final = 20_000


@dataclass(frozen=True, kw_only=True)
class LeftOut:
    """Bands of one gas that are left out.

    Parameters
    ----------
    name : str
        Formula of the gas, or ``O2-O2``.
    table : str
        Table of the bands; empty if there is none.
    loss : array, shape (nl,)
        Share of the direct light that they would take at airmass 1.5; nan where it is unknown. [1]
    strongest, wavelength : float
        Largest share between 380 and 780 nm, and its wavelength [nm]; nan if it is unknown. [1]
    """

    name: str
    table: str
    loss: FloatArray
    strongest: float
    wavelength: float

    def __str__(self) -> str:
        if not self.table:
            return f"bands of {self.name}: no table of them"
        parts = " ".join(_percent(x) for x in self.loss)
        return (
            f"bands of {self.name}: {parts} % of direct light at airmass {AIRMASS:g}, at most "
            f"{-100.0 * self.strongest:.2g} % at {self.wavelength:.4g} nm"
        )


def _percent(loss: float) -> str:
    """Change of the light by a loss, in per cent; "?" if it is unknown."""
    if np.isnan(loss):
        return "?"
    return "0" if loss < LEAST else f"{-100.0 * loss:.2g}"


def bands_left_out(planet: Planet, wavelengths: npt.ArrayLike) -> tuple[LeftOut, ...]:
    """Bands of the gases of a planet's mixtures that none of its constituents has.

    Bands that nowhere take more than 5e-5 of the visible light are none.

    The cross-sections are means over 10 nm that are right for the Earth's air, those of methane for
    some kilometres of the pure gas at 0 °C and 101 325 Pa; elsewhere the size is of the right order
    only.

    Parameters
    ----------
    planet : Planet
        Planet; gases that are given by coefficients are not known, and left out here.
    wavelengths : array, shape (nl,)
        Wavelengths. [nm]

    Examples
    --------
    >>> from airlight.planets import load_planet
    >>> for one in bands_left_out(load_planet("earth"), [764.0]):
    ...     print(one.name, one.loss.round(2).tolist())
    O2 [0.41]
    O2-O2 [0.01]
    """
    used = {
        one.absorption.cross_section
        for one in planet.constituents
        if isinstance(one.absorption, CrossSectionAbsorption)
        and isinstance(one.absorption.cross_section, str)
    }
    columns, pairs = gas_columns(planet), 0.0
    for one in planet.constituents:
        if isinstance(one.matter, GasMixture):
            oxygen = dict(one.matter.composition).get("O2", 0.0)
            density = one.amount * oxygen * one.matter.number_density
            pairs += density**2 / PAIR_DENSITY * _squared_column(one, planet.thickness)
    found = []
    for formula, tables in TABLES.items():
        if columns.get(formula, 0.0) > 0.0:
            found += [
                _left_out(formula, table, columns[formula], wavelengths)
                for table in tables or ("",)
                if table not in used
            ]
    if pairs > 0.0 and PAIRS not in used:
        found.append(_left_out("O2-O2", PAIRS, pairs, wavelengths))
    return tuple(one for one in found if not one.strongest < LEAST)


def gas_columns(planet: Planet) -> dict[str, float]:
    """Vertical columns of the gases of a planet's mixtures, by formula. [m⁻²]"""
    columns: dict[str, float] = {}
    for one in planet.constituents:
        if not isinstance(one.matter, GasMixture):
            continue
        for formula, fraction in one.matter.composition:
            density = one.amount * fraction * one.matter.number_density
            column = density * one.profile.column(planet.thickness)
            columns[formula] = columns.get(formula, 0.0) + column
    return columns


def _squared_column(constituent: Constituent, thickness: float) -> float:
    """Integral of the squared relative density over altitude. [m]"""
    from airlight.optics.density_profile import DensitySegments

    altitude = (np.arange(_STEPS) + 0.5) * thickness / _STEPS
    segments = DensitySegments.from_rows([constituent.profile.row(thickness)])
    return float(np.square(segments.at(altitude)[0]).sum() * thickness / _STEPS)


def _left_out(name: str, table: str, column: float, wavelengths: npt.ArrayLike) -> LeftOut:
    nm = values_in(wavelengths, "nm", "wavelengths")
    if not table:
        return LeftOut(
            name=name, table="", loss=np.full(nm.shape, np.nan), strongest=np.nan, wavelength=np.nan
        )
    spectrum = read_spectrum(table)
    known = (nm >= spectrum.wavelengths[0]) & (nm <= spectrum.wavelengths[-1])
    loss = np.full(nm.shape, np.nan)
    loss[known] = -np.expm1(-AIRMASS * column * spectrum.at(nm[known]))
    visible = -np.expm1(-AIRMASS * column * spectrum.at(_VISIBLE))
    top = int(np.argmax(visible))
    return LeftOut(
        name=name,
        table=table,
        loss=loss,
        strongest=float(visible[top]),
        wavelength=float(_VISIBLE[top]),
    )
