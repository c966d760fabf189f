"""Uniforms of the bodies without air of a scene."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.image.xyz import luminance
from airlight.physics.optics.bare_surface import albedo_unit, law_number
from airlight.render.scene_lights import SceneLights, Shade
from airlight.scene.moon_face import MOON_MAP, near_side_mean
from airlight.scene.surface_map import SurfaceMap, surface_map
from airlight.scene.system import System
from airlight.scene.system.body import Body
from airlight.scene.system.light import Light

FloatArray = NDArray[np.float64]

#: Craters wider than D per area D² of bodies that reflect as the Moon, as its preset has them. [1]
CRATERS: Final = 0.079


def crater_density(body: Body) -> float:
    """Craters wider than D per area D² of a body; 0 without. [1]"""
    return CRATERS if body.reflection == "moon" else 0.0


def body_map(system: System, body: Body) -> SurfaceMap | None:
    """Map of a body without air; None without one."""
    return None if body.map is None else surface_map(system.path_of(body.map))


def map_mean(picture: SurfaceMap, body: Body, wavelengths: FloatArray) -> FloatArray:
    """Mean of a map to which the albedo of its body refers, shape (3,). [1]

    That of each channel where the albedo has a colour, otherwise the luminance, and that of the
    near side for the Moon.
    """
    mean = near_side_mean() if body.map == MOON_MAP else picture.mean_rgb
    if np.ptp(body.albedos(wavelengths)) == 0.0:
        mean = np.full(3, luminance(mean))
    return np.maximum(mean, 1e-6)


def place_uniforms(system: System, body: Body, local: FloatArray) -> dict[str, float]:
    """Uniforms of place, map and law of a body, of those of ``BareBody``.

    Parameters
    ----------
    local : array, shape (3, 3)
        Axes of the observer's frame, as rows. [1]
    """
    radius = system.radius(body)
    picture = body_map(system, body)
    size = (1, 1, 1) if picture is None else (picture.rows, picture.columns, len(picture.levels))
    return {
        **_vector("body_centre", local @ (body.centre - system.eye) / radius),
        "body_power": max(system.power(body), 0.0) / radius**2,
        **_vector("body_x", local @ system.axes(body)[0]),
        **_vector("body_y", local @ system.axes(body)[1]),
        **_vector("body_z", local @ system.axes(body)[2]),
        "body_law": law_number(body.reflection),
        "body_radius": radius,
        "body_craters": crater_density(body),
        "body_mapped": float(picture is not None),
        "map_rows": size[0],
        "map_columns": size[1],
        "map_levels": size[2],
    }


def light_uniforms(
    lights: SceneLights,
    body: Body,
    light: Light,
    local: FloatArray,
    weights: FloatArray | None,
    shade: Shade | None = None,
) -> tuple[dict[str, float], FloatArray | None]:
    """Uniforms of a body under a light, of those of ``BareBody``, and its ``shade_table``.

    Parameters
    ----------
    local : array, shape (3, 3)
        Argument of ``place_uniforms``.
    weights : array, shape (nl, 3), optional
        Linear sRGB per radiance; by default ``picture_weights``.
    shade : Shade, optional
        Shadow on the body; by default that of ``lights``.

    Raises
    ------
    ConflictError
        If several bodies stand before the light.
    """
    system, nm = lights.system, lights.wavelengths
    source, radius = lights.seen_from(light, body), system.radius(body)
    colors = source.colors(weights) * body.albedos(nm)[:, None] / albedo_unit(body.reflection)
    picture = body_map(system, body)
    color = colors.sum(axis=0)
    mean = np.ones(3) if picture is None else map_mean(picture, body, nm)
    towards = lights.towards(light, body.centre[None])[0]
    place = lights.place_of(light)
    uniforms = {
        **_vector("body_color", color / mean),
        **_vector("body_light", local @ towards),
        "light_parallax": 0.0
        if place is None
        else radius / float(np.linalg.norm(place - body.centre)),
        "light_radius": source.angular_radius,
    }
    if shade is None and light.star is not None:
        shade = lights.shade(light, body)
    if shade is None:
        return uniforms | {"shaded": 0.0}, None
    offset = system.body(shade.body.name).centre - body.centre
    distance = float(np.linalg.norm(offset))
    angles = shade.separations
    left = np.divide(
        shade.left @ colors, color, out=np.zeros((angles.size, 3)), where=np.abs(color) > 0.0
    )
    uniforms |= {
        **_vector("shade", local @ offset / distance),
        "shaded": 1.0,
        "shade_parallax": radius / distance,
        "shade_radius": shade.radius,
        "shade_first": float(angles[0]),
        "shade_step": (angles.size - 1) / float(angles[-1] - angles[0]),
    }
    return uniforms, left


def _vector(name: str, values: Any) -> dict[str, float]:
    return {f"{name}_{axis}": float(value) for axis, value in zip("xyz", values, strict=True)}
