"""Thumbnails of the presets, packaged as WebP."""

from __future__ import annotations

import base64
import io
from functools import cache
from importlib import resources

import numpy as np
from numpy.typing import NDArray


def thumbnail_file(name: str) -> bytes | None:
    """WebP file of a preset's thumbnail; None without one."""
    if not name.replace("-", "").isalnum():  # the path of a planet file
        return None
    file = resources.files("airlight.viewer.gallery") / "thumbnails" / f"{name}.webp"
    return file.read_bytes() if file.is_file() else None


def thumbnail_address(name: str) -> str:
    """Thumbnail as a ``data:`` URI; empty without one.

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
    """Thumbnail pixels, encoded sRGB, shape (height, width, 3); None without one."""
    from PIL import Image

    content = thumbnail_file(name)
    if content is None:
        return None
    with Image.open(io.BytesIO(content)) as picture:
        return np.asarray(picture.convert("RGB"))
