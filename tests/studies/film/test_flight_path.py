"""Flights: great circles, rotations, equal factors, and no jump of a velocity."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.geometry.place_axes import place_axes
from airlight.scene.directions import camera_axes
from airlight.scene.flight import FOOTING, turned
from airlight.scene.sun_time import sun_at
from airlight.studies.film import Quality, load_film
from airlight.studies.film.flight_path import FlightPath, smooth_arcs
from airlight.studies.film.key_frames import smooth

#: Around a corner and over the north pole, with a camera that turns and a sun that sets.
VIEWS: dict[str, list[float]] = {
    "latitude": [40.0, 80.0, 75.0, 60.0, 60.0],
    "longitude": [10.0, 20.0, -160.0, -150.0, -120.0],
    "altitude": [2.0, 4e5, 3e7, 1e4, 1e4],
    "look_zenith": [85.0, 110.0, 180.0, 90.0, 95.0],
    "look_bearing": [350.0, 10.0, 90.0, 200.0, 100.0],
    "roll": [0.0, 0.0, 20.0, 0.0, 0.0],
    "field_of_view": [60.0, 60.0, 30.0, 90.0, 60.0],
    "sun_zenith": [70.0, 80.0, 85.0, 90.0, 95.0],
    "sun_azimuth": [180.0, 200.0, 250.0, 270.0, 280.0],
}
AT = [0.0, 0.2, 0.45, 0.8, 1.0]


def camera_of(view: dict[str, float]) -> np.ndarray:
    """Right, up and forward in the frame of the planet, as rows."""
    east, north, up = place_axes(view["latitude"], view["longitude"])
    local = np.stack([north, -east, up])
    axes = camera_axes(view["look_zenith"], view["look_bearing"], view.get("roll", 0.0))
    return np.asarray(axes @ local)


def vectors(view: dict[str, float]) -> np.ndarray:
    """Place, camera and sun as vectors, and the logarithm of the altitude."""
    east, north, up = place_axes(view["latitude"], view["longitude"])
    sun = camera_axes(view["sun_zenith"], view["sun_azimuth"], 0.0)[2]
    sun = sun @ np.stack([north, -east, up])
    scalars = [math.log(view["altitude"] + FOOTING), math.log(view["field_of_view"])]
    return np.concatenate([up, *camera_of(view), sun, scalars])


def test_a_flight_passes_through_its_key_frames() -> None:
    path = FlightPath(AT, VIEWS)
    for k, time in enumerate(AT):
        key = {name: values[k] for name, values in VIEWS.items()}
        assert_allclose(vectors(path.view(time)), vectors(key), atol=1e-12)


def test_a_flight_has_no_jump_of_a_velocity() -> None:
    # of a C1 curve the second difference shrinks with the square of the step; of a corner linearly
    path = FlightPath(AT, VIEWS)

    def corner(step: float) -> float:
        times = [time + k * step for time in AT[1:-1] for k in (-1, 0, 1)]
        seen = np.array([vectors(path.view(one)) for one in times]).reshape(-1, 3, 17)
        return float(np.abs(np.diff(seen, 2, axis=1)).max())

    assert corner(5e-5) < 0.3 * corner(1e-4)


def test_a_flight_rests_at_both_ends() -> None:
    # a velocity would be a difference of the first order of the step
    path, step = FlightPath(AT, VIEWS), 1e-6
    for time, other in ((0.0, step), (1.0, 1.0 - step)):
        moved = vectors(path.view(other)) - vectors(path.view(time))
        assert_allclose(moved, 0.0, atol=1e3 * step**2)


def test_between_two_places_lies_the_great_circle() -> None:
    # ``turned`` carries heading and sun along a great circle, as the keys of the window do
    start = (59.3, 18.1, 40.0, 70.0, 200.0)
    angle = 1.9
    end = turned(*start, 40.0, angle)
    names = ("latitude", "longitude", "look_bearing", "sun_zenith", "sun_azimuth")
    ends = {name: [a, b] for name, a, b in zip(names, start, end, strict=True)}
    path = FlightPath([0.0, 1.0], {**ends, "altitude": [1e4, 1e4], "look_zenith": [95.0, 95.0]})
    for time in np.linspace(0.0, 1.0, 9):
        share = float(
            smooth(np.array([0.0, 1.0]), np.array([[0.0], [1.0]]), np.array([time])).item()
        )
        view = path.view(float(time))
        expected = turned(*start, 40.0, share * angle)
        assert_allclose([view[name] for name in names], expected, atol=1e-9)
        assert_allclose([view["look_zenith"], view["altitude"]], [95.0, 1e4], rtol=1e-12)
        assert "roll" not in view


def test_places_of_one_great_circle_are_joined_as_smooth_joins_their_angles() -> None:
    at, angles = np.array([0.0, 0.3, 0.4, 0.7, 1.0]), np.array([0.1, 0.9, 1.0, 1.0, 2.4])
    points = np.stack([np.cos(angles), 0.6 * np.sin(angles), 0.8 * np.sin(angles)], axis=-1)
    where = np.linspace(-0.1, 1.1, 121)
    found = smooth_arcs(at, points, where)
    expected = smooth(at, angles[:, None], where).ravel()
    assert_allclose(np.arctan2(np.hypot(found[:, 1], found[:, 2]), found[:, 0]), expected)
    assert_allclose(found[:, 1] * 0.8, found[:, 2] * 0.6, atol=1e-15)


def test_altitude_and_field_of_view_change_by_equal_factors() -> None:
    path = FlightPath([0.0, 1.0], {name: values[:2] for name, values in VIEWS.items()})
    middle = path.view(0.5)["altitude"] + FOOTING
    assert middle == pytest.approx(math.sqrt((2.0 + FOOTING) * (4e5 + FOOTING)))


def test_the_sun_between_two_hours_is_that_of_the_hours_between() -> None:
    suns = [sun_at(50.0, 20.0, hour) for hour in (14.0, 22.0)]
    still = {"latitude": [50.0] * 2, "longitude": [7.0] * 2, "altitude": [2.0] * 2,
             "look_zenith": [90.0] * 2, "look_bearing": [300.0] * 2}  # fmt: skip
    zeniths, azimuths = zip(*suns, strict=True)
    path = FlightPath([0.0, 1.0], {**still, "sun_zenith": zeniths, "sun_azimuth": azimuths})
    view = path.view(0.5)
    assert_allclose([view["sun_zenith"], view["sun_azimuth"]], sun_at(50.0, 20.0, 18.0))


def film_of(views: dict[str, list[float]], **more: Any) -> dict[str, Any]:
    keys = [
        {"path": f"view.{name}", "values": values, "at": AT, "law": "flight"}
        for name, values in views.items()
    ]
    return {"film.frames": 5, "film.keys": keys, **more}


def test_a_film_of_a_flight_has_its_views() -> None:
    film, path = load_film("earth", film_of(VIEWS)), FlightPath(AT, VIEWS)
    for number in range(5):
        scene = film.frame_spec(number, Quality(width=16, height=9)).scene  # type: ignore[attr-defined]
        view = path.view(number / 4)
        assert scene.latitude == pytest.approx(view["latitude"], rel=1e-12)
        assert scene.altitude == pytest.approx(view["altitude"], rel=1e-12)
        bearing = scene.camera.look_azimuth + scene.sun_azimuth
        assert math.sin(math.radians(bearing - view["look_bearing"])) == pytest.approx(
            0.0, abs=1e-9
        )


def test_a_flight_by_the_clock_has_no_sun_of_its_own(tmp_path: Path) -> None:
    views = {name: values for name, values in VIEWS.items() if not name.startswith("sun")}
    times = {"film.start": "2026-06-21T10:00Z", "film.end": "2026-06-21T20:00Z"}
    film = load_film("earth", film_of(views, **times))
    first, last = (film.frame_spec(n, Quality()).scene for n in (0, 4))  # type: ignore[attr-defined]
    assert first.sun_zenith != last.sun_zenith
    bearing = first.camera.look_azimuth + first.sun_azimuth
    assert bearing % 360.0 == pytest.approx(350.0)


@pytest.mark.parametrize(
    ("changed", "line"),
    [
        ({"look_bearing": None}, "both or no sun_ angles"),
        ({"sun_zenith": None}, "both or no sun_ angles"),
        ({"altitude": [2.0, -9.0, 2.0, 2.0, 2.0]}, "numbers above 0"),
        ({"longitude": [10.0, -170.0, 0.0, 0.0, 0.0], "latitude": [40.0, -40.0, 0.0, 0.0, 0.0]},
         "not opposite"),
        ({"polariser": [0.0] * 5}, "a flight of view.latitude"),
    ],
)  # fmt: skip
def test_a_wrong_flight_is_refused_in_one_line(changed: dict[str, Any], line: str) -> None:
    views = {name: one for name, one in {**VIEWS, **changed}.items() if one is not None}
    with pytest.raises(ParameterError, match=line):
        load_film("earth", film_of(views))


def test_key_frames_of_a_flight_have_the_same_times() -> None:
    changes = film_of(VIEWS)
    changes["film.keys"][2]["at"] = [0.0, 0.1, 0.2, 0.3, 1.0]
    with pytest.raises(ParameterError, match="the times of the other keys"):
        load_film("earth", changes)
