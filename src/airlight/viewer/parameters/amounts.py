"""Amounts of a planet's constituents, brightness of its ground, turbidity of its atmosphere.

Shared by window, notebook and page. An amount is a factor in the planet file,
``constituents[…].amount`` or ``ground.brightness``, displayed in the usual measure: haze by optical
depth, ozone in Dobson units, the ground by albedo.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Final, NamedTuple

from airlight.errors import AirlightError
from airlight.physics.optics.gas_absorption import dobson_from_column
from airlight.physics.optics.reflection import largest_albedo
from airlight.planets.constituent import Constituent
from airlight.planets.ground import Ground
from airlight.planets.matter.absorbers import OzoneAbsorption
from airlight.planets.matter.particles import Particles
from airlight.planets.planet import Planet
from airlight.viewer.parameters.parameter import Parameter
from airlight.viewer.parameters.turbidity import turbidity_of

#: Name of the group of amounts, the first in the list.
AMOUNTS: Final = "amounts"
#: Wavelength of optical depths and of the ground's albedo. [nm]
AT: Final = 550.0
#: Path of the turbidity, which is derived from the amounts.
TURBIDITY: Final = "air.turbidity"
#: Path of the ground's albedo.
GROUND: Final = "air.ground"
#: Largest factor of a planet's amount, that of ``Constituent.amount``. [1]
MOST: Final = 100.0
#: Range of the factor on a slider. [1]
_FACTORS: Final = (0.1, 10.0)
#: Slider of an optical depth: lower end, and minimum of the upper end (thick smog). [1]
_DEPTHS: Final = (0.01, 3.0)
#: Slider of a column of ozone. [DU]
_COLUMNS: Final = (10.0, 2000.0)

#: Search terms for each kind of matter.
_SYNONYMS: Final = {
    "gas": ("rayleigh", "molecules", "gas", "atmosphere", "pressure", "density", "thickness",
            "blue sky"),
    "haze": ("haze", "aerosol", "smog", "fog", "mist", "smoke", "pollution", "dust", "visibility",
             "particles", "mie", "aod", "clean", "dirty"),
    "absorber": ("absorber", "absorption"),
    "ozone": ("ozone", "o3", "dobson", "chappuis", "ozone layer"),
    "ground": ("ground brightness", "reflectance", "snow", "surface", "soil", "albedo"),
    "turbidity": ("turbidity", "haze", "smog", "pollution", "linke", "preetham", "clear", "clarity",
                  "visibility"),
}  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class Amount(Parameter):
    """Amount of a constituent, or a number of the whole atmosphere.

    Attributes
    ----------
    key : str
        Path of its factor in the planet's file; empty for the turbidity.
    present : float
        Value of the planet. [unit]
    depth : float
        Vertical optical depth of the planet at 550 nm; negative if unknown. [1]
    matter : str
        ``gas``, ``haze``, ``absorber``, ``ozone``, ``ground`` or ``turbidity``.
    """

    key: str = ""
    present: float = 1.0
    depth: float = 0.0
    matter: str = ""


class Measure(NamedTuple):
    """Amount in the planet's file: kind of matter, number, unit, optical depth at 550 nm."""

    matter: str
    present: float
    unit: str
    depth: float
    words: str


def amount_path(index: int) -> str:
    """Path of a constituent's amount.

    Examples
    --------
    >>> amount_path(2)
    'air.amounts[2]'
    """
    return f"air.amounts[{index}]"


def amounts_of(planet: Planet, most: float = MOST) -> tuple[Amount, ...]:
    """Amounts of a planet, in the order of its constituents.

    Parameters
    ----------
    planet : Planet
        Planet as declared in its file.
    most : float
        Largest factor of the present amounts. [1]

    Returns
    -------
    tuple of Amount
        Constituents, then ``turbidity`` if there are gas and haze of known optical depth, then the
        albedo of the ground unless it is black.

    Examples
    --------
    >>> from airlight.planets import load_planet
    >>> [(one.label, round(one.present, 3), one.unit) for one in
    ...  amounts_of(load_planet("earth"))][:3]
    [('air', 1.0, '×'), ('aerosol optical depth', 0.064, '1'), ('ozone', 345.0, 'DU')]
    """
    found = [
        _constituent(index, one, planet.thickness, most)
        for index, one in enumerate(planet.constituents)
    ]
    return (*found, *_turbidity(found, most), *_ground(planet.ground, most))


