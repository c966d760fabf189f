"""The map of the ground as a browser takes it: a picture file, which it decodes by itself."""

from __future__ import annotations

import base64
import io
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.color.encoding import srgb_decode, srgb_encode
from airlight.scene.surface_map import map_file, surface_map

#: Widest map that is carried; a wider one is halved until it fits. [pixel]
_WIDEST: Final = 2048
_QUALITY: Final = 90
#: Largest file that is carried as it is. [byte]
_LARGEST: Final = 1_000_000
_KINDS: Final = {".jpg": "jpeg", ".jpeg": "jpeg", ".png": "png"}


def ground_map(name: str | None) -> dict[str, Any] | None:
    """A map of the ground for ``web/drawing/ground.js``.

    Parameters
    ----------
    name : str or None
        As ``surface_map`` takes it.

    Returns
    -------
    dict or None
        ``image``, a data address; ``levels``, the first number, height and width of each;
        ``decoded``, the reflectance of each of 256 levels of a channel. None without a map.
    """
    if name is None:
        return None
    found = surface_map(name)
    first = next((i for i, one in enumerate(found.levels) if one.shape[1] <= _WIDEST), -1)
    levels = found.levels[first:]
    starts = np.cumsum([0, *(one.size for one in levels[:-1])])
    return {
        "image": _as_address(map_file(name) if first == 0 else None, levels[0]),
        "levels": [[int(start), *one.shape[:2]] for start, one in zip(starts, levels, strict=True)],
        "decoded": [float(x) for x in srgb_decode(np.arange(256) / 255.0)],
    }


def _as_address(file: Path | None, pixels: NDArray[np.float32]) -> str:
    """The picture itself if a browser reads it and it is not large, else one made of its pixels."""
    kind = None if file is None else _KINDS.get(file.suffix.lower())
    if file is not None and kind is not None and file.stat().st_size <= _LARGEST:
        content = file.read_bytes()
    else:
        from PIL import Image

        kind, room = "jpeg", io.BytesIO()
        encoded = np.round(255.0 * srgb_encode(pixels)).astype(np.uint8)
        Image.fromarray(encoded).save(room, "JPEG", quality=_QUALITY, subsampling=0)
        content = room.getvalue()
    return f"data:image/{kind};base64,{base64.b64encode(content).decode('ascii')}"
