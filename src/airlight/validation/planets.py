"""Planets of the suites: a furnace, air of one constituent, grounds so vast that they are flat."""

from __future__ import annotations

from typing import Any, Final

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


def flattened(planet: Planet) -> Planet:
    """Plane-parallel limit of ``round_earth``: a ground radius a thousand times as large."""
    bottom = VAST * planet.bottom_radius
    return replace(planet, bottom_radius=bottom, top_radius=bottom + planet.thickness)


def flat_earth() -> Planet:
    """Flat ``round_earth``."""
    return replace(flattened(round_earth()), name="flat Earth")


def with_point_star(planet: Planet) -> Planet:
    """The planet under a point star of the same irradiance."""
    return replace(planet, star=replace(planet.star, angular_radius=0.0))


def one_constituent(
    name: str, bottom_radius: float, thickness: float, albedo: float, **constituent: Any
) -> Planet:
    """Air of one constituent under a point star of irradiance 1.

    Parameters
    ----------
    name : str
    bottom_radius, thickness : float
        Radius of the ground, and height of the air above it. [m]
    albedo : float
        Albedo of the ground. [1]
    constituent
        Keywords of ``Constituent``.
    """
    return Planet(
        name=name,
        bottom_radius=bottom_radius,
        top_radius=bottom_radius + thickness,
        ground=Ground(albedo=albedo),
        star=Star(irradiance=1.0, angular_radius=0.0),
        constituents=(Constituent(name="gas", **constituent),),
    )
