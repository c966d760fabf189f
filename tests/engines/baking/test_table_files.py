"""Tables on disk: whole, checked, and the same look-ups when read back."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from airlight.engines.baking.bake import Baked, bake
from airlight.engines.baking.table_errors import random_positions
from airlight.engines.baking.table_files import FORMAT, load_table, load_tables, write_tables
from airlight.errors import FileError, ParameterError
from airlight.files.atomic_folder import check_folder
from airlight.image.exr import read_exr_channels, write_exr_channels
from airlight.planets import Planet

CHOICES: dict[str, dict[str, Any]] = {
    "bruneton": {"size": (5, 8, 6, 4), "precision": "half"},
    "combined": {"size": (5, 8, 6, 4), "packing": "combined"},
    "plus": {"layout": "atmosphere-plus", "size": (5, 9, 7)},
    "plane": {
        "layout": "atmosphere-plus", "size": (5, 9, 7), "packing": "phase-included",
        "mapping": "power", "azimuth": 30.0,
    },
}  # fmt: skip


@pytest.fixture(scope="module")
def earth(solved: Callable[..., Any], reference_earth: Callable[..., Planet]) -> Any:
    return solved(reference_earth(albedo=0.3), quality="preview")


@pytest.fixture(scope="module")
def all_baked(earth: Any) -> dict[str, Baked]:
    return {name: bake(earth, points=60, **choice) for name, choice in CHOICES.items()}


@pytest.fixture
def written(all_baked: dict[str, Baked], tmp_path: Path) -> Path:
    return write_tables(tmp_path / "out", all_baked["bruneton"])


@pytest.mark.parametrize("name", CHOICES)
def test_look_ups_are_the_same_bit_by_bit_after_reading_back(
    name: str, all_baked: dict[str, Baked], earth: Any, tmp_path: Path
) -> None:
    # Nothing is computed anew: same values, same layout.
    baked = all_baked[name]
    manifest = write_tables(tmp_path / name, baked)
    back = load_tables(manifest)
    positions = random_positions(earth.medium, 300, 3)
    for key, table in baked.tables.items():
        again = back.tables[key]
        assert again.values.dtype == table.values.dtype
        assert_array_equal(again.values, table.values)
        assert (again.layout, again.unit, again.scale) == (table.layout, table.unit, table.scale)
        assert_array_equal(again.at(positions), table.at(positions))
        assert_array_equal(load_table(manifest.parent, key).at(positions), table.at(positions))
    assert_array_equal(
        back.light.relative_radiance(positions), baked.light.relative_radiance(positions)
    )
    assert back.errors == baked.errors
    assert back.about == baked.about


@pytest.mark.parametrize("name", CHOICES)
def test_exr_holds_the_texture_in_memory_order(
    name: str, all_baked: dict[str, Baked], tmp_path: Path
) -> None:
    # Bruneton's width is nu and mu_s, mu_s running fastest; Atmosphere Plus: i = x + y w + z w h.
    baked = all_baked[name]
    folder = write_tables(tmp_path / name, baked).parent
    table = baked.tables["scattering"]
    red = read_exr_channels(folder / "scattering.exr")["R"].ravel()
    assert red.dtype == table.values.dtype
    shape = table.layout.shape
    for index in np.random.default_rng(2).integers(0, red.size, 50):
        if len(shape) == 4:
            _, views, suns, angles = shape
            x, y, z = (
                index % (suns * angles),
                index // (suns * angles) % views,
                index // (suns * angles * views),
            )
            value = table.values[z, y, x % suns, x // suns, 0]
        else:
            altitudes, views, _ = shape
            x, y, z = index % altitudes, index // altitudes % views, index // (altitudes * views)
            value = table.values[x, y, z, 0]
        assert red[index] == value


def test_manifest_says_what_an_engine_needs(written: Path, earth: Any) -> None:
    # Axes, mappings, unit, checksum and error, and only files that are there.
    said = json.loads(written.read_text(encoding="utf-8"))
    assert said["planet"] == "reference"
    assert said["fingerprint"] == earth.medium.fingerprint()
    assert said["wavelengths_nm"] == [680.0, 550.0, 440.0]
    assert "moments" in said["solver"]
    assert "median" in said["errors"]["sky"]
    table = said["tables"]["scattering"]
    assert [axis["name"] for axis in table["axes"]] == ["r", "mu", "mu_s", "nu"]
    assert table["axes"][2]["parameters"]["lowest_mu_s"] < -0.3
    assert table["unit"] == "1"
    assert table["texture"]["width"] == 4 * 6
    listed = {"manifest.json"}
    for one in (*said["tables"].values(), said["light"], said["look_up"]):
        for name, of in one["files"].items():
            data = (written.parent / name).read_bytes()
            assert hashlib.sha256(data).hexdigest() == of["sha256"]
            assert len(data) == of["bytes"]
            listed.add(name)
    assert {file.name for file in written.parent.iterdir()} == listed
    assert said["reading"]["value"].startswith("scale * stored")
    assert {"look_up.glsl", "look_up.wgsl", "look_up.hlsl", "test_vectors.json"} <= listed
    assert said["light"]["phase_functions"][0] == "smooth"


@pytest.mark.parametrize("file", ["scattering.npz", "transmittance.npz", "phase-functions.npz"])
def test_a_damaged_file_is_noticed(written: Path, file: str) -> None:
    # One bit turned: the checksum differs.
    path = written.parent / file
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 1
    path.write_bytes(data)
    with pytest.raises(FileError, match=rf"{file}: is damaged: its SHA-256"):
        load_tables(written)


def test_what_is_missing_or_foreign_is_named(written: Path, tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match="table is 'clouds'; allowed: transmittance"):
        load_table(written, "clouds")
    (written.parent / "irradiance.npz").unlink()
    with pytest.raises(FileError, match=r"irradiance\.npz: cannot be read"):
        load_tables(written)
    other = tmp_path / "other.json"
    for text in ("{}", "[1, 2]", "{", '{"format": "airlight tables 1"}', "\udcff"):
        other.write_bytes(text.encode("utf-8", "surrogateescape"))
        with pytest.raises(FileError, match=r"other\.json"):
            load_tables(other)


@pytest.mark.parametrize("lost", ["layout", "channels", "scale", "files", "unit"])
def test_a_manifest_without_a_field_is_one_clear_line(written: Path, lost: str) -> None:
    said = json.loads(written.read_text(encoding="utf-8"))
    del said["tables"]["scattering"][lost]
    written.write_text(json.dumps(said), encoding="utf-8")
    with pytest.raises(FileError, match=lost) as error:
        load_tables(written)
    assert "\n" not in str(error.value)


def test_tables_replace_tables_and_nothing_else(
    all_baked: dict[str, Baked], tmp_path: Path
) -> None:
    # The second bake has other files; what belonged to the first is gone, a stranger's stays.
    folder = tmp_path / "out"
    write_tables(folder, all_baked["bruneton"])
    (folder / "notes.txt").write_text("mine")
    write_tables(folder, all_baked["plus"])
    names = {file.name for file in folder.iterdir()}
    assert "single-aerosol.npz" not in names
    assert {"notes.txt", "scattering.npz", "manifest.json"} <= names
    assert load_tables(folder).light.packing == "rgba"
    assert [file.name for file in tmp_path.iterdir()] == ["out"]


def test_a_folder_of_other_files_is_left_alone(all_baked: dict[str, Baked], tmp_path: Path) -> None:
    (tmp_path / "scattering.npz").write_text("mine")
    with pytest.raises(FileError, match="name a new or empty folder"):
        write_tables(tmp_path, all_baked["plus"])
    assert (tmp_path / "scattering.npz").read_text() == "mine"
    with pytest.raises(FileError, match="is a file"):
        check_folder(tmp_path / "scattering.npz", FORMAT)
    with pytest.raises(FileError, match="there is no folder"):
        check_folder(tmp_path / "a" / "b", FORMAT)


def test_nothing_is_left_behind_when_writing_fails(
    all_baked: dict[str, Baked], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Files appear together: an error in the last of them leaves no folder.
    from airlight.engines.baking import table_files

    def full(*arguments: Any) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(table_files, "write_manifest", full)
    with pytest.raises(FileError, match="No space left"):
        write_tables(tmp_path / "out", all_baked["plus"])
    assert list(tmp_path.iterdir()) == []


def test_channels_of_one_kind_only(tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match="channels"):
        write_exr_channels(tmp_path / "x.exr", {"R": np.zeros((2, 2)), "G": np.zeros((2, 2))})
    with pytest.raises(ParameterError, match="channels"):
        write_exr_channels(tmp_path / "x.exr", {})
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(FileError, match="cannot be read"):
        read_exr_channels(tmp_path / "x.exr")
