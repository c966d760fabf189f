"""Appearance of a planet in pictures: maps of colour, city lights and clouds, and airglow."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np
import numpy.typing as npt

from airlight.physics.optics.droplet_layer import DropletLayer, droplet_layer, no_layer

if TYPE_CHECKING:
    from airlight.planets.ground import Ground


@dataclass(frozen=True, kw_only=True)
class Surface:
    """Maps of the ground and airglow for rendering, which do not affect solvers.

    Parameters
    ----------
    map, deck, lights, clouds, clouds_from_space, relief : str or None
        Names or paths of the maps of colour, of a cloud deck, city lights, clouds and heights.
    rocks : float
        Share of bare ground below rocks. [1]
    craters : float
        Craters wider than D per area D². [1]
    brightness : float
        Factor of the map of colour. [1]
    cloud_altitude : float
        Altitude of the clouds; 0 without a map. [m]
    cloud_optical_depth : float
        Optical depth of complete cover. [1]
    airglow : str
        Name of the airglow, or ``none``.
    """

    map: str | None = None
    deck: str | None = None
    lights: str | None = None
    clouds: str | None = None
    clouds_from_space: str | None = None
    relief: str | None = None
    rocks: float = 0.0
    craters: float = 0.0
    brightness: float = 1.0
    cloud_altitude: float = 0.0
    cloud_optical_depth: float = 0.0
    airglow: str = "none"

    @classmethod
    def of(cls, ground: Ground, airglow: str) -> Surface:
        """Surface of a planet's ground, under its airglow."""
        return cls(
            map=ground.map,
            deck=ground.deck,
            lights=ground.lights,
            clouds=ground.clouds,
            clouds_from_space=ground.clouds_from_space,
            relief=ground.relief,
            rocks=ground.rocks,
            craters=ground.craters,
            brightness=ground.brightness,
            cloud_altitude=ground.cloud_altitude
            if ground.clouds or ground.clouds_from_space
            else 0.0,
            cloud_optical_depth=ground.cloud_optical_depth,
            airglow=airglow,
        )

    def layer(self, wavelengths: npt.NDArray[np.float64]) -> DropletLayer:
        """Layer of the clouds that are seen, at wavelengths [nm]; without droplets if none are."""
        if self.overlay[1] is None:
            return no_layer(wavelengths.size)
        return droplet_layer(self.cloud_optical_depth, wavelengths)

    @property
    def picture(self) -> str | None:
        """Map of colour, of the ground or of a deck."""
        return self.map or self.deck

    @property
    def overlay(self) -> tuple[str | None, str | None, str | None]:
        """Arguments of ``scene.ground_overlay``: lights, clouds that are seen, heights."""
        return self.lights, self.clouds or self.clouds_from_space, self.relief


#: Surface without any map.
PLAIN: Final = Surface()
