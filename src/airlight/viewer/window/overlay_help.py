"""Help overlay: mouse and key bindings."""

from __future__ import annotations

from typing import Final

from airlight.viewer.navigation.keys import as_json
from airlight.viewer.window import style

#: Widths of the overlay and of the column of keys. [logical pixel]
_WIDTH: Final = 840.0
_KEYS: Final = 112.0


def draw_help(width: float, height: float) -> bool:
    """Draw the help centred in the window.

    Parameters
    ----------
    width, height : float
        Size of the window. [logical pixel]

    Returns
    -------
    bool
        False once the user has closed it.
    """
    from imgui_bundle import imgui

    center = imgui.ImVec2(0.5 * width, 0.5 * height)
    imgui.set_next_window_pos(center, imgui.Cond_.always.value, imgui.ImVec2(0.5, 0.5))
    imgui.set_next_window_size(imgui.ImVec2(min(_WIDTH, width), 0.0))
    imgui.set_next_window_bg_alpha(0.96)
    flags = (
        imgui.WindowFlags_.no_title_bar.value
        | imgui.WindowFlags_.no_resize.value
        | imgui.WindowFlags_.no_move.value
        | imgui.WindowFlags_.no_saved_settings.value
    )
    imgui.push_style_var(imgui.StyleVar_.window_padding, imgui.ImVec2(24.0, 18.0))
    imgui.begin("help", None, flags)
    imgui.pop_style_var()
    if imgui.begin_table("columns", 2):
        for index, (heading, rows) in enumerate(as_json("window")["help"]):
            if index % 2 == 0:
                imgui.table_next_row()
            imgui.table_next_column()
            style.colored(heading, style.ACCENT)
            for keys, meaning in rows:
                left = imgui.get_cursor_pos_x()
                imgui.text_unformatted(keys)
                imgui.same_line()
                imgui.set_cursor_pos_x(left + _KEYS)
                style.colored(meaning, style.QUIET)
            imgui.dummy(imgui.ImVec2(0.0, 8.0))
        imgui.end_table()
    closed = imgui.button("close")
    imgui.same_line()
    imgui.text_colored(imgui.ImVec4(*style.QUIET), "Rest the pointer on a name for its meaning.")
    imgui.end()
    return not closed
