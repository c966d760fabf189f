"""Validation report as Markdown, with its pictures as files.

Long tables contain only rows that fail; the HTML report has all rows.
"""

from __future__ import annotations

from dataclasses import replace

from airlight.studies.reports.markdown import escaped, files_of, part_lines, row_lines, strong
from airlight.validation.report import (
    SUITE_COLUMNS,
    THRESHOLD_COLUMNS,
    ValidationReport,
    nearest_text,
    result_word,
)
from airlight.validation.suite import Part, ReportTable, Suite, Text


def markdown(report: ValidationReport, pictures: str) -> str:
    """Format the report as a page of Markdown.

    Parameters
    ----------
    pictures : str
        Folder of the pictures relative to the page, such as ``"pictures"``.
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
    lines += ["", "## Thresholds", ""]
    lines += row_lines(
        THRESHOLD_COLUMNS,
        [
            (
                suite.name,
                threshold.name,
                *threshold.texts,
                strong("met" if threshold.passed else "missed", not threshold.passed),
                threshold.source,
            )
            for suite, threshold in report.listed
        ],
    )
    for suite in report.suites:
        lines += _section(suite, pictures)
    return "\n".join(lines) + "\n"


def picture_files(report: ValidationReport) -> dict[str, bytes]:
    """Contents of the pictures, by file name."""
    return files_of([part for suite in report.suites for part in suite.parts])


def _section(suite: Suite, pictures: str) -> list[str]:
    lines = ["", f"## {suite.title}", ""]
    if suite.not_run:
        return [*lines, f"Not run: {suite.not_run}."]
    lines += [f"{strong(result_word(suite), not suite.passed)}, {suite.seconds:.1f} s", ""]
    lines += [escaped(suite.summary)]
    if suite.settings:
        lines += ["", f"*{escaped('; '.join(suite.settings))}*"]
    for part in suite.parts:
        lines += ["", *part_lines(_shortened(part), pictures)]
    return lines


def _shortened(part: Part) -> Part:
    """Part with only the failing rows of a folded table."""
    if not isinstance(part, ReportTable) or not part.folded:
        return part
    count = len(part.rows)
    failed = [row for row, mark in zip(part.rows, part.marks, strict=False) if mark == "fail"]
    if not failed:
        return Text(text=f"{part.title} ({count} rows): see the HTML report. {part.note}".strip())
    title = f"{part.title}: {len(failed)} of {count} rows that fail"
    return replace(part, title=title, rows=failed, marks=["fail"] * len(failed), folded=False)
