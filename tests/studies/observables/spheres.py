"""Planets whose light as a whole is known in closed form."""

from __future__ import annotations

from airlight.planets import Constituent, Ground, Planet, Star
from airlight.planets.matter.phases import Rayleigh
from airlight.planets.matter.profiles import Exponential

#: Radius of the ground, and scale height of the air. [m]
RADIUS, HEIGHT = 6360e3, 8e3


def sphere(depth: float, albedo: float, *, star: Star | None = None) -> Planet:
    """Ground under gas of a vertical optical depth that absorbs nothing."""
    return Planet(
        name="sphere",
        bottom_radius=RADIUS,
        top_radius=RADIUS + 120e3,
        ground=Ground(albedo=albedo),
        star=star or Star(irradiance=1.0, angular_radius=0.0),
        constituents=(
            Constituent(
                name="gas",
                profile=Exponential(scale_height=HEIGHT),
                scattering=max(depth, 1e-24) / HEIGHT,
                phase_function=Rayleigh(),
            ),
        ),
    )
