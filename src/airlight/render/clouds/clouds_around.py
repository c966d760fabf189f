"""``CloudsAround``: the three-dimensional clouds of a picture."""

from __future__ import annotations

import dataclasses
import functools
import math
from collections.abc import Callable, Sequence
from dataclasses import KW_ONLY, dataclass, replace
from typing import TYPE_CHECKING, Any, Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_optics import CloudOptics
from airlight.clouds.planet_clouds import Box, clouds_of
from airlight.errors import ParameterError
from airlight.kernel.cache import Cache
from airlight.kernel.threads import Cancel, Progress
from airlight.render.clouds import MOST_KINDS
from airlight.render.clouds.air_table import DIRECTIONS
from airlight.render.clouds.cloud_deck import CloudDeck
from airlight.render.clouds.cloud_light import FIRST, STILL, CloudLight, solve_clouds
from airlight.render.clouds.incident_light import OtherClouds, sun_over
from airlight.render.clouds.layer_geometry import seen_place
from airlight.render.clouds.mean_layer import MeanLayer, mean_layer

if TYPE_CHECKING:
    from airlight.planets.planet import Planet
    from airlight.scene import Scene
    from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]
#: Lights by what they depend on, with moments whose identity is a part of it.
_Lights: TypeAlias = Cache[tuple[Any, ...], tuple[Any, tuple[CloudLight, ...]]]
#: Mean layers by the identity of moments and of a similar layer, with these.
_Layers: TypeAlias = Cache[tuple[int, int], tuple[Any, MeanLayer | None]]


#: Distance of the horizon, seen from the planet's centre, above which clouds are lit by other suns
#: than that of their box. [deg]
_WIDE: Final = 5.0


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
    detail : str
        Detail of the light, see ``solve_clouds``.
    directions : (int, int)
        Azimuths and rows of each half of the table of the air; fewer for coarse frames.
    sky_view : (int, int), optional
        The same of the sky-view LUT of small frames, whose pixels are marched by default.
    similar : MeanLayer, optional
        Mean layer of similar clouds, which may be taken for a first light.
    solved_at : sequence of (float, Scene)
        Weights and scenes between which the light is interpolated, see ``solve_clouds``; by default
        it is solved for every picture.
    """

    decks: tuple[CloudDeck, ...]
    _: KW_ONLY
    quality: str = "preview"
    cache: bool = True
    detail: str = STILL
    directions: tuple[int, int] = DIRECTIONS
    sky_view: tuple[int, int] | None = None
    similar: MeanLayer | None = None
    solved_at: Sequence[tuple[float, Scene]] = ()
    #: The last light, which the next frame of a film may share.
    _lights: _Lights = dataclasses.field(default_factory=lambda: Cache(1))
    #: The last mean layer, which other lights share.
    _layers: _Layers = dataclasses.field(default_factory=lambda: Cache(1))

    @classmethod
    def of(
        cls,
        planet: Planet,
        scene: Scene,
        *,
        quality: str = "default",
        cache: bool = True,
        aimed: bool = True,
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
        aimed : bool
            Whether finer boxes are where the middle of the picture is, or below the observer.

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
        box = Box(latitude=scene.latitude, longitude=scene.longitude)

        @functools.cache
        def at(*nm: float) -> tuple[tuple[CloudField, CloudOptics], ...]:
            return clouds_of(planet, nm, box)

        def deck(number: int, field: CloudField) -> CloudDeck:
            place = seen_place(field, scene, radius) if aimed else (0.0, 0.0)
            return CloudDeck(field, lambda nm: at(*nm)[number][1], number, place)

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
        wide = is_wide(scene, solution.medium.bottom_radius)
        nodes = [(weight, one.with_light(one.lights[light])) for weight, one in self.solved_at]
        suns = [(1.0, scene), *nodes]
        key = (
            id(solution.moments),
            solution.lights[0].angular_radius,
            wide,
            self.detail,
            *((weight, sun_over(deck.field, one)) for weight, one in suns for deck in self.decks),
        )

        def make() -> tuple[Any, tuple[CloudLight, ...]]:
            similar = self.similar if self.detail == FIRST else None
            _, layer = self._layers.of(
                (id(solution.moments), id(similar)),
                lambda: (
                    (solution.moments, similar),
                    mean_layer(
                        solution,
                        self.decks,
                        similar=similar,
                        cache=self.cache,
                        progress=progress,
                        cancel=cancel,
                    ),
                ),
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
                    wide=wide,
                    detail=self.detail,
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


def is_wide(scene: Scene, radius: float) -> bool:
    """Whether clouds are seen so far away that they are lit by other suns, see ``solve_clouds``.

    Parameters
    ----------
    scene : Scene
        Observer.
    radius : float
        Radius of the ground. [m]
    """
    horizon = math.acos(radius / (radius + max(scene.altitude, 0.0)))
    return math.degrees(horizon) > _WIDE
