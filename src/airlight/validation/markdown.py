"""The report as Markdown with its pictures as files, for a repository's documentation.

Of long tables it has the rows that fail; the HTML report has all of them.
"""

from __future__ import annotations

from dataclasses import replace

from airlight.reports.markdown import escaped, files_of, part_lines, row_lines, strong
from airlight.validation.report import Report, result_word
from airlight.validation.suite import Part, ReportTable, Suite, Text


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
    lines += row_lines(
        ["suite", "result", "bars met", "time"],
        [
            (
                suite.title,
                strong(result_word(suite), not suite.passed),
                f"{sum(bar.passed for bar in suite.bars)} of {len(suite.bars)}",
                f"{suite.seconds:.1f} s",
            )
            for suite in report.suites
        ],
    )
    lines += ["", "## Bars", ""]
    lines += row_lines(
        ["suite", "what", "got", "bar", "", "whose bar"],
        [
            (
                suite.name,
                bar.name,
                f"{bar.got:.4g} {bar.unit}".strip(),
                f"≤ {bar.allowed:.4g} {bar.unit}".strip(),
                strong("met" if bar.passed else "missed", not bar.passed),
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
    """Part with only those rows of a folded table that fail."""
    if not isinstance(part, ReportTable) or not part.folded:
        return part
    count = len(part.rows)
    failed = [row for row, mark in zip(part.rows, part.marks, strict=False) if mark == "fail"]
    if not failed:
        return Text(text=f"{part.title} ({count} rows): see the HTML report. {part.note}".strip())
    title = f"{part.title}: {len(failed)} of {count} rows that fail"
    return replace(part, title=title, rows=failed, marks=["fail"] * len(failed), folded=False)
