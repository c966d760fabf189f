"""Remake ``validation/data/i3rc-*.csv``: consensus results of I3RC phase I, and case 2's field.

Run with ``python builders/i3rc.py FOLDER``. The folder has ``case1`` and ``case2`` with the files
of NASA's archives ``consensus_result_case1.tar`` and ``consensus_result_case2.tar`` (each in
``consensus_results``) and ``mmcr_tau_32km_020898``, the optical depths of case 2.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

DATA = Path(__file__).parents[1] / "src" / "airlight" / "validation" / "data"
SOURCE = """\
# Intercomparison of 3D Radiation Codes, phase I, case {case}: {what}
# Source: NASA I3RC, i3rc.gsfc.nasa.gov; Cahalan et al. (2005), The I3RC: Bringing Together the Most
# Advanced Radiative Transfer Tools for Cloudy Atmospheres, BAMS 86, 1275,
# doi:10.1175/BAMS-86-9-1275. Work of the United States Government, not subject to copyright.
# Made by builders/i3rc.py.
"""
RESULTS = """\
consensus results, one row a column of
# the field from low x. R, T, A: fluxes over the incident one; Iu, I601, I602, Id: pi L over it, of
# views from above to the nadir and at 60 degrees, of light that goes on in the sun's azimuth (1)
# and back (2), and from below to the zenith."""
FIELD = """\
optical depth of each cell,
# one row a layer from the highest, one column a column of the field from low x."""


def write(name: str, header: str, columns: list[str], rows: np.ndarray) -> None:
    """Write a table of the package."""
    lines = [",".join(f"{value:.5g}" for value in row) for row in rows]
    text = header + ",".join(columns) + "\n" + "\n".join(lines) + "\n"
    (DATA / name).write_text(text, encoding="utf-8")


def main(folder: Path) -> None:
    """Write the three tables."""
    for case in (1, 2):
        start = f"I3RC_cons_res_case{case}_"
        files = sorted((folder / f"case{case}" / "consensus_results").glob(f"{start}*.txt"))
        names = [file.stem.removeprefix(start) for file in files]
        table = np.stack([np.loadtxt(file).ravel() for file in files], axis=1)
        write(f"i3rc-case{case}.csv", SOURCE.format(case=case, what=RESULTS), names, table)
    depth = np.loadtxt(folder / "case2" / "mmcr_tau_32km_020898")
    columns = [str(k) for k in range(depth.shape[1])]
    write("i3rc-case2-depth.csv", SOURCE.format(case=2, what=FIELD), columns, depth)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
