"""Validation report as Markdown, with its pictures as files.

Only rankings are complete; of other tables the page has the rows that fail. Thresholds and tables
that the HTML report does not collapse are files beside the pictures.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final, TypeGuard
from urllib.parse import quote

from airlight.studies.reports.markdown import (
    csv_bytes,
    escaped,
    files_of,
    part_lines,
    row_lines,
    strong,
)
from airlight.validation.report import (
    SUITE_COLUMNS,
    THRESHOLD_COLUMNS,
    ValidationReport,
    nearest_text,
    result_word,
)
from airlight.validation.suite import Part, ReportTable, Suite, cells

#: File of all thresholds, and its columns.
_THRESHOLDS: Final = "thresholds.csv"
_THRESHOLD_FIELDS: Final = cells("suite | quantity | result | target | unit | met | source")


def markdown(report: ValidationReport, folder: str) -> str:
    """Format the report as a page of Markdown.

    Parameters
    ----------
    folder : str
        Folder of ``page_files`` relative to the page, such as ``"pictures"``.
    """
    lines = ["# Validation", "", f"**{report.verdict}.**", ""]
    lines += [f"- {name}: {value}" for name, value in report.provenance.items()]
    lines += [f"- time: {report.seconds:.0f} s", "", "## Suites", ""]
    lines += row_lines(
        SUITE_COLUMNS,
        [
            (
                suite.title,
                strong(result_word(suite), not suite.passed),
                f"{sum(one.passed for one in suite.thresholds)} of {len(suite.thresholds)}",
                nearest_text(suite),
                f"{suite.seconds:.1f} s",
            )
            for suite in report.suites
        ],
    )
    missed = [
        (suite.name, one.name, *one.texts, one.source)
        for suite, one in report.thresholds
        if not one.passed
    ]
    lines += ["", "## Thresholds", "", f"All: [{_THRESHOLDS}]({quote(folder)}/{_THRESHOLDS})."]
    if missed:
        lines += ["", "Missed:", ""]
        lines += row_lines([one for one in THRESHOLD_COLUMNS if one], missed)
    for suite in report.suites:
        lines += _section(suite, folder)
    return "\n".join(lines) + "\n"


def page_files(report: ValidationReport) -> dict[str, bytes]:
    """Contents of the pictures and of the files of tables, by file name."""
    parts = [part for suite in report.suites for part in suite.parts]
    tables = [part for part in parts if _is_file(part)]
    files = files_of(parts)
    files |= {one.file_name: csv_bytes(one.columns, one.rows) for one in tables}
    if len(files) < len(files_of(parts)) + len(tables):
        raise ValueError("two tables have the same title")
    rows = [
        (suite.name, one.name, one.result, one.target, one.unit, one.passed, one.source)
        for suite, one in report.listed
    ]
    return {**files, _THRESHOLDS: csv_bytes(_THRESHOLD_FIELDS, rows)}


def _section(suite: Suite, folder: str) -> list[str]:
    lines = ["", f"## {suite.title}", ""]
    if suite.not_run:
        return [*lines, f"Not run: {suite.not_run}."]
    lines += [f"{strong(result_word(suite), not suite.passed)}, {suite.seconds:.1f} s", ""]
    lines += [escaped(suite.summary)]
    if suite.settings:
        lines += ["", f"*{escaped('; '.join(suite.settings))}*"]
    for part in suite.parts:
        lines += ["", *_lines(part, folder)]
    return lines


def _is_file(part: Part) -> TypeGuard[ReportTable]:
    """Whether a part is a table that is written as a file; rankings stay on the page."""
    return isinstance(part, ReportTable) and not part.folded and "ours" not in part.marks


def _lines(part: Part, folder: str) -> list[str]:
    """Lines of a part, with only the failing rows of a table that is no ranking."""
    if not isinstance(part, ReportTable) or "ours" in part.marks:
        return part_lines(part, folder)
    where, count = "see the HTML report", len(part.rows)
    if not part.folded:
        where = f"[{part.file_name}]({quote(folder)}/{part.file_name})"
    failed = [row for row, mark in zip(part.rows, part.marks, strict=False) if mark == "fail"]
    if not failed:
        rows = f"{count} rows" if count > 1 else f"{count} row"
        return [f"{escaped(part.title)} ({rows}): {where}. {escaped(part.note)}".strip()]
    title = f"{part.title}: {len(failed)} of {count} rows that fail"
    shown = replace(part, title=title, rows=failed, marks=["fail"] * len(failed), folded=False)
    return [*part_lines(shown, folder), "", f"All rows: {where}."]
