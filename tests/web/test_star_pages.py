"""Star catalogue, Milky Way and zodiacal light on the page of a planet, as on the CPU."""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, datetime, timedelta
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from page_picture import opened_subject, page_picture

from airlight.geometry.ephemeris.instant import days_of
from airlight.geometry.ephemeris.sky import Place, horizon_axes, horizon_axes_by_sun, sun_seen
from airlight.image.display import to_display
from airlight.render import render
from airlight.render.star_points import add_catalogue
from airlight.viewer.browser.page_subject import PlanetPage, page_subject
from airlight.viewer.browser.star_sky import planet_sky
from airlight.viewer.parameters.view_parameters import scene_of, settings_of

WIDTH, HEIGHT = 240, 135
NIGHT: dict[str, Any] = {
    "view.altitude": 2.0, "view.sun_zenith": 115.0, "view.sun_azimuth": 290.0,
    "view.latitude": 48.0, "view.longitude": -30.0, "view.look_zenith": 75.0,
    "view.heading": 205.0, "view.field_of_view": 60.0, "display.automatic": False,
    "display.exposure": 15.0,
}  # fmt: skip
#: Views: Orion above the ground, zodiacal light by a filter, and a moon before the stars.
VIEWS: dict[str, dict[str, Any]] = {
    "orion": {},
    "zodiacal light": {"view.look_zenith": 60.0, "view.heading": 275.0, "view.filter": True},
    "moon": {"view.second_light": "moon", "view.second_zenith": 60.0, "view.moon_phase": 150.0,
             "view.second_azimuth": 205.0, "view.second_radius": 4.0, "view.look_zenith": 60.0},
}  # fmt: skip


@pytest.fixture(scope="module")
def subject() -> PlanetPage:
    """Earth of a page."""
    found = page_subject("earth-atmosphere-plus", {"ground.albedo": 0.1})
    assert isinstance(found, PlanetPage)
    return found


@pytest.fixture(scope="module")
def solutions(subject: PlanetPage) -> Any:
    """Its solution."""
    return subject.solved("three", "preview")


@pytest.fixture(scope="module")
def page(
    subject: PlanetPage, solutions: Any, kept_open: Callable[..., Any],
    tmp_path_factory: pytest.TempPathFactory,
) -> Any:  # fmt: skip
    """Page, open in a browser."""
    return opened_subject(subject, solutions, kept_open, tmp_path_factory.mktemp("pages"))


@pytest.mark.parametrize("name", VIEWS)
def test_the_night_of_a_page_has_the_stars_of_the_cpu(
    name: str, subject: PlanetPage, solutions: Any, page: Any
) -> None:
    values = subject.values(NIGHT | VIEWS[name])
    (solution,) = solutions.values()
    scene = scene_of(values, WIDTH, HEIGHT)
    frame = render(solution, scene)
    bare = to_display(frame.rgb, 15.0, settings=settings_of(values), **frame.lens)
    add_catalogue(frame.rgb, scene, solution, subject.planet.body)
    wanted = to_display(frame.rgb, 15.0, settings=settings_of(values), **frame.lens)
    got, _ = page_picture(page, NIGHT | VIEWS[name], (WIDTH, HEIGHT))
    assert (wanted.astype(float) - bare).max() > 100.0  # there is something to compare
    off = np.abs(got - wanted).max(axis=-1)
    assert off.mean() < 0.5
    assert (off > 2.0).mean() < 0.01
    dark, _ = page_picture(page, {**NIGHT, **VIEWS[name], "display.exposure": 2.5}, (32, 18))
    assert dark.max() < 255.0


@pytest.mark.parametrize("body", ["earth", "mars"])
def test_the_sky_turns_with_the_sun_and_the_date(
    body: str, solutions: Any, modules: Callable[..., Any]
) -> None:
    (solution,) = solutions.values()
    sky = planet_sky(solution.lights[0], body)
    assert sky is not None
    ask = modules({"drawing/star_layers": ("skyFrame",)}).evaluate
    place = Place(body=body, latitude=35.0, longitude=10.0)
    script = "([values, years]) => skyFrame(values, years).frame"

    def level(values: dict[str, Any]) -> np.ndarray:
        """Axes to the east, the north and the zenith in the frame of the J2000 equator."""
        ahead, left, up = np.array(ask(script, [values, sky["years"]]))
        turn = np.radians(values["view.sun_azimuth"])
        north = np.cos(turn) * ahead + np.sin(turn) * left
        return np.stack([np.cross(north, up), north, up])

    sun = {"view.latitude": 35.0, "view.sun_zenith": 112.0, "view.sun_azimuth": 265.0}
    wanted = horizon_axes_by_sun(place, 112.0, 265.0)
    assert_allclose(level({**sun, "view.clock": False}), wanted, atol=0.003)
    for day in (20, 172, 230):  # also when the declination falls
        time = datetime(2026, 1, 1, 22, tzinfo=UTC) + timedelta(days=day - 1)
        seen = sun_seen(place, time)
        date = {"view.clock": True, "view.year": 2026, "view.day": day, "view.hour": 22.0}
        sun = {"view.latitude": 35.0, "view.sun_zenith": seen.zenith}
        values = {**date, **sun, "view.sun_azimuth": seen.azimuth}
        assert_allclose(level(values), horizon_axes(place, days_of(time)), atol=0.006)
