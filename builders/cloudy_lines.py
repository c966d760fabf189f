"""Remake ``validation/data/cloudy-lines.csv``: radiances past cumuli by Monte Carlo.

Run with ``python builders/cloudy_lines.py [ERROR] [--only SUN:VIEW ...]``, with the relative
standard error of a radiance at most, 0.05 by default: four minutes of a core. ``--only`` replaces
the lines of these zenith angles of the sun and numbers of views, as ``--only 75:2 85:7``. Streams
of random numbers depend on the line alone: a smaller error continues the histories of a larger one.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from airlight.validation.cloudy_lines import FILE, SUNS, VIEWS, reference, traced

OUT = Path(__file__).parents[1] / "src" / "airlight" / "validation" / FILE
HEAD = """\
# Radiance of lines of sight past cumuli in spherical air per irradiance of the sun, by Monte Carlo
# (CloudyAir), scalar. Planet, field and lines: validation/cloudy_lines.py, whose VIEWS are counted.
# Made by builders/cloudy_lines.py.
sun_zenith,view,radiance,error
"""


def main() -> None:
    """Trace lines and write the file."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("error", nargs="?", type=float, default=0.05)
    parser.add_argument("--only", nargs="+", metavar="SUN:VIEW")
    given = parser.parse_args()
    chosen = np.full((len(SUNS), len(VIEWS)), given.only is None)
    for line in given.only or ():
        sun, view = line.split(":")
        chosen[SUNS.index(float(sun)), int(view)] = True
    radiance, error = np.empty((2, *chosen.shape)) if chosen.all() else reference()
    found = traced(given.error, chosen)
    radiance[chosen], error[chosen] = found.total[:, 0], found.total_error[:, 0]
    rows = [
        f"{sun:g},{view},{radiance[i, view]:.4g},{error[i, view]:.2g}"
        for i, sun in enumerate(SUNS)
        for view in range(len(VIEWS))
    ]
    OUT.write_text(HEAD + "\n".join(rows) + "\n")


if __name__ == "__main__":
    main()
