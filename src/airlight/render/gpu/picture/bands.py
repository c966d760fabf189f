"""Parts of a frame in which something may be visible, for which a GPU can skip the others."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.render.pixels.scenes_by_light import SceneForLight
from airlight.scene import Camera, Scene
from airlight.scene.projections.projected import projected_rays

#: First column and row of a part of a frame, and its size. [pixel]
Window = tuple[int, int, int, int]

#: Rows of a band, and columns between two of its samples. [pixel]
_STEP: Final = 16

#: Pixels per submission: interpolated, marched, and marched in software. It stays below the
#: watchdog limits of drivers, and a strip that is read back takes 64 MiB at most.
_PIXELS_AT_ONCE: Final = (1 << 22, 1 << 20, 1 << 16)


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


def bands_of(
    light: SceneForLight, uniforms: Mapping[str, float], size: tuple[int, int]
) -> list[Band]:
    """Bands of rows of a frame of one light; one with everything for a part of the frame.

    Parameters
    ----------
    uniforms : mapping
        Uniforms of the frame.
    size : (int, int)
        Size of the target. [pixel]
    """
    scene, solution = light.scene, light.solution
    if size != (scene.camera.width, scene.camera.height):
        return [Band(0, size[1], True, True, True)]
    star = (uniforms["seen_x"], 0.0, uniforms["seen_z"])
    reach = 2.0 * solution.lights[0].angular_radius + 3.0 * uniforms["pixel_angle"]
    return bands(scene, uniforms["horizon_mu"], star, reach + solution.geometry.max_refraction)


def rows_at_once(width: int, height: int, exact: bool, software: bool) -> int:
    """Rows per submission.

    Parameters
    ----------
    width, height : int
        Size of the target, with all samples of a row. [pixel]
    exact, software : bool
        Whether every pixel is marched, and whether the device is the CPU.
    """
    pixels = _PIXELS_AT_ONCE[(2 if software else 1) if exact else 0]
    return min(max(1, pixels // width), height)


def area_of(
    camera: Camera, towards: NDArray[np.float64], radius: float, window: Window
) -> Window | None:
    """Smallest known rectangle of a window with all pixels near a direction.

    Parameters
    ----------
    towards : array, shape (3,)
        Direction in the camera's frame. [1]
    radius : float
        Angle from it. [rad]
    window : (int, int, int, int)
        First column and row of the window in the frame, and its size. [pixel]

    Returns
    -------
    (int, int, int, int) or None
        First column and row in the window, and size; None if no pixel is near. [pixel]
    """
    assert camera.field_of_view is not None
    left, top, columns, rows = window
    x, y = (
        np.minimum(np.arange(-(-size // _STEP) + 1) * _STEP, size) + first
        for first, size in ((left, columns), (top, rows))
    )
    field = np.radians(camera.field_of_view)
    rays = projected_rays(
        camera.projection, x.astype(float), y.astype(float), camera.width, camera.height, field
    )
    near = rays @ towards > np.cos(min(radius + _STEP * camera.pixel_angle, np.pi))
    # a cell belongs to the area if one of its corners is near
    cells = near[:-1, :-1] | near[1:, :-1] | near[:-1, 1:] | near[1:, 1:]
    across, down = np.flatnonzero(cells.any(axis=0)), np.flatnonzero(cells.any(axis=1))
    if not across.size:
        return None
    first, above = _STEP * int(across[0]), _STEP * int(down[0])
    last = min(_STEP * (int(across[-1]) + 1), columns)
    below = min(_STEP * (int(down[-1]) + 1), rows)
    return first, above, last - first, below - above
