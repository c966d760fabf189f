"""Planets of the energy suite: furnaces, and Earths with and without curvature."""

from __future__ import annotations

from typing import Final

from airlight.planets import Constituent, Ground, Planet, Star, replace
from airlight.planets.matter.phases import HenyeyGreenstein, Rayleigh
from airlight.planets.matter.profiles import Exponential
from airlight.planets.spectral import PerWavelength
from airlight.validation.reference_earth import (
    CORRECTED_ABSORPTION,
    WAVELENGTHS,
    reference_earth,
)

#: Radius of the flat Earth over that of the round Earth.
VAST: Final = 1000.0


def furnace(albedo: float) -> Planet:
    """Conservative gas and haze over a Lambert ground.

    The gas has three optical depths, one per wavelength; the star is a point of irradiance 1.

    Parameters
    ----------
    albedo : float
        Albedo of the ground; 1 for the white furnace. [1]
    """
    gas = PerWavelength(wavelengths=WAVELENGTHS, values=(5.8e-6, 13.5e-6, 33.1e-6))
    return Planet(
        name="furnace",
        bottom_radius=6360e3,
        top_radius=6460e3,
        ground=Ground(albedo=albedo),
        star=Star(irradiance=1.0, angular_radius=0.0),
        constituents=(
            Constituent(
                name="gas",
                profile=Exponential(scale_height=8e3),
                scattering=gas,
                phase_function=Rayleigh(),
            ),
            Constituent(
                name="haze",
                profile=Exponential(scale_height=2e3),
                scattering=5e-5,
                phase_function=HenyeyGreenstein(asymmetry=0.6),
            ),
        ),
    )


def round_earth() -> Planet:
    """AP2's clear Earth with the corrected aerosol, ground albedo 0.1 and a point star."""
    return reference_earth(albedo=0.1, aerosol_absorption=CORRECTED_ABSORPTION)


def flat_earth() -> Planet:
    """Plane-parallel limit of ``round_earth``: a ground radius a thousand times as large."""
    earth = round_earth()
    bottom = VAST * earth.bottom_radius
    return replace(
        earth, name="flat Earth", bottom_radius=bottom, top_radius=bottom + earth.thickness
    )
