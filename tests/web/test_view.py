"""What the browser computes by itself: the same numbers as the Python of the scene."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.testing import assert_allclose

from airlight.color.exposure import automatic_exposure
from airlight.color.tone_maps import tone_map_named
from airlight.color.xyz import luminance
from airlight.scene import Camera, Scene

#: Nobody's special case.
VIEW = {
    "view.altitude": 1234.5,
    "view.latitude": 47.0,
    "view.longitude": -12.0,
    "view.look_zenith": 71.0,
    "view.heading": 203.0,
    "view.roll": 17.0,
    "view.field_of_view": 55.0,
    "view.projection": "perspective",
    "view.sun_zenith": 66.0,
    "view.sun_azimuth": 141.0,
}


def test_directions_are_those_of_the_scene(modules: Callable[..., Any]) -> None:
    # a second method: scene/directions.py and scene/observer.py
    page = modules({"drawing/view": ("cameraOf",)})
    got = page.evaluate(
        "([view, limits]) => cameraOf(view, limits)", [VIEW, {"perspective": [1e-3, 170]}]
    )
    camera = Camera(look_zenith=71.0, look_azimuth=203.0 - 141.0, roll=17.0)
    scene = Scene(camera=camera, sun_zenith=66.0, latitude=47.0, longitude=-12.0, sun_azimuth=141.0)
    # a few roundings of float64
    assert_allclose(got["axes"], camera.axes, atol=1e-14)
    assert_allclose(got["sun"], scene.sun_direction, atol=1e-14)
    assert_allclose(got["ground"], scene.ground_frame, atol=1e-14)
    assert_allclose(got["fieldOfView"], np.radians(55.0), rtol=1e-15)


def test_automatic_exposure_is_that_of_the_picture(modules: Callable[..., Any]) -> None:
    # a second method: color/exposure.py; a third of the pixels is black space
    rgb = np.random.default_rng(3).lognormal(0.0, 2.0, (9, 16, 3)).astype(np.float32)
    rgb[:3] *= 1e-9
    rgba = np.concatenate([rgb, np.ones((9, 16, 1), np.float32)], axis=2)
    grey = float(luminance(tone_map_named("hable").inverse(np.full(3, 0.18))))
    weights = luminance(np.eye(3)).tolist()
    page = modules({"drawing/exposure": ("automaticExposure",)})
    got = page.evaluate(
        "([rgba, grey, weights]) => automaticExposure(new Float32Array(rgba), grey, weights)",
        [rgba.ravel().tolist(), grey, weights],
    )
    assert_allclose(got, automatic_exposure(rgb), rtol=1e-12)


def test_flight_round_the_planet_ends_where_it_began(modules: Callable[..., Any]) -> None:
    # a great circle closes; the sun, fixed in space, is then where it was, and so is the heading
    page = modules({"ui/journey": ("moved",)})
    radius, altitude, steps = 1000.0, 250.0, 720
    length = (radius + altitude) * np.tan(2.0 * np.pi / steps)
    heading = np.radians(VIEW["view.heading"])
    got = page.evaluate(
        """([view, radius, length, steps]) => {
          let values = { ...view };
          const track = [];
          for (let i = 0; i < steps; i++) {
            const course = (values["view.heading"] * Math.PI) / 180;
            const step = [length * Math.sin(course), length * Math.cos(course), 0];
            const next = moved(values, radius, step);
            values = { ...values, ...next, "view.altitude": view["view.altitude"] };
            track.push(next["view.altitude"] - view["view.altitude"], values["view.sun_zenith"]);
          }
          return [values, track];
        }""",
        [{**VIEW, "view.altitude": altitude}, radius, float(length), steps],
    )
    values, track = got
    for name in ("latitude", "longitude", "heading", "sun_zenith", "sun_azimuth"):
        assert_allclose(values[f"view.{name}"], VIEW[f"view.{name}"], atol=1e-8, err_msg=name)
    # a step along the tangent gains height by Pythagoras
    gain = np.hypot(radius + altitude, length) - (radius + altitude)
    assert_allclose(track[0::2], gain, rtol=1e-9)
    # on the circle the sun's zenith angle swings between the plane's angle and its supplement
    east, north, up = np.eye(3)
    sun_zenith, bearing = np.radians(VIEW["view.sun_zenith"]), np.radians(VIEW["view.sun_azimuth"])
    sun = np.sin(sun_zenith) * (np.sin(bearing) * east + np.cos(bearing) * north)
    sun = sun + np.cos(sun_zenith) * up
    course = np.sin(heading) * east + np.cos(heading) * north
    swing = np.degrees(np.arccos(np.hypot(sun @ up, sun @ course)))
    assert_allclose([min(track[1::2]), max(track[1::2])], [swing, 180.0 - swing], atol=0.01)
