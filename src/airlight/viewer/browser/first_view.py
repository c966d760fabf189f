"""Image of a page's first view, displayed until the browser has rendered it."""

from __future__ import annotations

import base64
import io
from collections.abc import Mapping
from typing import Any, Final

from airlight.image.display import to_display
from airlight.kernel.threads import Cancel, Progress
from airlight.render import render
from airlight.viewer.parameters.parameter import Value
from airlight.viewer.parameters.view_parameters import scene_of, uniforms_of

#: Size of the picture, of which a browser shows the part within its window: a square contains the
#: view of a landscape window of any shape. [pixel]
SIDE: Final = 840
#: Largest size of the file. [byte]
LARGEST: Final = 60_000


def first_view(
    solution: Any,
    values: Mapping[str, Value],
    *,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> dict[str, str]:
    """Embedded image of a view.

    Parameters
    ----------
    solution : MomentsSolution
        Solution embedded in the page.

    Returns
    -------
    dict
        ``address``: WebP as a ``data:`` URI; ``fit``: how it fills the window, in CSS: ``cover`` in
        perspective, ``contain`` for projections with a fixed aspect ratio.
    """
    scene = scene_of(values, SIDE, SIDE)
    frame = render(
        solution, scene, orders=str(values["light.orders"]), progress=progress, cancel=cancel
    )
    exposure = float(values["display.exposure"])
    if values["display.automatic"]:
        exposure += frame.exposure
    pixels = to_display(
        frame.rgb, exposure, str(values["display.tone_map"]), eye=bool(uniforms_of(values)["eye"]),
        glare=float(values["display.glare"]), **frame.lens,
    )  # fmt: skip
    perspective = values["view.projection"] == "perspective"
    return {
        "address": "data:image/webp;base64," + base64.b64encode(_webp(pixels)).decode(),
        "fit": "cover" if perspective else "contain",
    }


def _webp(pixels: Any) -> bytes:
    """WebP in the best quality within the size limit."""
    from PIL import Image

    picture, content = Image.fromarray(pixels), b""
    for quality in (96, 90, 80, 60, 30, 10):
        file = io.BytesIO()
        picture.save(file, "WEBP", quality=quality, method=4)
        content = file.getvalue()
        if 4 * len(content) // 3 <= LARGEST:
            break
    return content
