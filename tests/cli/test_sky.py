"""``airlight sky``: what it writes and says, and the one line for each thing it refuses."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from airlight.cli import main
from airlight.image.exr import read_exr

QUICK = ["--quality", "preview", "--wavelengths", "rgb", "--size", "64"]


def test_a_map_its_json_and_its_lines(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "sky.exr"
    words = ["--for", "mitsuba", "--sun", "light", "--sun-azimuth", "120", "--sun-zenith", "60"]
    assert main(["sky", "earth", "-o", str(path), *QUICK, *words]) == 0
    assert sorted(one.name for one in tmp_path.iterdir()) == ["sky.exr", "sky.json", "sky.xml"]
    lines = capsys.readouterr().out.splitlines()
    assert re.fullmatch(r"\S+sky\.exr  64x32  \d+ kB  \d+\.\d s  float, linear, scale 1", lines[0])
    assert re.fullmatch(
        r"star: bearing 120\.00°, elevation 30\.03°, 0\.533° wide, [\d.e+]+ lx, "
        r"a separate light", lines[1],
    )  # fmt: skip
    rgb, texts = read_exr(path)
    assert rgb.shape == (32, 64, 3)
    assert texts["airlight.sun_azimuth"] == "120 deg"
    reported = json.loads((tmp_path / "sky.json").read_text(encoding="utf-8"))
    assert (reported["planet"], reported["observer"]) == ("Earth", {"altitude_m": 2.0})


def test_a_setting_sun_beyond_srgb_is_said(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["--for", "blender", "--sun-zenith", "89.3", "--quality", "preview", "--size", "64"]
    words += ["--wavelengths", "440,500,560,620"]
    assert main(["sky", "earth", "-o", str(tmp_path / "sky.exr"), *words]) == 0
    line = capsys.readouterr().out.splitlines()[1]
    found = re.search(r"mapped into sRGB: a channel by ([\d.]+) of its luminance", line)
    reported = json.loads((tmp_path / "sky.json").read_text(encoding="utf-8"))["lights"][0]
    change = np.abs(reported["gamut_change_W_m2"]).max() * 683.0 / reported["illuminance_lx"]
    assert found is not None
    assert float(found[1]) == pytest.approx(change, rel=0.05)
    assert change > 0.01


def test_a_place_and_a_time_are_in_the_json(tmp_path: Path) -> None:
    path = tmp_path / "sky.exr"
    words = ["--at", "59.33N,18.07E", "--time", "2026-06-21T18:10+02:00", "--for", "three"]
    assert main(["sky", "earth", "-o", str(path), *QUICK, *words]) == 0
    reported = json.loads((tmp_path / "sky.json").read_text(encoding="utf-8"))
    assert reported["observer"] == {
        "altitude_m": 2.0, "latitude_deg": 59.33, "longitude_deg": 18.07,
        "time": "2026-06-21T16:10:00Z",
    }  # fmt: skip
    # Stockholm, the afternoon of midsummer: the sun in the west, some 30° high
    sun = reported["lights"][0]
    assert 260.0 < sun["bearing_deg"] < 275.0
    assert 25.0 < sun["elevation_deg"] < 35.0
    assert [one["name"] for one in reported["lights"]] == ["star", "moon"]


def test_a_dome_master_for_a_theatre(tmp_path: Path) -> None:
    path = tmp_path / "dome.png"
    words = ["--for", "dome", "--front", "E", "--tilt", "15", "--sun-azimuth", "90"]
    words += ["--sun-zenith", "70", "--glare", "0"]
    assert main(["sky", "earth", "-o", str(path), *QUICK, *words]) == 0
    with Image.open(path) as image:
        pixels = np.asarray(image).astype(int).sum(axis=-1)
    # a sun in front, 55° below the middle of the tilted dome: in the lower half, on the axis
    row, column = np.unravel_index(np.argmax(pixels[:60]), (60, 64))
    assert 50 <= row <= 53
    assert abs(column - 31.5) < 2.0
    reported = json.loads((tmp_path / "dome.json").read_text(encoding="utf-8"))
    assert (reported["bearing_of_the_bottom_deg"], reported["tilt_deg"]) == (90.0, 15.0)


@pytest.mark.parametrize(
    ("words", "reported"),
    [
        (["-o", "a.exr"], "Missing option '--for'"),
        (["--for", "maya", "-o", "a.exr"], "'maya' is not one of 'blender'"),
        (["--for", "usd", "-o", "a.tif"], r"ends in .png, .exr, .hdr"),
        (["--for", "usd", "-o", "no/a.exr"], "there is no folder"),
        (["--for", "usd", "-o", "a.exr", "--front", "90"], "--front requires --for dome"),
        (["--for", "dome", "-o", "a.exr", "--front", "up"], "--front is 'up'"),
        (["--for", "dome", "-o", "a.exr", "--front", "S/30"], "--front is 'S/30'"),
        (["--for", "dome", "-o", "a.exr", "--tilt", "120"], "--tilt is 120.0; allowed: 0 to 90"),
        (
            ["--for", "usd", "-o", "a.exr", "--exposure", "1"],
            "--exposure does not apply to .exr files",
        ),
        (
            ["--for", "usd", "-o", "a.exr", "--tone-map", "aces"],
            "--tone-map does not apply to .exr files",
        ),
        (
            ["--for", "usd", "-o", "a.png", "--precision", "half"],
            "--precision does not apply to .png files",
        ),
        (["--for", "usd", "-o", "a.exr", "--scale", "-1"], "--scale is '-1'"),
        (["--for", "usd", "-o", "a.png", "--bits", "12"], "--bits is 12; allowed: 8 or 16"),
        (["--for", "usd", "-o", "a.exr", "--size", "65x40"], "twice as wide as high"),
        (["--for", "pbrt", "-o", "a.exr", "--size", "64x32"], "a square for octahedral"),
        (["--for", "usd", "-o", "a.exr", "--latitude", "3"], "--latitude requires --longitude"),
        (["--for", "usd", "-o", "a.exr", "--wavelengths", "550"], "three or more"),
        (["--for", "usd", "-o", "a.exr", "--stars", "--set", "body="], "--stars requires a planet"),
    ],
)
def test_bad_input_is_refused_in_one_line(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    words: list[str],
    reported: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["sky", "earth", *words]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert reported in line
    assert list(tmp_path.iterdir()) == []


def test_a_scale_too_large_for_halves_is_refused_by_its_option(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["--for", "godot", "--scale", "1000", "-o", str(tmp_path / "a.exr")]
    assert main(["sky", "earth", *QUICK, *words]) == 2
    assert capsys.readouterr().err.startswith("airlight: --scale is 1000.0; allowed: at most")


@pytest.mark.parametrize("word", [["--exposure", "2"], ["--tone-map", "agx"], ["--bits", "16"]])
def test_render_refuses_display_options_for_a_linear_file(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], word: list[str]
) -> None:
    assert main(["render", "earth", "-o", str(tmp_path / "a.exr"), *word]) == 2
    line = capsys.readouterr().err
    assert f"{word[0]} does not apply" in line
    assert "does not apply to .exr files, which hold linear radiance" in line
