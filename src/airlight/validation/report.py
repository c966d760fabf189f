"""The report as one HTML page that is complete in itself: no network, no other files."""

from __future__ import annotations

import base64
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape

from airlight.validation.suite import Bar, Cell, Picture, ReportTable, Suite

_STYLE = """
:root { --ink: #1c2530; --paper: #fff; --line: #d8dee6; --met: #0a6b3d; --missed: #b3261e;
  --soft: #f4f6f9; --ours: #fff6d6; --quiet: #5a6675; }
@media (prefers-color-scheme: dark) { :root { --ink: #e4e8ee; --paper: #14181d; --line: #38424e;
  --met: #5fcf97; --missed: #ff8a80; --soft: #1d242c; --ours: #3a3318; --quiet: #9aa7b6; } }
body { font: 15px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--paper);
  max-width: 72rem; margin: 0 auto; padding: 1.5rem 1.2rem 4rem; }
h1 { font-size: 1.7rem; margin: 0 0 .3rem; }
h2 { font-size: 1.35rem; margin: 3rem 0 .6rem; border-top: 2px solid var(--line);
  padding-top: 1.2rem; }
h3 { font-size: 1.05rem; margin: 1.8rem 0 .4rem; }
p { max-width: 52rem; }
.verdict { font-size: 1.15rem; font-weight: 600; }
.met { color: var(--met); } .missed { color: var(--missed); font-weight: 600; }
.quiet { color: var(--quiet); }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: .87rem; font-variant-numeric: tabular-nums; }
th, td { border-bottom: 1px solid var(--line); padding: .22rem .7rem .22rem .3rem;
  text-align: left; vertical-align: top; }
th { background: var(--soft); font-weight: 600; }
tr.fail td { color: var(--missed); } tr.ours td { background: var(--ours); font-weight: 600; }
figure { margin: 1.2rem 0; } figcaption { color: var(--quiet); max-width: 52rem; }
figure img { max-width: 100%; height: auto; background: #fff; }
summary { cursor: pointer; font-weight: 600; margin: .7rem 0 .3rem; }
dl { display: grid; grid-template-columns: max-content auto; gap: .1rem 1rem; font-size: .9rem; }
dt { color: var(--quiet); } dd { margin: 0; }
"""


@dataclass(frozen=True, kw_only=True)
class Report:
    """Suites of one run, with its provenance and time.

    Attributes
    ----------
    suites : sequence of Suite
        Suites in the order of the page.
    provenance : dict
        Date, version and machine, from ``provenance``.
    seconds : float
        Wall time of the run. [s]
    """

    suites: Sequence[Suite]
    provenance: Mapping[str, str]
    seconds: float

    @property
    def bars(self) -> list[tuple[Suite, Bar]]:
        """Return every bar with its suite."""
        return [(suite, bar) for suite in self.suites for bar in suite.bars]

    @property
    def listed(self) -> list[tuple[Suite, Bar]]:
        """As ``bars``, with all golden tables that are met in one bar, or they bury the others."""
        met = [bar for suite, bar in self.bars if suite.name == "golden" and bar.passed]
        if len(met) < 2:
            return self.bars
        one = Bar(
            name=f"numbers missed in {len(met)} tables", got=0, allowed=0, source="each table"
        )
        golden = next(suite for suite in self.suites if suite.name == "golden")
        rest = [(suite, bar) for suite, bar in self.bars if suite is not golden or not bar.passed]
        return [(golden, one), *rest]

    @property
    def passed(self) -> bool:
        """Whether every bar of the suites that ran is met."""
        return all(suite.passed for suite in self.suites)

    @property
    def verdict(self) -> str:
        """Result in one line."""
        missed = [bar for _, bar in self.bars if not bar.passed]
        left = [suite.name for suite in self.suites if suite.not_run]
        text = f"{len(self.bars) - len(missed)} of {len(self.bars)} bars are met"
        return text + (f"; not run: {', '.join(left)}" if left else "")


def cell_text(cell: Cell) -> str:
    """Text of a cell; floats have four significant digits.

    Examples
    --------
    >>> cell_text(0.123456), cell_text(7), cell_text("7.50")
    ('0.1235', '7', '7.50')
    """
    return f"{cell:.4g}" if isinstance(cell, float) else str(cell)


def result_word(suite: Suite) -> str:
    """Result of a suite in a word or two."""
    if suite.not_run:
        return f"not run: {suite.not_run}"
    if not suite.bars:
        return "shown, not judged"
    return "all bars met" if suite.passed else "misses a bar"


