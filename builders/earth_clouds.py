"""Remake ``scene/data/earth-clouds.jpg`` from the fair-weather clouds of Natural Earth III.

Run with ``python builders/earth_clouds.py FILE.png``, the file ``example/clouds/clouds.png``
(4096 x 2048) of the npm package globe.gl 2.46.2, whose opacity is that of the clouds.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from PIL import Image

TARGET = Path(__file__).parents[1] / "src" / "airlight" / "scene" / "data" / "earth-clouds.jpg"
QUALITY = 80
#: Opacity that is noise of the clear sky. [1]
CLEAR = 0.02
#: Exponent of the cover over opacity. The picture is of fair weather: opacity as cover has a mean
#: of 0.10, this one 0.20. The Earth's is two thirds (ISCCP); the preset's optical depth makes up
#: for it.
POWER = 0.5


def main() -> None:
    """Convert opacity to cover, save it, and say its mean over the sphere."""
    if len(sys.argv) < 2:
        sys.exit("give the file example/clouds/clouds.png of globe.gl 2.46.2")
    with Image.open(sys.argv[1]) as picture:
        opacity = np.asarray(picture.convert("RGBA"))[..., 3] / 255.0
    cover = np.clip((opacity - CLEAR) / (1.0 - CLEAR), 0.0, 1.0) ** POWER
    Image.fromarray(np.rint(255.0 * cover).astype(np.uint8)).save(
        TARGET, quality=QUALITY, optimize=True
    )
    weights = np.sin(np.pi * (np.arange(len(cover)) + 0.5) / len(cover))
    mean = float(cover.mean(axis=1) @ weights / weights.sum())
    print(f"{TARGET.name}: {TARGET.stat().st_size} bytes, mean cover {mean:.4f}")


if __name__ == "__main__":
    main()
