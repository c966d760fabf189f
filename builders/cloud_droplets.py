"""Remake the tables of the flat cloud layer's droplets, ``physics/optics/data/cloud-droplets-*``.

Run with ``python builders/cloud_droplets.py``: exact Mie theory for water, a gamma distribution of
radii, effective radius 10 µm and variance 1/9, the stratus and fair-weather cumulus of
``airlight.planets.clouds``. It takes a minute.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_optics import CloudOptics, droplets
from airlight.physics.optics.droplet_layer import DEGREE, REFERENCE, STEPS

DATA = Path(__file__).parents[1] / "src" / "airlight" / "physics" / "optics" / "data"
RADIUS, VARIANCE = 10e-6, 1.0 / 9.0
#: Wavelengths of the phase functions: 10 % moves the rings of the glory by a tenth of their
#: radius, less than their width. [nm]
WAVELENGTHS = (380.0, 410.0, 440.0, 475.0, 510.0, 550.0, 595.0, 640.0, 690.0, 750.0)
HEADER = (
    "# source: exact Mie theory (airlight.physics.optics.mie) for droplets of water, effective"
    " radius 10 um, effective variance 1/9; made by builders/cloud_droplets.py\n"
    "# licence: CC0\n"
)


def write(name: str, quantity: str, columns: list[str], rows: NDArray[np.float64]) -> None:
    """Write one table, of which the first column is a number of few digits."""
    lines = [f"# quantity: {quantity}\n", HEADER, ",".join(columns) + "\n"]
    lines += [",".join([f"{row[0]:g}", *(f"{x:.5g}" for x in row[1:])]) + "\n" for row in rows]
    path = DATA / f"cloud-droplets-{name}.csv"
    path.write_text("".join(lines), encoding="utf-8")
    print(f"{path.name}: {path.stat().st_size} bytes")


def main() -> None:
    """Compute and write both tables."""
    matter = droplets(RADIUS, VARIANCE)
    moments = CloudOptics.of_particles(matter, [REFERENCE]).phase.moments([REFERENCE], DEGREE)[0]
    degrees = np.arange(DEGREE + 1.0)
    write(
        "moments",
        "Legendre moments of the phase function at 550 nm; unit 1",
        ["degree", "moment"],
        np.stack([degrees, moments], axis=1),
    )
    angles = np.linspace(0.0, 180.0, STEPS + 1)
    phase = CloudOptics.of_particles(matter, WAVELENGTHS).phase
    values = phase.values(np.cos(np.radians(angles)), WAVELENGTHS)
    write(
        "phase",
        "phase function at wavelengths in nm, over the scattering angle in degrees; unit sr^-1",
        ["angle", *(f"{nm:g}" for nm in WAVELENGTHS)],
        np.concatenate([angles[:, None], values], axis=1),
    )


if __name__ == "__main__":
    main()
