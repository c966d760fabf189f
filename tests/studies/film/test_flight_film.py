"""Film files of flights: what is written is read back, and a dome's front is the line of sight."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.scene.directions import camera_axes
from airlight.studies.film import Quality, load_film
from airlight.studies.film.flight_film import FlightKey, flight_keys, write_flight

KEYS = tuple(
    FlightKey(
        time=time,
        view={
            "latitude": latitude,
            "longitude": 35.5,
            "altitude": altitude,
            "look_zenith": 80.0,
            "look_bearing": 10.0 * time,
            "roll": 0.0,
            "field_of_view": 60.0,
            "sun_zenith": 70.0,
            "sun_azimuth": 200.0,
        },
        exposure=time - 1.0,
    )
    for time, latitude, altitude in ((0.0, 27.5, 2.0), (1.3, 30.0, 1e4), (4.0, 31.1, 4e5))
)


def written(path: Path, keys: tuple[FlightKey, ...] = KEYS) -> Path:
    view = {"projection": "perspective", "ground": "plain"}
    write_flight(path, keys, planet="mars", view=view, display={"tone_map": "aces", "glare": 0.5})
    return path


def test_a_flight_written_is_read_back(tmp_path: Path) -> None:
    film = load_film(written(tmp_path / "flight.toml"))
    assert (film.name, film.planet_name, film.plan.count) == ("flight", "mars", 121)
    assert film.display == {"tone_map": "aces", "glare": 0.5}
    found = flight_keys(film)
    assert len(found) == len(KEYS)
    for one, key in zip(found, KEYS, strict=True):
        assert one.time == pytest.approx(key.time, abs=1e-12)
        assert one.exposure == pytest.approx(key.exposure, abs=1e-12)
        assert one.view == pytest.approx(dict(key.view), rel=1e-13)
    # what stays the same is a key of the view, which the command line can replace
    assert "view.field_of_view" not in {one.path for one in film.plan.keys}


def test_an_automatic_exposure_is_left_to_the_film(tmp_path: Path) -> None:
    keys = (KEYS[0], FlightKey(time=4.0, view=KEYS[1].view))
    film = load_film(written(tmp_path / "flight.toml", keys))
    assert film.plan.exposure(0) is None


def test_one_key_frame_is_no_flight(tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match="two or more key frames"):
        written(tmp_path / "flight.toml", KEYS[:1])
    with pytest.raises(ParameterError, match="law 'flight'"):
        flight_keys(load_film("mars", {"film.keys": [{"path": "view.roll", "values": [0, 1]}]}))


@pytest.mark.parametrize("tilt", [0.0, 20.0])
def test_the_front_of_a_dome_is_the_line_of_sight(tmp_path: Path, tilt: float) -> None:
    # the flight's line of sight lies at the lower edge of a dome, or above it by the tilt
    path = written(tmp_path / "flight.toml")
    changes = {"view.projection": "fisheye", "view.field_of_view": "180 deg"}
    how = Quality(width=16, height=16)
    flight, dome = (
        load_film(path, {**changes, **more}).frame_spec(60, how).scene.camera  # type: ignore[attr-defined]
        for more in ({}, {"view.dome_tilt": f"{tilt} deg"})
    )
    axes = [camera_axes(one.look_zenith, one.look_azimuth, one.roll) for one in (flight, dome)]
    right, up, forward = axes[1] @ axes[0][2]
    expected = [0.0, -np.cos(np.radians(tilt)), np.sin(np.radians(tilt))]
    assert_allclose([right, up, forward], expected, atol=1e-12)
