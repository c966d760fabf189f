"""Gallery popup: thumbnails of all presets by family, to choose from."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Final

import numpy as np

from airlight.viewer.gallery.presets import HEIGHT, WIDTH, Preset, families
from airlight.viewer.gallery.thumbnails import thumbnail
from airlight.viewer.painting.picture_texture import PictureTexture
from airlight.viewer.window import style

#: Name of the popup.
_POPUP: Final = "gallery of planets"
#: Largest size of the popup, and its distance from the window's edges. [logical pixel]
_LARGEST: Final = (860.0, 640.0)
_MARGIN: Final = 24.0
#: Width of a picture, and gap between pictures. [logical pixel]
_TILE: Final = 184.0
_GAP: Final = 10.0
#: Factor of the pixels per side by which a small picture is enlarged smoothly to fill the window.
ENLARGED: Final = 4
#: Heading of the presets of programs and papers.
LITERATURE: Final = "models of the literature"


class Gallery:
    """Popup with a picture of each preset.

    Parameters
    ----------
    texture : callable
        ``texture(name)``: ImGui's reference to the picture of a preset, or None.

    Attributes
    ----------
    opens : bool
        Whether the next frame opens the popup.
    is_open : bool
        Whether the last frame showed the popup.
    places : dict
        Last rectangles of the pictures by preset, and of the collapsible headings by family: left,
        top, right, bottom. [logical pixel]
    """

    def __init__(self, texture: Callable[[str], Any]) -> None:
        self._texture = texture
        self._at = ""
        self._unfolded: set[str] = set()
        self.opens = self.is_open = False
        self.places: dict[str, tuple[float, float, float, float]] = {}

    def open(self) -> None:
        """Open the popup in the next frame."""
        self.opens = True

    def draw(self, shown: str, size: tuple[float, float]) -> str:
        """Draw the popup if it is open; returns the chosen preset, or "".

        Parameters
        ----------
        shown : str
            Displayed planet, a preset or not.
        size : (float, float)
            Size of the window. [logical pixel]
        """
        from imgui_bundle import imgui

        if self.opens:
            self.opens, self._at = False, shown
            if any(one.name == shown for one in _literature()):
                self._unfolded |= {one.family for one in _literature() if one.name == shown}
            imgui.open_popup(_POPUP)
        width, height = (
            min(most, max(side - 2.0 * _MARGIN, 200.0))
            for most, side in zip(_LARGEST, size, strict=True)
        )
        center = imgui.ImVec2(0.5 * size[0], 0.5 * size[1])
        imgui.set_next_window_pos(center, imgui.Cond_.always.value, imgui.ImVec2(0.5, 0.5))
        imgui.set_next_window_size(imgui.ImVec2(width, height))
        flags = imgui.WindowFlags_.no_saved_settings.value | imgui.WindowFlags_.no_move.value
        self.is_open = imgui.begin_popup(_POPUP, flags)
        if not self.is_open:
            return ""
        columns = max(int((imgui.get_content_region_avail().x - 14.0) / (_TILE + _GAP)), 1)
        rows = self._rows(columns)
        keyed = self._keyed(rows)
        chosen = self._draw_families(shown, columns, scrolls=keyed)
        enter = (imgui.Key.enter, imgui.Key.keypad_enter)
        if any(imgui.is_key_pressed(key, False) for key in enter):
            chosen = self._at
        if chosen or imgui.is_key_pressed(imgui.Key.escape, False):
            imgui.close_current_popup()
            self.is_open = False  # at once: the next frame may come after the next key
        imgui.end_popup()
        return chosen

    def _rows(self, columns: int) -> list[list[str]]:
        """Names of the visible presets, in rows."""
        rows = []
        for family, presets in families().items():
            for some in _parts(presets):
                if some[0].kind == "literature" and family not in self._unfolded:
                    continue
                names = [one.name for one in some]
                rows += [names[at : at + columns] for at in range(0, len(names), columns)]
        return rows

    def _keyed(self, rows: list[list[str]]) -> bool:
        """Move the selection by the arrow keys; returns whether it moved."""
        from imgui_bundle import imgui

        keys = {
            imgui.Key.left_arrow: (0, -1),
            imgui.Key.right_arrow: (0, 1),
            imgui.Key.up_arrow: (-1, 0),
            imgui.Key.down_arrow: (1, 0),
        }
        before = self._at
        for key, step in keys.items():
            if imgui.is_key_pressed(key):
                self._at = neighbour(rows, self._at, step)
        return self._at != before

    def _draw_families(self, shown: str, columns: int, *, scrolls: bool) -> str:
        from imgui_bundle import imgui

        chosen = ""
        for family, presets in families().items():
            imgui.separator_text(family)
            for some in _parts(presets):
                if some[0].kind == "literature" and not self._unfolds(family, len(some)):
                    continue
                for number, one in enumerate(some):
                    if number % columns:
                        imgui.same_line(0.0, _GAP)
                    if self._draw_tile(one, shown, scrolls=scrolls):
                        chosen = one.name
        return chosen

    def _unfolds(self, family: str, count: int) -> bool:
        """Draw the collapsible heading of the literature's models; returns whether it is open."""
        from imgui_bundle import imgui

        imgui.set_next_item_open(family in self._unfolded)
        unfolded = imgui.collapsing_header(f"{LITERATURE} ({count})##{family}")
        self.places[f"{family} {LITERATURE}"] = style.item_place()
        (self._unfolded.add if unfolded else self._unfolded.discard)(family)
        return bool(unfolded)

    def _draw_tile(self, preset: Preset, shown: str, *, scrolls: bool) -> bool:
        """Draw a picture and its caption; returns whether it was clicked."""
        from imgui_bundle import imgui

        size = imgui.ImVec2(_TILE, _TILE * HEIGHT / WIDTH)
        imgui.begin_group()
        corner = imgui.get_cursor_screen_pos()
        clicked = imgui.invisible_button(preset.name, size)
        self.places[preset.name] = style.item_place()
        hovered = imgui.is_item_hovered()
        drawing = imgui.get_window_draw_list()
        end = imgui.ImVec2(corner.x + size.x, corner.y + size.y)
        texture = self._texture(preset.name)
        if texture is not None:
            drawing.add_image(texture, corner, end)
        color = style.ACCENT if preset.name == self._at or hovered else style.QUIET
        if preset.name in (shown, self._at) or hovered:
            drawing.add_rect(corner, end, imgui.get_color_u32(imgui.ImVec4(*color)), thickness=2.0)
        if scrolls and preset.name == self._at:
            imgui.set_scroll_here_y(0.5)
        imgui.text_colored(imgui.ImVec4(*color), preset.label)
        imgui.end_group()
        return bool(clicked)


