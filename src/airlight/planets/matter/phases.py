"""The phase functions a constituent can have, as parameter objects."""

from __future__ import annotations

from functools import cached_property
from typing import Annotated, Any, Final

import numpy as np
import numpy.typing as npt
from pydantic import BeforeValidator

from airlight.errors import ParameterError
from airlight.kernel import vectorized
from airlight.optics import phase_functions
from airlight.optics.phase_table import interpolated, moments
from airlight.planets.parameters import all_between, ascending, numbers, parameters
from airlight.planets.spectral import (
    EVERYWHERE,
    Limits,
    PerWavelength,
    Spectral,
    check_wavelength_list,
    spectral,
    spectral_at,
    spectral_limits,
)

FloatArray = npt.NDArray[np.float64]

#: How far from 1 the integral of a phase function may be.
INTEGRAL_TOLERANCE: Final = 1e-3
#: Largest ``|g|``: beyond it the forward lobe is narrower than the sun's disc.
LARGEST_ASYMMETRY: Final = 0.999

_Asymmetry = Annotated[Spectral, spectral(-LARGEST_ASYMMETRY, LARGEST_ASYMMETRY)]


@parameters
class Rayleigh:
    """Molecules, or anything much smaller than the wavelength.

    Parameters
    ----------
    depolarisation : float or PerWavelength
        δ, 0 to 0.5. [1]
    """

    depolarisation: Annotated[Spectral, spectral(0.0, 0.5)] = 0.0

    @property
    def limits(self) -> Limits:
        """The wavelengths at which it is known. [nm]"""
        return spectral_limits(self.depolarisation)

    def values(self, nu: npt.ArrayLike, wavelengths: npt.ArrayLike) -> FloatArray:
        """The phase function, shape of nu (...) and wavelengths (nl,) to (..., nl). [sr⁻¹]"""
        delta = spectral_at(self.depolarisation, wavelengths)
        return _evaluated(phase_functions.rayleigh, nu, delta)


@parameters
class CornetteShanks:
    """Particles with one lobe that tends to Rayleigh's as g tends to 0.

    Parameters
    ----------
    asymmetry : float or PerWavelength
        g, positive forward, -0.999 to 0.999; not exactly the mean cosine. [1]
    """

    asymmetry: _Asymmetry

    @property
    def limits(self) -> Limits:
        """The wavelengths at which it is known. [nm]"""
        return spectral_limits(self.asymmetry)

    def values(self, nu: npt.ArrayLike, wavelengths: npt.ArrayLike) -> FloatArray:
        """The phase function, shape of nu (...) and wavelengths (nl,) to (..., nl). [sr⁻¹]"""
        return _evaluated(
            phase_functions.cornette_shanks, nu, spectral_at(self.asymmetry, wavelengths)
        )


@parameters
class HenyeyGreenstein:
    """Particles with one lobe.

    Parameters
    ----------
    asymmetry : float or PerWavelength
        g, the mean cosine, -0.999 to 0.999. [1]
    """

    asymmetry: _Asymmetry

    @property
    def limits(self) -> Limits:
        """The wavelengths at which it is known. [nm]"""
        return spectral_limits(self.asymmetry)

    def values(self, nu: npt.ArrayLike, wavelengths: npt.ArrayLike) -> FloatArray:
        """The phase function, shape of nu (...) and wavelengths (nl,) to (..., nl). [sr⁻¹]"""
        return _evaluated(
            phase_functions.henyey_greenstein, nu, spectral_at(self.asymmetry, wavelengths)
        )


@parameters
class DoubleHenyeyGreenstein:
    """Particles with two lobes: weight·HG(asymmetry_1) + (1 - weight)·HG(asymmetry_2).

    Parameters
    ----------
    asymmetry_1, asymmetry_2 : float or PerWavelength
        Mean cosine of each lobe, -0.999 to 0.999. [1]
    weight : float or PerWavelength
        Share of the first lobe, 0 to 1. [1]
    """

    asymmetry_1: _Asymmetry
    asymmetry_2: _Asymmetry
    weight: Annotated[Spectral, spectral(0.0, 1.0)]

    @property
    def limits(self) -> Limits:
        """The wavelengths at which it is known. [nm]"""
        return spectral_limits(self.asymmetry_1, self.asymmetry_2, self.weight)

    def values(self, nu: npt.ArrayLike, wavelengths: npt.ArrayLike) -> FloatArray:
        """The phase function, shape of nu (...) and wavelengths (nl,) to (..., nl). [sr⁻¹]"""
        return _evaluated(
            phase_functions.double_henyey_greenstein,
            nu,
            spectral_at(self.asymmetry_1, wavelengths),
            spectral_at(self.asymmetry_2, wavelengths),
            spectral_at(self.weight, wavelengths),
        )


