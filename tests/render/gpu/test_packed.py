"""Packed textures: a shader reads the texels of eight bits that were written."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.device.flat import (
    MAX_ROWS,
    empty_flat_texture,
    packed_rows,
    packed_texture,
    read_flat,
)
from airlight.render.gpu.device.fragment_pass import FragmentPass
from airlight.render.gpu.emit.shader_types import FLAT_WIDTH, PACKED_WIDTH
from airlight.render.gpu.emit.texture_table import TextureTable
from airlight.render.gpu.emit.wgsl import WGSL

#: Texels of more rows than are handed over at a time, the last of them partly filled.
COUNT = 130 * PACKED_WIDTH + 77


def test_a_shader_reads_every_texel_as_fractions_of_255(device: Device) -> None:
    # The format's definition; devices convert to half a unit of single precision, some to two.
    values = np.arange(4 * COUNT) % 251 + np.arange(4 * COUNT) // 4 % 5
    texels = values.astype(np.uint8).reshape(COUNT, 4)
    texels[::PACKED_WIDTH, 0] = np.arange(131)  # no row is like another
    table = TextureTable("texels", "map", spectral=True, packed=True)
    source = f"""{WGSL.texture("map", 0, 0)}{table.reader(WGSL, "map")}
@fragment fn copied(@builtin(position) at: vec4f) -> @location(0) vec4f {{
  return read_texels(i32(at.y) * {FLAT_WIDTH} + i32(at.x));
}}
"""
    target = empty_flat_texture(device, COUNT, 4)
    FragmentPass(device, source, "copied", ["rgba32float"]).draw(
        {"map": packed_texture(device, texels.reshape(-1))}, [target]
    )
    assert_allclose(read_flat(device, target, COUNT), texels / 255.0, rtol=3e-7)


def test_no_height_is_a_power_of_two() -> None:
    heights = [packed_rows(count) for count in range(1, 40 * PACKED_WIDTH, PACKED_WIDTH // 3)]
    assert all(height & (height - 1) for height in heights)


def test_more_texels_than_a_texture_has_are_refused(device: Device) -> None:
    texels = np.zeros(4 * (PACKED_WIDTH * (MAX_ROWS - 1) + 1), np.uint8)
    with pytest.raises(ParameterError, match=r"allowed: at most 33554432 texels"):
        packed_texture(device, texels)
