"""Metering: solid-angle weights of pixels for the automatic exposure, without discs of stars."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.vectors import Vec3, cross, dot, minus
from airlight.image.exposure import metered_pixels, sampling_step, unlit_exposure
from airlight.image.star_exposure import exposure_with_stars
from airlight.image.xyz import luminance
from airlight.kernel import compiled_loop, kernel
from airlight.physics.optics.clouds import clouds_shown
from airlight.scene.light_position import LightPosition
from airlight.scene.picture_size import scaled
from airlight.scene.projections import PROJECTIONS
from airlight.scene.projections.projected import projected_ray
from airlight.scene.scene import Scene

if TYPE_CHECKING:
    from airlight.planets.light_source import LightSource

FloatArray = NDArray[np.float64]

#: Width of the picture that a GPU renders for metering: relative to the next larger one the
#: exposure differs by a few hundredths of a stop; with 64 pixels by a quarter stop where the
#: aureole of a low sun covers a few pixels. [pixel]
METERED: Final = 128
#: Exposure added behind a polariser, which halves unpolarised light. [EV]
FILTER: Final = 1.0
#: Angle around a star's disc that is excluded with it: refraction near the horizon raises a star by
#: up to 0.6°, and a pixel may contain a part of the disc. [rad]
_MARGIN: Final = math.radians(0.75)
#: Longest exposure without haze, over that of a white surface that faces the star. [EV]
_DEHAZED: Final = 1.8
#: Offset of the points whose rays determine a pixel's solid angle. [pixel]
_NEAR: Final = 0.25


@kernel
def left_out(angular_radius, pixel_angle):
    """Cosine of the angle around a star within which pixels are excluded. [1]

    Parameters
    ----------
    angular_radius : float
        Angular radius of the star. [rad]
    pixel_angle : float
        Angle of a pixel. [rad]
    """
    return math.cos(min(angular_radius + _MARGIN + pixel_angle, 0.5 * math.pi))


@kernel
def metering_weight(projection, x, y, width, height, field_of_view, sun, cosine):
    """Solid angle of a pixel, negative near the star's disc, 0 outside the projection. [sr]

    Parameters
    ----------
    projection : int
        Index in ``PROJECTIONS``.
    x, y : float
        Centre of the pixel, from the left and the top edge. [pixel]
    width, height : float
        Size of the frame. [pixel]
    field_of_view : float
        Field of view of the projection's ``ray``. [rad]
    sun : Vec3
        Unit vector towards the star, in the camera's frame. [1]
    cosine : float
        Result of ``left_out``. [1]

    Returns
    -------
    float
        Signed solid angle. [sr]
    """
    ray = projected_ray(projection, x, y, width, height, field_of_view)
    if dot(ray, ray) < 0.5:
        return 0.0
    sign = -1.0 if dot(ray, sun) > cosine else 1.0
    left = projected_ray(projection, x - _NEAR, y, width, height, field_of_view)
    right = projected_ray(projection, x + _NEAR, y, width, height, field_of_view)
    above = projected_ray(projection, x, y - _NEAR, width, height, field_of_view)
    below = projected_ray(projection, x, y + _NEAR, width, height, field_of_view)
    area = dot(ray, cross(minus(right, left), minus(below, above)))
    return sign * abs(area) / (4.0 * _NEAR * _NEAR)


@compiled_loop
def _fill(projection, x, y, width, height, field_of_view, suns, out, light):
    for row in range(y.size):
        for column in range(x.size):
            for sun in range(suns.shape[0]):
                weight = metering_weight(
                    projection, x[column], y[row], width, height, field_of_view,
                    Vec3(suns[sun, 0], suns[sun, 1], suns[sun, 2]), suns[sun, 3],
                )  # fmt: skip
                if sun == 0 or weight < 0.0:
                    out[row, column] = weight
                if weight < 0.0:
                    light[row, column] = sun
                    break


@kernel
def dehazed_exposure(exposure, white, mu_s, dehaze, altitude):
    r"""Exposure of a frame without haze: at most that of a camera, for which the haze was there.

    .. math:: \log_2 \frac{1}{L_w \mu} + 1.8, \quad \mu = \min(2 \mu_s, 1)

    by eye; five views of land, sea and clouds from 400 km with haze have 1.1 to 1.6 EV. A sea
    without haze is dark, as in a photograph.

    Parameters
    ----------
    exposure : float
        Metered exposure. [EV]
    white : float
        Result of ``white_luminance``; 0 if unknown. [W m⁻² sr⁻¹]
    mu_s : float
        Cosine of the star's zenith angle below the observer. [1]
    dehaze, altitude : float
        ``Camera.dehaze`` [1], and altitude of the observer. [m]

    Examples
    --------
    >>> dehazed_exposure(3.0, 1.0, 0.5, 1.0, 4e5), dehazed_exposure(3.0, 1.0, 0.5, 0.0, 4e5)
    (1.8, 3.0)
    """
    if white <= 0.0 or mu_s <= 0.0:
        return exposure
    longest = _DEHAZED - math.log2(white * min(2.0 * mu_s, 1.0))
    share = min(2.0 * dehaze, 1.0) * clouds_shown(altitude, True, True)
    return exposure - share * max(exposure - longest, 0.0)


def metering_weights(
    scene: Scene, angular_radius: float, step: int = 1
) -> tuple[FloatArray, FloatArray]:
    """Solid angles of all pixels, and the light near each.

    Parameters
    ----------
    scene : Scene
        Scene with camera and lights.
    step : int
        Step between evaluated rows and columns. [pixel]

    Returns
    -------
    weights : array, shape (ceil(rows / step), ceil(columns / step))
        Solid angles, below 0 near the discs of the lights, 0 outside the frame. [sr]
    light : array, shape (ceil(rows / step), ceil(columns / step))
        Index of the first light near each pixel. [1]

    Examples
    --------
    >>> from airlight.scene import Camera
    >>> sphere = Scene(camera=Camera(projection="equirectangular", width=64, height=32))
    >>> f"{abs(metering_weights(sphere, 0.0)[0]).sum() / (4.0 * np.pi):.2f}"
    '1.00'
    """
    camera = scene.camera
    assert camera.field_of_view is not None
    x = np.arange(camera.left, camera.left + camera.columns, step) + 0.5
    y = np.arange(camera.top, camera.top + camera.rows, step) + 0.5
    towards = np.array([one.direction for one in scene.lights]) @ camera.axes.T
    pixel = step * camera.pixel_angle
    cosines = np.array([left_out(one.radius(angular_radius), pixel) for one in scene.lights])
    if camera.parallel:  # no disc is rendered
        cosines[:] = math.inf
    suns = np.column_stack([towards, cosines])
    out, light = np.zeros((2, y.size, x.size))
    _fill(
        list(PROJECTIONS).index(camera.projection), x, y, float(camera.width),
        float(camera.height), math.radians(camera.field_of_view), suns, out, light,
    )  # fmt: skip
    return out, light


def unfiltered(scene: Scene) -> Scene:
    """Scene at the size for metering, without a polariser.

    The exposure is that of the picture without the filter and ``FILTER``: metered through it, the
    sky that the filter darkens would be shown as bright as before, and the ground too bright.
    """
    small = scaled(scene, min(1.0, METERED / scene.camera.width))
    return replace(small, camera=replace(small.camera, polariser=None))


def white_luminance(
    lights: Iterable[LightPosition],
    sources: tuple[LightSource, ...],
    weights: FloatArray | None = None,
) -> float:
    """Luminance of a white surface that faces all lights, outside the air: E / π. [W m⁻² sr⁻¹]

    Parameters
    ----------
    lights : iterable of LightPosition
        Visible lights; one that a moon occults counts in full.
    sources : tuple of LightSource
        Sources of the planet: ``Solution.lights``.
    weights : array, shape (nl, 3), optional
        Argument of ``LightSource.colors`` for the planet's star. [1]
    """
    total = np.zeros(3)
    for light in lights:
        source = light.source(sources)
        total += source.colors(weights if source is sources[0] else None).sum(axis=0)
    return max(float(luminance(total)), 0.0) / math.pi


def scene_exposure(
    rgb: NDArray[np.floating], scene: Scene, angular_radius: float, white: float = 0.0
) -> float:
    """Automatic exposure of a frame, independent of its size.

    Pixels away from the discs of the lights determine ``automatic_exposure``. A disc in view limits
    it, see ``airlight.image.star_exposure.star_limited``; in a frame of a disc alone, the disc
    determines the exposure.

    Parameters
    ----------
    rgb : array, shape (height, width, 3)
        Linear sRGB of the frame. [W m⁻² sr⁻¹]
    scene : Scene
        Scene with camera and lights.
    angular_radius : float
        Angular radius of the star. [rad]
    white : float, optional
        Result of ``white_luminance``; 0 if unknown. [W m⁻² sr⁻¹]

    Returns
    -------
    float
        Exposure, -100 to 100; ``unlit_exposure`` for a black frame. [EV]
    """
    step = sampling_step(*rgb.shape[:2])
    weights, light = metering_weights(scene, angular_radius, step)
    bright, cool = metered_pixels(rgb, step, weights)
    seen = np.isfinite(bright) & (weights != 0.0)
    lit = seen & (bright > 0.0)
    if not lit.any():
        return float(unlit_exposure(white))
    black = float(weights[seen & ~lit & (weights > 0.0)].sum())
    order = np.argsort(bright[lit])
    own = weights[lit][order]
    exposure = exposure_with_stars(
        bright[lit][order],
        np.maximum(own, 0.0),
        np.maximum(-own, 0.0),
        light[lit][order],
        cool[lit][order],
        len(scene.lights),
        black,
        float(np.abs(weights[seen]).sum()),
        white,
    )
    dehaze, mu_s = scene.camera.dehaze, math.cos(math.radians(scene.sun_zenith))
    return float(dehazed_exposure(exposure, white, mu_s, dehaze, scene.altitude))
