"""``airlight export-page``: from a planet's name to one file."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest

from airlight.cli import main
from airlight.viewer.browser.page import LEAST_PICTURE

QUICK = ["--quality", "preview", "--wavelengths", "three"]


def page_data(place: Path) -> Any:
    """Data of a written page."""
    text = place.read_text(encoding="utf-8")
    return json.loads(text.partition('id="airlight-data">')[2].partition("</script>")[0])


def test_page_is_one_file_below_3_mb_with_the_view_that_was_asked_for(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    place = tmp_path / "mars.html"
    view = ["--view", "altitude=1500", "--view", "projection=fisheye", "--view", "automatic=off"]
    assert main(["export-page", "mars-rayleigh", "-o", str(place), *view, *QUICK]) == 0
    assert str(place) in capsys.readouterr().out
    assert [file.name for file in tmp_path.iterdir()] == ["mars.html"]
    assert place.stat().st_size < 3e6
    data = page_data(place)
    assert data["planet"] == "mars-rayleigh"
    assert data["values"]["view.altitude"] == 1500.0
    assert data["values"]["view.projection"] == "fisheye"
    assert data["values"]["display.automatic"] is False


def test_page_too_large_has_no_stars_and_then_three_wavelengths(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    # Pluto's sun has no formula for dates, so its page has no control of them.
    place = tmp_path / "pluto.html"
    words = ["export-page", "pluto", "--quality", "preview", "-o", str(place)]
    assert main(words) == 0
    assert "four wavelengths" in capsys.readouterr().out
    assert "view.clock" not in page_data(place)["values"]
    assert "star_sky" in page_data(place)["picture"]
    for wavelengths in ("four", "three"):
        size = place.stat().st_size
        picture = re.search(r'<img class="airlight-first".*</div>', place.read_text())
        assert picture is not None
        reserved = size - len(picture[0]) + LEAST_PICTURE
        monkeypatch.setattr("airlight.viewer.browser.page.LARGEST", reserved - 100)
        assert main(words) == 0
        assert f"{wavelengths} wavelengths" in capsys.readouterr().out
        assert place.stat().st_size < size
        assert "star_sky" not in page_data(place)["picture"]

    monkeypatch.setattr("airlight.viewer.browser.page.LARGEST", 100_000)
    assert main(words) == 2
    assert "even at the quality preview with three wavelengths" in capsys.readouterr().err
    assert place.stat().st_size < size  # the page before is kept


def test_page_of_a_scene_has_its_time_and_no_sun_of_its_own(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    place = tmp_path / "moon.html"
    view = ["--view", "hours=-1.5", "--set", "moon.albedo=0.2"]
    assert main(["export-page", "lunar-eclipse", "-o", str(place), *view, *QUICK]) == 0
    data = page_data(place)
    declared = {one["path"]: one for one in data["parameters"]}
    assert data["values"]["scene.hours"] == -1.5
    assert declared["view.sun_zenith"]["mode"] == "derived"
    assert not {"view.clock", "view.second_light"} & declared.keys()
    scene = data["picture"]["scene"]
    assert [one["name"] for one in scene["bodies"]] == ["earth", "moon"]
    assert [one["hours"] for one in scene["moments"]][::24] == [-12.0, 0.0, 12.0]
    assert scene["bodies"][1]["lights"][0]["shade"] is not None

    assert main(["export-page", "solar-eclipse-2017", "-o", str(place), *QUICK]) == 2
    assert "corona, which only the CPU draws" in capsys.readouterr().err
    words = ["--view", "sun_zenith=80"]
    assert main(["export-page", "lunar-eclipse", "-o", str(place), *words, *QUICK]) == 2
    assert "view is 'view.sun_zenith'; allowed: view.altitude" in capsys.readouterr().err


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
