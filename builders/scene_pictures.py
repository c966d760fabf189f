"""Draw the pictures of docs/scenes.md: presets side by side.

python builders/scene_pictures.py
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image

from airlight.color.display import to_display
from airlight.paint.paint_system import paint_system
from airlight.system import load_system

FOLDER = Path(__file__).parents[1] / "docs" / "images" / "scenes"
#: Strips of presets, with their exposures; None for the automatic one. [EV]
STRIPS: dict[str, dict[str, float | None]] = {
    "scenes-1": {"earth-moon": None, "lunar-eclipse": None, "iss": None},
    "scenes-2": {"binary-sunset": None, "moonlit-night": None, "mars-phobos": None},
    "scenes-3": {"earth-eclipses-sun": -5.0, "orion": None},
}
WIDTH, HEIGHT = 560, 420


def picture(name: str, exposure: float | None) -> Image.Image:
    """One preset as it is displayed."""
    frame = paint_system(load_system(name), width=WIDTH, height=HEIGHT, samples=6)
    chosen = frame.exposure if exposure is None else exposure
    pixels = to_display(frame.rgb, exposure=chosen, pixel_angle=frame.pixel_angle)
    return Image.fromarray(np.asarray(pixels))


if __name__ == "__main__":
    FOLDER.mkdir(parents=True, exist_ok=True)
    for strip, presets in STRIPS.items():
        whole = Image.new("RGB", (WIDTH * len(presets), HEIGHT))
        for k, (name, exposure) in enumerate(presets.items()):
            whole.paste(picture(name, exposure), (k * WIDTH, 0))
        whole.save(FOLDER / f"{strip}.jpg", quality=92)
