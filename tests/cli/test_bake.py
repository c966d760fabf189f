"""``airlight bake``: from a planet's name to a folder of tables."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from airlight.cli import main
from airlight.engines.baking.table_files import load_tables

QUICK = ["--quality", "preview"]
PLANET = "earth-atmosphere-plus"


def test_tables_of_a_planet_are_written_and_their_errors_printed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    # The printed numbers are the manifest's.
    folder = tmp_path / "tables"
    words = ["bake", PLANET, "--layout", "bruneton", "--size", "6x12x8x5", "-o", str(folder)]
    assert main([*words, *QUICK]) == 0
    out = capsys.readouterr().out
    baked = load_tables(folder)
    assert baked.light.packing == "separate"
    assert baked.tables["scattering"].layout.shape == (6, 12, 8, 5)
    for name in ("transmittance", "irradiance", "scattering", "single-aerosol"):
        assert name in out
    assert f"{baked.errors['sky'].median:.1e}" in out
    assert str(folder / "manifest.json") in out
    assert [file.name for file in tmp_path.iterdir()] == ["tables"]


@pytest.mark.parametrize(
    ("options", "packing", "mapping"),
    [
        ([], "rgba", "weighted-power"),
        (["--packing", "phase-included", "--azimuth", "30deg"], "phase-included", "weighted-power"),
        (["--mapping", "linear", "--precision", "half", "--order", "1"], "rgba", "linear"),
    ],
)
def test_choices_reach_the_manifest(
    options: list[str], packing: str, mapping: str, tmp_path: Path
) -> None:
    folder = tmp_path / "plus"
    words = ["bake", PLANET, "--layout", "atmosphere-plus", "--size", "5x9x7", "-o", str(folder)]
    assert main([*words, *options, *QUICK]) == 0
    said = json.loads((folder / "manifest.json").read_text(encoding="utf-8"))
    assert said["light"]["packing"] == packing
    assert said["tables"]["scattering"]["layout"]["mapping"] == mapping
    assert said["tables"]["scattering"]["precision"] == ("half" if "half" in options else "single")
    assert said["orders"] == ("1" if "--order" in options else "all")
    assert said["tables"]["scattering"]["layout"]["azimuth"] == (30.0 if "30deg" in options else 0)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (
            ["--layout", "bruneton", "--mapping", "linear"],
            "--mapping requires --layout atmosphere-plus",
        ),
        (
            ["--layout", "bruneton", "--packing", "rgba"],
            "--packing requires --layout atmosphere-plus",
        ),
        (["--layout", "atmosphere-plus", "--mie", "combined"], "--mie requires --layout bruneton"),
        (["--layout", "atmosphere-plus", "--azimuth", "3"], "requires --packing phase-included"),
        (["--layout", "bruneton", "--size", "32x32"], "4 whole numbers such as 32x128x32x8"),
        (["--layout", "bruneton", "--size", "9x7x8x4"], "size of axis mu is 7"),
        (["--layout", "bruneton", "--order", "0"], "--order is '0'; allowed: all, or 1, 2, 3"),
        (["--layout", "bruneton", "--order", "2"], "order is 2; allowed: 1, or nothing"),
        (["--layout", "bruneton", "--cumulative"], "--cumulative requires --order K"),
        (["--layout", "bruneton", "--lowest-sun", "80deg"], "--lowest-sun is '80deg'; allowed: 90"),
        (["--layout", "bruneton", "--lowest-sun", "low"], "--lowest-sun is 'low'"),
        (["--layout", "atmosphere-plus", "--lowest-sun", "99"], "requires --layout bruneton"),
        (["--layout", "atmosphere-plus", "--smooth-phase", "own"], "requires --layout bruneton"),
        (
            ["--layout", "takram", "--smooth-phase", "own"],
            "--layout takram takes no --smooth-phase",
        ),
        (["--layout", "cube"], "cube"),
    ],
)
def test_what_cannot_be_is_one_line_and_leaves_no_folder(
    words: list[str], said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "tables"
    assert main(["bake", PLANET, "-o", str(folder), *words, *QUICK]) == 2
    error = capsys.readouterr().err
    assert said in error
    assert error.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_a_folder_of_other_things_is_refused_before_any_work(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "letter.txt").write_text("mine")
    words = ["bake", "no-such-planet", "--layout", "bruneton", "-o", str(tmp_path)]
    assert main(words) == 2
    assert "name a new or empty folder" in capsys.readouterr().err


def test_help_shows_examples(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bake", "--help"]) == 0
    assert "airlight bake earth --layout bruneton -o earth-tables" in capsys.readouterr().out
