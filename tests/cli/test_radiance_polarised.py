"""``airlight radiance --stokes``: one observer, a file of them, and Python agree."""

from __future__ import annotations

import csv
import re
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

import airlight
from airlight.cli import main

PLANET = "earth-atmosphere-plus"
QUICK = ["--quality", "preview"]
ONE = ["--sun-zenith", "80", "--view-zenith", "60"]
HEADER = "altitude_m,sun_zenith_deg,view_zenith_deg,azimuth_deg"
ROWS = ["0,80,60,60", "0,80,60,-60", "5e5,30,20,0"]
LINE = re.compile(r"(\S+) nm  I (\S+)  Q (\S+)  U (\S+) W m⁻² sr⁻¹ nm⁻¹  dolp (\S+)  aolp (\S+)°")


def test_a_file_one_observer_and_python_agree(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "in.csv").write_text("\n".join([HEADER, *ROWS]) + "\n")
    out = tmp_path / "out.csv"
    words = ["--input", str(tmp_path / "in.csv"), "-o", str(out), "--stokes", *QUICK]
    assert main(["radiance", PLANET, *words]) == 0
    with out.open(newline="") as stream:
        header, *table = csv.reader(stream)
    assert header[4:] == [
        f"{name}_{nm}nm" for name in ("I", "Q", "U", "dolp", "aolp") for nm in (680, 550, 440)
    ]
    values = np.array([[float(cell) for cell in row[4:]] for row in table]).reshape(3, 5, 3)

    solution = airlight.solve(PLANET, quality="preview")
    light = solution.radiance(altitude=0, sun_zenith=80, view_zenith=60, azimuth=60, stokes=True)
    assert_allclose(values[0, :3], light, rtol=1e-8)
    assert_allclose(values[0, 3], airlight.degree_of_polarisation(light), rtol=1e-8)
    # a mirrored sky: the angle turns to the other side
    assert_allclose(values[1], values[0] * [[1.0], [1.0], [-1.0], [1.0], [-1.0]], rtol=1e-6)
    assert np.all(values[2] == 0.0)  # it misses the air
    assert np.all(values[0, 3] > 0.2)

    capsys.readouterr()
    assert main(["radiance", PLANET, *ONE, "--azimuth", "60", "--stokes", *QUICK]) == 0
    found = [LINE.fullmatch(line) for line in capsys.readouterr().out.splitlines()]
    printed = np.array([[float(x) for x in one.groups()] for one in found if one])
    assert_allclose(printed[:, 1:4], values[0, :3].T, rtol=2e-8)
    assert_allclose(printed[:, 4:], values[0, 3:].T, atol=6e-4)  # half the last digit


def test_scalar_transfer_is_a_choice_and_another_radiance(
    capsys: pytest.CaptureFixture[str],
) -> None:
    found = []
    for words in ([], ["--no-polarisation"]):
        assert main(["radiance", PLANET, *ONE, "--wavelengths", "440", *QUICK, *words]) == 0
        found.append(float(capsys.readouterr().out.split()[2]))
    scalar = airlight.solve(PLANET, [440.0], "preview", polarisation=False)
    expected = scalar.radiance(altitude=0, sun_zenith=80, view_zenith=60).item()
    assert_allclose(found[1], expected, rtol=1e-8)
    # some percent, as of every Rayleigh sky (Mishchenko, Lacis & Travis 1994)
    assert 0.005 < abs(found[0] / found[1] - 1.0) < 0.15


@pytest.mark.parametrize(
    ("words", "part"),
    [
        (["--solver", "direct"], "--stokes requires --solver moments or montecarlo"),
        (["--no-polarisation"], "--stokes cannot be combined with --no-polarisation"),
    ],
)
def test_polarised_light_of_scalar_transfer_is_one_line(
    words: list[str], part: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["radiance", PLANET, *ONE, "--stokes", *words]) == 2
    assert capsys.readouterr().err == f"airlight: {part}\n"
