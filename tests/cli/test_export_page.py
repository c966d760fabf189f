"""``airlight export-page``: from a planet's name to one file."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from airlight.cli import main

QUICK = ["--quality", "preview", "--wavelengths", "three"]


def test_page_is_one_file_below_3_mb_with_the_view_that_was_asked_for(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    place = tmp_path / "mars.html"
    view = ["--view", "altitude=1500", "--view", "projection=fisheye", "--view", "automatic=off"]
    assert main(["export-page", "mars-rayleigh", "-o", str(place), *view, *QUICK]) == 0
    assert str(place) in capsys.readouterr().out
    assert [file.name for file in tmp_path.iterdir()] == ["mars.html"]
    assert place.stat().st_size < 3e6
    text = place.read_text(encoding="utf-8")
    data = json.loads(text.partition('id="airlight-data">')[2].partition("</script>")[0])
    assert data["planet"] == "mars-rayleigh"
    assert data["values"]["view.altitude"] == 1500.0
    assert data["values"]["view.projection"] == "fisheye"
    assert data["values"]["display.automatic"] is False


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["-o", "page.png"], "--output is 'page.png'; allowed: a name that ends with .html"),
        (["-o", "p.html", "--view", "height=3"], "--view is 'height=3'; allowed: NAME=VALUE, with"),
        (["-o", "p.html", "--view", "altitude=up"], "allowed: a number, in m"),
        (["-o", "p.html", "--view", "altitude=-5"], "view.altitude is -5"),
        (["-o", "no/p.html"], "no/p.html: there is no folder"),
        (["-o", "p.html", "--set", "ground.albed=1"], "a key of ground is 'albed'"),
    ],
)
def test_what_cannot_be_is_said_in_one_line(
    words: list[str],
    said: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["export-page", "mars-rayleigh", *words, *QUICK]) == 2
    error = capsys.readouterr().err
    assert said in error
    assert error.count("\n") == 1
    assert list(tmp_path.iterdir()) == []
