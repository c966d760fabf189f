"""Texture for 8-bit pictures of changing size."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from airlight.render.live_frame import LIVE_FORMAT


class PictureTexture:
    """8-bit picture on the GPU; its texture is replaced only when the size changes.

    Parameters
    ----------
    device : wgpu.GPUDevice
        Device that owns the texture.
    """

    def __init__(self, device: Any) -> None:
        self._device = device
        self._size = (0, 0)
        self._texture: Any = None
        self.view: Any = None

    def resize(self, width: int, height: int) -> Any:
        """Return the texture at this size [pixel]; its contents are lost if the size changes."""
        import wgpu

        if (width, height) != self._size:
            usage = wgpu.TextureUsage
            self._texture = self._device.create_texture(
                label="picture",
                size=(width, height, 1),
                format=LIVE_FORMAT,
                usage=usage.COPY_DST
                | usage.COPY_SRC
                | usage.TEXTURE_BINDING
                | usage.RENDER_ATTACHMENT,
            )
            self.view = self._texture.create_view()
            self._size = (width, height)
        return self._texture

    def write(self, pixels: NDArray[np.uint8]) -> None:
        """Upload pixels of encoded sRGB, shape (height, width, 3)."""
        height, width = pixels.shape[:2]
        texture = self.resize(width, height)
        padded = np.full((height, width, 4), 255, np.uint8)
        padded[..., :3] = pixels
        self._device.queue.write_texture(
            {"texture": texture, "mip_level": 0, "origin": (0, 0, 0)},
            padded,
            {"offset": 0, "bytes_per_row": 4 * width, "rows_per_image": height},
            (width, height, 1),
        )

    def wait(self) -> None:
        """Block until all work submitted for the texture is complete."""
        self._device.queue.read_texture(
            {"texture": self._texture, "mip_level": 0, "origin": (0, 0, 0)},
            {"offset": 0, "bytes_per_row": 4, "rows_per_image": 1},
            (1, 1, 1),
        )


class Canvases:
    """Pair of textures used in turn: one is shown while the other is rendered to.

    Parameters
    ----------
    device : wgpu.GPUDevice
        Device that owns the textures.
    """

    def __init__(self, device: Any) -> None:
        self._both = [PictureTexture(device), PictureTexture(device)]

    def next(self) -> PictureTexture:
        """Return the texture that was not returned last."""
        self._both.reverse()
        return self._both[0]
