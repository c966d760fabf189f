"""Remake ``methane-bands.csv``: what cold methane absorbs in the visible, by Karkoschka (1998).

Run with ``python builders/methane.py FILE``, where FILE is ``docs/reports/titan-mc.json`` of the
public repository migujorg/claude-space-thing (as of 1fbf3cfe8b5d): optical depths of Titan's
methane straight down, means over 10 nm of the coefficients of ``1995low.tab`` (NASA PDS, volume
GBAT_0001) times the 2.80 km-amagat that Huygens found. They are divided by that column again; the
PDS's own table was not read.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np

from tables import write_table

#: First wavelength and step of the file, in standard air, and their number. [nm]
FIRST, STEP, NUMBER = 360.0, 10.0, 48
#: Methane above Titan's ground: 2.80 km at 0 °C and 101 325 Pa. [m^-2]
COLUMN = 2.80e3 * 101_325.0 / (1.380649e-23 * 273.15)


def main() -> None:
    """Turn optical depths into cross-sections."""
    given = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
    depth = np.array(given["inputs"]["columnOpticalDepth"]["methane"])
    if depth.size != NUMBER:
        raise SystemExit(f"{depth.size} optical depths of methane, not {NUMBER}")
    nm = FIRST + STEP * np.arange(NUMBER)
    path = write_table(
        "methane-bands",
        {
            "quantity": "effective absorption cross-section of cold methane, mean over 10 nm",
            "unit": "m^2",
            "source": "Karkoschka (1998), Methane, ammonia, and temperature measurements of the "
            "Jovian planets and Titan from CCD-spectrophotometry, Icarus 133, 134, "
            "doi:10.1006/icar.1998.5913; its table in NASA PDS GBAT_0001, 1995low.tab; "
            "second-hand, from optical depths of Titan's 2.80 km-amagat",
            "licence": "figures of a public archive",
            "note": [
                "1e-29 m^2 are 0.269 per km-amagat. Made from spectra of the outer planets and",
                "Titan with paths of a few km-amagat, and right for such paths: lines saturate, so",
                "shorter paths take more and longer ones less than Beer's law with these. The mean",
                "over 10 nm of the coefficient takes more than the band where it is dark (730 nm).",
                "Wavelengths in air.",
            ],
        },
        ["cross_section"],
        nm,
        (depth / COLUMN)[:, None],
        digits=4,
    )
    print(f"{path.name}: {nm.size} rows, {COLUMN:.4g} m^-2")


if __name__ == "__main__":
    main()
