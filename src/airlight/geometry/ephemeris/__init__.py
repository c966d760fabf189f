"""Positions of sun and moon in the sky of bodies of the solar system."""

from __future__ import annotations

from airlight.geometry.ephemeris.sky import (
    MoonSighting,
    Place,
    Sighting,
    moon_seen,
    sub_lunar_point,
    sub_solar_point,
    sun_seen,
)
from airlight.geometry.ephemeris.time_text import read_time

__all__ = [
    "MoonSighting",
    "Place",
    "Sighting",
    "moon_seen",
    "read_time",
    "sub_lunar_point",
    "sub_solar_point",
    "sun_seen",
]
