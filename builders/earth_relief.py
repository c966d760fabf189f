"""Remake ``scene/data/earth-relief.png`` from NASA's picture of the Earth's topography.

Run with ``python builders/earth_relief.py FILE.png``, the file ``example/img/earth-topology.png``
(2048 x 1024) of the npm package three-globe 2.45.2: heights of GEBCO_08, black for sea level, white
for 6400 m and above.
"""

from __future__ import annotations

import sys
from pathlib import Path

from PIL import Image

TARGET = Path(__file__).parents[1] / "src" / "airlight" / "scene" / "data" / "earth-relief.png"


def main() -> None:
    """Save the heights alone, without colour profile."""
    if len(sys.argv) < 2:
        sys.exit("give the file example/img/earth-topology.png of three-globe 2.45.2")
    with Image.open(sys.argv[1]) as picture:
        heights = Image.frombytes("L", picture.size, picture.convert("L").tobytes())
    heights.save(TARGET, optimize=True)
    print(f"{TARGET.name}: {TARGET.stat().st_size} bytes")


if __name__ == "__main__":
    main()
