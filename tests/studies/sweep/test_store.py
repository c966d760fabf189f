"""Sweeps that come from elsewhere, are damaged, or written by two: one line, or computed again."""

from __future__ import annotations

import errno
import importlib
import json
import os
import pickle
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import xarray
from numpy.testing import assert_array_equal

from airlight.cli import main
from airlight.errors import CostError, FileError, ParameterError
from airlight.files.output_lock import output_lock
from airlight.kernel import memory
from airlight.studies.sweep import Grid, Swept, sweep
from airlight.studies.sweep import grid as grids
from airlight.studies.sweep import store as stores
from airlight.studies.sweep.store import SweepStore, size_on_disk
from airlight.studies.sweep.store_layout import MARKS, chunk_file, marks_file

pytest.importorskip("zarr")
sweeps = importlib.import_module("airlight.studies.sweep.sweep")  # whose name is a function's too


@pytest.fixture
def grid(monkeypatch: pytest.MonkeyPatch) -> Grid:
    """Grid of four blocks, of two suns and two views each."""
    monkeypatch.setattr(grids, "_BLOCK", 2 * 2 * 3)
    return Grid(
        planets=["earth-atmosphere-plus"], altitude=[0.0, 2e3], sun_zenith=[0.0, 45.0, 92.0],
        view_zenith=[0.0, 80.0], wavelengths=(680.0, 550.0, 440.0),
    )  # fmt: skip


def swept(grid: Grid, path: Path, **options: object) -> Swept:
    return sweep(grid, path, quality="preview", workers=1, **options)  # type: ignore[arg-type]


def files(path: Path) -> dict[str, bytes]:
    return {str(one.relative_to(path)): one.read_bytes() for one in path.rglob("*")
            if one.is_file()}  # fmt: skip


class Evil:
    """Object that creates a file when it is unpickled."""

    def __init__(self, file: Path) -> None:
        self.file = file

    def __reduce__(self) -> tuple:
        return (Path.touch, (self.file,))


# --- a group from elsewhere -------------------------------------------------------------------


def changed_field(field: str, value: object) -> Callable[[Path], None]:
    def change(file: Path) -> None:
        file.write_text(json.dumps({**json.loads(file.read_text()), field: value}))

    return change


def link(file: Path) -> None:
    file.unlink()
    file.symlink_to("/etc/hostname")


@pytest.mark.parametrize(
    ("name", "change", "line"),
    [
        ("radiance/.zarray", changed_field("dtype", "|O"), "dtype is '|O'; allowed: '<f4'"),
        ("radiance/.zarray", changed_field("compressor", {"id": "pickle"}), "compressor is {'id'"),
        ("radiance/.zarray", changed_field("filters", [{"id": "pickle"}]), "filters is [{'id'"),
        ("radiance/.zarray", changed_field("shape", [2**60]), "shape is [1152921504606846976]"),
        ("radiance/.zarray", changed_field("chunks", [1]), "chunks is [1]"),
        ("radiance/.zarray", changed_field("order", "F"), "order is 'F'; allowed: 'C'"),
        ("radiance/.zarray", changed_field("fill_value", 0), "fill_value is 0; allowed: 'NaN'"),
        ("radiance/.zarray", changed_field("codecs", []), "has the field 'codecs'"),
        ("radiance/.zattrs", changed_field("units", "W"), "units is 'W'; allowed: 'W m-2 sr-1"),
        ("planet/.zarray", changed_field("dtype", "|O"), "dtype is '|O'; allowed: '<U21'"),
        (f"{MARKS}/.zarray", changed_field("compressor", {"id": "pickle"}), "allowed: None"),
        (".zgroup", changed_field("zarr_format", 3), "zarr_format is 3; allowed: 2"),
        ("radiance/.zarray", lambda file: file.write_text("[" * 100_000), "is not valid JSON"),
        ("radiance/.zarray", lambda file: file.write_text("[]"), "is not a JSON object"),
        ("radiance/.zarray", lambda file: file.write_bytes(b"\xff\xfe"), "is not valid JSON"),
        ("radiance/.zarray", lambda file: os.truncate(file, 1 << 40), "is too large"),
        ("radiance/.zarray", Path.unlink, "radiance/.zarray cannot be read: No such file"),
        (".zattrs", lambda file: file.write_text("{"), ".zattrs is not valid JSON"),
        (".zattrs", Path.unlink, ".zattrs cannot be read"),
        ("radiance", shutil.rmtree, "radiance cannot be read"),
        ("radiance/.zarray", link, "radiance/.zarray is a link"),
        ("radiance/0.0.0.0.0.0", link, "radiance/0.0.0.0.0.0 is a link"),
        ("radiance/pipe", os.mkfifo, "radiance/pipe is not a file of a sweep"),
        ("zarr.json", lambda file: file.write_text("{}"), "zarr.json is not a file of a sweep"),
    ],
)
def test_metadata_that_airlight_does_not_write_are_one_line(
    grid: Grid, tmp_path: Path, name: str, change: Callable[[Path], None], line: str
) -> None:
    # the metadata of a grid are known before anything is read
    path = tmp_path / "a.zarr"
    store = SweepStore(path, grid, {})
    store.write((0, 0, 0, 0), np.ones((1, 2, 2, 1, 3), np.float32), 7)
    change(path / name)
    with pytest.raises(FileError) as refusal:
        swept(grid, path)
    assert line in str(refusal.value)
    assert "remove it, or choose another folder" in str(refusal.value)
    assert "\n" not in str(refusal.value)


