"""Data of a scene of several bodies for the browser, read by ``web/drawing/scene_space.js``.

What changes with time is sampled: positions, axes and lights of bodies, between which a page
interpolates. Vectors are in the frame of the scene.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import Cancelled, ConflictError
from airlight.image.white_balance import star_white
from airlight.kernel.threads import Cancel, Progress
from airlight.render.bare_bodies import body_map, light_uniforms, place_uniforms
from airlight.render.gpu.device.flat import FORMATS
from airlight.render.gpu.picture import uniforms as gpu
from airlight.render.gpu.picture.sky_views import DiscTables
from airlight.render.gpu_system_renderer import check_drawn_by_gpu
from airlight.render.scene_lights import SceneLights, Shade
from airlight.scene.system import System
from airlight.scene.system.body import Body
from airlight.scene.system.light import Light
from airlight.solver.moments.solution import MomentsSolution
from airlight.viewer.browser.package import ground_map
from airlight.viewer.browser.star_sky import star_sky
from airlight.viewer.browser.tables_text import DIGITS, as_text, rounded
from airlight.viewer.parameters.parameter import Parameter
from airlight.viewer.session.scene_around import SceneAround

#: Times before and after that of the scene, and the step between samples. [h]
SPAN: Final = 12.0
STEP: Final = 0.5
#: Number of lights of a planet with air that a page draws.
LIGHTS: Final = 2
#: Fraction of the strongest irradiance below which a light is left out. [1]
_FAINTEST: Final = 1e-12
#: Digits of numbers.
_DIGITS: Final = 10
#: Uniforms of ``BareBody`` that are vectors, those of the observer's place apart.
_TURNED: Final = ("body_x", "body_y", "body_z", "body_light", "shade")

#: Time of a page of a scene whose bodies move.
HOURS: Final = Parameter(
    path="scene.hours",
    label="time",
    group="sun",
    help="Hours from the time of the scene.",
    unit="h",
    low=-SPAN,
    high=SPAN,
    least=-SPAN,
    most=SPAN,
    step=0.25,
    synonyms=("clock", "date", "hour", "eclipse", "rotation"),
)


def scene_package(
    around: SceneAround,
    solutions: Mapping[str, MomentsSolution],
    *,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> dict[str, Any]:
    """Bodies and lights of a scene as JSON values.

    Parameters
    ----------
    around : SceneAround
        Scene.
    solutions : mapping
        Solutions of its planets at three or four wavelengths, by name.

    Returns
    -------
    dict
        ``home``, the index of the planet below the observer; ``aim`` of the camera; names of
        vectors that are ``turned``; ``white``, the chromaticity of the first star; ``bodies`` and
        ``stars`` in the order of the scene, and ``moments``, what changes with time.

    Raises
    ------
    ConflictError
        If a planet has more than two lights.
    """
    system = replace(around.system, given=around.system.planets)
    lights = SceneLights(system, next(iter(solutions.values())).wavelengths, solutions)
    by_time = _systems(around, system)
    nearest = sorted(by_time, key=lambda one: abs(one[0]))  # tables are of the nearest time
    shades = _shades([replace(lights, system=one, **_fresh()) for _, one in nearest])
    moments = []
    for number, (hours, one) in enumerate(by_time):
        if cancel is not None and cancel():
            raise Cancelled
        moments.append({"hours": hours, **_moment(replace(lights, system=one, **_fresh()), shades)})
        if progress is not None:
            progress(number + 1, len(by_time), "moving the bodies")
    return {
        "home": [body.name for body in system.bodies].index(around.body),
        "aim": _aim(lights),
        "turned": list(_TURNED),
        "white": star_white(lights.source(lights.stars[0], system.eye).spectrum),
        "bodies": [_body(lights, body, shades) for body in system.bodies],
        "stars": [_star(lights, star, solutions[around.body]) for star in lights.stars],
        "moments": moments,
        "sky": star_sky(lights.source(lights.stars[0], system.eye)) if system.stars else None,
    }


def _aim(lights: SceneLights) -> dict[str, Any] | None:
    """Body or star at which the camera looks; None without one."""
    system, view = lights.system, lights.system.view
    if view.look_at is None:
        return None
    stars, bodies = ([one.name for one in several] for several in (lights.stars, system.bodies))
    star = stars.index(view.look_at) if view.look_at in stars else None
    return {
        "star": star,
        "body": None if star is not None else bodies.index(view.look_at),
        "up": None if view.up is None else list(view.up),
        "roll": view.roll,
    }


def _fresh() -> dict[str, Any]:
    """Empty caches of ``SceneLights``."""
    return {"_sources": {}, "_shadows": {}}


def _systems(around: SceneAround, system: System) -> list[tuple[float, System]]:
    """Scene by time from that of its file [h], as long as the GPU draws it."""
    if not around.dated:
        return [(0.0, system)]
    found = [(0.0, system)]
    for way in (-1.0, 1.0):
        for step in range(1, round(SPAN / STEP) + 1):
            hours = way * step * STEP
            moved = replace(around.after(hours), given=system.given)
            try:
                check_drawn_by_gpu(moved)
            except ConflictError:
                break
            found.append((hours, moved))
    return sorted(found, key=lambda one: one[0])


def _shades(by_time: list[SceneLights]) -> dict[tuple[str, str], Shade]:
    """Bodies whose shadows reach bodies without air, by the names of star and body."""
    found = {}
    for lights in by_time:
        for star in lights.stars:
            for body in lights.system.bodies:
                key = star.name, body.name
                if body.planet is None and key not in found:
                    shade = lights.shade(star, body, whole=True)
                    if shade is not None:
                        found[key] = shade
    return found


def _body(
    lights: SceneLights, body: Body, shades: Mapping[tuple[str, str], Shade]
) -> dict[str, Any]:
    """What does not change with time: size, map, and tables of shadows."""
    system, solution = lights.system, lights.solutions.get(body.name)
    return {
        "name": body.name,
        "radius": system.radius(body),
        "outer": system.outer_radius(body),
        "bend": 0.0 if solution is None else float(solution.geometry.max_refraction),
        "refracts": solution is not None and solution.geometry.shell is not None,
        "map": None if body.planet is not None else ground_map(body_map(system, body)),
        "lights": [
            {"shade": _shade_table(lights, body, light, shades.get((light.name, body.name)))}
            for light in _lights_on(lights, body)
        ],
    }


def _lights_on(lights: SceneLights, body: Body) -> list[Light]:
    """Lights of a body, without those far fainter than the strongest."""
    found, strongest = [], 0.0
    for light in lights.on(body):
        irradiance = float(lights.seen_from(light, body).irradiance.max())
        strongest = max(strongest, irradiance)
        if irradiance > _FAINTEST * strongest or light.body is not None:
            found.append(light)
    if body.planet is not None and len(found) > LIGHTS:
        raise ConflictError(body.name, f"has {len(found)} lights; a page draws {LIGHTS}")
    return found


def _star(lights: SceneLights, star: Light, solution: MomentsSolution) -> dict[str, Any]:
    """Disc of a star, as seen from the observer of the scene file."""
    source = lights.source(star, lights.system.eye)
    lit = solution.with_light(source, secondary=True)
    place = lights.place_of(star)
    distance = None if place is None else float(np.linalg.norm(place - lights.system.eye))
    law = DiscTables.of(lit).texels
    return {
        "radius": float(source.angular_radius),
        "distance": distance,
        "numbers": _short(gpu.light_uniforms(solution, lit)),
        "disc": {"format": FORMATS[4], "data": as_text(rounded(law, DIGITS), 4)},
    }


def _moment(lights: SceneLights, shades: Mapping[tuple[str, str], Shade]) -> dict[str, Any]:
    """Positions, axes and lights at one time."""
    system = lights.system
    return {
        "bodies": [
            {
                "centre": _list(body.centre),
                "axes": [_list(row) for row in system.axes(body)],
                "place": {} if body.planet is not None else _placed(system, body),
                "lights": [
                    _on_air(lights, body, light, number > 0)
                    if body.planet is not None
                    else _on_body(lights, body, light, shades)
                    for number, light in enumerate(_lights_on(lights, body))
                ],
            }
            for body in system.bodies
        ],
        "stars": [
            {
                "place": None if (place := lights.place_of(star)) is None else _list(place),
                "towards": _list(star.towards(system.eye)),
            }
            for star in lights.stars
        ],
    }


def _placed(system: System, body: Body) -> dict[str, float]:
    """Uniforms of a body without air that depend on neither the observer nor the map's size."""
    numbers = place_uniforms(system, body, np.eye(3))
    left_out = ("body_centre", "body_power", "map_")
    return _short({n: x for n, x in numbers.items() if not n.startswith(left_out)})


