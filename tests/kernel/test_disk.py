"""Results on disk: complete or absent."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from airlight import ParameterError, load_planet, replace, solve
from airlight.kernel import disk as cache
from airlight.kernel import large_arrays
from airlight.planets import Planet

ARRAYS = {"field": np.arange(24, dtype=np.float32).reshape(2, 3, 4), "counts": np.array([4, 7])}


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(cache, "cache_folder", lambda: tmp_path)
    return tmp_path / "solutions"


def test_what_is_saved_is_loaded_bit_for_bit(folder: Path) -> None:
    cache.save("abc", ARRAYS)
    loaded = cache.load("abc")
    assert loaded is not None
    assert set(loaded) == set(ARRAYS)
    for name, array in ARRAYS.items():
        assert_array_equal(loaded[name], array, strict=True)
    assert cache.load("abd") is None
    assert [file.name for file in folder.iterdir()] == ["abc.npz"]


@pytest.mark.parametrize("part", [0.0, 0.01, 0.3, 0.9, 0.999])
def test_a_truncated_file_counts_as_none(part: float, folder: Path) -> None:
    cache.save("abc", ARRAYS)
    file = folder / "abc.npz"
    whole = file.read_bytes()
    file.write_bytes(whole[: int(part * len(whole))])
    assert cache.load("abc") is None
    cache.save("abc", ARRAYS)
    assert cache.load("abc") is not None


def test_one_flipped_bit_in_the_data_counts_as_none(folder: Path) -> None:
    # The checksum of the array covers every byte of it.
    cache.save("abc", ARRAYS)
    file = folder / "abc.npz"
    whole = bytearray(file.read_bytes())
    at = whole.index(ARRAYS["field"].tobytes()) + 17
    whole[at] ^= 1
    file.write_bytes(whole)
    assert cache.load("abc") is None


@pytest.mark.parametrize(
    "content", [b"", b"not a zip file", b"PK\x05\x06" + bytes(18), bytes(4096)]
)
def test_a_foreign_file_counts_as_none(content: bytes, folder: Path) -> None:
    folder.mkdir()
    (folder / "abc.npz").write_bytes(content)
    assert cache.load("abc") is None


def test_a_folder_in_the_files_place_counts_as_none(folder: Path) -> None:
    (folder / "abc.npz").mkdir(parents=True)
    assert cache.load("abc") is None
    cache.save("abc", ARRAYS)
    assert [file.name for file in folder.iterdir()] == ["abc.npz"]


def test_a_file_under_another_key_counts_as_none(folder: Path) -> None:
    cache.save("abc", ARRAYS)
    (folder / "abc.npz").rename(folder / "abd.npz")
    assert cache.load("abd") is None


def test_pickled_objects_are_never_opened(folder: Path) -> None:
    folder.mkdir()
    np.savez(folder / "abc.npz", key=np.array("abc"), field=np.array([{}], dtype=object))
    assert cache.load("abc") is None


def test_where_nothing_can_be_written_nothing_is_kept_and_nothing_said(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setattr(cache, "cache_folder", lambda: tmp_path / "file")
    cache.save("abc", ARRAYS)
    assert cache.load("abc") is None


@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), KeyboardInterrupt()])
def test_an_interrupted_write_leaves_no_part(
    error: BaseException, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    cache.save("old", ARRAYS)

    def broken(stream: object, **_: object) -> None:
        stream.write(b"half")  # type: ignore[attr-defined]
        raise error

    monkeypatch.setattr(np, "savez", broken)
    if isinstance(error, OSError):
        cache.save("abc", ARRAYS)
    else:
        with pytest.raises(KeyboardInterrupt):
            cache.save("abc", ARRAYS)
    assert [file.name for file in folder.iterdir()] == ["old.npz"]


def test_the_oldest_go_when_there_is_too_much(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    cache.save("a", ARRAYS)
    size = (folder / "a.npz").stat().st_size
    monkeypatch.setattr(cache, "LARGEST_TOTAL", int(2.5 * size))
    for age, key in ((300, "a"), (200, "b"), (100, "c")):
        cache.save(key, ARRAYS)
        os.utime(folder / f"{key}.npz", (1e9 - age, 1e9 - age))
    cache.save("d", ARRAYS)
    assert sorted(file.stem for file in folder.iterdir()) == ["c", "d"]


TEXELS = np.random.default_rng(5).integers(0, 256, 3 << 20, dtype=np.uint8)


@pytest.mark.parametrize("shape", [(-1,), (3, 1024, -1)])
def test_bytes_can_stay_in_their_file(shape: tuple[int, ...], folder: Path) -> None:
    cache.save("abc", {"texels": TEXELS.reshape(shape), **ARRAYS})
    loaded = cache.load("abc", in_place=True)
    assert loaded is not None
    assert set(loaded) == {"texels", *ARRAYS}
    assert_array_equal(loaded["texels"], TEXELS.reshape(shape), strict=True)
    assert_array_equal(loaded["field"], ARRAYS["field"], strict=True)
    assert type(loaded["texels"]) is np.ndarray
    assert loaded["texels"].flags.aligned
    assert loaded["texels"].flags.writeable


def test_what_is_written_to_bytes_in_place_is_not_kept(folder: Path) -> None:
    cache.save("abc", {"texels": TEXELS})
    first = cache.load("abc", in_place=True)
    assert first is not None
    first["texels"][:] = 0
    second = cache.load("abc", in_place=True)
    assert second is not None
    assert_array_equal(second["texels"], TEXELS)


def test_bytes_in_place_outlive_their_file(folder: Path) -> None:
    cache.save("abc", {"texels": TEXELS})
    loaded = cache.load("abc", in_place=True)
    assert loaded is not None
    cache.save("abc", {"texels": TEXELS[::-1].copy()})
    assert_array_equal(loaded["texels"], TEXELS)
    (folder / "abc.npz").unlink()
    assert_array_equal(loaded["texels"], TEXELS)


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="reads what Linux says")
def test_bytes_in_place_take_no_memory_until_they_are_read(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def resident() -> int:
        text = Path("/proc/self/status").read_text()
        return 1024 * int(text.split("RssFile:")[1].split()[0])

    monkeypatch.setattr(large_arrays, "_RESIDENT", 1)
    texels = np.tile(TEXELS, 8)
    cache.save("abc", {"texels": texels})
    before = resident()
    loaded = cache.load("abc", in_place=True)
    assert loaded is not None
    assert resident() - before < texels.nbytes // 8
    assert_array_equal(loaded["texels"], texels)
    assert resident() - before > texels.nbytes // 2
    large_arrays.release(loaded["texels"])
    assert resident() - before < texels.nbytes // 8


@pytest.mark.parametrize("harm", [0.0, 0.01, 0.9, 0.999, "bit", "name", "header"])
def test_damaged_bytes_are_not_read_in_place(harm: float | str, folder: Path) -> None:
    cache.save("abc", {"texels": TEXELS})
    file = folder / "abc.npz"
    whole = bytearray(file.read_bytes())
    at = whole.index(TEXELS[:64].tobytes())
    if isinstance(harm, float):
        whole = whole[: int(harm * len(whole))]
    elif harm == "bit":
        whole[at + 2_000_000] ^= 1
    elif harm == "name":
        whole[whole.rindex(b"PK\x03\x04", 0, at) + 26] ^= 1  # length of the member's name
    else:
        whole[at - 100] ^= 1
    file.write_bytes(whole)
    assert cache.load("abc", in_place=True) is None


def test_arrays_of_another_folder_are_kept_apart(folder: Path) -> None:
    cache.save("abc", ARRAYS, "others")
    assert cache.load("abc") is None
    assert cache.load("abc", "others") is not None
    assert [file.name for file in (folder.parent / "others").iterdir()] == ["abc.npz"]


@pytest.fixture
def planet(reference_earth: Callable[..., Planet]) -> Planet:
    return reference_earth(albedo=0.1, aerosol=None)


def sky(planet: Planet, **options: object) -> tuple[float, np.ndarray]:
    """Time of the solution (0 from the cache) [s], and some of its radiances."""
    solution = solve(planet, [550.0], "preview", **options)  # type: ignore[arg-type]
    views = np.linspace(0.0, 180.0, 19)
    radiance = solution.radiance(altitude=1e3, sun_zenith=70.0, view_zenith=views, azimuth=30.0)
    return solution.report.seconds, radiance.values


def test_a_second_solve_comes_from_disk_and_is_the_same_bit_for_bit(
    planet: Planet, folder: Path
) -> None:
    first_seconds, first = sky(planet)
    second_seconds, second = sky(planet)
    assert first_seconds > 0.0 == second_seconds
    assert_array_equal(first, second)
    never_seconds, _ = sky(planet, cache=False)
    assert never_seconds > 0.0
    assert len(list(folder.iterdir())) == 1


@pytest.mark.parametrize("harm", ["truncated", "foreign arrays", "wrong shape", "not finite"])
def test_a_solution_that_is_damaged_is_solved_again(
    harm: str, planet: Planet, folder: Path
) -> None:
    _, first = sky(planet)
    (file,) = folder.iterdir()
    if harm == "truncated":
        file.write_bytes(file.read_bytes()[:-1000])
    else:
        arrays = cache.load(file.stem)
        assert arrays is not None
        if harm == "foreign arrays":
            arrays = {"x": np.zeros(3)}
        elif harm == "wrong shape":
            arrays["field"] = arrays["field"][1:]
        else:
            arrays["field"] = np.full_like(arrays["field"], np.nan)
        cache.save(file.stem, arrays)
    seconds, again = sky(planet)
    assert seconds > 0.0
    assert_array_equal(first, again)
    assert sky(planet)[0] == 0.0


def test_whatever_changes_the_light_changes_the_key(planet: Planet, folder: Path) -> None:
    # Each of these is another planet or another question: none may be answered from disk.
    sky(planet)
    air = planet.constituents[0]
    others = [
        replace(planet, top_radius=6461e3),
        replace(planet, ground=replace(planet.ground, albedo=0.1000001)),
        replace(planet, star=replace(planet.star, angular_radius=0.1)),
        replace(planet, constituents=planet.constituents[:1]),
        replace(
            planet,
            constituents=(replace(air, absorption=1e-9), *planet.constituents[1:]),
        ),
    ]
    for number, other in enumerate(others):
        assert sky(other)[0] > 0.0
        assert len(list(folder.iterdir())) == number + 2
    solve(planet, [551.0], "preview")
    solve(planet, [550.0], "default")
    assert len(list(folder.iterdir())) == len(others) + 3


def test_an_unwritable_folder_does_not_stop_a_solve(
    planet: Planet, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setattr(cache, "cache_folder", lambda: tmp_path / "file")
    first, second = sky(planet), sky(planet)
    assert first[0] > 0.0
    assert second[0] > 0.0
    assert_array_equal(first[1], second[1])


def test_a_refused_question_leaves_nothing(folder: Path) -> None:
    with pytest.raises(ParameterError):
        solve(load_planet("earth"), [550.0], "excellent")
    assert not folder.exists()
