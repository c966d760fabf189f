"""Aerial perspective on disk, and ``airlight aerial``."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from airlight.cli.app import main
from airlight.engines.composition.aerial_files import write_aerial
from airlight.engines.composition.aerial_perspective import AerialPerspective
from airlight.errors import FileError
from airlight.kernel.lanes import LANES


def test_textures_hold_the_tables(aerial: AerialPerspective, tmp_path: Path) -> None:
    manifest = write_aerial(tmp_path / "air", aerial, {"planet": "Earth"})
    about = json.loads(manifest.read_text(encoding="utf-8"))
    assert about["planet"] == "Earth"
    assert about["sun_zenith_deg"] == 75.0
    for name, one in about["textures"].items():
        texels = np.frombuffer((manifest.parent / f"{name}.bin").read_bytes(), "<f2")
        texels = texels.reshape(one["height"] * one["width"], 4)[: one["texels"]]
        kept = getattr(aerial.tables, name).reshape(-1, LANES)[:, :4]
        assert_array_equal(texels.astype(np.float32), kept)
        assert np.isfinite(kept).all()
    # again, in its place; nothing else is left beside
    write_aerial(tmp_path / "air", aerial)
    assert [one.name for one in tmp_path.iterdir()] == ["air"]


def test_other_files_are_not_overwritten(aerial: AerialPerspective, tmp_path: Path) -> None:
    (tmp_path / "letter.txt").write_text("Dear")
    with pytest.raises(FileError, match=r"holds .*, but no manifest"):
        write_aerial(tmp_path, aerial)
    (tmp_path / "manifest.json").write_text('{"format": "airlight tables 1"}')
    with pytest.raises(FileError, match="is not a manifest of the format 'airlight aerial"):
        write_aerial(tmp_path, aerial)


def test_the_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = tmp_path / "air"
    quick = ["--wavelengths=rgb", "--quality=preview", "--farthest=1km"]
    wanted = ["aerial", "earth-atmosphere-plus", "--sun-zenith=80", "-o", str(folder), *quick]
    assert main(wanted) == 0
    assert "95 % within" in capsys.readouterr().out
    about = json.loads((folder / "manifest.json").read_text(encoding="utf-8"))
    assert about["sun_zenith_deg"] == 80.0
    assert about["altitude_m"] == 2.0
    assert (folder / "air.wgsl").is_file()
    assert main([*wanted, "--nearest=900m"]) == 2
    assert "farthest is 1000.0; allowed: twice the nearest" in capsys.readouterr().err
