"""``CloudsAround``: the three-dimensional clouds of a picture."""

from __future__ import annotations

import dataclasses
import functools
import math
from collections.abc import Callable, Sequence
from dataclasses import KW_ONLY, dataclass, replace
from typing import Any, Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_optics import CloudOptics
from airlight.clouds.planet_clouds import Box, clouds_of
from airlight.errors import ParameterError, warn
from airlight.kernel.cache import Cache
from airlight.kernel.threads import Cancel, Progress
from airlight.planets.planet import Planet
from airlight.render.clouds.cloud_deck import CloudDeck
from airlight.render.clouds.cloud_light import CloudLight, OtherClouds, solve_clouds, sun_over
from airlight.render.clouds.mean_layer import mean_layer
from airlight.scene import Scene
from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]
#: Lights by what they depend on, with moments whose identity is a part of it.
_Lights: TypeAlias = Cache[tuple[Any, ...], tuple[Any, tuple[CloudLight, ...]]]


#: Largest number of kinds of clouds in a picture.
MOST_KINDS: Final = 3
#: Distance of the horizon, seen from the planet's centre, above which a picture is warned of: boxes
#: have the same sun from side to side. [deg]
_WIDE: Final = 25.0


@dataclass(frozen=True, eq=False)
class CloudsAround:
    """Clouds of a picture, whose light is solved for each light of the scene.

    Parameters
    ----------
    decks : tuple of CloudDeck
        Clouds by ascending tops.
    quality : str
        Quality of ``solve_box``.
    cache : bool
        Whether solutions are read from and stored on disk.
    solved_at : sequence of (float, Scene)
        Weights and scenes between which the light is interpolated, see ``solve_clouds``; by default
        it is solved for every picture.
    """

    decks: tuple[CloudDeck, ...]
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
            If the planet has more than three kinds of clouds.
        """
        if not planet.clouds:
            return None
        if len(planet.clouds) > MOST_KINDS:
            allowed = f"at most {MOST_KINDS} kinds in a picture"
            raise ParameterError("clouds", f"{len(planet.clouds)} kinds", allowed)
        radius = planet.bottom_radius
        horizon = math.degrees(math.acos(radius / (radius + max(scene.altitude, 0.0))))
        if horizon > _WIDE:
            warn(
                f"clouds are lit by the sun of one place and seen up to {horizon:.0f}° from it: "
                "there their light is wrong; a map, ground.clouds, has the sun of each place"
            )
        box = Box(latitude=scene.latitude, longitude=scene.longitude)

        @functools.cache
        def at(*nm: float) -> tuple[tuple[CloudField, CloudOptics], ...]:
            return clouds_of(planet, nm, box)

        def deck(number: int, field: CloudField) -> CloudDeck:
            return CloudDeck(field, lambda nm: at(*nm)[number][1], number)

        decks = [deck(number, field) for number, (field, _) in enumerate(at(550.0))]
        return cls(
            tuple(sorted(decks, key=lambda deck: deck.field.top)),
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
    ) -> tuple[CloudLight, ...]:
        """Light of each of the clouds; parameters as those of ``solve_clouds``.

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
            *((weight, sun_over(deck.field, one)) for weight, one in suns for deck in self.decks),
        )

        def make() -> tuple[Any, tuple[CloudLight, ...]]:
            layer = mean_layer(
                solution, self.decks, cache=self.cache, progress=progress, cancel=cancel
            )
            found: list[CloudLight] = []
            for number in range(len(self.decks) - 1, -1, -1):
                others = [deck for deck in self.decks if deck is not self.decks[number]]
                one = solve_clouds(
                    solution,
                    scene,
                    self.decks[number],
                    OtherClouds(layer, tuple(found), tuple(others)),
                    solved_at=nodes,
                    quality=self.quality,
                    cache=self.cache,
                    progress=progress,
                    cancel=cancel,
                )
                found.insert(0, one)
            return solution.moments, tuple(found)

        kept = self._lights.of(key, make)[1]
        return tuple(
            replace(one, field=deck.field) for one, deck in zip(kept, self.decks, strict=True)
        )

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

        return ThroughClouds(self.decks, solution, scene).transmittance
