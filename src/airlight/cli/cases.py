"""Many observers in one CSV file: read with every cell checked, written with the results added."""

from __future__ import annotations

import contextlib
import csv
import math
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TextIO

import numpy as np
from numpy.typing import NDArray

from airlight.errors import FileError, ParameterError
from airlight.exports.whole_file import whole_file

#: Columns that are read, with the smallest and largest number allowed in them.
COLUMNS: dict[str, tuple[float, float]] = {
    "altitude_m": (0.0, 1e12),
    "sun_zenith_deg": (0.0, 180.0),
    "view_zenith_deg": (0.0, 180.0),
    "azimuth_deg": (-360.0, 360.0),
}


@dataclass(frozen=True, kw_only=True)
class Cases:
    """Table of observers.

    Parameters
    ----------
    comments : list of str
        Lines that begin with ``#`` above the header.
    header : list of str
        Names of all columns of the file.
    rows : list of list of str
        Cells as they are in the file.
    values : array, shape (n, 4)
        Numbers under ``COLUMNS``. [m, deg, deg, deg]
    """

    comments: list[str]
    header: list[str]
    rows: list[list[str]]
    values: NDArray[np.float64]


def read_cases(path: str) -> Cases:
    """Read observers from a CSV file.

    Parameters
    ----------
    path : str
        Path of a file in UTF-8 with a header; ``-`` is the standard input.

    Returns
    -------
    Cases
        Table in the file's order; empty lines are left out.

    Raises
    ------
    FileError
        If the file cannot be read, or lacks a header or a column.
    ParameterError
        For the first cell that is not a number in its range, with line and column.
    """
    name = "standard input" if path == "-" else path
    try:
        with _opened(path) as stream:
            return _parse(stream, name)
    except UnicodeDecodeError as error:
        raise FileError(name, "is no text in UTF-8") from error
    except (OSError, csv.Error) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise FileError(name, f"cannot be read: {reason}") from error


@contextlib.contextmanager
def _opened(path: str) -> Iterator[TextIO]:
    if path == "-":
        yield sys.stdin
        return
    with Path(path).open(encoding="utf-8-sig", newline="") as stream:
        yield stream


def _parse(stream: Iterable[str], name: str) -> Cases:
    lines = _without_nulls(stream, name)
    comments: list[str] = []
    first = ""
    for first in lines:
        if not first.startswith("#"):
            break
        comments.append(first.rstrip("\r\n"))
        first = ""
    header = [cell.strip() for cell in next(csv.reader([first]), [])]
    missing = [column for column in COLUMNS if column not in header]
    if missing:
        raise FileError(name, f"has no column {', '.join(missing)} in its header")
    positions = []
    for column in COLUMNS:
        if header.count(column) > 1:
            raise FileError(name, f"has the column {column} more than once")
        positions.append(header.index(column))
    rows: list[list[str]] = []
    values: list[list[float]] = []
    reader = csv.reader(lines)
    for row in reader:
        line = reader.line_num + len(comments) + 1
        if not any(cell.strip() for cell in row):
            continue
        if len(row) != len(header):
            found = f"{len(row)} cells"
            raise ParameterError(f"line {line}", found, f"{len(header)}, as in the header", name)
        values.append(
            [
                _number(row[position], line, column, limits, name)
                for position, (column, limits) in zip(positions, COLUMNS.items(), strict=True)
            ]
        )
        rows.append(row)
    table = np.array(values, dtype=np.float64).reshape(-1, len(COLUMNS))
    return Cases(comments=comments, header=header, rows=rows, values=table)


def _without_nulls(stream: Iterable[str], name: str) -> Iterator[str]:
    for line in stream:
        if "\0" in line:
            raise FileError(name, "is no text")
        yield line


def _number(cell: str, line: int, column: str, limits: tuple[float, float], name: str) -> float:
    low, high = limits
    try:
        value = float(cell)
    except ValueError:
        value = math.nan
    if not low <= value <= high:
        raise ParameterError(f"line {line}, {column}", cell, f"{low:g} to {high:g}", name)
    return value


def radiance_columns(wavelengths: Sequence[float]) -> list[str]:
    """Names of the columns of radiances.

    Examples
    --------
    >>> radiance_columns([680.0, 550.5])
    ['radiance_680nm', 'radiance_550.5nm']
    """
    return [f"radiance_{nm:.10g}nm" for nm in wavelengths]


def error_columns(wavelengths: Sequence[float]) -> list[str]:
    """Names of the columns of standard errors.

    Examples
    --------
    >>> error_columns([680.0])
    ['standard_error_680nm']
    """
    return [f"standard_error_{nm:.10g}nm" for nm in wavelengths]


def write_cases(
    path: str,
    cases: Cases,
    wavelengths: Sequence[float],
    radiance: NDArray[np.float64],
    standard_error: NDArray[np.float64] | None = None,
) -> None:
    """Write the table with the radiances appended.

    Parameters
    ----------
    path : str
        Path of the file, which appears whole or not at all; ``-`` is the standard output.
    cases : Cases
        Table, written as it was read.
    wavelengths : sequence of float
        Wavelengths of the radiances. [nm]
    radiance : array, shape (n, wavelengths)
        Radiances, written with nine digits. [W m⁻² sr⁻¹ nm⁻¹]
    standard_error : array, shape (n, wavelengths), optional
        Standard errors, written with two digits in columns after the radiances. [W m⁻² sr⁻¹ nm⁻¹]

    Raises
    ------
    FileError
        If the file cannot be written; an existing file is then unchanged.
    """
    if path == "-":
        _write(sys.stdout, cases, wavelengths, radiance, standard_error)
        return
    with (
        whole_file(path) as part,
        part.open("w", encoding="utf-8", newline="") as stream,
    ):
        _write(stream, cases, wavelengths, radiance, standard_error)


def _write(
    stream: TextIO,
    cases: Cases,
    wavelengths: Sequence[float],
    radiance: NDArray[np.float64],
    standard_error: NDArray[np.float64] | None,
) -> None:
    stream.writelines(f"{comment}\n" for comment in cases.comments)
    writer = csv.writer(stream, lineterminator="\n")
    columns = radiance_columns(wavelengths)
    answers = [[f"{value:.8e}" for value in row] for row in radiance]
    if standard_error is not None:
        columns += error_columns(wavelengths)
        for row, errors in zip(answers, standard_error, strict=True):
            row += [f"{value:.1e}" for value in errors]
    writer.writerow([*cases.header, *columns])
    for cells, answer in zip(cases.rows, answers, strict=True):
        writer.writerow([*cells, *answer])
