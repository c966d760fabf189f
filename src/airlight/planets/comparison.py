"""Differences between two planets: parameters and derived optical quantities."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np
import numpy.typing as npt

from airlight.planets.medium import Medium
from airlight.planets.parameter_values import parameter_values
from airlight.planets.planet import RED_GREEN_BLUE, Planet
from airlight.planets.schema.toml_model import fields_of
from airlight.planets.spectral import narrowest

if TYPE_CHECKING:
    from airlight.planets.constituent import Constituent

FloatArray = npt.NDArray[np.float64]
Value = float | str | None

#: Relative difference, to the larger number, below which numbers count as equal.
SAME: Final = 1e-6
#: Part name for all constituents together.
ALL: Final = "all"
#: Magnitude of the mean cosine below which a phase function counts as symmetric.
_ROUNDING: Final = 1e-12
#: Smallest and largest scattering angle at which phase functions are compared. [deg]
_LOBES: Final = (("phase function forward", 1.0), ("phase function backward", -1.0))


@dataclass(frozen=True, kw_only=True)
class Difference:
    """Quantity in which two planets differ.

    Parameters
    ----------
    part : str
        ``planet``, ``shell``, ``ground``, ``star``, the name of a constituent, or ``all``
        constituents.
    unit : str
        Unit of numerical values; empty without a unit.
    wavelength : float or None
        Wavelength of a quantity that depends on it. [nm]
    first, second : float, str or None
        Values; None where a planet does not have the quantity.

    Examples
    --------
    >>> higher = Difference(part="air", quantity="scale height", unit="m", first=8e3, second=9e3)
    >>> higher.absolute, higher.percent
    (1000.0, 12.5)
    """

    part: str
    quantity: str
    unit: str = ""
    wavelength: float | None = None
    first: Value
    second: Value

    @property
    def absolute(self) -> float | None:
        """Second minus first, if both are numbers. [unit]"""
        if isinstance(self.first, float) and isinstance(self.second, float):
            return self.second - self.first
        return None

    @property
    def percent(self) -> float | None:
        """Difference over the first value, if both are numbers and the first is not 0. [%]"""
        if self.absolute is None or self.first == 0.0:
            return None
        assert isinstance(self.first, float)
        return 100.0 * self.absolute / abs(self.first)


def common_wavelengths(first: Planet, second: Planet) -> tuple[float, ...]:
    """Wavelengths at which both planets are known: the first's, or the second's, or others.

    Returns
    -------
    tuple of float
        Wavelengths; empty if there are none. [nm]
    """
    low, high = narrowest([first.wavelength_limits, second.wavelength_limits])
    for listed in (first.wavelengths, second.wavelengths, RED_GREEN_BLUE):
        inside = tuple(nm for nm in listed if low <= nm <= high)
        if len(inside) == len(listed):
            return inside
    return (0.5 * (low + high),) if low <= high else ()


def compare(
    first: Planet, second: Planet, wavelengths: tuple[float, ...] | None = None
) -> tuple[Difference, ...]:
    """List the differences between two planets.

    Parameters
    ----------
    first, second : Planet
        Planets to compare.
    wavelengths : tuple of float, optional
        Wavelengths at which spectral values are compared; ``common_wavelengths`` by default. [nm]

    Returns
    -------
    tuple of Difference
        Parameters of planet, shell, ground and star; parameters and optical quantities of each
        constituent by name; optical quantities of the whole atmosphere. Of a constituent that one
        planet lacks, only optical quantities are listed. Relative differences below 1e-6 are
        omitted.

    Examples
    --------
    >>> from airlight.planets import load_planet
    >>> earth = load_planet("earth-atmosphere-plus")
    >>> literal = load_planet("earth-atmosphere-plus-literal")
    >>> for one in compare(earth, literal, (550.0,)):
    ...     if one.quantity == "single-scattering albedo":
    ...         print(f"{one.part}: {one.first:.3f} {one.second:.3f} {one.percent:.0f} %")
    aerosol: 0.900 0.476 -47 %
    all: 0.798 0.772 -3 %
    """
    nm = common_wavelengths(first, second) if wavelengths is None else wavelengths
    rows = [*_bodies(first, second, nm), *_air(first, second, nm)]
    return tuple(row for row in rows if differs(row.first, row.second))


def differs(first: Value, second: Value) -> bool:
    """Whether two values differ, numbers by more than 1e-6 of the larger."""
    if isinstance(first, float) and isinstance(second, float):
        return not math.isclose(first, second, rel_tol=SAME, abs_tol=0.0)
    return first != second


def _rows(
    part: str, quantity: str, unit: str, nm: tuple[float, ...], first: Any, second: Any
) -> Iterator[Difference]:
    """One row per wavelength; None where a planet has no such quantity."""
    for index, wavelength in enumerate(nm):
        values = [None if side is None else float(side[index]) for side in (first, second)]
        yield Difference(
            part=part,
            quantity=quantity,
            unit=unit,
            wavelength=wavelength,
            first=values[0],
            second=values[1],
        )


def _bodies(first: Planet, second: Planet, nm: tuple[float, ...]) -> Iterator[Difference]:
    """Differences of the planet, its shell, ground and star."""

    def row(part: str, quantity: str, unit: str, a: Value, b: Value) -> Difference:
        return Difference(part=part, quantity=quantity, unit=unit, first=a, second=b)

    yield row("shell", "ground radius", "m", first.bottom_radius, second.bottom_radius)
    yield row("shell", "top radius", "m", first.top_radius, second.top_radius)
    yield row("shell", "height", "m", first.thickness, second.thickness)
    known = [planet.wavelength_limits for planet in (first, second)]
    yield row("planet", "known from", "nm", known[0][0], known[1][0])
    yield row("planet", "known to", "nm", known[0][1], known[1][1])
    yield from _own_fields("planet", first, second)
    yield from _own_fields("ground", first.ground, second.ground)
    yield from _own_fields("star", first.star, second.star)
    albedos = [planet.ground.albedos(nm) for planet in (first, second)]
    yield from _rows("ground", "albedo", "", nm, *albedos)
    angles = [planet.star.angular_radius_degrees for planet in (first, second)]
    yield row("star", "angular radius", "deg", *angles)
    light = [planet.star.irradiances(nm) for planet in (first, second)]
    yield from _rows("star", "irradiance", "W m⁻² nm⁻¹", nm, *light)


#: Fields that are compared through quantities derived from them, or that only describe the planet.
_TREATED: Final = (
    "name", "description", "ground", "star", "constituents", "default_wavelengths", "albedo",
    "spectrum", "irradiance", "temperature", "distance", "radius", "angular_radius",
)  # fmt: skip


def _own_fields(part: str, first: Any, second: Any) -> Iterator[Difference]:
    """Differences of the other fields of the planet, ground or star, with their declared units."""
    for name, key in fields_of(type(first)).items():
        if name not in _TREATED:
            one, other = (_plain(getattr(side, name)) for side in (first, second))
            quantity, unit = name.replace("_", " "), key.unit_words
            yield Difference(part=part, quantity=quantity, unit=unit, first=one, second=other)


def _plain(value: Any) -> Value:
    return value if value is None or isinstance(value, float) else str(value)


def _air(first: Planet, second: Planet, nm: tuple[float, ...]) -> Iterator[Difference]:
    """Differences of each constituent by name, then of all of them."""
    planets = (first, second)
    light = [_Light(planet, nm) if nm else None for planet in planets]
    names = dict.fromkeys(one.name for planet in planets for one in planet.constituents)
    for name in names:
        sides = [
            next((one for one in planet.constituents if one.name == name), None)
            for planet in planets
        ]
        heights = [planet.thickness for planet in planets]
        if None in sides:
            there = [None if one is None else "there" for one in sides]
            yield Difference(part=name, quantity="constituent", first=there[0], second=there[1])
        else:
            yield from _parameters(name, sides, heights, nm)
        yield from _optics(name, light, nm)
    yield from _optics(ALL, light, nm)


def _parameters(
    name: str, sides: list[Constituent | None], heights: list[float], nm: tuple[float, ...]
) -> Iterator[Difference]:
    listed = [
        parameter_values(one, height, nm)
        for one, height in zip(sides, heights, strict=True)
        if one is not None
    ]
    for key in dict.fromkeys([*listed[0], *listed[1]]):
        quantity, unit, wavelength = key
        yield Difference(
            part=name,
            quantity=quantity,
            unit=unit,
            wavelength=wavelength,
            first=listed[0].get(key),
            second=listed[1].get(key),
        )


class _Light:
    """Vertical optical quantities of each constituent and of the whole atmosphere."""

    def __init__(self, planet: Planet, nm: tuple[float, ...]) -> None:
        medium = Medium.from_planet(planet, nm)
        scattered = medium.scattering * medium.columns[:, None]
        total = scattered.sum(axis=0)
        share = np.divide(scattered, total, out=np.zeros_like(scattered), where=total > 0.0)
        cosines = medium.phase_moments(1)[..., 1]
        cosines = np.where(np.abs(cosines) < _ROUNDING, 0.0, cosines)
        lobes = [medium.phase_function(nu) for _, nu in _LOBES]
        self.names = (*medium.names, ALL)
        self.depth = _with_sum(medium.vertical_optical_depth)
        self.scattered = _with_sum(scattered)
        self.cosine = _with_sum(cosines, cosines * share)
        self.lobes = [_with_sum(lobe, lobe * share) for lobe in lobes]

    def of(self, name: str) -> dict[tuple[str, str], FloatArray] | None:
        """Quantities of a constituent, or of ``all``, shape (nl,); None if it does not exist."""
        if name not in self.names:
            return None
        i = self.names.index(name) if name != ALL else -1
        depth, scattered = self.depth[i], self.scattered[i]
        albedo = np.divide(scattered, depth, out=np.zeros_like(depth), where=depth > 0.0)
        found = {("optical depth", ""): depth, ("single-scattering albedo", ""): albedo}
        if scattered.any():
            found["mean cosine", ""] = self.cosine[i]
            for (word, _), values in zip(_LOBES, self.lobes, strict=True):
                found[word, "sr⁻¹"] = values[i]
        return found


def _with_sum(values: FloatArray, parts: FloatArray | None = None) -> FloatArray:
    summed = (values if parts is None else parts).sum(axis=0)
    return np.concatenate([values, summed[None]])


def _optics(name: str, light: list[_Light | None], nm: tuple[float, ...]) -> Iterator[Difference]:
    found = [None if one is None else one.of(name) for one in light]
    for quantity, unit in dict.fromkeys(key for one in found for key in one or ()):
        if quantity != "optical depth" and None in found:
            continue
        nothing = np.zeros(len(nm))
        sides = [nothing if one is None else one.get((quantity, unit)) for one in found]
        yield from _rows(name, quantity, unit, nm, *sides)
