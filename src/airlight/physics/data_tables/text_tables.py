"""Tables in text files: with delimiters or blanks, of soundings, and of spectral libraries.

Layouts beside CSV and columns between blanks:

* radiosondes of the University of Wyoming, columns of equal width below a line of names and one of
  units (weather.uwyo.edu/upperair/sounding.html);
* the extended CSV of WOUDC, whose section ``#PROFILE`` has fixed units (WOUDC Contributor Guide,
  GAW Report 163);
* AERONET, with lines of text before the names;
* ECOSTRESS and ASTER spectral libraries, ``X Units:`` and ``Y Units:`` above two columns (Meerdink
  et al. 2019, Remote Sensing of Environment 230, 111196).
"""

from __future__ import annotations

import csv
import itertools
import re
from collections.abc import Callable, Sequence
from typing import Final

import numpy as np

from airlight.errors import FileError, ParameterError
from airlight.physics.data_tables.data_table import DataColumn, DataTable, column_of, number_of
from airlight.physics.data_tables.headings import Heading, heading

#: A line of a file with its number.
Line = tuple[int, str]
_COMMENT: Final = ("#", "%", "!")
#: Units of the columns of WOUDC's profiles, by the key of the name.
_WOUDC_UNITS: Final = {
    "pressure": "hPa",
    "o3partialpressure": "mPa",
    "temperature": "°C",
    "gpheight": "m",
    "height": "m",
    "sampletemperature": "°C",
}


def read_text_table(text: str, source: str, header: str | None = None) -> DataTable:
    """Table of a text file.

    Parameters
    ----------
    text : str
        Contents of the file.
    source : str
        Name in errors.
    header : str, optional
        Names and units, with commas between them, of a file that has none.
    """
    lines = list(enumerate(text.splitlines(), 1))
    first = next((line for _, line in lines if line.strip()), "")
    if header is None:
        if any(line.strip().upper() == "#PROFILE" for _, line in lines):
            return _woudc(lines, source)
        if any(line.startswith("X Units:") for _, line in lines[:60]):
            return _spectral_library(lines, source)
        at = _wyoming_header(lines)
        if at is not None:
            return _wyoming(lines, at, source)
        if first.startswith("AERONET"):
            start = [k for k, (_, line) in enumerate(lines) if "Date(dd" in line]
            if not start:
                raise FileError(source, "is not a table of AERONET: no line has the dates' name")
            return _delimited(lines[start[0] :], source, None, "AERONET")
    return _delimited(lines, source, header)


def _delimited(
    lines: Sequence[Line], source: str, header: str | None, layout: str = ""
) -> DataTable:
    """Table with commas, semicolons, tabs or blanks between columns, and comment lines."""
    body = [(n, line) for n, line in lines if line.strip()]
    comments = [(n, line) for n, line in body if line.lstrip().startswith(_COMMENT)]
    body = [(n, line) for n, line in body if not line.lstrip().startswith(_COMMENT)]
    if not body:
        raise FileError(source, "has no header")
    split = _splitter(body[-1][1], source)
    head, cells = (0, ""), split(body[0][1])
    if header is not None:
        head, names = (0, header), next(csv.reader([header], skipinitialspace=True))
    elif any(np.isnan(number_of(cell)) and cell.strip() for cell in cells):
        head, names, body = body[0], split(_joined(body[0][1])), body[1:]
    else:
        named = [(n, line, split(_joined(line.lstrip(" #%!")))) for n, line in comments]
        fitting = [one for one in named if len(one[2]) == len(cells)]
        if not fitting:
            allowed = "a line with the names and units of its columns above them, or one given"
            raise FileError(source, f"has no header: {allowed}")
        head, names = fitting[-1][:2], fitting[-1][2]
    headings = [heading(name) for name in names]
    rows = [split(line) for _, line in body]
    if rows and all(np.isnan(number_of(cell)) for cell in rows[0]) and len(rows) > 1:
        headings = _with_units(headings, rows[0])
        rows, body = rows[1:], body[1:]
    return _table(headings, rows, [n for n, _ in body], source, head[0], _notes(comments), layout)


def _table(
    headings: Sequence[Heading],
    rows: Sequence[Sequence[str]],
    lines: Sequence[int],
    source: str,
    head: int,
    notes: dict[str, str] | None = None,
    layout: str = "",
) -> DataTable:
    for n, row in zip(lines, rows, strict=True):
        if len(row) != len(headings):
            allowed = f"{len(headings)}, as in the header"
            raise ParameterError(f"line {n}", f"{len(row)} cells", allowed, source)
    columns: list[DataColumn] = [
        column_of(one, [row[k] for row in rows]) for k, one in enumerate(headings)
    ]
    at = np.asarray(lines, np.int64)
    return DataTable(source, tuple(columns), at, head, notes or {}, layout)


