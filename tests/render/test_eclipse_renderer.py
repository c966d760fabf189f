"""Pictures of a planet in the shadow of a moon, against pictures without the moon."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import airlight
from airlight.geometry.occulted_star import occulted_star
from airlight.render.cpu_renderer import CpuRenderer
from airlight.render.eclipse_renderer import EclipseRenderer
from airlight.render.pixels.polarising_filter import ALONG
from airlight.scene import Camera, Scene
from airlight.scene.local_ground import local_ground
from airlight.solver.eclipsed.solution import EclipsedSolution
from airlight.solver.moments.solution import MomentsSolution

NM = (680.0, 550.0, 440.0)
WIDTH, HEIGHT = 24, 16


@pytest.fixture(scope="module")
def earth() -> MomentsSolution:
    # A coast: land, water and clouds.
    planet = local_ground(airlight.load_planet("earth"), latitude=44.0, longitude=-124.0,
                          altitude=400e3)  # fmt: skip
    return airlight.solve(planet, NM, quality="preview")


def eclipsed(solution: MomentsSolution, zenith: float, size: float) -> EclipsedSolution:
    """Sun in the x-z plane and a moon before it, over the observer."""
    z = np.radians(zenith)
    towards = np.array([np.sin(z), 0.0, np.cos(z)])
    alpha, distance = solution.lights[0].angular_radius, 370e6
    place = np.array([0.0, 0.0, solution.medium.bottom_radius])
    star = occulted_star(
        place + distance * towards, distance * np.sin(size * alpha), towards, alpha,
        darkening=solution.lights[0].darkening(solution.wavelengths),
        reach=solution.medium.top_radius,
    )  # fmt: skip
    return EclipsedSolution(solution, star, cache=False)


def rendered(renderer: CpuRenderer) -> np.ndarray:
    rgb = np.zeros((HEIGHT, WIDTH, 3), np.float32)
    renderer.fill_sky_view()
    renderer.render_rows(0, HEIGHT, rgb)
    return rgb


@pytest.mark.parametrize(
    ("altitude", "look_zenith", "error"), [(2.0, 85.0, 1e-3), (400e3, 115.0, 6e-3)]
)
def test_a_tiny_moon_leaves_the_picture(
    earth: MomentsSolution, altitude: float, look_zenith: float, error: float
) -> None:
    # In the shadow the sea mirrors one direction of the sky, by day the mean over its facets.
    camera = Camera(width=WIDTH, height=HEIGHT, field_of_view=60.0, look_zenith=look_zenith,
                    look_azimuth=70.0, roll=10.0)  # fmt: skip
    scene = Scene(camera=camera, altitude=altitude, sun_zenith=65.0, latitude=44.0,
                  longitude=-124.0, sun_azimuth=110.0, ground="detailed")  # fmt: skip
    tiny = eclipsed(earth, 65.0, 0.005)
    got = rendered(EclipseRenderer(tiny, scene, np.eye(3)))
    expected = rendered(CpuRenderer(earth, scene, exact=True, disc=False))
    assert_allclose(got, expected, rtol=error, atol=1e-4 * expected.max())


def test_a_filter_and_q_and_u_are_refused_in_the_shadow(earth: MomentsSolution) -> None:
    camera = Camera(width=WIDTH, height=HEIGHT)
    scene = Scene(camera=replace(camera, polariser=30.0), altitude=2.0, sun_zenith=65.0)
    shadow = eclipsed(earth, 65.0, 0.5)
    with pytest.raises(airlight.ParameterError, match=r"camera\.polariser is 30\.0; allowed: none"):
        EclipseRenderer(shadow, scene, np.eye(3))
    renderer = EclipseRenderer(shadow, replace(scene, camera=camera), np.eye(3))
    with pytest.raises(airlight.ParameterError, match="stokes is True; allowed: False where"):
        renderer.render_rows(0, 1, np.zeros((HEIGHT, WIDTH, 3), np.float32), ALONG)


def test_the_shadow_is_a_dark_spot_seen_from_space(earth: MomentsSolution) -> None:
    camera = Camera(width=WIDTH, height=HEIGHT, field_of_view=30.0, look_zenith=180.0)
    scene = Scene(camera=camera, altitude=1.2e7, sun_zenith=30.0, latitude=44.0, longitude=-124.0)
    day = rendered(CpuRenderer(earth, scene, exact=True, disc=False))[..., 1]
    part = rendered(EclipseRenderer(eclipsed(earth, 30.0, 1.03), scene, np.eye(3)))[..., 1]
    part = part / np.maximum(day, 1e-3)  # the dark of space is 0
    middle = part[HEIGHT // 2 - 1 : HEIGHT // 2 + 1, WIDTH // 2 - 1 : WIDTH // 2 + 1]
    assert middle.max() < 0.1
    column = part[: HEIGHT // 2, WIDTH // 2]
    assert np.all(np.diff(column[2:]) < 0.0)  # lighter away from the umbra
    assert column.max() > 0.5
