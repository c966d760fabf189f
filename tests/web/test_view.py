"""The browser's computations of the view give the numbers of the Python scene."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.testing import assert_allclose

from airlight.image.exposure import automatic_exposure
from airlight.scene import Camera, Scene
from airlight.scene.flight import FOOTING, RATE
from airlight.scene.metering import scene_exposure
from airlight.scene.moon_light import MoonLight
from airlight.viewer.navigation.flight import flown

#: Generic view, without special angles.
VIEW = {
    "view.altitude": 1234.5,
    "view.latitude": 47.0,
    "view.longitude": -12.0,
    "view.look_zenith": 71.0,
    "view.heading": 203.0,
    "view.roll": 17.0,
    "view.filter": True,
    "view.polariser": 40.0,
    "view.dehaze": 0.9,
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
    camera = Camera(look_zenith=71.0, look_azimuth=203.0 - 141.0, roll=17.0, polariser=40.0)
    scene = Scene(camera=camera, sun_zenith=66.0, latitude=47.0, longitude=-12.0, sun_azimuth=141.0)
    # a few rounding errors of float64
    assert_allclose(got["axes"], camera.axes, atol=1e-14)
    assert_allclose(got["filter"], camera.filter_axis, atol=1e-14)
    assert_allclose(got["sun"], scene.sun_direction, atol=1e-14)
    assert_allclose(got["ground"], scene.ground_frame, atol=1e-14)
    assert_allclose(got["fieldOfView"], np.radians(55.0), rtol=1e-15)


def test_automatic_exposure_is_that_of_the_scene(modules: Callable[..., Any]) -> None:
    # a second method: scene/metering.py; a third of the pixels is black space, the sun is in view
    rgb = np.random.default_rng(3).lognormal(0.0, 2.0, (9, 16, 3)).astype(np.float32)
    rgb[:3] *= 1e-9
    camera = Camera(width=16, height=9, look_zenith=70.0, roll=17.0, field_of_view=55.0)
    scene = Scene(camera=camera, sun_zenith=66.0)
    rgb[camera.directions() @ scene.sun_direction > np.cos(0.06)] = 1e5
    rgba = np.concatenate([rgb, np.ones((9, 16, 1), np.float32)], axis=2)
    page = modules({"drawing/exposure": ("automaticExposure",), "drawing/view": ("cameraOf",)})
    view = {**VIEW, "view.look_zenith": 70.0, "view.heading": 141.0}
    got = page.evaluate(
        """([rgba, view]) => automaticExposure(
          new Float32Array(rgba), [16, 9], cameraOf(view, { perspective: [1e-3, 170] }), 0, 0.005,
          4.0,
        )""",
        [rgba.ravel().tolist(), view],
    )
    wanted = scene_exposure(rgb, scene, 0.005, 4.0)
    assert_allclose(got, wanted, rtol=1e-12)
    assert abs(wanted - automatic_exposure(rgb)) > 1.0  # the weights count


def test_automatic_exposure_leaves_out_every_light(modules: Callable[..., Any]) -> None:
    # a second method: scene/metering.py; the moon's own, larger disc covers a part of the picture
    rgb = np.random.default_rng(3).lognormal(0.0, 2.0, (9, 16, 3)).astype(np.float32)
    camera = Camera(width=16, height=9, look_zenith=70.0, field_of_view=55.0)
    moon = MoonLight(zenith=66.0, azimuth=6.0, angular_radius=8.0)
    scene = Scene(camera=camera, sun_zenith=110.0, secondary_lights=(moon,))
    rgb[camera.directions() @ moon.direction > np.cos(np.radians(8.0))] = 1e5
    rgba = np.concatenate([rgb, np.ones((9, 16, 1), np.float32)], axis=2)
    page = modules({"drawing/exposure": ("automaticExposure",), "drawing/view": ("cameraOf",)})
    view = {**VIEW, "view.look_zenith": 70.0, "view.heading": VIEW["view.sun_azimuth"],
            "view.roll": 0.0}  # fmt: skip
    suns = [[one.direction.tolist(), one.radius(0.005)] for one in scene.lights]
    got = page.evaluate(
        """([rgba, view, suns]) => automaticExposure(
          new Float32Array(rgba), [16, 9],
          { ...cameraOf(view, { perspective: [1e-3, 170] }), suns }, 0, 0.005, 0
        )""",
        [rgba.ravel().tolist(), view, suns],
    )
    wanted = scene_exposure(rgb, scene, 0.005)
    assert_allclose(got, wanted, rtol=1e-12)
    assert abs(wanted - automatic_exposure(rgb)) > 0.3


def test_flight_round_the_planet_ends_where_it_began(modules: Callable[..., Any]) -> None:
    # a great circle closes; the sun, fixed in space, and the heading then return
    page = modules({"ui/flight": ("flown",)})
    radius, altitude, steps = 1000.0, 250.0, 720
    seconds = 2.0 * np.pi / steps * (radius + altitude) / (RATE * (altitude + FOOTING))
    view = {**VIEW, "view.altitude": altitude, "view.look_zenith": 90.0}
    values, track = page.evaluate(
        """([view, radius, seconds, steps]) => {
          let values = { ...view };
          const track = [];
          for (let i = 0; i < steps; i++) {
            values = { ...values, ...flown(values, 0, 1, 0, seconds, radius) };
            track.push(values["view.sun_zenith"]);
          }
          return [values, track];
        }""",
        [view, radius, seconds, steps],
    )
    for path, value in view.items():
        if isinstance(value, float):
            assert_allclose(values[path], value, atol=1e-8, err_msg=path)
    # on the circle the sun's zenith angle varies between the plane's angle and its supplement
    east, north, up = np.eye(3)
    heading = np.radians(VIEW["view.heading"])
    sun_zenith, bearing = np.radians(VIEW["view.sun_zenith"]), np.radians(VIEW["view.sun_azimuth"])
    sun = np.sin(sun_zenith) * (np.sin(bearing) * east + np.cos(bearing) * north)
    sun = sun + np.cos(sun_zenith) * up
    course = np.sin(heading) * east + np.cos(heading) * north
    swing = np.degrees(np.arccos(np.hypot(sun @ up, sun @ course)))
    assert_allclose([min(track), max(track)], [swing, 180.0 - swing], atol=0.01)


def test_flight_is_that_of_the_window(modules: Callable[..., Any]) -> None:
    # a second method: navigation/flight.py, over positions, views, directions and altitudes
    page = modules({"ui/flight": ("flown",)})
    rng = np.random.default_rng(7)
    ways = [(0, 1, 0), (1, 0, 0), (0, 0, 1), (-1, 1, 0), (1, -1, 1), (0, 0, 0)]
    flights = []
    for altitude in (1.0, 300.0, 4e5, 1e8, 1e12):
        for latitude in (-90.0, -89.9, 0.0, 51.0, 90.0):
            for way in ways:
                turns = rng.uniform(0.0, 360.0, 3)
                view = {
                    **VIEW,
                    "view.altitude": altitude,
                    "view.latitude": latitude,
                    "view.longitude": float(turns[0]) - 180.0,
                    "view.heading": float(turns[1]),
                    "view.sun_azimuth": float(turns[2]),
                    "view.look_zenith": float(rng.uniform(0.0, 180.0)),
                    "view.sun_zenith": float(rng.uniform(0.0, 180.0)),
                }
                flights.append([view, *way, 0.1, 6.371e6])
    got = page.evaluate("(flights) => flights.map((one) => flown(...one))", flights)
    assert len(got) == len(flights)
    for one, flight in zip(got, flights, strict=True):
        wanted = flown(*flight)
        assert one.keys() == wanted.keys()
        for path, value in wanted.items():
            # degrees: two mathematics libraries, a few roundings apart
            assert_allclose(one[path], value, rtol=1e-13, atol=2e-9, err_msg=f"{path} of {flight}")
