"""The report: everything in it, nothing outside it, and no miss hidden."""

from __future__ import annotations

import base64
import csv
import io
import re
from dataclasses import replace
from html.parser import HTMLParser
from xml.etree import ElementTree

import pytest
from PIL import Image

from airlight.validation.markdown import markdown, page_files
from airlight.validation.report import ValidationReport, html, provenance
from airlight.validation.suite import ReportPicture, ReportTable, Suite, Text, Threshold


def png(colour: str) -> bytes:
    buffer = io.BytesIO()
    Image.new("RGB", (4, 3), colour).save(buffer, format="png")
    return buffer.getvalue()


WORST = ReportTable(
    title="The worst case",
    columns=["where", "error [%]"],
    rows=[("limb at 92°, |Δ| & <5 %", 4.87), ("noon", 0.01)],
    marks=["fail", ""],
    folded=True,
)


@pytest.fixture
def report() -> ValidationReport:
    met = Threshold(name="median error", result=0.05, target=0.3, unit="%", source="the thresholds")
    missed = Threshold(
        name="largest error", result=4.87, target=2.0, unit="%", source="the thresholds"
    )
    return ValidationReport(
        suites=[
            Suite(
                name="energy", title="Energy", summary="Balances.", thresholds=[met], seconds=1.5,
                parts=[ReportPicture(title="Shares of light", png=png("red"),
                                     caption="One & all.")],
            ),
            Suite(
                name="spherical", title="Spherical", summary="Compares.", thresholds=[met, missed],
                parts=[WORST, Text(text="One.\n\nTwo.")],
            ),
            Suite(name="measured", title="Measured", summary="", not_run="needs --data"),
            Suite(name="cie", title="CIE", summary="A fit.", parts=[WORST]),
        ],
        provenance=provenance(),
        seconds=12.3,
    )  # fmt: skip


def test_the_page_is_well_formed(report: ValidationReport) -> None:
    # Written as XML as well, so that a strict parser judges every tag and entity.
    page = html(report)
    root = ElementTree.fromstring(page.replace("<!DOCTYPE html>", ""))
    assert root.tag == "html"
    assert [e.text for e in root.iter("h2")] == ["Energy", "Spherical", "Measured", "CIE"]


def test_the_page_needs_no_network_and_no_file(report: ValidationReport) -> None:
    sources: list[str] = []

    class Links(HTMLParser):
        def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
            assert tag not in ("script", "link", "iframe", "object")
            sources.extend(v or "" for k, v in attrs if k in ("src", "href", "srcset"))

    page = html(report)
    Links().feed(page)
    assert sources
    assert all(re.match(r"data:image/png;base64,|#", source) for source in sources)
    assert "url(" not in page
    assert "@import" not in page


def test_embedded_pictures_are_the_pictures(report: ValidationReport) -> None:
    data = re.search(r'src="data:image/png;base64,([^"]+)"', html(report))
    assert data is not None
    assert base64.b64decode(data[1]) == png("red")


def test_the_worst_case_and_the_missed_threshold_are_shown_not_folded_away(
    report: ValidationReport,
) -> None:
    page = html(report)
    assert "limb at 92°, |Δ| &amp; &lt;5 %" in page
    assert "4.87" in page
    assert '<details open="open"><summary>The worst case (2 rows, 1 missed)' in page
    assert "2 of 3 thresholds are met; not run: measured" in page
    assert re.search(r"largest error</td><td>4.87 %</td><td>≤ 2 %</td><td class=\"missed\">", page)
    text = markdown(report, "pictures")
    assert "**4.87**" in text
    assert "### The worst case: 1 of 2 rows that fail" in text
    assert "noon" not in text
    assert text.count("| spherical | largest error | 4.87 % | ≤ 2 % | the thresholds |") == 1
    assert "median error" not in text.partition("## Thresholds")[2]


def test_markdown_leaves_long_tables_that_are_met_to_the_page(report: ValidationReport) -> None:
    met = replace(WORST, marks=["pass", "pass"], note="Known to 1 %.")
    suite = Suite(name="x", title="X", summary="", parts=[met])
    text = markdown(replace(report, suites=[suite]), "pictures")
    assert "The worst case (2 rows): see the HTML report. Known to 1 %." in text
    assert "noon" in html(replace(report, suites=[suite]))


def test_a_bar_is_met_up_to_it_and_not_by_nothing() -> None:
    # By definition; a number that is none must never pass.
    results = [
        Threshold(name="", result=got, target=2.0).passed for got in (2.0, 2.0001, float("nan"))
    ]
    assert results == [True, False, False]


def test_the_verdict_counts_misses_and_a_suite_without_bars_fails_nothing(
    report: ValidationReport,
) -> None:
    assert not report.passed
    assert [suite.passed for suite in report.suites] == [True, False, True, True]


