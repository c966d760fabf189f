"""``airlight validate``: what it writes, how it ends, and what it refuses before it works."""

from __future__ import annotations

import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import pytest

from airlight.cli import main
from airlight.validation import run as suites
from airlight.validation.suite import ReportPicture, ReportTable, Suite, Threshold

pytest.importorskip("matplotlib")

ONE_PIXEL = (
    b"\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR\x00\x00\x00\x01\x00\x00\x00\x01\x08\x00\x00\x00\x00:~\x9bU"
    b"\x00\x00\x00\nIDATx\x9cc`\x00\x00\x00\x02\x00\x01H\xaf\xa4q\x00\x00\x00\x00IEND\xaeB`\x82"
)


def error_line(capsys: pytest.CaptureFixture[str]) -> str:
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith("airlight: ")
    assert captured.err.count("\n") == 1
    return captured.err


def test_golden_numbers_make_a_page_and_status_0(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    # The real suite from the command line to the file.
    page = tmp_path / "report.html"
    assert main(["validate", "--suite", "golden", "-o", str(page)]) == 0
    assert "golden     all thresholds met" in capsys.readouterr().out
    text = page.read_text(encoding="utf-8")
    ElementTree.fromstring(text.replace("<!DOCTYPE html>", ""))
    assert "213.865952" in text
    assert [file.name for file in tmp_path.iterdir()] == ["report.html"]


@pytest.fixture
def quick(monkeypatch: pytest.MonkeyPatch) -> Suite:
    """Every suite but golden replaced by one with a picture; golden misses a threshold."""
    picture = ReportPicture(title="Some picture", png=ONE_PIXEL)
    table = ReportTable(title="Worst", columns=["case"], rows=[("the worst of all",)])
    made = Suite(
        name="golden", title="Golden numbers", summary="Numbers.", parts=[table, picture],
        thresholds=[Threshold(name="numbers missed", result=1, target=0)],
    )  # fmt: skip
    plain = replace(made, parts=[])
    monkeypatch.setattr(
        suites, "resolve_name", lambda path: lambda _: made if path.endswith("golden") else plain
    )
    return made


def test_a_missed_bar_is_said_and_status_1(
    quick: Suite, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    # A suite that misses; the page is written all the same.
    page = tmp_path / "report.html"
    assert main(["validate", "--suite", "golden", "-o", str(page)]) == 1
    out = capsys.readouterr().out
    assert "misses a threshold" in out
    assert "missed: numbers missed: 1, target ≤ 0" in out
    assert "the worst of all" in page.read_text(encoding="utf-8")


def test_all_without_data_says_what_was_not_run(
    quick: Suite, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    page = tmp_path / "report.html"
    main(["validate", "-o", str(page)])
    out = capsys.readouterr().out
    assert out.count("not run: requires reference data") == 3
    assert "not run: spherical, measured" in page.read_text(encoding="utf-8")


def test_markdown_comes_with_its_pictures_beside_it(quick: Suite, tmp_path: Path) -> None:
    main(["validate", "--suite", "golden", "-o", str(tmp_path / "page.md")])
    assert sorted(file.name for file in tmp_path.iterdir()) == ["page.md", "pictures"]
    assert (tmp_path / "pictures" / "some-picture.png").read_bytes() == ONE_PIXEL
    assert "numbers missed,1,0,,False" in (tmp_path / "pictures" / "thresholds.csv").read_text()
    assert "](pictures/some-picture.png)" in (tmp_path / "page.md").read_text(encoding="utf-8")


def test_pictures_in_a_folder_of_ones_own_bring_the_markdown_too(
    quick: Suite, tmp_path: Path
) -> None:
    words = ["validate", "--suite", "golden", "-o", str(tmp_path / "page.html")]
    main([*words, "--pictures", str(tmp_path / "a" / "plates")])
    assert sorted(file.name for file in tmp_path.iterdir()) == ["a", "page.html", "page.md"]
    assert "](a/plates/some-picture.png)" in (tmp_path / "page.md").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("words", "part"),
    [
        (["validate"], "--output"),
        (["validate", "-o", "report.pdf"], ".html or .md"),
        (["validate", "-o", "missing/report.html"], "there is no folder"),
        (["validate", "--suite", "gold", "-o", "a.html"], "--suite is 'gold'; allowed: golden"),
        (["validate", "--suite", "spherical", "-o", "a.html"], "--data is required for spherical"),
        (["validate", "--suite", "measured", "-o", "a.html"], "kider2013-05-27.npz"),
        (["validate", "--data", "nowhere", "-o", "a.html"], "nowhere: is not a folder"),
        (
            ["validate", "--suite", "spherical", "--data", ".", "-o", "a.html"],
            "contains no spherical",
        ),
    ],
)
def test_what_cannot_be_is_refused_before_any_work(
    words: list[str], part: str, quick: Suite, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    monkeypatch.chdir(tmp_path)
    assert main(words) == 2
    assert part in error_line(capsys)
    assert not list(tmp_path.iterdir())


def test_without_matplotlib_one_line_says_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    assert main(["validate", "--suite", "golden", "-o", str(tmp_path / "a.html")]) == 2
    assert "pip install 'airlight[plots]'" in error_line(capsys)


@pytest.mark.skipif(sys.platform == "win32", reason="Windows sends no SIGINT to one process")
def test_an_interrupted_validation_leaves_no_file(tmp_path: Path) -> None:
    # The suite tells that it has begun and then works for longer than the test waits.
    script = (
        "import sys, time\n"
        "from airlight.validation import run\n"
        "def long(work):\n"
        "    print('begun', flush=True)\n"
        "    time.sleep(3600)\n"
        "run.resolve_name = lambda _: long\n"
        "from airlight.cli import main\n"
        "sys.exit(main(sys.argv[1:]))\n"
    )
    with subprocess.Popen(
        [sys.executable, "-c", script, "validate", "--suite", "golden", "-o", "a.md"],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    ) as process:
        try:
            assert process.stdout is not None
            assert process.stdout.readline() == "begun\n"
            process.send_signal(signal.SIGINT)
            _, err = process.communicate(timeout=600)
        finally:
            process.kill()
    assert process.returncode == 130
    assert err == "airlight: cancelled\n"
    assert not list(tmp_path.iterdir())
