"""Orthographic pictures: parallel lines, and the disc of a planet by geometry alone."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import Camera, ParameterError, Scene, load_planet, render, solve
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.picture.gpu_renderer import GpuRenderer
from airlight.scene.projections.orthographic import disc_extent
from airlight.solver.moments.solution import MomentsSolution

EARTH = load_planet("earth-bruneton")
RADIUS, TOP = EARTH.bottom_radius, EARTH.top_radius


@pytest.fixture(scope="module")
def lit() -> MomentsSolution:
    return solve(EARTH, (680.0, 550.0, 440.0), "preview")


def globe(side: int = 64, **more: Any) -> Scene:
    camera = Camera(
        projection="orthographic", width=side, height=side,
        extent=disc_extent(TOP, side, side),
    )  # fmt: skip
    return Scene(camera=camera, **more)


def test_lines_of_sight_are_parallel_and_pass_the_centre_at_the_pixels_distance() -> None:
    # The definition: a pixel's line passes the centre at the pixel's own distance, of 1e12 m to R.
    scene = globe()
    view = scene.camera.directions()
    assert np.arccos(np.clip(-view[..., 2], -1.0, 1.0)).max() < 1e-5
    across = np.hypot(view[..., 0], view[..., 1]) * (RADIUS + scene.altitude)
    step = scene.camera.extent / 64.0
    x = (np.arange(64) + 0.5 - 32.0) * step
    assert_allclose(across, np.hypot(x[None, :], x[:, None]), rtol=1e-5)


def test_the_disc_is_as_large_as_the_planet(lit: MomentsSolution) -> None:
    # Area of a circle of the ground's radius, counted in pixels that are lit from behind the
    # observer; the air around it, 60 km, adds 1.9 %, and a pixel of the rim is 2 % of the radius.
    scene = globe(128, sun_zenith=0.0)
    light = render(lit, scene).rgb[..., 1]
    disc = np.count_nonzero(light > 0.2 * light.max()) * (scene.camera.extent / 128.0) ** 2
    assert np.pi * RADIUS**2 * 0.99 < disc < np.pi * TOP**2 * 1.02
    assert light[0, 0] == 0.0


def test_a_full_disc_sends_what_its_radiances_say(lit: MomentsSolution) -> None:
    # The second method: single lines of sight by the solution. Pictures march fewer points: 0.3 %.
    scene = globe(65, sun_zenith=50.0)
    rgb = render(lit, scene, exact=True).rgb
    radius = RADIUS + scene.altitude
    for row, column in ((32, 32), (32, 50), (20, 24)):
        x, y, _ = scene.camera.directions(slice(row, row + 1))[0, column]
        azimuth = np.degrees(np.arctan2(-y, x))
        values = np.asarray(lit.radiance(
            altitude=radius - RADIUS, sun_zenith=50.0, azimuth=azimuth,
            view_zenith=180.0 - np.degrees(np.arcsin(np.hypot(x, y))),
        ))  # fmt: skip
        source = lit.lights[0]
        wanted = (values / source.irradiance) @ source.colors()
        assert_allclose(rgb[row, column], wanted, rtol=4e-3)


def test_the_north_is_at_the_top_and_the_east_on_the_right() -> None:
    # A map's own orientation, seen from above, for a sun in any direction.
    scene = globe(sun_azimuth=105.0, latitude=0.0, longitude=0.0).north_up()
    planet = scene.camera.directions() @ scene.ground_frame.T
    north = planet[..., 2]
    east = planet[..., 1]
    assert north[0, 32] > 0.0 > north[-1, 32]
    assert east[32, -1] > 0.0 > east[32, 0]


@pytest.mark.parametrize(
    ("changes", "field"),
    [
        ({"extent": None}, "camera.extent"),
        ({"field_of_view": 60.0}, "camera.field_of_view"),
        ({"look_zenith": 90.0}, "camera.look_zenith"),
    ],
)
def test_what_an_orthographic_camera_has_not_is_refused(
    changes: dict[str, Any], field: str
) -> None:
    given = {"projection": "orthographic", "width": 8, "height": 8, "extent": "14000 km"}
    with pytest.raises(ParameterError, match=field):
        Camera(**{**given, **changes})


def test_an_orthographic_camera_has_no_altitude_and_others_no_extent() -> None:
    with pytest.raises(ParameterError, match=r"scene\.altitude"):
        globe(altitude=400e3)
    with pytest.raises(ParameterError, match=r"camera\.extent"):
        Camera(extent=1e6)


def test_a_device_draws_the_cpu_s_disc(device: Device, lit: MomentsSolution) -> None:
    # The second method: double precision, and the CPU's own rows of pixels. Light that is
    # not shown, below 1e-3 of the brightest, is left out.
    pictures = GpuRenderer(device)
    pictures.set_solution(lit)
    scene = globe(128, sun_zenith=50.0)
    wanted, got = render(lit, scene).rgb, pictures.render(scene).rgb
    assert_allclose(got, wanted, rtol=1e-2, atol=1e-3 * wanted.max())
