"""One policy of who draws, for still and live pictures."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from airlight import Camera, Scene, load_planet
from airlight.errors import Cancelled, ParameterError
from airlight.gpu.device.device import Device
from airlight.paint.paint_scene import paint_scene
from airlight.paint.scene_painter import PROCESSOR, ScenePainter
from airlight.solvers.moments.solution import MomentsSolution

PLANET = "earth-atmosphere-plus"
NM = (680.0, 550.0, 440.0)
SCENE = Scene(camera=Camera(width=64, height=36), altitude=2e3, sun_zenith=70.0)

Solved = Callable[..., MomentsSolution]


def never() -> bool:
    return False


def test_a_live_picture_ends_as_the_still_one(solved: Solved) -> None:
    # one policy: what the window shows in the end is what the command line writes
    still = paint_scene(load_planet(PLANET), SCENE, wavelengths=NM, quality="preview")
    live = ScenePainter().live(solved(load_planet(PLANET), NM, "preview"), SCENE, stale=never)
    *_, last = live
    assert last.finished
    assert last.frame is not None
    assert_array_equal(last.frame.rgb, still.rgb)
    assert last.by == still.metadata["device"] == PROCESSOR


def test_the_processor_takes_what_a_device_has_no_capacity_for(
    device: Device, solved: Solved
) -> None:
    # a texel holds four wavelengths: five are drawn live by the processor, and refused by name
    nm = (680.0, 620.0, 550.0, 500.0, 440.0)
    solution = solved(load_planet(PLANET), nm, "preview")
    painter = ScenePainter(dataclasses.replace(device, software=False))
    *_, last = painter.live(solution, SCENE, stale=never)
    painter.close()
    *_, again = painter.live(solution, SCENE, stale=never)
    assert [one.by for one in (last, again)] == [PROCESSOR] * 2
    with pytest.raises(ParameterError, match="at most 4 on the GPU"):
        painter.frame(solution, SCENE)


def test_a_stale_picture_stops_after_its_first_coarse_step(solved: Solved) -> None:
    # the first step is shown however quickly requests follow each other; the rest is left
    painter = ScenePainter()
    painter._rate = 2000.0  # as if the processor were slow: the first picture is a small one
    steps = painter.live(solved(load_planet(PLANET), NM, "preview"), SCENE, stale=lambda: True)
    first = next(steps)
    assert not first.finished
    assert first.scene.camera.width < SCENE.camera.width
    with pytest.raises(Cancelled):
        next(steps)


def test_a_still_picture_follows_a_live_one_on_the_same_device(
    device: Device, solved: Solved
) -> None:
    # live pictures of a software device read a coarser table, which a still picture must not
    solution = solved(load_planet(PLANET), NM, "preview")
    painter, fresh = ScenePainter(device), ScenePainter(device)
    list(painter.live(solution, SCENE, stale=never))
    painter.close()
    list(painter.live(solution, SCENE, stale=never))
    assert_array_equal(painter.frame(solution, SCENE).rgb, fresh.frame(solution, SCENE).rgb)
    assert np.ptp(painter.frame(solution, SCENE).rgb) > 0.0
