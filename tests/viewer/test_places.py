"""Preset viewpoints: directions of the camera."""

from __future__ import annotations

import math

import pytest

from airlight.scene.observer import horizon_zenith
from airlight.viewer.navigation.viewpoints import VIEWPOINTS, view_of
from airlight.viewer.session.session import Session


@pytest.mark.parametrize("name", ["earth-atmosphere-plus", "mars-openspace"])
@pytest.mark.parametrize("viewpoint", VIEWPOINTS, ids=lambda one: one.name)
def test_the_horizon_or_the_whole_planet_is_in_the_picture(name: str, viewpoint: object) -> None:
    # Geometry: the horizon's angle is known, a planet seen from h spans 2 asin(R/(R + h)).
    session = Session(name)
    bottom, top = (1e3 * float(session.value(f"shell.{end}_radius")) for end in ("bottom", "top"))
    view = view_of(viewpoint, bottom_radius=bottom, top_radius=top, bearing=100.0)
    session.move(view)
    altitude, look = view["view.altitude"], view["view.look_zenith"]
    if viewpoint.name == "planet":
        assert look == 180.0
        upright = math.degrees(2.0 * math.atan(math.tan(math.radians(30.0)) * 9.0 / 16.0))
        assert 2.0 * math.degrees(math.asin(bottom / (bottom + altitude))) < upright + 6.0
    else:
        assert abs(horizon_zenith(altitude, bottom) - look) < 10.0
        assert altitude < 10.0 * (top - bottom)
