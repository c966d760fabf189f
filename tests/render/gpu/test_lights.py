"""Lights of towns, and several lights, in pictures of a device."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import Camera, MoonLight, Scene, StarLight, load_planet, solve
from airlight.image.display import to_display
from airlight.image.display_settings import DisplaySettings
from airlight.render import render
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.device.flat import read_texture
from airlight.render.gpu.picture.gpu_renderer import GpuRenderer

#: Display of light alone.
PLAIN = DisplaySettings(eye=False, glare=0.0)
#: Use of a texture that is drawn into and read: RENDER_ATTACHMENT and COPY_SRC of WebGPU.
TARGET = 0x10 | 0x01


def test_lights_by_night_are_those_of_the_cpu(device: Device) -> None:
    # The same functions in double precision, over Europe from above the air and from within it; the
    # sun is at the antipodes. Columns in single precision are accurate to 1e-3 of the light.
    solution = solve(load_planet("earth"), (440.0, 500.0, 560.0, 620.0), "preview", cache=False)
    pictures = GpuRenderer(device, (128, 64))
    pictures.set_solution(solution)
    for altitude in (4e5, 3e3):
        camera = Camera(width=48, height=27, look_zenith=150.0, field_of_view=50.0)
        scene = Scene(
            camera=camera, altitude=altitude, sun_zenith=180.0, latitude=45.4, longitude=9.2
        )
        wanted = render(solution, scene).rgb
        assert wanted.max() > 1e-5
        assert_allclose(pictures.render(scene).rgb, wanted, rtol=5e-3, atol=2e-3 * wanted.max())


@pytest.mark.parametrize("name", ["night", "day", "two suns", "eclipse"])
def test_several_lights_are_shown_as_by_the_cpu(name: str, device: Device) -> None:
    # Each light has its sky-view LUT, its disc and its colours; the moon's phase and the second
    # star's darkening included. Discs of fifty pixels, so that the rim is little of the picture.
    solution = solve(load_planet("earth"), (440.0, 500.0, 560.0, 620.0), "preview", cache=False)
    moon = MoonLight(zenith=76.0, azimuth=25.0, phase=60.0, angular_radius=4.0)
    red = StarLight(zenith=78.0, azimuth=5.0, star=StarLight.black_body(3500.0, 4.0))
    zenith, others = {
        "night": (106.0, (moon,)), "day": (60.0, (moon,)), "two suns": (80.0, (red, moon)),
        "eclipse": (80.0, (red, replace(moon, zenith=77.0, azimuth=9.0, phase=150.0))),
    }[name]  # fmt: skip
    camera = Camera(width=96, height=54, look_zenith=80.0, look_azimuth=20.0)
    scene = Scene(camera=camera, altitude=100.0, sun_zenith=zenith, secondary_lights=others)
    wanted = render(solution, scene)
    pictures = GpuRenderer(device, (128, 64))
    pictures.set_solution(solution)
    shown = []
    for one in (replace(scene, secondary_lights=()), scene):
        target = device.device.create_texture(size=(96, 54, 1), format="rgba32float", usage=TARGET)
        pictures.display(
            one, target.create_view(), "rgba32float", exposure=wanted.exposure, settings=PLAIN
        )
        shown.append(255.0 * read_texture(device, target)[..., :3])
    given = {"settings": PLAIN, "star_white": wanted.star_white}
    expected = to_display(wanted.rgb, wanted.exposure, **given).astype(float)  # type: ignore[arg-type]
    assert np.abs(shown[1] - expected).max() <= 2
    assert np.abs(shown[0] - expected).max() > 5  # the second light is seen
