"""Three-dimensional clouds over another renderer's picture, against one of the same ground."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.ndimage import binary_erosion

from airlight import Camera, Scene, render
from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_optics import CloudOptics, droplets
from airlight.engines.composition import Placement, compose
from airlight.render.clouds.cloud_deck import CloudDeck
from airlight.render.clouds.clouds_around import CloudsAround
from airlight.solver.moments.solution import MomentsSolution

from .views import distance_to_sphere, looking

pytestmark = pytest.mark.slow

PLACE = Placement(sun_zenith=40.0, sun_azimuth=90.0)


@lru_cache
def optics(nm: tuple[float, ...]) -> CloudOptics:
    return CloudOptics.of_particles(droplets(10e-6, 0.1), np.array(nm))


def layer(depth: float) -> CloudsAround:
    """Even layer of an optical depth, from 1 to 1.5 km."""
    field = CloudField(
        extinction=np.full((4, 4, 8), depth / 500.0, np.float32),
        spacing=(500.0, 500.0, 62.5),
        base=1000.0,
        beyond="periodic",
    )
    return CloudsAround((CloudDeck(field, lambda nm: optics(tuple(np.asarray(nm).tolist()))),))


def relit_ground(earth: MomentsSolution, altitude: float, clouds: CloudsAround | None):
    """The planet's own ground as a picture, relit by sun and sky, and where it is."""
    camera = looking(altitude, -30.0, 30.0, field_of_view=60.0)
    bottom = earth.medium.bottom_radius
    away = distance_to_sphere(camera, np.array([0.0, 0.0, -bottom]), bottom)
    hit = np.isfinite(away)
    albedo = float(np.mean(earth.medium.ground_albedo))
    none = np.zeros((*hit.shape, 3))
    passes = {"albedo": none + albedo * hit[..., None], "normals": none}
    depth = np.where(hit, away, 1e10)
    composed = compose(
        np.zeros((*hit.shape, 3)), depth, camera, earth, PLACE, depth_kind="distance",
        white=None, exact=True, clouds=clouds, **passes,
    )  # fmt: skip
    return composed.rgb, hit


@pytest.mark.parametrize(("altitude", "bar"), [(1e4, 0.03), (500.0, 0.03)])
def test_ground_behind_or_below_clouds_is_that_of_a_rendered_picture(
    earth: MomentsSolution, altitude: float, bar: float
) -> None:
    clouds = layer(3.0)
    got, hit = relit_ground(earth, altitude, clouds)
    seen = Camera(width=96, height=54, field_of_view=60.0, look_zenith=120.0, look_azimuth=-60.0)
    scene = Scene(altitude=altitude, sun_zenith=40.0, sun_azimuth=90.0, camera=seen)
    wanted = render(earth, scene, exact=True, clouds=clouds).rgb
    ground = binary_erosion(hit, np.ones((3, 3)))
    assert ground.mean() > 0.3
    assert_allclose(got[ground], wanted[ground], rtol=bar)
    without, _ = relit_ground(earth, altitude, None)
    assert np.abs(got[ground] / without[ground] - 1.0).min() > 0.05


def test_clouds_without_depth_are_not_there(earth: MomentsSolution) -> None:
    got, _ = relit_ground(earth, 1e4, layer(1e-6))
    wanted, _ = relit_ground(earth, 1e4, None)
    assert_allclose(got, wanted, rtol=5e-3)


def test_surfaces_above_clouds_are_before_them(earth: MomentsSolution) -> None:
    """A wall 100 m away hides the layer; what light the layer adds to the air is little."""
    camera = looking(1e4, -30.0, 30.0, field_of_view=60.0)
    shape = (camera.height, camera.width)
    rgb, depth = np.full((*shape, 3), 0.3), np.full(shape, 100.0)
    got, wanted = (
        compose(rgb, depth, camera, earth, PLACE, clouds=clouds).rgb
        for clouds in (layer(30.0), None)
    )
    assert_allclose(got, wanted, rtol=5e-3)
