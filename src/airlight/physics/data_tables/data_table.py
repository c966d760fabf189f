"""Columns of numbers with names and units, found and converted by what they hold."""

from __future__ import annotations

import difflib
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ConflictError, FileError, ParameterError
from airlight.physics.data_tables.headings import Heading, conversion

FloatArray = NDArray[np.float64]

#: Cells without a value.
_MISSING_WORDS: Final = ("", "N/A", "NA", "-", "--", "*")


@dataclass(frozen=True, kw_only=True)
class Quantity:
    """What a column may hold.

    Attributes
    ----------
    name : str
        Name, in errors too.
    unit : str
        Unit of the numbers.
    names : tuple of str
        Other names of its columns, in lower case without signs.
    low, high : float
        Allowed range. [unit]
    above : bool
        Whether the lowest value is excluded.
    units : str
        Allowed units in errors.
    bare : bool
        Whether a column without a unit is in ``unit``; always where that is 1.
    """

    name: str
    unit: str
    names: tuple[str, ...] = ()
    low: float = -math.inf
    high: float = math.inf
    above: bool = False
    units: str = ""
    bare: bool = False

    def names_column(self, heading: Heading) -> bool:
        """Whether a column with this heading holds it."""
        return heading.key in (Heading(self.name).key, *self.names)


@dataclass(frozen=True, eq=False)
class DataColumn:
    """Column of a table.

    Attributes
    ----------
    heading : Heading
        Name, unit and wavelength.
    values : array, shape (n,) or more axes
        Numbers in the unit of the heading; not a number where a cell holds none.
    cells : sequence of str
        Texts of the cells of a text file; empty for arrays.
    dims : tuple of str
        Names of the axes of a labelled array.
    """

    heading: Heading
    values: FloatArray
    cells: Sequence[str] = ()
    dims: tuple[str, ...] = ()

    def missing(self, absent: Sequence[float] = ()) -> NDArray[np.bool_]:
        """Whether each cell is empty, or one of the numbers ``absent``."""
        found = np.isin(self.values, absent)
        if self.cells:
            found |= np.array([cell.strip() in _MISSING_WORDS for cell in self.cells], bool)
        return found


