"""Remake ``validation/data/cloudy-lines.csv``: radiances past cumuli by Monte Carlo.

Run with ``python builders/cloudy_lines.py [ERROR]``, with the relative standard error of a
radiance at most, 0.05 by default: four minutes of a core.
"""

from __future__ import annotations

import sys
from pathlib import Path

from airlight.validation.cloudy_lines import FILE, SUNS, VIEWS, traced

OUT = Path(__file__).parents[1] / "src" / "airlight" / "validation" / FILE
HEAD = """\
# Radiance of lines of sight past cumuli in spherical air per irradiance of the sun, by Monte Carlo
# (CloudyAir), scalar. Planet, field and lines: validation/cloudy_lines.py, whose VIEWS are counted.
# Made by builders/cloudy_lines.py.
sun_zenith,view,radiance,error
"""


def main() -> None:
    """Trace all lines and write the file."""
    found = traced(float(sys.argv[1]) if len(sys.argv) > 1 else 0.05)
    numbers = [(sun, view) for sun in SUNS for view in range(len(VIEWS))]
    rows = [
        f"{sun:g},{view},{radiance:.4g},{error:.2g}"
        for (sun, view), radiance, error in zip(
            numbers, found.total[:, 0], found.total_error[:, 0], strict=True
        )
    ]
    OUT.write_text(HEAD + "\n".join(rows) + "\n")


if __name__ == "__main__":
    main()
