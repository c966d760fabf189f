"""``airlight show``, with changes and beside another planet; the sky's colour is not solved."""

from __future__ import annotations

from typing import Any

import pytest

from airlight.cli import main
from airlight.errors import ParameterError
from airlight.render import sky_color

SKY = (
    sky_color.SkyColor(look="zenith", luminance=2e3, chromaticity=(0.25, 0.26), code="#102030"),
    sky_color.SkyColor(look="zenith", luminance=3e3, chromaticity=(0.25, 0.27), code="#112233"),
)


@pytest.fixture
def skies(monkeypatch: pytest.MonkeyPatch) -> None:
    answers = iter(SKY)
    monkeypatch.setattr(sky_color, "sky_colors", lambda *a, **o: (next(answers),))


def words(line: str) -> list[str]:
    return line.split()


@pytest.mark.usefixtures("skies")
def test_only_what_differs_is_printed_with_the_amount(capsys: pytest.CaptureFixture[str]) -> None:
    # 345 to 300 DU: -13 % of ozone's optical depth; the air and the aerosol are the same
    change = "ozone.absorption.ozone=300 DU"
    assert main(["show", "earth", "--set", change, "--compare", "earth"]) == 0
    out = capsys.readouterr().out
    lines = out.splitlines()
    assert not any(line.startswith(("air", "aerosol", "shell", "star")) for line in lines)
    depth = next(words(line) for line in lines if "optical depth" in line)
    assert depth[:3] == ["optical", "depth", "680"]
    assert float(depth[4]) / float(depth[3]) == pytest.approx(345.0 / 300.0, rel=1e-3)
    assert depth[-1] == "+15"
    # the sky: 2000 to 3000 cd/m², y by 0.01, x not at all
    luminance = next(words(line) for line in lines if "luminance" in line)
    assert luminance[-4:] == ["2000", "3000", "+1e+03", "+50"]
    assert "chromaticity y" in out
    assert "chromaticity x" not in out
    assert "#102030" in out
    assert "#112233" in out


@pytest.mark.usefixtures("skies")
def test_columns_are_aligned(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["show", "earth", "--compare", "earth-openspace"]) == 0
    lines = capsys.readouterr().out.splitlines()
    header = next(line for line in lines if "difference" in line)
    end = header.index("difference") + len("difference")
    rows = [line for line in lines if "coefficient [" in line or "luminance" in line]
    assert len(rows) >= 4
    for line in rows:
        assert line[end - 1] != " "
        assert line[end] == " "


def test_a_planet_beside_itself(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def unseen(*arguments: Any, **options: Any) -> None:
        raise ParameterError("wavelengths", 1e4, "visible ones")

    monkeypatch.setattr(sky_color, "sky_colors", unseen)
    assert main(["show", "mars", "--compare", "mars"]) == 0
    assert capsys.readouterr().out.strip() == "Mars and Mars do not differ."


def test_what_is_set_is_what_is_shown(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sky_color, "sky_colors", lambda *a, **o: (SKY[0],))
    assert main(["show", "earth", "--set", "ground.albedo=0.37", "--set", "air.name=gas"]) == 0
    out = capsys.readouterr().out
    assert "0.37" in out
    assert "gas " in out
    assert "zenith #102030" in out
    # a gas says what it is made of, ozone its column: 345 DU
    assert "288.15 K" in out
    assert "9.26939e+22 m⁻²" in out


def test_the_ground_that_the_air_is_solved_for_is_said(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    # Greenland's inland ice: more than five times the planet's mean albedo, 0.105
    monkeypatch.setattr(sky_color, "sky_colors", lambda *a, **o: (SKY[0],))
    assert main(["show", "earth"]) == 0
    assert "mean of the planet" in " ".join(capsys.readouterr().out.split())
    assert main(["show", "earth", "--latitude", "72", "--longitude", "-40"]) == 0
    out = " ".join(capsys.readouterr().out.split())
    assert "ground of 72°N 40°W" in out
    assert float(out.split(": albedo ")[1].split()[0]) > 5.0 * 0.105
    assert "planet 0.105" in out
    assert main(["show", "earth", "--ground-albedo", "0.3"]) == 0
    assert "surface albedo used by the solver as given" in " ".join(capsys.readouterr().out.split())
