"""Windows of a picture: their pixels are those of the whole picture, bit by bit."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from PIL import Image

from airlight import Camera, ParameterError, Scene, load_planet, render, solve
from airlight.cli import main
from airlight.image.display import to_display
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.picture.gpu_renderer import GpuRenderer
from airlight.render.render_system import render_system
from airlight.render.star_points import add_catalogue
from airlight.scene.system import load_system
from airlight.solver.moments.solution import MomentsSolution

CROP = (101, 37, 64, 50)


@pytest.fixture(scope="module")
def lit() -> MomentsSolution:
    return solve(load_planet("earth"), (680.0, 550.0, 440.0), "preview")


def window(whole: np.ndarray, crop: tuple[int, int, int, int] = CROP) -> np.ndarray:
    left, top, width, height = crop
    return whole[..., top : top + height, left : left + width, :]


def cropped(scene: Scene, crop: tuple[int, int, int, int] = CROP) -> Scene:
    return replace(scene, camera=replace(scene.camera, crop=crop))


@pytest.mark.parametrize(
    ("scene", "options"),
    [
        (Scene(altitude=2.0, sun_zenith=80.0, camera=Camera(width=320, height=180)), {}),
        (Scene(altitude=400e3, camera=Camera(width=320, height=180, look_zenith=110.0)), {}),
        (Scene(altitude=2.0, camera=Camera(projection="fisheye", width=256, height=256)), {}),
        (Scene(altitude=2.0, camera=Camera(width=320, height=180)), {"exact": True}),
        (Scene(altitude=2.0, camera=Camera(width=320, height=180)), {"stokes": True}),
    ],
)
def test_a_window_has_the_pixels_of_the_whole_picture(
    lit: MomentsSolution, scene: Scene, options: dict[str, Any]
) -> None:
    # The definition of a window; the table's texels and the samples are then the same, too.
    whole, part = (render(lit, one, **options) for one in (scene, cropped(scene)))
    assert_array_equal(part.rgb, window(whole.rgb))
    if options.get("stokes"):
        assert_array_equal(part.polarised, window(whole.polarised))


def test_tiles_make_the_whole_picture(lit: MomentsSolution) -> None:
    # Four tiles of uneven sizes, on a dome whose corners are black.
    scene = Scene(altitude=2.0, camera=Camera(projection="fisheye", width=200, height=200))
    whole = render(lit, scene).rgb
    rows = []
    for top, height in ((0, 70), (70, 130)):
        tiles = [
            render(lit, cropped(scene, (left, top, width, height))).rgb
            for left, width in ((0, 130), (130, 70))
        ]
        rows.append(np.concatenate(tiles, axis=1))
    assert_array_equal(np.concatenate(rows), whole)


def test_a_device_draws_the_same_window(device: Device, lit: MomentsSolution) -> None:
    # The definition again: pixels know their place in the whole picture.
    pictures = GpuRenderer(device)
    pictures.set_solution(lit)
    scene = Scene(altitude=2.0, sun_zenith=80.0, camera=Camera(width=320, height=180))
    whole, part = (pictures.render(one).rgb for one in (scene, cropped(scene)))
    assert_array_equal(part, window(whole))


def test_stars_and_dither_stand_where_they_do_in_the_whole_picture(lit: MomentsSolution) -> None:
    # Both depend on the place in the whole picture alone.
    camera = Camera(width=320, height=180, look_zenith=40.0, look_azimuth=180.0)
    scene = Scene(altitude=2.0, sun_zenith=120.0, camera=camera)
    frames = [render(lit, one) for one in (scene, cropped(scene))]
    for frame, one in zip(frames, (scene, cropped(scene)), strict=True):
        add_catalogue(frame.rgb, one, lit, "earth")
    assert frames[1].rgb.max() > 10.0 * np.median(frames[1].rgb)
    assert_array_equal(frames[1].rgb, window(frames[0].rgb))
    shown = [to_display(one.rgb, 10.0, origin=one.origin) for one in frames]
    assert_array_equal(shown[1], window(shown[0]))


def test_a_tile_of_a_file_is_exposed_as_the_whole(tmp_path: Path) -> None:
    # A lens and a meter see the whole picture.
    words = "--altitude 2m --sun-zenith 85 --size 160x90 --look-at sun --wavelengths rgb"
    command = ["render", "earth-bruneton", "--quality", "preview", *words.split()]
    more: tuple[list[str], ...] = ([], ["--glare", "0", "--exposure=-5"])
    for options in more:
        for name, crop in (("whole", []), ("tile", ["--crop", "60,20,40,30"])):
            assert main([*command, *options, *crop, "-o", str(tmp_path / f"{name}.png")]) == 0
        whole, tile = (np.asarray(Image.open(tmp_path / f"{n}.png")) for n in ("whole", "tile"))
        assert_array_equal(tile, window(whole, (60, 20, 40, 30)))


def test_a_tile_of_a_radiance_file_has_the_pixels_of_the_whole(tmp_path: Path) -> None:
    # The definition of a window, of four bytes a pixel (Ward 1991).
    command = ["render", "earth-bruneton", "--quality", "preview", "--wavelengths", "rgb"]
    found = []
    for size, crop in (((90, 160), []), ((30, 40), ["--crop", "60,20,40,30"])):
        path = tmp_path / f"{len(crop)}.hdr"
        assert main([*command, "--size", "160x90", *crop, "-o", str(path)]) == 0
        pixels = path.read_bytes().partition(b"\n\n")[2].partition(b"\n")[2]
        found.append(np.frombuffer(pixels, np.uint8).reshape(*size, 4))
    assert_array_equal(found[1], window(found[0], (60, 20, 40, 30)))


def test_a_tile_of_a_dome_is_black_beyond_the_circle_of_the_whole(lit: MomentsSolution) -> None:
    # A law: a lens that sees nothing there shows nothing, and light within the circle's edge.
    scene = Scene(sun_zenith=50.0, camera=Camera(projection="fisheye", width=200, height=200))
    frame = render(lit, cropped(scene, (10, 10, 60, 60)))
    shown = to_display(frame.rgb, -3.0, glare=10.0, dither=False, **frame.lens)
    place = 2 * np.arange(10, 70) + 1 - 200
    beyond = place**2 + place[:, None] ** 2 > 200**2
    assert 0 < beyond.sum() < beyond.size
    assert_array_equal(shown[beyond], 0)
    assert shown[~beyond].min() > 0


@pytest.mark.parametrize(
    "crop", [(0, 0, 321, 10), (-1, 0, 10, 10), (0, 0, 0, 10), (0, 0, 10), (0.5, 0, 10, 10), "0,0"]
)
def test_a_window_outside_the_picture_is_refused(crop: Any) -> None:
    with pytest.raises(ParameterError, match=r"camera\.crop .* inside 320x180 pixels"):
        Camera(width=320, height=180, crop=crop)


def test_a_scene_of_several_bodies_has_windows_too() -> None:
    # The definition: planets, surfaces and stars by the place in the whole picture. Lines to
    # stars are followed in other groups, which rounds their sums differently.
    system = load_system("orion")
    options: dict[str, Any] = {"width": 160, "height": 90, "wavelengths": (680.0, 550.0, 440.0)}
    crop = (60, 30, 50, 40)
    whole, part = (
        render_system(system, quality="preview", crop=one, **options) for one in (None, crop)
    )
    assert part.origin == (60, 30)
    assert_allclose(part.rgb, window(whole.rgb, crop), rtol=1e-6)
