"""Remake ``earth-albedo.csv``: the mean reflectance of the Earth by its map, over wavelength.

Run with ``python builders/earth_albedo_spectrum.py`` after ``earth_map.py``; it needs airlight
itself and nothing else.
"""

from __future__ import annotations

import numpy as np

from airlight.image.upsampling import reflectance_basis
from airlight.physics.optics.water import mean_specular
from airlight.scene.surface_map import surface_map
from tables import write_table

#: Wind speed over the sea, that of the presets. [m s⁻¹]
WIND = 5.0


def main() -> None:
    """Write the mean colour of the map, spread from 280 to 1000 nm, held to 2500."""
    wavelengths = np.append(np.arange(280.0, 1001.0, 10.0), 2500.0)
    earth = surface_map("earth")
    mean, water = earth.mean_rgb, earth.mean_water
    mirrored = water * mean_specular(WIND)
    reflectance = np.clip(reflectance_basis(wavelengths) @ mean, 0.0, 1.0) + mirrored
    path = write_table(
        "earth-albedo",
        {
            "quantity": "mean reflectance of the Earth's cloudless ground and sea",
            "unit": "1",
            "source": "area-weighted mean of the packaged map of the Earth (NASA Blue Marble Next "
            "Generation, see scene/data/SOURCES.md), its linear sRGB colour "
            f"({mean[0]:.4f}, {mean[1]:.4f}, {mean[2]:.4f}) spread over wavelength by the "
            f"smoothest reflectance of that colour, and {mirrored:.4f} that its water ({water:.4f} "
            f"of the area) mirrors of a uniform sky at {WIND:g} m/s (optics/water.py)",
            "licence": "public domain (NASA)",
        },
        ["reflectance"],
        wavelengths,
        reflectance[:, None],
        digits=5,
    )
    print(f"{path.name}: {len(wavelengths)} rows")


if __name__ == "__main__":
    main()
