"""The two painters show the same picture by different methods."""

from __future__ import annotations

import copy
import dataclasses
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import Camera, Scene, load_planet
from airlight.planets.picture_wavelengths import picture_wavelengths
from airlight.render.gpu.device.device import Device
from airlight.render.live_renderer import LiveRenderer
from airlight.render.solve_planet import live_solver
from airlight.solver.moments.solution import MomentsSolution
from airlight.viewer.painting.picture_source import Picture, Request
from airlight.viewer.painting.side_renderer import SideRenderer
from airlight.viewer.session.adaptation import Adaptation

Solved = Callable[..., MomentsSolution]


@pytest.fixture(scope="module")
def request_(solved: Solved) -> Request:
    earth = load_planet("earth-atmosphere-plus")
    nm = tuple(float(one) for one in picture_wavelengths(earth, "four"))
    scene = Scene(
        camera=Camera(width=96, height=54, look_zenith=95.0, look_azimuth=60.0),
        altitude=2e3,
        sun_zenith=70.0,
    )
    return Request(solution=solved(earth, nm, "preview"), scene=scene, exposure=0.0, automatic=True)


def pixels(device: Device, picture: Picture) -> np.ndarray:
    data: Any = device.device.queue.read_texture(
        {"texture": picture.view.texture, "mip_level": 0, "origin": (0, 0, 0)},
        {"offset": 0, "bytes_per_row": 4 * picture.width, "rows_per_image": picture.height},
        (picture.width, picture.height, 1),
    )
    shape = (picture.height, picture.width, 4)
    return np.frombuffer(data, np.uint8).reshape(shape)[..., :3].astype(int)


def never() -> bool:
    return False


def renderer_of(device: Device, by: Device | None = None) -> SideRenderer:
    """PictureSource with textures on a device, that draws by the CPU or by a device."""
    return SideRenderer(device.device, LiveRenderer(by))


def test_the_cpu_paints_finer_and_finer(device: Device, request_: Request) -> None:
    # Each picture has more pixels than the one before, the last has all.
    renderer = renderer_of(device)
    renderer._renderer._rate = 2000.0  # as if the CPU were slow: the first picture is a small one
    pictures = list(renderer.render(request_, never))
    widths = [one.width for one in pictures]
    assert widths == sorted(set(widths))
    assert len(widths) >= 2
    assert widths[-1] == 96
    assert [one.finished for one in pictures] == [False] * (len(widths) - 1) + [True]


def test_a_change_of_exposure_renders_nothing_anew(device: Device, request_: Request) -> None:
    # The requested exposure is added to the measured one; an existing frame is shown at once.
    renderer = renderer_of(device)
    automatic = list(renderer.render(request_, never))[-1]
    stops = dataclasses.replace(request_, exposure=-2.0)
    again = list(renderer.render(stops, never))
    assert [one.finished for one in again] == [True]
    assert_allclose(again[0].exposure, automatic.exposure - 2.0)


def test_both_painters_show_the_same(device: Device, request_: Request) -> None:
    # Two renderers of one solution: by the sky-view LUT, and by ray marching for each pixel.
    cpu = renderer_of(device)
    exact = pixels(device, list(cpu.render(request_, never))[-1])
    renderer = renderer_of(device, dataclasses.replace(device, software=False))
    while True:  # the CPU renders the first pictures while the shaders are compiled
        shown = list(renderer.render(request_, never))[-1]
        if shown.by == "GPU":
            break
        time.sleep(0.05)
    renderer.close()
    assert shown.finished
    # automatic exposure is measured on a smaller picture; tables are interpolated
    assert_allclose(pixels(device, shown), exact, rtol=0, atol=6)


def test_in_software_the_exact_picture_follows(device: Device, request_: Request) -> None:
    # From the sky-view LUT while the view moves, by the CPU at rest.
    if not device.software:
        pytest.skip("this device is no software")
    renderer = renderer_of(device, device)
    list(renderer.render(request_, never))
    renderer._renderer.close()  # the shaders are compiled
    moved = dataclasses.replace(
        request_, scene=dataclasses.replace(request_.scene, sun_zenith=60.0)
    )
    pictures = list(renderer.render(moved, never))
    assert [one.finished for one in pictures] == [False, True]
    assert [one.by for one in pictures] == ["GPU in software", "CPU"]
    # The first picture of an edited planet is metered itself, and is as bright as the last.
    adaptation = Adaptation()
    adaptation.towards(pictures[-1].exposure + 4.0, held=False)
    edited = dataclasses.replace(moved, solution=copy.copy(moved.solution), adaptation=adaptation)
    bright = []
    for one in renderer.render(edited, never):
        bright.append(pixels(device, one).mean())
    renderer.close()
    assert bright == pytest.approx([pixels(device, pictures[-1]).mean()] * len(bright), abs=1.5)


def test_what_the_gpu_has_no_room_for_the_cpu_solves(device: Device) -> None:
    # Four wavelengths fit into a texel, eight do not; both are solved.
    earth = load_planet("earth-atmosphere-plus")
    solver = live_solver("auto", dataclasses.replace(device, software=False))

    def progress(_done: int, _total: int, _message: str) -> None:
        pass

    for count in ("four", "eight"):
        nm = picture_wavelengths(earth, count)
        solution = solver(earth, nm, "preview", progress=progress, cancel=never)
        assert solution.planet is earth
        assert_allclose(solution.wavelengths, nm)


def test_stars_come_at_night(device: Device, request_: Request) -> None:
    # The catalogue is that of airlight.render(stars=True): by day none, at night points and the
    # Milky Way, in the last picture alone.
    scene = dataclasses.replace(
        request_.scene, sun_zenith=115.0, camera=Camera(width=96, height=54, look_zenith=50.0)
    )
    night = dataclasses.replace(request_, scene=scene)
    renderer = renderer_of(device)
    *before, last = renderer.render(night, never)
    assert not any(one.finished for one in before)
    assert last.finished
    added = pixels(device, last) - pixels(device, before[-1])
    assert (added.max(axis=2) > 40).sum() > 5
    day = [*renderer.render(request_, never)]
    assert day[-1].finished
    renderer.close()
