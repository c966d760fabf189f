"""Moons, their shadows and the sun's disc in scenes by a device, against those of the CPU."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray

import airlight
from airlight.errors import ConflictError
from airlight.image.display import to_display
from airlight.image.display_settings import DisplaySettings
from airlight.render.gpu.device.device import Device
from airlight.render.gpu_system_renderer import GpuSystemRenderer
from airlight.render.render_system import render_system
from airlight.render.solve_planet import solve_planets
from airlight.scene.frame import Frame
from airlight.scene.system import System, load_system
from airlight.scene.system.body import Body
from airlight.scene.system.light import Light
from airlight.scene.system.viewpoint import SceneObserver, View

NM = (440.0, 500.0, 560.0, 620.0)
#: Display of light alone.
PLAIN = DisplaySettings(eye=False, glare=0.0)
#: Sixteen samples of a pixel on a limb: in single precision one may fall on its other side.
SAMPLE = 255.0 / 16.0

MARS = Body(name="mars", planet="mars", position=(1e7, 0.0, 0.0))
SUN = Light(star=airlight.Star(spectrum="astm-g173"), direction=(-0.6, 0.6, 0.5))
#: Moons behind the limb of Mars, before it, and far away with a map, by each law.
MOONS = (
    Body(name="behind", radius=1.5e6, position=(3e7, 1.15e7, 0.0), reflection="lambert"),
    Body(name="before", radius=1e5, position=(3e6, -3e5, 0.0)),
    Body(
        name="far",
        radius=1.7e7,
        position=(4e8, 2e8, 6e7),
        reflection="moon",
        map="moon",
        prime_meridian=200.0,
    ),
)


def system(**changes: object) -> System:
    given = {
        "name": "moons",
        "bodies": (MARS, *MOONS),
        "lights": (SUN, Light(body="mars")),
        "observer": SceneObserver(position=(0.0, 0.0, 0.0)),
        "view": View(direction=(1.0, 0.25, 0.05), field_of_view=50.0),
    }
    return System(**{**given, **changes})  # type: ignore[arg-type]


def both(scene: System, device: Device, size: tuple[int, int] = (96, 64)) -> tuple[Frame, Frame]:
    """Frames by the device and by the CPU."""
    width, height = size
    wanted = render_system(scene, width=width, height=height, wavelengths=NM, quality="preview")
    renderer = GpuSystemRenderer(device, (128, 64))
    renderer.set_solutions(solve_planets(scene, NM, "preview"))
    return renderer.render(scene, width=width, height=height), wanted


def off(got: Frame, wanted: Frame) -> NDArray[np.float64]:
    """Largest difference of each pixel, as displayed with the CPU's exposure."""
    one, other = (
        to_display(frame.rgb, wanted.exposure, settings=PLAIN, star_white=wanted.star_white).astype(
            float
        )
        for frame in (got, wanted)
    )
    assert other.max() > 100.0
    return np.asarray(np.abs(one - other).max(axis=-1))


def check(got: Frame, wanted: Frame, edges: float = 0.01, most: float = SAMPLE) -> None:
    """Within 2 of 255 but for the samples of limbs."""
    apart = off(got, wanted)
    assert apart.max() <= most + 2.0
    assert (apart > 2.0).mean() < edges
    assert np.minimum(apart, SAMPLE).mean() < 0.1
    # one sample of the sun is 0.03 EV of these small pictures
    exact = most <= SAMPLE
    assert_allclose(got.exposure, wanted.exposure, rtol=0.0, atol=0.01 if exact else 0.05)
    assert_allclose(got.star_radius, wanted.star_radius)


def test_bodies_without_air_are_those_of_the_cpu(device: Device) -> None:
    # The CPU traces in double precision; moons by each law, with a map, before and behind air.
    check(*both(system(), device))


def test_craters_of_a_near_moon_are_those_of_the_cpu(device: Device) -> None:
    # 110 km above it, in double precision; at rims, whose slopes are turned round, a pixel in fifty
    # may differ. The ground varies more than its map, whose texels are wider than the picture.
    near = Body(
        name="near", radius=1.7374e6, position=(0.0, -1.8474e6, 0.0), reflection="moon", map="moon"
    )
    scene = system(bodies=(MARS, near), view=View(look_at="near", field_of_view=30.0))
    got, wanted = both(scene, device)
    check(got, wanted, 0.02, 100.0)
    assert np.std(wanted.rgb[..., 1]) > 0.02 * np.mean(wanted.rgb[..., 1])


def test_a_crop_is_part_of_the_picture(device: Device) -> None:
    # The same pixels with the same samples.
    renderer = GpuSystemRenderer(device, (128, 64))
    scene = system()
    renderer.set_solutions(solve_planets(scene, NM, "preview"))
    whole = renderer.render(scene, width=64, height=48)
    part = renderer.render(scene, width=64, height=48, crop=(20, 10, 30, 25))
    assert_allclose(part.rgb, whole.rgb[10:35, 20:50], rtol=1e-4, atol=1e-6 * whole.rgb.max())


