"""Uniforms of the shaders from a scene, a display and the orders of scattering."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.color.encoding import ENCODINGS
from airlight.color.exposure import exposure_factor
from airlight.color.tone_maps import TONE_MAPS
from airlight.errors import ParameterError
from airlight.geometry.bending import seen_star
from airlight.pixels.observer_numbers import observer_numbers
from airlight.pixels.pixel import Screen
from airlight.pixels.sky_by_processor import SkyLayers
from airlight.pixels.sky_table import Observer
from airlight.scene import Camera, Scene
from airlight.scene.projections import PROJECTIONS
from airlight.solvers.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Values of ``orders``, with their numbers in the shaders.
ORDERS: Final = {"all": 2, "single": 1, "multiple": 0}


def scene_numbers(scene: Scene, solution: MomentsSolution) -> dict[str, float]:
    """Uniforms of observer, star and camera, for one light: the first of the solution's.

    Parameters
    ----------
    scene : Scene
        Observer, star and camera.
    solution : MomentsSolution
        Solution of the planet.

    Returns
    -------
    dict
        Values by name.
    """
    camera, medium = scene.camera, solution.paths.medium
    true_r = solution.medium.bottom_radius + scene.altitude
    r = float(solution.paths.optical_radius(np.array(true_r)))
    outside = scene.altitude >= solution.medium.thickness
    bottom = medium.bottom_radius
    sun = scene.sun_direction
    seen, lift = sun[2], solution.paths
    if lift.shell is not None and not outside:
        seen = float(seen_star(r, sun[2], lift.shell.bottom, lift.shell.top, lift.lift)[0])
    axes = camera.axes
    assert camera.field_of_view is not None
    star_radius = solution.lights[0].angular_radius
    horizon_mu, horizon_sine, sun_level, seen_level, disc = observer_numbers(
        r, bottom, float(sun[0]), float(sun[1]), seen, star_radius
    )
    numbers = {
        "r": r,
        "outside": float(outside),
        "horizon_mu": horizon_mu,
        "horizon_sine": horizon_sine,
        "sun_x": sun_level,
        "sun_z": float(sun[2]),
        "seen_x": seen_level,
        "seen_z": seen,
        "field_of_view": np.radians(camera.field_of_view),
        "projection": list(PROJECTIONS).index(camera.projection),
        "pixel_angle": camera.pixel_angle,
        "disc": disc,
    }
    for name, axis in zip(("right", "up", "forward"), axes, strict=True):
        numbers |= {f"{name}_{c}": float(value) for c, value in zip("xyz", axis, strict=True)}
    for name, row in zip("xyz", scene.ground_frame, strict=True):
        numbers |= {f"{name}{c}": float(value) for c, value in zip("xyz", row, strict=True)}
    return numbers


def observer_from(numbers: Mapping[str, float]) -> Observer:
    """Observer, from the numbers of a scene and of the orders of scattering.

    Parameters
    ----------
    numbers : mapping
        Numbers by name.
    """
    values: dict[str, Any] = {name: float(numbers[name]) for name in Observer._fields}
    values["outside"] = bool(values["outside"])
    values["orders"] = int(values["orders"])
    return Observer(**values)


def screen_from(
    numbers: Mapping[str, float],
    camera: Camera,
    ground: tuple[FloatArray, Float32Array] | None,
    layers: SkyLayers,
) -> Screen:
    """Camera, ground map and table of the sky, as the CPU reads them.

    Parameters
    ----------
    numbers : mapping
        Numbers of the scene, and whether the star's disc is drawn.
    camera : Camera
        Camera of the scene.
    ground : tuple of arrays
        Map from ``SurfaceMap.flat``; None without a map.
    layers : SkyLayers
        Layers of a window of the table, which has its own sizes.
    """
    levels, texels = ground or (np.zeros((1, 3)), np.zeros(3, np.float32))
    values: dict[str, Any] = {
        name: float(numbers[name]) for name in Screen._fields if name in numbers
    }
    values |= {
        "width": float(camera.width),
        "height": float(camera.height),
        "projection": int(numbers["projection"]),
        "draws_disc": bool(numbers["draws_disc"]),
        "mapped": ground is not None,
        "map_levels": len(levels),
        "levels": levels,
        "texels": texels,
        "sky_columns": 0,
        "sky_rows": 0,
        "keeps_peaks": layers.first.size > 1,
        "sky_air": layers.air,
        "sky_ground": layers.ground,
        "sky_first": layers.first,
        "sky_second": layers.second,
    }
    return Screen(**values)


def display_numbers(exposure: float, tone_map: str, encoding: str | None) -> dict[str, float]:
    """Uniforms of exposure, tone map and encoding.

    Parameters
    ----------
    exposure : float
        Exposure. [EV]
    tone_map : str
        Name from ``TONE_MAPS``.
    encoding : str or None
        Name from ``ENCODINGS``; None for a target that encodes by itself.

    Raises
    ------
    ParameterError
        If a name is unknown.
    """
    if tone_map not in TONE_MAPS:
        raise ParameterError("tone_map", tone_map, ", ".join(TONE_MAPS))
    if encoding is not None and encoding not in ENCODINGS:
        raise ParameterError("encoding", encoding, ", ".join(ENCODINGS))
    return {
        "exposure": exposure_factor(exposure),
        "tone_map": list(TONE_MAPS).index(tone_map),
        "encoding": -1.0 if encoding is None else list(ENCODINGS).index(encoding),
    }


def order_number(orders: str) -> float:
    """Orders of scattering, as the shaders number them.

    Parameters
    ----------
    orders : str
        Name from ``ORDERS``.

    Raises
    ------
    ParameterError
        If the name is unknown.
    """
    if orders not in ORDERS:
        raise ParameterError("orders", orders, ", ".join(ORDERS))
    return float(ORDERS[orders])
