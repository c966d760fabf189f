"""Remake ``scene/data/earth-lights.jpg`` from NASA's picture of the Earth at night.

Run with ``python builders/earth_lights.py FILE.jpg``, the file ``example/img/earth-night.jpg``
(4096 x 2048) of the npm package three-globe 2.45.2 (``npm pack three-globe``). It needs SciPy.

The picture shows the land by moonlight in blue under the lights of the towns: lights are what is
redder than that. Its tones are those of a display, and saturate: a tenth of all lit pixels, from
town centres to whole conurbations, are one plateau. There the radiance follows from the lights
around: large conurbations are brightest in their middle. The contrast is that of Elvidge et al.
(2017, Int. J. Remote Sens. 38, 5860): villages 1e-9, suburbs 1e-8, centres of large towns
1e-7 W cm⁻² sr⁻¹; white is the mean of 10 km, ``scene.ground_overlay.TOWN_LUMINANCE``.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from PIL import Image
from scipy.ndimage import gaussian_filter

TARGET = Path(__file__).parents[1] / "src" / "airlight" / "scene" / "data" / "earth-lights.jpg"
QUALITY = 85
#: Red by moonlight relative to blue, and the red of the plateau's top above that: the picture's
#: land has (10, 52, 77), its brightest towns (105, 105, 105).
MOONLIT, BRIGHTEST = 0.25, 79.0
#: Red that is noise. [1]
NOISE = 6.0
#: Ends of the plateau, relative to its top. [1]
PLATEAU = (0.6, 0.85)
#: Share of the code that the picture gives: with it suburbs, half of the plateau's top, are 0.08
#: of the brightest, and villages, a fifth, 0.014. [1]
SEEN = 0.62
#: Deviation of the weights of the lights around, 24 km [pixel], and their sum in the middle of the
#: largest conurbations [1].
AROUND, LARGEST = 2.5, 0.85


def main() -> None:
    """Separate the lights from the moonlit land, and save them as a grey picture."""
    if len(sys.argv) < 2:
        sys.exit("give the file example/img/earth-night.jpg of three-globe 2.45.2")
    with Image.open(sys.argv[1]) as picture:
        pixels = np.asarray(picture.convert("RGB")).astype(np.float64)
    lights = (pixels[..., 0] - MOONLIT * pixels[..., 2] - NOISE) / (BRIGHTEST - NOISE)
    shown = np.clip(lights, 0.0, 1.0)
    flat = np.clip((lights - PLATEAU[0]) / (PLATEAU[1] - PLATEAU[0]), 0.0, 1.0)
    around = gaussian_filter(shown, AROUND, mode=("nearest", "wrap")) / LARGEST
    code = SEEN * shown + (1.0 - SEEN) * flat**2 * (3.0 - 2.0 * flat) * np.clip(around, 0.0, 1.0)
    grey = np.rint(255.0 * code).astype(np.uint8)
    Image.fromarray(grey).save(TARGET, quality=QUALITY, optimize=True)
    clipped = float((grey == 255).sum() / (grey > 12).sum())
    print(f"{TARGET.name}: {TARGET.stat().st_size} bytes, {clipped:.4f} of the lit pixels clipped")


if __name__ == "__main__":
    main()