def _constituent(index: int, one: Constituent, thickness: float, factor: float) -> Amount:
    measure = _measure(one, thickness)
    present = measure.present
    low, high = (end * present for end in _FACTORS)
    if measure.unit == "DU":
        low, high = _COLUMNS
    elif measure.matter == "haze" and measure.unit != "×":
        low, high = min(low, _DEPTHS[0]), max(high, _DEPTHS[1])
    most = factor * present
    label = f"{one.name} optical depth" if measure.unit == "1" else one.name
    return Amount(
        path=amount_path(index), label=label, group=AMOUNTS, help=measure.words,
        unit=measure.unit, low=_short(min(low, 0.1 * most)), high=min(_short(high), most),
        least=0.0, most=most, scale="log", step=1.1, synonyms=_SYNONYMS[measure.matter],
        key=f"constituents[{index}].amount", present=present, depth=measure.depth,
        matter=measure.matter,
    )  # fmt: skip


def _measure(one: Constituent, thickness: float) -> Measure:
    """Usual measure of the amount of a constituent, at factor 1."""
    factor = "Amount relative to that of the planet's file."
    try:
        depth = _depth(one, thickness)
    except AirlightError:  # no value at 550 nm
        depth = -1.0
    if one.bends or (one.phase_function is not None and one.phase_function.molecular):
        return Measure("gas", 1.0, "×", depth, factor)
    if one.scatters:
        if depth > 0.0:
            words = "Vertical optical depth at 550 nm: 0.05 is clean, 0.3 hazy, 1 and more smog."
            return Measure("haze", depth, "1", depth, words)
        return Measure("haze", 1.0, "×", depth, factor)
    column = _ozone(one, depth, thickness)
    if column > 0.0:
        words = "Column of ozone above the ground: 300 is usual on Earth."
        return Measure("ozone", column, "DU", depth, words)
    return Measure("absorber", 1.0, "×", depth, factor)


def _depth(one: Constituent, thickness: float) -> float:
    """Vertical optical depth at 550 nm; negative if it requires Mie theory. [1]"""
    if isinstance(one.matter, Particles):
        own = one.matter.optical_depth
        alone = one.absorption == 0.0
        stated = one.matter.at == AT and alone
        return one.amount * own if stated and own is not None else -1.0
    both = one.scattering_coefficients([AT], thickness)
    both = both + one.absorption_coefficients([AT], thickness)
    return float(both[0]) * one.profile.column(thickness)


def _ozone(one: Constituent, depth: float, thickness: float) -> float:
    """Ozone column; 0 for other constituents. [DU]"""
    if isinstance(one.absorption, OzoneAbsorption):
        return float(f"{one.amount * dobson_from_column(one.absorption.column):.12g}")
    if one.name != "ozone" or not depth > 0.0:
        return 0.0
    from airlight.physics.spectra.ozone import ozone_cross_section

    return dobson_from_column(depth / float(ozone_cross_section([AT])[0]))


def _turbidity(found: Iterable[Amount], factor: float) -> tuple[Amount, ...]:
    """Turbidity, (τ of gas + τ of haze) / τ of gas at 550 nm."""
    parts = [one for one in found if one.matter in ("gas", "haze")]
    gas = sum(one.depth for one in parts if one.matter == "gas")
    haze = sum(one.depth for one in parts if one.matter == "haze")
    if any(one.depth < 0.0 for one in parts) or not gas > 0.0 or not haze > 0.0:
        return ()
    present, most = turbidity_of(gas, haze), turbidity_of(gas, factor * haze)
    return (
        Amount(
            path=TURBIDITY, label="turbidity", group=AMOUNTS,
            help="Optical depth of gas and haze over that of the gas at 550 nm: 1 is pure air, 2 "
            "clear, 10 hazy. Changes the haze.",
            low=1.0, high=min(_short(max(10.0, 2.0 * present)), most), least=1.0, most=most,
            scale="log", step=1.05,
            synonyms=_SYNONYMS["turbidity"], present=present, matter="turbidity",
        ),
    )  # fmt: skip


def _ground(ground: Ground, factor: float) -> tuple[Amount, ...]:
    """Albedo of the ground at 550 nm."""
    low, high = ground.limits
    nm = min(max(AT, low), high)
    present = float(ground.albedos([nm])[0])
    if not present > 0.0:
        return ()
    most = min(largest_albedo(ground.reflection), factor * present)
    return (
        Amount(
            path=GROUND, label="ground albedo", group=AMOUNTS,
            help=f"Fraction of the light of {nm:.0f} nm that the ground reflects: sea 0.06, forest "
            "0.1, sand 0.35, fresh snow 0.9.",
            low=0.0, high=most, least=0.0, most=most, step=0.01 * most,
            synonyms=_SYNONYMS["ground"], key="ground.brightness", present=present,
            matter="ground",
        ),
    )  # fmt: skip


def _short(number: float) -> float:
    """Round to three significant digits, for the limits of a slider."""
    return float(f"{number:.3g}")
