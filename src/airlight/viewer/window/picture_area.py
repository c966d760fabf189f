"""Layout of the pictures in the window: one, or two side by side with a draggable divider."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

from airlight.viewer.painting.picture_source import Picture
from airlight.viewer.window import style

#: Distance from the divider within which it can be grabbed. [logical pixel]
_GRAB: Final = 7.0
#: Width of the probe's numbers and parts beside each other. [logical pixel]
_PROBE_WIDTH: Final = 576.0


@dataclass(frozen=True, kw_only=True)
class Rectangle:
    """Rectangular part of the window. [logical pixel]"""

    left: float
    top: float
    width: float
    height: float

    def holds(self, x: float, y: float) -> bool:
        """Whether a point lies inside."""
        return self.left <= x < self.left + self.width and self.top <= y < self.top + self.height

    def centered(self, width: float, height: float) -> Rectangle:
        """Rectangle of a size, centred in this one.

        Examples
        --------
        >>> Rectangle(left=10.0, top=0.0, width=100.0, height=50.0).centered(50.0, 50.0).left
        35.0
        """
        return Rectangle(
            left=self.left + 0.5 * (self.width - width),
            top=self.top + 0.5 * (self.height - height),
            width=width,
            height=height,
        )

    def place_of(self, x: float, y: float) -> tuple[float, float] | None:
        """Position of a point as fractions of width and height [1]; None outside."""
        if not self.holds(x, y):
            return None
        return (x - self.left) / self.width, (y - self.top) / self.height


class PictureArea:
    """Area of the pictures, behind the panels.

    Parameters
    ----------
    backend : ImguiWgpuBackend
        Back end that registers textures.

    Attributes
    ----------
    divider : float
        Position of the divider, as a fraction of the width. [1]
    """

    def __init__(self, backend: Any) -> None:
        self._backend = backend
        self._known: dict[int, tuple[Any, Any]] = {}
        self.divider = 0.5
        self._dragging = False
        self._split = False

    def draw(self, left: Picture | None, right: Picture | None, into: Rectangle) -> None:
        """Draw one picture, or parts of two on either side of the divider.

        Parameters
        ----------
        left : Picture or None
            Picture left of the divider, or the whole picture if there is no other.
        into : Rectangle
            Rectangle to fill.
        """
        views = {id(one.view) for one in (left, right) if one is not None}
        for old in set(self._known) - views:
            _, reference = self._known.pop(old)
            self._backend.unregister_texture(reference)
        self._split = right is not None
        if right is None:
            self._part(left, into, 0.0, 1.0)
            return
        self._part(left, into, 0.0, self.divider)
        self._part(right, into, self.divider, 1.0)

    def _part(self, picture: Picture | None, into: Rectangle, first: float, last: float) -> None:
        from imgui_bundle import imgui

        if picture is None or last <= first:
            return
        if id(picture.view) not in self._known:
            reference = self._backend.register_texture(picture.view)
            self._known[id(picture.view)] = (picture.view, reference)
        _, reference = self._known[id(picture.view)]
        # An inset of half a texel keeps a magnified picture from wrapping around at its edges.
        edge_x, edge_y = 0.0, 0.0
        if picture.width < into.width or picture.height < into.height:
            edge_x, edge_y = 0.5 / picture.width, 0.5 / picture.height
        imgui.get_background_draw_list().add_image(
            reference,
            imgui.ImVec2(into.left + first * into.width, into.top),
            imgui.ImVec2(into.left + last * into.width, into.top + into.height),
            imgui.ImVec2(max(first, edge_x), edge_y),
            imgui.ImVec2(min(last, 1.0 - edge_x), 1.0 - edge_y),
        )

    def draw_divider(self, into: Rectangle, names: tuple[str, str]) -> None:
        """Draw the line between two pictures, and their names."""
        from imgui_bundle import imgui

        drawing = imgui.get_background_draw_list()
        x = into.left + self.divider * into.width
        white = imgui.get_color_u32(imgui.ImVec4(1.0, 1.0, 1.0, 0.85))
        shade = imgui.get_color_u32(imgui.ImVec4(0.0, 0.0, 0.0, 0.6))
        bottom = into.top + into.height
        drawing.add_line(imgui.ImVec2(x, into.top), imgui.ImVec2(x, bottom), shade, 3.0)
        drawing.add_line(imgui.ImVec2(x, into.top), imgui.ImVec2(x, bottom), white, 1.0)
        middle = into.top + 0.5 * into.height
        drawing.add_circle_filled(imgui.ImVec2(x, middle), 7.0, shade)
        drawing.add_circle_filled(imgui.ImVec2(x, middle), 5.0, white)
        for name, at_right in zip(names, (False, True), strict=True):
            size = imgui.calc_text_size(name)
            start = x + 12.0 if at_right else x - 12.0 - size.x
            low = imgui.ImVec2(start - 6.0, into.top + 10.0)
            high = imgui.ImVec2(start + size.x + 6.0, into.top + 16.0 + size.y)
            drawing.add_rect_filled(low, high, shade, 4.0)
            drawing.add_text(imgui.ImVec2(start, into.top + 13.0), white, name)

    def draw_outdated(self, words: str, into: Rectangle, first: float, last: float) -> None:
        """Veil the picture of another planet, and show the current task.

        Parameters
        ----------
        words : str
            Current task; nothing is drawn if empty.
        first, last : float
            Left and right limit, as fractions of its width. [1]
        """
        from imgui_bundle import imgui

        if not words or last <= first:
            return
        drawing = imgui.get_background_draw_list()
        left, right = (into.left + share * into.width for share in (first, last))
        bottom = into.top + into.height
        veil = imgui.get_color_u32(imgui.ImVec4(0.0, 0.0, 0.0, 0.55))
        drawing.add_rect_filled(imgui.ImVec2(left, into.top), imgui.ImVec2(right, bottom), veil)
        size = imgui.calc_text_size(words)
        at = imgui.ImVec2(0.5 * (left + right - size.x), into.top + 0.5 * (into.height - size.y))
        white = imgui.get_color_u32(imgui.ImVec4(*style.TEXT_COLOR))
        drawing.add_text(at, white, words)

    def draw_working(self, words: str, into: Rectangle, first: float = 0.0) -> None:
        """Show the current task in a corner of an outdated picture.

        Parameters
        ----------
        words : str
            Current task; nothing is drawn if empty.
        first : float
            Left limit as a fraction of its width; there the name of a side is above. [1]
        """
        from imgui_bundle import imgui

        if not words:
            return
        drawing = imgui.get_background_draw_list()
        size = imgui.calc_text_size(words)
        left, below = into.left + first * into.width, 36.0 if first > 0.0 else 0.0
        at = imgui.ImVec2(left + 22.0, into.top + 18.0 + below)
        low = imgui.ImVec2(at.x - 10.0, at.y - 6.0)
        high = imgui.ImVec2(at.x + size.x + 10.0, at.y + size.y + 6.0)
        shade = imgui.get_color_u32(imgui.ImVec4(0.0, 0.0, 0.0, 0.7))
        drawing.add_rect_filled(low, high, shade, 4.0)
        drawing.add_text(at, imgui.get_color_u32(imgui.ImVec4(*style.TEXT_COLOR)), words)

    def draw_mark(self, into: Rectangle, place: tuple[float, float]) -> None:
        """Draw a small circle at a position, in fractions of width and height. [1]"""
        from imgui_bundle import imgui

        drawing = imgui.get_background_draw_list()
        x, y = into.left + place[0] * into.width, into.top + place[1] * into.height
        white = imgui.get_color_u32(imgui.ImVec4(1.0, 1.0, 1.0, 0.9))
        shade = imgui.get_color_u32(imgui.ImVec4(0.0, 0.0, 0.0, 0.7))
        drawing.add_circle(imgui.ImVec2(x, y), 6.0, shade, 0, 3.0)
        drawing.add_circle(imgui.ImVec2(x, y), 6.0, white, 0, 1.2)

    def grab(self, x: float, y: float, into: Rectangle) -> bool:
        """Start dragging the divider if it is at this point; returns whether it is."""
        line = into.left + self.divider * into.width
        self._dragging = self._split and into.holds(x, y) and abs(x - line) <= _GRAB
        return self._dragging

    def drag(self, x: float, into: Rectangle) -> bool:
        """Move the divider if it is being dragged; returns whether it is."""
        if self._dragging and into.width > 0.0:
            self.divider = min(max((x - into.left) / into.width, 0.02), 0.98)
        return self._dragging

    def release(self) -> None:
        """Stop dragging."""
        self._dragging = False


def layout(size: tuple[float, float], *, panels: bool, probe: float) -> dict[str, Rectangle]:
    """Rectangles of picture, panel, probe and status line.

    Parameters
    ----------
    size : (float, float)
        Size of the window. [logical pixel]
    panels : bool
        Whether the panels are visible; without them only the picture has a rectangle.
    probe : float
        Height of the probe's panel below the picture, 0 if it is closed. [logical pixel]

    Returns
    -------
    dict
        Rectangles by name. [logical pixel]

    Examples
    --------
    >>> parts = layout((1280.0, 720.0), panels=True, probe=0.0)
    >>> parts["picture"].left == parts["panel"].width
    True
    """
    width, height = size
    if not panels:
        return {"picture": Rectangle(left=0.0, top=0.0, width=width, height=height)}
    side = min(style.PANEL_WIDTH, 0.5 * width)
    body = max(height - style.STATUS_HEIGHT, 1.0)
    below = min(probe, 0.6 * body)
    # A narrow picture leaves too little beside the panel: the probe takes the window's width.
    left = 0.0 if width - side < _PROBE_WIDTH else side
    return {
        "panel": Rectangle(left=0.0, top=0.0, width=side, height=body - (0.0 if left else below)),
        "picture": Rectangle(left=side, top=0.0, width=width - side, height=body - below),
        "probe": Rectangle(left=left, top=body - below, width=width - left, height=below),
        "status": Rectangle(left=0.0, top=body, width=width, height=height - body),
    }