def test_a_polariser_halves_the_light_of_moons(device: Device) -> None:
    # Light of moons counts as unpolarised.
    scene = system(view=View(look_at="far", field_of_view=4.0))
    filtered = replace(scene, view=View(look_at="far", field_of_view=4.0, polariser=20.0))
    renderer = GpuSystemRenderer(device, (128, 64))
    renderer.set_solutions(solve_planets(scene, NM, "preview"))
    plain, seen = (renderer.render(one, width=16, height=16) for one in (scene, filtered))
    assert plain.rgb.max() > 0.0
    assert_allclose(seen.rgb, 0.5 * plain.rgb, rtol=1e-5)
    assert seen.unfiltered is not None


def test_a_shadow_on_a_moon_is_that_of_the_cpu(device: Device) -> None:
    # The umbra of air, and an edge of the shadow of a moon before the other.
    check(*both(load_system("lunar-eclipse"), device, (48, 32)))
    rock = Body(name="rock", radius=1e6, position=(4e6, -6e6, -3e6))
    screen = Body(name="screen", radius=5e5, position=(2.17e6, -4.17e6, -1.47e6))
    scene = system(
        bodies=(MARS, rock, screen), lights=(SUN,), view=View(look_at="rock", field_of_view=30.0)
    )
    got, wanted = both(scene, device, (64, 48))
    # Beside another body's limb the CPU has sixteen samples of the shadow's edge, the device one.
    check(got, wanted, 0.005, 100.0)
    free = render_system(
        replace(scene, bodies=(MARS, rock)), width=64, height=48, wavelengths=NM, quality="preview"
    )
    assert (free.rgb > 1.1 * wanted.rgb + 0.1).any()


def test_several_shadows_on_a_moon_are_refused(device: Device) -> None:
    rock = Body(name="rock", radius=1e6, position=(-4e6, 6e6, 3e6))
    screens = tuple(
        Body(name=name, radius=4e5, position=(-4e6 - 6.0 * far, 6e6 + 6.0 * far, 3e6 + 5.0 * far))
        for name, far in (("first", 4e5), ("second", 8e5))
    )
    scene = system(
        bodies=(MARS, rock, *screens), lights=(SUN,), view=View(look_at="rock", field_of_view=30.0)
    )
    renderer = GpuSystemRenderer(device, (128, 64))
    renderer.set_solutions(solve_planets(scene, NM, "preview"))
    with pytest.raises(ConflictError, match="rock is behind both first and second"):
        renderer.render(scene, width=8, height=6)


@pytest.mark.parametrize(
    ("direction", "moon"),
    [
        ((1.0, 0.36, 0.0), Body(name="moon", radius=1.2e4, position=(3e6, 1.086e6, 9e3))),
        ((1.0, 0.9, 0.0), Body(name="moon", radius=2e5, position=(6e7, 5.42e7, 1e5))),
    ],
)
def test_the_sun_behind_air_and_a_moon_is_that_of_the_cpu(
    direction: tuple[float, ...], moon: Body, device: Device
) -> None:
    # On the limb of Mars with a near moon before both, and beside Mars with a far moon. Each sample
    # of the CPU's is the device's, but for single precision at the rims.
    sun = Light(star=airlight.Star(spectrum="astm-g173"), direction=direction)
    scene = system(bodies=(MARS, moon), lights=(sun,), view=View(look_at="sun", field_of_view=2.0))
    got, wanted = both(scene, device, (48, 32))
    check(got, wanted, 0.005, 255.0)  # a sample of the sun is white
    bare = replace(scene, bodies=(MARS,))
    whole = render_system(bare, width=48, height=32, wavelengths=NM, quality="preview")
    assert whole.rgb.sum() > 1.02 * wanted.rgb.sum()


def test_a_small_sun_has_the_light_of_a_large_one(device: Device) -> None:
    # Radiance times solid angle of the pixels is the irradiance; the disc of two pixels is traced,
    # that of half a pixel shared out.
    sun = Light(star=airlight.Star(spectrum="astm-g173"), direction=(0.0, 1.0, 0.3))
    scene = system(bodies=(MARS,), lights=(sun,))
    renderer = GpuSystemRenderer(device, (128, 64))
    renderer.set_solutions(solve_planets(scene, NM, "preview"))
    light = []
    for width in (16, 128):
        view = View(look_at="sun", field_of_view=20.0)
        frame = renderer.render(replace(scene, view=view), width=width, height=width)
        light.append(frame.rgb.sum(axis=(0, 1)) / width**2)
    # sixteen samples of a disc of 14 pixels
    assert_allclose(light[0], light[1], rtol=0.02)


def test_stars_are_those_of_the_cpu(device: Device) -> None:
    # Points and the Milky Way are the same code; the air before them is the device's.
    got, wanted = both(load_system("orion"), device, (48, 32))
    check(got, wanted)
    dark = replace(load_system("orion"), stars=False)
    renderer = GpuSystemRenderer(device, (128, 64))
    renderer.set_solutions(solve_planets(dark, NM, "preview"))
    assert renderer.render(dark, width=48, height=32).rgb.sum() < 0.9 * got.rgb.sum()
