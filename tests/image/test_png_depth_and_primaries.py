"""PNG of 16 bits and of wide primaries: the numbers, and what the file says of them."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
import png
import pytest
from numpy.testing import assert_array_equal
from PIL import Image

from airlight.engines.baking import write_picture
from airlight.errors import ParameterError
from airlight.image.display import to_display
from airlight.image.png import read_png_metadata, write_png

LIGHT = np.random.default_rng(1).uniform(-0.05, 1.0, (9, 16, 3)).astype(np.float32)


def chunks_of(path: Path) -> dict[bytes, bytes]:
    """Chunks in front of the pixels, read by another program."""
    found = {}
    for kind, data in png.Reader(bytes=path.read_bytes()).chunks():
        if kind == b"IDAT":
            break
        found[kind] = data
    return found


@pytest.mark.parametrize("bits", [8, 16])
def test_pixels_and_texts_come_back(tmp_path: Path, bits: int) -> None:
    path = tmp_path / "a.png"
    write_picture(path, LIGHT, {"altitude": "2 m", "place": "Ö"}, exposure=0.0, bits=bits)
    width, height, rows, info = png.Reader(bytes=path.read_bytes()).read()
    assert (width, height, info["bitdepth"], info["planes"]) == (16, 9, bits, 3)
    seen = np.array([list(row) for row in rows]).reshape(9, 16, 3)
    assert_array_equal(seen, to_display(LIGHT, 0.0, bits=bits))
    texts = read_png_metadata(path)
    assert texts["airlight.altitude"] == "2 m"
    assert texts["airlight.place"] == "Ö"
    assert texts["airlight.eye"] == "by day"


@pytest.mark.parametrize("bits", [8, 16])
def test_display_p3_is_said_in_cicp_and_for_older_readers(tmp_path: Path, bits: int) -> None:
    path = tmp_path / "a.png"
    write_picture(path, LIGHT, exposure=0.0, primaries="display-p3", bits=bits)
    chunks = chunks_of(path)
    assert chunks[b"cICP"] == bytes([12, 13, 0, 1])
    assert b"sRGB" not in chunks
    white_red_green_blue = struct.unpack(">8I", chunks[b"cHRM"])
    assert white_red_green_blue == (31270, 32900, 68000, 32000, 26500, 69000, 15000, 6000)
    with Image.open(path) as image:
        image.load()
    if bits == 8:
        with Image.open(path) as image:
            seen = np.asarray(image)
        assert_array_equal(seen, to_display(LIGHT, 0.0, primaries="display-p3"))


def test_srgb_needs_one_chunk(tmp_path: Path) -> None:
    write_picture(tmp_path / "a.png", LIGHT, exposure=0.0)
    assert [one for one in chunks_of(tmp_path / "a.png") if one in (b"sRGB", b"cICP", b"gAMA")] == [
        b"sRGB"
    ]
    write_picture(tmp_path / "b.png", LIGHT, exposure=0.0, encoding="gamma")
    assert chunks_of(tmp_path / "b.png")[b"gAMA"] == (45455).to_bytes(4, "big")


def test_other_pixels_are_refused(tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match=r"^pixels is .float"):
        write_png(tmp_path / "a.png", LIGHT)
    with pytest.raises(ParameterError, match=r"^primaries is"):
        write_png(tmp_path / "a.png", np.zeros((2, 2, 3), np.uint8), primaries="adobe")
    assert not list(tmp_path.iterdir())
