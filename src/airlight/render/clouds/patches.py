"""Patches in which a periodic field continues beyond its box, so that it does not seem to repeat.

The plane is divided into squares a quarter wider than the box, with edges of fractal noise. The one
in the middle holds the box; each other one is the periodic field displaced at random, with its own
light. Edges cut through clouds; they are never inside the box.
"""

from __future__ import annotations

from math import floor
from typing import Final

from airlight.geometry.gradient_noise import below_289, gradient_noise, shuffled
from airlight.kernel import inlined, kernel

#: Width of a patch over that of the box. [1]
WIDTH: Final = 1.25
#: Largest displacement of an edge over the width of a patch: edges are outside the box. [1]
BENT: Final = 0.5 - 0.5 / WIDTH
#: Displacement of an edge by gradient noise, and wavelength, both over the width of a patch. [1]
COARSE: Final = (0.26, 0.2)
FINE: Final = (0.074, 0.06)
#: Change of the place across an edge over the way, at most.
STEEPEST: Final = 1.0 + COARSE[0] / COARSE[1] + FINE[0] / FINE[1]


@kernel
def edge_noise(x, y, other):
    """Displacement of an edge over the width of a patch, at most ``BENT``. [1]

    Parameters
    ----------
    x, y : float
        Place over the width of a patch. [1]
    other : float
        Number of the edge's direction, 0.5 or 1.5.
    """
    found = COARSE[0] * gradient_noise(x / COARSE[1], y / COARSE[1], other)
    found += FINE[0] * gradient_noise(x / FINE[1], y / FINE[1], other)
    return min(max(found, -BENT), BENT)


@inlined
def displaced_patch(east, north, width, length):
    """Displacement of the periodic field at a place, and a distance within which it is the same.

    Parameters
    ----------
    east, north : float
        Place from the middle of the box. [m]
    width, length : float
        Sides of the box to the east and to the north. [m]

    Returns
    -------
    right, up, free : float
        Displacement to the east and to the north; distance. [m]
    """
    x, y = 0.5 + east / (WIDTH * width), 0.5 + north / (WIDTH * length)
    column, row = floor(x), floor(y)
    near_x, near_y = 0.5 - abs(x - column - 0.5), 0.5 - abs(y - row - 0.5)
    nearest = min(near_x * width, near_y * length) * WIDTH
    free = nearest - BENT * WIDTH * max(width, length)
    if free <= 0.0:
        bent_x, bent_y = x + edge_noise(x, y, 0.5), y + edge_noise(x, y, 1.5)
        column, row = floor(bent_x), floor(bent_y)
        near_x, near_y = 0.5 - abs(bent_x - column - 0.5), 0.5 - abs(bent_y - row - 0.5)
        free = min(near_x * width, near_y * length) * WIDTH / STEEPEST
    right, up = 0.0, 0.0
    if column != 0 or row != 0:
        i, j = below_289(float(column)), below_289(float(row))
        right = width / 289.0 * shuffled(below_289(shuffled(i) + j))
        up = length / 289.0 * shuffled(below_289(shuffled(below_289(j + 53.0)) + i))
    return right, up, free
