"""Sweeps: the radiances of the solution, resumed block by block, by any number of processes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import xarray
from numpy.testing import assert_allclose, assert_array_equal

import airlight
from airlight.cli import main
from airlight.errors import FileError, ParameterError
from airlight.planets import load_planet
from airlight.solver import solve
from airlight.studies.sweep import Grid, sweep
from airlight.studies.sweep import grid as grids
from airlight.studies.sweep.store import SweepStore
from airlight.studies.sweep.store_layout import varied_axis

pytest.importorskip("zarr")
NM = (680.0, 550.0, 440.0)


def small(**changes: object) -> Grid:
    values: dict = {
        "planets": ["earth-atmosphere-plus"], "vary": {"ground.albedo": [0.1, 0.5]},
        "altitude": [0.0, 2e3], "sun_zenith": [0.0, 45.0, 60.0, 92.0],
        "view_zenith": [0.0, 80.0, 100.0], "azimuth": [0.0, 90.0], "wavelengths": NM,
    }  # fmt: skip
    return Grid(**{**values, **changes})


def radiances(path: Path) -> xarray.Dataset:
    with xarray.open_zarr(path) as data:
        return data.load()


@pytest.fixture
def four_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Blocks of two suns and three views, so that a small grid has several."""
    monkeypatch.setattr(grids, "_BLOCK", 2 * 3 * 2 * 3)


def test_a_sweep_holds_the_radiances_of_the_solution(tmp_path: Path) -> None:
    # the same call for one of its planets, without blocks
    grid = small()
    done = sweep(grid, tmp_path / "a.zarr", quality="preview", workers=1)
    assert (done.computed, done.kept) == (4, 0)
    data = radiances(done.path)
    assert data.radiance.dims == grid.dims
    assert data.radiance.shape == grid.shape
    planet = load_planet("earth-atmosphere-plus", {"ground.albedo": 0.5})
    direct = solve(planet, wavelengths=NM, quality="preview").radiance(
        altitude=2e3, sun_zenith=np.array(grid.sun_zenith)[:, None, None],
        view_zenith=np.array(grid.view_zenith)[:, None], azimuth=np.array(grid.azimuth),
    )  # fmt: skip
    found = data.radiance.sel({"ground.albedo": 0.5, "altitude": 2e3}).isel(planet=0)
    assert_array_equal(found.values, direct.values.astype(np.float32))
    assert data.radiance.units == "W m-2 sr-1 nm-1"


def test_polarised_light_is_beside_the_radiance(tmp_path: Path) -> None:
    # the same call without blocks; and a sweep without Stokes parameters is another one
    grid, path = small(vary={}, altitude=[0.0]), tmp_path / "a.zarr"
    sweep(grid, path, quality="preview", stokes=True, workers=1)
    data = radiances(path).squeeze(("planet", "altitude"))
    light = solve(load_planet("earth-atmosphere-plus"), wavelengths=NM, quality="preview").radiance(
        altitude=0.0, sun_zenith=data.sun_zenith.values[:, None, None],
        view_zenith=data.view_zenith.values[:, None], azimuth=data.azimuth.values, stokes=True,
    )  # fmt: skip
    for name, stokes in (("radiance", "I"), ("Q", "Q"), ("U", "U")):
        assert_array_equal(data[name].values, light.sel(stokes=stokes).values.astype(np.float32))
    assert_allclose(data.dolp, np.hypot(data.Q, data.U) / data.radiance, rtol=1e-5)
    assert_allclose(data.aolp, 0.5 * np.degrees(np.arctan2(data.U, data.Q)), atol=1e-3)
    assert float(data.dolp.max()) > 0.5
    assert data.U.units == "W m-2 sr-1 nm-1"
    with pytest.raises(FileError, match="contains a sweep of another grid"):
        sweep(grid, path, quality="preview", workers=1)


@pytest.mark.usefixtures("four_blocks")
def test_a_second_start_computes_what_is_missing_or_changed(tmp_path: Path) -> None:
    grid, path = small(), tmp_path / "a.zarr"
    assert grid.blocks == (1, 2, 2, 2, 1)
    done = sweep(grid, path, quality="preview", workers=1)
    assert (done.computed, done.kept) == (8, 0)
    before = radiances(path)

    class Killed(Exception):
        pass

    def stop(done: int, total: int, message: str) -> None:
        if message == "radiances" and done == 3:
            raise Killed

    other = tmp_path / "b.zarr"
    with pytest.raises(Killed):
        sweep(grid, other, quality="preview", workers=1, progress=stop)
    assert int(radiances(other).radiance.isnull().sum()) == 5 * 36
    done = sweep(grid, other, quality="preview", workers=1)
    assert (done.computed, done.kept) == (5, 3)
    assert_array_equal(radiances(other).radiance.values, before.radiance.values)
    assert sweep(grid, other, quality="default", workers=1).kept == 0


@pytest.mark.slow
@pytest.mark.usefixtures("four_blocks")
def test_one_process_and_two_workers_write_the_same_numbers(tmp_path: Path) -> None:
    found = []
    for workers in (1, 2):
        path = tmp_path / f"{workers}.zarr"
        sweep(small(), path, quality="preview", workers=workers)
        found.append(radiances(path).radiance.values)
    assert np.isfinite(found[0]).all()
    assert_array_equal(*found)


def test_a_folder_of_another_grid_is_left_alone(tmp_path: Path) -> None:
    path = tmp_path / "a.zarr"
    one = small(planets=["mars-rayleigh"], vary={}, altitude=[0.0], sun_zenith=[10.0])
    sweep(one, path, quality="preview", workers=1)
    before = radiances(path).radiance.values
    with pytest.raises(FileError, match="contains a sweep of another grid"):
        sweep(small(), path, quality="preview", workers=1)
    assert_array_equal(radiances(path).radiance.values, before)


