"""Synthetic skies of known parameters, with noise of known size."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from airlight.planets import load_planet
from airlight.solver import solve
from airlight.studies.fit.measurements import Measurements
from airlight.studies.fit.sky_model import smooth

PLANET: Final = "earth-atmosphere-plus"
#: Relative standard deviation of the noise.
NOISE: Final = 0.02
WAVELENGTHS: Final = (440.0, 550.0, 680.0)


def clean_sky(
    changes: Mapping[str, Any],
    suns: tuple[float, ...] = (40.0, 60.0, 75.0, 85.0),
    wavelengths: tuple[float, ...] = WAVELENGTHS,
) -> Measurements:
    """Radiances of a planet with changes of its file, without noise."""
    sun, view, azimuth = np.meshgrid(suns, (5.0, 35.0, 60.0, 80.0), (10.0, 70.0, 170.0))
    solution = solve(load_planet(PLANET, changes), wavelengths, smooth("preview"), cache=False)
    seen = solution.radiance(
        altitude=0.0, sun_zenith=sun.ravel(), view_zenith=view.ravel(), azimuth=azimuth.ravel()
    )
    count = len(wavelengths)

    def each(values: np.ndarray) -> np.ndarray:
        return np.repeat(values.ravel(), count)

    numbers = np.unique(each(sun), return_inverse=True)[1].reshape(-1)
    return Measurements(
        source="synthetic", wavelength=np.tile(wavelengths, sun.size), altitude=0.0 * each(sun),
        sun_zenith=each(sun), view_zenith=each(view), azimuth=each(azimuth),
        radiance=seen.values.ravel().astype(float), uncertainty=None, scan=numbers,
        scans=tuple(f"sun {one:g}°" for one in suns),
    )  # fmt: skip


def noisy(clean: Measurements, seed: int, share: float = NOISE) -> Measurements:
    """The sky with Gaussian noise, and its size as uncertainty."""
    from dataclasses import replace

    size = share * clean.radiance
    noise = np.random.default_rng(seed).standard_normal(size.shape)
    return replace(clean, radiance=clean.radiance + size * noise, uncertainty=size)
