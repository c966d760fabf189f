"""Environment map of a planet's sky for another renderer, with separate lights."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.engines.environment.consumers import Consumer
from airlight.engines.environment.disc import Disc, enu_from_local, seen_disc
from airlight.engines.environment.gamut import GamutChange, bring_into_gamut
from airlight.engines.environment.ground import GROUNDS, blacken_ground, grey_ground
from airlight.engines.environment.texels import texel_solid_angles
from airlight.errors import ConflictError, ParameterError
from airlight.planets.reading.reader import PlanetLike, load_planet
from airlight.render.pixels.scenes_by_light import scenes_by_light
from airlight.render.render_scene import Renderer
from airlight.scene.camera import Camera
from airlight.scene.frame import Frame
from airlight.scene.local_ground import local_ground

if TYPE_CHECKING:
    from airlight.kernel.threads import Cancel, Progress
    from airlight.scene import Scene

FloatArray = NDArray[np.float64]

#: Treatment of the discs of sun and moon: in the map, omitted, or as separate lights.
SUNS: Final = ("include", "exclude", "light")


@dataclass(frozen=True, kw_only=True, eq=False)
class EnvironmentMap:
    """Radiance map around an observer, with separate lights.

    Attributes
    ----------
    consumer : Consumer
        Target program.
    frame : Frame
        Linear sRGB radiance, not negative, with metadata. [W m⁻² sr⁻¹]
    scene : Scene
        Observer, lights, and the camera that renders the map.
    sun : str
        Name from ``SUNS``.
    ground : str
        Name from ``GROUNDS``.
    discs : tuple of Disc
        Discs of the visible lights, whether rendered into the map or not.
    gamut : GamutChange
        Change of the map by gamut mapping to sRGB.
    placed : bool
        Whether latitude and longitude of the scene were given by the user.
    planet : str
        Name of the planet.
    """

    consumer: Consumer
    frame: Frame
    scene: Scene
    sun: str
    ground: str
    discs: tuple[Disc, ...]
    gamut: GamutChange
    placed: bool
    planet: str

    @property
    def rgb(self) -> NDArray[np.float32]:
        """Linear sRGB radiance, shape (height, width, 3). [W m⁻² sr⁻¹]"""
        return self.frame.rgb

    def irradiance(self, normal: FloatArray) -> FloatArray:
        """Irradiance of a plane by the map, linear sRGB, shape (3,). [W m⁻²]

        Parameters
        ----------
        normal : array, shape (3,)
            Normal of the plane in ENU, a unit vector. [1]
        """
        camera = self.scene.camera
        facing = normal @ enu_from_local(self.scene.sun_azimuth)
        total = np.zeros(3)
        for row in range(camera.height):
            block = slice(row, row + 1)
            cosine = np.maximum(camera.directions(block)[0] @ facing, 0.0)
            weight = cosine * texel_solid_angles(camera, block)[0]
            total += weight @ self.rgb[row].astype(np.float64)
        return total


def map_camera(consumer: Consumer, width: int, height: int, sun_azimuth: float) -> Camera:
    """Camera for the map of a program.

    Parameters
    ----------
    consumer : Consumer
        Target program.
    width, height : int
        Size of the map. [pixel]
    sun_azimuth : float
        Compass bearing of the sun, the zero of the camera's azimuth. [deg]
    """
    return Camera(
        projection=consumer.projection,
        width=width,
        height=height,
        look_zenith=consumer.look_zenith,
        look_azimuth=math.remainder(consumer.centre - sun_azimuth, 360.0),
    )


def environment_map(
    planet: PlanetLike,
    scene: Scene,
    consumer: Consumer,
    *,
    sun: str = "include",
    ground: str = "neutral",
    placed: bool = True,
    local: bool = True,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
    **options: Any,
) -> EnvironmentMap:
    """Solve a planet and render the environment map of an observer.

    Parameters
    ----------
    planet : Planet, str, Path or Solution
        Planet to solve, see ``load_planet``.
    scene : Scene
        Observer and lights; of the camera, only the size is used.
    sun : str
        Discs of sun and moon: in the map (``include``), omitted (``exclude``), or separate lights
        instead (``light``).
    ground : str
        Lower hemisphere: ``neutral``, a uniform grey of the ground's albedo; ``map``, the planet's
        ground map; or ``black``.
    placed : bool
        Whether latitude and longitude of the scene were given by the user; otherwise the
        atmosphere is solved with the mean albedo of the planet.
    local : bool
        Whether the planet is solved with the albedo around a given location, as by
        ``render_scene``.
    progress, cancel, **options :
        Arguments of ``render_scene``.
    """
    for name, value, allowed in (("sun", sun, SUNS), ("ground", ground, GROUNDS)):
        if value not in allowed:
            raise ParameterError(name, value, ", ".join(allowed))
    if scene.camera.polariser is not None:
        raise ConflictError("camera.polariser", "does not apply to an environment map")
    planet = load_planet(planet, progress=progress, cancel=cancel)
    camera = map_camera(consumer, scene.camera.width, scene.camera.height, scene.sun_azimuth)
    planet, scene = replace(scene, camera=camera).on_basin_floor(planet)
    if placed and local:
        planet = local_ground(
            planet, latitude=scene.latitude, longitude=scene.longitude, altitude=scene.altitude
        )
    if ground == "neutral":
        planet = grey_ground(planet)
    renderer = Renderer(planet, disc=False, local=False, **options)
    frame, solution = renderer.render(scene, progress=progress, cancel=cancel)
    light = frame.rgb
    if ground == "black":
        blacken_ground(light, solution, scene)
    found = (seen_disc(one) for one in scenes_by_light(scene, solution))
    discs = tuple(one for one in found if one is not None)
    gamut = bring_into_gamut(light)
    if sun == "include":
        for one in discs:
            one.put_into(light, camera, enu_from_local(scene.sun_azimuth).T)
    return EnvironmentMap(
        consumer=consumer,
        frame=frame,
        scene=scene,
        sun=sun,
        ground=ground,
        discs=discs,
        gamut=gamut,
        placed=placed,
        planet=planet.name,
    )
