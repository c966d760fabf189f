"""``CloudsAround``: the three-dimensional clouds of a picture."""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_optics import CloudOptics
from airlight.clouds.planet_clouds import Box, clouds_of
from airlight.errors import ParameterError
from airlight.kernel.threads import Cancel, Progress
from airlight.planets.planet import Planet
from airlight.render.clouds.cloud_light import CloudLight, OpticsAt, solve_clouds
from airlight.scene import Scene
from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class CloudsAround:
    """Clouds of a picture, whose light is solved for each light of the scene.

    Parameters
    ----------
    field : CloudField
        Extinction.
    optics_at : callable
        Optical properties of the particles at wavelengths, as ``CloudOptics.of_particles``.
    quality : str
        Quality of ``solve_box``.
    cache : bool
        Whether solutions are read from and stored on disk.
    """

    field: CloudField
    optics_at: OpticsAt
    _: KW_ONLY
    quality: str = "preview"
    cache: bool = True

    @classmethod
    def of(
        cls, planet: Planet, scene: Scene, *, quality: str = "preview", cache: bool = True
    ) -> CloudsAround | None:
        """Clouds of a planet around a scene's place; None without clouds.

        Parameters
        ----------
        planet : Planet
            Planet.
        scene : Scene
            Scene, in whose place boxes of generated clouds have their middle.

        Raises
        ------
        ParameterError
            If the planet has several kinds of clouds.
        """
        if not planet.clouds:
            return None
        if len(planet.clouds) > 1:
            raise ParameterError("clouds", f"{len(planet.clouds)} kinds", "one kind in a picture")
        box = Box(latitude=scene.latitude, longitude=scene.longitude)
        kept: dict[bytes, tuple[CloudField, CloudOptics]] = {}

        def at(nm: FloatArray) -> tuple[CloudField, CloudOptics]:
            key = np.asarray(nm, float).tobytes()
            if key not in kept:
                kept[key] = clouds_of(planet, nm, box)[0]
            return kept[key]

        return cls(at(np.array([550.0]))[0], lambda nm: at(nm)[1], quality=quality, cache=cache)

    def lit(
        self,
        solution: MomentsSolution,
        scene: Scene,
        *,
        progress: Progress | None = None,
        cancel: Cancel | None = None,
    ) -> CloudLight:
        """Light of the clouds; parameters as those of ``solve_clouds``."""
        return solve_clouds(
            solution,
            scene,
            self.field,
            self.optics_at,
            quality=self.quality,
            cache=self.cache,
            progress=progress,
            cancel=cancel,
        )
