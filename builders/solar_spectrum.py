"""Remake ``astm-g173.csv``: the sun outside the air, from the copy of ASTM G-173 in pvlib.

Run with ``python builders/solar_spectrum.py`` where pvlib is installed.
"""

from __future__ import annotations

import numpy as np
from pvlib.spectrum import get_reference_spectra

from tables import write_table

FIRST, LAST = 280, 1000  # nm; the standard begins at 280


def main() -> None:
    """Keep the rows at whole nanometres; below 400 nm the standard's step is 0.5 nm."""
    spectrum = get_reference_spectra(standard="ASTM G173-03")["extraterrestrial"]
    wavelengths = np.arange(FIRST, LAST + 1.0)
    values = spectrum.loc[wavelengths].to_numpy()[:, None]  # fails if a row is missing
    path = write_table(
        "astm-g173",
        {
            "quantity": "extraterrestrial solar spectral irradiance at 1 au",
            "unit": "W m^-2 nm^-1",
            "source": "ASTM G173-03 (2020), Standard Tables for Reference Solar Spectral "
            "Irradiances, column 'extraterrestrial'; as shipped by pvlib 0.16.1 (ASTMG173.csv)",
            "licence": "published by the National Laboratory of the Rockies (formerly NREL) for "
            "free use; pvlib is BSD-3-Clause",
            "note": [
                "Rows at whole nanometres, 280 to 1000 nm, as printed; none is interpolated.",
                "Below 400 nm the standard also has rows at half nanometres; they are left out.",
            ],
        },
        ["irradiance"],
        wavelengths,
        values,
        digits=6,
    )
    print(f"{path.name}: {len(wavelengths)} rows")


if __name__ == "__main__":
    main()
