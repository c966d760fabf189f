"""Lights of towns in pictures of a device."""

from __future__ import annotations

from numpy.testing import assert_allclose

from airlight import Camera, Scene, load_planet, solve
from airlight.gpu.device.device import Device
from airlight.gpu.picture.pictures import Pictures
from airlight.render import render


def test_lights_by_night_are_those_of_the_processor(device: Device) -> None:
    # The same functions in double precision, over Europe from above the air and from within it; the
    # sun is at the antipodes. Columns in single precision are accurate to 1e-3 of the light.
    solution = solve(load_planet("earth"), (440.0, 500.0, 560.0, 620.0), "preview", cache=False)
    pictures = Pictures(device, (128, 64))
    pictures.show(solution)
    for altitude in (4e5, 3e3):
        camera = Camera(width=48, height=27, look_zenith=150.0, field_of_view=50.0)
        scene = Scene(
            camera=camera, altitude=altitude, sun_zenith=180.0, latitude=45.4, longitude=9.2
        )
        wanted = render(solution, scene).rgb
        assert wanted.max() > 1e-5
        assert_allclose(pictures.frame(scene).rgb, wanted, rtol=5e-3, atol=2e-3 * wanted.max())
