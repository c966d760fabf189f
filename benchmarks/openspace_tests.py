"""The performance tests of the OpenSpace paper on this machine's GPU: figure 8 and table 2.

    python benchmarks/openspace_tests.py                          # on a GPU: about a minute
    python benchmarks/openspace_tests.py --markdown openspace.md
    python benchmarks/openspace_tests.py --frames 4 --size 320x180 --dome 512   # software

Frames follow a flight (``openspace_flight.toml``, as the window records them), each complete:
sky-view LUT, pixels, exposure and tone map into a texture of 8 bits, until the device is done. The
flight is drawn twice, and timed the second time. Four wavelengths, polarised light; as in the
window, a software GPU has a smaller sky-view LUT, filled by the CPU. *Without* is the same ground
below nothing; *2 and 3 atmospheres* have further Earths in the sky, whose distant pixels are drawn
too. One size given by ``--size`` replaces those of the paper. AIRLIGHT_GPU chooses the
device by a part of its name.

The authors' times (Costa et al. 2021, table 2) are of their hardware.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any, Final

import numpy as np

from airlight import Camera, Scene, load_planet
from airlight.image.display_settings import DisplaySettings
from airlight.image.four_wavelengths import four_wavelengths
from airlight.planets.parameters import replace
from airlight.planets.planet import Planet
from airlight.render.gpu.device.device import Device, NoDevice, open_device
from airlight.render.gpu.picture.gpu_renderer import QUICK_SKY_VIEW_SIZE, SKY_VIEW_SIZE, GpuRenderer
from airlight.render.gpu_system_renderer import GpuSystemRenderer
from airlight.render.rendering_gpu import fits
from airlight.render.solve_planet import solve_planet
from airlight.scene.system import System
from airlight.scene.system.body import Body
from airlight.scene.system.light import Light
from airlight.scene.system.viewpoint import SceneObserver, View
from airlight.studies.film import Quality, load_film
from airlight.viewer.session.constituent_switches import switched

FLIGHT: Final = Path(__file__).with_name("openspace_flight.toml")
FORMAT: Final = "rgba8unorm"
SETTINGS: Final = DisplaySettings(glare=0.0)
#: Sizes of table 2, and that of figure 8. [pixel]
SIZES: Final = ((1280, 720), (1920, 1080))
#: The authors' times with one atmosphere and without, by size (table 2), and our target. [ms]
AUTHORS: Final = {(1280, 720): (1.81, 1.64), (1920, 1080): (2.63, 1.81)}
TARGET: Final = {(1920, 1080): 1.0}
#: Our target from an edit to its light. [ms]
EDIT_TARGET: Final = 50.0
#: The authors' times with two and three atmospheres, by size. [ms]
SEVERAL: Final = {(1280, 720): (2.66, 5.00), (1920, 1080): (4.08, 6.06)}
#: Positions of further Earths, above the sunset of the flight. [m]
COMPANIONS: Final = ((2e7, -5e7, 1.2e7), (3e7, -4e7, 2.5e7))


def texture(device: Device, size: tuple[int, int]) -> Any:
    """Target of frames."""
    import wgpu

    use = wgpu.TextureUsage.RENDER_ATTACHMENT
    return device.device.create_texture(size=(*size, 1), format=FORMAT, usage=use)


def timed(
    device: Device, size: tuple[int, int], frames: Sequence[Any], draw: Callable[[Any, Any], None]
) -> np.ndarray:
    """Times by the clock of ``draw(frame, view)``, of the second time that all are drawn. [ms]"""
    target = texture(device, size)
    view, spent = target.create_view(), []
    for frame in (*frames, *frames):
        began = time.perf_counter()
        draw(frame, view)
        device.wait()
        spent.append(1e3 * (time.perf_counter() - began))
    target.destroy()
    return np.array(spent[len(frames) :])


def timed_scenes(device: Device, renderer: GpuRenderer, scenes: Sequence[Scene]) -> np.ndarray:
    """Times of frames of one planet. [ms]"""
    camera = scenes[0].camera
    return timed(
        device,
        (camera.width, camera.height),
        scenes,
        lambda scene, view: renderer.display(scene, view, FORMAT, exposure=-3.0, settings=SETTINGS),
    )


def system_of(planet: str, scene: Scene, count: int) -> System:
    """Scene of a planet with further ones like it, seen as in its own scene."""
    latitude, longitude, altitude = scene.latitude, scene.longitude, scene.altitude
    lat, lon, zenith, bearing = np.radians(
        [latitude, longitude, scene.sun_zenith, scene.sun_azimuth or 0.0]
    )
    up = np.array([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)])
    east = np.array([-np.sin(lon), np.cos(lon), 0.0])
    level = np.sin(bearing) * east + np.cos(bearing) * np.cross(up, east)
    sun = np.cos(zenith) * up + np.sin(zenith) * level
    camera = scene.camera
    return System(
        name="flight",
        bodies=(
            Body(name="0", planet=planet),
            *(
                Body(name=str(k), planet=planet, position=COMPANIONS[k - 1])
                for k in range(1, count)
            ),
        ),
        lights=(Light(star=load_planet(planet).star, direction=tuple(sun.tolist())),),
        observer=SceneObserver(body="0", latitude=latitude, longitude=longitude, altitude=altitude),
        view=View(
            look_zenith=camera.look_zenith,
            look_bearing=((scene.sun_azimuth or 0.0) + camera.look_azimuth) % 360.0,
            field_of_view=camera.field_of_view,
        ),
    )


def shown(renderer: GpuSystemRenderer, size: tuple[int, int], system: System, view: Any) -> None:
    """Display a frame of several planets."""
    renderer.display(system, view, FORMAT, size, exposure=-3.0, settings=SETTINGS)


def renderer_of(device: Device) -> GpuRenderer:
    """Renderer as the window has it."""
    return GpuRenderer(device, QUICK_SKY_VIEW_SIZE if device.software else SKY_VIEW_SIZE)


def opened(device: Device, planet: Planet, quality: str) -> GpuRenderer:
    """Renderer of a planet by four wavelengths."""
    nm, weights = four_wavelengths(planet.star.irradiances, planet.wavelength_limits)
    renderer = renderer_of(device)
    renderer.set_solution(solve_planet(planet, nm, quality), weights)
    return renderer


def row(name: str, size: tuple[int, int], spent: np.ndarray, *beside: float | None) -> list[str]:
    """Cells of a row: median and 95 % of times, the authors' and the target. [ms]"""
    found = [f"{x:.2f}" for x in (np.median(spent), np.percentile(spent, 95.0))]
    return [
        name,
        f"{size[0]}x{size[1]}",
        *found,
        *("" if x is None else f"{x:.2f}" for x in beside),
    ]


