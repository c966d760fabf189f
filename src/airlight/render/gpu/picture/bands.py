"""Bands of rows without ground, star or edges, for which a software GPU can skip work."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np

from airlight.scene import Scene
from airlight.scene.projections.projected import projected_rays

#: Rows of a band, and columns between two of its samples. [pixel]
_STEP: Final = 16


class Band(NamedTuple):
    """Contiguous rows with the same shader.

    Attributes
    ----------
    first, rows : int
        First row and number of rows. [pixel]
    ground, star, edge : bool
        Whether the ground, the star's disc or the ground's edge may be visible.
    """

    first: int
    rows: int
    ground: bool
    star: bool
    edge: bool


def bands(
    scene: Scene, lowest_up: float, star: tuple[float, float, float], reach: float
) -> list[Band]:
    """Bands of rows of a frame and which of ground, star and edge each may show.

    An element may be listed although no pixel shows it, but not the reverse.

    Parameters
    ----------
    lowest_up : float
        Sine of the elevation of the horizon or, from outside, of the limb. [1]
    star : (float, float, float)
        Apparent direction of the star. [1]
    reach : float
        Largest angle between ``star`` and a visible point of its disc. [rad]
    """
    camera = scene.camera
    assert camera.field_of_view is not None
    width, height = camera.width, camera.height
    x = np.linspace(0.0, width, max(2, -(-width // _STEP) + 1))
    firsts = np.arange(0, height, _STEP)
    y = np.concatenate([firsts, [height]]).astype(float)
    field = np.radians(camera.field_of_view)
    rays = projected_rays(camera.projection, x, y, width, height, field) @ camera.axes
    margin = 1.5 * _STEP * camera.pixel_angle
    elevation = np.arcsin(np.clip(rays[..., 2], -1.0, 1.0))
    seen = np.any(rays != 0.0, axis=-1)
    ground = (seen & (elevation < np.arcsin(lowest_up) + margin)).any(axis=1)
    sky = (seen & (elevation > np.arcsin(lowest_up) - margin)).any(axis=1)
    separation = np.arccos(np.clip(rays @ np.asarray(star), -1.0, 1.0))
    near = (seen & (separation < reach + margin)).any(axis=1)
    found: list[Band] = []
    for k, first in enumerate(firsts):
        count = min(_STEP, height - int(first))
        both = [bool(one[k] or one[k + 1]) for one in (ground, near, sky)]
        shows = (both[0], both[1], both[0] and both[2])
        if found and found[-1][2:] == shows:
            found[-1] = found[-1]._replace(rows=found[-1].rows + count)
        else:
            found.append(Band(int(first), count, *shows))
    return found
