"""Phase function from a table of scattering angles."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cached_property
from typing import Annotated, Any

import numpy as np
import numpy.typing as npt
from pydantic import BeforeValidator

from airlight.errors import ParameterError
from airlight.optics.phase_table import interpolated, moments
from airlight.planets.matter.phases.phase_function import (
    INTEGRAL_TOLERANCE,
    PhaseFunction,
    PhaseRow,
)
from airlight.planets.parameters import all_between, ascending, numbers, parameters
from airlight.planets.schema.key import Key, Wavelengths
from airlight.planets.schema.section import Section, quantity_list
from airlight.planets.spectral import (
    EVERYWHERE,
    LONGEST,
    SHORTEST,
    Limits,
    PerWavelength,
    check_wavelength_list,
)

FloatArray = npt.NDArray[np.float64]


def _rows(value: Any) -> tuple[tuple[float, ...], ...]:
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if not isinstance(value, (list, tuple)):
        raise ParameterError("values", value, "a list of lists of numbers")
    return tuple(numbers(row, f"values[{i}]", 0.0, 1e12, "/sr") for i, row in enumerate(value))


def _matrices(value: Any) -> tuple[tuple[tuple[float, ...], ...], ...]:
    if not isinstance(value, (list, tuple)) or not all(
        isinstance(row, (list, tuple)) for row in value
    ):
        raise ParameterError("ratios", value, "for each row three lists of numbers")
    return tuple(
        tuple(numbers(one, f"ratios[{i}][{k}]", -1.0, 1.0) for k, one in enumerate(row))
        for i, row in enumerate(value)
    )


def _values(section: Section, name: str, wavelengths: Wavelengths) -> tuple[tuple[float, ...], ...]:
    """Read one list, or one for each wavelength. [sr⁻¹]"""
    values = section.required(name, "a list of numbers in /sr, or one list per wavelength")
    field = section.name_of(name)
    if isinstance(values, list) and values and all(isinstance(row, list) for row in values):
        if wavelengths is None:
            raise ParameterError(field, len(values), "one list, or wavelengths for the lists")
        return tuple(quantity_list(row, "1/sr", f"{field}[{i}]") for i, row in enumerate(values))
    return (quantity_list(values, "1/sr", field),)


@parameters
class TabulatedPhase(PhaseFunction):
    """A phase function from a table; between angles its logarithm is linear in the angle.

    Parameters
    ----------
    angles : tuple of float
        Scattering angles, ascending from 0 to 180. [deg]
    rows : tuple of tuple of float
        One row of values per wavelength, each as long as ``angles``; a single row serves every
        wavelength. [sr⁻¹]
    wavelengths : tuple of float
        Wavelengths, one per row; empty for a single row. Linear between them. [nm]
    ratios : tuple, optional
        For each row F₁₂, F₃₃ and F₃₄ of the phase matrix over the phase function, each as long as
        ``angles``, -1 to 1; linear between angles. [1]

    Raises
    ------
    ParameterError
        If a row does not integrate to 1 within 0.001: the error shows its integral.
    """

    keyword = "tabulated"

    angles: Annotated[
        tuple[float, ...],
        Key(
            label="angle",
            help="Scattering angles of the rows, in increasing order.",
            note="From 0 to 180 deg.",
            unit="deg",
            range=(0.0, 180.0),
            listed=True,
            example="0, 90, 180 deg",
            mode="advanced",
            fresh=["0 deg", "90 deg", "180 deg"],
        ),
    ]
    rows: Annotated[
        tuple[tuple[float, ...], ...],
        BeforeValidator(_rows),
        Key(
            name="values",
            label="phase function",
            help="Values at these angles; the integral over the sphere is 1.",
            note="One list, or one list per wavelength. Linear in the logarithm between angles. A"
            " table whose integral is off 1 by more than 0.001 is refused; the error names the"
            " integral to divide by.",
            unit="1/sr",
            read=_values,
            shown="/sr",
            slider=(1e-4, 1e3),
            typed=(0.0, 1e9),
            scale="log",
            per="angles",
            per_unit="deg",
            mode="advanced",
        ),
    ]
    wavelengths: Annotated[tuple[float, ...], all_between(SHORTEST, LONGEST, "nm")] = ()
    ratios: Annotated[tuple[tuple[tuple[float, ...], ...], ...], BeforeValidator(_matrices)] = ()

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
        sizes = {(len(row), *{len(one) for one in row}) for row in self.ratios}
        if self.ratios and (len(self.ratios) != rows or sizes != {(3, len(self.angles))}):
            raise ParameterError(
                "ratios", len(self.ratios), f"F12, F33 and F34 at {len(self.angles)} angles a row"
            )
        integrals = self._row_moments(0)[:, 0]
        for index in range(rows):
            if not abs(integrals[index] - 1.0) <= INTEGRAL_TOLERANCE:
                raise ParameterError(
                    f"integral of values[{index}]",
                    float(integrals[index]),
                    f"1 within {INTEGRAL_TOLERANCE:g}: divide the values by it",
                )

    @classmethod
    def read_values(cls, section: Section, wavelengths: Wavelengths = None) -> dict[str, Any]:
        """Angles and rows; the wavelengths of the constituent if there is a row for each."""
        values = super().read_values(section, wavelengths)
        given = section.raw("values")
        if isinstance(given, list) and given and isinstance(given[0], list):
            values["wavelengths"] = wavelengths
        return values

    @cached_property
    def _table(self) -> tuple[FloatArray, FloatArray]:
        return np.array(self.angles), np.array(self.rows)

    @property
    def limits(self) -> Limits:
        """Wavelengths at which it is known. [nm]"""
        if not self.wavelengths:
            return EVERYWHERE
        return PerWavelength(wavelengths=self.wavelengths, values=self.wavelengths).limits

    def values(self, nu: npt.ArrayLike, wavelengths: npt.ArrayLike) -> FloatArray:
        """Phase function, shape of nu (...) and wavelengths (nl,) to (..., nl). [sr⁻¹]"""
        angle = np.degrees(np.arccos(np.clip(nu, -1.0, 1.0)))
        return np.asarray(interpolated(*self._table, angle) @ self._weights(wavelengths))

    def polarising(self, nu: npt.ArrayLike, wavelengths: npt.ArrayLike) -> FloatArray:
        """Element F₁₂ of the phase matrix, shape of nu (...) and (nl,) to (..., nl). [sr⁻¹]"""
        if not self.ratios:
            return super().polarising(nu, wavelengths)
        angle = np.degrees(np.arccos(np.clip(nu, -1.0, 1.0)))
        across = np.stack([np.interp(angle, self.angles, one[0]) for one in self.ratios], axis=-1)
        return np.asarray((interpolated(*self._table, angle) * across) @ self._weights(wavelengths))

    def moments(self, wavelengths: npt.ArrayLike, degree: int) -> FloatArray:
        """Legendre moments as ``optics.legendre`` defines them, shape (nl, degree + 1). [1]

        Integrated between the table's own angles, so that no ripple lies between the nodes.
        """
        return np.asarray(self._weights(wavelengths).T @ self._row_moments(degree))

    def _row_moments(self, degree: int) -> FloatArray:
        """Legendre moments of each row, shape (nr, degree + 1), kept: they take long. [1]"""
        if degree not in self._kept_moments:
            self._kept_moments[degree] = moments(*self._table, degree)
        return self._kept_moments[degree]

    @cached_property
    def _kept_moments(self) -> dict[int, FloatArray]:
        return {}

    def sampled(self, wavelength: float) -> tuple[PhaseRow, ...]:
        """Rows between which a wavelength [nm] lies, one or two."""
        shares = self._weights([wavelength])[:, 0]
        angles, rows = self._table
        ratios: list[FloatArray | None] = [np.array(one) for one in self.ratios]
        ratios = ratios or [None] * len(rows)
        return tuple(
            PhaseRow(float(shares[i]), angles, rows[i], ratios[i]) for i in np.flatnonzero(shares)
        )

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

    @classmethod
    def fresh(cls, old: Mapping[str, Any], thickness: float) -> dict[str, Any]:
        """Table of isotropic scattering; see ``Record.fresh``."""
        even = float(f"{0.25 / math.pi:.10g}")
        return {**super().fresh(old, thickness), "values": [even, even, even]}
