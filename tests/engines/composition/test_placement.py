"""A scene on a planet: directions, the curvature of the ground, the sun where the camera is."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import ParameterError
from airlight.engines.composition import Pinhole, Placement
from airlight.engines.composition.placement import pinhole_view

from .views import looking

EARTH = 6371e3


def moved(camera: Pinhole, position: tuple[float, float, float]) -> Pinhole:
    matrix = camera.to_world.copy()
    matrix[:3, 3] = position
    return Pinhole(
        width=camera.width, height=camera.height, focal_x=camera.focal_x, focal_y=camera.focal_y,
        to_world=matrix,
    )  # fmt: skip


def test_the_heading_is_the_bearing_of_the_scene_s_forward_axis() -> None:
    # 90 is east, as on a compass; where Y is up, -Z is ahead
    ahead = Placement(heading=90.0).to_east_north_up @ [0.0, 1.0, 0.0]
    assert_allclose(ahead, [1.0, 0.0, 0.0], atol=1e-12)
    turned = Placement(heading=90.0, up="y").to_east_north_up
    assert_allclose(turned @ [0.0, 0.0, -1.0], [1.0, 0.0, 0.0], atol=1e-12)
    assert_allclose(turned @ [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], atol=1e-12)
    assert np.linalg.det(turned) == pytest.approx(1.0)


def test_a_level_plane_rises_above_the_ground() -> None:
    # h = sqrt(R² + d²) - R at the distance d from where the plane touches, and millimetres are kept
    camera = moved(looking(0.0, 0.0), (0.0, 100.0, 0.002))
    view = pinhole_view(camera, Placement(metres_per_unit=1000.0), EARTH)
    wanted = math.sqrt(100e3**2 + (EARTH + 2.0) ** 2) - EARTH
    assert view.scene.altitude == pytest.approx(wanted, abs=1e-6)
    # 100 km north of the origin are d/R radians of latitude
    assert math.radians(view.scene.latitude) == pytest.approx(math.atan(100e3 / (EARTH + 2.0)))


def test_the_sun_stands_elsewhere_for_a_camera_far_away() -> None:
    # a quarter of the way round the equator the sun has set a quarter
    place = Placement(sun_zenith=30.0, sun_azimuth=270.0, altitude=0.0)
    camera = moved(looking(0.0, 0.0), (2.0 * EARTH, 0.0, 0.0))  # east, and above
    view = pinhole_view(camera, place, EARTH)
    assert view.scene.longitude == pytest.approx(math.degrees(math.atan2(2.0, 1.0)))
    assert view.scene.sun_zenith == pytest.approx(30.0 + view.scene.longitude)
    assert view.scene.sun_azimuth % 360.0 == pytest.approx(270.0)


def test_a_camera_keeps_its_axes_in_every_position() -> None:
    # the scene's camera, made of three angles, looks where the matrix says: up, down, rolled
    turn = np.eye(4)
    for seed in range(6):
        turn[:3, :3] = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0]
        turn[:3, 0] *= np.linalg.det(turn[:3, :3])
        turn[2, 3] = 10.0
        camera = Pinhole(width=8, height=6, focal_x=8.0, focal_y=8.0, to_world=turn)
        place = Placement(sun_zenith=90.0, sun_azimuth=90.0, heading=0.0)
        axes = pinhole_view(camera, place, EARTH).axes
        # the observer's x is the sun's side, east; y north of it to the left; z up
        assert_allclose(axes, camera.axes, atol=1e-9)


@pytest.mark.parametrize(
    ("block", "given", "words"),
    [
        ({"lat": 91.0}, {}, "airlight.lat is 91.0; allowed: -90 to 90 deg"),
        ({"latitude": 1.0}, {}, "airlight.latitude is 1.0; allowed: planet, lat, lon"),
        ({"metres_per_unit": 0.0}, {}, "airlight.metres_per_unit is 0.0"),
        ({"up": "x"}, {}, "airlight.up is 'x'; allowed: z or y"),
        ({"alt": "high"}, {}, "airlight.alt is 'high'"),
        ({}, {"sun_zenith": 200.0}, "sun_zenith is 200.0; allowed: 0 to 180 deg"),
    ],
)
def test_a_bad_block_gets_one_line(
    block: dict[str, Any], given: dict[str, Any], words: str
) -> None:
    with pytest.raises(ParameterError) as raised:
        Placement.from_block(block, **given)
    assert words in str(raised.value)


def test_an_option_replaces_the_block() -> None:
    place = Placement.from_block({"lat": 10.0, "alt": 5.0, "planet": "mars"}, latitude=20.0)
    assert (place.latitude, place.altitude) == (20.0, 5.0)
