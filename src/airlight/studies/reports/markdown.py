"""Parts of a report page as Markdown, with their pictures as files."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Sequence
from html import escape
from urllib.parse import quote

from airlight.studies.reports.parts import Cell, Part, ReportPicture, ReportTable, cell_text


def files_of(parts: Sequence[Part]) -> dict[str, bytes]:
    """Contents of the pictures among parts, by file name."""
    pictures = [part for part in parts if isinstance(part, ReportPicture)]
    files = {picture.file_name: picture.png for picture in pictures}
    if len(files) < len(pictures):
        raise ValueError("two pictures have the same title")
    return files


def csv_bytes(columns: Sequence[str], rows: Sequence[Sequence[Cell]]) -> bytes:
    r"""Table as a file of comma-separated values.

    Examples
    --------
    >>> csv_bytes(("scene", "error [%]"), [("noon, summer", 0.0123456)])
    b'scene,error [%]\n"noon, summer",0.01235\n'
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerows([columns, *([cell_text(cell) for cell in row] for row in rows)])
    return text.getvalue().encode()


def part_lines(part: Part, pictures: str) -> list[str]:
    """Lines of a table, picture or text.

    Parameters
    ----------
    pictures : str
        Folder of the pictures relative to the page, such as ``"pictures"``.
    """
    if isinstance(part, ReportTable):
        return _table(part)
    if isinstance(part, ReportPicture):
        return [
            f"![{escaped(part.title)}]({quote(pictures)}/{part.file_name})",
            "",
            escaped(part.caption),
        ]
    return [escaped(part.text)]


def _table(table: ReportTable) -> list[str]:
    marks = table.marks or [""] * len(table.rows)
    rows = [
        [strong(cell_text(cell), mark in ("fail", "ours")) for cell in row]
        for row, mark in zip(table.rows, marks, strict=True)
    ]
    body = row_lines(table.columns, rows)
    note = ["", escaped(table.note)] if table.note else []
    if table.folded and "fail" not in marks:
        title = f"<summary>{escape(table.title)} ({len(rows)} rows)</summary>"
        return ["<details>", title, "", *body, *note, "", "</details>"]
    return [f"### {escaped(table.title)}", "", *body, *note]


def row_lines(columns: Sequence[str], rows: Sequence[Sequence[Cell]]) -> list[str]:
    """Lines of a table."""
    lines = [_row(columns), "|" + "---|" * len(columns)]
    return lines + [_row([cell_text(cell) for cell in row]) for row in rows]


def _row(cells: Sequence[str]) -> str:
    return "| " + " | ".join(escaped(cell).replace("|", "\\|") for cell in cells) + " |"


def strong(text: str, wanted: bool) -> str:
    """Text, optionally bold."""
    return f"**{text}**" if wanted and text else text


def escaped(text: str) -> str:
    r"""Text with HTML and Markdown syntax escaped.

    Examples
    --------
    >>> print(escaped("<b> [a](b) \\`"))
    &lt;b> [a]\(b) \\\`
    """
    return re.sub(r"[\\`]|(?<=\])[(\[]", r"\\\g<0>", text).replace("<", "&lt;")
