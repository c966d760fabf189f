"""Time of the display chain, from linear light to 8 bits: ``python benchmarks/display_chain.py``.

Frames are as skies are, by formula, at 1280 × 720. Wall time is of all threads, the other of one
thread's processor for a pixel, which other work on the machine does not change.
``--frame`` compares it, glare and exposure included, with the light of whole frames of Earth.
``--device`` measures its passes on the graphics device, in software where there is none, beside
those that only fill the picture, or copy it: what a pass over all pixels costs there.
"""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from airlight.image.display import display_rows, to_display
from airlight.image.display_settings import DisplaySettings
from airlight.image.exposure import automatic_exposure
from airlight.image.tone_maps import TONE_MAPS
from airlight.planets.picture_wavelengths import picture_wavelengths
from airlight.scene.frame import Frame

WIDTH, HEIGHT = 1280, 720
REPEATS = 7
#: Altitude [m], zenith angle of the sun, and of the line of sight with its azimuth [deg], by name.
LOOKS = {
    "orbit": (400e3, 60.0, 110.0, -75.0),
    "noon": (2.0, 35.0, 80.0, 90.0),
    "sunset": (2.0, 89.0, 82.0, 0.0),
}
#: Format of the device's target, and angle of a pixel. [rad]
TARGET = "rgba8unorm"
PIXEL = 1e-3
#: A sky with a sun, and passes that do nothing with it.
SKY = """
@fragment
fn sky(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
  let near = exp(-0.01 * distance(at.xy, vec2<f32>(640.0, 300.0)));
  return vec4<f32>(3.0 + 200.0 * near, 5.0 + 90.0 * near, 9.0 + 20.0 * near, 1.0);
}
"""
PLAIN = {
    "fill": """
@fragment
fn fill() -> @location(0) vec4<f32> {
  return vec4<f32>(0.25, 0.5, 0.75, 1.0);
}
""",
    "copy": """
@group(0) @binding(0) var light: texture_2d<f32>;
@fragment
fn copy(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
  return textureLoad(light, vec2<i32>(at.xy), 0);
}
""",
}


def frames() -> dict[str, NDArray[np.float32]]:
    """Linear frames: a blue sky, a sunset, a limb before space, light beyond sRGB."""
    x, y = np.meshgrid(np.linspace(-1.0, 1.0, WIDTH), np.linspace(1.0, 0.0, HEIGHT))
    sky = (0.4 + np.exp(-4.0 * y))[..., None] * np.array([3.0, 5.0, 9.0])
    sky += np.exp(-8.0 * y)[..., None] * np.array([8.0, 6.0, 2.0])
    glow = np.exp(-3.0 * np.hypot(x, y))[..., None] * np.array([60.0, 18.0, 1.0])
    sunset = glow + (0.3 + y)[..., None] * np.array([0.5, 0.8, 1.6])
    limb = np.where(y[..., None] > 0.4, 0.0, 1.0) * sky
    deep = (0.5 + y)[..., None] * np.array([-0.3, 1.0, 5.0])
    found = {"sky": sky, "sunset": sunset, "limb": limb, "beyond sRGB": deep}
    return {name: frame.astype(np.float32) for name, frame in found.items()}


def shortest(work: Callable[[], object], clock: Callable[[], float]) -> float:
    """Shortest time of several runs. [s]"""
    times = []
    for _ in range(REPEATS):
        began = clock()
        work()
        times.append(clock() - began)
    return min(times)


