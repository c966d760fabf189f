"""``airlight render --at --time``: what is drawn, said and refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from airlight.cli import main
from airlight.image.png import read_png_metadata

QUICK = ["--quality", "preview", "--wavelengths", "rgb", "--size", "32x18"]
STOCKHOLM = ["--at", "59.33N,18.07E", "--time", "2026-06-21T21:10+02:00"]


def rendered(path: Path, *words: str, planet: str = "earth-atmosphere-plus") -> dict[str, str]:
    assert main(["render", planet, "-o", str(path), *QUICK, *words]) == 0
    texts = read_png_metadata(path)
    return {key.removeprefix("airlight."): value for key, value in texts.items()}


def test_picture_of_a_place_and_time_says_both(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    texts = rendered(tmp_path / "a.png", *STOCKHOLM, "--look-at", "sun")
    line, file = capsys.readouterr().out.splitlines()
    assert line == (
        "earth 59.3300°N 18.0700°E  2026-06-21T19:10:00Z  sun +4.18°, bearing 311.2°, 1.0162 au  "
        "moon +21.39°, bearing 220.9°, 49 % lit, waxing"
    )
    assert "a.png" in file
    assert texts["time"] == "2026-06-21T19:10:00Z"
    assert texts["altitude"] == "2 m"
    assert float(texts["sun_azimuth"].split()[0]) == pytest.approx(311.2, abs=0.05)
    assert texts["look"].split(",")[1] == "0 deg"


def test_an_eclipse_is_said(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    # totality over Oregon, and two hours later, when the Moon has left the sun
    oregon = ["--at", "44.507N,121.12W", "--time"]
    rendered(tmp_path / "a.png", *oregon, "2017-08-21T17:20:35Z")
    said = capsys.readouterr().out
    apart = float(said.partition("in front of the sun, ")[2].partition("°")[0])
    assert apart < 0.02
    assert "total; for the sky of totality: airlight render" in said
    rendered(tmp_path / "b.png", *oregon, "2017-08-21T19:20:35Z")
    assert "in front of the sun" not in capsys.readouterr().out


def test_a_partial_eclipse_over_london_shows_its_crescent(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    # 12 August 2026, London: largest at 18:13 UT, 91 % of the area and 0.926 of the diameter
    # covered (NASA, Besselian elements of F. Espenak); the crescent is to the upper right, which
    # the sun's light fills more than half of the limb but less than a tenth of the disc
    words = ["--at", "51.5N,0.1W", "--time", "2026-08-12T18:13Z", "--look-at", "sun", "--fov", "3"]
    out = tmp_path / "a.png"
    quick = ["--quality", "preview", "--wavelengths", "rgb", "--size", "320x180"]
    assert main(["render", "earth", "-o", str(out), *quick, *words]) == 0
    said = capsys.readouterr().out
    # the limb is darker than the middle: of 9 % of the area 6 to 8 % of the light is left
    left = float(said.partition("from its centre: ")[2].partition(" %")[0])
    assert 6.0 < left < 8.5
    bright = np.asarray(Image.open(out).convert("L")) > 200
    disc = np.pi * (0.5 * 0.5264 / 3.0 * 320) ** 2
    assert 0.06 < bright.sum() / disc < 0.13
    row, column = np.nonzero(bright)
    assert row.mean() < 90.0 - 5.0  # above the middle of the picture, where the sun's middle is
    assert np.ptp(column) > 0.6 * 0.5264 / 3.0 * 320


def test_sun_distance_of_the_file_is_said(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    rendered(tmp_path / "a.png", *STOCKHOLM, "--sun-distance", "file", "--altitude", "5km")
    assert "lit as in the planet's file" in capsys.readouterr().out


def test_mars_by_season_and_solar_time(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["--at", "4.59S,137.44E,10m", "--ls", "250", "--time", "14:30", "--look-at", "W/10"]
    texts = rendered(tmp_path / "m.png", *words, planet="mars-rayleigh")
    said = capsys.readouterr().out.splitlines()[0]
    assert said.startswith("mars 4.5900°S 137.4400°E  200")
    assert said.endswith("solar time 14:30")
    assert texts["altitude"] == "10 m"
    assert texts["look"].startswith("80,")


@pytest.mark.parametrize(
    ("words", "line"),
    [
        (["--at", "59N,18E"], "--at requires --time or --ls"),
        (["--time", "sunset"], "--time requires --at"),
        (["--zone", "solar"], "--zone requires --at"),
        ([*STOCKHOLM, "--sun-zenith", "80"], "--sun-zenith cannot be combined with --at"),
        ([*STOCKHOLM, "--latitude", "8"], "--latitude cannot be combined with --at"),
        (
            ["--at", "59N,18E,2km", "--altitude", "3km", "--time", "noon"],
            "--altitude cannot be combined with an altitude in --at",
        ),
        (["--at", "91N,18E", "--time", "noon"], "--at is '91N,18E'; allowed: latitudes from -90"),
        (["--at", "59N,18E", "--time", "2026-06-21T10:00"], "a time with its zone"),
        (["--at", "59N,18E", "--time", "2026-06-21 10:00", "--zone", "X"], "--zone is 'X'"),
        (["--at", "78N,15E", "--time", "2026-06-21 sunset"], "the sun stays between 11."),
        (["--at", "59N,18E", "--ls", "400"], "--ls is 400.0; allowed: 0 to 360 deg"),
        (["--look-at", "moon"], "--look-at is 'moon'; allowed: horizon, nadir, zenith, sun, moon"),
    ],
)
def test_what_cannot_be_is_one_clear_line(
    words: list[str], line: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "a.png"
    assert main(["render", "earth-atmosphere-plus", "-o", str(path), *QUICK, *words]) != 0
    error = capsys.readouterr().err.strip()
    assert line in error
    assert "\n" not in error
    assert not path.exists()


def test_planet_without_a_body_is_told_how_to_get_one(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["render", "exoplanet", "-o", str(tmp_path / "v.png"), *QUICK, *STOCKHOLM]) != 0
    assert "body is missing; allowed: one of earth, mars, titan" in capsys.readouterr().err
