"""Remake ``water-vapour-bands.csv``: what water vapour absorbs in the visible, by Bird & Riordan.

Run with ``python builders/water_vapour.py FILE``, where FILE is ``pvlib/spectrum/spectrl2.py`` of
the wheel of pvlib 0.16.1 (``pip download --no-deps pvlib==0.16.1``), which has the table of the
report as lists; only these are read.
"""

from __future__ import annotations

import ast
import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tables import write_table

FloatArray = NDArray[np.float64]

#: Water of the U.S. Standard Atmosphere, 1976, and the way that the table is right for.
WATER, AIRMASS = 1.42, 1.5  # cm; 1
#: Molecules above a square metre. [m^-2]
COLUMN = WATER * 1e4 / 18.01528 * 6.02214076e23
FIRST, LAST = 300.0, 1000.0
AIRMASSES = (0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0)


def coefficients(path: Path) -> tuple[FloatArray, FloatArray]:
    """Wavelengths [nm] and water vapour's coefficients of the report's table."""
    found: dict[str, FloatArray] = {}
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Subscript):
            key = node.targets[0].slice
            if isinstance(key, ast.Constant) and isinstance(node.value, ast.List):
                found[str(key.value)] = np.array(ast.literal_eval(node.value))
    return found["wavelength"], found["water_vapor_absorption"]


def optical_depth(coefficient: FloatArray, airmass: float) -> FloatArray:
    """-ln T of eq. 2-8, with the water of the standard atmosphere. [1]"""
    amount = coefficient * WATER * airmass
    return 0.2385 * amount / (1.0 + 20.07 * amount) ** 0.45


def main() -> None:
    """Turn the report's transmittances into cross-sections at 1 nm."""
    nm, known = coefficients(Path(sys.argv[1]))
    shown = np.arange(FIRST, LAST + 1.0)
    at_reference = optical_depth(known, AIRMASS) / AIRMASS
    errors = []
    for centre in (593.0, 724.4, 937.0):
        row = int(np.argmin(np.abs(nm - centre)))
        true = np.array([np.exp(-optical_depth(known[row], m)) for m in AIRMASSES])
        ours = np.exp(-at_reference[row] * np.array(AIRMASSES))
        pairs = [
            f"{m:g}: {t:.3f} ({100.0 * (o / t - 1.0):+.1f} %)"
            for m, t, o in zip(AIRMASSES, true, ours, strict=True)
        ]
        errors.append(f"{centre:g} nm, transmittance by airmass (error of the table): "
                      + ", ".join(pairs))  # fmt: skip
        print(errors[-1])
    path = write_table(
        "water-vapour-bands",
        {
            "quantity": "effective absorption cross-section of water vapour",
            "unit": "m^2",
            "source": "Bird & Riordan (1984), Simple solar spectral model for direct and diffuse "
            "irradiance on horizontal and tilted planes, SERI/TR-215-2436, doi:10.2172/5986936, "
            "eq. 2-8 and table of coefficients, the copy in pvlib 0.16.1",
            "licence": "public report of the U.S. Department of Energy; pvlib BSD-3-Clause",
            "note": [
                f"-ln T / ({AIRMASS:g} N) at airmass {AIRMASS:g} over {WATER:g} cm of water,",
                f"N = {COLUMN:.4g} m^-2, linear between",
                "the report's wavelengths, which stand for about 10 nm. No Beer's law holds for a",
                "mean over lines: too weak on shorter ways and too strong on longer ones:",
                *errors,
            ],
        },
        ["cross_section"],
        shown,
        np.interp(shown, nm, at_reference / COLUMN)[:, None],
        digits=5,
    )
    print(f"{path.name}: {shown.size} rows")


if __name__ == "__main__":
    main()