def test_no_code_of_a_received_group_is_executed(
    grid: Grid, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # a pickle that creates a file, and the setting by which each numcodecs unpickles it
    import numcodecs.pickles

    monkeypatch.setattr(numcodecs.pickles, "ALLOW_UNSAFE_PICKLE_DECODE", True)
    path, trace = tmp_path / "a.zarr", tmp_path / "executed"
    swept(grid, path)
    for array, chunk in (("radiance", "0.0.0.0.0.0"), ("planet", "0"), (MARKS, "0.0.0.0.0")):
        kept = files(path)
        changed_field("dtype", "|O")(path / array / ".zarray")
        changed_field("compressor", {"id": "pickle", "protocol": 5})(path / array / ".zarray")
        (path / array / chunk).write_bytes(pickle.dumps(Evil(trace)))
        with pytest.raises(FileError, match="allowed"):
            swept(grid, path)
        (path / array / ".zarray").write_bytes(kept[f"{array}/.zarray"])
        swept(grid, path)
        assert files(path) == kept
    assert not trace.exists()
    assert pickle.loads(pickle.dumps(Evil(trace))) is None  # the pickle does what it should
    assert trace.exists()


def test_zarr_reads_what_is_written(grid: Grid, tmp_path: Path) -> None:
    # a second method: Zarr's and xarray's own readers, with and without consolidated metadata
    path = tmp_path / "a.zarr"
    store = SweepStore(path, grid, {"settings": "degree=4"})
    whole = np.arange(2 * 3 * 2 * 3, dtype=np.float32).reshape(1, 2, 3, 2, 1, 3)
    for block in np.ndindex(*grid.blocks):
        store.write(block, whole[grid.region(block)][None], 7)
    for consolidated in (True, False):
        with xarray.open_zarr(path, consolidated=consolidated) as data:
            assert_array_equal(data.radiance.values, whole)
            assert_array_equal(data.sun_zenith.values, grid.sun_zenith)
            assert data.planet.item() == "earth-atmosphere-plus"
            assert data.settings == "degree=4"


# --- damage -----------------------------------------------------------------------------------


def flip(file: Path) -> None:
    content = bytearray(file.read_bytes())
    content[len(content) // 2] ^= 1
    file.write_bytes(content)


@pytest.mark.parametrize(
    "damage", [flip, lambda file: os.truncate(file, 20), lambda file: os.truncate(file, 0),
               lambda file: os.truncate(file, 1 << 40), Path.unlink],
    ids=["flipped", "truncated", "emptied", "grown", "deleted"],
)  # fmt: skip
@pytest.mark.parametrize("stokes", [False, True])
def test_damaged_blocks_are_computed_again(
    grid: Grid, tmp_path: Path, damage: Callable[[Path], None], stokes: bool
) -> None:
    # the store as it was before
    path, lines = tmp_path / "a.zarr", []
    swept(grid, path, stokes=stokes)
    before = files(path)
    blocks = list(np.ndindex(*grid.blocks))
    damage(path / chunk_file("radiance", blocks[1]))
    damage(path / chunk_file("dolp" if stokes else "radiance", blocks[2]))
    done = swept(grid, path, stokes=stokes, on_message=lines.append)
    assert (done.computed, done.kept, done.damaged) == (2, 2, 2)
    assert lines == ["2 of 4 blocks are damaged and will be recomputed"]
    assert files(path) == before
    assert swept(grid, path, stokes=stokes).kept == 4


@pytest.mark.parametrize("seed", range(8))
def test_any_byte_of_a_store_may_be_damaged(grid: Grid, tmp_path: Path, seed: int) -> None:
    # each file in turn: the store is again what it was, or a line says what is wrong
    path, random = tmp_path / "a.zarr", np.random.default_rng(seed)
    swept(grid, path)
    before = files(path)
    for name, content in before.items():
        changed = bytearray(content)
        changed[random.integers(len(content))] ^= 1 << int(random.integers(8))
        (path / name).write_bytes(changed)
        try:
            swept(grid, path)
        except FileError as error:
            assert "\n" not in str(error)
            assert name.rpartition("/")[2] in (".zarray", ".zattrs", ".zgroup")
            (path / name).write_bytes(content)
        assert files(path) == before, name


def test_a_damaged_mark_or_axis_is_written_again(grid: Grid, tmp_path: Path) -> None:
    # the store as it was before
    path, lines = tmp_path / "a.zarr", []
    swept(grid, path)
    before = files(path)
    flip(path / marks_file((0,)))
    flip(path / "sun_zenith/0")
    assert swept(grid, path, on_message=lines.append).damaged == 1
    assert lines == ["the axis sun_zenith was damaged and is written again",
                     "1 of 4 blocks are damaged and will be recomputed"]  # fmt: skip
    assert files(path) == before


# --- nothing is left, and one writer ----------------------------------------------------------


def test_a_failed_sweep_leaves_nothing(grid: Grid, tmp_path: Path) -> None:
    # a key that no planet has, and an error of a computation
    typo = Grid(planets=["mars-rayleigh"], vary={"ground.albdo": [0.1]}, sun_zenith=[10.0],
                view_zenith=[0.0], wavelengths=[550.0])  # fmt: skip
    with pytest.raises(ParameterError, match="albdo"):
        swept(typo, tmp_path / "a.zarr")

    def stop(done: int, total: int, message: str) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        swept(grid, tmp_path / "a.zarr", progress=stop)
    assert list(tmp_path.iterdir()) == []


def test_a_varied_key_cannot_name_a_folder_elsewhere(tmp_path: Path) -> None:
    # keys of planet files may be quoted, with any letters
    grid = Grid(planets=["earth"], vary={'"../../note".x': [1, 2]}, sun_zenith=[10.0],
                view_zenith=[0.0], wavelengths=[550.0])  # fmt: skip
    with pytest.raises(ParameterError, match="without a slash"):
        SweepStore(tmp_path / "a.zarr", grid, {})


def test_a_typo_on_the_command_line_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    # issue 36: it left a store that then held the sweep of another grid
    monkeypatch.chdir(tmp_path)
    words = ["sweep", "earth-atmosphere-plus", "--sun-zenith", "0", "--view-zenith", "0",
             "--quality", "preview", "-o", "a.zarr"]  # fmt: skip
    assert main([*words, "--vary", "ground.albdo=0.1,0.2"]) == 2
    assert list(tmp_path.iterdir()) == []
    assert main([*words, "--vary", "ground.albedo=0.1,0.2"]) == 0
    assert [file.name for file in tmp_path.iterdir()] == ["a.zarr"]


def test_a_second_writer_is_refused_in_one_line(grid: Grid, tmp_path: Path) -> None:
    # whether the store is there or not; and what the first writes is whole
    path = tmp_path / "a.zarr"
    refused = []

    def second(done: int, total: int, message: str) -> None:
        with pytest.raises(FileError, match="is being written by another process") as refusal:
            swept(grid, path)
        refused.append((message, "\n" in str(refusal.value)))

    assert swept(grid, path, progress=second).computed == 4
    assert {message for message, _ in refused} == {"solving", "radiances"}
    assert not any(several for _, several in refused)
    assert swept(grid, path).kept == 4
    assert [file.name for file in tmp_path.iterdir()] == ["a.zarr"]


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no kill -9")
def test_a_killed_sweep_holds_no_lock_and_what_it_left_goes(grid: Grid, tmp_path: Path) -> None:
    # the operating system releases locks; a file of somebody else stays
    path = tmp_path / "a.zarr"
    code = """if True:
        import os, sys
        from pathlib import Path
        from airlight.files.output_lock import hidden_file, output_lock
        path = Path(sys.argv[1])
        with output_lock(path):
            part = hidden_file(path, "part")
            (part / "radiance").mkdir(parents=True)
            os.kill(os.getpid(), 9)
    """
    assert subprocess.run([sys.executable, "-c", code, path], check=False).returncode == -9
    assert len(list(tmp_path.iterdir())) == 2
    (tmp_path / ".0123456789abcdef.part").touch()
    assert swept(grid, path).computed == 4
    assert sorted(file.name for file in tmp_path.iterdir()) == [".0123456789abcdef.part", "a.zarr"]


# --- before the cost --------------------------------------------------------------------------


def test_a_full_disk_is_one_line_and_what_was_written_is_kept(
    grid: Grid, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # a disk that is full after so many files of blocks
    path, write, left = tmp_path / "a.zarr", stores._put, [0]

    def full(file: Path, content: bytes) -> None:
        left[0] -= 1
        if left[0] < 0:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        write(file, content)

    monkeypatch.setattr(stores, "_put", full)
    with pytest.raises(FileError, match=r"a\.zarr: cannot be written: No space left") as refusal:
        swept(grid, path)
    assert "kept" not in str(refusal.value)
    assert list(tmp_path.iterdir()) == []
    left[0] = 5  # two files each of two blocks, and one of a third
    with pytest.raises(FileError, match="No space left on device; 2 blocks are kept, and"):
        swept(grid, path)
    left[0] = 1000
    done = swept(grid, path)
    assert (done.computed, done.kept, done.damaged) == (2, 2, 0)
    assert not list(path.rglob("*.part"))


def test_a_sweep_that_the_disk_cannot_hold_is_refused_at_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # 10^4 altitudes by 1801 suns by 721 views by 8 azimuths by 4 wavelengths of four bytes
    grid = Grid(
        planets=["mars-rayleigh"], altitude=range(10_000), sun_zenith=np.linspace(0, 180, 1801),
        view_zenith=np.linspace(0, 180, 721), azimuth=range(8), wavelengths=[440, 550, 680, 700],
    )  # fmt: skip
    size = size_on_disk(grid, stokes=False)
    assert 1.66e12 < size < 1.9e12
    monkeypatch.setattr(stores.shutil, "disk_usage", lambda path: shutil._ntuple_diskusage(  # type: ignore[attr-defined]
        2e12, 1e12, 1e12))  # fmt: skip
    line = "needs up to 1.67 TB, and the disk has 1 TB free: choose fewer values, or another disk"
    with pytest.raises(FileError, match=line):
        swept(grid, tmp_path / "a.zarr")
    assert list(tmp_path.iterdir()) == []


def test_a_large_sweep_is_announced_and_one_that_memory_cannot_hold_refused(
    grid: Grid, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sweeps, "_LARGE", 1)
    lines: list[str] = []
    swept(grid, tmp_path / "a.zarr", on_message=lines.append)
    # four chunks, of one sector of 4096 bytes each
    assert "up to 16.4 kB, a sweep of 36 radiances in 4 blocks" in lines[0]
    monkeypatch.setattr(memory, "free_memory", lambda: 1e3)
    with pytest.raises(CostError, match="a sweep of 36 radiances in 4 blocks needs about"):
        swept(grid, tmp_path / "b.zarr")


@pytest.mark.skipif(not hasattr(os, "geteuid"), reason="permission bits are POSIX")
def test_a_closed_folder_is_refused_before_anything_is_solved(
    grid: Grid, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # as the system answers where a file system is mounted read-only, which holds for root too
    monkeypatch.setattr(sweeps, "opened_runner", None)
    monkeypatch.setattr(stores.os, "access", lambda *_: False)
    with pytest.raises(FileError, match="cannot be written to"):
        swept(grid, tmp_path / "a.zarr")


def test_the_lock_of_a_sweep_is_that_of_its_folder_through_a_link(
    grid: Grid, tmp_path: Path
) -> None:
    path, linked = tmp_path / "a.zarr", tmp_path / "b.zarr"
    swept(grid, path)
    linked.symlink_to(path)
    with output_lock(path), pytest.raises(FileError, match="is being written"):
        swept(grid, linked)
    assert swept(grid, linked).kept == 4
