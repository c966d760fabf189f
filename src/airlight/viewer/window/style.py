"""Style of the window: typeface, colours, spacing."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Final

#: Height of the text. [logical pixel]
TEXT: Final = 15.0
#: Width of the panel of parameters. [logical pixel]
PANEL_WIDTH: Final = 384.0
#: Height of the status line. [logical pixel]
STATUS_HEIGHT: Final = 26.0

#: Colour of text: red, green, blue, opacity. [1]
TEXT_COLOR: Final = (0.92, 0.93, 0.94, 1.0)
#: Colours of secondary text, links, warnings and errors: red, green, blue, opacity. [1]
QUIET: Final = (0.62, 0.65, 0.70, 1.0)
ACCENT: Final = (0.36, 0.66, 0.96, 1.0)
WARNING: Final = (0.98, 0.76, 0.36, 1.0)
ERROR: Final = (1.00, 0.50, 0.45, 1.0)
#: Colour around the picture, dark and neutral for the assessment of colours. [1]
SURROUND: Final = (0.055, 0.055, 0.055, 1.0)

#: Code points of the icon font.
UNDO: Final = "\uf2ea"
REDO: Final = "\uf2f9"
RESET: Final = "\uf0e2"
PLAY: Final = "\uf04b"
PAUSE: Final = "\uf04c"
SAVE: Final = "\uf0c7"
HELP: Final = "\uf059"


def apply_style() -> None:
    """Set the style and load the typeface of the current ImGui context."""
    from imgui_bundle import imgui

    imgui.style_colors_dark()
    style = imgui.get_style()
    style.window_rounding = 0.0
    style.child_rounding = 4.0
    style.frame_rounding = 3.0
    style.grab_rounding = 3.0
    style.popup_rounding = 4.0
    style.tab_rounding = 3.0
    style.scrollbar_size = 11.0
    style.window_border_size = 0.0
    style.window_padding = imgui.ImVec2(12.0, 10.0)
    style.frame_padding = imgui.ImVec2(7.0, 3.0)
    style.item_spacing = imgui.ImVec2(7.0, 5.0)
    style.grab_min_size = 9.0
    style.font_size_base = TEXT
    color = imgui.Col_
    for which, value in {
        color.window_bg: (0.105, 0.11, 0.12, 1.0),
        color.popup_bg: (0.13, 0.135, 0.15, 0.98),
        color.child_bg: (0.0, 0.0, 0.0, 0.0),
        color.frame_bg: (0.19, 0.20, 0.22, 1.0),
        color.frame_bg_hovered: (0.25, 0.27, 0.30, 1.0),
        color.frame_bg_active: (0.28, 0.31, 0.35, 1.0),
        color.slider_grab: (0.20, 0.40, 0.66, 1.0),
        color.slider_grab_active: (0.26, 0.52, 0.84, 1.0),
        color.check_mark: ACCENT,
        color.header: (0.17, 0.20, 0.24, 1.0),
        color.header_hovered: (0.22, 0.28, 0.36, 1.0),
        color.header_active: (0.24, 0.32, 0.42, 1.0),
        color.button: (0.20, 0.23, 0.27, 1.0),
        color.button_hovered: (0.26, 0.35, 0.47, 1.0),
        color.button_active: (0.30, 0.45, 0.64, 1.0),
        color.tab: (0.14, 0.15, 0.17, 1.0),
        color.tab_selected: (0.20, 0.29, 0.40, 1.0),
        color.tab_hovered: (0.26, 0.37, 0.52, 1.0),
        color.tab_selected_overline: ACCENT,
        color.text: TEXT_COLOR,
        color.text_disabled: QUIET,
        color.table_header_bg: (0.15, 0.165, 0.19, 1.0),
        color.table_row_bg_alt: (1.0, 1.0, 1.0, 0.03),
        color.separator: (0.24, 0.25, 0.28, 1.0),
    }.items():
        style.set_color_(which, imgui.ImVec4(*value))
    _load_typeface()


def _load_typeface() -> None:
    """Load Roboto, with superscripts and arrows of Inconsolata and icons of Font Awesome."""
    import imgui_bundle
    from imgui_bundle import imgui

    folder = Path(imgui_bundle.__file__).parent / "assets" / "fonts"
    atlas = imgui.get_io().fonts
    for index, name in enumerate(
        ("Roboto/Roboto-Regular.ttf", "Inconsolata-Medium.ttf", "Font_Awesome_6_Free-Solid-900.otf")
    ):
        path = folder / name
        if not path.is_file():  # another build of the package: use its built-in font
            if index == 0:
                return
            continue
        config = imgui.ImFontConfig()
        config.merge_mode = index > 0
        atlas.add_font_from_file_ttf(str(path), TEXT, config)


def colored(text: str, color: tuple[float, float, float, float]) -> None:
    """Draw coloured text, wrapped at the panel's edge."""
    from imgui_bundle import imgui

    imgui.push_style_color(imgui.Col_.text, imgui.ImVec4(*color))
    imgui.push_text_wrap_pos(0.0)
    imgui.text_unformatted(text)
    imgui.pop_text_wrap_pos()
    imgui.pop_style_color()


def hint(text: str, *, width: float = 300.0) -> None:
    """Show a tooltip while the pointer rests on the last item drawn, and drags nothing."""
    from imgui_bundle import imgui

    if (
        text
        and not imgui.is_any_item_active()
        and imgui.is_item_hovered(imgui.HoveredFlags_.for_tooltip.value)
    ):
        imgui.begin_tooltip()
        imgui.push_text_wrap_pos(width)
        imgui.text_unformatted(text)
        imgui.pop_text_wrap_pos()
        imgui.end_tooltip()


def item_place() -> tuple[float, float, float, float]:
    """Rectangle of the last item drawn: left, top, right, bottom. [logical pixel]"""
    from imgui_bundle import imgui

    low, high = imgui.get_item_rect_min(), imgui.get_item_rect_max()
    return low.x, low.y, high.x, high.y


def button(
    icon: str, name: str, sentence: str, act: Callable[[], object], *, on: bool = True
) -> None:
    """Draw a button with an icon, disabled unless ``on``."""
    from imgui_bundle import imgui

    imgui.begin_disabled(not on)
    if imgui.button(f"{icon}##{name}"):
        act()
    imgui.end_disabled()
    hint(sentence)
