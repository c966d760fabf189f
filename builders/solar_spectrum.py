"""Remake ``astm-g173.csv``: the sun outside the air, from the copy of ASTM G-173 in pvlib.

Run with ``python builders/solar_spectrum.py`` where pvlib is installed.
"""

from __future__ import annotations

import numpy as np
from pvlib.spectrum import get_reference_spectra

from tables import write_table

#: First wavelength of the standard, and the last at which its step is one nanometre or less. [nm]
FIRST, EVERY = 280, 1700


def main() -> None:
    """Keep the rows at whole nanometres; the standard's step is 0.5 nm below 400 nm."""
    spectrum = get_reference_spectra(standard="ASTM G173-03")["extraterrestrial"]
    beyond = spectrum.index[spectrum.index > EVERY].to_numpy(float)
    wavelengths = np.concatenate([np.arange(FIRST, EVERY + 1.0), beyond])
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
                "Rows at whole nanometres, 280 to 4000 nm, as printed; none is interpolated.",
                "Their step is 1 nm to 1700 nm; then follow 1702 nm and every 5 nm from 1705 nm.",
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