def html(report: Report) -> str:
    """Format the report as a page of HTML.

    Parameters
    ----------
    report : Report

    Returns
    -------
    str
        Page in HTML that is also well-formed XML.
    """
    verdict = "met" if report.passed else "missed"
    facts = "".join(f"<dt>{escape(k)}</dt><dd>{escape(v)}</dd>" for k, v in _facts(report))
    return "\n".join(
        [
            "<!DOCTYPE html>",
            '<html lang="en"><head><meta charset="utf-8"/>',
            '<meta name="viewport" content="width=device-width, initial-scale=1"/>',
            f"<title>airlight: validation</title><style>{_STYLE}</style></head><body>",
            "<h1>airlight: validation</h1>",
            f'<p class="verdict {verdict}">{escape(report.verdict)}</p>',
            f"<dl>{facts}</dl>",
            "<h3>Suites</h3>",
            _suites(report),
            "<h3>Bars</h3>",
            _bars(report),
            *(_section(suite) for suite in report.suites),
            "</body></html>\n",
        ]
    )


def _facts(report: Report) -> list[tuple[str, str]]:
    return [*report.provenance.items(), ("time", f"{report.seconds:.0f} s")]


def _suites(report: Report) -> str:
    rows = []
    for suite in report.suites:
        met = sum(bar.passed for bar in suite.bars)
        style = "quiet" if not suite.bars else "met" if suite.passed else "missed"
        rows.append(
            f'<tr><td><a href="#{suite.name}">{escape(suite.title)}</a></td>'
            f'<td class="{style}">{escape(result_word(suite))}</td>'
            f"<td>{met} of {len(suite.bars)}</td><td>{suite.seconds:.1f} s</td></tr>"
        )
    return _table_of(["suite", "result", "bars met", "time"], rows)


def _bars(report: Report) -> str:
    rows = []
    for suite, bar in report.listed:
        style, word = ("met", "met") if bar.passed else ("missed", "missed")
        rows.append(
            f'<tr><td><a href="#{suite.name}">{escape(suite.name)}</a></td>'
            f"<td>{escape(bar.name)}</td><td>{bar.got:.4g} {escape(bar.unit)}</td>"
            f"<td>≤ {bar.allowed:.4g} {escape(bar.unit)}</td>"
            f'<td class="{style}">{word}</td><td class="quiet">{escape(bar.source)}</td></tr>'
        )
    return _table_of(["suite", "what", "got", "bar", "", "whose bar"], rows)


def _table_of(columns: Sequence[str], rows: Sequence[str]) -> str:
    head = "".join(f"<th>{escape(column)}</th>" for column in columns)
    body = "\n".join(rows)
    return (
        f'<div class="scroll"><table><thead><tr>{head}</tr></thead>'
        f"<tbody>\n{body}\n</tbody></table></div>"
    )


def _section(suite: Suite) -> str:
    lines = [f'<h2 id="{suite.name}">{escape(suite.title)}</h2>']
    if suite.not_run:
        return "\n".join([*lines, f'<p class="quiet">Not run: {escape(suite.not_run)}.</p>'])
    style = "quiet" if not suite.bars else "met" if suite.passed else "missed"
    lines.append(f'<p class="{style}">{escape(result_word(suite))}, {suite.seconds:.1f} s</p>')
    lines.append(f"<p>{escape(suite.summary)}</p>")
    if suite.settings:
        lines.append(f'<p class="quiet">{escape("; ".join(suite.settings))}</p>')
    for part in suite.parts:
        if isinstance(part, ReportTable):
            lines.append(_table(part))
        elif isinstance(part, Picture):
            lines.append(_picture(part))
        else:
            lines += [f"<p>{escape(paragraph)}</p>" for paragraph in part.text.split("\n\n")]
    return "\n".join(lines)


def _table(table: ReportTable) -> str:
    marks = table.marks or [""] * len(table.rows)
    rows = [
        f'<tr class="{mark}">' + "".join(f"<td>{escape(cell_text(c))}</td>" for c in row) + "</tr>"
        for row, mark in zip(table.rows, marks, strict=True)
    ]
    body = _table_of(table.columns, rows)
    note = f'<p class="quiet">{escape(table.note)}</p>' if table.note else ""
    if table.folded:
        # A table with a missed row starts open, so that the row is seen.
        is_open = ' open="open"' if "fail" in marks else ""
        missed = sum(mark == "fail" for mark in marks)
        count = f"{len(rows)} row{'s' * (len(rows) != 1)}" + (
            f", {missed} missed" if missed else ""
        )
        title = f"{escape(table.title)} ({count})"
        return f"<details{is_open}><summary>{title}</summary>{body}{note}</details>"
    return f"<h3>{escape(table.title)}</h3>{body}{note}"


def _picture(picture: Picture) -> str:
    data = base64.b64encode(picture.png).decode("ascii")
    return (
        f'<figure><img alt="{escape(picture.title)}" src="data:image/png;base64,{data}"/>'
        f"<figcaption>{escape(picture.caption)}</figcaption></figure>"
    )
