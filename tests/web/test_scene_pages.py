"""Pages of scenes of several bodies, compared with the CPU's pictures of the same scene."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from page_picture import opened_subject, page_picture

from airlight.errors import ParameterError
from airlight.image.display import to_display
from airlight.render.render_system import render_solved_system
from airlight.render.scene_lights import SceneLights
from airlight.viewer.browser.page_subject import ScenePage, page_subject
from airlight.viewer.parameters.view_parameters import settings_of

WIDTH, HEIGHT = 160, 90
#: Two planets with air, of which the first refracts; a moon half in the shadow of the second, lit
#: by it too, and another before the sun.
SCENE = """
name = "Two planets"
stars = true

[[bodies]]
name = "near"
planet = "exoplanet"
position = ["0 km", "0 km", "0 km"]

[[bodies]]
name = "far"
planet = "mars-rayleigh"
position = ["60000 km", "6000 km", "0 km"]

[[bodies]]
name = "rock"
radius = "1200 km"
albedo = 0.3
reflection = "lommel-seeliger"
position = ["54000 km", "-2200 km", "-1800 km"]

[[bodies]]
name = "pebble"
radius = "130 km"
reflection = "moon"
position = ["30327 km", "23960 km", "-7421 km"]

[[lights]]
star = { spectrum = "astm-g173" }
direction = [0.55, 0.8, -0.25]

[[lights]]
body = "far"

[observer]
body = "near"
latitude = "0 deg"
longitude = "0 deg"
altitude = "8000 km"

