"""Films of three-dimensional clouds: drift with the wind, light between positions of the sun."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import xarray

from airlight.errors import ParameterError
from airlight.image.xyz import luminance
from airlight.planets import load_planet
from airlight.render.clouds.cloud_time import CloudTime, clouds_at
from airlight.scene import Scene
from airlight.studies.film import Finish, Quality, animate, load_film
from airlight.studies.film.frame_spec import PlanetFrameSpec
from airlight.studies.film.light_frames import STEP, LightFrames

PLANET = "earth-atmosphere-plus"
HOW = Quality(width=64, height=64, wavelengths=(440.0, 550.0, 680.0), quality="preview")
#: Observer above the middle of the box, and middle of the cloud. [m]
ALTITUDE, CLOUD = 6e3, 1050.0


@pytest.fixture(scope="module")
def heap(tmp_path_factory: pytest.TempPathFactory) -> str:
    """File of a thin round cloud in the middle of a box of 6.4 km."""
    at = (np.arange(32) - 15.5) * 200.0
    x, y = np.meshgrid(at, at, indexing="ij")
    values = 0.05 * np.exp(-0.5 * (x * x + y * y) / 400.0**2)[..., None] * np.ones(4)
    axes = {"x": at, "y": at, "z": 1000.0 + 25.0 * (np.arange(4) + 0.5)}
    path = tmp_path_factory.mktemp("clouds") / "heap.nc"
    xarray.Dataset(
        {"extinction": (("x", "y", "z"), values, {"units": "m-1"})},
        {name: ((name,), one, {"units": "m"}) for name, one in axes.items()},
    ).to_netcdf(path, engine="scipy")
    return str(path)


def film(heap: str, **changes: object):
    table = {"file": heap, "beyond": "periodic", "effective_radius": "6 um"}
    view = {
        "view.altitude": f"{ALTITUDE} m", "view.look_zenith": "180 deg",
        "view.field_of_view": "50 deg", "view.sun_zenith": "20 deg", "view.ground": "plain",
    }  # fmt: skip
    given = {**view, **changes}
    return load_film(
        PLANET, {"clouds": [table], **{path: one for path, one in given.items() if one is not None}}
    )


def middle(picture: np.ndarray, clear: np.ndarray) -> tuple[float, float]:
    """Column and row of the middle of what is brighter than without clouds. [pixel]"""
    bright = np.maximum(luminance(picture - clear), 0.0)
    bright = np.where(bright > 0.2 * bright.max(), bright, 0.0)
    rows, columns = np.indices(bright.shape)
    return (columns * bright).sum() / bright.sum(), (rows * bright).sum() / bright.sum()


@pytest.mark.slow
def test_a_cloud_moves_by_the_wind_times_the_time(heap: str) -> None:
    """A west wind of 50 m/s moves it 1 km to the east in 20 s; the projection is perspective."""
    wind = {"clouds.wind_speed": "50 m/s", "clouds.wind_direction": "270 deg"}
    # the glory is out of the picture, and the shadow beside the cloud
    made = film(heap, **wind, **{"film.frames": 21, "film.rate": 1, "view.sun_zenith": "60 deg"})
    first, last = (made.frame_spec(number, HOW) for number in (0, 20))
    assert isinstance(first, PlanetFrameSpec)
    clear = replace(first, planet=first.planet.without_clouds).render().rgb
    (x0, y0), (x1, y1) = (middle(one.render().rgb, clear) for one in (first, last))
    focal = 32.0 / math.tan(math.radians(25.0))
    assert math.hypot(x1 - x0, y1 - y0) == pytest.approx(focal * 1e3 / (ALTITUDE - CLOUD), rel=0.03)
    right, up, _ = first.scene.camera.axes
    moved = right * (x1 - x0) - up * (y1 - y0)
    bearing = first.scene.sun_azimuth + math.degrees(math.atan2(-moved[1], moved[0]))
    assert math.remainder(bearing - 90.0, 360.0) == pytest.approx(0.0, abs=2.0)


@pytest.mark.slow
def test_frames_without_wind_are_identical_and_with_wind_do_not_jump(heap: str) -> None:
    """Each frame has as much cloud as the others: a box is periodic, and seen as a whole."""
    still = film(heap, **{"film.frames": 3})
    one, other = (still.frame_spec(number, HOW).render().rgb for number in (0, 2))
    np.testing.assert_array_equal(one, other)
    wind = {"clouds.wind_speed": "50 m/s", "clouds.wind_direction": "225 deg"}
    made = film(heap, **wind, **{"film.frames": 6, "film.rate": 2})
    frames = np.array([made.frame_spec(number, HOW).render().rgb for number in range(6)])
    means = luminance(frames).mean((1, 2))
    np.testing.assert_allclose(means, means[0], rtol=5e-3)
    changes = np.abs(np.diff(luminance(frames), axis=0)).mean((1, 2)) / means.mean()
    assert changes.min() > 1e-3
    np.testing.assert_allclose(changes, changes.mean(), rtol=0.1)


@pytest.mark.slow
def test_light_between_two_suns_is_that_of_the_sun_between(heap: str) -> None:
    """A second way: the same frame, solved for its own sun."""
    frames = {
        "film.frames": 3,
        "film.keys": [{"path": "view.sun_zenith", "values": "70, 70.4 deg"}],
    }
    between = film(heap, **frames).frame_spec(1, HOW)
    alone = film(heap, **{"view.sun_zenith": "70.2 deg"}).frame_spec(0, HOW)
    assert isinstance(between, PlanetFrameSpec)
    assert between.clouds is not None
    assert [weight for weight, _ in between.clouds.solved_at] == pytest.approx([0.5, 0.5])
    expected = alone.render().rgb
    np.testing.assert_allclose(between.render().rgb, expected, rtol=0.02)
    np.testing.assert_allclose(between.render().rgb.mean(), expected.mean(), rtol=2e-3)


@pytest.mark.validation
def test_two_workers_solve_each_box_once_and_write_the_same_bytes(
    heap: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    keys = [{"path": "view.sun_zenith", "values": "70, 70.8 deg"}]
    made = film(heap, **{"film.frames": 5, "film.keys": keys})
    assert made.lit_frames(range(5)) == (0, 2, 4)
    assert made.lit_frames([3]) == (2, 4)
    how, messages = replace(HOW, width=16, height=16), []
    for workers in (1, 2):
        monkeypatch.setenv("AIRLIGHT_CACHE", str(tmp_path / f"cache{workers}"))
        animate(
            made, tmp_path / str(workers), how=how, finish=Finish(exposure=0.0), workers=workers,
            progress=lambda done, total, message: messages.append((message, done, total)),
        )  # fmt: skip
    lit = [one for one in messages if one[0] == "light of clouds" and one[2] == 3]
    assert [one[1] for one in lit] == [1, 2, 3]
    one, two = (
        {file.name: file.read_bytes() for file in (tmp_path / name).glob("*.png")} for name in "12"
    )
    assert len(one) == 5
    assert one == two


def sun_path(count: int, degrees: float) -> np.ndarray:
    """Directions of a light that moves evenly along a great circle. [1]"""
    angle = np.radians(np.linspace(0.0, degrees, count))
    return np.stack([np.cos(angle), 0.0 * angle, np.sin(angle)], axis=-1)[:, None]


def test_light_is_solved_for_few_frames_and_all_around_a_change() -> None:
    frames = LightFrames.of(sun_path(101, 10.0), [0] * 101)
    apart = np.diff(frames.solved) * 0.1
    assert apart.max() <= STEP + 1e-9
    assert len(frames.solved) <= 2 + 10.0 / (STEP - 0.1)
    (one, first), (other, second) = frames.around(7)
    assert first < 7 < second
    assert one + other == pytest.approx(1.0)
    assert one * first + other * second == pytest.approx(7.0, abs=1e-6)
    assert LightFrames.of(sun_path(5, 0.0), [0] * 5).around(3) == ((1.0, 0),)
    changed = LightFrames.of(sun_path(5, 0.1), [0, 0, 0, 1, 1])
    assert changed.solved.tolist() == [0, 2, 3, 4]
    fast = LightFrames.of(sun_path(4, 90.0), [0] * 4)
    assert fast.solved.tolist() == [0, 1, 2, 3]


def test_cells_stay_with_the_ground_when_the_observer_moves(heap: str) -> None:
    planet = load_planet(PLANET, {"clouds": [{"file": heap}]})
    time = CloudTime(seconds=0.0, latitude=10.0, longitude=20.0)
    scene = Scene(latitude=10.01, longitude=19.98)
    found = clouds_at(planet, scene, time)
    assert found is not None
    field = found.decks[0].field
    assert (field.latitude, field.longitude) == (10.01, 19.98)
    degree = math.radians(planet.bottom_radius)
    expected = 0.02 * degree * math.cos(math.radians(10.0)), -0.01 * degree
    np.testing.assert_allclose(field.drift, expected, rtol=1e-4)


def test_a_film_has_the_seconds_of_its_clock_or_of_playback(heap: str) -> None:
    clock = {"film.start": "2026-06-21T10:00Z", "film.end": "2026-06-21T10:10Z"}
    view = {"view.sun_zenith": None}
    for changes, seconds in (({**clock, **view}, 300.0), ({"film.rate": 4}, 0.5)):
        spec = film(heap, **{"film.frames": 5, **changes}).frame_spec(2, HOW)
        assert isinstance(spec, PlanetFrameSpec)
        assert spec.clouds is not None
        assert spec.clouds.seconds == seconds


def test_the_wind_of_a_film_is_constant(heap: str) -> None:
    keys = [{"path": "clouds.wind_speed", "values": "1, 2 m/s"}]
    with pytest.raises(ParameterError, match=r"clouds\.wind_speed.*same at all times"):
        film(heap, **{"film.keys": keys}).frame_spec(0, HOW)