def _rows(value: Any) -> tuple[tuple[float, ...], ...]:
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if not isinstance(value, (list, tuple)):
        raise ParameterError("values", value, "a list of lists of numbers")
    return tuple(numbers(row, f"values[{i}]", 0.0, 1e12, "/sr") for i, row in enumerate(value))


@parameters
class TabulatedPhase:
    """A phase function from a table; between angles its logarithm is linear in the angle.

    Parameters
    ----------
    angles : tuple of float
        Scattering angles, ascending from 0 to 180. [deg]
    rows : tuple of tuple of float
        One row of values per wavelength, each as long as ``angles``; a single row serves every
        wavelength. [sr⁻¹]
    wavelengths : tuple of float
        One per row; empty for a single row. Linear between them. [nm]

    Raises
    ------
    ParameterError
        If a row does not integrate to 1 within 0.001: the value shown is its integral.
    """

    angles: Annotated[tuple[float, ...], all_between(0.0, 180.0, "deg")]
    rows: Annotated[tuple[tuple[float, ...], ...], BeforeValidator(_rows)]
    wavelengths: Annotated[tuple[float, ...], all_between(10.0, 1e6, "nm")] = ()

    def __post_init__(self) -> None:
        if not 3 <= len(self.angles) <= 10_000 or self.angles[0] != 0.0 or self.angles[-1] != 180.0:
            raise ParameterError("angles", self.angles, "3 to 10000 angles from 0 to 180 deg")
        ascending(self.angles, "angles", "deg")
        if self.wavelengths:
            check_wavelength_list(self.wavelengths)
        rows = max(1, len(self.wavelengths))
        if len(self.rows) != rows:
            raise ParameterError("values", len(self.rows), f"{rows} rows, one per wavelength")
        for index, row in enumerate(self.rows):
            if len(row) != len(self.angles):
                raise ParameterError(
                    f"values[{index}]", len(row), f"as many numbers as angles, {len(self.angles)}"
                )
        integrals = moments(*self._table, 0)[:, 0]
        for index in range(rows):
            if not abs(integrals[index] - 1.0) <= INTEGRAL_TOLERANCE:
                raise ParameterError(
                    f"integral of values[{index}]",
                    float(integrals[index]),
                    f"1 within {INTEGRAL_TOLERANCE:g}: divide the values by it",
                )

    @cached_property
    def _table(self) -> tuple[FloatArray, FloatArray]:
        return np.array(self.angles), np.array(self.rows)

    @property
    def limits(self) -> Limits:
        """The wavelengths at which it is known. [nm]"""
        if not self.wavelengths:
            return EVERYWHERE
        return PerWavelength(wavelengths=self.wavelengths, values=self.wavelengths).limits

    def values(self, nu: npt.ArrayLike, wavelengths: npt.ArrayLike) -> FloatArray:
        """The phase function, shape of nu (...) and wavelengths (nl,) to (..., nl). [sr⁻¹]"""
        angle = np.degrees(np.arccos(np.clip(nu, -1.0, 1.0)))
        return np.asarray(interpolated(*self._table, angle) @ self._weights(wavelengths))

    def moments(self, wavelengths: npt.ArrayLike, degree: int) -> FloatArray:
        """Legendre moments as ``optics.legendre`` defines them, shape (nl, degree + 1). [1]

        Integrated between the table's own angles, so that no ripple falls between the nodes.
        """
        return np.asarray(self._weights(wavelengths).T @ moments(*self._table, degree))

    def _weights(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Share of each row in the values at each wavelength, shape (nr, nl). [1]"""
        nm = np.asarray(wavelengths, dtype=np.float64)
        weights = np.ones((1, len(nm)))
        if self.wavelengths:
            order = np.argsort(self.wavelengths)
            known = np.asarray(self.wavelengths)[order]
            weights = np.empty((len(known), len(nm)))
            for position, unit_row in zip(order, np.eye(len(known)), strict=True):
                weights[position] = np.interp(nm, known, unit_row)
        return weights


PhaseFunction = (
    Rayleigh | CornetteShanks | HenyeyGreenstein | DoubleHenyeyGreenstein | TabulatedPhase
)


def _evaluated(formula: Any, nu: npt.ArrayLike, *per_wavelength: FloatArray) -> FloatArray:
    cosines = np.asarray(nu, dtype=np.float64)[..., None]
    return np.asarray(vectorized(formula)(cosines, *per_wavelength))
