"""Remake ``rings-saturn.csv``: optical depth and brightness of Saturn's rings by radius.

Run with ``python builders/ring_profile.py FOLDER``, where FOLDER is ``source_data/rings`` of the
public repository ivoyager/ivbinary_maker (as of edfca9aac4bb): transmittance and brightness of the
lit side at 13 177 radii from 74 510 to 140 390 km, by Björn Jónsson (bjj.mmedia.is/data/s_rings).
Four of them make a row, whose optical depth is that of their mean transmittance. Brightness is
divided by that of a layer of this depth, where it is above 0.3, and counts as linear.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

FILE = Path(__file__).parents[1] / "src/airlight/physics/optics/data/rings-saturn.csv"
#: Radii of the first and last number [km], their number, and that of those in a row.
FIRST, LAST, NUMBER, TOGETHER = 74_510.0, 140_390.0, 13_177, 4
#: Optical depth of a row through which nothing was seen. [1]
OPAQUE = 4.0
#: Optical depth below which brightness does not separate albedo from depth, and air mass: the sum
#: of the inverse cosines of star and observer, by eye for low elevations. [1]
THIN, AIR_MASS = 0.3, 6.0
FROM = "transparency and backscattered light, from data of NASA's PDS"
WORDS = "the author's words, in the copyright file of Debian's stellarium-data"
HEADER = (
    "# quantity: normal optical depth of Saturn's rings, and relative albedo of their particles",
    "# unit: km, 1, 1",
    f"# source: Björn Jónsson, bjj.mmedia.is/data/s_rings, {FROM}",
    "# read through: ivoyager/ivbinary_maker, source_data/rings",
    f"# licence: free to use if the origin is mentioned ({WORDS})",
    "# note: means of transmittance over 20 km; 4 stands where nothing was seen through",
    "# note: the F ring is one cut of an eccentric ring",
    "radius_km,optical_depth,brightness",
)


def main() -> None:
    """Turn transmittances into optical depths."""
    given, lit = (
        np.loadtxt(Path(sys.argv[1]) / f"{name}.txt") for name in ("transparency", "backscattered")
    )
    if given.size != NUMBER:
        raise SystemExit(f"{given.size} transmittances, not {NUMBER}")
    radii = np.linspace(FIRST, LAST, NUMBER)
    whole = NUMBER // TOGETHER * TOGETHER
    mean = given[:whole].reshape(-1, TOGETHER).mean(axis=1)
    depth = -np.log(np.clip(mean, np.exp(-OPAQUE), 1.0))
    middle = radii[:whole].reshape(-1, TOGETHER).mean(axis=1)
    light = lit[:whole].reshape(-1, TOGETHER).mean(axis=1) / -np.expm1(-AIR_MASS * depth - 1e-9)
    columns = middle.tolist(), depth.tolist(), np.where(depth > THIN, light, 1.0).tolist()
    rows = (f"{r:g},{d:.3g},{b:.3g}" for r, d, b in zip(*columns, strict=True))
    FILE.write_text("\n".join((*HEADER, *rows)) + "\n", encoding="utf-8")
    print(f"{FILE.name}: {middle.size} rows")


if __name__ == "__main__":
    main()
