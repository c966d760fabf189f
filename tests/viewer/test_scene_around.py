"""Scene of several bodies around the planet of a session."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import ConflictError
from airlight.scene.system import load_system
from airlight.viewer.window.start import Start, opened


@pytest.mark.parametrize(
    ("name", "body"),
    [
        ("iss", "earth"),
        ("earth-moon", "earth"),
        ("mars-phobos", "mars"),
        ("binary-sunset", "planet"),
        ("orion", "earth"),
    ],
)
def test_a_session_begins_with_the_view_of_the_scene_file(name: str, body: str) -> None:
    # The place above the session's planet, its camera and its sun are those of the file, though
    # that has its observer above a moon, or a direction in space; a date counts whole seconds.
    session, wanted = opened(Start(planet=name)), load_system(name)
    around = session.around
    assert around is not None
    assert around.body == body
    got = around.seen(session.view, None)
    scale = float(np.linalg.norm(wanted.eye - wanted.body(body).centre))
    assert_allclose(got.eye, wanted.eye, rtol=0.0, atol=1e-6 * scale)
    assert_allclose(got.camera_axes, wanted.camera_axes, rtol=0.0, atol=2e-6)
    for one, other in zip(got.lights, wanted.lights, strict=True):
        if one.star is not None:
            assert_allclose(one.towards(got.eye), other.towards(wanted.eye), rtol=0.0, atol=1e-6)
    assert got.view.camera(64, 36, None).field_of_view == pytest.approx(
        wanted.view.camera(64, 36, None).field_of_view
    )
    assert not session.can_undo


def test_time_moves_the_bodies_of_a_scene_with_an_ephemeris() -> None:
    # As the file at the later time has them.
    session = opened(Start(planet="iss"))
    assert session.view["view.clock"]
    session.set("view.hour", 23.0)
    assert session.around is not None
    got = session.around.seen(session.view, None)
    wanted = load_system("iss", {"time": datetime(2024, 4, 20, 23, tzinfo=UTC).isoformat()})
    for one, other in zip(got.bodies, wanted.bodies, strict=True):
        assert_allclose(one.position, other.position)


def test_the_camera_of_a_scene_follows_the_body_that_it_looks_at() -> None:
    # As that of the file at the later time; after a turn by hand it stays.
    session = opened(Start(planet="lunar-eclipse"))
    session.set("view.hour", 8.5)
    assert session.around is not None
    got = session.around.seen(session.view, None)
    wanted = load_system("lunar-eclipse", {"time": "2025-03-14T08:30Z"})
    assert_allclose(got.camera_axes, wanted.camera_axes, rtol=0.0, atol=2e-6)
    session.set("view.heading", float(session.view["view.heading"]) + 1.0)
    turned = session.view["view.heading"]
    session.set("view.hour", 9.0)
    assert session.view["view.heading"] == turned


def test_the_sun_is_moved_by_hand_in_a_scene() -> None:
    # Its zenith angle above the place is then the session's.
    session = opened(Start(planet="mars-phobos"))
    session.move({"view.sun_zenith": 20.0, "view.sun_azimuth": 75.0})
    assert session.around is not None
    got = session.around.seen(session.view, None)
    mars = got.body("mars")
    up = (got.eye - mars.centre) / np.linalg.norm(got.eye - mars.centre)
    assert_allclose(got.lights[0].towards(got.eye) @ up, np.cos(np.radians(20.0)), rtol=1e-9)


def test_an_edited_planet_is_the_scene_s() -> None:
    session = opened(Start(planet="mars-phobos", changes=("mars.ground.albedo=0.9",)))
    assert session.around is not None
    planet = session.around.system.planets["mars"]
    assert session.value("ground.albedo") == 0.9
    darker = replace(planet, name="darker")
    assert session.around.seen(session.view, darker).planets["mars"] is darker


def test_a_scene_that_the_gpu_does_not_draw_is_refused() -> None:
    with pytest.raises(ConflictError, match="corona"):
        opened(Start(planet="solar-eclipse-2017"))
