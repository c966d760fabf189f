"""``airlight spectrum``: numbers on the screen, files, and one line for what is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.cli import main

EARTH = ("spectrum", "earth-bruneton", "--quality", "preview", "--wavelengths", "680,550,440")


def test_albedos_are_printed_with_their_units(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*EARTH, "--of", "bond-albedo"]) == 0
    out, err = capsys.readouterr()
    assert "spherical_albedo" in out
    assert "[nm]" in out
    assert "bond_albedo 0." in out
    assert "other wavelengths are not included" in err


def test_files_of_each_kind_are_written_at_once(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    names = [tmp_path / name for name in ("limb.csv", "limb.nc", "limb.png")]
    files = [part for name in names for part in ("-o", str(name))]
    assert main([*EARTH, "--of", "limb", "--tangent-heights", "0:40:20km", *files]) == 0
    assert all(name.stat().st_size > 0 for name in names)
    rows = np.loadtxt(
        (line for line in names[0].read_text().splitlines() if line[:1].isdigit()), delimiter=","
    )
    assert_allclose(np.unique(rows[:, 0]), [0.0, 20e3, 40e3])
    assert capsys.readouterr().out.count("limb of") == 3


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--of", "disc", "--phase-angles", "0,200"), "--phase-angles is 200.0; allowed: 0 to 180"),
        (("--of", "disc", "--tangent-heights", "5km"), "--tangent-heights"),
        (("--of", "limb", "--tangent-heights", "900km"), "--tangent-heights is 900000.0"),
        (("--of", "transmission", "-o", "x.txt"), ".csv, .nc, .json, .png, .svg, .pdf"),
        (("--of", "transmission", "-o", "no/such/folder/x.csv"), "there is no folder"),
        (("--of", "disc", "--phase-angles", "0:x:2"), "--phase-angles"),
    ],
)
def test_what_cannot_be_is_refused_on_one_line(
    arguments: tuple[str, ...], words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*EARTH, *arguments]) == 2
    # beside it a note that this planet's air ends low
    notes = [line for line in capsys.readouterr().err.splitlines() if "air ends at" not in line]
    assert len(notes) == 1
    assert words in notes[0]


def test_missing_bands_and_lines_that_miss_are_said(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["spectrum", "exoplanet", "--of", "transmission", "--quality", "preview",
                "--wavelengths", "1000:1600:100"]) == 0  # fmt: skip
    assert "CO2 1200 to 1220, 1520 to 1660 nm" in capsys.readouterr().err
    assert main(["radiance", "earth-bruneton", "--altitude", "1000km", "--sun-zenith", "60",
                "--view-zenith", "90", "--quality", "preview"]) == 0  # fmt: skip
    assert "1 of 1 lines of sight miss the atmosphere" in capsys.readouterr().err
