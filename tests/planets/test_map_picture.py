"""Pictures of maps: every mode of colour, refused by their headers before they are decoded."""

from __future__ import annotations

import struct
import warnings
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from PIL import Image

from airlight.errors import FileError
from airlight.planets.map_picture import map_pixels

#: An opaque red left half, and a right half of grey that is transparent where it can be.
RED, GREY = (255, 0, 0), (51, 51, 51)


def halves() -> Image.Image:
    picture = Image.new("RGB", (8, 4), RED)
    picture.paste(GREY, (4, 0, 8, 4))
    return picture


def transparent() -> Image.Image:
    picture = halves().convert("RGBA")
    picture.putalpha(Image.fromarray(np.repeat([[255, 0]], 4, axis=1).repeat(4, 0).astype("u1")))
    return picture


def palette() -> Image.Image:
    picture = halves().quantize(2)
    picture.info["transparency"] = 0
    return picture


@pytest.mark.parametrize("make", [halves, transparent, palette])
def test_colours_are_kept_whatever_the_mode(tmp_path: Path, make: Any) -> None:
    # Transparency is no reflectance: the colour below it is the ground's.
    make().save(tmp_path / "map.png")
    pixels = map_pixels(tmp_path / "map.png")
    assert_array_equal(pixels, np.asarray(halves()))


@pytest.mark.parametrize("mode", ["1", "L", "LA", "I;16"])
def test_grey_of_every_depth_is_grey(tmp_path: Path, mode: str) -> None:
    # White and black are the same number in all depths, 65535 being the white of sixteen bits.
    white = 65535 if mode == "I;16" else 255
    values = np.zeros((4, 8), np.uint16 if mode == "I;16" else np.uint8)
    values[:, 4:] = white
    picture = Image.fromarray(values)
    (picture if mode == "I;16" else picture.convert(mode)).save(tmp_path / "map.png")
    wanted = np.where(values == white, 255, 0)
    assert_array_equal(map_pixels(tmp_path / "map.png", grey=True), wanted)
    assert_array_equal(map_pixels(tmp_path / "map.png"), wanted[..., None].repeat(3, 2))


def header_of(width: int, height: int) -> bytes:
    """PNG of black pixels that says its size and has no more than the beginning of its data."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        return (
            struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        )

    size = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", size) + chunk(b"IDAT", zlib.compress(b"\0" * 99))


@pytest.mark.parametrize("width", [20002, 60000, 2_000_000])
def test_a_picture_that_would_fill_the_memory_is_refused_by_its_header(
    tmp_path: Path, width: int
) -> None:
    # The file has a hundred bytes: whoever decoded it would find it cut short.
    file = tmp_path / "bomb.png"
    file.write_bytes(header_of(width, width // 2))
    with warnings.catch_warnings(), pytest.raises(FileError, match="pixels; allowed: ") as refusal:
        warnings.simplefilter("error")
        map_pixels(file)
    assert "\n" not in str(refusal.value)


def test_pictures_between_pillow_s_limit_and_ours_do_not_warn(tmp_path: Path) -> None:
    # Pillow warns above 89 million pixels; the data that are missing are the next complaint.
    file = tmp_path / "large.png"
    file.write_bytes(header_of(18000, 9000))
    with pytest.raises(FileError, match="cannot be read as a picture"):
        map_pixels(file)


@pytest.mark.parametrize("size", [(8, 8), (4, 8), (10, 4)])
def test_a_picture_that_is_not_twice_as_wide_as_high_is_refused(
    tmp_path: Path, size: tuple[int, int]
) -> None:
    Image.new("RGB", size).save(tmp_path / "map.png")
    with pytest.raises(FileError, match="allowed: twice as wide as high"):
        map_pixels(tmp_path / "map.png")


def test_an_odd_width_counts_as_twice_the_height(tmp_path: Path) -> None:
    Image.new("RGB", (9, 5)).save(tmp_path / "map.png")
    assert map_pixels(tmp_path / "map.png").shape == (5, 9, 3)


@pytest.mark.parametrize(
    ("value", "words"),
    [(np.nan, "nan"), (np.inf, "inf"), (-np.inf, "-inf"), (-9999.0, "-9999"), (1.5, "1.5")],
)
@pytest.mark.parametrize("grey", [False, True])
def test_missing_data_of_a_float_map_are_refused_with_their_number(
    tmp_path: Path, value: float, words: str, grey: bool
) -> None:
    # what is no reflectance has no colour: marks of missing data became black or white
    values = np.full((4, 8), 0.25, np.float32)
    values[2, 5], values[3, 0] = value, value
    Image.fromarray(values).save(tmp_path / "map.tif")
    said = f"has 2 pixels out of range, the first {words} at column 5, row 2; allowed: 0 to 1"
    with pytest.raises(FileError, match=said):
        map_pixels(tmp_path / "map.tif", grey=grey)


def test_a_float_map_may_overshoot_by_what_eight_bits_round_away(tmp_path: Path) -> None:
    # 0.5 / 255 is the half step: enlarged maps overshoot their ends by rounding
    values = np.full((4, 8), 1.0 + 0.49 / 255.0, np.float32)
    values[:, :4] = -0.49 / 255.0
    Image.fromarray(values).save(tmp_path / "map.tif")
    assert_array_equal(np.unique(map_pixels(tmp_path / "map.tif", grey=True)), [0, 255])


def test_negative_whole_numbers_are_no_reflectance(tmp_path: Path) -> None:
    Image.fromarray(np.full((4, 8), -1, np.int32)).save(tmp_path / "map.tif")
    with pytest.raises(FileError, match="32 pixels out of range, the first -1"):
        map_pixels(tmp_path / "map.tif")
