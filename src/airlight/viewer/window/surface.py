"""The surface of a canvas: cleared, with the pictures and the panels of ImGui on it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from airlight.viewer.window import style
from airlight.viewer.window.canvas import MISSING_EXTRA, WindowError


class WindowSurface:
    """ImGui on a canvas.

    Parameters
    ----------
    device : wgpu.GPUDevice
    canvas : rendercanvas canvas

    Raises
    ------
    WindowError
        If the packages are missing, or the device cannot draw on this canvas.
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
            # Colours are encoded by whoever makes them; the surface must not encode them again.
            form = self._context.get_preferred_format(device.adapter).removesuffix("-srgb")
            self._context.configure(device=device, format=form)
        except Exception as error:
            reason = " ".join(str(error).split())
            raise WindowError(
                f"the graphics device cannot draw on this display: {reason}"
            ) from error
        self._renderer = ImguiRenderer(device, canvas)
        implot.create_context()
        self.backend = self._renderer.backend
        self._imgui = imgui
        style.apply_style()

    @property
    def size(self) -> tuple[float, float]:
        """Width and height. [logical pixel]"""
        width, height = self._context.logical_size
        return float(width), float(height)

    @property
    def ratio(self) -> float:
        """Pixels of the display per logical pixel. [1]"""
        return float(self._context.pixel_ratio)

    @property
    def typing(self) -> bool:
        """Whether the user is typing into a field."""
        return bool(self._imgui.get_io().want_text_input)

    @property
    def pressed(self) -> bool:
        """Whether a panel's control is held."""
        return bool(self._imgui.is_any_item_active())

    @property
    def asks(self) -> bool:
        """Whether a list or a menu is open over the rest."""
        any_of = self._imgui.PopupFlags_.any_popup.value
        return bool(self._imgui.is_popup_open("", any_of))

    def draw(self, gui: Callable[[], None]) -> None:
        """Clear the surface and draw what ``gui`` says."""
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
        self._renderer.set_gui(gui)
        self._renderer.render()
