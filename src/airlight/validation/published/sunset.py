"""Setting sun: refraction on the horizon, and the flattening of the disc.

Meeus (1998), Astronomical Algorithms, second edition: refraction is 34' on the horizon (chapter 15)
and 28.75' half a degree above it (chapter 16, example a), at 10 °C and 1010 hPa. By equations 16.3
(Bennett) and 16.4 (Sæmundsson) a sun of 32' on the horizon is 26.9' high, 0.84 of its width.
Numbers are taken from programs after the book, not checked against it.
"""

from __future__ import annotations

from math import asin, degrees, radians, sin
from typing import Final

import numpy as np

from airlight.geometry.refraction import apparent_sun
from airlight.planets import Medium, Planet, load_planet
from airlight.solver.refracted_geometry import RefractedGeometry
from airlight.validation.published.row import PublishedRow, PublishedSection

#: Angular diameter of the sun at 1 au. [deg]
DIAMETER: Final = 2.0 * 0.2665
#: Wavelength of the medium, whose refractivity is used for all. [nm]
_NM: Final = 550.0


def refraction(geometry: RefractedGeometry, seen: float) -> float:
    """Refraction of a star seen from the ground. [deg]

    Parameters
    ----------
    seen : float
        Apparent altitude of the star. [deg]
    """
    x = geometry.optical_radius(np.array([geometry.medium.bottom_radius]))
    if geometry.shell is not None:
        x = np.array([geometry.shell.bottom])
    return degrees(float(geometry.refraction_angle(x, np.array([sin(radians(seen))]))[0]))


def flattening(geometry: RefractedGeometry, diameter: float = DIAMETER) -> float:
    """Height over width of a star whose lower limb touches the horizon of the ground. [1]

    Parameters
    ----------
    diameter : float
        True angular diameter of the star. [deg]
    """
    bottom, top = geometry.medium.bottom_radius, geometry.medium.top_radius
    if geometry.shell is not None:
        bottom, top = geometry.shell.bottom, geometry.shell.top
    low = -refraction(geometry, 0.0)
    limbs = [
        asin(
            float(
                apparent_sun(bottom, sin(radians(true)), bottom, top, geometry.refraction_table)[0]
            )
        )
        for true in (low, low + diameter)
    ]
    return degrees(limbs[1] - limbs[0]) / diameter


def geometry_of(planet: Planet) -> RefractedGeometry:
    """Refracted geometry of a planet."""
    return RefractedGeometry.of(Medium.from_planet(planet, (_NM,)))


def sunset() -> PublishedSection:
    """Refraction and flattening of preset ``earth``."""
    geometry = geometry_of(load_planet("earth"))
    meeus = "Meeus (1998), chapter"
    seen = {altitude: 60.0 * refraction(geometry, altitude) for altitude in (0.0, 0.5)}
    high, flat = "height over width of the sun on the horizon", flattening(geometry)
    return PublishedSection(
        title="Setting sun",
        rows=[
            PublishedRow("refraction on the horizon", 34.0, seen[0.0], f"{meeus} 15", "′"),
            PublishedRow("refraction half a degree above", 28.75, seen[0.5], f"{meeus} 16", "′"),
            PublishedRow(high, 0.84, flat, f"{meeus} 16, equations 3 and 4"),
        ],
        note="At sea level in the U.S. Standard Atmosphere, 15 °C; the published numbers are for "
        "10 °C and 1010 hPa, where air bends light by 1.4 % more. The lapse rate near the ground "
        "moves the height by 0.015.",
    )
