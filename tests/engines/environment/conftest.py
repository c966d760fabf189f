"""Maps that several tests read, each made once."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import pytest

from airlight import Camera, Scene, load_planet
from airlight.engines.environment.consumers import CONSUMERS
from airlight.engines.environment.environment_map import EnvironmentMap, environment_map

#: Wavelengths of the maps. [nm]
NM = (440.0, 500.0, 560.0, 620.0)
#: Bearing of the sun in all of them: in no middle of a map, on no seam. [deg]
BEARING = 215.0


@pytest.fixture(scope="session")
def made() -> Callable[..., EnvironmentMap]:
    """``made(consumer, sun, zenith, planet, ground, width)``: a small map, made once."""

    @cache
    def one(
        consumer: str = "blender",
        sun: str = "include",
        zenith: float = 50.0,
        planet: str = "earth",
        ground: str = "neutral",
        width: int = 128,
        quality: str = "preview",
    ) -> EnvironmentMap:
        reader = CONSUMERS[consumer]
        height = width // 2 if reader.projection == "equirectangular" else width
        camera = Camera(projection=reader.projection, width=width, height=height)
        scene = Scene(altitude=2.0, sun_zenith=zenith, sun_azimuth=BEARING, camera=camera)
        return environment_map(
            load_planet(planet), scene, reader, sun=sun, ground=ground, placed=False,
            wavelengths=NM, quality=quality,
        )  # fmt: skip

    return one
