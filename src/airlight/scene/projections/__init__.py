"""Registry of projections; a new projection is a module here and a line below."""

from __future__ import annotations

from airlight.scene.projections.cubemap import CUBEMAP
from airlight.scene.projections.equirectangular import EQUIRECTANGULAR
from airlight.scene.projections.fisheye import FISHEYE
from airlight.scene.projections.octahedral import OCTAHEDRAL
from airlight.scene.projections.orthographic import ORTHOGRAPHIC
from airlight.scene.projections.perspective import PERSPECTIVE
from airlight.scene.projections.projection import Projection

#: Every projection under its name.
PROJECTIONS: dict[str, Projection] = {
    projection.name: projection
    for projection in (
        PERSPECTIVE,
        FISHEYE,
        EQUIRECTANGULAR,
        CUBEMAP,
        OCTAHEDRAL,
        ORTHOGRAPHIC,
    )
}

__all__ = ["PROJECTIONS", "Projection"]
