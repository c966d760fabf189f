"""Large arrays are kept in files without names, and take little memory in use."""

from __future__ import annotations

import ctypes
import mmap
from pathlib import Path

import numpy as np
import pytest

from airlight.errors import CostError
from airlight.kernel import large_arrays, memory
from airlight.kernel.large_arrays import bands, release, zeros

needs_files = pytest.mark.skipif(
    large_arrays.free_disk() == 0.0, reason="a system that cannot take such memory back"
)


@pytest.fixture
def large(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Cache's folder, where all arrays of a megabyte are large."""
    monkeypatch.setenv("AIRLIGHT_CACHE", str(tmp_path))
    monkeypatch.setattr(large_arrays, "LARGE", 1 << 20)
    return tmp_path


def resident_files() -> int:
    """Memory of this process that is of files. [byte]"""
    text = Path("/proc/self/status").read_text()
    return 1024 * int(text.split("RssFile:")[1].split()[0])


@needs_files
def test_a_large_array_is_in_a_file_that_has_no_name(large: Path) -> None:
    array = zeros((512, 1024), np.float32)
    assert isinstance(array.base, mmap.mmap)
    assert type(array) is np.ndarray
    assert not array.any()
    assert list(large.iterdir()) == []
    assert zeros((512, 1), np.float32).base is None


@needs_files
@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="reads what Linux says")
def test_bands_leave_little_of_it_in_memory(large: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(large_arrays, "_RESIDENT", 1 << 22)
    monkeypatch.setattr(large_arrays, "_BAND", 1 << 20)
    array, peak = zeros((8192, 1024), np.float32), 0
    before = resident_files()
    for number, band in enumerate(bands(array)):
        band[:] = number + 1
        peak = max(peak, resident_files() - before)
    assert peak < array.nbytes // 3
    assert [band[0, 0] for band in bands(array)] == list(range(1, 33))
    kept = np.zeros((8192, 1024), np.float32)
    kept[:] = 1.0
    release(kept)  # has no file, and nothing happens to it
    assert kept.all()


def test_without_room_on_the_disk_it_is_in_memory(
    large: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(large_arrays, "free_disk", lambda: 1e6)
    assert zeros((512, 1024), np.float32).base is None


def test_a_large_picture_needs_memory_or_a_disk(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(memory, "free_memory", lambda: 1e9)
    monkeypatch.setattr(memory, "_of_process", lambda: float("inf"))
    monkeypatch.setattr(memory, "free_disk", lambda: 1e10)
    memory.check_drawn(8192, 8192)
    monkeypatch.setattr(memory, "free_disk", lambda: 1e9)
    with pytest.raises(CostError, match=r"8192x8192 pixels needs about 2\.1 GB of memory"):
        memory.check_drawn(8192, 8192)
    monkeypatch.setattr(memory, "free_disk", lambda: 1e10)
    monkeypatch.setattr(memory, "_of_process", lambda: 2e9)  # counts files, too
    with pytest.raises(CostError, match="needs about"):
        memory.check_drawn(8192, 8192)


@needs_files
def test_a_cache_that_cannot_be_written_leaves_it_in_memory(
    large: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("AIRLIGHT_CACHE", str(large / "file" / "below"))
    (large / "file").touch()
    assert zeros((512, 1024), np.float32).base is None
    monkeypatch.setenv("AIRLIGHT_CACHE", str(large / "not" / "yet"))
    assert zeros((512, 1024), np.float32).base is not None


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="reads what Linux says")
def test_memory_that_is_no_longer_used_is_given_back() -> None:
    # The last block is not freed: the C library keeps all memory below it.
    def resident() -> int:
        text = Path("/proc/self/status").read_text()
        return 1024 * int(text.split("RssAnon:")[1].split()[0])

    libc = ctypes.CDLL(None)
    if not hasattr(libc, "malloc_trim"):
        pytest.skip("another C library")
    libc.malloc.restype, libc.malloc.argtypes = ctypes.c_void_p, [ctypes.c_size_t]
    libc.free.argtypes = [ctypes.c_void_p]
    size, count = 100_000, 1000  # below the size that gets memory of its own
    blocks = [libc.malloc(size) for _ in range(count)]
    for block in blocks:
        ctypes.memset(block, 1, size)
    for block in blocks[:-1]:
        libc.free(block)
    held = resident()
    memory.give_back()
    assert held - resident() > 0.8 * size * count
    libc.free(blocks[-1])