def _literature() -> list[Preset]:
    return [one for some in families().values() for one in some if one.kind == "literature"]


def _parts(presets: Sequence[Preset]) -> list[list[Preset]]:
    """Presets of a family: own models, and models of the literature."""
    plain = [one for one in presets if one.kind != "literature"]
    return [part for part in (plain, [one for one in presets if one not in plain]) if part]


def neighbour(rows: Sequence[Sequence[str]], name: str, step: tuple[int, int]) -> str:
    """Neighbour of a name in rows of names; the first name if it is unknown.

    Parameters
    ----------
    name : str
        Name at the start of the step.
    step : (int, int)
        Rows down, and columns to the right.

    Examples
    --------
    >>> rows = [["a", "b", "c"], ["d"]]
    >>> neighbour(rows, "c", (1, 0)), neighbour(rows, "c", (0, 1)), neighbour(rows, "a", (-1, 0))
    ('d', 'd', 'a')
    """
    flat = [one for row in rows for one in row]
    if name not in flat:
        return flat[0]
    if step[1]:
        return flat[min(max(flat.index(name) + step[1], 0), len(flat) - 1)]
    row = next(number for number, names in enumerate(rows) if name in names)
    column = rows[row].index(name)
    there = rows[min(max(row + step[0], 0), len(rows) - 1)]
    return there[min(column, len(there) - 1)]


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
