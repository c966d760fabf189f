"""Frame sizes: fitting to a window, and scaling of a scene's resolution."""

from __future__ import annotations

from dataclasses import replace

from airlight.scene.projections import PROJECTIONS
from airlight.scene.scene import Scene


def fitting(projection: str, width: int, height: int) -> tuple[int, int]:
    """Largest size with a projection's aspect ratio that fits into a window. [pixel]

    Parameters
    ----------
    projection : str
        Name from ``PROJECTIONS``.
    width, height : int
        Size of the window. [pixel]

    Examples
    --------
    >>> fitting("equirectangular", 1280, 720), fitting("perspective", 1280, 720)
    ((1280, 640), (1280, 720))
    """
    ratio = PROJECTIONS[projection].aspect
    if ratio is None:
        return max(1, width), max(1, height)
    side = max(1, min(height, width // ratio))
    return ratio * side, side


def reduced(projection: str, width: int, height: int, most: int) -> tuple[int, int]:
    """Size of the same shape, as far as the projection allows, of limited width. [pixel]

    Parameters
    ----------
    projection : str
        Name from ``PROJECTIONS``.
    width, height : int
        Size of the frame. [pixel]
    most : int
        Largest width. [pixel]

    Examples
    --------
    >>> reduced("perspective", 1280, 720, 64), reduced("cubemap", 384, 64, 100)
    ((64, 36), (96, 16))
    """
    part = min(1.0, most / width)
    return fitting(projection, round(part * width), round(part * height))


def resized(scene: Scene, width: int, height: int) -> Scene:
    """Scene with the largest frame that fits into a size.

    Parameters
    ----------
    scene : Scene
        Scene with the camera.
    width, height : int
        Maximum size. [pixel]
    """
    wide, high = fitting(scene.camera.projection, width, height)
    return replace(scene, camera=replace(scene.camera, width=wide, height=high))


def scaled(scene: Scene, part: float) -> Scene:
    """Scene with the resolution scaled by ``part`` per side.

    Parameters
    ----------
    part : float
        Scale of width and height. [1]

    Examples
    --------
    >>> small = scaled(Scene(), 0.25).camera
    >>> small.width, small.height
    (320, 180)
    """
    camera = scene.camera
    return resized(scene, round(camera.width * part), round(camera.height * part))