def edits(device: Device, planet: Planet, scene: Scene, count: int) -> np.ndarray:
    """Times from an edit of the haze to the picture of its light, `preview`. [ms]"""
    nm, weights = four_wavelengths(planet.star.irradiances, planet.wavelength_limits)
    gpu = device if fits(planet, len(nm)) and not device.software else None
    renderer, spent = renderer_of(device), []
    target = texture(device, (scene.camera.width, scene.camera.height))
    view, last = target.create_view(), planet.constituents[-1]
    for number in range(count + 1):
        haze = replace(last, amount=last.amount * (1.0 + 0.1 * (number + 1)))
        edited = replace(planet, constituents=(*planet.constituents[:-1], haze))
        began = time.perf_counter()
        solution = solve_planet(edited, nm, "preview", device=gpu, cache=False)
        renderer.set_solution(solution, weights)
        renderer.display(scene, view, FORMAT, exposure=-3.0, settings=SETTINGS)
        device.wait()
        spent.append(1e3 * (time.perf_counter() - began))
    target.destroy()
    return np.array(spent[1:])


def measured(device: Device, given: argparse.Namespace) -> list[list[str]]:
    """Rows of the table."""
    rows = []
    changes = {"film.frames": given.frames}
    film = load_film(FLIGHT, changes)
    planet = film.planets[0]
    nothing = switched(planet, tuple(range(len(planet.constituents))))
    with_air = opened(device, planet, given.quality)
    sizes = SIZES if given.size is None else (given.size,)
    for air, renderer in ((True, with_air), (False, opened(device, nothing, "preview"))):
        for size in sizes:
            how = Quality(width=size[0], height=size[1])
            specs: list[Any] = [film.frame_spec(n, how) for n in range(given.frames)]
            spent = timed_scenes(device, renderer, [one.scene for one in specs])
            authors = AUTHORS.get(size, (None, None))
            name = "flight, 1 atmosphere" if air else "flight, without"
            target = TARGET.get(size) if air else None
            rows.append(row(name, size, spent, authors[0 if air else 1], target))
            print(" ", *rows[-1], flush=True)
    nm, weights = four_wavelengths(planet.star.irradiances, planet.wavelength_limits)
    solution = solve_planet(planet, nm, given.quality)
    for count in (2, 3):
        several = GpuSystemRenderer(device, with_air.sky_view_size)
        several.set_solutions({str(k): solution for k in range(count)}, weights)
        for size in sizes:
            how = Quality(width=size[0], height=size[1])
            specs = [film.frame_spec(n, how) for n in range(given.frames)]
            systems = [system_of(film.planet_name, one.scene, count) for one in specs]
            spent = timed(device, size, systems, partial(shown, several, size))
            beside = SEVERAL.get(size, (None, None))[count - 2]
            rows.append(row(f"flight, {count} atmospheres", size, spent, beside, None))
            print(" ", *rows[-1], flush=True)
    dome = Camera(projection="fisheye", width=given.dome, height=given.dome, look_zenith=0.0)
    scenes = [
        Scene(altitude=2.0 + k, sun_zenith=80.0, camera=dome) for k in range(min(given.frames, 10))
    ]
    try:
        rows.append(
            row(
                "dome", (given.dome, given.dome), timed_scenes(device, with_air, scenes), None, None
            )
        )
    except Exception as error:  # of the driver: too little memory of the GPU, too large a texture
        reason = str(error).strip().splitlines()[0]
        rows.append(["dome", f"{given.dome}x{given.dome}", reason, "", "", ""])
    small = Camera(width=sizes[0][0], height=sizes[0][1])
    scene = Scene(altitude=2.0, sun_zenith=80.0, camera=small)
    spent = edits(device, planet, scene, min(given.frames, 10))
    rows.append(row("edit to its light", sizes[0], spent, None, EDIT_TARGET))
    return rows


