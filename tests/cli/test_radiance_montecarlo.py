"""``airlight radiance --solver montecarlo``: value ± error, for one observer and for a file."""

from __future__ import annotations

import csv
import re
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_less

from airlight.cli import main

PLANET = "earth-atmosphere-plus"
ONE = ["--sun-zenith", "60", "--view-zenith", "30", "--azimuth", "90"]
SAMPLED = ["--solver", "montecarlo", "--relative-error", "0.005"]
LINE = re.compile(r"(\S+) nm  (\S+) ± (\S+) W m⁻² sr⁻¹ nm⁻¹  \((\d+) histories\)")


def lines(text: str) -> np.ndarray:
    """Wavelength, value, error and histories of each line."""
    found = [LINE.fullmatch(line) for line in text.splitlines()]
    assert all(found)
    return np.array([[float(x) for x in one.groups()] for one in found if one])


def test_one_observer_gets_value_error_and_histories(
    capsys: pytest.CaptureFixture[str],
) -> None:
    # Against the moments solver, which is good to 0.3 %, and the error that was asked for.
    assert main(["radiance", PLANET, *ONE, *SAMPLED]) == 0
    captured = capsys.readouterr()
    assert captured.err == ""
    wavelength, value, error, histories = lines(captured.out).T
    assert wavelength.tolist() == [680.0, 550.0, 440.0]
    assert_array_less(error, 0.0051 * value)
    assert (histories >= 1000).all()
    assert main(["radiance", PLANET, *ONE]) == 0
    printed = capsys.readouterr().out
    moments = [float(line.split()[2]) for line in printed.splitlines()]
    assert_allclose(value, moments, rtol=0.005, atol=3.0 * error.max())


def test_a_file_gets_columns_of_errors_and_one_observer_the_same_numbers(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    # The same question has the same histories, alone or in a list; nine digits are written.
    header = "altitude_m,sun_zenith_deg,view_zenith_deg,azimuth_deg"
    (tmp_path / "in.csv").write_text(f"{header}\n5e5,30,20,0\n0,60,30,90\n")
    words = ["--input", str(tmp_path / "in.csv"), "-o", str(tmp_path / "out.csv")]
    assert main(["radiance", PLANET, *words, "--wavelengths", "550", *SAMPLED, "--seed", "3"]) == 0
    with (tmp_path / "out.csv").open(newline="") as stream:
        table = list(csv.reader(stream))
    assert table[0][4:] == ["radiance_550nm", "standard_error_550nm"]
    assert [float(cell) for cell in table[1][4:]] == [0.0, 0.0]  # it misses the air
    capsys.readouterr()
    assert main(["radiance", PLANET, *ONE, "--wavelengths", "550", *SAMPLED, "--seed", "3"]) == 0
    _, value, error, _ = lines(capsys.readouterr().out)[0]
    assert_allclose([float(cell) for cell in table[2][4:]], [value, error], rtol=1e-7)


def test_another_seed_is_another_answer_within_the_error(
    capsys: pytest.CaptureFixture[str],
) -> None:
    # Independent histories; four combined standard errors.
    answers = []
    for seed in ("1", "2"):
        words = [*ONE, "--wavelengths", "440", *SAMPLED, "--seed", seed]
        assert main(["radiance", PLANET, *words]) == 0
        answers.append(lines(capsys.readouterr().out)[0])
    first, second = answers
    assert first[1] != second[1]
    assert abs(first[1] - second[1]) < 4.0 * np.hypot(first[2], second[2])


def test_an_error_that_is_not_reached_is_said(capsys: pytest.CaptureFixture[str]) -> None:
    # Midnight: no light is found, and one line on the error stream says so.
    words = ["--sun-zenith", "180", "--view-zenith", "0", "--wavelengths", "550"]
    assert main(["radiance", PLANET, *words, *SAMPLED, "--quality", "preview"]) == 0
    captured = capsys.readouterr()
    assert captured.err.count("\n") == 1
    assert "NOT within the requested error" in captured.err


@pytest.mark.parametrize(
    ("words", "part"),
    [
        (["--relative-error", "0.01"], "--relative-error requires --solver montecarlo"),
        (["--seed", "4"], "--seed requires --solver montecarlo"),
        (["--solver", "magic"], "--solver is 'magic'; allowed: moments"),
        ([*SAMPLED[:2], "--relative-error", "0"], "--relative-error is 0.0; allowed: 1e-06 to 1"),
        ([*SAMPLED[:2], "--seed=-1"], "--seed is -1; allowed: a whole number"),
    ],
)
def test_impossible_options_are_one_line(
    words: list[str], part: str, capsys: pytest.CaptureFixture[str]
) -> None:
    # Refused before anything is solved.
    assert main(["radiance", PLANET, *ONE, *words]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert part in captured.err
    assert captured.err.count("\n") == 1


def test_polarised_light_has_an_error_of_each_stokes_parameter(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    # Against the moments solver, which is good to 0.3 % of I, and the errors that are printed.
    header = "altitude_m,sun_zenith_deg,view_zenith_deg,azimuth_deg"
    (tmp_path / "in.csv").write_text(f"{header}\n0,60,30,90\n")
    words = ["--input", str(tmp_path / "in.csv"), "--wavelengths", "550", "--stokes"]
    found = []
    for more in (SAMPLED, []):
        assert main(["radiance", PLANET, *words, *more]) == 0
        names, cells = csv.reader(capsys.readouterr().out.splitlines())
        found.append(dict(zip(names, map(float, cells), strict=True)))
    sampled, moments = found
    whole = moments["I_550nm"]
    for name in "IQU":
        error = sampled[f"standard_error_{name}_550nm"]
        assert 0.0 < error < 0.0051 * whole
        assert (
            abs(sampled[f"{name}_550nm"] - moments[f"{name}_550nm"]) < 3.0 * error + 0.003 * whole
        )
    assert_allclose(sampled["dolp_550nm"], moments["dolp_550nm"], atol=0.02)
    assert main(["radiance", PLANET, *ONE, "--wavelengths", "550", "--stokes", *SAMPLED]) == 0
    assert re.fullmatch(
        r"550 nm  I \S+ ± \S+  Q \S+ ± \S+  U \S+ ± \S+ W m⁻² sr⁻¹ nm⁻¹  dolp \S+  aolp \S+°"
        r"  \(\d+ histories\)\n",
        capsys.readouterr().out,
    )