[camera]
look_at = "far"
up = [0, 0, 1]
field_of_view = "25 deg"
"""
#: Views: from space, from the ground through the air, past the limb with a filter, of the sun.
VIEWS: dict[str, dict[str, Any]] = {
    "space": {},
    "ground": {"view.altitude": 2.0, "view.latitude": -8.0, "view.longitude": -78.0,
               "view.look_zenith": 80.0, "view.heading": 88.0, "view.field_of_view": 40.0},
    "a filter": {"view.altitude": 3e5, "view.longitude": -95.0, "view.look_zenith": 102.0,
                 "view.heading": 85.0, "view.field_of_view": 30.0, "view.filter": True,
                 "view.polariser": 70.0},
    "stars": {"view.look_zenith": 50.0, "view.heading": 250.0, "view.field_of_view": 60.0},
    "sun": {"view.look_zenith": 56.73, "view.heading": 107.35, "view.field_of_view": 1.5},
}  # fmt: skip
#: Paths of the camera and the sun.
ANGLES = ("look_zenith", "heading", "roll", "sun_zenith", "sun_azimuth")


@pytest.fixture(scope="module")
def subject(tmp_path_factory: pytest.TempPathFactory) -> ScenePage:
    """Scene of a page."""
    file = tmp_path_factory.mktemp("scenes") / "two.toml"
    file.write_text(SCENE, encoding="utf-8")
    found = page_subject(file, {})
    assert isinstance(found, ScenePage)
    return found


@pytest.fixture(scope="module")
def solutions(subject: ScenePage) -> Any:
    """Solutions of both planets."""
    return subject.solved("three", "preview")


@pytest.fixture(scope="module")
def page(
    subject: ScenePage, solutions: Any, kept_open: Callable[..., Any],
    tmp_path_factory: pytest.TempPathFactory,
) -> Any:  # fmt: skip
    """Page, open in a browser."""
    return opened_subject(subject, solutions, kept_open, tmp_path_factory.mktemp("pages"))


@pytest.mark.parametrize("name", VIEWS)
def test_a_page_draws_a_scene_as_the_cpu_does(
    name: str, subject: ScenePage, solutions: Any, page: Any
) -> None:
    values = subject.values(VIEWS[name])
    lights = SceneLights(subject.at(values), solutions["near"].wavelengths, solutions)
    frame = render_solved_system(lights, (WIDTH, HEIGHT, None))
    fixed = {"display.automatic": False, "display.exposure": frame.exposure}
    wanted = to_display(frame.rgb, frame.exposure, settings=settings_of(values), **frame.lens)
    got, _ = page_picture(page, {**VIEWS[name], **fixed}, (WIDTH, HEIGHT))
    off = np.abs(got - wanted).max(axis=-1)
    assert wanted.max() > 150.0
    assert off.mean() < 0.2
    if name == "stars":
        assert 20 < (wanted.max(axis=-1) > 100.0).sum() < wanted.size // 30
    assert (off > 2.0).mean() < 0.005  # samples on edges
    # Metered in small, a thin crescent covers other pixels.
    _, exposure = page_picture(page, VIEWS[name], (WIDTH, HEIGHT))
    assert exposure == pytest.approx(frame.exposure, abs=0.3)


def test_time_stands_still_in_a_scene_without_a_date(page: Any) -> None:
    page.evaluate("airlight.ready")
    assert page.evaluate("airlight.parts.tools.querySelectorAll('button:disabled').length") >= 1
    assert page.evaluate("airlight.state.later(3)") == {}


def test_sun_and_camera_follow_the_time_and_the_place(modules: Callable[..., Any]) -> None:
    subject = page_subject("lunar-eclipse", {})
    assert isinstance(subject, ScenePage)
    solutions = subject.solved("three", "preview")
    values = subject.values({})
    picture = subject.data(solutions, "", values, "three")["picture"]
    space = {name: picture[name] for name in ("geometry", "thickness", "radius", "flattening")}
    found = modules({"drawing/scene_space": ("SceneSpace",)}).evaluate(
        """([scene, planet, values]) => {
          const space = new SceneSpace(scene, planet);
          const moved = { "view.latitude": -40, "view.altitude": 2 };
          const still = space.follow(values, moved);
          const later = space.follow({ ...values, ...still }, { "scene.hours": 2.75 });
          const turned = { ...values, "view.heading": values["view.heading"] + 1 };
          const aside = space.follow(turned, { "scene.hours": 2.75 });
          return [space.follow(values, { "scene.hours": -1.2 }), still, later, aside];
        }""",
        [picture["scene"], space, values],
    )
    earlier, still, later, aside = ({**values, **one} for one in found)
    # Positions are interpolated between samples of half an hour.
    assert_allclose(apart(earlier, subject.values({"scene.hours": -1.2}), ANGLES), 0.0, atol=0.002)
    moved = subject.values({"view.latitude": -40.0, "view.altitude": 2.0, "scene.hours": 2.75})
    assert_allclose(apart(later, moved, ANGLES[3:]), 0.0, atol=0.002)
    for turned in (still, later, aside):  # the camera no longer looks at the Moon
        assert_allclose(apart(turned, values, ANGLES[:1]), 0.0, atol=1e-9)


def apart(one: dict[str, Any], other: dict[str, Any], names: tuple[str, ...]) -> list[float]:
    """Differences of angles of two views. [deg]"""
    paths = [f"view.{name}" for name in names]
    return [math.remainder(one[path] - other[path], 360.0) for path in paths]


def test_time_ends_where_the_moons_shadow_falls_on_air() -> None:
    # The partial eclipse of 21 August 2017 began on Earth at 15:47 UT (Espenak 2014).
    subject = page_subject("lunar-eclipse", {"time": "2017-08-21T12:00Z"})
    assert isinstance(subject, ScenePage)
    solutions = subject.solved("three", "preview")
    data = subject.data(solutions, "", subject.values({}), "three")
    (time,) = (one for one in data["parameters"] if one["path"] == "scene.hours")
    assert time["most"] == time["high"] == 3.5
    assert time["least"] == -12.0
    with pytest.raises(ParameterError, match=r"scene\.hours is 6.*; allowed: -12 to 3\.5 h"):
        subject.data(solutions, "", subject.values({"scene.hours": 6.0}), "three")
