"""Lines of sight past cumuli in spherical air: 60 radiances by Monte Carlo."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_layer import CloudLayer
from airlight.clouds.cloud_optics import CloudOptics
from airlight.clouds.planet_clouds import Box, clouds_of
from airlight.planets import Medium, Planet, load_planet
from airlight.solver.montecarlo.cloudy_air import CloudyAir
from airlight.solver.montecarlo.estimate import Estimate
from airlight.solver.montecarlo.settings import MonteCarloSettings
from airlight.solver.montecarlo.solution import MonteCarloSolution
from airlight.validation.reference_files import packaged_table

FloatArray = NDArray[np.float64]

#: File of this package with radiances of Monte Carlo, made by ``builders/cloudy_lines.py``.
FILE: Final = "data/cloudy-lines.csv"
#: Place of the field. [deg]
LATITUDE, LONGITUDE = 10.0, 20.0
#: Wavelength. [nm]
WAVELENGTH: Final = 550.0
#: Zenith angles of the sun, which is in the east. [deg]
SUNS: Final = (20.0, 45.0, 60.0, 75.0, 85.0)
SUN_AZIMUTH: Final = 90.0
#: Altitude of the observer above the place of the field, view zenith angle, and azimuth from the
#: sun: on the ground, at 3 km, in an airliner and in orbit. Lines end within the box of the field,
#: beyond which pictures do not repeat it. [m], [deg]
VIEWS: Final = (
    (0.0, 20.0, 0.0),
    (0.0, 45.0, 90.0),
    (0.0, 60.0, 180.0),
    (0.0, 80.0, 45.0),
    (3e3, 100.0, 90.0),
    (3e3, 120.0, 0.0),
    (3e3, 150.0, 180.0),
    (11e3, 130.0, 30.0),
    (11e3, 140.0, 135.0),
    (11e3, 180.0, 0.0),
    (400e3, 180.0, 0.0),
    (400e3, 179.5, 90.0),
)


def cumuli_over_sea() -> Planet:
    """Earth with cumuli above a ground as dark as the sea, without refraction."""
    clouds = [{"kind": "cumulus", "organisation": 0.0}]
    earth = load_planet("earth", {"refraction": "none", "ground.albedo": 0.06, "clouds": clouds})
    plain = replace(earth.ground, map=None, relief=None, clouds_from_space=None, lights=None)
    return replace(earth, ground=plain)


def field_at(wavelengths: ArrayLike) -> tuple[CloudField, CloudOptics]:
    """Field, and optical properties of its droplets at wavelengths [nm]."""
    box = Box(latitude=LATITUDE, longitude=LONGITUDE)
    return clouds_of(cumuli_over_sea(), wavelengths, box)[0]


def traced(relative_error: float, chosen: NDArray[np.bool_]) -> Estimate:
    """Radiances of lines by Monte Carlo, those of the first sun first, in scalar transfer.

    Parameters
    ----------
    relative_error : float
        Standard error over each radiance. [1]
    chosen : array of bool, shape (suns, views)
        Lines.
    """
    settings = MonteCarloSettings(
        relative_error=relative_error, polarisation=False, exact_first_order=False
    )
    medium = Medium.from_planet(cumuli_over_sea().without_clouds, [WAVELENGTH])
    air = CloudyAir(MonteCarloSolution(medium, settings), [CloudLayer(*field_at([WAVELENGTH]))])
    sun, view = np.nonzero(chosen)
    views = np.array(VIEWS)[view]
    return air.radiance(
        latitude=LATITUDE,
        longitude=LONGITUDE,
        altitude=views[:, 0],
        view_zenith=views[:, 1],
        azimuth=views[:, 2] + SUN_AZIMUTH,
        sun_zenith=np.array(SUNS)[sun],
        sun_azimuth=SUN_AZIMUTH,
    )


def reference() -> tuple[FloatArray, FloatArray]:
    """Radiances by Monte Carlo and their standard errors. [sr⁻¹]

    Returns
    -------
    radiance, error : array, shape (suns, views)
        Per irradiance of the sun.
    """
    table = packaged_table(FILE)
    radiance, error = table[:, 2:4].T.reshape(2, len(SUNS), len(VIEWS))
    return radiance, error
