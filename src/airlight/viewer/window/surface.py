"""Surface of a canvas, on which ImGui draws the pictures and the panels."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Final

from airlight.viewer.window import style
from airlight.viewer.window.canvas import MISSING_EXTRA, WindowError

#: ImGui's settings for a missing ``end``, besides adding it: raise, print, show.
_STRICT: Final = (
    "config_error_recovery_enable_assert",
    "config_error_recovery_enable_debug_log",
    "config_error_recovery_enable_tooltip",
)


class WindowSurface:
    """ImGui renderer on a canvas.

    Attributes
    ----------
    took_input : bool
        Whether input came before the last frame. ImGui takes a press and its release in two frames,
        and shows what they close in the next.
    """

    def __init__(self, device: Any, canvas: Any) -> None:
        try:
            from imgui_bundle import imgui, implot
            from wgpu.utils.imgui import ImguiRenderer
        except ImportError as error:
            raise WindowError(MISSING_EXTRA) from error
        self._device = device
        try:
            self._context = canvas.get_wgpu_context()
            # Colours are already encoded; the surface must not encode them again.
            form = self._context.get_preferred_format(device.adapter).removesuffix("-srgb")
            self._context.configure(device=device, format=form)
        except Exception as error:
            reason = " ".join(str(error).split())
            raise WindowError(f"the GPU cannot draw on this display: {reason}") from error
        self._renderer = ImguiRenderer(device, canvas)
        implot.create_context()
        self.backend = self._renderer.backend
        self.took_input = False
        self._imgui = imgui
        style.apply_style()

    @property
    def size(self) -> tuple[float, float]:
        """Width and height. [logical pixel]"""
        width, height = self._context.logical_size
        return float(width), float(height)

    @property
    def ratio(self) -> float:
        """Physical pixels per logical pixel. [1]"""
        return float(self._context.pixel_ratio)

    @property
    def typing(self) -> bool:
        """Whether the user is typing into a field."""
        return bool(self._imgui.get_io().want_text_input)

    @property
    def pressed(self) -> bool:
        """Whether a control of a panel is held."""
        return bool(self._imgui.is_any_item_active())

    @property
    def asks(self) -> bool:
        """Whether a popup list or menu is open."""
        any_of = self._imgui.PopupFlags_.any_popup.value
        return bool(self._imgui.is_popup_open("", any_of))

    def close_popups(self) -> bool:
        """Close all popup lists and menus; returns whether there were any."""
        if not self.asks:
            return False
        self._imgui.internal.close_popup_to_level(0, True)
        return True

    @contextmanager
    def balanced(self) -> Iterator[None]:
        """End windows, tables and styles left open by an exception within.

        Otherwise ImGui would reject this and every later frame.
        """
        internal, style_now = self._imgui.internal, self._imgui.get_style()
        state, alpha = internal.ErrorRecoveryState(), style_now.alpha
        internal.error_recovery_store_state(state)
        try:
            yield
        except BaseException:
            # ImGui reports each missing end as an error; here it is a consequence of one.
            io = self._imgui.get_io()
            settings = {name: getattr(io, name) for name in _STRICT}
            try:
                for name in _STRICT:
                    setattr(io, name, False)
                internal.error_recovery_try_to_recover_state(state)
            finally:
                for name, value in settings.items():
                    setattr(io, name, value)
                # After begin_disabled(False) ImGui restores an opacity it never stored: 0.
                style_now.alpha = alpha
            raise

    def draw(self, gui: Callable[[], None]) -> None:
        """Clear the surface and draw ``gui``."""
        encoder = self._device.create_command_encoder()
        view = self._context.get_current_texture().create_view()
        clearing = encoder.begin_render_pass(
            color_attachments=[
                {
                    "view": view,
                    "resolve_target": None,
                    "clear_value": style.SURROUND,
                    "load_op": "clear",
                    "store_op": "store",
                }
            ]
        )
        clearing.end()
        self._device.queue.submit([encoder.finish()])
        self.took_input = len(self._renderer.imgui_context.input_events_queue) > 0
        self._renderer.set_gui(gui)
        self._renderer.render()
