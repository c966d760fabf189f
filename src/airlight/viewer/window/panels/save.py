"""Saving from the window: the picture as PNG or EXR, a film, the planet as a planet file."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

from airlight.errors import AirlightError
from airlight.plain_text import plain
from airlight.planets.parameters import replace as replaced
from airlight.render.live_system_renderer import solutions_around
from airlight.render.picture import LINEAR, picture_suffix, write_picture
from airlight.render.render_scene import render_solution
from airlight.render.render_system import render_solved_system
from airlight.render.scene_lights import SceneLights
from airlight.render.star_points import add_catalogue
from airlight.scene import Scene
from airlight.scene.picture_size import resized
from airlight.viewer.background.error_line import one_line
from airlight.viewer.painting.picture_source import Picture
from airlight.viewer.painting.side_renderer import shows_stars
from airlight.viewer.window import style
from airlight.viewer.window.film import RATE, Sun, film_format, sunlit, write_film

#: Sizes for saving a picture, by name; None is the window's. [pixel]
SIZES: Final[tuple[tuple[str, tuple[int, int] | None], ...]] = (
    ("as in the window", None),
    ("1280 × 720", (1280, 720)),
    ("1920 × 1080", (1920, 1080)),
    ("3840 × 2160", (3840, 2160)),
    ("2048 × 2048", (2048, 2048)),
    ("4096 × 2048", (4096, 2048)),
    ("8192 × 4096", (8192, 4096)),
)
#: Text of the dialog for each kind of file.
_WORDS: Final = {
    "picture": ".png: as it is shown.  .exr: linear light, untouched.",
    "film": f".webp or .png with {RATE} pictures a second, at the exposure that is shown.",
    "planet": "A .toml that airlight reads like its own planets.",
}


class Saving:
    """Thread that writes pictures.

    Parameters
    ----------
    wake : callable
        Called on the thread when ``message`` or ``error`` has changed.

    Attributes
    ----------
    message, error : str
        Progress or result, and error, in one line each; empty if there is none.
    """

    def __init__(self, wake: Callable[[], None]) -> None:
        self._wake = wake
        self._thread: threading.Thread | None = None
        self._cancelled = False
        self.message = ""
        self.error = ""

    @property
    def busy(self) -> bool:
        """Whether a picture is being rendered or written."""
        return self._thread is not None and self._thread.is_alive()

    def save(self, path: str, picture: Picture, size: tuple[int, int] | None) -> None:
        """Start to render and write a picture; does nothing while busy.

        Parameters
        ----------
        path : str
            Path that ends in ``.png`` or ``.exr``.
        picture : Picture
            Picture whose scene and exposure are used.
        size : (int, int), optional
            Width and height, by default the window's; a panorama or a cube strip takes the
            largest size of its aspect ratio that fits. [pixel]
        """
        scene = picture.request.scene
        if size is not None:
            scene = resized(scene, *size)
        self._start(
            f"saving {path}",
            lambda: picture_suffix(path),
            lambda: self._write(path, picture, scene),
        )

    def _start(self, message: str, check: Callable[[], object], work: Callable[[], str]) -> None:
        """Check a path, then work on a thread; does nothing while busy."""
        if self.busy:
            return
        self.message, self.error = "", ""
        try:
            check()
        except AirlightError as error:
            self.error = str(error)
            return
        self.message = message

        def run() -> None:
            try:
                self.message = work()
            except Exception as failure:
                self.message, self.error = "", one_line(failure)
            self._wake()

        self._thread = threading.Thread(target=run, name="airlight-saving", daemon=True)
        self._thread.start()

    def _write(self, path: str, picture: Picture, scene: Scene) -> str:
        request, exposure, clouds = picture.request, picture.exposure, None
        if picture_suffix(path) in LINEAR:
            scene = replace(scene, camera=replace(scene.camera, dehaze=0.0))
        report: dict[str, Any] = {
            "cancel": lambda: self._cancelled,
            "progress": self._progress,
        }
        if request.system is not None:
            solution = request.solution
            solutions = solutions_around(solution, request.system, request.body, {})
            view = replaced(request.system.view, dehaze=scene.camera.dehaze)
            system = replace(request.system, view=view)
            lights = SceneLights(system, solution.wavelengths, solutions)
            whole = scene.camera.width, scene.camera.height, None
            frame = render_solved_system(lights, whole, **report)
        else:
            if request.clouds is not None:
                clouds = request.clouds.refined(
                    request.solution, scene, request.cloud_time, **report
                )
            frame = render_solution(
                request.solution, scene, orders=request.orders, clouds=clouds, **report
            )
        planet = request.solution.planet
        if planet is not None and shows_stars(picture):
            add_catalogue(frame.rgb, scene, request.solution, planet.body, clouds)
        metadata = {"planet": planet.name if planet else "", **scene.metadata()}
        metadata |= {"orders": request.orders}
        written = write_picture(path, frame, metadata, exposure=exposure, settings=request.display)
        size = f"{scene.camera.width}×{scene.camera.height}"
        return f"saved {written.path}  {size}  {written.size / 1e3:.0f} kB"

    def film(
        self, path: str, picture: Picture, size: tuple[int, int] | None, suns: tuple[Sun, ...]
    ) -> None:
        """Start to render and write a film; does nothing while busy.

        Parameters
        ----------
        path : str
            Path that ends in ``.webp`` or ``.png``.
        picture : Picture
            Picture that defines observer, camera and exposure.
        size : (int, int), optional
            See ``save``. [pixel]
        suns : tuple of (float, float)
            Zenith angle and compass bearing of the sun, frame by frame. [deg]
        """
        scene = picture.request.scene
        scenes = sunlit(scene if size is None else resized(scene, *size), suns)
        self._start(
            f"filming {path}",
            lambda: film_format(path),
            lambda: self._film(path, picture, scenes),
        )

    def _film(self, path: str, picture: Picture, scenes: tuple[Scene, ...]) -> str:
        written = write_film(
            path, picture, scenes, progress=self._progress, cancel=lambda: self._cancelled
        )
        return f"saved {path}  {len(scenes)} frames  {written / 1e6:.1f} MB"

    def _progress(self, done: int, total: int, message: str) -> None:
        self.message = f"saving: {100.0 * done / max(total, 1):.0f} %"
        self._wake()

    def close(self) -> None:
        """Cancel, and wait for the thread to end."""
        self._cancelled = True
        if self._thread is not None:
            self._thread.join()


class SaveDialog:
    """Save dialog, over the picture.

    Attributes
    ----------
    asks : str
        Kind of file, ``picture``, ``film`` or ``planet``; empty if the dialog is closed.
    picture_path, film_path, planet_path : str
        Paths in the text fields.
    hours, seconds : float
        Time lapse of a film, and its duration. [h], [s]
    """

    def __init__(self) -> None:
        self.asks = ""  # "picture", "film", "planet" or empty
        self.picture_path = "airlight.png"
        self.film_path = "airlight.webp"
        self.hours, self.seconds = 3.0, 6.0
        self.planet_path = "my-planet.toml"
        self._size = 0
        self._fresh = False

    def ask(self, what: str) -> None:
        """Open the dialog for a ``picture``, a ``film`` or a ``planet``."""
        self.asks, self._fresh = what, True

    def draw(
        self,
        width: float,
        height: float,
        save_picture: Callable[[str, tuple[int, int] | None], object],
        save_film: Callable[[str, tuple[int, int] | None, float, float], object],
        save_planet: Callable[[str], object],
    ) -> None:
        """Draw the dialog if it is open, and save once confirmed.

        Parameters
        ----------
        width, height : float
            Size of the window. [logical pixel]
        save_picture : callable
            ``save_picture(path, size)``, with the size in pixels or None.
        save_film : callable
            ``save_film(path, size, hours, seconds)``.
        save_planet : callable
            ``save_planet(path)``.
        """
        from imgui_bundle import imgui

        if not self.asks:
            return
        center = imgui.ImVec2(0.5 * width, 0.45 * height)
        imgui.set_next_window_pos(center, imgui.Cond_.always.value, imgui.ImVec2(0.5, 0.5))
        imgui.set_next_window_size(imgui.ImVec2(min(460.0, width), 0.0))
        flags = (
            imgui.WindowFlags_.no_collapse.value
            | imgui.WindowFlags_.no_resize.value
            | imgui.WindowFlags_.no_title_bar.value
            | imgui.WindowFlags_.no_saved_settings.value
        )
        imgui.begin("save", None, flags)
        asks = self.asks
        style.colored(f"Save the {self.asks}", style.ACCENT)
        imgui.set_next_item_width(-1.0)
        if self._fresh:
            imgui.set_keyboard_focus_here()
            self._fresh = False
        path = getattr(self, f"{asks}_path")
        entered, path = imgui.input_text(
            "##path", path, imgui.InputTextFlags_.enter_returns_true.value
        )
        setattr(self, f"{asks}_path", path)
        if asks != "planet":
            imgui.set_next_item_width(200.0)
            _, self._size = imgui.combo("size", self._size, [name for name, _ in SIZES])
        if asks == "film":
            self._draw_times()
        style.colored(_WORDS[asks], style.QUIET)
        style.colored(_where(path), style.QUIET)
        if imgui.button("save") or entered:
            self.asks = ""
            target = str(_expanded(path))
            size = SIZES[self._size][1]
            if asks == "picture":
                save_picture(target, size)
            elif asks == "film":
                save_film(target, size, self.hours, self.seconds)
            else:
                save_planet(target)
        imgui.same_line()
        if imgui.button("cancel") or imgui.is_key_pressed(imgui.Key.escape):
            self.asks = ""
        imgui.end()

    def _draw_times(self) -> None:
        """Draw the sliders of a film's time lapse and duration."""
        from imgui_bundle import imgui

        imgui.set_next_item_width(200.0)
        _, self.hours = imgui.slider_float("of the sun's time", self.hours, 0.1, 24.0, "%.1f h")
        imgui.set_next_item_width(200.0)
        _, self.seconds = imgui.slider_float("length", self.seconds, 1.0, 60.0, "%.0f s")


def _expanded(path: str) -> Path:
    """Expand ``~``; unchanged if the home directory is unknown."""
    try:
        return Path(path).expanduser()
    except RuntimeError:
        return Path(path)


def _where(path: str) -> str:
    """Line with the folder of a path, or an error."""
    try:
        return plain(f"in {_expanded(path).parent.resolve()}")
    except (OSError, ValueError, RuntimeError) as error:  # a null character, a cycle of links
        return plain(error)
