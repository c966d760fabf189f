"""Validation report as a self-contained HTML page."""

from __future__ import annotations

import datetime
import os
import platform
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Final

from airlight.kernel.threads import thread_count
from airlight.studies.reports.html import page_html, part_html, table_html
from airlight.validation.suite import Suite, Threshold, cells

#: Packages whose versions can change a number.
_PACKAGES = ("numpy", "numba", "scipy", "matplotlib")

#: Headings of the tables of suites and thresholds.
SUITE_COLUMNS: Final = cells("suite | verdict | thresholds met | largest result over target | time")
THRESHOLD_COLUMNS: Final = cells("suite | quantity | result | target | | source")


@dataclass(frozen=True, kw_only=True)
class ValidationReport:
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
    def thresholds(self) -> list[tuple[Suite, Threshold]]:
        """Thresholds with their suites."""
        return [(suite, threshold) for suite in self.suites for threshold in suite.thresholds]

    @property
    def listed(self) -> list[tuple[Suite, Threshold]]:
        """``thresholds`` with the passed golden tables merged into one."""
        met = [
            threshold
            for suite, threshold in self.thresholds
            if suite.name == "golden" and threshold.passed
        ]
        if len(met) < 2:
            return self.thresholds
        one = Threshold(
            name=f"numbers missed in {len(met)} tables", result=0, target=0, source="each table"
        )
        golden = next(suite for suite in self.suites if suite.name == "golden")
        rest = [
            (suite, threshold)
            for suite, threshold in self.thresholds
            if suite is not golden or not threshold.passed
        ]
        return [(golden, one), *rest]

    @property
    def passed(self) -> bool:
        """Whether every threshold of the suites that ran is met."""
        return all(suite.passed for suite in self.suites)

    @property
    def verdict(self) -> str:
        """Result in one line."""
        missed = [threshold for _, threshold in self.thresholds if not threshold.passed]
        left = [suite.name for suite in self.suites if suite.not_run]
        text = f"{len(self.thresholds) - len(missed)} of {len(self.thresholds)} thresholds are met"
        return text + (f"; not run: {', '.join(left)}" if left else "")


def provenance() -> Mapping[str, str]:
    """Provenance of a run: version, date, machine, as texts by name."""
    return {
        "airlight": _version("airlight"),
        "date": datetime.datetime.now(datetime.UTC).strftime("%Y-%m-%d %H:%M UTC"),
        "machine": f"{_cpu_name()}, {thread_count()} of {os.cpu_count()} cores used",
        "system": f"{platform.system()} {platform.machine()}, Python {platform.python_version()}",
        "packages": ", ".join(
            f"{name} {found}" for name in _PACKAGES if (found := _version(name)) != "unknown"
        ),
    }


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "unknown"


def _cpu_name() -> str:
    """Name of the CPU, if known."""
    try:
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return " ".join(line.partition(":")[2].split())
    except OSError:
        pass
    return platform.processor() or platform.machine()


def result_word(suite: Suite) -> str:
    """Short result of a suite."""
    if suite.not_run:
        return f"not run: {suite.not_run}"
    if not suite.thresholds:
        return "shown, not judged"
    return "all thresholds met" if suite.passed else "misses a threshold"


def nearest_text(suite: Suite) -> str:
    """Result closest to its target, or farthest beyond it."""
    one = suite.nearest
    return "" if one is None else f"{one.name}: {' '.join(one.texts)}"


def html(report: ValidationReport) -> str:
    """Report as an HTML page."""
    verdict = "met" if report.passed else "missed"
    facts = "".join(f"<dt>{escape(k)}</dt><dd>{escape(v)}</dd>" for k, v in _facts(report))
    return page_html(
        "airlight: validation",
        [
            f'<p class="verdict {verdict}">{escape(report.verdict)}</p>',
            f"<dl>{facts}</dl>",
            "<h3>Suites</h3>",
            _suites(report),
            "<h3>Thresholds</h3>",
            _thresholds(report),
            *(_section(suite) for suite in report.suites),
        ],
    )


def _facts(report: ValidationReport) -> list[tuple[str, str]]:
    return [*report.provenance.items(), ("time", f"{report.seconds:.0f} s")]


def _suites(report: ValidationReport) -> str:
    rows = []
    for suite in report.suites:
        met = sum(threshold.passed for threshold in suite.thresholds)
        style = "quiet" if not suite.thresholds else "met" if suite.passed else "missed"
        rows.append(
            f'<tr><td><a href="#{suite.name}">{escape(suite.title)}</a></td>'
            f'<td class="{style}">{escape(result_word(suite))}</td>'
            f"<td>{met} of {len(suite.thresholds)}</td><td>{escape(nearest_text(suite))}</td>"
            f"<td>{suite.seconds:.1f} s</td></tr>"
        )
    return table_html(SUITE_COLUMNS, rows)


def _thresholds(report: ValidationReport) -> str:
    rows = []
    for suite, threshold in report.listed:
        style, word = ("met", "met") if threshold.passed else ("missed", "missed")
        rows.append(
            f'<tr><td><a href="#{suite.name}">{escape(suite.name)}</a></td>'
            f"<td>{escape(threshold.name)}</td>"
            f"<td>{escape(threshold.texts[0])}</td><td>{escape(threshold.texts[1])}</td>"
            f'<td class="{style}">{word}</td><td class="quiet">{escape(threshold.source)}</td></tr>'
        )
    return table_html(THRESHOLD_COLUMNS, rows)


def _section(suite: Suite) -> str:
    lines = [f'<h2 id="{suite.name}">{escape(suite.title)}</h2>']
    if suite.not_run:
        return "\n".join([*lines, f'<p class="quiet">Not run: {escape(suite.not_run)}.</p>'])
    style = "quiet" if not suite.thresholds else "met" if suite.passed else "missed"
    lines.append(f'<p class="{style}">{escape(result_word(suite))}, {suite.seconds:.1f} s</p>')
    lines.append(f"<p>{escape(suite.summary)}</p>")
    if suite.settings:
        lines.append(f'<p class="quiet">{escape("; ".join(suite.settings))}</p>')
    lines += [part_html(part) for part in suite.parts]
    return "\n".join(lines)
