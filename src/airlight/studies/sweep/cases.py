"""CSV files of observers: validated input, and output with the results appended."""

from __future__ import annotations

import contextlib
import csv
import math
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final, TextIO

import numpy as np
from numpy.typing import NDArray

from airlight.errors import FileError, ParameterError
from airlight.files.atomic_file import atomic_file, check_target
from airlight.files.input_files import LARGEST_CASES, check_input
from airlight.solver.stokes_frame import STOKES
from airlight.studies.sweep.grid import AXES

#: Columns that are read, with the range of allowed numbers.
COLUMNS: Final = {f"{name}_{unit}": (low, high) for name, (low, high, unit) in AXES.items()}

#: Suffixes of tables that are written.
SUFFIXES: Final = (".csv", ".nc")


@dataclass(frozen=True, kw_only=True)
class Cases:
    """Table of observers.

    Parameters
    ----------
    comments : list of str
        Comment lines above the header.
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


def check_table(path: str, suffixes: Sequence[str] = SUFFIXES) -> None:
    """Raise an error, before the computation, if an output table cannot be written.

    Parameters
    ----------
    path : str
        Path of the output; ``-`` is the standard output.
    suffixes : sequence of str
        Suffixes of the formats that can be written.

    Raises
    ------
    FileError
        If it is none of these, or as for ``check_target``.
    """
    if path == "-":
        return
    if Path(path).suffix.lower() not in suffixes:
        raise FileError(path, f"the name of a table ends in {' or '.join(suffixes)}")
    check_target(path)


def read_cases(path: str) -> Cases:
    """Read observers from a CSV file.

    Parameters
    ----------
    path : str
        Path of a file in UTF-8 with a header; ``-`` is the standard input.

    Returns
    -------
    Cases
        Table in the file's order, without empty lines.
    """
    with case_blocks(path, None) as (head, blocks):
        some = list(blocks)
    rows = [row for one in some for row in one.rows]
    values = np.concatenate([one.values for one in some]) if some else head.values
    return Cases(comments=head.comments, header=head.header, rows=rows, values=values)


@contextlib.contextmanager
def case_blocks(path: str, size: int | None) -> Iterator[tuple[Cases, Iterator[Cases]]]:
    """Read observers from a CSV file block by block, in bounded memory.

    Parameters
    ----------
    path : str
        Path as for ``read_cases``.
    size : int, optional
        Number of rows in a block; default: all.

    Yields
    ------
    (Cases, iterator of Cases)
        Comments and header, and an iterator of blocks.
    """
    name = "standard input" if path == "-" else path
    with contextlib.ExitStack() as stack:
        with _explained(name):
            lines = _without_nulls(stack.enter_context(_opened(path)), name)
            head, positions = _head(lines, name)
        yield head, _guarded(_rows(lines, head, positions, name, size), name)


def _guarded(blocks: Iterator[Cases], name: str) -> Iterator[Cases]:
    """Blocks, with reading errors as ``FileError``."""
    while True:
        with _explained(name):
            block = next(blocks, None)
        if block is None:
            return
        yield block


@contextlib.contextmanager
def _explained(name: str) -> Iterator[None]:
    try:
        yield
    except UnicodeDecodeError as error:
        raise FileError(name, "is not UTF-8 text") from error
    except (OSError, csv.Error) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise FileError(name, f"cannot be read: {reason}") from error


@contextlib.contextmanager
def _opened(path: str) -> Iterator[TextIO]:
    if path == "-":
        yield sys.stdin
        return
    check_input(path, LARGEST_CASES)  # a pipe without a writer would not even open
    with Path(path).open(encoding="utf-8-sig", newline="") as stream:
        yield stream


def _head(lines: Iterator[str], name: str) -> tuple[Cases, list[int]]:
    """Comments and header, and the positions of ``COLUMNS``."""
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
    empty = np.empty((0, len(COLUMNS)))
    return Cases(comments=comments, header=header, rows=[], values=empty), positions


def _rows(
    lines: Iterator[str], head: Cases, positions: list[int], name: str, size: int | None
) -> Iterator[Cases]:
    rows: list[list[str]] = []
    values: list[list[float]] = []

    def block() -> Cases:
        table = np.array(values, dtype=np.float64).reshape(-1, len(COLUMNS))
        return Cases(comments=head.comments, header=head.header, rows=list(rows), values=table)

    reader = csv.reader(lines)
    for row in reader:
        line = reader.line_num + len(head.comments) + 1
        if not any(cell.strip() for cell in row):
            continue
        if len(row) != len(head.header):
            found, allowed = f"{len(row)} cells", f"{len(head.header)}, as in the header"
            raise ParameterError(f"line {line}", found, allowed, name)
        values.append(
            [
                _number(row[position], line, column, limits, name)
                for position, (column, limits) in zip(positions, COLUMNS.items(), strict=True)
            ]
        )
        rows.append(row)
        if size is not None and len(rows) == size:
            yield block()
            rows, values = [], []
    if rows:
        yield block()


def _without_nulls(stream: TextIO, name: str) -> Iterator[str]:
    for line in stream:
        if "\0" in line:
            raise FileError(name, "is not text")
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


def radiance_columns(wavelengths: Sequence[float], *, stokes: bool = False) -> list[str]:
    """Names of the columns of radiances.

    Parameters
    ----------
    wavelengths : sequence of float
        Wavelengths. [nm]
    stokes : bool
        Whether the columns are I, Q and U, degree and angle of polarisation.

    Examples
    --------
    >>> radiance_columns([680.0, 550.5])
    ['radiance_680nm', 'radiance_550.5nm']
    >>> radiance_columns([680.0], stokes=True)
    ['I_680nm', 'Q_680nm', 'U_680nm', 'dolp_680nm', 'aolp_680nm']
    """
    names = (*STOKES, "dolp", "aolp") if stokes else ("radiance",)
    return [f"{name}_{nm:.10g}nm" for name in names for nm in wavelengths]


def error_columns(wavelengths: Sequence[float], *, stokes: bool = False) -> list[str]:
    """Names of the columns of standard errors, of radiance or of I, Q and U.

    Examples
    --------
    >>> error_columns([680.0])
    ['standard_error_680nm']
    >>> error_columns([680.0], stokes=True)
    ['standard_error_I_680nm', 'standard_error_Q_680nm', 'standard_error_U_680nm']
    """
    names = [f"standard_error_{name}" for name in STOKES] if stokes else ["standard_error"]
    return [f"{name}_{nm:.10g}nm" for name in names for nm in wavelengths]


def write_cases(
    path: str,
    cases: Cases,
    wavelengths: Sequence[float],
    radiance: NDArray[np.float64],
    standard_error: NDArray[np.float64] | None = None,
    *,
    stokes: bool = False,
) -> None:
    """Write the table with the radiances appended.

    Parameters
    ----------
    path : str
        Path of the .csv, written atomically; ``-`` is the standard output.
    cases : Cases
        Table of observers.
    wavelengths : sequence of float
        Wavelengths of the radiances. [nm]
    radiance : array, shape (n, wavelengths)
        Radiances, written with nine digits. [W m⁻² sr⁻¹ nm⁻¹]
    standard_error : array, shape (n, wavelengths), optional
        Standard errors, written with two digits in columns after the radiances. [W m⁻² sr⁻¹ nm⁻¹]
    stokes : bool
        Whether the values are those of ``polarised_answers``.

    Raises
    ------
    FileError
        If the file cannot be written; an existing file is then unchanged.
    """
    check_table(path, (".csv",))
    if path == "-":
        _write(sys.stdout, cases, wavelengths, radiance, standard_error, stokes)
        return
    with (
        atomic_file(path) as part,
        part.open("w", encoding="utf-8", newline="") as stream,
    ):
        _write(stream, cases, wavelengths, radiance, standard_error, stokes)


def _write(
    stream: TextIO,
    cases: Cases,
    wavelengths: Sequence[float],
    radiance: NDArray[np.float64],
    standard_error: NDArray[np.float64] | None,
    stokes: bool,
) -> None:
    columns = radiance_columns(wavelengths, stokes=stokes)
    if standard_error is not None:
        columns += error_columns(wavelengths, stokes=stokes)
    write_head(stream, cases, columns)
    write_rows(stream, cases, radiance, standard_error)


def write_head(stream: TextIO, cases: Cases, columns: Sequence[str]) -> None:
    """Write the comments and the header of a table, with columns appended."""
    stream.writelines(f"{comment}\n" for comment in cases.comments)
    csv.writer(stream, lineterminator="\n").writerow([*cases.header, *columns])


def write_rows(
    stream: TextIO,
    cases: Cases,
    radiance: NDArray[np.float64],
    standard_error: NDArray[np.float64] | None = None,
) -> None:
    """Write rows with the radiances appended; arguments as for ``write_cases``."""
    writer = csv.writer(stream, lineterminator="\n")
    answers = [[f"{value:.8e}" for value in row] for row in radiance]
    if standard_error is not None:
        for row, errors in zip(answers, standard_error, strict=True):
            row += [f"{value:.1e}" for value in errors]
    for cells, answer in zip(cases.rows, answers, strict=True):
        writer.writerow([*cells, *answer])
