"""The report as Markdown with its pictures as files, for a repository's documentation."""

from __future__ import annotations

from collections.abc import Sequence

from airlight.validation.report import Report, cell_text, result_word
from airlight.validation.suite import Cell, Picture, ReportTable, Suite


def markdown(report: Report, pictures: str) -> str:
    """Format the report as a page of Markdown.

    Parameters
    ----------
    report : Report
    pictures : str
        Folder of the pictures relative to the page, such as ``"pictures"``.
    """
    lines = ["# Validation", "", f"**{report.verdict}.**", ""]
    lines += [f"- {name}: {value}" for name, value in report.provenance.items()]
    lines += [f"- time: {report.seconds:.0f} s", "", "## Suites", ""]
    lines += _rows(
        ["suite", "result", "bars met", "time"],
        [
            (
                suite.title,
                _strong(result_word(suite), not suite.passed),
                f"{sum(bar.passed for bar in suite.bars)} of {len(suite.bars)}",
                f"{suite.seconds:.1f} s",
            )
            for suite in report.suites
        ],
    )
    lines += ["", "## Bars", ""]
    lines += _rows(
        ["suite", "what", "got", "bar", "", "whose bar"],
        [
            (
                suite.name,
                bar.name,
                f"{bar.got:.4g} {bar.unit}".strip(),
                f"≤ {bar.allowed:.4g} {bar.unit}".strip(),
                _strong("met" if bar.passed else "missed", not bar.passed),
                bar.source,
            )
            for suite, bar in report.listed
        ],
    )
    for suite in report.suites:
        lines += _section(suite, pictures)
    return "\n".join(lines) + "\n"


def picture_files(report: Report) -> dict[str, bytes]:
    """Contents of the pictures, by file name.

    Raises
    ------
    ValueError
        If two pictures have the same name.
    """
    pictures = [p for suite in report.suites for p in suite.parts if isinstance(p, Picture)]
    files = {picture.file_name: picture.png for picture in pictures}
    if len(files) < len(pictures):
        raise ValueError("two pictures have the same title")
    return files


def _section(suite: Suite, pictures: str) -> list[str]:
    lines = ["", f"## {suite.title}", ""]
    if suite.not_run:
        return [*lines, f"Not run: {suite.not_run}."]
    lines += [f"{_strong(result_word(suite), not suite.passed)}, {suite.seconds:.1f} s", ""]
    lines += [_escaped(suite.summary)]
    if suite.settings:
        lines += ["", f"*{_escaped('; '.join(suite.settings))}*"]
    for part in suite.parts:
        lines.append("")
        if isinstance(part, ReportTable):
            lines += _table(part)
        elif isinstance(part, Picture):
            lines += [f"![{part.title}]({pictures}/{part.file_name})", "", _escaped(part.caption)]
        else:
            lines.append(_escaped(part.text))
    return lines


def _table(table: ReportTable) -> list[str]:
    marks = table.marks or [""] * len(table.rows)
    rows = [
        [_strong(cell_text(cell), mark in ("fail", "ours")) for cell in row]
        for row, mark in zip(table.rows, marks, strict=True)
    ]
    body = _rows(table.columns, rows)
    note = ["", _escaped(table.note)] if table.note else []
    if table.folded and "fail" not in marks:
        title = f"<summary>{table.title} ({len(rows)} rows)</summary>"
        return ["<details>", title, "", *body, *note, "", "</details>"]
    return [f"### {table.title}", "", *body, *note]


def _rows(columns: Sequence[str], rows: Sequence[Sequence[Cell]]) -> list[str]:
    lines = [_row(columns), "|" + "---|" * len(columns)]
    return lines + [_row([cell_text(cell) for cell in row]) for row in rows]


def _row(cells: Sequence[str]) -> str:
    return "| " + " | ".join(_escaped(cell).replace("|", "\\|") for cell in cells) + " |"


def _strong(text: str, strong: bool) -> str:
    return f"**{text}**" if strong and text else text


def _escaped(text: str) -> str:
    return text.replace("<", "&lt;")
