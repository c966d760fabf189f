"""Remake ``full-disc-albedos.csv``: what telescopes see of the giant planets and Titan, by
Karkoschka (1998).

Run with ``python builders/planet_albedos.py FOLDER``, where FOLDER is ``spectra/files/Karkoschka``
of the public repository Askaniy/TrueColorTools (as of 808d62e1f731): the albedos of ``1995low.tab``
(NASA PDS, volume GBAT_0001), a file for each planet. The PDS's own table was not read.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

FILE = (
    Path(__file__).parents[1] / "src" / "airlight" / "validation" / "data" / "full-disc-albedos.csv"
)
PLANETS = ("Jupiter", "Saturn", "Uranus", "Neptune", "Titan")
#: Wavelengths, and the width of the means. [nm]
WAVELENGTHS = np.arange(360.0, 761.0, 10.0)
WIDTH = 10.0
HEADER = """\
# Albedo of the full disc in July 1995, means over 10 nm: Karkoschka (1998), Methane, ammonia, and
# temperature measurements of the Jovian planets and Titan from CCD-spectrophotometry, Icarus 133,
# 134, doi:10.1006/icar.1998.5913; NASA PDS GBAT_0001, 1995low.tab; second-hand, from files of
# Askaniy/TrueColorTools. Phase angles 6.8, 5.7, 0.7, 0.3 and 5.7 degrees; calibration 4 %;
# Saturn without rings. Licence: figures of a public archive. Made by builders/planet_albedos.py.
"""


def main() -> None:
    """Average the spectra and write the table."""
    columns = []
    for name in PLANETS:
        nm, albedo = np.loadtxt(Path(sys.argv[1]) / f"{name}1995.txt", unpack=True)
        near = np.abs(nm - WAVELENGTHS[:, None] + 1e-9) <= 0.5 * WIDTH
        columns.append((near * albedo).sum(axis=1) / near.sum(axis=1))
    rows = [HEADER, ",".join(["wavelength_nm", *(name.lower() for name in PLANETS)]), "\n"]
    for nm, *values in zip(WAVELENGTHS, *columns, strict=True):
        rows.append(",".join([f"{nm:g}", *(f"{value:.4f}" for value in values)]) + "\n")
    FILE.write_text("".join(rows), encoding="utf-8")
    print(f"{FILE.name}: {WAVELENGTHS.size} rows, {FILE.stat().st_size} bytes")


if __name__ == "__main__":
    main()
