"""Draw the pictures of docs/scenes.md: presets side by side, and views of an eclipse.

python builders/scene_pictures.py [STRIP ...]
"""

from __future__ import annotations

import sys
from dataclasses import replace as replaced
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from PIL import Image

from airlight.image.display import to_display
from airlight.planets.parameters import replace
from airlight.render.render_system import render_system
from airlight.scene.system import System, load_system

FOLDER = Path(__file__).parents[1] / "docs" / "images" / "scenes"
#: Strips of presets, with their exposures; None for the automatic one. [EV]
STRIPS: dict[str, dict[str, float | None]] = {
    "scenes-1": {"earth-moon": None, "lunar-eclipse": None, "iss": None},
    "scenes-2": {"binary-sunset": None, "moonlit-night": None, "mars-phobos": None},
    "scenes-3": {"earth-eclipses-sun": None, "orion": None},
}
WIDTH, HEIGHT = 560, 420


class EclipseView(NamedTuple):
    """View of the eclipse: exposure, width of the picture, changes of observer and camera."""

    exposure: float | None
    width: int
    observer: dict[str, Any]
    view: dict[str, Any]


ECLIPSE = "solar-eclipse-2017"
#: Strips of views of the eclipse.
VIEWS: dict[str, tuple[EclipseView, ...]] = {
    "scenes-4": (
        EclipseView(None, WIDTH, {}, {}),
        EclipseView(None, HEIGHT, {}, {"look_zenith": 0.0, "look_bearing": 0.0,
                                       "projection": "fisheye", "field_of_view": 180.0}),
        EclipseView(-1.5, HEIGHT, {}, {"look_zenith": None, "look_bearing": None,
                                       "look_at": "moon", "field_of_view": 3.5}),
    ),
    "scenes-5": (
        EclipseView(None, WIDTH, {"altitude": 400e3, "latitude": 40.5},
                    {"look_zenith": 124.0, "look_bearing": 0.0, "field_of_view": 80.0}),
        EclipseView(None, HEIGHT, {"altitude": 2e7, "latitude": 20.0, "longitude": -105.0},
                    {"look_zenith": 180.0, "look_bearing": 0.0, "field_of_view": 29.0}),
    ),
}  # fmt: skip


def of_eclipse(view: EclipseView) -> Image.Image:
    """View of the eclipse as it is displayed."""
    system = load_system(ECLIPSE)
    seen = replaced(
        system, observer=replace(system.observer, **view.observer),
        view=replace(system.view, **view.view),
    )  # fmt: skip
    return picture(seen, view.exposure, view.width)


def picture(system: System, exposure: float | None, width: int = WIDTH) -> Image.Image:
    """One scene as it is displayed."""
    frame = render_system(system, width=width, height=HEIGHT, samples=6)
    chosen = frame.exposure if exposure is None else exposure
    pixels = to_display(
        frame.rgb, exposure=chosen, pixel_angle=frame.pixel_angle, star_white=frame.star_white,
        eye=exposure is None,
    )  # fmt: skip
    return Image.fromarray(np.asarray(pixels))


def side_by_side(pictures: list[Image.Image]) -> Image.Image:
    """Pictures of one height in a row."""
    whole = Image.new("RGB", (sum(one.width for one in pictures), HEIGHT))
    left = 0
    for one in pictures:
        whole.paste(one, (left, 0))
        left += one.width
    return whole


if __name__ == "__main__":
    FOLDER.mkdir(parents=True, exist_ok=True)
    for strip in sys.argv[1:] or [*STRIPS, *VIEWS]:
        if strip in VIEWS:
            drawn = [of_eclipse(view) for view in VIEWS[strip]]
        else:
            drawn = [picture(load_system(name), ev) for name, ev in STRIPS[strip].items()]
        side_by_side(drawn).save(FOLDER / f"{strip}.jpg", quality=92)
