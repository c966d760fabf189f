"""Rocks on bare ground, with lit and shaded sides and cast shadows; they are not data.

The share of the ground below rocks wider than D is k exp(-q D), q = 1.79 + 0.152/k (Golombek & Rapp
1997, J. Geophys. Res. 102, 4117), with the k of the planet's file. Each cell of a square lattice
has at most one rock, half of an ellipsoid with faces and pits, of the sizes between those of the
next finer and its own lattice. A line of sight, or towards the star, visits the cells that it
crosses below the tops of rocks. Seen from above, mean reflectance and mean sunlight remain. Seen at
an angle, rocks brighten the ground towards the star and darken it away from it, as half ellipsoids
do on ground that reflects by Lambert's law, down to 6° of elevation; at flatter angles they are
lower and do less.
"""

from __future__ import annotations

from math import exp, floor, log, log2, sin, sqrt
from typing import Final, NamedTuple

from airlight.geometry.gradient_noise import in_period, plane_noise, shuffled
from airlight.geometry.vectors import Vec3
from airlight.kernel import kernel
from airlight.scene.ground_detail import STEP, along_lattice

#: Decrease q of the share of the ground below rocks with their diameter, for a share of 0 of all
#: rocks, and its increase with the share's inverse. [m⁻¹]
DECREASE: Final = 1.79
SPARSER: Final = 0.152
#: Number of lattices, and size of the finest, to a factor of two. [m]
LATTICES: Final = 3
FINEST: Final = 0.33
#: Diameter of the widest rock of a lattice, and mean area of a cell's rock, whose logarithm of the
#: diameter is uniform and whose outline is ragged. [cell], [cell²]
WIDEST: Final = 0.6
AREA: Final = 0.0815
#: Height of a rock over its radius: of the flattest, and what the highest has more. [1]
FLAT: Final = 0.5
STEEPER: Final = 0.6
#: Height of the highest rock [cell], and farthest distance from which rocks are looked for [cell],
#: with the number of cells that are visited.
HIGHEST: Final = 0.33
SPAN: Final = 3.0
VISITS: Final = 5
#: Size of the noise of fields of rocks over the finest cells. [1]
PATCH: Final = 64.0
#: Longest shadow. [cell]
SHADOW: Final = 2.5
#: Reflectance of rocks over that of the ground between them. [1]
DARK: Final = 0.75
#: Logarithm of the ratio of diameters on a lattice. [1]
FOURFOLD: Final = log(4.0)
#: Faces across a radius, waves of pits in 2π radii, roughness of both, and that of outlines. [1]
FACETS: Final = 1.6
PITS: Final = 23.0
ROUGH: Final = 0.2
PITTED: Final = 0.25
RAGGED: Final = 0.2
#: Direct light that the ground and rocks lose per share of rocks, seen from above, under a star in
#: the zenith, and its increase with the tangent of the zenith angle; of 20 000 places each. [1]
LOST: Final = 0.174
SHADED: Final = 0.189
#: Cosine of the star's zenith angle below which faces are lit as at it. [1]
LOWEST: Final = 0.1


class Rocks(NamedTuple):
    """Rocks in a pixel.

    Attributes
    ----------
    tone : float
        Reflectance over that without rocks. [1]
    open : float
        Share of the direct light on the ground without rocks that remains. [1]
    light : float
        Direct light on rocks, over that of level ground. [1]
    bare : float
        Share of the pixel without rocks. [1]
    """

    tone: float
    open: float
    light: float
    bare: float


@kernel
def rock_area(narrow, wide, share):
    """Share of the ground below rocks between two diameters [m], of a share of all rocks. [1]

    Examples
    --------
    >>> round(rock_area(0.0, 1e9, 0.07), 9), round(rock_area(0.2, 0.8, 0.07), 4)
    (0.07, 0.0288)
    """
    decrease = DECREASE + SPARSER / share
    return share * (exp(-decrease * narrow) - exp(-decrease * wide))