def _with_units(headings: Sequence[Heading], units: Sequence[str]) -> list[Heading]:
    """Headings with the units of the line below them."""
    pairs = zip(headings, units, strict=False)
    return [Heading(one.name, one.unit or unit.strip(), one.wavelength) for one, unit in pairs]


def _joined(line: str) -> str:
    """Header with no blank before a unit in brackets."""
    return re.sub(r"[ \t]+(?=[\[(])", "", line)


def _splitter(line: str, source: str) -> Callable[[str], list[str]]:
    """Function that divides a line into cells as this one is divided."""
    mark = next((one for one in ";,\t" if one in line), None)
    if mark is None or (mark == "\t" and not line.partition("\t")[0].strip()):
        return str.split
    decimal = mark == ";" and re.search(r"\d,\d", line) and "." not in line

    def split(text: str) -> list[str]:
        try:
            cells = next(csv.reader([text], delimiter=mark, strict=True))
        except csv.Error as error:
            raise FileError(source, f"is not valid CSV: {error}") from error
        return [re.sub(r"(?<=\d),(?=\d)", ".", cell) for cell in cells] if decimal else cells

    return split


def _notes(comments: Sequence[Line]) -> dict[str, str]:
    """Texts of the lines ``# key: value``; lines of one key are joined."""
    notes: dict[str, str] = {}
    for _, line in comments:
        key, colon, value = line.lstrip(" #%!").partition(":")
        if colon:
            notes[key.strip()] = f"{notes.get(key.strip(), '')} {value.strip()}".strip()
    return notes


def _wyoming_header(lines: Sequence[Line]) -> int | None:
    """Index of the line of names of a sounding of the University of Wyoming."""
    for k, (_, line) in enumerate(lines[:-1]):
        if line.split()[:2] == ["PRES", "HGHT"] and line.startswith(" "):
            return k
    return None


def _wyoming(lines: Sequence[Line], at: int, source: str) -> DataTable:
    """Sounding in columns of equal width, of which some are blank; ends before the next text."""
    names = list(re.finditer(r"\S+", lines[at][1].expandtabs()))
    units = lines[at + 1][1].split()
    if len(units) != len(names):
        allowed = f"a unit for each of the {len(names)} columns"
        raise ParameterError(f"line {lines[at + 1][0]}", len(units), allowed, source)
    edges = [0, *(one.end() for one in names)]
    rows: list[list[str]] = []
    numbers: list[int] = []
    for n, line in lines[at + 2 :]:
        if not line.strip() or not line.strip("- "):
            if rows:
                break
            continue
        if re.search(r"[A-Za-z<]", line):
            break
        rows.append([line[a:b] for a, b in itertools.pairwise(edges)])
        numbers.append(n)
    headings = [Heading(one[0], unit) for one, unit in zip(names, units, strict=True)]
    title = next((line.strip() for _, line in lines[:at] if "Observations at" in line), "")
    notes = {"title": re.sub(r"<[^>]*>", "", title)}
    return _table(headings, rows, numbers, source, lines[at][0], notes, "University of Wyoming")


def _woudc(lines: Sequence[Line], source: str) -> DataTable:
    """Section ``#PROFILE`` of an extended CSV."""
    at = next(k for k, (_, line) in enumerate(lines) if line.strip().upper() == "#PROFILE")
    section: list[Line] = []
    for n, line in lines[at + 1 :]:
        if line.startswith("#"):
            break
        if line.strip() and not line.startswith("*"):
            section.append((n, line))
    if len(section) < 2:
        raise FileError(source, "has no rows below #PROFILE")
    names = [heading(name) for name in section[0][1].split(",")]
    headings = [
        Heading(one.name, one.unit or _WOUDC_UNITS.get(one.key, ""), one.wavelength)
        for one in names
    ]
    rows = [line.split(",") for _, line in section[1:]]
    rows = [[*row, *[""] * (len(headings) - len(row))] for row in rows]
    return _table(headings, rows, [n for n, _ in section[1:]], source, section[0][0], {}, "WOUDC")


def _spectral_library(lines: Sequence[Line], source: str) -> DataTable:
    """Two columns below lines ``key: value``, which have the units of both."""
    notes: dict[str, str] = {}
    body: list[Line] = []
    for n, line in lines:
        cells = line.replace(",", " ").split()
        if len(cells) == 2 and not np.isnan([number_of(cell) for cell in cells]).any():
            body.append((n, " ".join(cells)))
        elif body and line.strip():
            raise ParameterError(f"line {n}", line.strip(), "a wavelength and a value", source)
        elif ":" in line:
            key, _, value = line.partition(":")
            notes[key.strip()] = value.strip()
    headings = [heading(notes.get(key, "")) for key in ("X Units", "Y Units")]
    rows = [line.split() for _, line in body]
    if not rows:
        raise FileError(source, "has no rows of a wavelength and a value")
    head = next(n for n, line in lines if line.startswith("X Units:"))
    numbers = [n for n, _ in body]
    return _table(headings, rows, numbers, source, head, notes, "spectral library")
