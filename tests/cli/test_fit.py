"""``airlight fit`` from the command line to its files, and what it refuses."""

from __future__ import annotations

import re
from pathlib import Path
from xml.etree import ElementTree

import pytest

from airlight.cli import main
from airlight.cli.fit import FREE, FitOptions
from airlight.cli.planet_options import PlanetOptions
from airlight.planets import load_planet

HEADER = "wavelength_nm,sun_zenith_deg,view_zenith_deg,azimuth_deg,radiance"


@pytest.fixture
def sky(tmp_path: Path) -> Path:
    """Radiances by ``airlight radiance`` itself."""
    file, cases = tmp_path / "sky.csv", tmp_path / "cases.csv"
    lines = [f"0,{sun},{view},60" for sun in (40, 70) for view in (10, 50, 80)]
    cases.write_text("\n".join(["altitude_m,sun_zenith_deg,view_zenith_deg,azimuth_deg", *lines]))
    words = ["radiance", "earth-atmosphere-plus", "--set", "ground.albedo=0.4", "--input",
             str(cases), "--output", str(file), "--quality", "preview", "--no-cache"]  # fmt: skip
    assert main(words) == 0
    return file


@pytest.mark.slow
@pytest.mark.parametrize("page", [pytest.param("fit.html", marks=pytest.mark.validation), "fit.md"])
def test_fit_writes_planet_and_report(
    sky: Path, tmp_path: Path, page: str, capsys: pytest.CaptureFixture[str]
) -> None:
    # The albedo of the radiances is known; the files are read back.
    pytest.importorskip("matplotlib")
    output, report = tmp_path / "fitted.toml", tmp_path / page
    words = ["fit", "earth-atmosphere-plus", "--data", str(sky), "--free",
             "ground.albedo, aerosol.optical_depth", "--uncertainty", "1%", "--quality", "preview",
             "--no-cache", "-o", str(output), "--report", str(report)]  # fmt: skip
    assert main(words) == 0
    said = capsys.readouterr().out
    # A preview of ``radiance`` has the degree of clear air, a fit's that of all air: 0.3995.
    shown = re.search(r"ground\.albedo = ([\d.]+) ± ", said)
    assert shown is not None
    assert abs(float(shown[1]) - 0.4) < 0.004
    assert abs(load_planet(output).ground.albedo - 0.4) < 0.004
    text = report.read_text(encoding="utf-8")
    if page.endswith(".html"):
        ElementTree.fromstring(text.replace("<!DOCTYPE html>", ""))
    else:
        pictures = sorted(file.name for file in (tmp_path / "fit-pictures").glob("*.png"))
        assert "residuals.png" in pictures
        assert all(name in text for name in pictures)
    assert "ground.albedo" in text


def test_without_free_the_aerosol_is_fitted_and_what_the_data_need_besides() -> None:
    # Of a photograph, whose exposure is free, the load alone.
    planet = PlanetOptions(planet="earth")
    sky = FitOptions().settings(planet, photograph=False)
    assert tuple(sky.free) == FREE
    assert list(FitOptions().settings(planet, photograph=True).free) == ["aerosol.optical_depth"]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--free", "ground.albdo"], "--free is 'ground.albdo'; allowed: the path of a number"),
        (["--free", "ground.albdo"], "such as 'ground.albedo'"),
        (["--free", ","], "--free"),
        (["--bandwidth", "0nm"], "--bandwidth is 0.0; allowed: more than 0"),
        (["--free", "ground.albedo", "--bounds", "ground.albedo"], "--bounds is 'ground.albedo'"),
        (["--free", "ground.albedo", "--bounds", "ground.albedo=0.1"], "LOW..HIGH"),
        (["--free", "ground.albedo", "--prior", "ground.albedo=0.1"], "MEAN±SIGMA"),
        (["--free", "ground.albedo", "--uncertainty", "0"], "--uncertainty"),
        (["--free", "ground.albedo", "--loss", "square"], "--loss is 'square'"),
        (["--free", "ground.albedo", "--photo", "x.png"], "--data cannot be combined with --photo"),
        (["--free", "ground.albedo", "--report", "x.pdf"], "--report"),
        (["--free", "ground.albedo", "-o", "x.txt"], ".toml"),
        (["--free", "scale, ground.albedo", "--each-scan", "ground.brightness"], "--each-scan"),
    ],
)  # fmt: skip
def test_faults_are_said_in_one_line_with_the_option(
    words: list[str], said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    # Before any solution: the exit status is 2.
    monkeypatch.chdir(tmp_path)
    (tmp_path / "sky.csv").write_text(f"{HEADER}\n550,40,10,0,0.05\n")
    start = ["fit", "earth-atmosphere-plus", "--data", "sky.csv", "-o", "fitted.toml"]
    assert main([*start, "--quality", "preview", "--no-cache", *words]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert said in error
    assert not (tmp_path / "fitted.toml").exists()
