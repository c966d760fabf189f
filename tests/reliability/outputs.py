"""Outputs that a later command goes on from, or shares: damaged, contested, among foreign files."""

from __future__ import annotations

import random
import shutil
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import xarray as xr
from PIL import Image
from processes import DAMAGES, begin, ended
from tally import Tally

#: Commands that keep finished parts of their output for the next run, and that output.
RESUMED: tuple[tuple[str, tuple[str, ...]], ...] = (
    ("s.zarr", ("sweep", "earth-openspace", "--vary", "ground.albedo=0:0.4:0.1", "--altitude",
                "0m,10km", "--sun-zenith", "0:80:20", "--view-zenith", "0:80:20", "--azimuth", "0",
                "--quality", "preview", "--wavelengths", "rgb", "-o", "s.zarr")),
    ("frames", ("animate", "earth-openspace", "-o", "frames", "--frames", "6", "--key",
                "view.altitude=2m,400km exponential", "--size", "64x36", "--quality", "preview")),
)  # fmt: skip
#: Modules that Python, Dask and Numba import early.
MODULES = (
    "signal", "types", "struct", "socket", "pickle", "selectors", "numba", "numpy", "threading",
    "logging", "json", "asyncio", "random", "site", "sitecustomize", "usercustomize", "string",
    "dask", "distributed", "tornado", "yaml", "airlight", "click", "rich", "ssl", "tempfile",
)  # fmt: skip
_WITNESS = "import pathlib; pathlib.Path({witness!r}).write_text('imported')\n"


def content(output: Path) -> dict[str, np.ndarray]:
    """Values of a sweep's variables, or pixels of its frames."""
    if output.suffix == ".zarr":
        with xr.open_zarr(output, consolidated=False) as store:
            return {str(name): np.asarray(one.values) for name, one in store.items()}
    pixels = {}
    for file in sorted(output.glob("*.png")):
        with Image.open(file) as image:
            pixels[file.name] = np.asarray(image)
    return pixels


def _compare(output: Path, expected: dict[str, np.ndarray]) -> None:
    """Raise AssertionError unless an output has the values of the undisturbed one."""
    found = content(output)
    assert found.keys() == expected.keys(), sorted(found)
    for name, values in expected.items():
        np.testing.assert_array_equal(found[name], values, err_msg=name)


def _deleted(file: Path, _: random.Random) -> None:
    file.unlink()


def undisturbed(folder: Path, cache: Path) -> Path:
    """Folder with the outputs of the commands, made if it is not there."""
    for name, words in RESUMED:
        if not (folder / name).exists():
            status, err = ended(begin(words, folder, cache))
            assert status == 0, err
    return folder


def _contents(whole: Path) -> dict[str, dict[str, np.ndarray]]:
    return {name: content(whole / name) for name, _ in RESUMED}


def try_damage(
    count: int, seed: int, folder: Path, cache: Path, whole: Path | None = None
) -> Tally:
    """Damage finished outputs; the same command mends them, or a line says that it cannot.

    ``whole`` is what ``undisturbed`` has returned, of this cache or one that was copied.
    """
    chance, tally = random.Random(seed), Tally("damaged sweeps and frames")
    whole = whole or undisturbed(folder / "whole", cache)
    expected = _contents(whole)
    for number in range(count):
        name, words = chance.choice(RESUMED)
        place, damage = folder / f"damaged-{number}", chance.choice((*DAMAGES, _deleted))
        shutil.copytree(whole, place)
        files = sorted(file for file in (place / name).rglob("*") if file.is_file())
        hit = chance.sample(files, min(len(files), chance.choice((1, 2, 5))))
        try:
            for file in hit:
                damage(file, chance)
            status, err = ended(begin(words, place, cache))
            if status == 2:
                assert err.splitlines()[-1].startswith("airlight: "), err
            else:
                assert status == 0, err
                _compare(place / name, expected[name])
            tally.add("held" if status == 0 else "refused")
        except Exception as error:
            names = [str(file.relative_to(place)) for file in hit]
            tally.add("", f"{number}: {damage.__name__} {names}: {ascii(str(error))[:300]}")
        shutil.rmtree(place, ignore_errors=True)
    return tally


def try_writers(
    count: int, seed: int, folder: Path, cache: Path, whole: Path | None = None
) -> Tally:
    """Two to four commands write one output: each is right or told why not, and it is whole."""
    chance, tally = random.Random(seed), Tally("commands that write one output")
    expected = _contents(whole or undisturbed(folder / "whole", cache))
    for number in range(count):
        name, words = chance.choice(RESUMED)
        place = folder / f"shared-{number}"
        processes = []
        for _ in range(chance.randint(2, 4)):
            processes.append(begin(words, place, cache))
            time.sleep(chance.choice((0.0, chance.uniform(0.0, 3.0))))
        try:
            done = [ended(one) for one in processes]
            assert any(status == 0 for status, _ in done), done
            for status, err in done:
                assert status in (0, 2), err
                assert status == 0 or err.splitlines()[-1].startswith("airlight: "), err
            _compare(place / name, expected[name])
            left = [one.name for one in place.iterdir() if one.name not in ("in.csv", name)]
            assert left == [], left
            tally.add("held")
        except Exception as error:
            tally.add("", f"{number}: {words[0]}: {ascii(str(error))[:300]}")
            for one in processes:
                one.kill()
        shutil.rmtree(place, ignore_errors=True)
    return tally


def hostile(folder: Path, names: tuple[str, ...]) -> Path:
    """Fill a folder with modules that leave a witness when they are imported; its path."""
    folder.mkdir(parents=True, exist_ok=True)
    witness = folder / "witness.txt"
    for name in names:
        (folder / f"{name}.py").write_text(_WITNESS.format(witness=str(witness)))
    return witness


def try_places(
    count: int, seed: int, folder: Path, cache: Path, whole: Path | None = None
) -> Tally:
    """Work in folders with modules of others: none is imported, the result is the same."""
    chance, tally = random.Random(seed), Tally("hostile working directories")
    expected = _contents(whole or undisturbed(folder / "whole", cache))
    for number in range(count):
        name, words = chance.choice(RESUMED)
        place = folder / f"hostile-{number}"
        witness = hostile(place, tuple(chance.sample(MODULES, chance.randint(1, len(MODULES)))))
        more = ("--workers", "2") if chance.random() < 0.8 else ()
        here = place / "cold" if chance.random() < 0.2 else cache
        try:
            status, err = ended(begin((*words, *more), place, here))
            assert not witness.exists(), "a module of the working directory was imported"
            assert status == 0, err
            _compare(place / name, expected[name])
            tally.add("held")
        except Exception as error:
            tally.add("", f"{number}: {words[0]} {more}: {ascii(str(error))[:300]}")
        shutil.rmtree(place, ignore_errors=True)
    return tally


#: Fuzzers by name, as ``scripts/soak`` calls them.
FUZZERS: dict[str, Callable[..., Tally]] = {
    "damage": try_damage, "writers": try_writers, "places": try_places,
}  # fmt: skip
