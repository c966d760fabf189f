"""Large pictures are drawn and written band by band, and are the same."""

from __future__ import annotations

import mmap
import tracemalloc
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from PIL import Image

from airlight import solve
from airlight.engines.baking import exr, exr_bands, png
from airlight.image.display import to_display
from airlight.image.exposure import sampled
from airlight.kernel import large_arrays
from airlight.render import render
from airlight.render.picture import write_picture
from airlight.scene import Camera, Scene
from airlight.scene.frame import Frame
from airlight.scene.light_position import LightPosition

SIDE = 1024


@pytest.fixture
def large(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[], None]:
    """Make all pictures from here on large, with their arrays in the folder ``cache``."""

    def make() -> None:
        monkeypatch.setenv("AIRLIGHT_CACHE", str(tmp_path / "cache"))
        for module in (large_arrays, exr, png):
            monkeypatch.setattr(module, "LARGE", 1)
        monkeypatch.setattr(large_arrays, "_BAND", 1 << 19)

    return make


def sky(make: Callable[[tuple[int, ...], type], np.ndarray] = np.zeros) -> np.ndarray:
    """Light with a gradient and a bright point, and with what is not finite."""
    rgb = make((SIDE, SIDE, 3), np.float32)
    rgb[:] = np.linspace(1.0, 30.0, SIDE, dtype=np.float32)[:, None, None]
    rgb *= np.linspace(0.2, 1.0, SIDE, dtype=np.float32)[:, None]
    rgb[300, 500] = 4e6
    rgb[10, 10] = np.nan
    return rgb


@pytest.mark.parametrize("precision", exr.PRECISIONS)
@pytest.mark.parametrize("compression", exr.COMPRESSIONS)
@pytest.mark.parametrize("height", [1, 256, 300, 777])
def test_bands_make_the_same_openexr(
    tmp_path: Path, large: Callable[[], None], precision: str, compression: str, height: int
) -> None:
    light = np.random.default_rng(1).random((height, 61, 3), np.float32)
    layers = {"Q": 2.0 * light, "dolp": np.ascontiguousarray(light[..., 0])}
    options = {"precision": precision, "compression": compression, "layers": layers}
    texts = {"dataWindow": "a text", "a" * 40: "a long name"}
    exr.write_exr(tmp_path / "whole.exr", light, texts, **options)
    large()
    exr.write_exr(tmp_path / "bands.exr", light, texts, **options)
    assert (tmp_path / "whole.exr").read_bytes() == (tmp_path / "bands.exr").read_bytes()


def test_display_and_png_are_the_same(tmp_path: Path, large: Callable[[], None]) -> None:
    texts = {"planet": "earth"}
    light = sky()
    write_picture(tmp_path / "whole.png", light, texts, pixel_angle=1e-3)
    deep = to_display(light, pixel_angle=1e-3, bits=16)
    large()
    written = sky(large_arrays.zeros)
    write_picture(tmp_path / "bands.png", written, texts, pixel_angle=1e-3)
    with Image.open(tmp_path / "whole.png") as one, Image.open(tmp_path / "bands.png") as other:
        assert_array_equal(np.asarray(one), np.asarray(other))
        assert one.info == other.info
    assert_array_equal(to_display(written, pixel_angle=1e-3, bits=16), deep)


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="reads what Linux says")
def test_sampling_a_picture_does_not_bring_it_into_memory(large: Callable[[], None]) -> None:
    def resident() -> int:
        return int(Path("/proc/self/status").read_text().split("RssFile:")[1].split()[0]) * 1024

    large()
    light = sky(large_arrays.zeros)
    light.base.madvise(mmap.MADV_DONTNEED)
    before = resident()
    few = sampled(light, 9)
    assert resident() - before < light.nbytes // 2
    assert_array_equal(few, light[::9, ::9])


@pytest.mark.parametrize("name", ["dome.exr", "dome.png"])
@pytest.mark.parametrize("bits", [8, 16])
def test_writing_takes_less_memory_than_the_light(
    tmp_path: Path, large: Callable[[], None], name: str, bits: int
) -> None:
    small = np.ones((32, 32, 3), np.float32)
    write_picture(tmp_path / name, small, exposure=-4.0, bits=bits, pixel_angle=1e-3)  # loads code
    large()
    light = sky(large_arrays.zeros)
    tracemalloc.start()
    try:
        write_picture(tmp_path / name, light, exposure=-4.0, bits=bits, pixel_angle=1e-3)
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < 0.8 * light.nbytes


def test_a_large_frame_of_two_lights_is_the_same(large: Callable[[], None]) -> None:
    solution = solve("earth-openspace", [680, 550, 440], "preview")
    scene = Scene(
        altitude=2.0,
        sun_zenith=70.0,
        camera=Camera(projection="fisheye", width=96, height=96),
        secondary_lights=(LightPosition(zenith=40.0, azimuth=90.0),),
    )
    whole = render(solution, scene, stokes=True)
    large()
    filed = render(solution, scene, stokes=True)
    assert_array_equal(whole.rgb, filed.rgb)
    assert_array_equal(whole.polarised, filed.polarised)
    assert isinstance(filed, Frame)


@pytest.mark.parametrize("name", ["dome.exr", "dome.png"])
def test_nothing_is_left_of_a_picture_that_was_interrupted(
    tmp_path: Path, large: Callable[[], None], name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    large()
    light = sky(large_arrays.zeros)
    if name.endswith(".exr"):
        monkeypatch.setattr(exr_bands, "_parsed", _interrupted)
    else:
        monkeypatch.setattr(png, "_filtered_lines", _interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_picture(tmp_path / name, light, exposure=-4.0)
    assert [path.name for path in tmp_path.iterdir()] == ["cache"]


def _interrupted(*_: object) -> None:
    raise KeyboardInterrupt
