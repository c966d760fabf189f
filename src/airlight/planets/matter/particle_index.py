"""What particles are made of, as parameter objects: their complex refractive index."""

from __future__ import annotations

from typing import Annotated, Final

import numpy as np
import numpy.typing as npt

from airlight.optics.effective_medium import maxwell_garnett
from airlight.optics.index_table import read_index
from airlight.planets.parameters import Fraction, instance_of, parameters
from airlight.planets.spectral import (
    Limits,
    PerWavelength,
    Spectral,
    narrowest,
    spectral,
    spectral_at,
    spectral_limits,
)

ComplexArray = npt.NDArray[np.complex128]

#: The longest list of wavelengths at each of which particles are computed exactly.
_LONGEST_OWN: Final = 40


@parameters
class GivenIndex:
    """A refractive index n + ik, given as numbers.

    Parameters
    ----------
    real : float or PerWavelength
        n, 0.1 to 10. [1]
    imaginary : float or PerWavelength
        k, 0 to 10: light is only ever absorbed. [1]
    """

    real: Annotated[Spectral, spectral(0.1, 10.0)]
    imaginary: Annotated[Spectral, spectral(0.0, 10.0)] = 0.0

    @property
    def limits(self) -> Limits:
        """The wavelengths at which it is known. [nm]"""
        return spectral_limits(self.real, self.imaginary)

    @property
    def own_wavelengths(self) -> tuple[float, ...]:
        """The wavelengths that it was given at. [nm]"""
        own: set[float] = set()
        for value in (self.real, self.imaginary):
            if isinstance(value, PerWavelength) and len(value.wavelengths) <= _LONGEST_OWN:
                own.update(value.wavelengths)
        return tuple(sorted(own))

    def at(self, wavelengths: npt.ArrayLike) -> ComplexArray:
        """n + ik at wavelengths within ``limits`` [nm], shape (nl,)."""
        n, k = (spectral_at(value, wavelengths) for value in (self.real, self.imaginary))
        return np.asarray(n + 1j * k)


@parameters
class TableIndex:
    """A refractive index from a table.

    Parameters
    ----------
    table : str
        A name or path that ``optics.index_table.read_index`` knows.
    """

    table: str

    def __post_init__(self) -> None:
        read_index(self.table)

    @property
    def limits(self) -> Limits:
        """The wavelengths at which it is known. [nm]"""
        return read_index(self.table).limits

    @property
    def own_wavelengths(self) -> tuple[float, ...]:
        """None: tables have many rows."""
        return ()

    def at(self, wavelengths: npt.ArrayLike) -> ComplexArray:
        """n + ik at wavelengths within ``limits`` [nm], shape (nl,)."""
        return read_index(self.table).at(wavelengths)


@parameters
class MixedIndex:
    """A matrix that holds small grains of something else; Maxwell Garnett's rule.

    Parameters
    ----------
    matrix, inclusions : GivenIndex or TableIndex
    fraction : float
        Share of the inclusions in the volume, 0 to 1. [1]
    """

    matrix: Annotated[GivenIndex | TableIndex, instance_of(GivenIndex, TableIndex)]
    inclusions: Annotated[GivenIndex | TableIndex, instance_of(GivenIndex, TableIndex)]
    fraction: Fraction

    @property
    def limits(self) -> Limits:
        """The wavelengths at which both are known. [nm]"""
        return narrowest([self.matrix.limits, self.inclusions.limits])

    @property
    def own_wavelengths(self) -> tuple[float, ...]:
        """The wavelengths that either was given at. [nm]"""
        own = {*self.matrix.own_wavelengths, *self.inclusions.own_wavelengths}
        low, high = self.limits
        return tuple(sorted(nm for nm in own if low <= nm <= high))

    def at(self, wavelengths: npt.ArrayLike) -> ComplexArray:
        """n + ik at wavelengths within ``limits`` [nm], shape (nl,)."""
        parts = self.matrix.at(wavelengths), self.inclusions.at(wavelengths)
        return maxwell_garnett(*parts, self.fraction)


ParticleIndex = GivenIndex | TableIndex | MixedIndex
