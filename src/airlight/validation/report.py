"""The report as one HTML page that is complete in itself: no network, no other files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape

from airlight.reports.html import page_html, part_html, table_html
from airlight.validation.suite import Bar, Suite


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
    return page_html(
        "airlight: validation",
        [
            f'<p class="verdict {verdict}">{escape(report.verdict)}</p>',
            f"<dl>{facts}</dl>",
            "<h3>Suites</h3>",
            _suites(report),
            "<h3>Bars</h3>",
            _bars(report),
            *(_section(suite) for suite in report.suites),
        ],
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
    return table_html(["suite", "result", "bars met", "time"], rows)


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
    return table_html(["suite", "what", "got", "bar", "", "whose bar"], rows)


def _section(suite: Suite) -> str:
    lines = [f'<h2 id="{suite.name}">{escape(suite.title)}</h2>']
    if suite.not_run:
        return "\n".join([*lines, f'<p class="quiet">Not run: {escape(suite.not_run)}.</p>'])
    style = "quiet" if not suite.bars else "met" if suite.passed else "missed"
    lines.append(f'<p class="{style}">{escape(result_word(suite))}, {suite.seconds:.1f} s</p>')
    lines.append(f"<p>{escape(suite.summary)}</p>")
    if suite.settings:
        lines.append(f'<p class="quiet">{escape("; ".join(suite.settings))}</p>')
    lines += [part_html(part) for part in suite.parts]
    return "\n".join(lines)
