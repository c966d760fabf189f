r"""Procedural lamps below the resolution of the map of city lights; they are not data.

Octaves of noise, each a quarter of the previous scale, from a map texel down, divide the light of a
texel between districts, towns and quarters, and, by the lines along which noise vanishes, streets;
the finest cells, 115 m on Earth, have a lamp each. Every factor has the mean 1, and they are
independent, so that the map keeps its mean. Factors finer than two pixels are 1, with a fade
between two and four.
"""

from __future__ import annotations

from math import exp, floor, pi
from typing import Final

from airlight.geometry.gradient_noise import (
    GRADIENT_DEVIATION,
    PERIOD,
    gradient_noise,
    in_period,
    lattice_value,
    shuffled,
)
from airlight.kernel import inlined, kernel
from airlight.scene.ground_detail import OCTAVES, STEP

#: Octaves of noise before that of the lamps.
_DISTRICTS: Final = 3
#: Radius of a lamp over its cell, and mean of (1 - d²/R²)² over the cell, 4π R³ 8/105. [1]
_LAMP: Final = 0.4
_LAMP_MEAN: Final = 32.0 * pi * _LAMP**3 / 105.0
#: Octave of streets. Before it light is the exponential of noise, of this factor, as that of places
#: is: few are bright; and its mean, of 2 million places. [1]
_STREETS: Final = 2
_UNEVEN: Final = 6.0
_UNEVEN_MEAN: Final = 1.3753
#: Noise w at the edges of streets, whose middle is where noise vanishes; and mean of their light,
#: (1 - |n|/w)³ over the noise n, of 2 million places. [1]
_STREET: Final = 2.5 * GRADIENT_DEVIATION
_STREET_MEAN: Final = 0.4019


@kernel
def lamp_bump(x, y, z):
    """Light of the lamp of a cell at a place, of mean 1.

    Parameters
    ----------
    x, y, z : float
        Coordinates, in cells. [1]
    """
    i, j, k = float(floor(x)), float(floor(y)), float(floor(z))
    dx, dy, dz = x - i - 0.5, y - j - 0.5, z - k - 0.5
    inside = 1.0 - (dx * dx + dy * dy + dz * dz) / (_LAMP * _LAMP)
    if inside <= 0.0:
        return 0.0
    bright = 1.0 + lattice_value(shuffled(shuffled(in_period(i)) + in_period(j)), in_period(k))
    return bright * inside * inside / _LAMP_MEAN


@inlined
def lamp_pattern(place, footprint, cell, whole, part):
    """Light of lamps at a place over that of the map. [1]

    Parameters
    ----------
    place, footprint, cell, whole, part :
        Arguments of ``ground_detail``.

    Returns
    -------
    float
        Factor, of mean 1. [1]
    """
    factor, scale = 1.0, STEP ** (OCTAVES - 1)
    for octave in range(_DISTRICTS + 1):
        shown = min(0.5 * cell * scale / footprint - 1.0, 1.0)
        if shown > 0.0:
            period = float(PERIOD * scale)
            # as in ground_detail: integers stay exact in single precision
            x = (whole.x - period * floor(whole.x / period)) / scale
            y = (whole.y - period * floor(whole.y / period)) / scale
            z = (whole.z - period * floor(whole.z / period)) / scale
            x += (part.x + place.x / cell) / scale
            y += (part.y + place.y / cell) / scale
            z += (part.z + place.z / cell) / scale
            own = 0.0
            if octave == _DISTRICTS:
                own = lamp_bump(x, y, z)
            else:
                noise = gradient_noise(x, y, z)
                own = 1.0 + 2.0 * noise  # above 0: noise is below 0.5
                if 0 < octave < _STREETS:
                    own = exp(_UNEVEN * noise) / _UNEVEN_MEAN
                elif octave == _STREETS:
                    near = 1.0 - min(abs(noise) / _STREET, 1.0)
                    own = near * near * near / _STREET_MEAN
            factor *= 1.0 + shown * (own - 1.0)
        scale = scale // STEP
    return factor
