"""Maps on disk: decoded once, and again when a picture or the code changes."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from PIL import Image

from airlight.errors import FileError
from airlight.kernel import disk
from airlight.kernel.large_arrays import FileMemory
from airlight.scene import ground_overlay as overlays
from airlight.scene import map_cache, surface_map
from airlight.scene.map_levels import Levels

HEIGHT = 256


@pytest.fixture(autouse=True)
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Folder of the cache, for maps of any size."""
    monkeypatch.setattr(disk, "cache_folder", lambda: tmp_path / "cache")
    monkeypatch.setattr(map_cache, "SMALLEST", 1)
    return tmp_path / "cache" / "maps"


@pytest.fixture
def decoded(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Names of the pictures that were decoded."""
    found: list[str] = []

    def counting(file: Path, real: Callable[..., object], **options: bool) -> object:
        found.append(file.name)
        return real(file, **options)

    for module in (surface_map, overlays):
        real = module.map_pixels
        monkeypatch.setattr(
            module, "map_pixels", lambda file, real=real, **options: counting(file, real, **options)
        )
    return found


def picture(folder: Path, name: str, seed: int, channels: int = 3) -> Path:
    """Picture of noise."""
    shape = (HEIGHT, 2 * HEIGHT, 3)[: 2 if channels == 1 else 3]
    texels = np.random.default_rng(seed).integers(0, 256, shape, dtype=np.uint8)
    Image.fromarray(texels).save(folder / name)
    return folder / name


def loaded(name: Path) -> surface_map.SurfaceMap:
    """Load a map as a new process would."""
    return surface_map.surface_map.__wrapped__(str(name))


def overlay(*names: Path | None) -> surface_map.SurfaceMap:
    """Load an overlay as a new process would."""
    found = overlays.ground_overlay.__wrapped__(*(one and str(one) for one in names))
    assert found is not None
    return found


def test_a_map_is_decoded_once(tmp_path: Path, cache: Path, decoded: list[str]) -> None:
    file = picture(tmp_path, "map.png", 1)
    picture(tmp_path, "map-water.png", 2, channels=1)
    first = loaded(file)
    assert decoded == ["map.png", "map-water.png"]
    second = loaded(file)
    assert decoded == ["map.png", "map-water.png"]
    assert len(list(cache.iterdir())) == 1
    made = surface_map._decoded(str(file), file, tmp_path / "map-water.png")
    for one in (first, second):
        assert isinstance(one.flat.base, FileMemory)
        assert (one.rows, one.columns) == made[:2]
        assert_array_equal(one.flat, made.flat)


@pytest.mark.parametrize("change", ["map", "water", "no water", "code", "damage"])
def test_whatever_changes_a_map_has_it_decoded_again(
    change: str, tmp_path: Path, cache: Path, decoded: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    file = picture(tmp_path, "map.png", 1)
    water = picture(tmp_path, "map-water.png", 2, channels=1)
    before = loaded(file).flat.copy()
    if change == "map":
        picture(tmp_path, "map.png", 3)
    elif change == "water":
        picture(tmp_path, "map-water.png", 3, channels=1)
    elif change == "no water":
        water.unlink()
    elif change == "code":
        monkeypatch.setattr(map_cache, "fingerprint", lambda _: "another")
    else:
        (kept,) = cache.iterdir()
        kept.write_bytes(kept.read_bytes()[:-1000])
    after = loaded(file).flat
    assert decoded.count("map.png") == 2
    assert (before.tobytes() == after.tobytes()) == (change in ("code", "damage"))


def test_overlays_are_kept_by_both_pictures(tmp_path: Path, decoded: list[str]) -> None:
    lights, clouds = (picture(tmp_path, f"{n}.png", n, channels=1) for n in (1, 2))
    ways = [(lights, None), (None, lights), (lights, clouds), (clouds, lights)]
    first = [overlay(*way).flat.copy() for way in ways]
    count = len(decoded)
    second = [overlay(*way).flat for way in ways]
    for one, other in zip(first, second, strict=True):
        assert_array_equal(one, other)
    assert len({one.tobytes() for one in first}) == len(ways)
    # Clouds are read by another module, which counts nothing here.
    assert len(decoded) == count


def test_small_maps_are_not_kept(
    tmp_path: Path, cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(map_cache, "SMALLEST", 1 << 22)
    file = picture(tmp_path, "map.png", 1)
    assert_array_equal(loaded(file).flat, loaded(file).flat)
    assert not cache.exists()


def test_without_a_place_for_it_a_map_is_in_memory(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = picture(tmp_path, "map.png", 1)
    (tmp_path / "taken").write_text("in the way")
    monkeypatch.setattr(disk, "cache_folder", lambda: tmp_path / "taken")
    assert loaded(file).flat.base is None


@pytest.mark.parametrize("name", ["missing.png", "folder", "text.png"])
def test_pictures_that_cannot_be_read_are_refused_as_ever(
    name: str, tmp_path: Path, cache: Path
) -> None:
    (tmp_path / "folder").mkdir()
    (tmp_path / "text.png").write_text("no picture")
    with pytest.raises(FileError, match=name):
        loaded(tmp_path / name)
    assert not cache.exists()


def test_foreign_arrays_count_as_none(tmp_path: Path, decoded: list[str]) -> None:
    file = picture(tmp_path, "map.png", 1)
    files = (file, None)
    key = map_cache._key(Path(surface_map.__file__), files)
    disk.save(key, {"size": np.array([1, 2])}, "maps")
    wanted = Levels(1, 2, np.arange(8, dtype=np.uint8))
    found = map_cache.cached_levels(Path(surface_map.__file__), files, lambda: wanted)
    assert found[:2] == (1, 2)
    assert_array_equal(found.flat, wanted.flat)