@dataclass(frozen=True, eq=False)
class DataTable:
    """Table with named columns.

    Attributes
    ----------
    source : str
        File, or kind of object, named in errors.
    columns : tuple of DataColumn
        Columns in the order of the table.
    lines : array, shape (n,)
        Line in the file of each row; empty for an object.
    head : int
        Line of the header.
    notes : mapping
        Texts of the comment lines ``# key: value``.
    layout : str
        Name of the layout of a text file.
    """

    source: str
    columns: tuple[DataColumn, ...]
    lines: NDArray[np.int64] = field(default_factory=lambda: np.empty(0, np.int64))
    head: int = 0
    notes: Mapping[str, str] = field(default_factory=dict)
    layout: str = ""

    def find(self, wanted: Quantity) -> DataColumn | None:
        """Column without a wavelength of its own that holds a quantity, or None."""
        found = [
            one
            for one in self.columns
            if wanted.names_column(one.heading) and math.isnan(one.heading.wavelength)
        ]
        if len(found) > 1:
            raise FileError(self.source, f"has the column {wanted.name} more than once")
        return found[0] if found else None

    def by_wavelength(self, wanted: Quantity) -> list[DataColumn]:
        """Columns of a quantity at wavelengths of their own."""
        return [
            one
            for one in self.columns
            if wanted.names_column(one.heading) and not math.isnan(one.heading.wavelength)
        ]

    def required(self, wanted: Quantity, suffix: str = "") -> DataColumn:
        """Column that holds a quantity; an error with the nearest name if there is none."""
        found = self.find(wanted)
        if found is None:
            texts = [one.heading.text or one.heading.name for one in self.columns]
            named = [re.split(r"\s*[\[(]", text)[0] for text in texts]
            near = difflib.get_close_matches(wanted.name, named, n=1, cutoff=0.6)
            hint = f" (did you mean {near[0]!r}?)" if near else ""
            raise FileError(self.source, f"has no column {wanted.name}{suffix} in its header{hint}")
        return found

    def check_lists(self, *wanted: Quantity) -> None:
        """Raise an error unless the columns of quantities are lists of one length."""
        columns = [one for one in map(self.find, wanted) if one is not None]
        for one in columns:
            if one.values.ndim != 1 or one.values.shape != columns[0].values.shape:
                allowed = f"a list as long as {columns[0].heading.name} (select a coordinate)"
                raise ParameterError(one.heading.name, one.values.shape, allowed, self.source)

    def numbers(self, wanted: Quantity, column: DataColumn | None = None) -> FloatArray:
        """Checked numbers of a column in the unit of the quantity. [unit]

        Parameters
        ----------
        wanted : Quantity
            What the column holds.
        column : DataColumn, optional
            Column; default: the one that is named for the quantity.
        """
        column = self.required(wanted) if column is None else column
        factor, offset = self.conversion(wanted, column)
        values = column.values * factor + offset
        bad = ~((values >= wanted.low) & (values <= wanted.high))
        if wanted.above:
            bad |= values == wanted.low
        if bad.any():
            self._reject(wanted, column, bad, values)
        return np.asarray(values, np.float64)

    def own_numbers(self, wanted: Quantity, column: DataColumn) -> FloatArray:
        """Checked numbers of a column in its own unit, whatever that is."""
        bare = replace(column, heading=replace(column.heading, unit=""))
        return self.numbers(replace(wanted, bare=True), bare)

    def conversion(self, wanted: Quantity, column: DataColumn) -> tuple[float, float]:
        """Factor and offset from the column's unit to that of the quantity."""
        unit = column.heading.unit
        if not unit and (wanted.bare or wanted.unit == "1"):
            return 1.0, 0.0
        name = f"unit of {column.heading.name}"
        units = wanted.units or wanted.unit
        if not unit:
            example = f"{column.heading.name} [{units.partition(',')[0]}]"
            allowed = f"{units}, in the header as in {example!r}, or given by units"
            raise ConflictError(self._at_head(name), f"is missing; allowed: {allowed}", self.source)
        try:
            return conversion(unit, wanted.unit, name)
        except ParameterError:
            allowed = f"a unit such as {units}"
            raise ParameterError(self._at_head(name), unit, allowed, self.source) from None

    def where(self, kept: NDArray[Any]) -> DataTable:
        """Table of some rows, by a mask or indices; arrays of other lengths stay."""
        at = np.flatnonzero(kept) if kept.dtype == bool else kept
        listed = [int(k) for k in at]
        rows = kept.size if kept.dtype == bool else 1 + max(listed, default=-1)

        def part(one: DataColumn) -> DataColumn:
            if not one.values.ndim or len(one.values) < rows:
                return one
            cells = [one.cells[k] for k in listed] if one.cells else ()
            return replace(one, values=one.values[at], cells=cells)

        columns = tuple(part(one) for one in self.columns)
        return replace(self, columns=columns, lines=self.lines[at] if self.lines.size else at)

    def with_units(self, units: Mapping[str, str]) -> DataTable:
        """Table with units of some columns replaced, by name."""
        keys = {Heading(name).key: (name, unit) for name, unit in units.items()}
        known = [one.heading.key for one in self.columns]
        for key, (name, _) in keys.items():
            if key not in known:
                shown = ", ".join(dict.fromkeys(one.heading.name for one in self.columns))
                raise ParameterError("units", name, f"columns of {self.source}: {shown}")
        columns = tuple(
            replace(one, heading=replace(one.heading, unit=keys[one.heading.key][1]))
            if one.heading.key in keys
            else one
            for one in self.columns
        )
        return replace(self, columns=columns)

    def place(self, row: int) -> str:
        """Line of a row, or its number for an object."""
        return f"line {self.lines[row]}" if self.lines.size else f"row {row}"

    def _at_head(self, name: str) -> str:
        return f"line {self.head}, {name}" if self.head else name

    def _reject(
        self, wanted: Quantity, column: DataColumn, bad: NDArray[np.bool_], values: FloatArray
    ) -> None:
        at = tuple(int(k) for k in np.argwhere(bad)[0])
        name = wanted.name
        if not math.isnan(column.heading.wavelength):
            name = f"{name} at {column.heading.wavelength:g} nm"
        elif column.heading.name != wanted.name:
            name = f"{name} ({column.heading.name})"
        shown: object = column.cells[at[0]].strip() if column.cells else float(column.values[at])
        least = f"more than {wanted.low:g}" if wanted.above else f"{wanted.low:g}"
        unit = "" if wanted.unit == "1" else f" {wanted.unit.removeprefix('1')}"
        if not math.isinf(wanted.high):
            allowed = f"{least} to {wanted.high:g}{unit}"
        else:
            allowed = "a finite number" if math.isinf(wanted.low) else f"{least}{unit} or more"
        if shown == "":
            shown = "an empty cell"
        elif self.conversion(wanted, column) != (1.0, 0.0):
            shown = f"{shown} {column.heading.unit}"
        where = self.place(at[0]) if len(at) == 1 else f"index {list(at)}"
        raise ParameterError(f"{where}, {name}", shown, allowed, self.source)


def number_of(cell: str) -> float:
    """Number of a cell; not a number if it holds none, nor for what is infinite."""
    try:
        value = float(cell)
    except ValueError:
        return math.nan
    return value if math.isfinite(value) else math.nan


def column_of(heading: Heading, cells: Sequence[str]) -> DataColumn:
    """Column of a text file."""
    try:
        values = np.array(cells, dtype=np.float64)
        values[~np.isfinite(values)] = math.nan
    except ValueError:
        values = np.array([number_of(cell) for cell in cells], dtype=np.float64)
    return DataColumn(heading, values, cells)
