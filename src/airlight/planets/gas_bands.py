"""Absorption bands of a planet's gases that its file omits, with their strength."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np
import numpy.typing as npt

from airlight.physics.optics.band_transmission import TABLES as LINES
from airlight.physics.spectra.tables import read_spectrum
from airlight.physics.units import values_in
from airlight.planets.matter.absorbers import CrossSectionAbsorption
from airlight.planets.matter.band_absorption import BandAbsorption
from airlight.planets.matter.gas_mixture import GasMixture
from airlight.planets.matter.gases import GasScattering, density_of_state

if TYPE_CHECKING:
    from airlight.physics.optics.density_profile import DensitySegments
    from airlight.planets.constituent import Constituent
    from airlight.planets.planet import Planet

FloatArray = npt.NDArray[np.float64]

#: Tables of bands by formula; empty for gases with bands in the visible for which airlight has no
#: table.
TABLES: Final[dict[str, tuple[str, ...]]] = {
    "O2": ("oxygen-bands",),
    "H2O": ("water-vapour-bands",),
    "CH4": ("methane-bands",),
    "NH3": (),
}
#: Table of collision-induced absorption by oxygen pairs, which scales with the square of the
#: density; and the density of oxygen for which it is made: air at 288.15 K and 101 325 Pa. [m⁻³]
PAIRS: Final = "oxygen-pairs"
PAIR_DENSITY: Final = 5.3354e24
#: Formula of oxygen pairs.
PAIR: Final = "O2-O2"
#: Columns of gases with bands in the atmosphere of a world, assumed for a planet with its sky
#: unless its mixtures name them or have no oxygen: oxygen, its pairs as counted by
#: ``PAIR_DENSITY``, and 14.2 mm of water; U.S. Standard Atmosphere, 1976. [m⁻²]
WORLD_COLUMNS: Final[dict[str, dict[str, float]]] = {
    "earth": {"O2": 4.50e28, PAIR: 2.474e28, "H2O": 4.747e26},
}
#: Mole fractions of the gases of ``scattering = { rayleigh = … }``; for air, those of its King
#: factor.
_NAMED: Final = {
    "air": (("N2", 0.78084), ("O2", 0.20946), ("Ar", 0.00934)),
    "co2": (("CO2", 1.0),),
}
#: Words that identify a gas in the name of an absorber with its own cross-section.
_WORDS: Final[dict[str, tuple[str, ...]]] = {
    "O2": ("o2", "oxygen"),
    "O2-O2": ("o2-o2", "o4", "pairs", "oxygen"),
    "H2O": ("h2o", "water", "vapour", "vapor"),
    "CH4": ("ch4", "methane"),
    "NH3": ("nh3", "ammonia"),
}
#: Air mass at which the magnitude of an effect is given. [1]
AIRMASS: Final = 1.5
#: Loss below which 0 is reported. [1]
LEAST: Final = 5e-5
#: Wavelengths among which the strongest effect is sought. [nm]
_VISIBLE: Final = np.arange(380.0, 781.0)


@dataclass(frozen=True, kw_only=True)
class OmittedBands:
    """Omitted absorption bands of a gas.

    Parameters
    ----------
    name : str
        Formula of the gas, or ``O2-O2``.
    table : str
        Table of the bands; empty if there is none.
    loss : array, shape (nl,)
        Fraction of direct light absorbed at air mass 1.5; NaN if unknown. [1]
    strongest, wavelength : float
        Largest fraction between 380 and 780 nm [1], and its wavelength [nm]; NaN if unknown.
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
    """Absorbed fraction as a text in per cent; "?" if unknown."""
    if np.isnan(loss):
        return "?"
    return "0" if loss < LEAST else f"{-100.0 * loss:.2g}"


