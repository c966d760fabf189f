"""Flat textures return their contents, also across the ends of rows."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from airlight.errors import ParameterError
from airlight.render.gpu.device.flat import (
    empty_flat_texture,
    flat_texture,
    read_flat,
    read_texture,
    update_flat,
)
from airlight.render.gpu.device.fragment_pass import FragmentPass
from airlight.render.gpu.emit.shader_types import FLAT_WIDTH


def numbers(count, channels):
    shape = (count,) if channels == 1 else (count, channels)
    return np.random.default_rng(count).normal(size=shape).astype(np.float32)


@pytest.mark.parametrize("channels", [1, 4])
@pytest.mark.parametrize("count", [1, 2047, 2048, 2049, 5000])
def test_a_flat_texture_gives_back_what_was_put_in(device, count, channels):
    # A copy: float32 both ways, bit for bit; the rest of the last row is 0.
    values = numbers(count, channels)
    texture = flat_texture(device, values)
    assert_array_equal(read_flat(device, texture, count), values)
    whole = read_texture(device, texture).reshape(-1, channels)
    assert whole.shape[0] % FLAT_WIDTH == 0
    assert_array_equal(whole[count:], np.zeros_like(whole[count:]))


@pytest.mark.parametrize("channels", [1, 4])
@pytest.mark.parametrize(
    ("start", "count"), [(0, 1), (5, 2043), (5, 4200), (2000, 4200), (2048, 2048), (9000, 1000)]
)
def test_an_update_changes_its_texels_and_no_other(device, start, count, channels):
    # The same assignment to a NumPy array.
    values = numbers(10000, channels)
    texture = flat_texture(device, values)
    update_flat(device, texture, start, numbers(count, channels))
    values[start : start + count] = numbers(count, channels)
    assert_array_equal(read_flat(device, texture, 10000), values)


def test_texel_i_stands_where_shaders_look_for_it(device):
    # (i & 2047, i >> 11), by the contract of all shaders.
    texture = flat_texture(device, np.arange(6000.0))
    i = np.array([0, 2047, 2048, 4095, 5999])
    assert_array_equal(read_texture(device, texture)[i >> 11, i & 2047, 0], i)


def test_what_does_not_fit_is_refused(device):
    texture = flat_texture(device, np.zeros(3000))
    with pytest.raises(ParameterError, match=r"^start is 4096"):
        update_flat(device, texture, 4096, [1.0])
    with pytest.raises(ParameterError, match=r"^start is -1"):
        update_flat(device, texture, -1, [1.0])
    with pytest.raises(ParameterError, match=r"^array\.shape is \(5, 4\)"):
        update_flat(device, texture, 0, np.zeros((5, 4)))
    with pytest.raises(ParameterError, match=r"^array\.shape is \(5, 3\)"):
        flat_texture(device, np.zeros((5, 3)))
    with pytest.raises(ParameterError, match=r"^count is"):
        empty_flat_texture(device, FLAT_WIDTH * 8192 + 1, 1)


@pytest.mark.parametrize(
    ("format", "tolerance"),
    [
        ("rgba32float", 0.0),
        ("rgba16float", 2.0**-11),  # half the last bit of a float16 below 1
        ("rgba8unorm", 0.5 / 255.0),
        ("bgra8unorm", 0.5 / 255.0),
    ],
)
@pytest.mark.parametrize("width", [1, 7, 64, 73])
def test_pictures_of_any_width_and_format_are_read_back(device, format, tolerance, width):
    # A shader that writes its texel's number: a copy needs rows of 256 bytes, these have others.
    import wgpu

    source = """
    @fragment fn texel(@builtin(position) at: vec4f) -> @location(0) vec4f {
      let p = floor(at.xy);
      return vec4f(p / 128.0, 0.25, 1.0);
    }"""
    texture = device.device.create_texture(
        size=(width, 5, 1),
        format=format,
        usage=wgpu.TextureUsage.RENDER_ATTACHMENT | wgpu.TextureUsage.COPY_SRC,
    )
    FragmentPass(device, source, "texel", [format]).draw({}, [texture])
    rows, columns = np.indices((5, width))
    expected = np.stack(
        [columns / 128.0, rows / 128.0, np.full_like(rows, 0.25, float), np.ones(rows.shape)], -1
    )
    read = read_texture(device, texture)
    assert read.dtype == np.float32
    np.testing.assert_allclose(read, expected, rtol=0.0, atol=tolerance + 1e-7)
