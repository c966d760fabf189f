"""Preset viewpoints: directions of the camera."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.scene.observer import horizon_zenith
from airlight.scene.surface_map import surface_map
from airlight.viewer.navigation.viewpoints import PLACE, VIEWPOINTS, Viewpoint, view_of
from airlight.viewer.parameters.view_parameters import DEFAULTS, scene_of
from airlight.viewer.session.session import Session


@pytest.mark.parametrize("name", ["earth-atmosphere-plus", "mars-openspace"])
@pytest.mark.parametrize("viewpoint", VIEWPOINTS, ids=lambda one: one.name)
def test_the_horizon_or_the_whole_planet_is_in_the_picture(name: str, viewpoint: Viewpoint) -> None:
    # Geometry: the horizon's angle is known, a planet seen from h spans 2 asin(R/(R + h)).
    session = Session(name)
    bottom, top = (1e3 * float(session.value(f"shell.{end}_radius")) for end in ("bottom", "top"))
    view = view_of(viewpoint, bottom_radius=bottom, top_radius=top)
    session.move(view)
    altitude, look = view["view.altitude"], view["view.look_zenith"]
    if viewpoint.name in ("planet", "crescent"):
        assert look == 180.0
        upright = math.degrees(2.0 * math.atan(math.tan(math.radians(30.0)) * 9.0 / 16.0))
        assert 2.0 * math.degrees(math.asin(bottom / (bottom + altitude))) < upright + 6.0
    else:
        assert abs(horizon_zenith(altitude, bottom) - look) < 10.0
        assert altitude < 10.0 * (top - bottom)


@pytest.mark.parametrize("viewpoint", VIEWPOINTS, ids=lambda one: one.name)
def test_the_sun_of_a_viewpoint_shines_there_on_one_day(viewpoint: Viewpoint) -> None:
    # Spherical trigonometry: sin δ = sin φ cos z + cos φ sin z cos A; between two weeks before an
    # equinox and ten days after it the declination is within 9° and 0° south.
    latitude = math.radians(PLACE[0])
    zenith, bearing = math.radians(viewpoint.sun_zenith), math.radians(viewpoint.sun_bearing)
    sine = math.sin(latitude) * math.cos(zenith)
    sine += math.cos(latitude) * math.sin(zenith) * math.cos(bearing)
    assert -9.0 < math.degrees(math.asin(sine)) < 0.0


def test_a_whole_planet_has_north_at_the_top() -> None:
    # The definition of the heading of a camera that looks straight down: what is up in its picture.
    for viewpoint in VIEWPOINTS:
        if viewpoint.altitude < 0.0:
            view = view_of(viewpoint, bottom_radius=6371e3, top_radius=6471e3)
            seen = {**DEFAULTS, **view}
            scene = scene_of(seen, 64, 64)
            up = scene.ground_frame @ scene.camera.axes[1]
            place = scene.ground_frame @ np.array([0.0, 0.0, 1.0])
            north = np.array([0.0, 0.0, 1.0]) - place[2] * place
            assert_allclose(up, north / np.linalg.norm(north), atol=1e-9)


def test_the_viewer_begins_at_a_coast() -> None:
    # An atlas: the Red Sea is 200 km wide there; the land is east of it.
    assert (DEFAULTS["view.latitude"], DEFAULTS["view.longitude"]) == PLACE
    west, east = surface_map("earth").sample(PLACE[0], [PLACE[1] - 0.5, PLACE[1] + 0.5])[:, 3]
    assert_allclose([west, east], [1.0, 0.0])
