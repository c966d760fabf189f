"""Remake ``docs/_static/front-sky.jpg``: the frames between which the front page's slider chooses.

Run with ``python builders/front_sky.py`` and look at the picture.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image

import airlight
from airlight.image.display import to_display
from airlight.planets.picture_wavelengths import picture_wavelengths

OUT = Path(__file__).parents[1] / "docs" / "_static" / "front-sky.jpg"
#: Elevation of the sun in each frame, from the top; those of docs/_static/front-sky.js. [deg]
ELEVATIONS = (40.0, 20.0, 10.0, 5.0, 2.0, 0.0, -2.0, -4.0, -6.0)


def main() -> None:
    """Render the frames, each exposed as an eye adapts, above each other."""
    earth = airlight.load_planet("earth")
    solution = airlight.solve(earth, picture_wavelengths(earth), quality="preview")
    camera = airlight.Camera(width=800, height=300, field_of_view=75.0, look_zenith=82.0)
    frames = []
    for elevation in ELEVATIONS:
        scene = airlight.Scene(
            altitude=10.0,
            longitude=-30.0,
            sun_zenith=90.0 - elevation,
            camera=camera,
            ground="detailed",
        )
        frame = airlight.render(solution, scene)
        frames.append(to_display(frame.rgb, exposure=frame.exposure, **frame.lens))
    Image.fromarray(np.concatenate(frames)).save(OUT, quality=82)


if __name__ == "__main__":
    main()
