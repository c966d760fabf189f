"""Remake ``scene/system/data/milky-way.png``: the light of stars too faint for the catalogue.

Run with ``python builders/milky_way.py FILE.png``, the file
``usr/share/stellarium/textures/milkyway.png`` of the Debian package stellarium-data 0.22.2-1: the
panorama by Axel Mellinger, who permits to modify and redistribute it with credit. It gives the
structure; the brightness is that of published integrated starlight, in V.

* Light away from the Milky Way: c/(|sin b| + 0.25) with 28 S10 at the galactic poles (Roach &
  Gordon 1973, The Light of the Night Sky, table 3-1; 1 S10 is one star of V = 10 per square degree,
  27.78 mag per square second of arc).
* Mean over the sky: 105 S10 with the stars of the catalogue (the same).
* Large Sagittarius star cloud: 20.8 mag per square second of arc.

The picture's luminance to a power, times a factor, is added; both follow from the last two.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageFilter

from airlight.image.encoding import srgb_decode
from airlight.image.xyz import luminance
from airlight.scene.system.milky_way import BRIGHTEST, galactic_axes
from airlight.scene.system.stars import stars

TARGET = Path(__file__).parents[1] / "src/airlight/scene/system/data/milky-way.png"
#: Rows of the map.
ROWS = 512
#: Brightness at the poles, mean over the sky with the catalogue's stars, and of the cloud. [S10]
POLE, MEAN, CLOUD = 28.0, 105.0, 10.0 ** (0.4 * (27.78 - 20.8))
#: Galactic coordinates of the cloud, and its radius. [deg]
SAGITTARIUS, RADIUS = (1.5, -4.0), 1.5


def main() -> None:
    """Reduce the picture, give it the brightness of starlight, save it and print some places."""
    if len(sys.argv) < 2:
        sys.exit("give the file textures/milkyway.png of stellarium-data")
    with Image.open(sys.argv[1]) as picture:
        calm = picture.convert("RGB").filter(ImageFilter.MedianFilter(5))
    light = luminance(srgb_decode(np.asarray(calm) / 255.0)).astype(np.float32)
    # Right ascension increases to the left, from 90 degrees.
    grey = Image.fromarray(light).resize((2 * ROWS, ROWS), Image.Resampling.BOX)
    structure = np.maximum(np.asarray(grey, float), 0.0)
    declination = np.radians(90.0 - (np.arange(ROWS) + 0.5) / ROWS * 180.0)[:, None]
    ascension = np.radians(90.0 - (np.arange(2 * ROWS) + 0.5) / (2 * ROWS) * 360.0)
    flat = np.cos(declination)
    places = np.stack(
        np.broadcast_arrays(
            flat * np.cos(ascension), flat * np.sin(ascension), np.sin(declination)
        ),
        axis=-1,
    )
    weights = np.broadcast_to(flat, structure.shape) / (flat.sum() * 2 * ROWS)
    sine = places @ galactic_axes()[2]
    around = POLE * 1.25 / (np.abs(sine) + 0.25)
    bright = 1e4 * float((10.0 ** (-0.4 * stars().magnitudes)).sum()) / 41_253.0
    cloud = near(places, SAGITTARIUS)
    low, high = 0.2, 1.0
    for _ in range(40):
        power = 0.5 * (low + high)
        shape = structure**power
        factor = (MEAN - bright - (weights * around).sum()) / (weights * shape).sum()
        found = (around + factor * shape)[cloud].mean()
        low, high = (power, high) if found < CLOUD else (low, power)
    whole = around + factor * shape
    codes = np.rint(255.0 * np.sqrt(np.minimum(whole / BRIGHTEST, 1.0))).astype(np.uint8)
    Image.fromarray(codes).save(TARGET, optimize=True)
    print(f"{TARGET.name}: {TARGET.stat().st_size} bytes, power {power:.3f}, max {whole.max():.0f}")
    for name, place in (
        ("Sagittarius", SAGITTARIUS),
        ("Scutum", (27.0, -3.0)),
        ("Cygnus", (75.0, 1.0)),
        ("rift", (40.0, 1.0)),
        ("Carina", (287.0, -1.0)),
        ("anticentre", (180.0, 0.0)),
        ("pole", (0.0, 90.0)),
    ):
        print(f"{name:12} {27.78 - 2.5 * np.log10(whole[near(places, place)].mean()):.2f} mag")


def near(places: NDArray[np.float64], galactic: tuple[float, float]) -> NDArray[np.bool_]:
    """Places around galactic coordinates."""
    l, b = np.radians(galactic)
    towards = np.array([np.cos(b) * np.cos(l), np.cos(b) * np.sin(l), np.sin(b)])
    return np.asarray(places @ (towards @ galactic_axes()) > np.cos(np.radians(RADIUS)))


if __name__ == "__main__":
    main()
