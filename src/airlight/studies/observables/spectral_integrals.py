"""Integrals of irradiance over wavelengths, and the wavelengths that they need.

Irradiance over the star's irradiance is interpolated log-linearly to half nanometres; the star's
lines are thus integrated at the resolution of its own spectrum.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.physics.spectra.action_spectra import (
    UV_INDEX_SCALE,
    erythema,
    luminous_efficacy,
    photons,
    photosynthetic,
)
from airlight.physics.spectra.v_band import V_RANGE, v_passband
from airlight.planets.medium import Medium
from airlight.planets.planet import Planet
from airlight.solver.band_solution import band_widths
from airlight.solver.solution import Solution

FloatArray = NDArray[np.float64]

#: Range of default wavelengths, as far as the planet's data reach. [nm]
SHORTEST, LONGEST = 280.0, 4000.0
#: Largest step of default wavelengths, and from where on five times that. [nm]
WIDEST: Final = 20.0
INFRARED: Final = 1000.0
#: Width of default bands of gases from the first wavelength on, and from ``INFRARED`` on. [nm]
LINES: Final = 580.0
BAND: Final = 20.0
BROAD: Final = 100.0
#: Air mass at which wavelengths are chosen and errors are estimated. [1]
AIR_MASS: Final = 1.5
#: Largest error of the interpolated direct beam over the star's, and of its erythemal part over
#: the largest. [1]
TOLERANCE: Final = 0.01
#: Smallest ratio that is interpolated. [1]
_DARK: Final = 1e-30
#: Width of bands from which their means are kept. [nm]
_WIDE: Final = 2.0
#: Largest part of a weighted spectrum, over its maximum, at an end of the wavelengths where the
#: weight goes on. [1]
_END: Final = 0.01


@dataclass(frozen=True)
class Integral:
    """Integral of irradiance with a weight.

    Attributes
    ----------
    unit, label : str
        Unit and long name.
    weight : callable
        Function of wavelengths [nm], in ``unit`` per W m⁻².
    low, high : float
        Range of the weight. [nm]
    """

    unit: str
    label: str
    weight: Callable[[FloatArray], FloatArray]
    low: float
    high: float


#: Integrals of global irradiance by name.
WEIGHTED: Final = {
    "illuminance": Integral("lx", "illuminance", luminous_efficacy, 360.0, 830.0),
    "par": Integral(
        "W m-2", "photosynthetically active radiation, 400 to 700 nm", photosynthetic, 400.0, 700.0
    ),
    "par_photons": Integral(
        "umol m-2 s-1",
        "photosynthetically active photons, 400 to 700 nm",
        lambda nm: photosynthetic(nm) * photons(nm),
        400.0,
        700.0,
    ),
    "uv_index": Integral("1", "UV index", lambda nm: UV_INDEX_SCALE * erythema(nm), 250.0, 400.0),
}
#: Energy in the passband of V, see ``airlight.physics.spectra.v_band``.
V_BAND: Final = Integral("W m-2", "irradiance in V", v_passband, *V_RANGE)


class SpectralIntegrals:
    """Integrals over the wavelengths of a solution.

    Parameters
    ----------
    solution : Solution
        Solution at two wavelengths or more.
    """

    def __init__(self, solution: Solution) -> None:
        self._order = np.argsort(solution.wavelengths)
        self.wavelengths = solution.wavelengths[self._order]
        widths = band_widths(solution)
        self._widths = np.zeros(self._order.size) if widths is None else widths[self._order]
        half = 0.5 * self._widths
        apart = np.diff(self.wavelengths) > half[:-1] + half[1:] - 0.5
        self._alone = np.concatenate([[True], apart]) & np.concatenate([apart, [True]])
        self.dense = steps_between(*self.range, 0.5)
        source = solution.lights[0]
        known = source.irradiance if source.spectrum is None else source.spectrum(self.dense)
        self.star = np.asarray(known, float)
        self._solution = solution

    @property
    def range(self) -> tuple[float, float]:
        """First and last wavelength, of bands their edges. [nm]"""
        ends = self._widths[[0, -1]]
        half = np.where(ends >= _WIDE, 0.5 * ends, 0.0)
        return float(self.wavelengths[0] - half[0]), float(self.wavelengths[-1] + half[1])

    @property
    def words(self) -> str:
        """Range of broadband quantities as text."""
        return "{:g} to {:g} nm".format(*self.range)

    def spectra(self, ratio: FloatArray) -> FloatArray:
        """Irradiance at half nanometres from that over the star's, (n, nl) to (n, nd).

        That of a band of 2 nm or more has the mean of the band, unless it overlaps another one.
        """
        logs = np.log(np.maximum(ratio[:, self._order], _DARK))
        found = [np.interp(self.dense, self.wavelengths, one) for one in logs]
        between = np.exp(found)
        lit: FloatArray = np.where(between > 10.0 * _DARK, between, 0.0) * self.star
        for k in np.flatnonzero((self._widths >= _WIDE) & self._alone):
            low = self.wavelengths[k] - 0.5 * self._widths[k]
            of = (self.dense >= low) & (self.dense < low + self._widths[k])
            known = ratio[:, self._order[k]] * self.star[of].sum()
            lit[:, of] *= (known / np.maximum(lit[:, of].sum(axis=1), _DARK))[:, None]
        return lit

    def broadband(self, ratio: FloatArray) -> FloatArray:
        """Irradiance over all wavelengths, shape (n,). [W m⁻²]"""
        return np.asarray(np.trapezoid(self.spectra(ratio), self.dense))

    def weighted(self, one: Integral, ratio: FloatArray) -> FloatArray:
        """Integral with a weight, shape (n,); NaN where the wavelengths do not reach.

        Of radiance over the star's irradiance it is luminance, or radiance in a passband.
        """
        inside = (self.dense >= one.low) & (self.dense <= one.high)
        nm = self.dense[inside]
        if nm.size < 2:
            return np.full(len(ratio), np.nan)
        light = self.spectra(ratio)[:, inside] * one.weight(nm)
        largest = _END * light.max(axis=1)
        cut = (nm[0] > one.low) & (light[:, 0] > largest)
        cut |= (nm[-1] < one.high) & (light[:, -1] > largest)
        return np.where(cut, np.nan, np.trapezoid(light, nm))

    def errors(self) -> dict[str, float]:
        """Estimated relative errors of interpolation, by name: those of the vertical air's beam.

        Empty for a solution without a planet. [1]
        """
        planet = self._solution.planet
        if planet is None:
            return {}
        whole = sampled(*self.range)
        depth = vertical_depth(planet, whole)
        true = np.exp(-AIR_MASS * np.interp(self.dense, whole, depth))
        at = np.interp(self.wavelengths, whole, depth)
        near = np.exp(-AIR_MASS * np.interp(self.dense, self.wavelengths, at))
        found = {}
        for name, one in WEIGHTED.items():
            inside = (self.dense >= one.low) & (self.dense <= one.high)
            found[name] = self._error(inside, one.weight(self.dense), near, true)
        everywhere = np.ones(self.dense.shape)
        return {"broadband": self._error(everywhere > 0.0, everywhere, near, true)} | found

    def _error(
        self, inside: NDArray[np.bool_], weight: FloatArray, near: FloatArray, true: FloatArray
    ) -> float:
        nm, light = self.dense[inside], (weight * self.star)[inside]
        if nm.size < 2:
            return 0.0
        whole = float(np.trapezoid(light * true[inside], nm))
        return float(np.trapezoid(light * near[inside], nm)) / whole - 1.0 if whole > 0.0 else 0.0


def steps_between(low: float, high: float, step: float) -> FloatArray:
    """Both ends and the multiples of a step between them.

    Examples
    --------
    >>> steps_between(440.7, 442.0, 0.5)
    array([440.7, 441. , 441.5, 442. ])
    """
    between = np.arange(np.floor(low / step) + 1.0, np.ceil(high / step)) * step
    return np.unique(np.concatenate(([low], between, [high])))


def sampled(low: float, high: float) -> FloatArray:
    """Both ends, and wavelengths every nanometre, from 1000 nm on every five. [nm]

    Examples
    --------
    >>> sampled(998.5, 1007.0)
    array([ 998.5,  999. , 1000. , 1005. , 1007. ])
    """
    parts = [np.array([low, high])]
    if low < INFRARED:
        parts.append(steps_between(low, min(high, INFRARED), 1.0))
    if high > INFRARED:
        parts.append(steps_between(max(low, INFRARED), high, 5.0))
    return np.unique(np.concatenate(parts))


def vertical_depth(planet: Planet, wavelengths: ArrayLike) -> FloatArray:
    """Optical depth of the clear air, shape (nl,). [1]"""
    medium = Medium.from_planet(planet.without_clouds, wavelengths)
    return np.asarray(medium.columns @ medium.extinction)


def irradiance_wavelengths(planet: Planet) -> tuple[float, ...]:
    """Wavelengths at which the irradiance of a planet can be integrated. [nm]

    Every 20 nm, and further whole nanometres, largest error first, until the direct beam at air
    mass 1.5, interpolated between them, is right within 1 % of the star's irradiance, and its
    erythemal part within 1 % of the largest.

    Parameters
    ----------
    planet : Planet
        Planet; its data limit the range, at most 280 to 4000 nm.
    """
    low, high = planet.wavelength_limits
    low, high = max(low, SHORTEST), min(high, LONGEST)
    if high - low < 1.0:
        return tuple(planet.wavelengths)
    dense = sampled(np.ceil(low), np.floor(high))
    depth = vertical_depth(planet, dense)
    beam = np.exp(-AIR_MASS * depth)
    burning = erythema(dense) * planet.star.irradiances(dense)
    largest = float((burning * beam).max()) or 1.0
    weight = np.maximum(1.0, burning / largest)
    ends = np.unique([dense[0], *np.clip([INFRARED], dense[0], dense[-1]), dense[-1]])
    places: set[int] = set()
    for first, last, step in zip(ends, ends[1:], (WIDEST, 5.0 * WIDEST), strict=False):
        even = np.linspace(first, last, int(np.ceil((last - first) / step)) + 1)
        places |= set(np.searchsorted(dense, even.round()).tolist())
    while len(places) < dense.size:
        chosen = sorted(places)
        near = np.exp(-AIR_MASS * np.interp(dense, dense[chosen], depth[chosen]))
        error = np.abs(near - beam) * weight
        worst = int(error.argmax())
        if error[worst] <= TOLERANCE:
            break
        places.add(worst)
    return tuple(dense[sorted(places)].tolist())


def irradiance_bands(planet: Planet) -> tuple[FloatArray, FloatArray | None]:
    """Wavelengths of ``irradiance_wavelengths``, and bands where a planet's gases absorb in lines.

    Parameters
    ----------
    planet : Planet
        Planet with its gases.

    Returns
    -------
    wavelengths : array, shape (nl,)
        Wavelengths and middles of bands. [nm]
    widths : array, shape (nl,), or None
        Widths of bands, of 1 nm for wavelengths; None for a planet without gases. [nm]
    """
    alone = np.array(irradiance_wavelengths(planet))
    high = min(planet.with_gases.wavelength_limits[1], LONGEST)
    if not planet.gases or high <= LINES or alone[0] >= LINES:
        return alone, None
    below = alone[alone < LINES - 0.5]
    edges = [np.arange(LINES, min(high, INFRARED), BAND), np.arange(INFRARED, high + 1.0, BROAD)]
    starts = np.concatenate([*edges, [high]])
    starts = starts[starts <= high]
    widths = np.diff(starts)
    wide = widths > 0.0
    middles = (starts[:-1] + 0.5 * widths)[wide]
    return np.concatenate([below, middles]), np.concatenate([np.ones(below.size), widths[wide]])


def band_wavelengths(planet: Planet, bandwidth: float) -> tuple[float, ...]:
    """Middles of adjacent bands over the range of ``irradiance_wavelengths``. [nm]

    Parameters
    ----------
    planet : Planet
        Planet with its gases, whose data limit the range, at most 280 to 4000 nm.
    bandwidth : float
        Width of the bands. [nm]

    Examples
    --------
    >>> from airlight.planets import load_planet
    >>> middles = band_wavelengths(load_planet("earth"), 10.0)
    >>> middles[0], middles[-1], len(middles)
    (285.0, 2495.0, 222)
    """
    low, high = planet.with_gases.wavelength_limits
    low, high = max(low, SHORTEST), min(high, LONGEST)
    count = max(int((high - low) / bandwidth), 1)
    return tuple((low + bandwidth * (np.arange(count) + 0.5)).tolist())