def _on_air(lights: SceneLights, body: Body, light: Light, second: bool) -> dict[str, Any]:
    """Light of a planet with air: uniforms, irradiance [W m⁻² nm⁻¹], radius [rad]."""
    source, solution = lights.seen_from(light, body), lights.solutions[body.name]
    lit = solution.with_light(source, secondary=second)
    return {
        "towards": _list(lights.towards(light, body.centre[None])[0]),
        "radius": float(source.angular_radius),
        "irradiance": float(source.irradiance.max()),
        "numbers": _short(gpu.light_uniforms(solution, lit)),
    }


def _on_body(
    lights: SceneLights, body: Body, light: Light, shades: Mapping[tuple[str, str], Shade]
) -> dict[str, Any]:
    """Uniforms of a light of a body without air, with directions in the frame of the scene."""
    shade = shades.get((light.name, body.name)) if light.star is not None else None
    numbers, _ = light_uniforms(lights, body, light, np.eye(3), None, shade)
    return {"numbers": _short(numbers)}


def _shade_table(
    lights: SceneLights, body: Body, light: Light, shade: Shade | None
) -> dict[str, Any] | None:
    """Texture of a shadow by separation and channel, and its place in it."""
    if shade is None or light.star is None:
        return None
    _, left = light_uniforms(lights, body, light, np.eye(3), None, shade)
    assert left is not None
    textures, places = gpu.FRAME.laid_out({"shade_table": left})
    table = textures["shade"]
    return {
        "format": FORMATS[table.shape[1]],
        "data": as_text(rounded(table, DIGITS), table.shape[1]),
        "places": {f"table_{n}": [*place, 0, 0, 0][:4] for n, place in places.items()},
    }


def _list(values: NDArray[np.float64]) -> list[float]:
    return [float(f"{x:.12g}") for x in values]


def _short(numbers: Mapping[str, float]) -> dict[str, float]:
    return {name: float(f"{x:.{_DIGITS}g}") for name, x in numbers.items()}
