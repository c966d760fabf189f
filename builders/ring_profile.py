"""Remake ``rings-saturn.csv``: optical depth of Saturn's rings by radius.

Run with ``python builders/ring_profile.py FILE``, where FILE is
``source_data/rings/transparency.txt`` of the public repository ivoyager/ivbinary_maker (as of
edfca9aac4bb): transmittance at 13 177 radii from 74 510 to 140 390 km, by Björn Jónsson
(bjj.mmedia.is/data/s_rings). Four of them make a row, whose optical depth is that of their mean
transmittance.
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
FROM = "from stellar occultations in the archive of NASA's PDS"
WORDS = "the author's words, in the copyright file of Debian's stellarium-data"
HEADER = (
    "# quantity: normal optical depth of Saturn's rings, means of transmittance over 20 km",
    "# unit: km, 1",
    f"# source: Björn Jónsson, transparency of Saturn's rings, bjj.mmedia.is/data/s_rings, {FROM}",
    "# read through: ivoyager/ivbinary_maker, source_data/rings/transparency.txt",
    f"# licence: free to use if the origin is mentioned ({WORDS})",
    "# note: 4 stands where nothing was seen through. The F ring is one cut of an eccentric ring.",
    "radius_km,optical_depth",
)


def main() -> None:
    """Turn transmittances into optical depths."""
    given = np.loadtxt(sys.argv[1])
    if given.size != NUMBER:
        raise SystemExit(f"{given.size} transmittances, not {NUMBER}")
    radii = np.linspace(FIRST, LAST, NUMBER)
    whole = NUMBER // TOGETHER * TOGETHER
    mean = given[:whole].reshape(-1, TOGETHER).mean(axis=1)
    depth = -np.log(np.clip(mean, np.exp(-OPAQUE), 1.0))
    middle = radii[:whole].reshape(-1, TOGETHER).mean(axis=1)
    rows = (f"{r:g},{d:.3g}" for r, d in zip(middle.tolist(), depth.tolist(), strict=True))
    FILE.write_text("\n".join((*HEADER, *rows)) + "\n", encoding="utf-8")
    print(f"{FILE.name}: {middle.size} rows")


if __name__ == "__main__":
    main()
