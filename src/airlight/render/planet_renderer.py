"""Atmosphere and ground of a planet in a scene of several bodies, with or without an eclipse."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ConflictError
from airlight.geometry.occulted_star import OccultedStar, occulted_star
from airlight.kernel.large_arrays import zeros
from airlight.kernel.threads import Cancel, Progress
from airlight.planets.light_source import LightSource
from airlight.render.clouds.cloud_time import CloudTime, clouds_at
from airlight.render.cpu_renderer import CpuRenderer
from airlight.render.eclipse_renderer import EclipseRenderer, check_unfiltered
from airlight.render.pixels.scenes_by_light import light_visibility
from airlight.render.render import add_rendered
from airlight.render.scene_lights import SceneLights
from airlight.render.through_air import AirAround
from airlight.scene import Camera, Scene
from airlight.scene.directions import camera_angles, level_axes
from airlight.scene.system import System
from airlight.scene.system.body import Body
from airlight.scene.system.light import Light
from airlight.solver.eclipsed.solution import EclipsedSolution

if TYPE_CHECKING:
    from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]

#: Fraction of the strongest irradiance below which a light is ignored. [1]
_FAINTEST: Final = 1e-12


@dataclass(frozen=True, eq=False, kw_only=True)
class AtmosphereLayer(AirAround):
    """Rendered atmosphere and ground of a planet.

    Attributes
    ----------
    body : Body
        Planet.
    layer : array, shape (rows, columns, 3)
        Linear sRGB of air and ground. [W m⁻² sr⁻¹]
    """

    body: Body
    layer: NDArray[np.float32]


def atmosphere_layer(
    lights: SceneLights,
    camera: Camera,
    body: Body,
    *,
    clouds: CloudTime | None = None,
    quality: str = "default",
    cache: bool = True,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> AtmosphereLayer:
    """Render a planet under each light of a scene.

    Lights that are invisible by day beside the first (``light_visibility``) light no clouds.

    Parameters
    ----------
    lights : SceneLights
        Lights of the scene, with the solution of the planet.
    camera : Camera
        Projection and size of the frame.
    body : Body
        Planet with air.
    clouds : CloudTime, optional
        Time of its three-dimensional clouds; by default that of the first frame.
    quality, cache, progress, cancel :
        See ``render_system``.

    Raises
    ------
    ConflictError
        If a planet with three-dimensional clouds is in a moon's shadow.
    """
    system, solution = lights.system, lights.solutions[body.name]
    layers = zeros((1, camera.rows, camera.columns, 3), np.float32)
    before = None
    for number, (lit, scene, local, moon, air) in enumerate(body_lights(lights, camera, body)):
        around = None
        if air:
            around = clouds_at(
                system.planets[body.name], scene, clouds, quality=quality, cache=cache
            )
        if moon is None:
            lit_clouds = around.lit(lit, scene, progress=progress, cancel=cancel) if around else ()
            renderer = CpuRenderer(lit, scene, disc=False, clouds=lit_clouds)
            if around is not None and before is None:
                before = _in_frame(around.before_space(lit, scene), local)
        else:
            if around is not None:
                raise ConflictError("clouds", "cannot be rendered in a moon's shadow")
            check_unfiltered(scene)  # before the shadow is solved, which takes minutes
            eclipsed = EclipsedSolution(lit, moon, cache=cache, progress=progress, cancel=cancel)
            renderer = EclipseRenderer(eclipsed, scene, local)
        add_rendered(layers, renderer, (None,), progress, cancel, black=number == 0)
    return AtmosphereLayer(
        body=body,
        solution=solution,
        altitude=system.place_above(body)[2],
        axes=level_axes(zenith_above(system, body)),
        layer=layers[0],
        clouds=before,
        pole=system.axes(body)[2],
    )


class BodyLight(NamedTuple):
    """Planet of a scene under one of its lights.

    Attributes
    ----------
    solution : MomentsSolution
        Solution with this light.
    scene : Scene
        Scene of this planet alone, in the frame of the light.
    axes : array, shape (3, 3)
        Axes of that frame as rows. [1]
    moon : OccultedStar or None
        Airless body that occults the light.
    visible : bool
        Whether it is visible beside the first light, ``light_visibility``.
    """

    solution: MomentsSolution
    scene: Scene
    axes: FloatArray
    moon: OccultedStar | None
    visible: bool


def body_lights(lights: SceneLights, camera: Camera, body: Body) -> Iterator[BodyLight]:
    """Planet under each of the lights that illuminate it.

    Parameters
    ----------
    lights, camera, body :
        Arguments of ``atmosphere_layer``.
    """
    system, solution = lights.system, lights.solutions[body.name]
    brightest, first_zenith = 0.0, 0.0
    for number, light in enumerate(lights.on(body)):
        source = lights.seen_from(light, body)
        irradiance = float(source.irradiance.max())
        brightest = max(brightest, irradiance)
        if irradiance <= _FAINTEST * brightest:
            continue
        lit = solution.with_light(source, secondary=number > 0)
        towards = lights.towards(light, body.centre[None])[0]
        local = level_axes(zenith_above(system, body), towards)
        scene = scene_of_light(lights, camera, body, towards, local)
        moon = None if light.star is None else occulting_moon(lights, light, body, source)
        visible = number == 0 or light_visibility(
            scene.sun_zenith, first_zenith, 0.0, irradiance / brightest,
            scene.altitude, solution.medium.bottom_radius, solution.medium.thickness,
        ) > 1.0  # fmt: skip
        first_zenith = scene.sun_zenith if number == 0 else first_zenith
        yield BodyLight(lit, scene, local, moon, visible)


def zenith_above(system: System, body: Body) -> FloatArray:
    """Unit vector from the centre of a body towards the observer. [1]"""
    offset = system.eye - body.centre
    return np.asarray(offset / np.linalg.norm(offset))


def _in_frame(
    transmittance: Callable[[FloatArray], FloatArray], local: FloatArray
) -> Callable[[FloatArray], FloatArray]:
    """Transmittance of rays in the frame of the scene, of which the rows of ``local`` are axes."""
    return lambda rays: transmittance(rays @ local.T)


def scene_of_light(
    lights: SceneLights, camera: Camera, body: Body, towards: FloatArray, local: FloatArray
) -> Scene:
    """Single-planet scene of a light in its local frame, whose axes are the rows of ``local``."""
    system, up = lights.system, local[2]
    latitude, longitude, altitude = system.place_above(body)
    east = np.cross(system.axes(body)[2], up)
    flat = np.linalg.norm(east)
    bearing = 0.0
    if flat > 1e-12:
        east = east / flat
        bearing = math.degrees(math.atan2(local[0] @ east, local[0] @ np.cross(up, east)))
    zenith, azimuth, roll = camera_angles(system.camera_axes @ local.T)
    return Scene(
        camera=replace(camera, look_zenith=zenith, look_azimuth=azimuth, roll=roll),
        altitude=altitude,
        sun_zenith=math.degrees(math.atan2(abs(towards @ local[0]), towards @ up)),
        latitude=latitude,
        longitude=longitude,
        sun_azimuth=bearing,
        ground="detailed",
    )


def occulting_moon(
    lights: SceneLights, star: Light, body: Body, source: LightSource
) -> OccultedStar | None:
    """Airless body that occults a star for a planet's atmosphere; None if there is none.

    Of several, the body whose shadow axis passes nearest to the planet's centre.

    Parameters
    ----------
    star, body : Light, Body
        Star, and planet with an atmosphere.
    source : LightSource
        Star as seen from the planet.

    Returns
    -------
    OccultedStar or None
        In the frame of the scene, around the planet's centre.
    """
    system, alpha = lights.system, source.angular_radius
    if alpha <= 0.0:
        return None
    reach = system.outer_radius(body)
    towards = star.towards(body.centre)
    nearest, found = math.inf, None
    for other in system.bodies:
        if other.name == body.name or other.planet is not None:
            continue
        offset = other.centre - body.centre
        distance, radius = float(np.linalg.norm(offset)), system.radius(other)
        if offset @ towards <= 0.0 or (
            star.position is not None
            and distance > float(np.linalg.norm(np.asarray(star.position) - body.centre))
        ):
            continue
        miss = float(np.linalg.norm(np.cross(offset, towards)))
        # The penumbra's edge; the star's parallax over the planet is far less than its radius.
        if miss - reach < radius + (distance + reach) * math.tan(alpha) and miss < nearest:
            nearest, found = miss, other
    if found is None:
        return None
    far = math.inf
    if star.position is not None:
        far = float(np.linalg.norm(np.asarray(star.position) - body.centre))
    return occulted_star(
        found.centre - body.centre,
        system.radius(found),
        towards,
        alpha,
        darkening=source.darkenings,
        reach=reach,
        distance=far,
    )
