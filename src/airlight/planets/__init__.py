"""Planets: their composition, their files, and the medium that solvers read."""

from __future__ import annotations

from airlight.planets.constituent import Constituent
from airlight.planets.ground import Ground
from airlight.planets.medium import Medium
from airlight.planets.parameters import replace
from airlight.planets.planet import Planet
from airlight.planets.reading.reader import load_planet, planet_names
from airlight.planets.star import Star

__all__ = [
    "Constituent",
    "Ground",
    "Medium",
    "Planet",
    "Star",
    "load_planet",
    "planet_names",
    "replace",
]
