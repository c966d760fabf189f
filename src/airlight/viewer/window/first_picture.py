"""Splash of the window: the preset's thumbnail and the progress."""

from __future__ import annotations

from typing import Any, Final

from airlight.viewer.gallery.presets import HEIGHT, WIDTH
from airlight.viewer.window import style
from airlight.viewer.window.picture_area import Rectangle

#: Factor of the thumbnail's colours, which marks it as preliminary. [1]
_DIMMED: Final = 0.6
#: Width of the progress bar, and its distance from the bottom. [logical pixel]
_BAR: Final = 360.0
_LIFT: Final = 72.0


def draw_first_picture(texture: Any, into: Rectangle, text: str, share: float) -> None:
    """Draw a thumbnail that covers a rectangle, and the progress.

    Parameters
    ----------
    texture : imgui.ImTextureRef or None
        Texture of the thumbnail; None without a thumbnail.
    text : str
        Current task.
    share : float
        Completed fraction. [1]
    """
    from imgui_bundle import imgui

    drawing = imgui.get_background_draw_list()
    low = imgui.ImVec2(into.left, into.top)
    high = imgui.ImVec2(into.left + into.width, into.top + into.height)
    if texture is not None:
        across, down = _covering(into.width / max(into.height, 1.0))
        dim = imgui.get_color_u32(imgui.ImVec4(_DIMMED, _DIMMED, _DIMMED, 1.0))
        first, last = (imgui.ImVec2(0.5 + s * across, 0.5 + s * down) for s in (-1.0, 1.0))
        drawing.add_image(texture, low, high, first, last, dim)
    words = f"preview — preparing the picture\n{text}"
    size = imgui.calc_text_size(words)
    width = min(max(_BAR, size.x), into.width - 40.0)
    left = into.left + 0.5 * (into.width - width)
    top = into.top + into.height - _LIFT - size.y
    shade = imgui.get_color_u32(imgui.ImVec4(0.0, 0.0, 0.0, 0.6))
    white = imgui.get_color_u32(imgui.ImVec4(1.0, 1.0, 1.0, 0.9))
    accent = imgui.get_color_u32(imgui.ImVec4(*style.ACCENT))
    drawing.add_rect_filled(
        imgui.ImVec2(left - 16.0, top - 12.0),
        imgui.ImVec2(left + width + 16.0, top + size.y + 28.0),
        shade,
        6.0,
    )
    drawing.add_text(imgui.ImVec2(left, top), white, words)
    line = top + size.y + 12.0
    for fraction, color in ((1.0, shade), (min(max(share, 0.0), 1.0), accent)):
        drawing.add_rect_filled(
            imgui.ImVec2(left, line), imgui.ImVec2(left + fraction * width, line + 4.0), color, 2.0
        )


def _covering(ratio: float) -> tuple[float, float]:
    """Half the fractions of a thumbnail's sides that cover a rectangle of this aspect ratio.

    Half a texel at each edge is omitted, as sampling wraps around.

    Examples
    --------
    >>> across, down = _covering(16.0 / 9.0)
    >>> round(across, 2), round(down, 2)
    (0.5, 0.5)
    >>> _covering(1.0)[0] < 0.3
    True
    """
    own = WIDTH / HEIGHT
    across, down = (0.5, 0.5 * own / ratio) if ratio > own else (0.5 * ratio / own, 0.5)
    return min(across, 0.5 - 0.5 / WIDTH), min(down, 0.5 - 0.5 / HEIGHT)
