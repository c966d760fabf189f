"""Disc of a light, rendered at high resolution, as a separate light or as part of a map.

As map texels are often larger than the sun, the disc is rendered in a separate small frame with
many pixels across it, which are then accumulated in the texels of the map. This conserves the
irradiance at any map resolution.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.engines.environment.gamut import grey_of, without_negatives
from airlight.engines.environment.ground import horizon_cosine
from airlight.engines.environment.texels import texel_solid_angles, texels_of
from airlight.physics.constants import LUMINOUS_EFFICACY
from airlight.render.cpu_renderer import CpuRenderer
from airlight.render.pixels.scenes_by_light import SceneForLight
from airlight.scene.apparent_sun import apparent_altitude
from airlight.scene.camera import Camera

FloatArray = NDArray[np.float64]

#: Smallest and largest width of the small picture. [pixel]
_FEWEST: Final = 160
_MOST: Final = 2048
#: Smallest number of its pixels per texel of the map.
_PER_TEXEL: Final = 8
#: Half width relative to the radius of the disc, and for a disc whose centre may be below the
#: horizon.
_HALF_WIDTH: Final = 1.25
_HALF_WIDTH_LOW: Final = 2.5
#: Transmittance below which a disc is invisible, as on the ground of Venus. [1]
_UNSEEN: Final = 1e-12
#: Pixels across the disc, at least. [pixel]
_ACROSS: Final = 60
#: Smallest and largest half width. [rad]
_SMALLEST: Final = math.radians(1e-3)
_WIDEST: Final = math.radians(30.0)


@dataclass(frozen=True, kw_only=True, eq=False)
class Disc:
    """Disc of a light as attenuated and refracted by the atmosphere.

    Attributes
    ----------
    name : str
        Name of the light source.
    directions : array, shape (n, 3)
        Directions of the pixels of the disc's frame in ENU: x east, y north, z up. [1]
    light : array, shape (n, 3)
        Normal irradiance of each pixel: linear sRGB, not negative. [W m⁻²]
    angular_diameter : float
        Angular diameter without refraction. [deg]
    darkening : array, shape (3, 6)
        Limb darkening at the ground of red, green and blue: coefficients of powers of the cosine of
        emergence, of the radiance relative to its mean. [1]
    moved : array, shape (3,)
        Change of the irradiance by gamut mapping. [W m⁻²]
    """

    name: str
    directions: FloatArray
    light: FloatArray
    angular_diameter: float
    darkening: FloatArray
    moved: FloatArray

    @property
    def direction(self) -> FloatArray:
        """Unit vector to the centroid of its radiance in ENU, shape (3,). [1]"""
        total = grey_of(self.light) @ self.directions
        return np.asarray(total / np.linalg.norm(total))

    @property
    def irradiance(self) -> FloatArray:
        """Normal irradiance, linear sRGB, shape (3,). [W m⁻²]"""
        return np.asarray(self.light.sum(axis=0))

    @property
    def illuminance(self) -> float:
        """Normal illuminance. [lx]"""
        return LUMINOUS_EFFICACY * float(grey_of(self.irradiance))

    @property
    def gamut_change(self) -> float:
        """Largest change of a channel by gamut mapping, over the luminance. [1]"""
        return float(np.abs(self.moved).max() / grey_of(self.irradiance))

    def put_into(self, rgb: NDArray[np.float32], camera: Camera, to_local: FloatArray) -> None:
        """Add the radiance of the disc to a map.

        Parameters
        ----------
        rgb : array, shape (height, width, 3)
            Linear sRGB radiance, modified in place. [W m⁻² sr⁻¹]
        to_local : array, shape (3, 3)
            Rotation from ENU to the frame of the camera's angles.
        """
        row, column = texels_of(camera, self.directions @ to_local.T)
        shown = row >= 0
        texel, place = np.unique(row[shown] * camera.width + column[shown], return_inverse=True)
        light = np.zeros((texel.size, 3))
        np.add.at(light, place, self.light[shown])
        for one, sent in zip(texel, light, strict=True):
            y, x = divmod(int(one), camera.width)
            solid = texel_solid_angles(camera, slice(y, y + 1))[0]
            rgb[y, x] += (sent / solid[x if solid.size > 1 else 0]).astype(np.float32)


def enu_from_local(sun_azimuth: float) -> FloatArray:
    """Rotation from the local frame to ENU, shape (3, 3). [1]

    Parameters
    ----------
    sun_azimuth : float
        Compass bearing of the sun. [deg]

    Examples
    --------
    >>> enu_from_local(90.0).round(12) @ [1.0, 0.0, 0.0] + 0.0  # a sun in the east
    array([1., 0., 0.])
    """
    turn = math.radians(sun_azimuth)
    east, north = math.sin(turn), math.cos(turn)
    return np.array([[east, -north, 0.0], [north, east, 0.0], [0.0, 0.0, 1.0]])


def seen_disc(lit: SceneForLight) -> Disc | None:
    """Disc of a light through the atmosphere; None if it is not visible.

    Parameters
    ----------
    lit : SceneForLight
        Scene by this light, with the camera of the map.
    """
    scene, solution = lit.scene, lit.solution
    source = solution.lights[0]
    camera = _close_camera(lit)
    if camera is None:
        return None
    renderer = CpuRenderer(solution, replace(scene, camera=camera), exact=True, air=False)
    rgb = np.zeros((camera.height, camera.width, 3), np.float32)
    renderer.render_rows(0, camera.height, rgb)
    lit_pixels = np.any(rgb != 0.0, axis=-1)
    if not lit_pixels.any():
        return None
    outside = float(grey_of(source.colors().sum(axis=0)))
    local = camera.directions()[lit_pixels]
    forward = camera.axes[2]
    # dΩ = p² cos³ of the angle off the axis for a flat picture
    solid = camera.pixel_angle**2 * (local @ forward) ** 3
    raw = rgb[lit_pixels].astype(np.float64) * solid[:, None]
    light, _ = without_negatives(raw)
    if not float(grey_of(light.sum(axis=0))) > _UNSEEN * outside:
        return None
    through = solution.transmittance(
        altitude=scene.altitude,
        view_zenith=math.degrees(math.acos(float(np.clip(local[:, 2].mean(), -1.0, 1.0)))),
    ).values
    weights = np.maximum(source.colors() * through[:, None], 0.0)
    darkening = weights.T @ source.darkenings / np.maximum(weights.sum(axis=0), 1e-300)[:, None]
    return Disc(
        name=source.name,
        directions=local @ enu_from_local(scene.sun_azimuth).T,
        light=light,
        angular_diameter=math.degrees(2.0 * source.angular_radius),
        darkening=darkening,
        moved=light.sum(axis=0) - raw.sum(axis=0),
    )


def _close_camera(lit: SceneForLight) -> Camera | None:
    """Camera of the high-resolution frame; None for a light below the horizon."""
    scene, solution = lit.scene, lit.solution
    radius = solution.lights[0].angular_radius
    zenith, width = scene.sun_zenith, _HALF_WIDTH
    planet = solution.planet
    lift = solution.geometry.max_refraction
    medium = solution.medium
    outside = scene.altitude >= medium.thickness
    horizon = math.degrees(math.acos(horizon_cosine(solution, scene.altitude)))
    reach = width * radius
    if outside:
        passing = (medium.bottom_radius + scene.altitude) * math.sin(math.radians(zenith))
        if zenith > 90.0 and passing < medium.top_radius * (1.0 + reach):
            reach = min(reach + lift, _WIDEST)
    elif lift > 0.0 and planet is not None:
        seen = apparent_altitude(planet, scene.altitude, scene.sun_zenith)
        if seen is None:
            zenith, reach = min(zenith, horizon), _HALF_WIDTH_LOW * radius
        else:
            zenith = 90.0 - seen
    if math.radians(zenith - horizon) > reach + lift:
        return None
    half = max(reach, _SMALLEST)
    texel = scene.camera.pixel_angle
    count = math.ceil(max(2.0 * half / texel * _PER_TEXEL, _ACROSS * half / max(radius, 1e-9)))
    count = min(max(count, _FEWEST), _MOST)
    return Camera(
        width=count,
        height=count,
        field_of_view=math.degrees(2.0 * half),
        look_zenith=zenith,
    )
