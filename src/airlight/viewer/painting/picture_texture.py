"""A texture that shows 8-bit pictures of changing size."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray


class PictureTexture:
    """Eight-bit pixels on the graphics device; a new texture only when the size changes.

    Parameters
    ----------
    device : wgpu.GPUDevice
    """

    #: Encoded sRGB: what is written is what is shown.
    form: Final = "rgba8unorm"

    def __init__(self, device: Any) -> None:
        self._device = device
        self._size = (0, 0)
        self._texture: Any = None
        self.view: Any = None

    def resize(self, width: int, height: int) -> Any:
        """The texture, of this size in pixels; what it showed is lost if the size is new."""
        import wgpu

        if (width, height) != self._size:
            usage = wgpu.TextureUsage
            self._texture = self._device.create_texture(
                label="picture",
                size=(width, height, 1),
                format=self.form,
                usage=usage.COPY_DST
                | usage.COPY_SRC
                | usage.TEXTURE_BINDING
                | usage.RENDER_ATTACHMENT,
            )
            self.view = self._texture.create_view()
            self._size = (width, height)
        return self._texture

    def write(self, pixels: NDArray[np.uint8]) -> None:
        """Show pixels, shape (height, width, 3)."""
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
        """Return when all that was submitted for it has been done."""
        self._device.queue.read_texture(
            {"texture": self._texture, "mip_level": 0, "origin": (0, 0, 0)},
            {"offset": 0, "bytes_per_row": 4, "rows_per_image": 1},
            (1, 1, 1),
        )


class Canvases:
    """Two textures in turn: while one is shown, the other is painted.

    Parameters
    ----------
    device : wgpu.GPUDevice
    """

    def __init__(self, device: Any) -> None:
        self._both = [PictureTexture(device), PictureTexture(device)]

    def next(self) -> PictureTexture:
        """The one that was not given last."""
        self._both.reverse()
        return self._both[0]
