"""Small pictures of the presets, packaged as WebP."""

from __future__ import annotations

import base64
import io
from functools import cache
from importlib import resources

import numpy as np
from numpy.typing import NDArray


def thumbnail_file(name: str) -> bytes | None:
    """File of a preset's small picture, WebP; None for a planet without one.

    Parameters
    ----------
    name : str
        Name of a preset.
    """
    if not name.replace("-", "").isalnum():  # the path of a planet file
        return None
    file = resources.files("airlight.viewer.gallery") / "thumbnails" / f"{name}.webp"
    return file.read_bytes() if file.is_file() else None


def thumbnail_address(name: str) -> str:
    """Small picture of a preset as a ``data:`` URI; empty for a planet without one.

    Parameters
    ----------
    name : str
        Name of a preset.
    """
    content = thumbnail_file(name)
    if content is None:
        return ""
    return "data:image/webp;base64," + base64.b64encode(content).decode()


@cache
def thumbnail(name: str) -> NDArray[np.uint8] | None:
    """Pixels of a preset's small picture, encoded sRGB, shape (height, width, 3), or None.

    Parameters
    ----------
    name : str
        Name of a preset.
    """
    from PIL import Image

    content = thumbnail_file(name)
    if content is None:
        return None
    with Image.open(io.BytesIO(content)) as picture:
        return np.asarray(picture.convert("RGB"))
