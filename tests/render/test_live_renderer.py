"""One policy of who draws, for still and live pictures."""

from __future__ import annotations

import dataclasses
import weakref
from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from airlight import Camera, Scene, load_planet
from airlight.errors import Cancelled, ParameterError
from airlight.render.gpu.device.device import Device
from airlight.render.live_renderer import LiveRenderer
from airlight.render.render_scene import CPU, render_scene, render_solution
from airlight.solver.moments.solution import MomentsSolution

PLANET = "earth-atmosphere-plus"
NM = (680.0, 550.0, 440.0)
SCENE = Scene(camera=Camera(width=64, height=36), altitude=2e3, sun_zenith=70.0)

Solved = Callable[..., MomentsSolution]


def never() -> bool:
    return False


def test_a_live_picture_ends_as_the_still_one(solved: Solved) -> None:
    # one policy: what the window shows in the end is what the command line writes
    still = render_scene(load_planet(PLANET), SCENE, wavelengths=NM, quality="preview")
    live = LiveRenderer().live(solved(load_planet(PLANET), NM, "preview"), SCENE, stale=never)
    *_, last = live
    assert last.finished
    assert last.frame is not None
    assert_array_equal(last.frame.rgb, still.rgb)
    assert last.by == still.metadata["device"] == CPU


def test_the_cpu_takes_what_a_device_has_no_capacity_for(device: Device, solved: Solved) -> None:
    # a texel holds four wavelengths: five are rendered live by the CPU, and refused by name
    nm = (680.0, 620.0, 550.0, 500.0, 440.0)
    solution = solved(load_planet(PLANET), nm, "preview")
    renderer = LiveRenderer(dataclasses.replace(device, software=False))
    *_, last = renderer.live(solution, SCENE, stale=never)
    renderer.close()
    *_, again = renderer.live(solution, SCENE, stale=never)
    assert [one.by for one in (last, again)] == [CPU] * 2
    with pytest.raises(ParameterError, match="at most 4 on the GPU"):
        render_solution(solution, SCENE, device)


def test_a_stale_picture_stops_after_its_first_coarse_step(solved: Solved) -> None:
    # the first step is shown however quickly requests follow each other; the rest is left
    renderer = LiveRenderer()
    renderer._rate = 2000.0  # as if the CPU were slow: the first picture is a small one
    steps = renderer.live(solved(load_planet(PLANET), NM, "preview"), SCENE, stale=lambda: True)
    first = next(steps)
    assert not first.finished
    assert first.scene.camera.width < SCENE.camera.width
    with pytest.raises(Cancelled):
        next(steps)


def test_a_still_picture_follows_a_live_one_on_the_same_device(
    device: Device, solved: Solved
) -> None:
    # live pictures of a software GPU read a coarser table, which a still picture must not
    solution = solved(load_planet(PLANET), NM, "preview")
    before = render_solution(solution, SCENE, device).rgb
    renderer = LiveRenderer(device)
    list(renderer.live(solution, SCENE, stale=never))
    renderer.close()
    list(renderer.live(solution, SCENE, stale=never))
    assert_array_equal(render_solution(solution, SCENE, device).rgb, before)
    assert np.ptp(before) > 0.0


def test_the_device_of_a_compilation_is_released(
    device: Device, solved: Solved, monkeypatch: pytest.MonkeyPatch
) -> None:
    # with its shaders, more than a hundred megabytes
    apart: list[weakref.ref[object]] = []
    duplicate = Device.duplicate

    def remembered(one: Device) -> Device:
        second = duplicate(one)
        apart.append(weakref.ref(second.device))
        return second

    monkeypatch.setattr(Device, "duplicate", remembered)
    renderer = LiveRenderer(dataclasses.replace(device, software=True))
    list(renderer.live(solved(load_planet(PLANET), NM, "preview"), SCENE, stale=never))
    assert renderer._compiling is not None
    renderer._compiling.join()
    assert [one() for one in apart] == [None]
