"""Glare of a device against that of the CPU: the same formulas in other hands."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight import Camera, Scene, load_planet
from airlight.image.display import to_display
from airlight.image.display_settings import DisplaySettings
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.device.flat import read_texture
from airlight.render.gpu.picture.gpu_renderer import GpuRenderer
from airlight.solver.moments.solution import MomentsSolution

NM = (440.0, 500.0, 560.0, 620.0)


@pytest.fixture(scope="module")
def pictures(device: Device, solved: Callable[..., MomentsSolution]) -> GpuRenderer:
    made = GpuRenderer(device, (64, 64))
    made.set_solution(solved(load_planet("earth"), NM, "preview"))
    return made


def shown(
    pictures: GpuRenderer, seen: Scene, kind: str = "rgba8unorm", glare: float = 0.0, **more: float
) -> np.ndarray:
    """Picture of a device. [0 to 255]"""
    import wgpu

    use = wgpu.TextureUsage.RENDER_ATTACHMENT | wgpu.TextureUsage.COPY_SRC
    size = (seen.camera.width, seen.camera.height, 1)
    target = pictures.device.device.create_texture(size=size, format=kind, usage=use)
    settings = DisplaySettings(glare=glare)
    given = {"exposure": -5.0, **more}
    pictures.display(seen, target.create_view(), kind, settings=settings, **given)
    return 255.0 * read_texture(pictures.device, target)[..., :3]


def towards_the_sun(width: int, height: int, projection: str = "perspective") -> Scene:
    """Sun in the upper left part of a picture, odd sizes on the way."""
    look = {"look_zenith": 75.0, "look_azimuth": 8.0} if projection == "perspective" else {}
    camera = Camera(projection=projection, width=width, height=height, **look)
    return Scene(altitude=2.0, sun_zenith=65.0, camera=camera)


@pytest.mark.parametrize("size", [(160, 90), (101, 57), (64, 6), (7, 3)])
@pytest.mark.parametrize("amount", [1.0, 4.0])
def test_glare_of_a_device_is_the_cpu_s(
    size: tuple[int, int], amount: float, pictures: GpuRenderer
) -> None:
    # half of 1/255 for rounding to 8 bits, each, of the same light
    seen = towards_the_sun(*size)
    frame = pictures.render(seen)
    plain = to_display(frame.rgb, -5.0, glare=0.0, **frame.lens)
    wanted = to_display(frame.rgb, -5.0, glare=amount, **frame.lens).astype(float)
    if min(size) > 50:
        assert np.abs(wanted - plain).max() > 20.0  # there is something to compare
    assert_allclose(shown(pictures, seen, glare=amount), wanted, rtol=0.0, atol=1.0)


def test_beyond_the_circle_of_a_dome_a_device_shows_no_glare(pictures: GpuRenderer) -> None:
    # a law: no light is shown where the picture has no direction; within, the CPU's glare
    seen = towards_the_sun(72, 64, "fisheye")
    frame = pictures.render(seen)
    got = shown(pictures, seen, glare=10.0)
    beyond = ~seen.camera.directions().any(axis=-1)
    assert np.count_nonzero(beyond) > 1000
    assert_array_equal(got[beyond], 0.0)
    wanted = to_display(frame.rgb, -5.0, glare=10.0, **frame.lens).astype(float)
    assert np.abs(wanted - to_display(frame.rgb, -5.0, glare=0.0, **frame.lens)).max() > 20.0
    assert_allclose(got, wanted, rtol=0.0, atol=1.0)


def test_glare_follows_what_is_drawn(pictures: GpuRenderer) -> None:
    # Levels are kept, as is the picture: after other sizes, lights and amounts each has to be as
    # it was, bit for bit.
    first, second = towards_the_sun(160, 90), towards_the_sun(96, 54)
    scenes = (first, second, Scene(altitude=2.0, sun_zenith=88.0, camera=first.camera))
    wanted = [[shown(pictures, seen, glare=a) for seen in scenes] for a in (0.0, 1.0)]
    for k in (1, 0, 2, 1, 1, 2, 0):
        for a in (1, 0, 1):
            assert_array_equal(shown(pictures, scenes[k], glare=float(a)), wanted[a][k])
    assert np.abs(wanted[1][0] - wanted[0][0]).max() > 20.0


def test_faces_of_a_cube_spread_no_light(pictures: GpuRenderer) -> None:
    # what is beside a face in the picture is not beside it in the sky
    seen = towards_the_sun(144, 24, "cubemap")
    assert pictures.render(seen).pixel_angle == 0.0
    assert_array_equal(shown(pictures, seen, glare=1.0), shown(pictures, seen, glare=0.0))
