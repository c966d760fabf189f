"""Phase function from a table of scattering angles."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cached_property, partial
from typing import Annotated, Any, Final

import numpy as np
import numpy.typing as npt
from pydantic import BeforeValidator

from airlight.errors import ParameterError
from airlight.kernel import vectorized
from airlight.physics.optics.phase_matrix import unpolarising_ratio
from airlight.physics.optics.phase_table import interpolated, moments
from airlight.physics.units import values_in
from airlight.planets.matter.phases.phase_function import (
    INTEGRAL_TOLERANCE,
    PhaseFunction,
    PhaseRow,
)
from airlight.planets.parameters import all_between, ascending, numbers, parameters
from airlight.planets.schema.field import Field, Wavelengths, key
from airlight.planets.schema.toml_table import TomlTable, quantity_list
from airlight.planets.spectral import (
    EVERYWHERE,
    LONGEST,
    SHORTEST,
    Limits,
    PerWavelength,
    check_wavelength_list,
)

FloatArray = npt.NDArray[np.float64]

#: Largest excess of f12² + f33² + f34² over 1, for values rounded in a file. [1]
_ROUNDING: Final = 1e-3


def _rows(name: str, low: float, high: float, unit: str = "") -> BeforeValidator:
    """Validator of rows of numbers in a range."""

    def rows(value: Any) -> tuple[tuple[float, ...], ...]:
        if isinstance(value, np.ndarray):
            value = value.tolist()
        if not isinstance(value, (list, tuple)):
            raise ParameterError(name, value, "a list of lists of numbers")
        return tuple(numbers(row, f"{name}[{i}]", low, high, unit) for i, row in enumerate(value))

    return BeforeValidator(rows)


def _read_rows(
    unit: str, allowed: str, table: TomlTable, name: str, wavelengths: Wavelengths
) -> tuple[tuple[float, ...], ...]:
    """Read one list, or one for each wavelength. [unit]"""
    values = table.required(name, allowed)
    field = table.name_of(name)
    if isinstance(values, list) and values and all(isinstance(row, list) for row in values):
        if wavelengths is None:
            raise ParameterError(field, len(values), "one list, or wavelengths for the lists")
        return tuple(
            quantity_list(row, unit, f"{field}[{i}]", bare=True) for i, row in enumerate(values)
        )
    return (quantity_list(values, unit, field, bare=True),)


#: Ratio of elements of the phase matrix.
_RATIO: Final = Field(
    label="F₁₂/F₁₁",
    help="Element F₁₂ of the phase matrix over the phase function: minus the degree to which it"
    " polarises.",
    note="Rows like `values`, -1 to 1; negative where light swings across the scattering plane."
    " Nothing is polarised without it.",
    read=partial(_read_rows, "1", "a list of numbers, or one list per wavelength"),
    slider=(-1.0, 1.0),
    input_range=(-1.0, 1.0),
    per="angles",
    per_unit="deg",
)


@parameters
class TabulatedPhase(PhaseFunction):
    """Phase function from a table; between angles its logarithm is linear in the angle.

    Parameters
    ----------
    angles : tuple of float
        Scattering angles, ascending from 0 to 180. [deg]
    rows : tuple of tuple of float
        Values at ``angles``, one row per wavelength or a single row. [sr⁻¹]
    wavelengths : tuple of float
        Wavelengths of the rows, with linear interpolation; empty for a single row. [nm]
    f12, f33, f34 : tuple of tuple of float, optional
        Elements of the phase matrix over the phase function, like ``rows``; linear between angles.
        Default: F₃₃ of Rayleigh scattering, as far as F₁₂ permits, and F₃₄ = 0. [1]

    Raises
    ------
    ParameterError
        If a row does not integrate to 1 within 0.001, or a degree of polarisation exceeds 1.
    """

    keyword = "tabulated"
    mode = "advanced"

    angles: tuple[float, ...] = key(
        label="angle",
        help="Scattering angles of the rows, in increasing order.",
        note="From 0 to 180 deg.",
        unit="deg",
        range=(0.0, 180.0),
        example="0, 90, 180 deg",
        initial=["0 deg", "90 deg", "180 deg"],
    )
    rows: Annotated[tuple[tuple[float, ...], ...], _rows("values", 0.0, 1e12, "/sr")] = key(
        name="values",
        label="phase function",
        help="Values at these angles; the integral over the sphere is 1.",
        note="One list, or one list per wavelength, in /sr where no unit is given. Linear in"
        " the logarithm between angles. A table whose integral is off 1 by more than 0.001 is"
        " refused; the error names the integral to divide by.",
        unit="1/sr",
        read=partial(_read_rows, "1/sr", "a list of numbers in /sr, or one list per wavelength"),
        shown="/sr",
        slider=(1e-4, 1e3),
        input_range=(0.0, 1e9),
        scale="log",
        per="angles",
        per_unit="deg",
    )
    wavelengths: Annotated[tuple[float, ...], all_between(SHORTEST, LONGEST, "nm")] = ()
    f12: Annotated[tuple[tuple[float, ...], ...], _rows("f12", -1.0, 1.0)] = key(_RATIO, default=())
    f33: Annotated[tuple[tuple[float, ...], ...], _rows("f33", -1.0, 1.0)] = key(
        _RATIO,
        label="F₃₃/F₁₁",
        help="Element F₃₃ over the phase function.",
        note="By default that of Rayleigh's law, as far as `f12` leaves room.",
        default=(),
    )
    f34: Annotated[tuple[tuple[float, ...], ...], _rows("f34", -1.0, 1.0)] = key(
        _RATIO,
        label="F₃₄/F₁₁",
        help="Element F₃₄ over the phase function.",
        note="0 by default.",
        default=(),
    )

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
        self._check_matrix(rows)
        integrals = self._row_moments(0)[:, 0]
        for index in range(rows):
            if not abs(integrals[index] - 1.0) <= INTEGRAL_TOLERANCE:
                raise ParameterError(
                    f"integral of values[{index}]",
                    float(integrals[index]),
                    f"1 within {INTEGRAL_TOLERANCE:g}: divide the values by it",
                )

    def _check_matrix(self, rows: int) -> None:
        for name in ("f12", "f33", "f34"):
            given: tuple[tuple[float, ...], ...] = getattr(self, name)
            if given and len(given) != rows:
                raise ParameterError(name, len(given), f"{rows} rows, one per row of values")
            for index, row in enumerate(given):
                if len(row) != len(self.angles):
                    allowed = f"as many numbers as angles, {len(self.angles)}"
                    raise ParameterError(f"{name}[{index}]", len(row), allowed)
        if self.ratios is not None:
            most = float(np.square(self.ratios).sum(axis=1).max())
            if most > 1.0 + _ROUNDING:
                raise ParameterError("f12² + f33² + f34²", most, "at most 1 at every angle")

    @cached_property
    def ratios(self) -> FloatArray | None:
        """F₁₂, F₃₃ and F₃₄ over the phase function, (nr, 3, na); None if none is given. [1]"""
        if not (self.f12 or self.f33 or self.f34):
            return None
        shape = max(1, len(self.wavelengths)), len(self.angles)
        f12, f34 = (np.array(one) if one else np.zeros(shape) for one in (self.f12, self.f34))
        if self.f33:
            f33 = np.array(self.f33)
        else:
            law = vectorized(unpolarising_ratio)(np.cos(np.radians(self.angles)))
            room = np.sqrt(np.maximum(1.0 - f12**2 - f34**2, 0.0))
            f33 = np.clip(law, -room, room)
        return np.stack([f12, f33, f34], axis=1)

    @classmethod
    def read_values(
        cls, table: TomlTable, wavelengths: Wavelengths = None, **known: Any
    ) -> dict[str, Any]:
        """Values of the fields; the wavelengths of the constituent if there is a row for each."""
        values = super().read_values(table, wavelengths, **known)
        given = table.raw("values")
        if isinstance(given, list) and given and isinstance(given[0], list):
            values["wavelengths"] = wavelengths
        return values

    @cached_property
    def _table(self) -> tuple[FloatArray, FloatArray]:
        return np.array(self.angles), np.array(self.rows)

    @property
    def limits(self) -> Limits:
        """Wavelength range. [nm]"""
        if not self.wavelengths:
            return EVERYWHERE
        return PerWavelength(wavelengths=self.wavelengths, values=self.wavelengths).limits

    def values(self, nu: npt.ArrayLike, wavelengths: npt.ArrayLike) -> FloatArray:
        """Phase function, shape of nu (...) and wavelengths (nl,) to (..., nl). [sr⁻¹]"""
        angle = np.degrees(np.arccos(np.clip(nu, -1.0, 1.0)))
        return np.asarray(interpolated(*self._table, angle) @ self._weights(wavelengths))

    def phase_f12(self, nu: npt.ArrayLike, wavelengths: npt.ArrayLike) -> FloatArray:
        """Element F₁₂ of the phase matrix, shape of nu (...) and (nl,) to (..., nl). [sr⁻¹]"""
        if self.ratios is None:
            return super().phase_f12(nu, wavelengths)
        angle = np.degrees(np.arccos(np.clip(nu, -1.0, 1.0)))
        across = np.stack([np.interp(angle, self.angles, one[0]) for one in self.ratios], axis=-1)
        return np.asarray((interpolated(*self._table, angle) * across) @ self._weights(wavelengths))

    def moments(self, wavelengths: npt.ArrayLike, degree: int) -> FloatArray:
        """Legendre moments as ``physics.optics.legendre`` defines them, shape (nl, degree + 1). [1]

        Integrated between the table's angles, without aliasing.
        """
        return np.asarray(self._weights(wavelengths).T @ self._row_moments(degree))

    def _row_moments(self, degree: int) -> FloatArray:
        """Legendre moments of each row, shape (nr, degree + 1), cached. [1]"""
        if degree not in self._kept_moments:
            self._kept_moments[degree] = moments(*self._table, degree)
        return self._kept_moments[degree]

    @cached_property
    def _kept_moments(self) -> dict[int, FloatArray]:
        return {}

    def sampled(self, wavelength: float) -> tuple[PhaseRow, ...]:
        """Rows for interpolation to a wavelength [nm], one or two."""
        shares = self._weights([wavelength])[:, 0]
        angles, rows = self._table
        ratios = [None] * len(rows) if self.ratios is None else self.ratios
        return tuple(
            PhaseRow(float(shares[i]), angles, rows[i], ratios[i]) for i in np.flatnonzero(shares)
        )

    def _weights(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Weight of each row at each wavelength, shape (nr, nl). [1]"""
        nm = values_in(wavelengths, "nm", "wavelengths")
        weights = np.ones((1, len(nm)))
        if self.wavelengths:
            order = np.argsort(self.wavelengths)
            known = np.asarray(self.wavelengths)[order]
            weights = np.empty((len(known), len(nm)))
            for position, unit_row in zip(order, np.eye(len(known)), strict=True):
                weights[position] = np.interp(nm, known, unit_row)
        return weights

    @classmethod
    def default_table(cls, old: Mapping[str, Any], thickness: float) -> dict[str, Any]:
        """Table of isotropic scattering; see ``TomlModel.default_table``."""
        even = float(f"{0.25 / math.pi:.10g}")
        return {**super().default_table(old, thickness), "values": [even, even, even]}
