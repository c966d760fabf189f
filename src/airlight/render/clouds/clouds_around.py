"""``CloudsAround``: the three-dimensional clouds of a picture."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence
from dataclasses import KW_ONLY, dataclass, replace
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_optics import CloudOptics
from airlight.clouds.planet_clouds import Box, clouds_of
from airlight.errors import ParameterError
from airlight.kernel.cache import Cache
from airlight.kernel.threads import Cancel, Progress
from airlight.planets.planet import Planet
from airlight.render.clouds.cloud_light import CloudLight, OpticsAt, solve_clouds, sun_over
from airlight.scene import Scene
from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]
#: Lights by what they depend on, with moments whose identity is a part of it.
_Lights: TypeAlias = Cache[tuple[Any, ...], tuple[Any, CloudLight]]


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
    solved_at : sequence of (float, Scene)
        Weights and scenes between which the light is interpolated, see ``solve_clouds``; by default
        it is solved for every picture.
    """

    field: CloudField
    optics_at: OpticsAt
    _: KW_ONLY
    quality: str = "preview"
    cache: bool = True
    solved_at: Sequence[tuple[float, Scene]] = ()
    #: The last light, which the next frame of a film may share.
    _lights: _Lights = dataclasses.field(default_factory=lambda: Cache(1))

    @classmethod
    def of(
        cls, planet: Planet, scene: Scene, *, quality: str = "default", cache: bool = True
    ) -> CloudsAround | None:
        """Clouds of a planet around a scene's place; None without clouds.

        Parameters
        ----------
        planet : Planet
            Planet.
        scene : Scene
            Scene, in whose place boxes of generated clouds have their middle.
        quality : str
            Quality of the picture; that of the boxes is ``"preview"`` below ``"high"``.

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

        return cls(
            at(np.array([550.0]))[0],
            lambda nm: at(nm)[1],
            quality="high" if quality == "high" else "preview",
            cache=cache,
        )

    def lit(
        self,
        solution: MomentsSolution,
        scene: Scene,
        *,
        light: int = 0,
        progress: Progress | None = None,
        cancel: Cancel | None = None,
    ) -> CloudLight:
        """Light of the clouds; parameters as those of ``solve_clouds``.

        Parameters
        ----------
        light : int
            Number of the light among those of the scenes of ``solved_at``.
        """
        nodes = [(weight, one.with_light(one.lights[light])) for weight, one in self.solved_at]
        suns = [(1.0, scene), *nodes]
        key = (
            id(solution.moments),
            solution.lights[0].angular_radius,
            *((weight, sun_over(self.field, one)) for weight, one in suns),
        )

        def make() -> tuple[Any, CloudLight]:
            found = solve_clouds(
                solution,
                scene,
                self.field,
                self.optics_at,
                solved_at=nodes,
                quality=self.quality,
                cache=self.cache,
                progress=progress,
                cancel=cancel,
            )
            return solution.moments, found

        return replace(self._lights.of(key, make)[1], field=self.field)

    def before_space(
        self, solution: MomentsSolution, scene: Scene
    ) -> Callable[[FloatArray], FloatArray]:
        """Transmittance of the clouds on lines of sight, see ``ThroughClouds``. [1]

        Parameters
        ----------
        solution, scene : MomentsSolution, Scene
            Arguments of ``ThroughClouds``.
        """
        from airlight.render.clouds.through_clouds import ThroughClouds

        optics = self.optics_at(solution.wavelengths)
        return ThroughClouds(self.field, optics, solution, scene).transmittance
