"""Thumbnails of the presets as textures."""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from airlight.viewer.gallery.thumbnails import thumbnail
from airlight.viewer.painting.picture_texture import PictureTexture

#: Factor of the pixels per side by which a small picture is enlarged smoothly to fill the window.
ENLARGED: Final = 4


class Thumbnails:
    """Thumbnail textures, created on first use.

    Parameters
    ----------
    device : wgpu.GPUDevice
        Device that draws the window.
    backend : ImguiWgpuBackend
        Back end that registers textures.
    """

    def __init__(self, device: Any, backend: Any) -> None:
        self._device, self._backend = device, backend
        self._known: dict[tuple[str, int], tuple[Any, Any] | None] = {}

    def of(self, name: str, enlarged: int = 1) -> Any:
        """ImGui's reference to the texture of a preset; None for a planet without a picture.

        Parameters
        ----------
        enlarged : int
            Factor of the pixels per side.
        """
        key = (name, enlarged)
        if key not in self._known:
            self._known[key] = self._made(name, enlarged)
        known = self._known[key]
        return None if known is None else known[1]

    def _made(self, name: str, enlarged: int) -> tuple[Any, Any] | None:
        from PIL import Image

        pixels = thumbnail(name)
        if pixels is None:
            return None
        if enlarged > 1:
            picture = Image.fromarray(pixels)
            size = (enlarged * picture.width, enlarged * picture.height)
            pixels = np.asarray(picture.resize(size, Image.Resampling.BICUBIC))
        texture = PictureTexture(self._device)
        texture.write(pixels)
        return texture, self._backend.register_texture(texture.view)
