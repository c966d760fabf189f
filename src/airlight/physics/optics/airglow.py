r"""Airglow: emissions of thin layers of the upper atmosphere, in rayleigh.

The profile of a layer between the radii r₁ and r₂ is

.. math:: x(r) = \frac{(r_2^2 - r^2)(r^2 - r_1^2)}{\tfrac{1}{6} (r_2 - r_1)^3 (r_1 + r_2)^2}

It is a parabola in r to (r₂ - r₁)/r, has a vertical column of 1, and half of its maximum over
(r₂ - r₁)/√2. Along a straight line r² = b² + s², so that its column is that of a polynomial of
degree four in s, which three points integrate exactly.
"""

from __future__ import annotations

import math
from functools import cache
from math import sqrt
from typing import Final, NamedTuple

from airlight.errors import ParameterError
from airlight.kernel import kernel
from airlight.physics.constants import PLANCK, SPEED_OF_LIGHT
from airlight.physics.optics.data_files import data_names, data_text

#: Photon radiance of one rayleigh, exact. [m⁻² s⁻¹ sr⁻¹] Baker (1974), Appl. Opt. 13, 2160.
RAYLEIGH: Final = 1e10 / (4.0 * math.pi)
#: Prefix of the file names of the tables that ship with the package.
_PREFIX: Final = "airglow-"
#: Gauss-Legendre rule of three points: node and weights on [-1, 1].
_NODE: Final = math.sqrt(0.6)
_OUTER, _MIDDLE = 5.0 / 9.0, 8.0 / 9.0


class Emission(NamedTuple):
    """Emission of a layer: a line, or a band of constant photon radiance per wavelength.

    Attributes
    ----------
    name : str
        Emitter.
    first, last : float
        Limits of its wavelengths, equal for a line. [nm]
    brightness : float
        Zenith brightness without attenuation. [R]
    altitude, width : float
        Altitude of the maximum, and full width at half maximum. [m]
    """

    name: str
    first: float
    last: float
    brightness: float
    altitude: float
    width: float


@cache
def airglow_names() -> tuple[str, ...]:
    """Names of the tables that ship with the package."""
    return data_names(_PREFIX)


@cache
def airglow_emissions(name: str) -> tuple[Emission, ...]:
    """Emissions of the night sky of a body, quiet and at middle latitudes.

    Brightness varies by factors of two from night to night, that of the red line by more.

    Parameters
    ----------
    name : str
        One of ``airglow_names()``.

    Raises
    ------
    ParameterError
        If there is no such table.

    Examples
    --------
    >>> green, *_ = airglow_emissions("earth")
    >>> green.brightness, green.altitude
    (250.0, 95000.0)
    """
    if name not in airglow_names():
        raise ParameterError("airglow", name, ", ".join(("none", *airglow_names())))
    lines = [one for one in data_text(_PREFIX, name).splitlines() if one[:1] != "#"]
    found = []
    for line in lines[1:]:
        emitter, *numbers = line.split(",")
        first, last, brightness, altitude, width = (float(one) for one in numbers)
        found.append(Emission(emitter, first, last, brightness, 1e3 * altitude, 1e3 * width))
    return tuple(found)


def line_radiance(brightness: float, wavelength: float) -> float:
    """Radiance of a spectral line. [W m⁻² sr⁻¹]

    Parameters
    ----------
    brightness : float
        Brightness. [R]
    wavelength : float
        Wavelength. [nm]

    Examples
    --------
    >>> f"{line_radiance(250.0, 557.7):.3e}"
    '7.086e-08'
    """
    return brightness * RAYLEIGH * PLANCK * SPEED_OF_LIGHT / (1e-9 * wavelength)


@kernel
def layer_column(low, high, impact, first, last):
    """Column of a layer along a part of a straight line, over its vertical column. [1]

    Parameters
    ----------
    low, high : float
        Radii r₁ and r₂ of the layer. [m]
    impact : float
        Smallest distance b of the line from the centre. [m]
    first, last : float
        Distances s along the line from there, both in the layer; 0 unless they ascend. [m]
    """
    if last <= first:
        return 0.0
    middle, half = 0.5 * (first + last), 0.5 * (last - first)
    thick, both = high - low, high + low
    total = 0.0
    for k in range(3):
        s = middle + half * (k - 1.0) * _NODE
        r = sqrt(impact * impact + s * s)
        inner = (high - r) / thick * ((high + r) / both)
        outer = (r - low) / thick * ((r + low) / both)
        weight = _MIDDLE if k == 1 else _OUTER
        total += weight * inner * outer
    return 6.0 * half / thick * total


@kernel
def layer_columns(low, high, impact, start):
    """Columns of a layer on the near and on the far half of a line, over its vertical column. [1]

    Parameters
    ----------
    low, high, impact :
        Arguments of ``layer_column``.
    start : float
        Distance of the line's start from its point nearest to the centre; negative before it. [m]

    Returns
    -------
    near, far : float
        Column before and beyond the point nearest to the centre. [1]
    """
    if impact >= high:
        return 0.0, 0.0
    leaving = sqrt((high - impact) * (high + impact))
    entering = sqrt(max((low - impact) * (low + impact), 0.0))
    near = layer_column(low, high, impact, max(-leaving, start), -entering)
    far = layer_column(low, high, impact, max(entering, start), leaving)
    return near, far
