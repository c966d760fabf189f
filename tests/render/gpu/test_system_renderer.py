"""Pictures of several planets with air by a device, against those of the CPU."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import airlight
from airlight.errors import ConflictError
from airlight.image.display import to_display
from airlight.image.display_settings import DisplaySettings
from airlight.planets.parameters import replace as replaced
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.device.flat import read_texture
from airlight.render.gpu_system_renderer import GpuSystemRenderer
from airlight.render.render_system import render_system
from airlight.render.solve_planet import solve_planets
from airlight.scene.system import System
from airlight.scene.system.body import Body
from airlight.scene.system.light import Light
from airlight.scene.system.viewpoint import SceneObserver, View

NM = (440.0, 500.0, 560.0, 620.0)
SIZE = (96, 64)
#: Display of light alone.
PLAIN = DisplaySettings(eye=False, glare=0.0)
#: Use of a texture that is drawn into and read: RENDER_ATTACHMENT and COPY_SRC of WebGPU.
TARGET = 0x10 | 0x01

MARS = Body(name="mars", planet="mars", position=(1e7, 0.0, 0.0))
EARTH = Body(name="earth", planet="earth", position=(3e7, 8e6, 0.0))
TWIN = Body(name="twin", planet="earth", position=(6e7, 1.8e7, 1.2e7))
SUN = Light(star=airlight.Star(spectrum="astm-g173"), direction=(-0.6, 0.6, 0.5))


#: From space, the Earth past the limb of Mars; from the ground of Mars, both Earths through dust.
SCENES = {
    "space": System(
        name="space",
        bodies=(MARS, EARTH),
        lights=(SUN,),
        observer=SceneObserver(position=(0.0, 0.0, 0.0)),
        view=View(direction=(1.0, 0.35, 0.0), field_of_view=36.0),
    ),
    "ground": System(
        name="ground",
        bodies=(TWIN, MARS, EARTH),
        lights=(SUN,),
        observer=SceneObserver(body="mars", latitude=65.0, altitude=2.0),
        view=View(look_at="earth", field_of_view=60.0),
    ),
}


@pytest.mark.parametrize("name", SCENES)
def test_planets_before_each_other_are_drawn_as_by_the_cpu(name: str, device: Device) -> None:
    # The CPU marches in double precision; the device interpolates a sky-view LUT.
    system = SCENES[name]
    width, height = SIZE
    wanted = render_system(
        system, width=width, height=height, wavelengths=NM, quality="preview", samples=1
    )
    pictures = GpuSystemRenderer(device, (128, 64))
    pictures.set_solutions(solve_planets(system, NM, "preview"))
    got = pictures.render(system, width=width, height=height)
    exposure = -np.log2(np.percentile(wanted.rgb, 99.0))
    one, other = (
        to_display(frame.rgb, exposure, settings=PLAIN, star_white=frame.star_white).astype(float)
        for frame in (got, wanted)
    )
    assert other.max() > 150.0
    off = np.abs(one - other)
    # on the edge of a rock rounding decides what is seen: 0.12 % of the values
    assert (off > 2.0).mean() < 0.003
    assert off.mean() < 0.1
    # Live, the sum is displayed once.
    target = device.device.create_texture(size=(*SIZE, 1), format="rgba32float", usage=TARGET)
    pictures.display(
        system, target.create_view(), "rgba32float", SIZE, exposure=exposure, settings=PLAIN
    )
    shown = 255.0 * read_texture(device, target)[..., :3]
    assert np.abs(shown - one).max() <= 1.0


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        (
            {"bodies": (MARS, Body(name="rock", radius=1e6, position=(0.0, 1e7, 8.4e6)))},
            r"bodies\[0\] has air in a moon's shadow, which only the CPU draws",
        ),
        ({"bodies": (Body(name="rock", radius=1e6, position=(1e7, 0.0, 0.0)),)}, "no planet with"),
        ({"lights": (replaced(SUN, corona="baumbach"),)}, "scene has a corona"),
        (
            {"changes": {"earth": {"clouds": [{"kind": "cumulus"}]}}, "bodies": (EARTH,)},
            "has three-dimensional clouds",
        ),
    ],
)
def test_what_the_device_does_not_draw_is_refused(
    changes: dict[str, object], said: str, device: Device
) -> None:
    system = replace(SCENES["space"], **({"bodies": (MARS,)} | changes))  # type: ignore[arg-type]
    pictures = GpuSystemRenderer(device, (128, 64))
    pictures.set_solutions(solve_planets(replace(SCENES["space"], bodies=(MARS,)), NM, "preview"))
    with pytest.raises(ConflictError, match=said):
        pictures.render(system, width=8, height=6)
