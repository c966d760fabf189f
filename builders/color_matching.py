"""Remake ``cie-1931.csv``: the 2 degree colour-matching functions, from colour-science.

Run with ``python builders/color_matching.py`` where colour-science is installed.
"""

from __future__ import annotations

import numpy as np
from colour import MSDS_CMFS

from tables import write_table


def main() -> None:
    """Write the 471 rows from 360 to 830 nm as they are."""
    functions = MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
    wavelengths = np.asarray(functions.wavelengths, dtype=np.float64)
    np.testing.assert_array_equal(wavelengths, np.arange(360.0, 831.0))
    path = write_table(
        "cie-1931",
        {
            "quantity": "colour-matching functions of the CIE 1931 2 degree standard observer",
            "unit": "1",
            "source": "ISO/CIE 11664-1:2019, Colorimetry, Part 1: CIE standard colorimetric "
            "observers, at 1 nm; as shipped by colour-science 0.4.7",
            "licence": "published by the CIE; colour-science is BSD-3-Clause",
        },
        ["x", "y", "z"],
        wavelengths,
        np.asarray(functions.values),
        digits=13,
    )
    print(f"{path.name}: {len(wavelengths)} rows")


if __name__ == "__main__":
    main()