def test_what_made_the_report_is_said(report: ValidationReport) -> None:
    page = html(report)
    for name, value in provenance().items():
        assert f"<dt>{name}</dt>" in page
        if name not in ("date", "machine"):
            assert value in page
    assert "cores used" in page


def test_markdown_names_its_pictures_and_they_are_there(report: ValidationReport) -> None:
    assert "![Shares of light](plates/shares-of-light.png)" in markdown(report, "plates")
    files = page_files(report)
    assert set(files) == {"shares-of-light.png", "thresholds.csv"}
    assert files["shares-of-light.png"] == png("red")


def test_thresholds_and_tables_are_files_beside_the_page_and_rankings_are_on_it(
    report: ValidationReport,
) -> None:
    # Read again they are what was written; of a table of which rows fail, those stay on the page.
    rows = [(f"case {n}, sun", 0.5 * n) for n in range(30)]
    long = ReportTable(title="All cases", columns=["where", "error [%]"], rows=rows, note="By sun.")
    missed = replace(long, title="Some cases", marks=["fail"] + [""] * 29)
    short = replace(long, title="One case", rows=rows[:1])
    ranking = replace(long, title="Ranking", rows=rows[:2], marks=["ours", ""])
    suite = Suite(name="x", title="X", summary="", parts=[long, missed, short, ranking])
    report = replace(report, suites=[*report.suites, suite])
    text, files = markdown(report, "plates"), page_files(report)
    assert "All cases (30 rows): [all-cases.csv](plates/all-cases.csv). By sun." in text
    assert "One case (1 row): [one-case.csv](plates/one-case.csv). By sun." in text
    page, _, ranked = text.partition("### Ranking")
    assert "| **case 0, sun** | **0** |" in page
    assert "case 1, sun" not in page
    assert "| case 1, sun | 0.5 |" in ranked
    assert "ranking.csv" not in files
    assert "All rows: [some-cases.csv](plates/some-cases.csv)." in text

    def read(name: str) -> list[list[str]]:
        return list(csv.reader(io.StringIO(files[name].decode())))

    assert read("all-cases.csv")[1:] == [[name, f"{error:.4g}"] for name, error in rows]
    assert read("some-cases.csv") == read("all-cases.csv")
    assert [[row[0], *row[2:6]] for row in read("thresholds.csv")] == [
        ["suite", "result", "target", "unit", "met"],
        ["energy", "0.05", "0.3", "%", "True"],
        ["spherical", "0.05", "0.3", "%", "True"],
        ["spherical", "4.87", "2", "%", "False"],
    ]


def test_tables_with_one_name_are_refused() -> None:
    table = ReportTable(title="A", columns=["b"], rows=[("c",)] * 30)
    suite = Suite(name="x", title="X", summary="", parts=[table, table])
    with pytest.raises(ValueError, match="same title"):
        page_files(ValidationReport(suites=[suite], provenance={}, seconds=0.0))


def test_markdown_keeps_its_tables_in_shape(report: ValidationReport) -> None:
    # A threshold in a cell would end it: every row of a table has the heading's number of cells.
    lines = markdown(report, "p").splitlines()
    start = lines.index("| where | error [%] |")
    assert lines[start + 2].replace("\\|", "").count("|") == 3
    assert "&lt;5 %" in lines[start + 2]


def test_pictures_with_one_name_are_refused() -> None:
    twice = [ReportPicture(title="A b", png=b""), ReportPicture(title="a B", png=b"")]
    suite = Suite(name="x", title="X", summary="", parts=twice)
    with pytest.raises(ValueError, match="same title"):
        page_files(ValidationReport(suites=[suite], provenance={}, seconds=0.0))


@pytest.mark.parametrize(
    ("rows", "marks", "part"), [([("a",)], (), "a row of 1 for 2"), ([], ("pass",), "1 marks")]
)
def test_tables_that_do_not_fit_are_refused(rows: list, marks: tuple, part: str) -> None:
    with pytest.raises(ValueError, match=part):
        ReportTable(title="t", columns=["a", "b"], rows=rows, marks=marks)


def test_a_figure_becomes_a_small_picture_of_the_size_asked_for() -> None:
    pytest.importorskip("matplotlib")
    from airlight.studies.plots.figure import new_figure

    figure = new_figure("Title", size=(5.0, 2.0))
    figure.add_subplot().plot([0, 1], [1, 0])
    picture = ReportPicture.from_figure(figure, title="Title", dpi=80)
    with Image.open(io.BytesIO(picture.png)) as image:
        assert image.size == (400, 160)
        assert len(image.convert("RGB").getcolors(100_000) or []) > 2
    assert len(picture.png) < 20_000
