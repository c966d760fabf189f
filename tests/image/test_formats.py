"""Files read back: pixels bit by bit, and the scene's texts."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import OpenEXR
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from PIL import Image

from airlight.errors import FileError, ParameterError
from airlight.image.exr import read_exr, write_exr
from airlight.image.png import read_png_metadata, write_png

METADATA = {"altitude": "400000 m", "planet": "Größe ☉", "look": "109.8,0 deg"}


def test_png_pixels_come_back_as_written(tmp_path: Path) -> None:
    pixels = np.random.default_rng(1).integers(0, 256, (13, 7, 3), dtype=np.uint8)
    write_png(tmp_path / "a.png", pixels)
    with Image.open(tmp_path / "a.png") as image:
        assert image.mode == "RGB"
        assert_array_equal(np.asarray(image), pixels)


def test_exr_pixels_come_back_bit_by_bit(tmp_path: Path) -> None:
    # every kind of float32: tiny, huge, subnormal, negative zero
    rgb = np.random.default_rng(2).normal(size=(11, 5, 3)).astype(np.float32)
    rgb[0, 0] = [1e-38, 3e38, -0.0]
    rgb[0, 1, 0] = np.float32(1e-44)
    write_exr(tmp_path / "a.exr", rgb)
    back, _ = read_exr(tmp_path / "a.exr")
    assert back.dtype == np.float32
    assert_array_equal(back.view(np.uint32), rgb.view(np.uint32))


def test_exr_channels_are_named_as_every_reader_expects(tmp_path: Path) -> None:
    # red, green, blue at distinct values: a swap of channels would show
    rgb = np.full((2, 2, 3), [1.0, 2.0, 3.0], dtype=np.float32)
    write_exr(tmp_path / "a.exr", rgb)
    with OpenEXR.File(str(tmp_path / "a.exr"), separate_channels=True) as image:
        values = {name: float(c.pixels[0, 0]) for name, c in image.channels().items()}
        header = dict(image.header())  # the binding empties it at the end
    assert values == {"R": 1.0, "G": 2.0, "B": 3.0}
    # one unit of luminance is 1 W m⁻² sr⁻¹ weighted by y-bar: 683 cd m⁻² by the lumen's definition
    assert_allclose(header["whiteLuminance"], 683.0)
    # ITU-R BT.709-6, items 1.3 and 1.4
    assert_allclose(
        header["chromaticities"], (0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.329), rtol=1e-7
    )


def test_the_scene_stands_in_both_formats(tmp_path: Path) -> None:
    write_png(tmp_path / "a.png", np.zeros((2, 2, 3), np.uint8), METADATA)
    write_exr(tmp_path / "a.exr", np.zeros((2, 2, 3), np.float32), METADATA)
    expected = {f"airlight.{name}": text for name, text in METADATA.items()}
    for texts in (read_png_metadata(tmp_path / "a.png"), read_exr(tmp_path / "a.exr")[1]):
        assert texts.pop("airlight.version")
        assert {k: v for k, v in texts.items() if k.startswith("airlight.")} == expected


@pytest.mark.parametrize(("encoding", "chunk"), [("srgb", b"sRGB"), ("gamma", b"gAMA")])
def test_png_tells_its_encoding(tmp_path: Path, encoding: str, chunk: bytes) -> None:
    write_png(tmp_path / "a.png", np.zeros((2, 2, 3), np.uint8), encoding=encoding)
    assert chunk in (tmp_path / "a.png").read_bytes()


@pytest.mark.parametrize(
    "pixels",
    [
        np.zeros((2, 2, 3), np.float32),
        np.zeros((2, 2, 4), np.uint8),
        np.zeros((2, 2), np.uint8),
    ],
)
def test_png_of_another_shape_is_refused(tmp_path: Path, pixels: np.ndarray) -> None:
    with pytest.raises(ParameterError, match="allowed: uint8"):
        write_png(tmp_path / "a.png", pixels)
    assert not list(tmp_path.iterdir())


def test_exr_in_double_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match="allowed: float32"):
        write_exr(tmp_path / "a.exr", np.zeros((2, 2, 3)))  # type: ignore[arg-type]
    assert not list(tmp_path.iterdir())


def test_a_file_that_is_no_exr_is_one_clear_line(tmp_path: Path) -> None:
    (tmp_path / "a.exr").write_bytes(b"not a picture")
    with pytest.raises(FileError, match=r"a\.exr: cannot be read as OpenEXR") as refusal:
        read_exr(tmp_path / "a.exr")
    assert "\n" not in str(refusal.value)


def test_exr_layers_are_channels_of_their_names(tmp_path: Path) -> None:
    random = np.random.default_rng(4)
    rgb, light = random.normal(size=(2, 5, 4, 3)).astype(np.float32)
    number = random.normal(size=(5, 4)).astype(np.float32)
    write_exr(tmp_path / "a.exr", rgb, layers={"Q": light, "dolp": number})
    with OpenEXR.File(str(tmp_path / "a.exr"), separate_channels=True) as image:
        found = {name: np.array(one.pixels) for name, one in image.channels().items()}
    assert sorted(found) == sorted(["R", "G", "B", "Q.R", "Q.G", "Q.B", "dolp"])
    for k, letter in enumerate("RGB"):
        assert_array_equal(found[f"Q.{letter}"], light[..., k])
    assert_array_equal(found["dolp"], number)
    assert_array_equal(read_exr(tmp_path / "a.exr")[0], rgb)  # readers of colours find them
    with pytest.raises(ParameterError, match=r"layers\[Q\] is 'float32 \(2, 2\)'; allowed"):
        write_exr(tmp_path / "b.exr", rgb, layers={"Q": number[:2, :2]})
