"""Pictures of single and of multiple scattering."""

from __future__ import annotations

import numpy as np
import pytest
from marched_pictures import centres
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.planets import load_planet, replace
from airlight.render import render
from airlight.scene import Camera, Scene
from airlight.solver import solve
from airlight.solver.moments.solution import MomentsSolution

NM = (440.0, 550.0, 680.0)


@pytest.fixture(scope="module")
def earth() -> MomentsSolution:
    planet = load_planet("earth-atmosphere-plus")
    point = replace(planet, star=replace(planet.star, angular_radius=0.0))
    return solve(point, NM, "preview")


def scene(altitude: float) -> Scene:
    camera = Camera(width=24, height=12, field_of_view=120.0, look_zenith=100.0)
    return Scene(camera=camera, altitude=altitude, sun_zenith=70.0)


@pytest.mark.parametrize("altitude", [2.0, 400e3])
def test_single_and_multiple_light_make_all_light(earth: MomentsSolution, altitude: float) -> None:
    # Single and multiple scattering add up to all light; a point star has no
    # disc. Float32: 5e-6 of the brightest.
    one, more, whole = (
        render(earth, scene(altitude), orders=orders).rgb
        for orders in ("single", "multiple", "all")
    )
    assert one.max() > 0.0
    assert more.max() > 0.0
    assert_allclose(one + more, whole, rtol=0.0, atol=5e-6 * whole.max())


def test_a_picture_of_single_light_is_the_radiance_of_the_first_order(
    earth: MomentsSolution,
) -> None:
    # A second method: the query marches with twice as many points. Away from the star's glow, where
    # the haze just above the ground counts most, the two differ by less than 0.2 %.

    camera = Camera(width=24, height=12, field_of_view=90.0, look_zenith=95.0, look_azimuth=120.0)
    here = Scene(camera=camera, altitude=2.0, sun_zenith=70.0)
    rgb = centres(earth, here, orders="single").reshape(-1, 3)
    look = here.camera.directions().reshape(-1, 3)
    radiance = earth.radiance(
        altitude=here.altitude,
        sun_zenith=here.sun_zenith,
        view_zenith=np.degrees(np.arccos(look[:, 2])),
        azimuth=np.degrees(np.arctan2(-look[:, 1], look[:, 0])),
        order=1,
    )
    relative = np.asarray(radiance) / earth.medium.solar_irradiance
    assert_allclose(rgb, relative @ earth.lights[0].colors(), rtol=2e-3)


def test_other_orders_are_refused(earth: MomentsSolution) -> None:
    # The message lists all values.
    with pytest.raises(ParameterError, match="all, single, multiple"):
        render(earth, scene(2.0), orders="double")
