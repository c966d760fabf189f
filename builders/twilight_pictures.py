"""Remake ``docs/images/planets/earth-twilight.png``: dusk in one exponential, and in real air.

Run with ``python builders/twilight_pictures.py``; it needs airlight alone. Rows: the sun 2°, 4° and
6° below the horizon, seen towards it and away from it. Left, Earth with one exponential of the same
column, no stratospheric aerosol and straight light; right, preset ``earth``. Each row has one
exposure, that of the right.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image

from airlight import Camera, Scene, load_planet, solve
from airlight.image.display import to_display
from airlight.image.exposure import automatic_exposure
from airlight.image.spectral import default_wavelengths
from airlight.render import render
from airlight.validation.published.twilight import one_exponential

FILE = Path(__file__).parents[1] / "docs" / "images" / "planets" / "earth-twilight.png"
WIDTH, HEIGHT, GAP = 320, 180, 4
#: Depressions of the sun, and azimuths of the line of sight from the sun. [deg]
DEPRESSIONS, ASIDE = (2.0, 4.0, 6.0), (0.0, 180.0)


def main() -> None:
    """Draw the sheet."""
    earth = load_planet("earth")
    wavelengths = default_wavelengths(16)
    solutions = [solve(one, wavelengths) for one in (one_exponential(earth), earth)]
    rows = []
    for depression in DEPRESSIONS:
        for aside in ASIDE:
            camera = Camera(
                width=WIDTH, height=HEIGHT, look_zenith=76.0, look_azimuth=aside, field_of_view=60.0
            )
            scene = Scene(altitude=2.0, sun_zenith=90.0 + depression, camera=camera)
            before, after = (render(one, scene).rgb for one in solutions)
            exposure = automatic_exposure(after)
            pair = [to_display(one, exposure) for one in (before, after)]
            gap = np.full((HEIGHT, GAP, 3), 128, np.uint8)
            rows.append(np.concatenate([pair[0], gap, pair[1]], axis=1))
            rows.append(np.full((GAP, 2 * WIDTH + GAP, 3), 128, np.uint8))
    Image.fromarray(np.concatenate(rows[:-1])).save(FILE, optimize=True)


if __name__ == "__main__":
    main()
