"""Moon and second star by the command line."""

from __future__ import annotations

from pathlib import Path

import pytest

from airlight.cli import main
from airlight.image.png import read_png_metadata

FAST = ["--size", "32x18", "--wavelengths", "rgb", "--quality", "preview"]


def test_the_moon_of_a_time_lights_the_picture_unasked(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    # 26 October 2026, a day after full moon: 62° high over the Alps at 23 UTC. The exposure, which
    # is told, has to rise by more than two stops without it, to airglow and the lights of towns.
    when = ["earth", "--at", "46.5N,8E", "--time", "2026-10-26T23:00Z", "--look-at", "N"]
    reported = []
    for more in ([], ["--moon", "none"]):
        assert main(["render", *when, *FAST, *more, "-o", str(tmp_path / "a.png")]) == 0
        line = capsys.readouterr().out.splitlines()[-1]
        reported.append(float(line.split("exposure")[1].split()[0]))
    assert reported[1] > reported[0] + 2.0


def test_lights_are_told_in_the_header(tmp_path: Path) -> None:
    picture = tmp_path / "two.png"
    lights = ["--moon", "60,40,30", "--second-star", "80,12,3500K,0.4deg"]
    assert main(["render", "earth", "--altitude", "2m", *FAST, *lights, "-o", str(picture)]) == 0
    texts = read_png_metadata(picture)
    assert texts["airlight.light_2"] == "moon, zenith 60 deg, azimuth 40 deg, phase 30 deg"
    star = "second star, zenith 80 deg, azimuth 12 deg, 3500 K, angular radius 0.4 deg"
    assert texts["airlight.light_3"] == star


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (["--moon", "up"], "--moon is 'up'"),
        (["--moon", "60,40,200"], "phase 0 to 180 deg"),
        (["--second-star", "80,12"], "--second-star is '80,12'; allowed: zenith,azimuth,temp"),
        (["--second-star", "80,12,3K"], "temperature 100 to 1e"),
        (["--stars", "--set", "body="], "--stars requires a planet whose body is"),
        (
            ["--stars", "--projection", "orthographic"],
            "--stars cannot be combined with projection orthographic",
        ),
    ],
)
def test_what_cannot_be_is_one_clear_line(
    options: list[str], says: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["render", "earth", *FAST, *options, "-o", str(tmp_path / "x.png")]) != 0
    error = capsys.readouterr().err.strip()
    assert says in error
    assert "\n" not in error
