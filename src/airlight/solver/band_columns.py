"""Bands: terms of k-distributions as columns of one medium, whose results are averaged."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import reduce
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.physics.optics.exponential_sums import (
    MULTIPLES,
    NOTHING,
    ExponentialSum,
    divided,
    exponential_sum,
)
from airlight.physics.optics.gas_absorption import reference_coefficient
from airlight.physics.units import values_in
from airlight.planets.matter.band_absorption import BandAbsorption
from airlight.planets.medium import Medium

if TYPE_CHECKING:
    from airlight.kernel.threads import Cancel, Progress
    from airlight.physics.units import Measures
    from airlight.planets.constituent import Constituent
    from airlight.planets.planet import Planet

FloatArray = NDArray[np.float64]

#: Largest width of a band: scattering is that of its middle. [nm]
WIDEST: Final = 100.0
#: Optical depth of a gas at air mass 1 below which it is left out. [1]
_LEAST: Final = 1e-5


@dataclass(frozen=True, eq=False)
class BandColumns:
    """Medium of bands, and the medium whose columns are the terms of their k-distributions.

    Attributes
    ----------
    medium : Medium
        Medium at the middles of the bands, without the gases; irradiance of the star is the mean
        over each band.
    columns : Medium
        Medium of the terms.
    band : array of int, shape (ncol,)
        Band of each column, ascending.
    weights : array, shape (ncol,)
        Weights of the columns, whose sum over a band is 1. [1]
    """

    medium: Medium
    columns: Medium
    band: NDArray[np.intp]
    weights: FloatArray

    @classmethod
    def of(
        cls,
        planet: Planet,
        wavelengths: FloatArray,
        bandwidth: Measures,
        *,
        progress: Progress | None = None,
        cancel: Cancel | None = None,
    ) -> BandColumns:
        """Columns of a planet with its gases.

        Parameters
        ----------
        planet : Planet
            Planet without three-dimensional clouds.
        wavelengths : array, shape (nl,)
            Middles of the bands. [nm]
        bandwidth : float or array, shape (nl,)
            Full widths of the bands. [nm]
        progress, cancel : callable, optional
            See ``airlight.kernel.threads``.

        Raises
        ------
        ParameterError
            If a width is not above 0 and at most 100 nm.
        """
        nm = np.atleast_1d(wavelengths)
        widths = _widths(bandwidth, nm.size)
        whole = planet.with_gases
        gases = [isinstance(one.absorption, BandAbsorption) for one in whole.constituents]
        bare = tuple(
            replace(one, absorption=0.0) if gas else one
            for one, gas in zip(whole.constituents, gases, strict=True)
        )
        medium = Medium.from_planet(
            replace(whole, constituents=bare), nm, progress=progress, cancel=cancel
        )
        medium = replace(medium, solar_irradiance=_band_irradiance(planet, nm, widths))
        rows = [row for row, gas in enumerate(gases) if gas]
        parts = [whole.constituents[row] for row in rows]
        terms = [_terms(parts, c, w) for c, w in zip(nm.tolist(), widths.tolist(), strict=True)]
        band = np.repeat(np.arange(nm.size), [one.weights.size for one, _ in terms])
        absorption = medium.absorption[:, band]
        if rows:
            depths = np.concatenate([depth for _, depth in terms], axis=1)
            for row, one, depth in zip(rows, parts, depths, strict=True):
                height = one.profile.column(planet.thickness)
                absorption[row] += reference_coefficient(1.0, height, depth)
        columns = replace(
            medium,
            wavelengths=medium.wavelengths[band],
            scattering=medium.scattering[:, band],
            absorption=absorption,
            phase_table=medium.phase_table[:, band],
            ground_albedo=medium.ground_albedo[band],
            solar_irradiance=medium.solar_irradiance[band],
        )
        weights = np.concatenate([one.weights for one, _ in terms])
        return cls(medium, columns, band, weights)

    def mean(self, values: FloatArray) -> FloatArray:
        """Means over bands of values of columns, shape (..., ncol) to (..., nl)."""
        starts = np.searchsorted(self.band, np.arange(self.band[-1] + 1))
        return np.asarray(np.add.reduceat(values * self.weights, starts, axis=-1))


def _widths(bandwidth: Measures, count: int) -> FloatArray:
    given = np.asarray(values_in(bandwidth, "nm", "bandwidth"), dtype=np.float64)
    if given.ndim > 1 or given.size not in (1, count):
        raise ParameterError("bandwidth", given.shape, f"one width, or {count} of them")
    if not ((given > 0.0) & (given <= WIDEST)).all():
        raise ParameterError("bandwidth", float(given.min()), f"more than 0, up to {WIDEST:g} nm")
    return np.broadcast_to(given, (count,))


def _band_irradiance(planet: Planet, nm: FloatArray, widths: FloatArray) -> FloatArray:
    """Mean irradiance of the star over each band, shape (nl,). [W m⁻² nm⁻¹]"""
    low, high = planet.star.limits
    found = []
    for centre, width in zip(nm.tolist(), widths.tolist(), strict=True):
        count = max(int(np.ceil(width / 0.25)), 4)
        within = centre + width * ((np.arange(count) + 0.5) / count - 0.5)
        found.append(planet.star.irradiances(np.clip(within, low, high)).mean())
    return np.array(found)


def _terms(
    gases: list[Constituent], centre: float, width: float
) -> tuple[ExponentialSum, FloatArray]:
    """Exponential sum of all gases over a band, and the gases' parts of its rates, (gases, nt)."""
    curves = [_transmittances(one, centre, width) for one in gases]
    lines = [k for k, curve in enumerate(curves) if curve[-1] < 1.0 - MULTIPLES[-1] * _LEAST]
    if not lines:
        return NOTHING, np.zeros((len(gases), 1))
    total = exponential_sum(reduce(np.multiply, [curves[k] for k in lines]))
    depths = np.zeros((len(gases), total.rates.size))
    depths[lines] = divided(total, [exponential_sum(curves[k]) for k in lines])
    return total, depths


def _transmittances(one: Constituent, centre: float, width: float) -> FloatArray:
    assert isinstance(one.absorption, BandAbsorption)
    return one.absorption.transmittances(centre, width, one.amount * MULTIPLES)
