"""``CloudTime``: three-dimensional clouds at a time of a film."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Final

from airlight.kernel.cache import Cache

if TYPE_CHECKING:
    from airlight.clouds.cloud_field import CloudField
    from airlight.planets.planet import Planet
    from airlight.render.clouds.cloud_deck import CloudDeck
    from airlight.render.clouds.clouds_around import CloudsAround
    from airlight.scene import Scene

#: Clouds of the last pictures, whose light the next ones may share.
_CLOUDS: Final[Cache[tuple[Any, ...], CloudsAround | None]] = Cache(1)


@dataclass(frozen=True, kw_only=True)
class CloudTime:
    """Clouds at a time of a film.

    Parameters
    ----------
    seconds : float
        Time since the first frame. [s]
    latitude, longitude : float
        Place of the observer in the first frame, around which clouds are generated. [deg]
    solved_at : tuple of (float, Scene)
        See ``CloudsAround``.
    """

    seconds: float
    latitude: float
    longitude: float
    solved_at: tuple[tuple[float, Scene], ...] = ()

    def of(self, first: CloudsAround, planet: Planet, scene: Scene) -> CloudsAround:
        """Clouds of a frame, which share the light that is kept by those of the first.

        A box drifts with the wind. Its middle stays with an observer who moves, and so does its
        sun, while its cells stay with the ground, within the curvature of the planet over the
        distance; a file with coordinates stays where it is.

        Parameters
        ----------
        first : CloudsAround
            Clouds around the place of the first frame.
        planet, scene : Planet, Scene
            Planet, and scene of the frame.
        """
        decks = tuple(deck._replace(field=self._moved(deck, planet, scene)) for deck in first.decks)
        return replace(first, decks=decks, solved_at=self.solved_at)

    def _moved(self, deck: CloudDeck, planet: Planet, scene: Scene) -> CloudField:
        """Field of clouds of a frame."""
        own, (east, north) = deck.field, planet.clouds[deck.number].drift(self.seconds)
        place = own.latitude, own.longitude
        if place == (self.latitude, self.longitude):
            degree = math.radians(1.0) * planet.bottom_radius
            place = scene.latitude, scene.longitude
            middle = math.cos(math.radians(0.5 * (self.latitude + scene.latitude)))
            east -= degree * middle * math.remainder(scene.longitude - self.longitude, 360.0)
            north -= degree * (scene.latitude - self.latitude)
        return replace(own, latitude=place[0], longitude=place[1], drift=(east, north))


def clouds_at(
    planet: Planet,
    scene: Scene,
    time: CloudTime | None = None,
    *,
    quality: str = "default",
    cache: bool = True,
) -> CloudsAround | None:
    """Clouds of a planet around a scene's place, at a time of a film; None without clouds.

    Parameters
    ----------
    planet, scene, quality, cache :
        Arguments of ``CloudsAround.of``.
    time : CloudTime, optional
        Time; by default that of the first frame.
    """
    if not planet.clouds:
        return None
    from airlight.render.clouds.clouds_around import CloudsAround

    first = scene
    if time is not None:
        first = replace(scene, latitude=time.latitude, longitude=time.longitude)
    place = first.latitude, first.longitude
    aim = None if time is not None else (scene.altitude, scene.sun_azimuth, *scene.camera.axes[2])
    kept = _CLOUDS.of(
        (planet.clouds, planet.bottom_radius, planet.thickness, place, quality, cache, aim),
        lambda: CloudsAround.of(planet, first, quality=quality, cache=cache, aimed=time is None),
    )
    return kept if kept is None or time is None else time.of(kept, planet, scene)
