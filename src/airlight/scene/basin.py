"""Scenes below the reference level of altitudes, on the floor of a basin."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from airlight.planets.lowered_ground import stands_on_floor
from airlight.scene.scene import Scene

if TYPE_CHECKING:
    from airlight.planets.planet import Planet


def on_basin_floor(planet: Planet, scene: Scene) -> tuple[Planet, Scene]:
    """Planet with its ground lowered to an observer at negative altitude, and the scene there.

    Parameters
    ----------
    scene : Scene
        Scene; scene and planet are returned unchanged for altitudes of 0 or more.

    Examples
    --------
    >>> from airlight.planets import load_planet
    >>> planet, scene = on_basin_floor(load_planet("mars"), Scene(altitude=-7e3))
    >>> planet.bottom_radius, scene.altitude
    (3382498.0, 2.0)
    """
    if scene.altitude >= 0.0:
        return planet, scene
    planet, height = stands_on_floor(planet, scene.altitude)
    return planet, replace(scene, altitude=height)
