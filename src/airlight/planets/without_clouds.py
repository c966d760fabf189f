"""Refusal of planets with three-dimensional clouds where these would be ignored."""

from __future__ import annotations

from typing import Protocol

from airlight.errors import ConflictError
from airlight.planets.clouds import Clouds


class HasClouds(Protocol):
    """Planet."""

    @property
    def clouds(self) -> tuple[Clouds, ...]:
        """Its clouds."""


def check_clear(planet: HasClouds, consumer: str = "this computation") -> None:
    """Raise an error for a planet with three-dimensional clouds, which would be ignored.

    ``Medium.from_planet`` calls it, so that no solver ignores clouds. One that computes them takes
    ``planet.clouds`` and the medium of ``planet.without_clouds``; a command that does not may call
    it first, with its name.

    Parameters
    ----------
    planet : Planet
        Planet.
    consumer : str
        Command or solver in the error.

    Raises
    ------
    ConflictError
        If the planet has clouds.
    """
    if planet.clouds:
        raise ConflictError(
            "clouds",
            f"cannot be used by {consumer}, where air is the same everywhere: remove them",
        )
