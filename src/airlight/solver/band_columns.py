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
#: Transmittance of the largest of ``MULTIPLES`` from which a gas is left out. [1]
_CLEAR: Final = 0.999


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
    widths : array, shape (nl,)
        Widths of the bands. [nm]
    """

    medium: Medium
    columns: Medium
    band: NDArray[np.intp]
    weights: FloatArray
    widths: FloatArray

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
        whole = planet.with_gases.constituents
        curves = {
            one.name: _transmittances(one, nm, widths)
            for one in whole
            if isinstance(one.absorption, BandAbsorption)
        }
        absorb = {name for name, curve in curves.items() if (curve[:, -1] < _CLEAR).any()}
        kept = [
            one for one in whole if one.name not in curves or one.name in absorb or one.scatters
        ]
        bare = tuple(replace(one, absorption=0.0) if one.name in curves else one for one in kept)
        medium = Medium.from_planet(
            replace(planet, constituents=bare, gases=()), nm, progress=progress, cancel=cancel
        )
        medium = replace(medium, solar_irradiance=_band_irradiance(planet, nm, widths))
        rows = [row for row, one in enumerate(kept) if one.name in absorb]
        terms = [_terms([curves[kept[row].name][k] for row in rows]) for k in range(nm.size)]
        band = np.repeat(np.arange(nm.size), [one.weights.size for one, _ in terms])
        absorption = medium.absorption[:, band]
        for part, row in enumerate(rows):
            depth = np.concatenate([depths[part] for _, depths in terms])
            height = kept[row].profile.column(planet.thickness)
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
        return cls(medium, columns, band, weights, widths)

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


def _transmittances(one: Constituent, nm: FloatArray, widths: FloatArray) -> FloatArray:
    """Mean transmittance of each band for ``MULTIPLES`` of a gas, shape (nl, 48). [1]"""
    assert isinstance(one.absorption, BandAbsorption)
    of, multiples = one.absorption.transmittances, one.amount * MULTIPLES
    return np.array([of(c, w, multiples) for c, w in zip(nm, widths, strict=True)])


def _terms(curves: list[FloatArray]) -> tuple[ExponentialSum, FloatArray]:
    """Exponential sum of all gases over a band, and the gases' parts of its rates, (gases, nt)."""
    lines = [k for k, curve in enumerate(curves) if curve[-1] < _CLEAR]
    if not lines:
        return NOTHING, np.zeros((len(curves), 1))
    total = exponential_sum(reduce(np.multiply, [curves[k] for k in lines]))
    depths = np.zeros((len(curves), total.rates.size))
    depths[lines] = divided(total, [exponential_sum(curves[k]) for k in lines])
    return total, depths
