"""Place, cells and extinction of clouds, as the pixels read them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from airlight.clouds.cloud_field import CloudField
from airlight.render.clouds.incident_light import field_axes
from airlight.render.clouds.inner_box import WIDTH
from airlight.render.clouds.patches import displacements, patch_edges

if TYPE_CHECKING:
    from airlight.scene import Scene

#: Step of the place of a finer box. [m]
_STEP: Final = 0.5 * WIDTH


def seen_place(field: CloudField, scene: Scene, radius: float) -> tuple[float, float]:
    """Where the middle of a picture crosses the middle height of a field: east and north. [m]

    In whole steps, so that pictures side by side share their light; the place below the observer,
    if the line does not cross it inside the field.

    Parameters
    ----------
    field : CloudField
        Clouds.
    scene : Scene
        Scene with the camera.
    radius : float
        Radius of the ground. [m]
    """
    east, north, up = (np.array(axis) for axis in field_axes(field, scene))
    ray, eye = np.array(scene.camera.axes[2]), radius + scene.altitude
    middle = radius + 0.5 * (field.base + field.top)
    root = middle**2 - eye**2 * (1.0 - ray[2] ** 2)
    half = math.sqrt(max(root, 0.0))
    for way in (-eye * ray[2] - half, -eye * ray[2] + half):
        point = way * ray + [0.0, 0.0, eye]
        height = float(point @ up)
        place = radius * float(point @ east) / height, radius * float(point @ north) / height
        inside = all(abs(one) < 0.5 * side for one, side in zip(place, field.sides, strict=True))
        if root > 0.0 and way > 0.0 and height > 0.0 and inside:
            return _STEP * round(place[0] / _STEP), _STEP * round(place[1] / _STEP)
    return 0.0, 0.0


def layer_geometry(field: CloudField, scene: Scene, radius: float) -> dict[str, Any]:
    """Parameters of ``LayerTables`` that do not depend on light.

    Parameters
    ----------
    field : CloudField
        Clouds.
    scene : Scene
        Scene, in whose local frame the axes are.
    radius : float
        Radius of the ground. [m]
    """
    east, north, up = field_axes(field, scene)
    step_x, step_y, step_z = (float(step) for step in field.spacing)
    edges = patch_edges(*field.sides)
    if field.beyond == "periodic":
        moved = displacements(field.column_optical_depth > 0.0, *field.sides)
        edges = edges._replace(moved=moved)
    return {
        "radius": radius,
        "base": radius + field.base,
        "top": radius + field.top,
        "corner_x": field.west,
        "corner_y": field.south,
        "step_x": step_x,
        "step_y": step_y,
        "step_z": step_z,
        "periodic": field.beyond == "periodic",
        "detailed": field.interpolated and scene.ground == "detailed",
        "trail": field.trail,
        "east": east,
        "north": north,
        "up": up,
        "edges": edges,
    }
