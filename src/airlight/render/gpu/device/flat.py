"""Flat textures: 1-D arrays in rows, read by ``textureLoad``; floats, or packed sRGB texels."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import ParameterError
from airlight.image.texels import CHANNELS
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.emit.shader_types import FLAT_WIDTH, PACKED_WIDTH

Float32Array = NDArray[np.float32]

#: Number of rows that every browser allows.
MAX_ROWS: Final = 8192
#: Format of a flat texture by number of channels.
FORMATS: Final = {1: "r32float", 4: "rgba32float"}
#: Format of ``airlight.image.texels``. That by which a device decodes sRGB itself is off by up to
#: 2.5 % in Mesa's software renderer.
PACKED_FORMAT: Final = "rgba8unorm"
#: Rows that are handed over at a time: the device holds a copy of what it has not yet taken, and
#: keeps that memory, as large as the whole texture if it were handed over at once.
_BAND: Final = 64
#: Type and number of channels of the formats that can be read back.
_READABLE: Final = {
    "r32float": (np.float32, 1),
    "rg32float": (np.float32, 2),
    "rgba32float": (np.float32, 4),
    "r16float": (np.float16, 1),
    "rgba16float": (np.float16, 4),
    "r8unorm": (np.uint8, 1),
    "rgba8unorm": (np.uint8, 4),
    "rgba8unorm-srgb": (np.uint8, 4),
    "bgra8unorm": (np.uint8, 4),
    "bgra8unorm-srgb": (np.uint8, 4),
}


def flat_rows(count: int) -> int:
    """Number of rows of a flat texture that holds ``count`` texels; at least one."""
    return max(1, -(-count // FLAT_WIDTH))


def flat_texture(device: Device, array: ArrayLike, label: str = "") -> Any:
    """Flat texture from an array, zero-padded to full rows.

    It can be read by a shader, rendered to, updated by ``update_flat`` and read back.

    Parameters
    ----------
    array : array, shape (n,) or (n, 4)
        Values, stored as float32: one channel, or four.

    Returns
    -------
    wgpu.GPUTexture
        ``r32float`` or ``rgba32float``, ``FLAT_WIDTH`` wide.

    Raises
    ------
    ParameterError
        If the shape differs, or the array exceeds the capacity of a texture (16.8 million texels).
    """
    values = _texels(array)
    texture = empty_flat_texture(device, values.shape[0], values.shape[1], label)
    update_flat(device, texture, 0, values)
    return texture


def empty_flat_texture(device: Device, count: int, channels: int, label: str = "") -> Any:
    """Flat texture of zeros for ``count`` texels of one or four channels.

    Parameters
    ----------
    count, channels : int
        Number of texels, and of channels.

    Returns
    -------
    wgpu.GPUTexture
        ``r32float`` or ``rgba32float``.

    Raises
    ------
    ParameterError
        If the texels exceed the capacity of a texture, or the channels are not 1 or 4.
    """
    import wgpu

    if channels not in FORMATS:
        raise ParameterError("channels", channels, "1 or 4")
    if not 0 <= count <= FLAT_WIDTH * MAX_ROWS:
        raise ParameterError("count", count, f"at most {FLAT_WIDTH * MAX_ROWS} texels")
    use = wgpu.TextureUsage
    return device.device.create_texture(
        label=label,
        size=(FLAT_WIDTH, flat_rows(count), 1),
        format=FORMATS[channels],
        usage=use.TEXTURE_BINDING | use.COPY_DST | use.COPY_SRC | use.RENDER_ATTACHMENT,
    )


def update_flat(device: Device, texture: Any, start: int, array: ArrayLike) -> None:
    """Overwrite texels of a flat texture from index ``start`` on.

    Parameters
    ----------
    start : int
        Index of the first texel; need not begin a row.
    array : array, shape (n,) or (n, 4)
        Values, with as many channels as the texture has.
    """
    values = _texels(array)
    width, height = texture.size[:2]
    if FORMATS[values.shape[1]] != texture.format:
        raise ParameterError("array.shape", values.shape, f"texels of format {texture.format}")
    if not 0 <= start <= width * height - values.shape[0]:
        raise ParameterError(
            "start",
            start,
            f"0 to {width * height - values.shape[0]}: {values.shape[0]} texels "
            f"into {width * height}",
        )
    done, end = start, start + values.shape[0]
    while done < end:  # the rest of a partly filled row, whole rows, the beginning of the last row
        row, column = divmod(done, width)
        whole = (end - done) // width if column == 0 else 0
        take = whole * width if whole else min(width - column, end - done)
        block = values[done - start : done - start + take]
        shape = (width, whole, 1) if whole else (take, 1, 1)
        device.device.queue.write_texture(
            {"texture": texture, "origin": (column, row, 0)},
            block,
            {"bytes_per_row": shape[0] * 4 * values.shape[1], "rows_per_image": shape[1]},
            shape,
        )
        done += take


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


def packed_texture(
    device: Device, texels: NDArray[np.uint8] | NDArray[np.float16], label: str = ""
) -> Any:
    """Packed texture from an array, zero-padded to full rows.

    Parameters
    ----------
    device : Device
        Device from ``open_device``.
    texels : array of uint8 or float16, 4·n numbers
        Texels of ``airlight.image.texels``, or numbers of 16 bits, one after another.
    label : str
        Label in messages of the device.

    Returns
    -------
    wgpu.GPUTexture
        ``rgba8unorm`` or ``rgba16float``, ``PACKED_WIDTH`` wide.

    Raises
    ------
    ParameterError
        If they exceed the capacity of a texture (33.5 million texels).
    """
    import wgpu

    texels, count = texels.ravel(), texels.size // CHANNELS
    rows = packed_rows(count)
    if rows > MAX_ROWS:
        raise ParameterError("count", count, f"at most {PACKED_WIDTH * MAX_ROWS} texels")
    use = wgpu.TextureUsage
    texture = device.device.create_texture(
        label=label,
        size=(PACKED_WIDTH, rows, 1),
        format="rgba16float" if texels.dtype == np.float16 else PACKED_FORMAT,
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
            {"bytes_per_row": texels.itemsize * CHANNELS * width, "rows_per_image": height},
            (width, height, 1),
        )
        device.device.queue.submit([])
    return texture


def read_texture(device: Device, texture: Any) -> Float32Array:
    """Read back a two-dimensional texture.

    Parameters
    ----------
    texture : wgpu.GPUTexture
        Texture made with ``COPY_SRC``; floats of 16 or 32 bits, or 8-bit values.

    Returns
    -------
    array, shape (height, width, channels)
        Values; 8-bit values are divided by 255 and stay encoded; red always comes first.
    """
    if texture.format not in _READABLE:
        raise ParameterError("texture.format", texture.format, ", ".join(_READABLE))
    kind, channels = _READABLE[texture.format]
    width, height = texture.size[:2]
    row_bytes = width * channels * np.dtype(kind).itemsize
    # The queue pads rows to the 256 bytes that a copy needs and removes the padding again.
    read = device.device.queue.read_texture(
        {"texture": texture},
        {"bytes_per_row": row_bytes, "rows_per_image": height},
        (width, height, 1),
    )
    values = np.frombuffer(read, kind).reshape(height, width, channels)
    if kind is np.uint8:
        values = (values / np.float32(255.0)).astype(np.float32)
        if texture.format.startswith("bgra"):
            values = values[..., [2, 1, 0, 3]]
    return np.ascontiguousarray(values, np.float32)


def read_flat(device: Device, texture: Any, count: int) -> Float32Array:
    """Read back the first ``count`` texels of a flat texture, shape (count,) or (count, 4)."""
    values = read_texture(device, texture)
    texels = values.reshape(-1, values.shape[2])[:count]
    return texels[:, 0] if texels.shape[1] == 1 else texels


def _texels(array: ArrayLike) -> Float32Array:
    values = np.ascontiguousarray(array, np.float32)
    if values.ndim == 1:
        values = values[:, None]
    if values.ndim != 2 or values.shape[1] not in FORMATS:
        raise ParameterError("array.shape", np.shape(array), "(n,) or (n, 4)")
    return values
