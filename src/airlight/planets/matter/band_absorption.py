"""Absorption by lines of a gas, averaged over bands."""

from __future__ import annotations

from typing import Final

import numpy as np
import numpy.typing as npt

from airlight.physics.optics.gas_absorption import reference_coefficient
from airlight.physics.units import values_in
from airlight.planets.matter.matter import Absorber
from airlight.planets.matter.state_keys import COLUMN
from airlight.planets.parameters import parameters
from airlight.planets.schema.field import key
from airlight.planets.spectral import Limits

FloatArray = npt.NDArray[np.float64]

#: Air mass and width of the band for which coefficients without a bandwidth are made. [1], [nm]
AIR_MASS: Final = 1.5
WIDTH: Final = 10.0


def _tables() -> tuple[str, ...]:
    from airlight.physics.optics.band_transmission import TABLES

    return tuple(TABLES.values())


@parameters
class BandAbsorption(Absorber):
    """Absorption by lines of a gas with a k-distribution in each band.

    Parameters
    ----------
    transmission : str
        Table of ``physics.optics.band_transmission``.
    column : float
        Vertical column of molecules. [m⁻²]

    Notes
    -----
    Tables are made for paths through the whole of the Earth's air; their pressures are not those
    of the planet. The profile should be that of the density which counts, with p to the power of
    0.94 (oxygen), 0.89 (water vapour), 0.79 (carbon dioxide) or 0.71 (methane).
    """

    keyword = "transmission"

    transmission: str = key(
        help="Table of transmittances of a gas.",
        note="With a bandwidth each band has a k-distribution of up to 8 terms; without, the"
        " coefficient is that of 10 nm at air mass 1.5.",
        choices=_tables,
    )
    column: float = key(COLUMN)

    @property
    def limits(self) -> Limits:
        """Wavelength range of the tables. [nm]"""
        from airlight.physics.optics.band_transmission import LIMITS

        return LIMITS

    def transmittances(self, centre: float, width: float, multiples: FloatArray) -> FloatArray:
        """Mean transmittance over a band [nm] of multiples of the column, shape (n,). [1]"""
        from airlight.physics.optics.band_transmission import band_transmittance

        return band_transmittance(self.transmission, centre, width, self.column * multiples)

    def coefficients(self, wavelengths: npt.ArrayLike, vertical_column: float) -> FloatArray:
        """Absorption coefficient at relative density 1, shape (nl,). [m⁻¹]"""
        nm = np.atleast_1d(values_in(wavelengths, "nm", "wavelengths"))
        way = np.array([AIR_MASS])
        mean = np.array([self.transmittances(float(one), WIDTH, way)[0] for one in nm])
        sigma = -np.log(np.maximum(mean, 1e-300)) / (AIR_MASS * self.column)
        return reference_coefficient(self.column, vertical_column, sigma)
