"""Lights of a scene behind its moon: what an eclipse leaves, as their observer sees it.

The disc is hidden pixel by pixel. Air and ground are lit by the part of it that the observer sees,
at each wavelength, darkened towards its rim. ``EclipsedSolution`` knows that part at every point
and takes minutes; against it a clear sky over London in 2026 is off by 1 % where 0.6 of the sun's
light is left and by 8 % where 0.06 is, over Spain by 20 % three minutes before totality. In
totality, where all light comes from the air around the umbra, the sky is held at a share of the
day's: by and large right, but without its bright horizon.
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

#: Share of its light that a hidden star leaves to the air: what the air around an umbra sends into
#: it. [1]
DARKEST: Final = 4.5e-4
#: Wavelength of the share that the disc's radiance refers to. [nm]
_MIDDLE: Final = 550.0
#: Linear darkening of the sun's disc there, and points of an integral over its radius. [1]
_DARKENING: Final = 0.6
_POINTS: Final = 128


@kernel
def light_left(star_radius, separation, radius):
    """Share of a sun's light that a moon leaves, at least ``DARKEST``: for hosts in any language.

    Parameters
    ----------
    star_radius, separation, radius : float
        Angular radius of the sun, distance of the moon's middle from its, radius of the moon. [rad]

    Returns
    -------
    float
        Share, as that of ``visible_light`` by a linear law of darkening, to 0.01. [1]

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
    """Radiance of a disc over its irradiance behind a moon, over that without; 0 if all is hidden.

    Parameters
    ----------
    left : float
        Share of the light that the moon leaves, at least ``DARKEST``. [1]
    """
    return 1.0 / left if left > DARKEST else 0.0


def occulted_light(
    source: LightSource, light: LightPosition, lights: Sequence[LightPosition]
) -> LightSource:
    """Source of a light behind the moons of a scene; itself where none is in front of it.

    Parameters
    ----------
    source : LightSource
        Source of the light.
    light : LightPosition
        The light.
    lights : sequence of LightPosition
        Lights of the scene; of several moons the one nearest to the light's middle is taken.
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
        math.degrees(alpha), [math.degrees(nearest)], [found.angular_radius],
        darkening=source.darkenings,
    )  # fmt: skip
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
