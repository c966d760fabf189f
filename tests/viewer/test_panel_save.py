"""Saving from the window: the files hold the picture shown, errors are one line."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose
from PIL import Image

from airlight import Camera, Scene, load_planet
from airlight.color.display import to_display
from airlight.render import render
from airlight.solvers.moments.solution import MomentsSolution
from airlight.viewer.painting.picture_source import Picture, Request
from airlight.viewer.window.panels.save import Saving


@pytest.fixture
def shown(solved: Callable[..., MomentsSolution]) -> Picture:
    solution = solved(load_planet("earth-atmosphere-plus"), (680.0, 550.0, 440.0), "preview")
    scene = Scene(camera=Camera(width=40, height=24), altitude=1e3, sun_zenith=50.0)
    request = Request(solution=solution, scene=scene, orders="multiple", tone_map="aces")
    return Picture(
        view=None,
        width=40,
        height=24,
        request=request,
        exposure=-1.5,
        finished=True,
        seconds=0.0,
        by="test",
    )


def saved(path: Path, shown: Picture, size: tuple[int, int] | None) -> Saving:
    saving = Saving(lambda: None)
    saving.save(str(path), shown, size)
    limit = time.monotonic() + 60.0
    while saving.busy:
        assert time.monotonic() < limit
        time.sleep(0.01)
    return saving


def test_a_saved_picture_is_what_is_shown(tmp_path: Path, shown: Picture) -> None:
    # The renderer called directly with the window's orders, exposure and tone map.
    file = tmp_path / "a.png"
    saving = saved(file, shown, None)
    assert saving.error == ""
    assert saving.message.startswith(f"saved {file}  40×24")
    light = render(shown.request.solution, shown.request.scene, orders="multiple").rgb
    expected = to_display(light, exposure=-1.5, tone_map="aces")
    pixels = np.asarray(Image.open(file).convert("RGB"))
    assert_allclose(pixels.astype(int), expected.astype(int), rtol=0, atol=0)


def test_another_size_and_linear_light(tmp_path: Path, shown: Picture) -> None:
    file = tmp_path / "a.exr"
    saving = saved(file, shown, (64, 32))
    assert saving.error == ""
    assert "64×32" in saving.message
    assert file.stat().st_size > 64 * 32 * 2


def test_a_wrong_suffix_is_one_line(tmp_path: Path, shown: Picture) -> None:
    saving = saved(tmp_path / "a.bmp", shown, None)
    assert "the name of a picture ends in .png or .exr" in saving.error
    assert "\n" not in saving.error
    assert not list(tmp_path.iterdir())


def test_closing_stops_a_large_picture(tmp_path: Path, shown: Picture) -> None:
    saving = Saving(lambda: None)
    saving.save(str(tmp_path / "a.png"), shown, (8192, 4096))
    saving.close()
    assert not list(tmp_path.iterdir())
