"""Saving from the window: the files hold the picture shown, errors are one line."""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose
from PIL import Image

from airlight import Camera, Scene, load_planet
from airlight.image.display import to_display
from airlight.image.display_settings import DisplaySettings
from airlight.render import render
from airlight.solver.moments.solution import MomentsSolution
from airlight.viewer.painting.picture_source import Picture, Request
from airlight.viewer.window.film import sun_path, sunlit
from airlight.viewer.window.panels.save import Saving

ACES = DisplaySettings(tone_map="aces", eye=False)


@pytest.fixture
def shown(solved: Callable[..., MomentsSolution]) -> Picture:
    solution = solved(load_planet("earth-atmosphere-plus"), (680.0, 550.0, 440.0), "preview")
    scene = Scene(camera=Camera(width=40, height=24), altitude=1e3, sun_zenith=50.0)
    request = Request(solution=solution, scene=scene, orders="multiple", display=ACES)
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
    # The renderer called directly with the window's orders, exposure, tone map and glare.
    file = tmp_path / "a.png"
    saving = saved(file, shown, None)
    assert saving.error == ""
    assert saving.message.startswith(f"saved {file}  40×24")
    scene = shown.request.scene
    light = render(shown.request.solution, scene, orders="multiple")
    angle, white = scene.camera.pixel_angle, light.star_white
    expected = to_display(light.rgb, -1.5, tone_map="aces", pixel_angle=angle, star_white=white)
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
    assert "the name of a picture ends in .png, .exr, .hdr" in saving.error
    assert "\n" not in saving.error
    assert not list(tmp_path.iterdir())


def test_closing_stops_a_large_picture(tmp_path: Path, shown: Picture) -> None:
    saving = Saving(lambda: None)
    saving.save(str(tmp_path / "a.png"), shown, (8192, 4096))
    saving.close()
    assert not list(tmp_path.iterdir())


def test_a_film_shows_the_sun_move_from_where_one_is(tmp_path: Path, shown: Picture) -> None:
    # Its first and last frames are the pictures of those suns, rendered one by one; lossless PNG.
    file = tmp_path / "a.png"
    suns = sun_path(0.0, (50.0, 90.0), 2.0, 0.2)
    saving = Saving(lambda: None)
    saving.film(str(file), shown, None, suns)
    limit = time.monotonic() + 60.0
    while saving.busy:
        assert time.monotonic() < limit
        time.sleep(0.01)
    assert saving.error == ""
    assert saving.message.startswith(f"saved {file}  4 frames")
    scenes = sunlit(shown.request.scene, suns)
    # the camera stays: its bearing is that of the sun and the azimuth from it
    for scene in scenes:
        bearing = scene.sun_azimuth + scene.camera.look_azimuth
        assert_allclose((bearing - shown.request.scene.sun_azimuth) % 360.0, 0.0, atol=1e-9)
    with Image.open(file) as film:
        assert film.n_frames == 4
        for index in (0, 3):
            film.seek(index)
            light = render(shown.request.solution, scenes[index], orders="multiple")
            angle, white = scenes[index].camera.pixel_angle, light.star_white
            expected = to_display(light.rgb, -1.5, "aces", pixel_angle=angle, star_white=white)
            assert_allclose(np.asarray(film.convert("RGB")).astype(int), expected, rtol=0, atol=0)
    assert np.abs(np.diff([s[0] for s in suns])).min() > 1.0


def test_a_film_s_automatic_exposure_follows_the_light_smoothly(
    tmp_path: Path, shown: Picture
) -> None:
    # From the exposure of the picture towards that of each frame, 1/20 s of 0.13 s at a time.
    file = tmp_path / "a.png"
    suns = sun_path(0.0, (50.0, 90.0), 2.0, 0.2)
    request = dataclasses.replace(shown.request, automatic=True, exposure=-0.5)
    saving = Saving(lambda: None)
    saving.film(str(file), dataclasses.replace(shown, request=request), None, suns)
    limit = time.monotonic() + 60.0
    while saving.busy:
        assert time.monotonic() < limit
        time.sleep(0.01)
    exposure = -1.5
    with Image.open(file) as film:
        for index, scene in enumerate(sunlit(request.scene, suns)):
            film.seek(index)
            frame = render(request.solution, scene, orders="multiple")
            share = 1.0 - np.exp(-0.05 / 0.13)
            exposure += share * (frame.exposure - 0.5 - exposure)
            expected = to_display(frame.rgb, exposure, "aces", eye=False, **frame.lens)
            found = np.asarray(film.convert("RGB")).astype(int)
            assert_allclose(found, expected, rtol=0, atol=1)
    assert exposure < -1.8  # it has moved


def test_a_film_has_a_suffix_of_its_own(tmp_path: Path, shown: Picture) -> None:
    saving = Saving(lambda: None)
    saving.film(str(tmp_path / "a.gif"), shown, None, ((50.0, 90.0), (51.0, 90.0)))
    assert "the name of a film ends in .webp or .png" in saving.error
    assert not list(tmp_path.iterdir())
