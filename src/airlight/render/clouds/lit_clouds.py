"""``LitClouds``: clouds of live pictures, whose light was solved before."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Final

from airlight.kernel.threads import Cancel, Progress
from airlight.render.clouds.cloud_light import STILL, CloudLight
from airlight.render.clouds.cloud_time import CloudTime
from airlight.render.clouds.clouds_around import CloudsAround, is_wide
from airlight.render.clouds.mean_layer import MeanLayer
from airlight.render.pixels.scenes_by_light import scenes_by_light

if TYPE_CHECKING:
    from airlight.planets.planet import Planet
    from airlight.scene import Scene
    from airlight.solver.moments.solution import MomentsSolution

#: Azimuths and rows of the table of the air of coarse frames, and of their sky-view LUT, by eye.
QUICK: Final = (15, 15)
QUICK_SKY_VIEW: Final = (48, 48)
#: Change of a light's direction up to which its clouds keep their light: a thousandth of it with
#: the sun at 75°, 4/1000 at 89° (a fifth of the errors of 0.5° in docs/clouds.md). [deg]
_SAME_LIGHT: Final = 0.1
#: Distance from the place of clouds beyond which those of another place are generated. [deg]
_FAR: Final = 5.0


@dataclass(frozen=True, eq=False, kw_only=True)
class LitClouds(CloudsAround):
    """Clouds with the light of a scene, which those of similar scenes share.

    Parameters
    ----------
    planet : Planet
        Planet with the clouds.
    solution : MomentsSolution
        Solution of the planet without clouds.
    scene : Scene
        Scene of the light, at the place about which clouds are generated.
    solved : mapping from int to tuple of CloudLight
        Light of each of the clouds by the number of the light in the scene.
    """

    planet: Planet
    solution: MomentsSolution
    scene: Scene
    solved: Mapping[int, tuple[CloudLight, ...]] = field(default_factory=dict)

    @classmethod
    def solve(
        cls,
        around: CloudsAround,
        planet: Planet,
        solution: MomentsSolution,
        scene: Scene,
        *,
        detail: str = STILL,
        progress: Progress | None = None,
        cancel: Cancel | None = None,
    ) -> LitClouds:
        """Solve the light of clouds under each light of a scene that illuminates air.

        Parameters
        ----------
        around : CloudsAround
            Clouds.
        planet, solution, scene :
            See the class.
        detail : str
            Detail of the light, see ``solve_clouds``.
        progress, cancel : callable, optional
            See ``airlight.kernel.threads``.
        """
        wanted = replace(around, detail=detail)
        solved = {}
        for seen, lit, air, light in scenes_by_light(scene, solution):
            number = scene.lights.index(light)
            if air:
                solved[number] = CloudsAround.lit(
                    wanted, lit, seen, light=number, progress=progress, cancel=cancel
                )
        own = {name: getattr(wanted, name) for name in _OF_CLOUDS}
        return cls(planet=planet, solution=solution, scene=scene, solved=solved, **own)

    def lit(
        self,
        solution: MomentsSolution,
        scene: Scene,
        *,
        light: int = 0,
        progress: Progress | None = None,
        cancel: Cancel | None = None,
    ) -> tuple[CloudLight, ...]:
        """Light of each of the clouds as solved; none of a light that was not there."""
        if light not in self.solved:
            return ()
        return tuple(
            replace(one, field=deck.field)
            for one, deck in zip(self.solved[light], self.decks, strict=True)
        )

    @property
    def mean_layer(self) -> MeanLayer | None:
        """Mean layer of the clouds; None without cloudy columns or light."""
        return next((one.layer for some in self.solved.values() for one in some), None)

    def at(self, scene: Scene, seconds: float = 0.0) -> LitClouds:
        """Clouds seen in a scene after the wind has moved them for a time. [s]"""
        own = self.scene
        time = CloudTime(seconds=seconds, latitude=own.latitude, longitude=own.longitude)
        moved = time.of(self, self.planet, scene)
        assert isinstance(moved, LitClouds)
        return moved

    def refined(
        self,
        solution: MomentsSolution,
        scene: Scene,
        seconds: float = 0.0,
        *,
        progress: Progress | None = None,
        cancel: Cancel | None = None,
    ) -> LitClouds:
        """Clouds seen in a scene after a time [s], whose light is solved if it is another.

        Parameters
        ----------
        solution, scene, progress, cancel :
            See ``solve``.
        """
        found = self
        if self.detail != STILL or self.solution is not solution or not self.same_light(scene):
            own = replace(scene, latitude=self.scene.latitude, longitude=self.scene.longitude)
            found = LitClouds.solve(
                self, self.planet, solution, own, progress=progress, cancel=cancel
            )
        return found.at(scene, seconds)

    def same_clouds(self, planet: Planet, scene: Scene) -> bool:
        """Whether a planet has these clouds, and a scene is near their place."""
        return (
            self.planet.clouds == planet.clouds
            and self.planet.bottom_radius == planet.bottom_radius
            and self.planet.thickness == planet.thickness
            and near(self.scene, scene)
        )

    def same_light(self, scene: Scene) -> bool:
        """Whether the lights of a scene come from the same directions as those of the clouds."""
        return same_lights(self.scene, scene, self.planet.bottom_radius)


#: Fields of ``CloudsAround`` that do not change with the light.
_OF_CLOUDS: Final = ("decks", "quality", "cache", "detail", "directions", "sky_view")


def near(one: Scene, other: Scene) -> bool:
    """Whether two scenes are so close to each other that they have the same clouds."""
    turn = math.remainder(one.longitude - other.longitude, 360.0)
    turn *= math.cos(math.radians(other.latitude))
    return math.hypot(one.latitude - other.latitude, turn) < _FAR


def same_lights(one: Scene, other: Scene, radius: float) -> bool:
    """Whether clouds have the same light in two scenes, within ``_SAME_LIGHT``.

    Parameters
    ----------
    one, other : Scene
        Scenes near the same place.
    radius : float
        Radius of the ground. [m]
    """
    if len(one.lights) != len(other.lights) or is_wide(one, radius) != is_wide(other, radius):
        return False
    for first, second in zip(one.lights, other.lights, strict=True):
        turn = first.azimuth + one.sun_azimuth - second.azimuth - other.sun_azimuth
        turn = math.remainder(turn, 360.0) * math.sin(math.radians(first.zenith))
        if type(first) is not type(second):
            return False
        if math.hypot(first.zenith - second.zenith, turn) > _SAME_LIGHT:
            return False
    return True
