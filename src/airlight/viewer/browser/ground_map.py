"""Ground map for a browser: image files, which the browser decodes."""

from __future__ import annotations

import base64
import io
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.image.texels import DECODED
from airlight.scene.map_levels import reduced
from airlight.scene.surface_map import SurfaceMap

#: Widest map that is embedded; a wider one is reduced to this width. [pixel]
_WIDEST: Final = 2048
_QUALITY: Final = 90


def ground_map(found: SurfaceMap | None, *, lossless: bool = False) -> dict[str, Any] | None:
    """Ground map, or overlay, for ``web/drawing/ground.js``.

    Parameters
    ----------
    lossless : bool
        Whether compression is lossless, as for city lights, whose JPEG artefacts would brighten a
        dark sea.

    Returns
    -------
    dict or None
        ``image``, a data URL; ``water``, a data URL of the water fraction, or None; ``rows`` and
        ``columns``; ``decoded``, linear values of the 256 encoded values [1]. None without a
        map.
    """
    if found is None:
        return None
    texels = found.levels[0]
    if texels.shape[1] > _WIDEST:
        texels = reduced(texels, _WIDEST // 2, _WIDEST)
    rows, columns = texels.shape[:2]
    return {
        "image": _colors(texels[..., :3], lossless),
        "water": _water(texels[..., 3]),
        "rows": rows,
        "columns": columns,
        "decoded": [float(x) for x in DECODED[0]],
    }


def _colors(pixels: NDArray[np.uint8], lossless: bool) -> str:
    """Data URL of a JPEG, or of a PNG if lossless."""
    from PIL import Image

    room = io.BytesIO()
    grey = np.ptp(pixels, axis=2).max() == 0
    image = Image.fromarray(np.ascontiguousarray(pixels[..., 0] if grey else pixels))
    if lossless:
        image.save(room, "PNG", optimize=True)
        return _as_address("png", room.getvalue())
    # No chroma subsampling: coasts would lose the colour of the water.
    image.save(room, "JPEG", quality=_QUALITY, subsampling=0, optimize=True)
    return _as_address("jpeg", room.getvalue())


def _water(shares: NDArray[np.uint8]) -> str | None:
    """Data URL of a lossless grey image of the water fraction; None without water."""
    from PIL import Image

    if not shares.any():
        return None
    room = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(shares)).save(room, "PNG", optimize=True)
    return _as_address("png", room.getvalue())


def _as_address(kind: str, content: bytes) -> str:
    return f"data:image/{kind};base64,{base64.b64encode(content).decode('ascii')}"
