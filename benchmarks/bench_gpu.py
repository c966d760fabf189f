"""Frames of the GPU: drawn for a window, read back as numbers, and what an empty frame costs.

Bar: 20 frames a second at 960 x 540 with the sky-view LUT, on two cores and lavapipe (software).
A frame begins with a moved camera and ends when the device has done it; beside the time stands the
part of it that the device's own clock gives to our passes.

Run with ``pytest benchmarks/bench_gpu.py``; AIRLIGHT_GPU chooses the device by a part of its name.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import count
from time import process_time
from typing import Any

import numpy as np
import pytest

from airlight import Camera, Scene, solve
from airlight.image.display_settings import DisplaySettings
from airlight.image.four_wavelengths import few_wavelengths
from airlight.render.gpu.device.device import Device, NoDevice, open_device
from airlight.render.gpu.device.flat import flat_texture, read_texture, update_flat
from airlight.render.gpu.device.fragment_pass import FragmentPass
from airlight.render.gpu.device.pass_times import PassTimes
from airlight.render.gpu.picture.gpu_renderer import QUICK_SKY_VIEW_SIZE, SKY_VIEW_SIZE, GpuRenderer

SIZES = [(960, 540), (1920, 1080)]
FORMAT = "rgba8unorm"
#: From where a frame is drawn: altitude, view zenith, sun zenith.
PLACES = {"ground": (2.0, 85.0, 60.0), "35 km": (35e3, 95.0, 80.0), "400 km": (400e3, 105.0, 75.0)}
#: Texels of the moments of a default solution of four wavelengths, as an order of magnitude.
FIELD = 500_000

EMPTY = "@fragment fn empty() -> @location(0) vec4f { return vec4f(0.5); }"


@pytest.fixture(scope="module")
def device() -> Device:
    try:
        return open_device()
    except NoDevice as reason:
        pytest.skip(str(reason))


@pytest.fixture(scope="module")
def solution(earth: Any) -> Any:
    return solve(earth, few_wavelengths(4, *earth.wavelength_limits), cache=False)


@pytest.fixture(scope="module")
def pictures(device: Device, solution: Any) -> Any:
    made = GpuRenderer(device)
    made.set_solution(solution)
    return made


def target(device: Device, size: tuple[int, int]) -> Any:
    import wgpu

    use = wgpu.TextureUsage.RENDER_ATTACHMENT | wgpu.TextureUsage.COPY_SRC
    return device.device.create_texture(size=(*size, 1), format=FORMAT, usage=use)


def scenes(place: str, size: tuple[int, int]) -> Callable[[], Scene]:
    """The next scene of a flight: no two frames are the same, so nothing is drawn from memory."""
    altitude, look, sun = PLACES[place]
    first = Scene(
        altitude=altitude,
        sun_zenith=sun,
        camera=Camera(width=size[0], height=size[1], look_zenith=look),
    )
    steps = count()
    return lambda: replace(first, altitude=altitude * (1.0 + 1e-3 * (next(steps) % 100)))


@pytest.mark.benchmark(group="an empty frame")
@pytest.mark.parametrize("size", SIZES, ids=lambda size: f"{size[0]}x{size[1]}")
def test_empty_frame(benchmark: Any, device: Device, size: Any, tell: Any) -> None:
    # what is left for a frame when nothing is drawn in it
    empty, view = FragmentPass(device, EMPTY, "empty", [FORMAT]), target(device, size)
    clocks = PassTimes(device) if device.measures_time else None

    def frame() -> None:
        encoder = device.device.create_command_encoder()
        empty.run(encoder, [], [view], timestamps=clocks("empty") if clocks else None)
        if clocks:
            clocks.resolve(encoder)
        device.device.queue.submit([encoder.finish()])
        device.wait()
        if clocks:
            on_device.append(clocks.read()["empty"])

    on_device: list[float] = []
    frame()
    benchmark(frame)
    if on_device:
        tell(f"{device}, empty frame {size}: {1e3 * np.median(on_device):.2f} ms on the device")


@pytest.mark.benchmark(group="tables of the GPU")
@pytest.mark.parametrize("way", ["upload", "update a tenth", "read back"])
def test_tables(benchmark: Any, device: Device, way: str) -> None:
    # 8 MB, the moments of a default solution
    values = np.random.default_rng(1).random((FIELD, 4), np.float32)
    texture = flat_texture(device, values)

    def run() -> None:
        if way == "upload":
            update_flat(device, texture, 0, values)
        elif way == "update a tenth":
            update_flat(device, texture, FIELD // 3, values[: FIELD // 10])
        else:
            read_texture(device, texture)
        device.wait()

    benchmark(run)


@pytest.mark.benchmark(group="a frame for the window")
@pytest.mark.parametrize("size", SIZES, ids=lambda size: f"{size[0]}x{size[1]}")
@pytest.mark.parametrize("table", [QUICK_SKY_VIEW_SIZE, SKY_VIEW_SIZE], ids=["moving", "resting"])
@pytest.mark.parametrize("place", PLACES)
def test_drawn_frame(
    benchmark: Any, device: Device, solution: Any, place: str, table: Any, size: Any, tell: Any
) -> None:
    # sky-view LUT, pixels and tone map, into a texture as in the window; the smaller LUT is that of
    # software GPUs while the view moves
    view, following = target(device, size).create_view(), scenes(place, size)
    pictures = GpuRenderer(device, table)
    pictures.set_solution(solution)
    settings = DisplaySettings(tone_map="aces", glare=0.0)
    spent: list[float] = []

    def frame() -> None:
        began = process_time()
        pictures.display(following(), view, FORMAT, exposure=-2.5, settings=settings)
        device.wait()
        spent.append(process_time() - began)

    frame()  # compiles the shaders
    spent.clear()
    benchmark.pedantic(frame, rounds=15)
    rate = 1.0 / benchmark.stats.stats.median
    tell(
        f"{device}, {place}, {size}, table {table}: {rate:.1f} frames a second, "
        f"{1e3 * np.median(spent):.0f} ms of CPU time a frame"
    )


@pytest.mark.benchmark(group="a frame as numbers")
@pytest.mark.parametrize("exact", [False, True], ids=["sky-view LUT", "every pixel marched"])
@pytest.mark.parametrize("place", PLACES)
def test_frame_as_numbers(benchmark: Any, pictures: Any, place: str, exact: bool) -> None:
    # linear light in float32, read back: what ``airlight render --device gpu`` waits for
    following = scenes(place, SIZES[0])
    pictures.render(following(), exact=exact)
    benchmark.pedantic(lambda: pictures.render(following(), exact=exact), rounds=3)


@pytest.mark.benchmark(group="a new solution on the GPU")
def test_show(benchmark: Any, device: Device, pictures: Any, earth: Any) -> None:
    # what an edit adds to the solver's time before the next frame can be drawn
    solution = solve(earth, few_wavelengths(4, *earth.wavelength_limits), "preview", cache=False)

    def show() -> None:
        pictures.set_solution(solution)
        device.wait()

    benchmark(show)