def test_blocks_cover_a_large_grid_once() -> None:
    grid = small(sun_zenith=np.linspace(0, 180, 1801), view_zenith=np.linspace(0, 180, 721),
                 azimuth=np.linspace(0, 180, 181))  # fmt: skip
    filled = np.zeros(grid.shape[3:5], int)
    for sun in range(grid.blocks[-2]):
        for view in range(grid.blocks[-1]):
            region = grid.region((0, 0, 0, sun, view))
            filled[region[-4], region[-3]] += 1
            size = np.prod([len(range(*r.indices(n))) for r, n in
                            zip(region[-4:], grid.shape[-4:], strict=True)])  # fmt: skip
            assert size <= grids._BLOCK
    assert filled.min() == filled.max() == 1


@pytest.mark.parametrize(
    ("changes", "line"),
    [
        ({"sun_zenith": [0.0, 190.0]}, "allowed: 0 to 180 deg"),
        ({"view_zenith": []}, "1 to 100000"),
        ({"view_zenith": [30.0, 10.0]}, "ascending"),
        ({"planets": []}, "1 to 10000"),
        ({"planets": ["earth", "earth"]}, "once"),
    ],
)
def test_unusable_axes_are_refused(changes: dict, line: str) -> None:
    with pytest.raises(ParameterError, match=line):
        small(**changes)


@pytest.mark.parametrize(
    ("words", "line"),
    [
        (["--sun-zenith", "0:100"], "--sun-zenith is '0:100'; allowed: a list, or FROM:TO:STEP"),
        (["--sun-zenith", "0,200"], "--sun-zenith[1] is 200.0; allowed: 0 to 180 deg"),
        (["--sun-zenith", "0", "--vary", "ground.albdo=0.1,0.2"], "a key of ground is 'albdo'"),
        (["--sun-zenith", "0", "--vary", "grund.albedo=0.1,0.2"], "--vary is 'grund.albedo'"),
        (["--sun-zenith", "0", "--vary", "ground.albedo"], "--vary is 'ground.albedo'"),
        (["--sun-zenith", "0", "-o", "."], ".: is not a sweep"),
    ],
)
def test_wrong_options_are_one_line(
    words: list[str], line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    monkeypatch.chdir(tmp_path)
    (tmp_path / "note.txt").touch()
    rest = [] if "-o" in words else ["-o", "a.zarr"]
    assert main(["sweep", "earth-atmosphere-plus", "--view-zenith", "0", *words, *rest]) == 2
    said = capsys.readouterr().err
    assert line in said
    assert said.count("\n") == 1


def test_the_command_writes_what_it_says(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    words = ["sweep", "earth-atmosphere-plus", "--sun-zenith", "0:60:30", "--view-zenith", "0,80",
             "--quality", "preview", "-o", "sky.zarr"]  # fmt: skip
    assert main(words) == 0
    assert "1 blocks computed, 0 unchanged" in capsys.readouterr().out
    assert main(words) == 0
    assert "0 blocks computed, 1 unchanged" in capsys.readouterr().out
    assert radiances(Path("sky.zarr")).radiance.shape == (1, 1, 3, 2, 1, 3)


def test_varied_values_are_numbers_with_their_unit(tmp_path: Path) -> None:
    # 1 DU is 0.01 mm of gas at 0 deg C and 1 atm: 2.6867e20 molecules per square metre
    (tmp_path / "a.zarr").mkdir()
    grid = Grid(
        planets=["earth"], sun_zenith=[30.0], view_zenith=[0.0], wavelengths=[550.0],
        vary={"ozone.absorption.ozone": ["200 DU", "300 DU"],
              "shell.top_radius": ["6471 km", 6.48e6],
              "ground.albedo": [0, 0.5], "name": ["a", "b"]},
    )  # fmt: skip
    store = SweepStore(tmp_path / "a.zarr", grid, {"settings": "degree=4"})
    assert not list((tmp_path / "a.zarr").iterdir())  # it appears with the first block
    store.write((0,) * 8, np.ones((1, 1, 1, 1, 1), np.float32), 1)
    data = radiances(tmp_path / "a.zarr")
    expected = {
        "ozone.absorption.ozone": ([200.0, 300.0], "DU"),
        "shell.top_radius": ([6471e3, 6480e3], "m"),
        "ground.albedo": ([0.0, 0.5], "1"),
    }
    for name, (numbers, unit) in expected.items():
        assert_array_equal(data[name].values, numbers)
        assert data[name].units == unit
    assert data.name.values.tolist() == ["a", "b"]
    assert_allclose(varied_axis("earth", "ozone.absorption.ozone", ["1 DU", 2.6867e20])[0], 1.0,
                    rtol=1e-4)  # fmt: skip
    assert (data.Conventions, data.planet.item()) == ("CF-1.10", "earth")
    assert data.attrs["version"] == airlight.__version__
    assert data.sun_zenith.standard_name == "solar_zenith_angle"


def test_identical_sweeps_are_identical(tmp_path: Path) -> None:
    # by definition of ``Dataset.identical``: names, values and all attributes
    grid = small(vary={}, altitude=[0.0], sun_zenith=[10.0])
    found = [radiances(sweep(grid, tmp_path / f"{name}.zarr", quality="preview", workers=1).path)
             for name in ("a", "b")]  # fmt: skip
    xarray.testing.assert_identical(*found)


@pytest.mark.parametrize("name", ["a.nc", "a.csv", "a.JSON", "a.h5"])
def test_a_store_named_as_another_format_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(FileError, match="names a file; allowed: a folder"):
        sweep(small(), tmp_path / name, quality="preview", workers=1)
    assert not list(tmp_path.iterdir())