def omitted_bands(planet: Planet, wavelengths: npt.ArrayLike) -> tuple[OmittedBands, ...]:
    """Absorption bands of a planet's gases that none of its constituents has.

    Bands that absorb less than 5e-5 of visible light are neglected. Cross-sections are means over
    10 nm for the Earth's atmosphere, or for some kilometres of methane at 0 °C and 101 325 Pa;
    elsewhere only the order of magnitude is right.

    Parameters
    ----------
    planet : Planet
        Planet; its gases are those of its mixtures, air and carbon dioxide by name, and those of
        ``WORLD_COLUMNS``.
    wavelengths : array, shape (nl,)
        Wavelengths. [nm]

    Examples
    --------
    >>> from airlight.planets import load_planet
    >>> for one in omitted_bands(load_planet("earth"), [764.0]):
    ...     print(one.name, one.loss.round(2).tolist())
    O2 [0.41]
    H2O [0.0]
    O2-O2 [0.01]
    """
    columns = gas_columns(planet)
    tables = [(formula, table) for formula, names in TABLES.items() for table in names or ("",)]
    found = [
        _omitted(formula, table, columns[formula], wavelengths)
        for formula, table in (*tables, (PAIR, PAIRS))
        if columns.get(formula, 0.0) > 0.0
        and not (_absorbs(planet, formula, table) or absorbs_lines(planet, formula))
    ]
    return tuple(one for one in found if not one.strongest < LEAST)


def gas_columns(planet: Planet) -> dict[str, float]:
    """Vertical columns of gases, by formula: of the planet's own, or of its world's. [m⁻²]"""
    columns: dict[str, float] = {}
    densities = planet.relative_densities
    for i, one in enumerate(planet.constituents):
        composition, whole = _mixture(one)
        height = densities.columns[i]
        for formula, fraction in composition:
            density = one.amount * fraction * whole
            columns[formula] = columns.get(formula, 0.0) + density * height
            if formula == "O2":
                pairs = density**2 / PAIR_DENSITY * _squared_column(densities, i)
                columns[PAIR] = columns.get(PAIR, 0.0) + pairs
    if columns and "O2" not in columns:
        return columns
    return {**WORLD_COLUMNS.get(planet.body or "", {}), **columns}


def _mixture(constituent: Constituent) -> tuple[tuple[tuple[str, float], ...], float]:
    """Mole fractions [1] and number density [m⁻³] of a gas at relative density 1."""
    if isinstance(constituent.matter, GasMixture):
        return constituent.matter.composition, constituent.matter.number_density
    gas = constituent.scattering
    if isinstance(gas, GasScattering):
        density = density_of_state(gas.number_density, gas.temperature, gas.pressure)
        return _NAMED.get(gas.gas, ()), density
    return (), 0.0


def _absorbs(planet: Planet, formula: str, table: str) -> bool:
    """Whether a constituent absorbs by a table, or by an explicit cross-section of this gas."""
    for one in planet.constituents:
        if isinstance(one.absorption, CrossSectionAbsorption):
            own = one.absorption.cross_section
            named = any(word in one.name.lower() for word in _WORDS.get(formula, ()))
            if own == table or (named and not isinstance(own, str)):
                return True
    return False


def absorbs_lines(planet: Planet, formula: str) -> bool:
    """Whether a constituent absorbs by k-distributions of this gas."""
    found = [one.absorption for one in planet.constituents]
    return any(
        isinstance(o, BandAbsorption) and o.transmission == LINES.get(formula) for o in found
    )


def _squared_column(densities: DensitySegments, index: int) -> float:
    """Integral of a constituent's squared relative density over altitude. [m]"""
    squares = np.square(densities.at_nodes[index])
    return float(np.trapezoid(squares, densities.node_altitudes))


def _omitted(name: str, table: str, column: float, wavelengths: npt.ArrayLike) -> OmittedBands:
    nm = values_in(wavelengths, "nm", "wavelengths")
    if not table:
        return OmittedBands(
            name=name, table="", loss=np.full(nm.shape, np.nan), strongest=np.nan, wavelength=np.nan
        )
    spectrum = read_spectrum(table)
    known = (nm >= spectrum.wavelengths[0]) & (nm <= spectrum.wavelengths[-1])
    loss = np.full(nm.shape, np.nan)
    loss[known] = -np.expm1(-AIRMASS * column * spectrum.at(nm[known]))
    visible = -np.expm1(-AIRMASS * column * spectrum.at(_VISIBLE))
    top = int(np.argmax(visible))
    return OmittedBands(
        name=name,
        table=table,
        loss=loss,
        strongest=float(visible[top]),
        wavelength=float(_VISIBLE[top]),
    )