@kernel
def rocks_met(x, y, ray, span, blur, density, sun):
    """Share of a line that rocks hide, and their direct light over that of level ground. [1]

    Parameters
    ----------
    x, y : float
        End on the ground. [cell]
    ray : Vec3
        Horizontal direction from there, and ascent. [1]
    span : float
        Distance from which rocks are looked for. [cell]
    blur : float
        Width of the pixel. [cell]
    density : float
        Share of cells with a rock. [1]
    sun : Vec3
        Direction towards the star. [1]
    """
    left, light, went, visits = 1.0, 0.0, 0.0, 0
    several, low = 289.0 * density, min(span * ray.z / HIGHEST, 1.0)
    start_x, start_y = x + span * ray.x, y + span * ray.y
    i, j = float(floor(start_x)), float(floor(start_y))
    step_x, next_x, every_x = 1.0, i + 1.0 - start_x, 1.0 / max(abs(ray.x), 1e-6)
    if ray.x > 0.0:
        step_x, next_x = -1.0, start_x - i
    step_y, next_y, every_y = 1.0, j + 1.0 - start_y, 1.0 / max(abs(ray.y), 1e-6)
    if ray.y > 0.0:
        step_y, next_y = -1.0, start_y - j
    next_x *= every_x
    next_y *= every_y
    column = shuffled(in_period(i))
    while visits < VISITS and went <= span and left > 0.02:
        number = shuffled(column + in_period(j))
        if number < several:
            radius = 0.5 * WIDEST * exp(-FOURFOLD * number / several)
            # lower than the line where it leaves the cell
            if (FLAT + STEEPER) * radius * low > (span - min(next_x, next_y)) * ray.z:
                first = shuffled(number + column)
                second = shuffled(first + in_period(j)) / 289.0
                first /= 289.0
                at_x = x - i - radius - (1.0 - 2.0 * radius) * first
                at_y = y - j - radius - (1.0 - 2.0 * radius) * second
                if abs(at_x * ray.y - at_y * ray.x) < radius + 0.5 * blur:
                    at_x /= radius
                    at_y /= radius
                    height = radius * (FLAT + STEEPER * second) * low
                    way_x, way_y, climb = ray.x / radius, ray.y / radius, ray.z / max(height, 1e-6)
                    square = way_x * way_x + way_y * way_y + climb * climb
                    middle = at_x * way_x + at_y * way_y
                    nearest = max(at_x * at_x + at_y * at_y - middle * middle / square, 0.0)
                    edge = at_x - at_y - middle * (way_x - way_y + climb) / square
                    nearest *= 1.0 + RAGGED + RAGGED * sin(6.0 * edge + 40.0 * first)
                    met = (sqrt(max(1.0 - nearest, 0.0) * square) - middle) / square
                    part = min(max((1.0 - sqrt(nearest)) * radius / blur + 0.5, 0.0), 1.0)
                    if met > 0.0 and part > 0.0:
                        at_x += met * way_x
                        at_y += met * way_y
                        along, aside = first, sqrt(1.0 - first * first)
                        u = along * at_x + aside * at_y
                        v = along * at_y - aside * at_x
                        u = (floor(FACETS * u + second) + 0.5 - second) / FACETS
                        v = (floor(FACETS * v + first) + 0.5 - first) / FACETS
                        u += ROUGH * sin(5.0 * at_y + 40.0 * first)
                        v += ROUGH * sin(5.0 * at_x + 40.0 * second)
                        u += PITTED * sin(PITS * (at_x + met * climb)) * sin(PITS * at_y)
                        face_x, face_y = along * u - aside * v, aside * u + along * v
                        face_z = met * climb * radius / max(height, 1e-6)
                        facing = face_x * sun.x + face_y * sun.y + face_z * sun.z
                        facing /= sqrt(face_x * face_x + face_y * face_y + face_z * face_z)
                        light += left * part * max(facing, 0.0) / max(sun.z, LOWEST)
                        left *= 1.0 - part
        if next_x < next_y:
            went = next_x
            next_x += every_x
            i += step_x
            column = shuffled(in_period(i))
        else:
            went = next_y
            next_y += every_y
            j += step_y
        visits += 1
    return 1.0 - left, light


@kernel
def rocks(place, whole, ray, sun, pixel, blur, cell, bare, share):
    """``Rocks`` of a pixel.

    Parameters
    ----------
    place, whole : Vec3
        Place and lattice point, ``faced``. [finest cell]
    ray, sun : Vec3
        Horizontal direction towards the observer in the plane of the face, and the ascent of the
        line of sight; direction towards the star. [1]
    pixel, blur : float
        Width of the pixel across the line of sight, and its mean on the ground. [finest cell]
    cell : float
        Size of the finest cells. [m]
    bare : float
        Share of bare ground. [1]
    share : float
        Share of bare ground below rocks. [1]
    """
    tone, open_ground, light, below, left = 1.0, 1.0, 0.0, 0.0, 1.0
    scale = 4.0 ** floor(0.5 * log2(FINEST / cell) + 0.5)
    if bare * share > 0.0 and 0.4 * WIDEST * scale * STEP ** (LATTICES - 1) > pixel:
        inverse = 1.0 / (PATCH * scale)
        field, _rise_x, _rise_y = plane_noise(
            along_lattice(whole.x, place.x, inverse), along_lattice(whole.y, place.y, inverse)
        )
        bare *= min(max(1.0 + 2.0 * field, 0.0), 2.0)
    sine = max(sqrt(sun.x * sun.x + sun.y * sun.y), 1e-6)
    up = Vec3(sun.x / sine, sun.y / sine, max(sun.z, LOWEST) / sine)
    for _lattice in range(LATTICES):
        shown = min(0.4 * WIDEST * scale / pixel - 1.0, 1.0) if bare * share > 0.0 else 0.0
        if shown > 0.0:
            wide = WIDEST * scale * cell
            area = bare * rock_area(wide / STEP, wide, share)
            density = min(area / AREA, 1.0)
            below += shown * area
            x = along_lattice(whole.x, place.x, 1.0 / scale)
            y = along_lattice(whole.y, place.y, 1.0 / scale)
            span = min(HIGHEST / max(ray.z, 1e-6), SPAN)
            cover, face = rocks_met(x, y, ray, span, pixel / scale, density, sun)
            dark = 0.0
            if cover < 0.98:
                span = min(HIGHEST / up.z, SHADOW)
                dark, _lit = rocks_met(x, y, up, span, blur / scale, density, sun)
            # the widest rocks hide what the narrow ones are
            between = 1.0 - shown * cover
            tone = tone * between + shown * cover * DARK
            light = light * between + shown * face
            open_ground *= between * (1.0 - shown * dark)
            left *= between
        scale *= STEP
    kept = 1.0 - below * (LOST + SHADED * sine / max(sun.z, 2.0 * LOWEST))
    return Rocks(tone / (1.0 - below * (1.0 - DARK)), open_ground / kept, light / kept, left)
