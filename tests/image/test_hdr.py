"""Radiance pictures: read as the format's definition says, by a few lines of their own."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight import FileError, ParameterError
from airlight.image.hdr import rgbe, write_hdr
from airlight.render.picture import read_picture_metadata, write_picture


def read(path: Path) -> tuple[np.ndarray, dict[str, str]]:
    """Pixels and header by Ward (1991): mantissa / 256 · 2^(exponent - 128), over EXPOSURE."""
    head, _, rest = path.read_bytes().partition(b"\n\n")
    first, *lines = head.decode().splitlines()
    assert first == "#?RADIANCE"
    texts = dict(line.split("=", 1) for line in lines)
    assert texts["FORMAT"] == "32-bit_rle_rgbe"
    size, _, pixels = rest.partition(b"\n")
    y, height, x, width = size.split()
    assert (y, x) == (b"-Y", b"+X")
    raw = np.frombuffer(pixels, np.uint8).reshape(int(height), int(width), 4).astype(float)
    light = raw[..., :3] / 256.0 * 2.0 ** (raw[..., 3:] - 128.0)
    return light / float(texts["EXPOSURE"]), texts


def test_light_of_any_brightness_is_read_back_within_half_a_mantissa(tmp_path: Path) -> None:
    # eight bits of which the first is set: half a unit is 1/256 of the largest channel at most
    rng = np.random.default_rng(3)
    rgb = (rng.random((40, 30, 3)) * 10.0 ** rng.uniform(-20, 20, (40, 30, 1))).astype(np.float32)
    rgb[0, 0], rgb[0, 1] = 0.0, [1.0, -0.5, 0.0]
    write_hdr(tmp_path / "a.hdr", 0.25 * rgb, scale=0.25)
    light, texts = read(tmp_path / "a.hdr")
    seen = np.maximum(rgb, 0.0)
    error = np.abs(light - seen) / np.maximum(seen.max(axis=-1, keepdims=True), 1e-30)
    assert error.max() <= 1.0 / 256.0
    assert_array_equal(light[0, 0], 0.0)
    assert_allclose(light[0, 1], [1.0, 0.0, 0.0])
    assert texts["PRIMARIES"].split()[-2:] == ["0.3127", "0.3290"]


def test_pixels_are_those_of_the_published_code() -> None:
    # Ward (1991), setcolr: frexp of the largest channel; 255.5 units are the next exponent's 128
    light = np.array([[[1.0, 0.5, 0.25], [255.9 / 256.0, 0.0, 0.0], [2.0**-130, 0.0, 0.0]]])
    expected = [[[128, 64, 32, 129], [128, 0, 0, 129], [0, 0, 0, 0]]]
    assert_array_equal(rgbe(light), expected)
    for wrong in (np.inf, np.nan, 2.0**127):
        with pytest.raises(ParameterError, match="finite radiance"):
            rgbe(np.full((1, 1, 3), wrong))


def test_no_pixel_begins_a_run() -> None:
    # runs begin with 1 1 1 n, or with 2 2 and a byte below 128: no normalised pixel does
    light = 10.0 ** np.random.default_rng(5).uniform(-3, 3, (200, 50, 3))
    pixels = rgbe(light)
    assert pixels[..., :3].max(axis=-1).min() >= 128


def test_a_picture_says_how_it_was_made(tmp_path: Path) -> None:
    rgb = np.full((4, 5, 3), 0.5, np.float32)
    written = write_picture(tmp_path / "a.hdr", rgb, {"altitude": "2 m"})
    assert written.exposure is None
    assert read_picture_metadata(tmp_path / "a.hdr")["airlight.altitude"] == "2 m"
    assert_allclose(read(tmp_path / "a.hdr")[0], rgb)
    cut = (tmp_path / "a.hdr").read_bytes()[:-1]
    (tmp_path / "a.hdr").write_bytes(cut)
    with pytest.raises(FileError, match="before its last pixel"):
        read_picture_metadata(tmp_path / "a.hdr")
