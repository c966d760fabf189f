"""Packed textures: 8-bit sRGB texels, decoded in the shader."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.image.texels import CHANNELS
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.device.flat import MAX_ROWS
from airlight.render.gpu.emit.shader_types import PACKED_WIDTH

#: Format of ``airlight.image.texels``. That by which a device decodes sRGB itself is off by up to
#: 2.5 % in Mesa's software renderer.
PACKED_FORMAT: Final = "rgba8unorm"
#: Rows uploaded together: the device holds a copy of pending data and keeps that memory, as large
#: as the whole texture if it were uploaded together.
_BAND: Final = 64


def packed_rows(count: int) -> int:
    """Number of rows of a packed texture of ``count`` texels, never a power of two.

    Software GPUs recompile a shader, which takes them seconds to minutes, when a texture's
    height becomes a power of two or ceases to be one.

    Examples
    --------
    >>> packed_rows(1), packed_rows(4096 * 4), packed_rows(4096 * 4 + 1)
    (3, 5, 5)
    """
    rows = max(3, -(-count // PACKED_WIDTH))
    return rows if rows & (rows - 1) else rows + 1


def packed_texture(device: Device, texels: NDArray[np.uint8], label: str = "") -> Any:
    """Packed texture from an array, zero-padded to full rows.

    Parameters
    ----------
    texels : array of uint8, shape (4·n,)
        Texels of ``airlight.image.texels``, one after another.

    Returns
    -------
    wgpu.GPUTexture
        ``rgba8unorm``, ``PACKED_WIDTH`` wide.

    Raises
    ------
    ParameterError
        If they exceed the capacity of a texture (33.5 million texels).
    """
    import wgpu

    count = texels.size // CHANNELS
    rows = packed_rows(count)
    if rows > MAX_ROWS:
        raise ParameterError("count", count, f"at most {PACKED_WIDTH * MAX_ROWS} texels")
    use = wgpu.TextureUsage
    texture = device.device.create_texture(
        label=label,
        size=(PACKED_WIDTH, rows, 1),
        format=PACKED_FORMAT,
        usage=use.TEXTURE_BINDING | use.COPY_DST,
    )
    whole = count // PACKED_WIDTH
    bands = [(first, min(_BAND, whole - first), PACKED_WIDTH) for first in range(0, whole, _BAND)]
    for first, height, width in [*bands, (whole, 1, count - whole * PACKED_WIDTH)]:
        if height * width == 0:
            continue
        start = CHANNELS * first * PACKED_WIDTH
        device.device.queue.write_texture(
            {"texture": texture, "origin": (0, first, 0)},
            np.ascontiguousarray(texels[start : start + CHANNELS * height * width]),
            {"bytes_per_row": CHANNELS * width, "rows_per_image": height},
            (width, height, 1),
        )
        device.device.queue.submit([])
    return texture
