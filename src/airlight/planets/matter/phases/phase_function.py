"""Interface of phase functions, and methods that only use their values."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from functools import lru_cache
from typing import Any, ClassVar, Final, NamedTuple

import numpy as np
import numpy.typing as npt

from airlight.kernel import vectorized
from airlight.physics.optics.legendre import legendre_moments
from airlight.physics.optics.phase_matrix import unpolarising_ratio
from airlight.physics.optics.phase_table import interpolated
from airlight.physics.units import values_in
from airlight.planets.schema.toml_model import TomlModel, fields_of
from airlight.planets.spectral import Limits, PerWavelength, spectral_at, spectral_limits

FloatArray = npt.NDArray[np.float64]

#: Largest deviation from 1 of the integral of a phase function.
INTEGRAL_TOLERANCE: Final = 1e-3
#: Largest deviation of a formula's logarithm from linear interpolation between tabulated angles.
#: [1]
_TABLE_TOLERANCE: Final = 1e-5
#: Number of angles of the first table, and of halvings of its widest steps.
_FIRST_ANGLES: Final = 181
_MOST_HALVINGS: Final = 24
#: Number of digits of a parameter in a planet file.
_DIGITS: Final = 6
#: Points between tabulated angles in the integrals of polarisation.
_STEPS_A_CELL: Final = 4
#: Largest number of cached polarising elements, by formula and parameters.
_CACHE_SIZE: Final = 512


class PhaseRow(NamedTuple):
    """Tabulated phase function over the scattering angle, with its weight in a mixture.

    Attributes
    ----------
    share : float
        Weight. [1]
    angles : array, shape (m,)
        Angles, ascending from 0 to 180; the logarithm is linear between them. [deg]
    values : array, shape (m,)
        Phase function. [sr⁻¹]
    ratios : array, shape (3, m), or None
        F₁₂, F₃₃ and F₃₄ over the phase function, linear between the angles; None if unknown. [1]
    """

    share: float
    angles: FloatArray
    values: FloatArray
    ratios: FloatArray | None = None


class PhaseFunction(TomlModel, ABC):
    """Phase function as a parameter object, normalised to 1 over the sphere.

    Attributes
    ----------
    molecular : bool
        Whether it is that of molecules, whose scattering follows λ⁻⁴ beyond given wavelengths.
    """

    molecular: ClassVar[bool] = False

    @property
    @abstractmethod
    def limits(self) -> Limits:
        """Wavelength range. [nm]"""

    @abstractmethod
    def values(self, nu: npt.ArrayLike, wavelengths: npt.ArrayLike) -> FloatArray:
        """Phase function, shape of nu (...) and wavelengths (nl,) to (..., nl). [sr⁻¹]"""

    def phase_f12(self, nu: npt.ArrayLike, wavelengths: npt.ArrayLike) -> FloatArray:
        """Element F₁₂ of the phase matrix, shape of nu (...) and (nl,) to (..., nl). [sr⁻¹]

        Zero if only the phase function is known.
        """
        return np.zeros((*np.shape(nu), np.size(wavelengths)))

    def polarising_moments(self, wavelengths: npt.ArrayLike) -> FloatArray:
        r"""Expansion coefficients of the phase matrix, shape (nl, 4). [1]

        .. math:: 2\pi \int F_{12}\, d^2_{02}(\theta)\, d\nu, \quad
                  \pi \int \left[(F_{22} + F_{33})\, d^2_{22}
                  \pm (F_{22} - F_{33})\, d^2_{2,-2}\right] d\nu, \quad
                  \pi \int (F_{22} + F_{33})\, d^5_{22}\, d\nu

        Hovenier, van der Mee & Domke (2004), Transfer of Polarized Light in Planetary Atmospheres,
        section 2.8: their β₁, α₂ and α₃ of degree 2, over 5, and their α₂ + α₃ of degree 5, over
        22. β₁ couples I to even moments of Q and U; α₂ couples even and α₃ odd moments. The last
        determines the truncated fraction of Q and U, see ``solver.moments.delta_m``.
        """
        return np.array(
            [polarising_moments_of(self.sampled(float(nm))) for nm in np.atleast_1d(wavelengths)]
        )

    @abstractmethod
    def sampled(self, wavelength: float) -> tuple[PhaseRow, ...]:
        """Sampling tables of scattering angles at a wavelength [nm]: one, or a mixture of two."""

    def moments(self, wavelengths: npt.ArrayLike, degree: int) -> FloatArray:
        """Legendre moments as ``optics.legendre`` defines them, shape (nl, degree + 1). [1]"""
        nm = np.atleast_1d(values_in(wavelengths, "nm", "wavelengths"))
        return legendre_moments(lambda nu: np.moveaxis(self.values(nu, nm), 0, -1), degree)

    def frozen(self, wavelengths: FloatArray) -> dict[str, Any]:
        """Table for a planet file that represents it at a few wavelengths by few numbers.

        By default a Henyey-Greenstein function of the same mean cosine.
        """
        mean = self.moments(wavelengths, 1)
        return {"kind": "henyey-greenstein", "asymmetry": written(mean[:, 1] / mean[:, 0])}


def polarising_moments_of(rows: tuple[PhaseRow, ...]) -> tuple[float, float, float, float]:
    """``PhaseFunction.polarising_moments`` at one wavelength, from tables. [1]"""
    beta_1, alpha_2, alpha_3, forward = 0.0, 0.0, 0.0, 0.0
    share = (np.arange(_STEPS_A_CELL) + 0.5) / _STEPS_A_CELL
    for row in rows:
        width = np.diff(np.radians(row.angles))[:, None]
        angle = (np.radians(row.angles[:-1, None]) + width * share).ravel()
        nu = np.cos(angle)
        rings = 2.0 * np.pi * np.repeat(width / _STEPS_A_CELL, _STEPS_A_CELL) * np.sin(angle)
        light = interpolated(row.angles, row.values[None], np.degrees(angle))[:, 0] * rings
        light = row.share * light / light.sum()
        turned, across = vectorized(unpolarising_ratio)(nu), np.zeros_like(nu)
        if row.ratios is not None:
            across, turned = (
                np.interp(np.degrees(angle), row.angles, one) for one in row.ratios[:2]
            )
        beta_1 += float(light @ (across * (np.sqrt(6.0) / 4.0) * (1.0 - nu**2)))
        ahead, behind = 0.5 * (1.0 + nu), 0.5 * (1.0 - nu)
        same, other = (1.0 + turned) * ahead**2, (1.0 - turned) * behind**2
        alpha_2 += float(light @ (same + other)) / 2.0
        alpha_3 += float(light @ (same - other)) / 2.0
        fifth = ahead**3 - behind * (21.0 * ahead**2 - behind * (63.0 * ahead - 35.0 * behind))
        forward += float(light @ (same * fifth)) / 2.0
    return beta_1, alpha_2, alpha_3, forward


class FormulaPhase(PhaseFunction):
    """Phase function by a formula of the cosine and of the fields, in order.

    Subclasses are frozen (``@parameters``), with a ``keyword``, a ``formula`` and fields declared
    by ``Field``, and are registered in ``PHASES``.

    Attributes
    ----------
    formula : callable
        ``@kernel`` of nu and the fields, as a ``staticmethod``. [sr⁻¹]
    """

    formula: ClassVar[Callable[..., float]]

    def _given(self) -> tuple[float | PerWavelength, ...]:
        return tuple(getattr(self, name) for name in fields_of(type(self)))

    def parameters_at(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Parameters of the formula, shape (np, nl). [1]"""
        return np.array([spectral_at(one, wavelengths) for one in self._given()])

    @property
    def limits(self) -> Limits:
        """Wavelength range. [nm]"""
        return spectral_limits(*self._given())

    def values(self, nu: npt.ArrayLike, wavelengths: npt.ArrayLike) -> FloatArray:
        """Phase function, shape of nu (...) and wavelengths (nl,) to (..., nl). [sr⁻¹]"""
        cosines = np.asarray(nu, dtype=np.float64)[..., None]
        formula: Any = vectorized(type(self).formula)
        return np.asarray(formula(cosines, *self.parameters_at(wavelengths)))

    def polarising_moments(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """See ``PhaseFunction``; computed once for wavelengths of equal parameters."""
        nm = np.atleast_1d(values_in(wavelengths, "nm", "wavelengths"))
        given = self.parameters_at(nm).reshape(-1, nm.size).T
        formula = type(self).formula
        return np.array([_formula_moments(formula, *row) for row in given.tolist()])

    def sampled(self, wavelength: float) -> tuple[PhaseRow, ...]:
        """Table of the formula, linear in the logarithm, with an error of 1e-5."""
        return _formula_rows(type(self).formula, *self.parameters_at([wavelength]).ravel())

    def frozen(self, wavelengths: FloatArray) -> dict[str, Any]:
        """Table of its own parameters at these wavelengths; see ``PhaseFunction.frozen``."""
        names = [key.name for key in fields_of(type(self)).values()]
        given = self.parameters_at(wavelengths)
        rows = {name: written(row) for name, row in zip(names, given, strict=True)}
        return {"kind": self.keyword, **rows}


def _formula_rows(formula: Any, *given: float) -> tuple[PhaseRow, ...]:
    """Table of a formula with the given parameters, see ``FormulaPhase.sampled``."""

    def at(angles: FloatArray) -> FloatArray:
        return np.asarray(vectorized(formula)(np.cos(np.radians(angles)), *given))

    angles = np.linspace(0.0, 180.0, _FIRST_ANGLES)
    for _ in range(_MOST_HALVINGS):
        between = 0.5 * (angles[:-1] + angles[1:])
        values, true = at(angles), at(between)
        straight = np.sqrt(values[:-1] * values[1:])
        coarse = np.abs(straight - true) > _TABLE_TOLERANCE * true
        if not coarse.any():
            break
        angles = np.sort(np.concatenate([angles, between[coarse]]))
    return (PhaseRow(1.0, angles, at(angles)),)


@lru_cache(maxsize=_CACHE_SIZE)
def _formula_moments(formula: Any, *given: float) -> tuple[float, float, float, float]:
    """``polarising_moments_of`` of a formula with the given parameters. [1]"""
    return polarising_moments_of(_formula_rows(formula, *given))


def written(values: FloatArray) -> Any:
    """Numbers for a planet file: a single one if all are equal, otherwise one per wavelength."""
    listed = [float(f"{value:.{_DIGITS}g}") for value in values]
    return listed[0] if len(set(listed)) == 1 else listed
