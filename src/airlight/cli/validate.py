"""``airlight validate``: validation report against published and independent values."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Annotated

import typer

from airlight.cli import options
from airlight.cli.console import examples, say, shown_progress
from airlight.cli.option_groups import named_errors
from airlight.errors import ParameterError

EPILOG = examples(
    "airlight validate -o report.html",
    "airlight validate --suite golden -o golden.html",
    "airlight validate --suite published -o published.html",
    "airlight validate --suite kider --data reference-data -o kider.html",
    "airlight validate --data reference-data -o report.html --pictures pictures",
    "airlight validate --data reference-data -o docs/validation/report.md",
)

#: Exit status if a threshold is missed.
MISSED = 1


def validate(
    output: Annotated[
        Path,
        options.output_option("FILE", "Report: .html, or .md with pictures and tables beside."),
    ],
    suite: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME",
            help="Suites: {validation.run:SUITES} or all (all). May be repeated.",
        ),
    ] = None,
    data: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Folder of reference data for spherical, measured and kider; not distributed.",
        ),
    ] = None,
    pictures: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Folder of pictures and tables for an additional Markdown version.",
        ),
    ] = None,
    overwrite: options.Overwrite = False,
) -> None:
    """Check airlight against published numbers, independent codes and measured skies.

    The exit status is 0 if every threshold is met, 1 if one is missed, 2 after an error.
    """
    started = time.perf_counter()
    from airlight.files.atomic_file import check_target
    from airlight.studies.reports.report_pictures import check_pictures
    from airlight.validation.run import chosen, run

    check_target(output)
    kind = output.suffix.lower()
    if kind not in (".html", ".htm", ".md"):
        raise ParameterError("--output", str(output), "a file that ends in .html or .md")
    if kind == ".md" and pictures is None:
        pictures = output.parent / "pictures"
    if pictures is not None:
        check_pictures(pictures, _page(output), overwrite=overwrite)
    names = suite or ["all"]
    with named_errors("suite", "data"):
        chosen(names, data)
    _check_matplotlib()

    from airlight.validation.report import ValidationReport, provenance, result_word
    from airlight.validation.suite import SuiteRun

    suites = []
    with shown_progress() as report:
        for one in run(names, SuiteRun(data=data, progress=report)):
            suites.append(one)
            met = sum(threshold.passed for threshold in one.thresholds)
            say(
                f"{one.name:10s} {result_word(one):20s} {met} of {len(one.thresholds)} thresholds  "
                f"{one.seconds:.1f} s",
                flush=True,
            )
            for threshold in one.thresholds:
                if not threshold.passed:
                    result, target = threshold.texts
                    say(f"  missed: {threshold.name}: {result}, target {target}")
    whole = ValidationReport(
        suites=suites, provenance=provenance(), seconds=time.perf_counter() - started
    )
    _write(whole, output, pictures, overwrite)
    say(f"{output}  {output.stat().st_size / 1e3:.0f} kB  {whole.verdict}")
    if not whole.passed:
        raise typer.Exit(MISSED)


def _check_matplotlib() -> None:
    """Raise an error if matplotlib is not installed."""
    from airlight.studies.plots.figure import new_figure

    new_figure("")


def _page(output: Path) -> Path | None:
    """Path of the report in Markdown, unless it is the output."""
    return None if output.suffix.lower() == ".md" else output.with_suffix(".md")


def _write(report: object, output: Path, pictures: Path | None, overwrite: bool) -> None:
    import os

    from airlight.files.atomic_file import atomic_file
    from airlight.studies.reports.report_pictures import write_pictures
    from airlight.validation.markdown import markdown, page_files
    from airlight.validation.report import ValidationReport, html

    assert isinstance(report, ValidationReport)
    page = output.with_suffix(".md")
    if pictures is not None:
        beside = Path(os.path.relpath(pictures, page.parent)).as_posix()
        text = markdown(report, beside)
        write_pictures(pictures, page_files(report), _page(output), text, overwrite=overwrite)
        with atomic_file(page) as part:
            part.write_text(text, encoding="utf-8")
    if output.suffix.lower() != ".md":
        with atomic_file(output) as part:
            part.write_text(html(report), encoding="utf-8")
