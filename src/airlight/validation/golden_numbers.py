"""Golden numbers: published values from ``data/golden.toml``, for comparison.

The last printed digit gives the tolerance.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class GoldenRow:
    """Row of golden numbers.

    Attributes
    ----------
    label : str
        Description of the numbers.
    at : dict
        Inputs.
    printed : tuple of str
        Numbers as printed.
    allowed : array, shape (n,)
        Allowed difference of each, in the group's unit.
    """

    label: str
    at: Mapping[str, Any]
    printed: tuple[str, ...]
    allowed: FloatArray

    @property
    def expected(self) -> FloatArray:
        """Numbers as floats, shape (n,)."""
        return np.array([float(text) for text in self.printed])


@dataclass(frozen=True)
class Group:
    """Table of golden numbers.

    Attributes
    ----------
    name, title : str
        Identifier for programs, and heading for readers.
    source : str
        Authority for the numbers.
    unit : str
        Unit of all its numbers.
    columns : tuple of str
        Quantities of the numbers in a row.
    reason : str
        Reason for the size of the allowed differences.
    rows : tuple of GoldenRow
    """

    name: str
    title: str
    source: str
    unit: str
    columns: tuple[str, ...]
    reason: str
    rows: tuple[GoldenRow, ...]


@dataclass(frozen=True)
class GoldenComparison:
    """Golden number and the value computed for it.

    Attributes
    ----------
    label, column : str
        Row and column of the number.
    printed : str
        Number as printed.
    got, difference, allowed : float
        Computed value, its difference from the printed number and the allowed difference, in the
        group's unit.
    """

    label: str
    column: str
    printed: str
    got: float
    difference: float
    allowed: float

    @property
    def passed(self) -> bool:
        """Whether the difference is allowed; NaN is not."""
        return bool(abs(self.difference) <= self.allowed)

    @property
    def used(self) -> float:
        """Difference over the allowed difference; 0 if there is no difference. [1]"""
        if self.difference == 0.0:
            return 0.0
        return abs(self.difference) / self.allowed if self.allowed > 0.0 else float("inf")


def last_digit(printed: str) -> float:
    """Unit of the last digit of a printed number; 0 for a plain 0, which is exact.

    Examples
    --------
    >>> last_digit("5.185366e-3"), last_digit("213"), last_digit(".0625")
    (1e-09, 1.0, 0.0001)
    """
    if printed == "0":
        return 0.0
    mantissa, _, exponent = printed.lower().partition("e")
    decimals = len(mantissa.partition(".")[2])
    return float(10.0 ** (int(exponent or 0) - decimals))


@cache
def golden_groups() -> tuple[Group, ...]:
    """Golden numbers of the package, in the order of the file."""
    text = files("airlight.validation").joinpath("data/golden.toml").read_text(encoding="utf-8")
    groups: dict[str, Group] = {}
    for table in tomllib.loads(text)["group"]:
        rows = table.get("row")
        if rows is None:
            rows = _summed([groups[name] for name in table["sum_of"]])
        groups[table["name"]] = Group(
            name=table["name"],
            title=table["title"],
            source=table["source"],
            unit=table["unit"],
            columns=tuple(table["columns"]),
            reason=table["reason"],
            rows=tuple(_row(table, row) for row in rows),
        )
    return tuple(groups.values())


def _row(table: Mapping[str, Any], row: Mapping[str, Any]) -> GoldenRow:
    printed = tuple(row["expected"])
    relative = row.get("relative", table.get("relative", 0.0))
    absolute = row.get("absolute", table.get("absolute", 0.0))
    digits = row.get("digits", table.get("digits", 0.0))
    allowed = [
        # Half a digit is rounding; a hundredth more allows for rounding in the comparison.
        max(1.01 * digits * last_digit(text), relative * abs(float(text)), absolute)
        for text in printed
    ]
    return GoldenRow(row["label"], row.get("at", {}), printed, np.array(allowed))


def _summed(parts: Sequence[Group]) -> list[dict[str, Any]]:
    return [
        {
            "label": rows[0].label,
            "at": rows[0].at,
            "expected": [f"{value:.6e}" for value in sum(row.expected for row in rows)],
        }
        for rows in zip(*(part.rows for part in parts), strict=True)
    ]


def compare(
    group: Group, got: Sequence[FloatArray], *, single: bool = False
) -> list[GoldenComparison]:
    """Compare computed values with a group of golden numbers.

    Parameters
    ----------
    got : sequence of array, shape (n,)
        Values of each row, in the order of the group.
    single : bool
        Whether both are rounded to float32 before the comparison.
    """
    compared = []
    for row, values in zip(group.rows, got, strict=True):
        for column, text, allowed, value in zip(
            group.columns, row.printed, row.allowed, np.ravel(values), strict=True
        ):
            if single:
                difference = float(np.float32(value)) - float(np.float32(text))
            else:
                difference = float(value) - float(text)
            compared.append(
                GoldenComparison(row.label, column, text, float(value), difference, float(allowed))
            )
    return compared