def by_frame(count: int) -> None:
    """Print a line for each frame of Earth: light and display, of the CPU's time.

    Parameters
    ----------
    count : int
        Number of wavelengths.
    """
    from airlight import Camera, Scene, load_planet, render, solve

    planet = load_planet("earth")
    solution = solve(planet, picture_wavelengths(planet, count))
    print(f"{WIDTH} x {HEIGHT}, {count} wavelengths")
    for name, (altitude, sun, look, aside) in LOOKS.items():
        camera = Camera(width=WIDTH, height=HEIGHT, look_zenith=look, look_azimuth=aside)
        scene = Scene(camera=camera, altitude=altitude, sun_zenith=sun)
        frame = render(solution, scene)

        def display(frame: Frame = frame) -> None:
            to_display(frame.rgb, replace(frame).exposure, pixel_angle=frame.pixel_angle)

        light = shortest(partial(render, solution, scene), time.process_time)
        shown = shortest(display, time.process_time)
        share = shown / (light + shown)
        print(f"{name:8s} {1e3 * light:6.0f} ms of light, {1e3 * shown:4.0f} ms of display, "
              f"{share:.1%} of the frame")  # fmt: skip


def by_device() -> None:
    """Print a line for each pass, with the time of the whole process's threads beside it."""
    import wgpu

    from airlight.render.gpu.device.device import open_device
    from airlight.render.gpu.device.fragment_pass import FragmentPass
    from airlight.render.gpu.picture.display_passes import LINEAR, DisplayPasses
    from airlight.render.pixels.view_uniforms import display_uniforms

    device = open_device()
    chain = DisplayPasses(device)
    light = chain.picture(WIDTH, HEIGHT)
    target = device.device.create_texture(
        size=(WIDTH, HEIGHT, 1), format=TARGET, usage=wgpu.TextureUsage.RENDER_ATTACHMENT
    ).create_view()
    waits = device.device.create_buffer(size=16, usage=wgpu.BufferUsage.COPY_SRC)
    FragmentPass(device, SKY, "sky", [LINEAR]).draw({}, [light])
    fill, copy = (FragmentPass(device, text, name, [TARGET]) for name, text in PLAIN.items())

    def shown(glare: float, again: bool) -> None:
        chain.drawn = object() if again else "sky"
        numbers = display_uniforms(-4.0, DisplaySettings(glare=glare))
        chain.display(numbers, PIXEL, target, TARGET)

    works = {
        "fill": lambda: fill.draw({}, [target]),
        "copy": lambda: copy.draw({"light": light}, [target]),
        "display": lambda: shown(0.0, False),
        "display, glare kept": lambda: shown(1.0, False),
        "display, glare anew": lambda: shown(1.0, True),
    }
    print(f"{WIDTH} x {HEIGHT}, {device.name}")
    for name, work in works.items():

        def done(work: Callable[[], None] = work) -> None:
            work()
            device.device.queue.read_buffer(waits)  # comes after all that was submitted

        done()
        wall, own = shortest(done, time.perf_counter), shortest(done, time.process_time)
        print(f"{name:20s} {1e3 * wall:6.1f} ms  {1e3 * own:6.1f} ms of the CPU")


def main() -> None:
    """Print a line for each frame, and for each tone map."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--frame", type=int, metavar="WAVELENGTHS", help="whole frames")
    parser.add_argument("--device", action="store_true", help="the graphics device's passes")
    given = parser.parse_args()
    if given.device:
        by_device()
        return
    if given.frame:
        by_frame(given.frame)
        return
    made = frames()
    print(f"{WIDTH} x {HEIGHT}, {os.cpu_count()} processors")
    for name, rgb in made.items():
        exposure = automatic_exposure(rgb)
        wall = shortest(partial(to_display, rgb, exposure), time.perf_counter)
        display = DisplaySettings().display(exposure)
        picture = np.empty(rgb.shape, np.uint8)
        own = shortest(partial(display_rows, rgb, picture, 0, 0, 255.0, display), time.thread_time)
        print(f"{name:12s} {1e3 * wall:6.1f} ms  {1e9 * own / rgb[..., 0].size:5.0f} ns a pixel")
    sky = made["sky"]
    metering = shortest(partial(automatic_exposure, sky), time.perf_counter)
    print(f"exposure of the sky: {1e3 * metering:.1f} ms")
    for tone_map in TONE_MAPS:
        wall = shortest(partial(to_display, sky, -4.0, tone_map), time.perf_counter)
        print(f"{tone_map:18s} {1e3 * wall:6.1f} ms")


if __name__ == "__main__":
    main()
