"""Eclipse of a light by the Moon in single-planet scenes.

The disc is occulted pixel by pixel. Air and ground are illuminated uniformly by the fraction of the
limb-darkened disc that is visible to the observer. Against ``EclipsedSolution``, which resolves
that fraction in space and takes minutes, a clear sky over London in 2026 is off by 1 % at 0.6 of
the irradiance and by 8 % at 0.06, over Spain by 20 % three minutes before totality. In totality,
when light comes from around the umbra, the sky is a constant fraction of the daylight, without its
bright horizon.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from airlight.geometry.disc_overlap import covered_half_arc, visible_light
from airlight.kernel import kernel
from airlight.planets.light_source import LightSource, Occulter
from airlight.scene.light_position import LightPosition
from airlight.scene.moon_light import MoonLight

#: Irradiance fraction in totality, for light scattered into the umbra. [1]
DARKEST: Final = 4.5e-4
#: Reference wavelength of the visible fraction. [nm]
_MIDDLE: Final = 550.0
#: Linear limb-darkening coefficient, and quadrature points over the radius. [1]
_DARKENING: Final = 0.6
_POINTS: Final = 128


@kernel
def light_left(star_radius, separation, radius):
    """Unocculted fraction of a star's irradiance, at least ``DARKEST``; also emitted as JavaScript.

    Parameters
    ----------
    star_radius, separation, radius : float
        Angular radius of the sun, separation of the centres, angular radius of the moon. [rad]

    Returns
    -------
    float
        Fraction, as ``visible_light`` with linear limb darkening, accurate to 0.01. [1]

    Examples
    --------
    >>> light_left(0.004, 0.0, 0.005) == DARKEST, light_left(0.004, 0.01, 0.005)
    (True, 1.0)
    """
    left, whole = 0.0, 0.0
    for k in range(_POINTS):
        mu = (k + 0.5) / _POINTS
        light = mu * (1.0 - _DARKENING + _DARKENING * mu)
        rho = star_radius * math.sqrt((1.0 - mu) * (1.0 + mu))
        left += light * (1.0 - covered_half_arc(rho, separation, radius) / math.pi)
        whole += light
    return max(left / whole, DARKEST)


@kernel
def disc_factor(left):
    """Factor of radiance per irradiance of a partly occulted disc; 0 in totality. [1]

    Parameters
    ----------
    left : float
        Result of ``light_left``. [1]
    """
    return 1.0 / left if left > DARKEST else 0.0


def occulted_light(
    source: LightSource, light: LightPosition, lights: Sequence[LightPosition]
) -> LightSource:
    """Light source, dimmed if a moon of the scene occults it.

    Parameters
    ----------
    lights : sequence of LightPosition
        Lights of the scene; only the moon nearest to the light occults it.
    """
    if isinstance(light, MoonLight):
        return source
    towards, alpha = light.direction, source.angular_radius
    nearest, found = math.inf, None
    for moon in lights:
        if isinstance(moon, MoonLight):
            apart = 2.0 * math.asin(min(0.5 * math.dist(towards, moon.direction), 1.0))
            if apart < min(nearest, alpha + math.radians(moon.angular_radius)):
                nearest, found = apart, moon
    if found is None:
        return source
    left = visible_light(
        math.degrees(alpha),
        [math.degrees(nearest)],
        [found.angular_radius],
        darkening=source.darkenings,
    )
    left = np.maximum(left, DARKEST)
    middle = float(np.interp(_MIDDLE, source.wavelengths, left))
    turned = LightPosition(zenith=found.zenith, azimuth=found.azimuth - light.azimuth)
    x, y, z = turned.direction
    return replace(
        source,
        irradiance=source.irradiance * left,
        occulter=Occulter(x, y, z, math.radians(found.angular_radius), middle),
        hidden=middle / left,
    )
