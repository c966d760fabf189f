"""Ground of bodies without air: colours of maps, craters and rolling ground between texels."""

from __future__ import annotations

from math import pi, sqrt
from typing import Final

from airlight.geometry.vectors import Vec3, dot, minus, plus, scaled
from airlight.kernel import compiled_loop, kernel
from airlight.scene.craters import FLATTENED, FLATTEST, LOWEST, craters, highland
from airlight.scene.ground_detail import finest_cell
from airlight.scene.ground_place import latitude_longitude, map_color
from airlight.scene.land_texture import face_of, faced, texture_footprint, texture_light
from airlight.scene.rolling_ground import rolling

#: Contrast of the land that its noise mottles, by eye. [1]
MOTTLED: Final = 0.1


@kernel
def crater_light(own, ray, light, leaving, width, green, density, radius, rows):
    """Light of a place of a body without air, by craters and hills, over that without them. [1]

    Those of near ground alone: pixels wider than half a texel of the map have none.

    Parameters
    ----------
    own, ray, light : Vec3
        Unit vectors in the body-fixed frame: place, line of sight, and towards the light. [1]
    leaving : float
        Cosine of emergence. [1]
    width : float
        Width of the pixel at the distance of the place. [radius]
    green : float
        Green reflectance of the map. [1]
    density : float
        Craters wider than D per area D². [1]
    radius : float
        Radius of the body. [m]
    rows : float
        Rows of the map.
    """
    leaving, mu = max(leaving, FLATTEST), dot(own, light)
    wide = width / leaving
    wide = max(texture_footprint(wide, leaving), FLATTENED * wide)
    shown = min(2.0 - 4.0 * wide * rows / pi, 1.0)
    if shown <= 0.0:
        return 1.0
    cell, high = finest_cell(radius, rows), highland(green)
    cells, face = radius / cell, face_of(own)
    level = minus(light, scaled(own, mu))
    sine = max(sqrt(dot(level, level)), 1e-6)
    way = scaled(level, min(1.0 / max(mu, 1e-3), LOWEST / sine))
    beyond = scaled(plus(ray, scaled(own, -dot(own, ray))), 1.0 / leaving)
    place, start = scaled(own, cells), Vec3(0.0, 0.0, 0.0)
    ground = rolling(place, wide * cells, start, scaled(level, 1.0 / sine), high, cell)
    pits = craters(
        plus(faced(place, face), Vec3(ground.aside, ground.along, 0.0)),
        start, faced(own, face), faced(way, face), width * cells, cell, density, high,
        faced(beyond, face), False,
    )  # fmt: skip
    tone = max(1.0 + pits.tone + MOTTLED * ground.tone, 0.1)
    return 1.0 + shown * (pits.light * texture_light(mu, ground.ascent) * tone - 1.0)


@compiled_loop
def crater_lights(places, rays, lights, leaving, width, green, density, radius, rows, out):
    """``crater_light`` at n points.

    Parameters
    ----------
    places, rays, lights : array, shape (n, 3)
        Arguments of ``crater_light``. [1]
    leaving, width, green : array, shape (n,)
        Arguments of ``crater_light``.
    out : array, shape (n,)
        Is multiplied by the results. [1]
    """
    for k in range(out.size):
        out[k] *= crater_light(
            Vec3(places[k, 0], places[k, 1], places[k, 2]),
            Vec3(rays[k, 0], rays[k, 1], rays[k, 2]),
            Vec3(lights[k, 0], lights[k, 1], lights[k, 2]),
            leaving[k], width[k], green[k], density, radius, rows,
        )  # fmt: skip


@compiled_loop
def map_colors(texels, rows, columns, levels, places, level, out):
    """``map_color`` at n points.

    Parameters
    ----------
    texels, rows, columns, levels :
        Arguments of ``map_color``.
    places : array, shape (n, 3)
        Unit vectors in the body-fixed frame. [1]
    level : array, shape (n,)
        Levels of the map. [1]
    out : array, shape (n, 4)
        Receives the colours. [1]
    """
    for k in range(level.size):
        own = Vec3(places[k, 0], places[k, 1], places[k, 2])
        latitude, longitude = latitude_longitude(own)
        map_color(texels, rows, columns, levels, latitude, longitude, level[k], out[k], 0)
