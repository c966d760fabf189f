"""The scene: its sun, its checks and its metadata."""

from __future__ import annotations

import math

import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.scene import Camera, Scene


@pytest.mark.parametrize("zenith", [0.0, 45.0, 90.0, 110.0, 180.0])
def test_sun_stands_at_its_zenith_angle_on_the_side_of_azimuth_0(zenith: float) -> None:
    sun = Scene(sun_zenith=zenith).sun_direction
    assert_allclose(math.degrees(math.atan2(sun[0], sun[2])), zenith, atol=1e-12)
    assert_allclose(sun[1], 0.0, atol=1e-15)


@pytest.mark.parametrize(
    ("changes", "field"),
    [
        ({"altitude": -2e4}, "scene.altitude"),
        ({"altitude": math.inf}, "scene.altitude"),
        ({"altitude": math.nan}, "scene.altitude"),
        ({"sun_zenith": 180.5}, "scene.sun_zenith"),
        ({"latitude": 91.0}, "scene.latitude"),
        ({"longitude": "east"}, "scene.longitude"),
        ({"sun_azimuth": 400.0}, "scene.sun_azimuth"),
        ({"camera": "fisheye"}, "scene.camera"),
    ],
)
def test_an_impossible_scene_is_refused(changes: dict[str, object], field: str) -> None:
    with pytest.raises(ParameterError) as refusal:
        Scene(**changes)  # type: ignore[arg-type]
    assert refusal.value.field == field


def test_metadata_holds_every_number_of_the_scene_with_its_unit() -> None:
    camera = Camera(projection="fisheye", width=512, height=512, look_azimuth=12.5, roll=1.25)
    scene = Scene(
        camera=camera,
        altitude=400e3,
        sun_zenith=85.0,
        latitude=47.5,
        longitude=-8.25,
        sun_azimuth=300.0,
    )
    assert scene.metadata() == {
        "altitude": "400000 m",
        "sun_zenith": "85 deg",
        "latitude": "47.5 deg",
        "longitude": "-8.25 deg",
        "sun_azimuth": "300 deg",
        "ground": "plain",
        "projection": "fisheye",
        "size": "512x512",
        "field_of_view": "180 deg",
        "look": "0,12.5 deg",
        "roll": "1.25 deg",
    }
