"""Ground map for a browser: an image file, which the browser decodes."""

from __future__ import annotations

import base64
import io
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.color.encoding import srgb_decode, srgb_encode
from airlight.scene.surface_map import map_file, surface_map

#: Widest map that is embedded; a wider one is halved until it fits. [pixel]
_WIDEST: Final = 2048
_QUALITY: Final = 90
#: Largest file that is embedded unchanged. [byte]
_LARGEST: Final = 1_000_000
_KINDS: Final = {".jpg": "jpeg", ".jpeg": "jpeg", ".png": "png"}


def ground_map(name: str | None) -> dict[str, Any] | None:
    """Ground map for ``web/drawing/ground.js``.

    Parameters
    ----------
    name : str or None
        Name of the map, as for ``surface_map``.

    Returns
    -------
    dict or None
        ``image``, a data URL; ``levels``, the offset, height and width of each; ``decoded``, the
        reflectance of the 256 values of a channel [1]. None without a map.
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
    """Data URL of the file if a browser can read it and it is small, else of its pixels."""
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
