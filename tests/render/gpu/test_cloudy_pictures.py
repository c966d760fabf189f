"""Pictures of three-dimensional clouds by a device.

Reference: the CPU, which runs the same functions for the same tables in double precision.
"""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import Camera, Scene, load_planet
from airlight.clouds.cloud_detail import cloud_detail, detail_by_octaves
from airlight.clouds.planet_clouds import Box
from airlight.errors import ParameterError
from airlight.image.display import to_display
from airlight.image.exposure import automatic_exposure
from airlight.render.clouds import clouds_around
from airlight.render.clouds.clouds_around import CloudsAround
from airlight.render.cpu_renderer import CpuRenderer
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.picture.cloudy_shaders import cloudy_shader
from airlight.render.gpu.picture.gpu_renderer import GpuRenderer
from airlight.render.pixels.scenes_by_light import scenes_by_light
from airlight.render.rendering_gpu import check_clouds
from airlight.solver.moments.solution import MomentsSolution

NM = (440.0, 500.0, 560.0, 620.0)
#: Clouds of the pictures.
CUMULUS = {"kind": "cumulus", "seed": 2}


@pytest.fixture(scope="module")
def solution() -> MomentsSolution:
    from airlight.render.solve_planet import solve_planet

    return solve_planet(load_planet("earth-atmosphere-plus"), NM, "preview", cache=False)


def of_the_cpu(solution: MomentsSolution, scene: Scene, clouds: CloudsAround) -> np.ndarray:
    """Picture whose horizon has one sample, as that of a device in software."""
    (seen, lit, _, _), *_ = scenes_by_light(scene, solution)
    renderer = CpuRenderer(lit, seen, clouds=clouds.lit(lit, seen), edges=False)
    rgb = np.zeros((scene.camera.rows, scene.camera.columns, 3), np.float32)
    renderer.render_rows(0, scene.camera.rows, rgb)
    return rgb


@pytest.mark.slow
def test_clouds_of_a_device_are_those_of_the_cpu(
    device: Device, solution: MomentsSolution, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Bounds are those that were seen, with a margin. From the ground 95 % of pixels are within
    # 2/255 and the largest difference is 9: in single precision lines close to the horizon start
    # tens of metres aside. From 3 km all are within 1/255. The field is small, to save time.
    monkeypatch.setattr(clouds_around, "Box", partial(Box, size=6400.0))
    pictures = GpuRenderer(device)
    pictures.set_solution(solution)
    planet = load_planet("earth-atmosphere-plus", {"clouds": [CUMULUS]})
    for altitude, zenith, share, most in ((2.0, 80.0, 0.94, 12.0), (3e3, 100.0, 0.99, 3.0)):
        camera = Camera(width=32, height=18, look_zenith=zenith, look_azimuth=20.0)
        scene = Scene(camera=camera, altitude=altitude, sun_zenith=60.0)
        clouds = CloudsAround.of(planet, scene)
        clear = pictures.render(scene)
        wanted = of_the_cpu(solution, scene, clouds)
        seen = pictures.render(scene, clouds=clouds)
        exposure = automatic_exposure(wanted)
        shown = [to_display(one, exposure).astype(float) for one in (wanted, seen.rgb)]
        off = np.abs(shown[0] - shown[1]).max(axis=2)
        assert (off <= 2.0).mean() >= share
        assert off.max() <= most
        assert_allclose(seen.rgb.mean(), wanted.mean(), rtol=2e-3)
        # clear sky is rendered as before
        assert np.abs(clear.rgb - seen.rgb).max() > 0.1 * wanted.max()
        np.testing.assert_array_equal(pictures.render(scene).rgb, clear.rgb)


@pytest.mark.parametrize(
    ("scene", "reason"),
    [
        (Scene(camera=Camera(width=8, height=6, polariser=0.0)), "none with clouds"),
        (Scene(camera=Camera(width=8, height=6), altitude=4e5), "24000 m"),
    ],
)
def test_what_a_device_cannot_draw_with_clouds_is_refused(scene: Scene, reason: str) -> None:
    planet = load_planet("earth-atmosphere-plus", {"clouds": [CUMULUS]})
    clouds = CloudsAround.of(planet, scene)
    assert clouds is not None
    with pytest.raises(ParameterError, match=reason):
        check_clouds(clouds, scene)


@pytest.mark.parametrize("layers", [1, 2, 3])
def test_shaders_of_clouds_read_no_more_textures_than_browsers_allow(layers: int) -> None:
    # 16 sampled textures of a stage are WebGPU's default limit.
    shader = cloudy_shader(layers, 16, False, (("filter", 0),))
    assert len(shader.textures) <= 16
    assert shader.emitter.taken >= {"add_clouds", "line_of_air", "shade_ground"}


def test_detail_in_shaders_is_that_of_lanes() -> None:
    # The same octaves in another order; lanes have single precision.
    random = np.random.default_rng(5)
    for _ in range(50):
        east, north, up = random.uniform(-2e3, 2e3, 3)
        width = 10.0 ** random.uniform(-1.0, 2.0)
        wanted = cloud_detail(east, north, up, width, 60.0)
        assert_allclose(
            detail_by_octaves(east, north, up, width, 60.0), wanted, rtol=2e-3, atol=0.05
        )