def table(device: Device, rows: list[list[str]]) -> str:
    """Table in Markdown."""
    info = device.adapter.info
    head = ["test", "size", "median [ms]", "95 % [ms]", "authors [ms]", "target [ms]"]
    gpu = f"{info['device']} ({info['adapter_type']}, {info['backend_type']})"
    lines = [
        f"GPU: {gpu}; driver: {info['vendor']} {info['description']}",
        "",
        *(f"| {' | '.join(cells)} |" for cells in (head, ["---"] * len(head), *rows)),
    ]
    return "\n".join(lines)


def size_of(text: str) -> tuple[int, int]:
    """Width and height of ``1280x720``. [pixel]"""
    width, _, height = text.partition("x")
    return int(width), int(height)


def main(words: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--frames", type=int, default=300, help="frames of the flight")
    parser.add_argument("--size", type=size_of, help="one size instead of the paper's")
    parser.add_argument("--dome", type=int, default=8192, help="width of the dome's frame")
    parser.add_argument("--quality", default="default", help="quality of the solution")
    parser.add_argument("--markdown", type=Path, help="file for the table")
    given = parser.parse_args(words)
    try:
        device = open_device()
    except NoDevice as reason:
        raise SystemExit(str(reason)) from None
    text = table(device, measured(device, given))
    print(text)
    if given.markdown is not None:
        given.markdown.write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
