"""CPU renderer of a planet in a scene of several bodies, with or without a moon's shadow."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.occulted_star import OccultedStar, occulted_star
from airlight.kernel.threads import Cancel, Progress
from airlight.planets.light_source import LightSource
from airlight.render.cpu_renderer import CpuRenderer
from airlight.render.eclipse_renderer import EclipseRenderer, check_unfiltered
from airlight.render.scene_lights import SceneLights
from airlight.scene import Scene
from airlight.scene.system.body import Body
from airlight.scene.system.light import Light
from airlight.solver.eclipsed.solution import EclipsedSolution
from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]


def planet_renderer(
    lights: SceneLights,
    light: Light,
    body: Body,
    lit: MomentsSolution,
    scene: Scene,
    local: FloatArray,
    *,
    cache: bool = True,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> CpuRenderer:
    """Renderer of a planet under one light; ``EclipseRenderer`` in the shadow of a moon.

    Parameters
    ----------
    light, body : Light, Body
        Light, and planet with an atmosphere.
    scene : Scene
        Observer and camera in the frame of the light.
    local : array, shape (3, 3)
        Axes of that frame in the scene's, as rows. [1]
    cache, progress, cancel :
        See ``render_system``.
    """
    source = lights.seen_from(light, body)
    star = None if light.star is None else occulting_moon(lights, light, body, source)
    if star is None:
        return CpuRenderer(lit, scene, disc=False)
    check_unfiltered(scene)  # before the shadow is solved, which takes minutes
    eclipsed = EclipsedSolution(lit, star, cache=cache, progress=progress, cancel=cancel)
    return EclipseRenderer(eclipsed, scene, local)


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
        found.centre - body.centre, system.radius(found), towards, alpha,
        darkening=source.darkenings, reach=reach, distance=far,
    )  # fmt: skip
