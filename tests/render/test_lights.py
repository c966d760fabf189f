"""Several lights of a scene: their pictures add up."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest
from marched_pictures import marched
from numpy.testing import assert_allclose, assert_array_equal

from airlight import Camera, Scene, load_planet
from airlight.planets.light_source import LightSource
from airlight.render import render
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.picture.gpu_renderer import GpuRenderer
from airlight.scene.light_position import LightPosition
from airlight.solver import solve
from airlight.viewer.painting.probe import probe

WAVELENGTHS = (680.0, 550.0, 440.0)


@dataclass(frozen=True, kw_only=True)
class Dimmed(LightPosition):
    """Light that shines as the star does, with a share of its irradiance and a disc of its own."""

    share: float
    radius: float | None = None

    def source(self, sources: tuple[LightSource, ...]) -> LightSource:
        star = sources[0]
        alpha = star.angular_radius if self.radius is None else self.radius
        return replace(
            star, name="dimmed", angular_radius=alpha, irradiance=self.share * star.irradiance
        )


@dataclass(frozen=True, kw_only=True)
class Lit(Scene):
    """Scene whose lights are given."""

    given: tuple[LightPosition, ...] = ()

    @property
    def lights(self) -> tuple[LightPosition, ...]:
        return self.given


@pytest.fixture(scope="module")
def solution():
    return solve(load_planet("earth"), WAVELENGTHS, "preview")


CAMERA = Camera(width=256, height=144, look_zenith=78.0, look_azimuth=20.0)
PLAIN = Scene(altitude=3e3, sun_zenith=75.0, latitude=20.0, longitude=-40.0, camera=CAMERA)


def lit(scene: Scene, *lights: LightPosition) -> Lit:
    fields = {name: getattr(scene, name) for name in scene.__dataclass_fields__}
    return Lit(**fields, given=lights)


HALVES = lit(PLAIN, *(Dimmed(zenith=75.0, share=0.5) for _ in range(2)))


@pytest.mark.parametrize("exact", [False, True])
def test_two_halves_of_a_star_are_the_star(solution, exact):
    # Linearity: to the rounding of single precision, the disc included.
    small = {"camera": replace(CAMERA, width=64, height=36)} if exact else {}
    one = render(solution, replace(PLAIN, **small), exact=exact).rgb
    two = render(solution, replace(HALVES, **small), exact=exact).rgb
    assert_allclose(two, one, rtol=2e-6)


def test_a_device_adds_lights_as_the_cpu_does(device: Device, solution):
    # The star's halves, and a second, smaller light of another colour elsewhere in the sky.
    pictures = GpuRenderer(device, (128, 64))
    pictures.set_solution(solution)
    small = {"camera": replace(CAMERA, width=64, height=36)}
    one = pictures.render(replace(PLAIN, **small)).rgb
    assert_allclose(pictures.render(replace(HALVES, **small)).rgb, one, rtol=2e-6)
    assert_array_equal(pictures.render(replace(PLAIN, **small)).rgb, one)  # the star is back
    moon = Dimmed(zenith=60.0, azimuth=50.0, share=0.1, radius=0.02)
    both = lit(replace(PLAIN, **small), LightPosition(zenith=75.0), moon)
    wanted = marched(solution, both, device)
    seen = pictures.render(both, exact=True).rgb
    # Two discs, whose rims single precision draws elsewhere by a fraction of a pixel.
    error = np.abs(seen - wanted).max(axis=2) / wanted.max(axis=2)
    assert np.quantile(error, 0.99) < 0.01


def test_a_light_at_another_azimuth_is_the_picture_turned(solution):
    # A panorama turned by 90° is its columns moved by a quarter, the ground's map included: the
    # star's compass bearing turns with it.
    around = Camera(projection="equirectangular", width=96, height=48)
    scene = replace(PLAIN, camera=around, sun_azimuth=100.0)
    moved = lit(scene, LightPosition(zenith=75.0, azimuth=90.0))
    turned = replace(scene, sun_azimuth=190.0)
    wanted = np.roll(render(solution, turned, exact=True).rgb, 24, axis=1)
    assert_allclose(render(solution, moved, exact=True).rgb, wanted, rtol=2e-4)


def test_every_light_has_its_disc(solution):
    # Nothing but the second light's disc differs where it stands, and its light is that of the
    # disc: irradiance times transmittance, whatever its size.
    camera = Camera(width=120, height=90, field_of_view=6.0, look_zenith=60.0, look_azimuth=50.0)
    scene = replace(PLAIN, camera=camera)
    directions = camera.directions()
    near = Dimmed(zenith=60.0, azimuth=50.0, share=1.0).direction
    for radius in (0.004, 0.015):
        moon = Dimmed(zenith=60.0, azimuth=50.0, share=1e-3, radius=radius)
        rgb = render(solution, lit(scene, moon), exact=True).rgb
        apart = np.arccos(np.clip(directions @ near, -1.0, 1.0))
        sky = np.median(rgb[apart > 1.5 * radius], axis=0)
        pixel = camera.pixel_angle**2 * np.maximum(directions @ camera.axes[2], 0.0) ** 3
        got = ((rgb - sky) * pixel[..., None])[apart < 1.5 * radius].sum(axis=0)
        transmittance = np.asarray(solution.transmittance(altitude=3e3, view_zenith=60.0))
        expected = 1e-3 * (transmittance[:, None] * solution.lights[0].colors()).sum(axis=0)
        # The sky around the light is brighter than its median by forward scattering: 1 %.
        assert_allclose(got, expected, rtol=0.02)


def test_the_probe_adds_the_lights_of_the_picture(solution):
    # Two computations of the same light: the probe's spectrum and a pixel marched, away from the
    # horizon, where a pixel is the mean of several lines of sight.
    moon = Dimmed(zenith=50.0, azimuth=-60.0, share=0.3, radius=0.01)
    scene = lit(replace(PLAIN, camera=replace(CAMERA, width=16, height=9)),
                LightPosition(zenith=75.0), moon)  # fmt: skip
    rgb = render(solution, scene, exact=True).rgb
    for row, column in ((1, 3), (5, 12)):
        found = probe(solution, scene, scene.camera.directions()[row, column])
        assert_allclose(found.rgb, rgb[row, column], rtol=0.01)
        assert sum(part.name.startswith("dimmed: ") for part in found.parts) >= 3
