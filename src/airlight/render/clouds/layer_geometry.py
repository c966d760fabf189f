"""Place, cells and extinction of clouds, as the pixels read them."""

from __future__ import annotations

from typing import Any

from airlight.clouds.cloud_field import CloudField
from airlight.render.clouds.cloud_light import field_axes
from airlight.render.clouds.patches import patch_edges
from airlight.scene import Scene


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
        "edges": patch_edges(*field.sides),
    }
