"""The map of the ground: placed right, without a seam, and with the right mean."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from PIL import Image

from airlight.errors import FileError
from airlight.image.encoding import srgb_decode, srgb_encode
from airlight.image.texels import decoded_texels
from airlight.scene.map_levels import level_count
from airlight.scene.surface_map import SurfaceMap, from_pixels, surface_map


def striped(height: int = 64) -> SurfaceMap:
    """Red grows to the north, green to the east of 180° W and back, both linear in the angle."""
    latitude = 90.0 - (np.arange(height) + 0.5) * 180.0 / height
    longitude = -180.0 + (np.arange(2 * height) + 0.5) * 180.0 / height
    red = np.broadcast_to((90.0 + latitude[:, None]) / 180.0, (height, 2 * height))
    green = np.broadcast_to(1.0 - np.abs(longitude[None, :]) / 180.0, (height, 2 * height))
    pixels = np.rint(255.0 * srgb_encode(np.stack([red, green, 0.0 * red], axis=-1)))
    water = np.rint(127.5 * red).astype(np.uint8)
    return from_pixels("striped", pixels.astype(np.uint8), water)


def test_colours_between_pixels_are_linear_in_the_angles() -> None:
    # Bilinear interpolation of a linear function is exact away from the kinks; the texels are its
    # values to half a step of eight bits, at most 0.0045 of sRGB and 0.002 of the water.
    where = striped()
    latitude, longitude = np.meshgrid([-60.3, 0.0, 71.7], [-150.1, -10.2, 33.3, 170.9])
    colours = where.sample(latitude, longitude)
    assert colours.shape == (4, 3, 4)
    assert_allclose(colours[..., 0], (90.0 + latitude) / 180.0, atol=4.5e-3)
    assert_allclose(colours[..., 1], 1.0 - np.abs(longitude) / 180.0, atol=4.5e-3)
    assert_allclose(colours[..., 3], (90.0 + latitude) / 360.0, atol=2e-3)


def test_longitude_goes_round_without_a_seam() -> None:
    where = striped()
    assert_allclose(where.sample(10.0, 180.0 - 1e-9), where.sample(10.0, -180.0 + 1e-9), atol=1e-6)
    assert_allclose(where.sample(10.0, 33.0 + 720.0), where.sample(10.0, 33.0), atol=1e-5)
    assert_allclose(where.sample(10.0, -327.0), where.sample(10.0, 33.0), atol=1e-5)


def test_the_poles_are_the_first_and_the_last_row() -> None:
    where = striped()
    ends = decoded_texels(where.levels[0][[0, -1], 0])
    assert_array_equal(where.sample([90.0, -90.0], 33.0)[..., 0], ends[..., 0])


def test_mean_weighs_a_polar_cap_by_its_area() -> None:
    # Archimedes: the cap north of 30° has (1 - sin 30°)/2 = 1/4 of the sphere's area
    pixels = np.zeros((60, 120, 3), dtype=np.uint8)
    pixels[:20] = 255
    assert_allclose(from_pixels("cap", pixels).mean_rgb, 0.25, rtol=1e-6)


def test_pixels_are_decoded_from_srgb() -> None:
    # IEC 61966-2-1: 118/255 is 0.1812 (middle grey), 255 is 1
    where = from_pixels("grey", np.full((1, 2, 3), [0, 118, 255], dtype=np.uint8))
    assert_allclose(where.sample(0.0, -180.0), [0.0, 0.1812, 1.0, 0.0], atol=5e-5)


def test_water_is_linear_and_its_mean_weighs_the_area() -> None:
    # The definition of a share; 51/255 is a fifth, of a cap with a quarter of the sphere.
    water = np.zeros((60, 120), dtype=np.uint8)
    water[:20] = 51
    where = from_pixels("cap", np.full((60, 120, 3), 255, np.uint8), water)
    assert_allclose(where.sample(80.0, 0.0), [1.0, 1.0, 1.0, 0.2], rtol=1e-6)
    assert_allclose([where.mean_water, *where.mean_rgb], [0.05, 1.0, 1.0, 1.0], rtol=1e-6)


def test_each_level_has_the_mean_of_the_one_before() -> None:
    pixels = np.random.default_rng(3).integers(0, 256, (32, 64, 3), dtype=np.uint8)
    water = np.random.default_rng(4).integers(0, 256, (32, 64), dtype=np.uint8)
    levels = from_pixels("noise", pixels, water).levels
    assert [level.shape[:2] for level in levels] == [(32 >> i, 64 >> i) for i in range(6)]
    for fine, level in pairwise(levels):
        # Second path: whole arrays. A texel is off by half a step of eight bits at most.
        linear = decoded_texels(fine)
        wanted = linear.reshape(level.shape[0], 2, level.shape[1], 2, 4).mean(axis=(1, 3))
        assert_allclose(decoded_texels(level), wanted, atol=0.5 * 2.3 / 255.0)


def test_level_has_texels_as_large_as_the_footprint() -> None:
    where = from_pixels("white", np.full((32, 64, 3), 255, dtype=np.uint8))
    texel = np.pi / 32.0
    assert_allclose(where.level([0.0, texel, 2.0 * texel, 8.0 * texel, 1e3]), [0, 0, 1, 3, 5])


def test_sampling_different_levels_at_once_is_sampling_each_alone() -> None:
    pixels = np.random.default_rng(4).integers(0, 256, (16, 32, 3), dtype=np.uint8)
    where = from_pixels("noise", pixels)
    latitude, longitude = np.array([-40.0, 5.0, 80.0]), np.array([-170.0, 12.0, 179.0])
    together = where.sample(latitude, longitude, [0.0, 2.4, 1.6])
    alone = [where.sample(a, b, c) for a, b, c in zip(latitude, longitude, [0, 2, 2], strict=True)]
    assert_array_equal(together, alone)


@pytest.mark.parametrize("rows", [5, 27, 675])
def test_levels_of_odd_sizes_keep_the_mean(rows: int) -> None:
    # Equal parts of the whole: the mean over rows and columns stays, but for the rounding to eight
    # bits, at most 0.0015 a level at this brightness; it averages out where there are many texels.
    pixels = np.random.default_rng(5).integers(90, 110, (rows, 2 * rows, 3), dtype=np.uint8)
    pixels[: rows // 2] += 20
    levels = from_pixels("odd", pixels).levels
    assert len(levels) == level_count(rows)
    assert levels[-1].shape == (1, 2, 4)
    means = [decoded_texels(level).mean(axis=(0, 1), dtype=np.float64) for level in levels]
    assert_allclose(means, np.broadcast_to(means[0], (len(levels), 4)), atol=3e-3)


def test_levels_are_held_once() -> None:
    # One after another, as formulas and devices read them, and not a second time.
    where = from_pixels("grey", np.full((5, 10, 3), 118, np.uint8))
    assert_array_equal(where.flat, np.concatenate([one.reshape(-1) for one in where.levels]))
    assert all(np.shares_memory(one, where.flat) for one in where.levels)


def test_a_larger_map_than_devices_hold_is_reduced(monkeypatch: pytest.MonkeyPatch) -> None:
    # Each new texel is the mean of three by three old ones, in linear light.
    monkeypatch.setattr("airlight.scene.surface_map.MOST_TEXELS", 30 * 60)
    pixels = np.random.default_rng(6).integers(0, 256, (90, 180, 3), dtype=np.uint8)
    full = from_pixels("large", pixels).levels[0]
    assert full.shape == (30, 60, 4)
    wanted = srgb_decode(pixels / 255.0).reshape(30, 3, 60, 3, 3).mean(axis=(1, 3))
    assert_allclose(decoded_texels(full)[..., :3], wanted, atol=0.5 * 2.3 / 255.0)


def test_a_picture_s_file_is_a_map(tmp_path: Path) -> None:
    Image.new("L", (8, 4), 255).save(tmp_path / "white.png")
    assert_allclose(surface_map(str(tmp_path / "white.png")).mean_rgb, 1.0, rtol=1e-6)


@pytest.mark.parametrize("content", [None, b"no picture", b"\x89PNG\r\n\x1a\n"])
def test_what_is_no_picture_is_refused_in_one_line(tmp_path: Path, content: bytes | None) -> None:
    file = tmp_path / "map.png"
    if content is not None:
        file.write_bytes(content)
    with pytest.raises(FileError) as refusal:
        surface_map(str(file))
    assert "\n" not in str(refusal.value)


def test_an_unknown_map_is_refused_with_the_known_ones() -> None:
    known = "earth, jupiter, mars, moon, pluto, saturn"
    with pytest.raises(FileError, match=rf"unknown ground map \(known: {known}\)$"):
        surface_map("vulcan")


def test_earth_s_map_lies_the_right_way_round() -> None:
    # regions that any atlas shows: bright sand and ice, dark seas, green forest
    earth = surface_map("earth")
    height, width = earth.levels[0].shape[:2]
    assert width == 2 * height
    sahara, antarctica, pacific, congo = earth.sample(
        [23.0, -80.0, -20.0, 0.0], [15.0, 90.0, -120.0, 22.0], 3
    )[:, :3]
    assert sahara.mean() > 3.0 * pacific.mean()
    assert antarctica.mean() > 3.0 * pacific.mean()
    assert sahara[0] > sahara[2]
    assert congo[1] > congo[0]
    # land and sea seen through clear air reflect some tens of percent at most
    assert np.all((earth.mean_rgb > 0.01) & (earth.mean_rgb < 0.5))


def test_irrigated_land_is_green_and_desert_is_not() -> None:
    # Green over red of crops and canopies is 1.2 to 2 (SOURCES.md), of sand below 1: the Nile's
    # delta and valley, the Po's plain, Punjab, rain forest; deserts of Egypt and Arabia.
    earth = surface_map("earth")
    latitudes = [30.8, 45.0, 31.0, -4.0, 28.0, 22.0]
    longitudes = [31.0, 10.5, 74.0, -63.0, 26.0, 50.0]
    red, green, _blue, _water = earth.sample(latitudes, longitudes).T
    assert (green[:4] > 1.2 * red[:4]).all()
    assert (green[4:] < 0.85 * red[4:]).all()


def test_water_is_read_from_the_file_beside_the_map(tmp_path: Path) -> None:
    Image.new("RGB", (8, 4), (255, 255, 255)).save(tmp_path / "own.jpg")
    Image.new("L", (8, 4), 51).save(tmp_path / "own-water.png")
    assert_allclose(surface_map(str(tmp_path / "own.jpg")).mean_water, 0.2, rtol=1e-6)


def test_water_of_another_size_is_refused(tmp_path: Path) -> None:
    Image.new("RGB", (8, 4)).save(tmp_path / "own.jpg")
    Image.new("L", (4, 2)).save(tmp_path / "own-water.png")
    with pytest.raises(FileError, match="another size; allowed: 8 x 4"):
        surface_map(str(tmp_path / "own.jpg"))


def test_the_earth_s_water_is_where_an_atlas_has_it() -> None:
    # Charette and Smith (2010), Oceanography 23, 112: the ocean covers 361.84e6 km² of 510.07e6,
    # 70.9 %; lakes add 1 %, turbid coasts and what is below a pixel are missing.
    earth = surface_map("earth")
    assert_allclose(earth.mean_water, 0.711, atol=0.005)
    atlantic, sahara, caspian, victoria, greenland = earth.sample(
        [30.0, 24.0, 42.0, -1.0, 75.0], [-40.0, 10.0, 50.5, 33.0, -40.0]
    )[:, 3]
    assert_allclose([atlantic, caspian, victoria], 1.0)
    assert_allclose([sahara, greenland], 0.0)
