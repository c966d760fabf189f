"""Decoration of land in pictures: hills, woods, coasts and texture, on the colours of the map."""

from __future__ import annotations

from math import sqrt
from typing import Final

from airlight.geometry.vectors import Vec3, plus, scaled
from airlight.kernel import inlined, kernel
from airlight.render.pixels.coast import land_and_water
from airlight.render.pixels.cratered_land import highlands, land_craters
from airlight.render.pixels.ground_clouds import CLOUD_VALUES
from airlight.render.pixels.land_from_above import land_from_above
from airlight.render.pixels.oblate import point_below
from airlight.render.pixels.skyline import (
    BEYOND,
    GROUND,
    HILLY,
    LOW,
    NEAR,
    SNOWED,
    grown,
    hill_size,
    leafiness,
    near_hills,
    risen,
    rocky_hills,
    snowiness,
)
from airlight.scene.ground_detail import unmixed
from airlight.scene.hills import canopy, hills, woods
from airlight.scene.land_texture import (
    ROW,
    face_of,
    faced,
    land_texture,
    seen_row,
    texture_footprint,
    texture_light,
    textured,
)
from airlight.scene.rocks import rocks
from airlight.scene.rolling_ground import rolling

#: Share of water from which a place has no land to be decorated: sums of weights are rounded. [1]
NEARLY_WATER: Final = 0.999
#: Size of pits of airless soil over that of mounds of others, and its contrast over theirs, by eye:
#: impacts mix it. [1]
PITTED: Final = -0.6
SOIL: Final = 0.5
#: Contrast of stony ground with wind, of dust and sand, over that of others, by eye. [1]
DRIFTS: Final = 2.0
#: Reflectance of rocks over that of dust, and that of blocks of fresh rock over that of old airless
#: soil, by eye. [1]
STONES: Final = 0.7
BLOCKS: Final = 1.2
#: Contrast of hills over that of the grain of the map, which is half of that of its land. [1]
LOUD: Final = 3.0
#: Green reflectances between which contrast falls, and what is left of it on brighter land: median
#: deviations in squares of four texels of the packaged map of Earth are 0.12 of the mean of land of
#: 0.06 to 0.2, 0.05 of that of 0.3 to 0.4 and 0.03 of that of 0.4 to 0.6. [1]
DARK: Final = 0.2
BRIGHT: Final = 0.45
EVEN: Final = 0.3
#: Cosine of the zenith angle of a line of sight below which land is seen in rows. [1]
GRAZING: Final = 0.35
#: Reflectance of woods over that of what is between them. [1]
SHADY: Final = 0.4
#: Mean share of woods on green land. [1]
COVER: Final = 0.394
#: What mean reflectance loses as woods are where the ground between them would be bright, of 12 000
#: places with the contrast of the packaged map of Earth. [1]
COMMON: Final = 0.031
#: Contrast of ground where wind moves sand and dust over that of its map, by eye. [1]
DUSTY: Final = 2.5
#: Index of the light of the sky over that on level ground.
SKY: Final = 12 + CLOUD_VALUES
#: Cosine of the star's zenith angle below which the light of the sky comes from the star's side as
#: at it: horizontal over vertical is 0.8 tan 40°, 1.5 for 60° and 2.1 for 75° to 90°, as rendered
#: for Mars with dust of optical depth 0.5. Least light of the sky of a slope. [1], [1]
LOWEST_GLOW: Final = 0.5
LEAST_SKY: Final = 0.1
#: Finest texture of hills beyond the horizon [pixel]; distance from which that of airless ground
#: before a low observer grows to it, until hills begin [m], and share to which it does [1]; by eye.
COARSER: Final = 8.0
CRISP: Final = 40.0
SOFT: Final = 0.6
#: On airless hills, by how much more rocks are blurred, and share of craters that is left out: they
#: are of level ground, whose shadows at a grazing angle are lines; by eye. [1]
FEWER: Final = 2.0
LEVEL: Final = 0.8


@kernel
def unevenness(green, altitude):
    """Contrast of land from high above over that of dark land, by a map's reflectance. [1]

    Parameters
    ----------
    green : float
        Green reflectance. [1]
    altitude : float
        Altitude of the observer, below ``LOW`` of whom the dunes of bright land keep theirs. [m]

    Examples
    --------
    >>> unevenness(0.1, 4e5), round(unevenness(0.5, 4e5), 9), unevenness(0.5, 2.0)
    (1.0, 0.3, 1.0)
    """
    bright = min(max((green - DARK) / (BRIGHT - DARK), 0.0), 1.0)
    return 1.0 - (1.0 - EVEN) * bright * min(max(altitude / LOW - 1.0, 0.0), 1.0)


@inlined
def detailed_land(place, footprint, cosine, mu_s, spot, reach, observer, frame, color):
    """Decorate land: coast and noise between texels, texture of reflectance and small slopes.

    Parameters
    ----------
    place : Vec3
        Result of ``ground_spot``. [m]
    footprint, cosine : float
        Longer axis of the pixel [m]; cosine of the zenith angle towards the observer. [1]
    mu_s : float
        Cosine of the star's zenith angle. [1]
    spot : MapSpot
        Place in the map.
    reach : float
        Distance. [m]
    observer, frame : Observer, FrameTables
        Observer, and what the pixels read.
    color : array, shape (GROUND_VALUES,)
        Values of the map, which are changed. [1]
    """
    view = frame.camera
    share = color[3] if view.mapped else 0.0
    if share < NEARLY_WATER:
        beyond = max(color[BEYOND], 1.0)
        place, footprint, reach = scaled(place, beyond), beyond * footprint, beyond * reach
        cell, snow, leaf, uneven = view.detail_cell, 0.0, 0.0, 1.0
        if view.mapped:
            snow = snowiness(color[0], color[2])
            uneven = max(unevenness(color[1], observer.optical_altitude), snow)
            leaf = leafiness(color[0], color[1], snow)
        pitted, bare = view.craters > 0.0, 0.0
        airless = pitted and not view.weathered
        if pitted:
            bare = highlands(spot, view)
        blur = texture_footprint(footprint, cosine) / cell
        # the star's azimuth is the observer's first axis
        way = Vec3(observer.ground_x.x, observer.ground_y.x, observer.ground_z.x)
        finest = Vec3(
            view.part.x + place.x / cell, view.part.y + place.y / cell, view.part.z + place.z / cell
        )
        middle = plus(point_below(observer), scaled(place, 1.0 / frame.tables.bottom))
        near = near_hills(observer.optical_altitude, cell, view.pixel_angle)
        high = risen(reach, observer.optical_altitude, near)
        ascent, tone, hue, wood, height, leaves = 0.0, 0.0, 0.0, 0.0, 0.0, 1.0
        woody, moved = leaf, Vec3(0.0, 0.0, 0.0)
        if view.relieved and observer.optical_altitude > LOW:
            ascent, tone, hue = land_from_above(
                middle, finest, blur, way, uneven, leaf, snow, frame, color
            )
            woody = 0.0
        elif pitted and observer.optical_altitude > LOW:
            ground = rolling(finest, blur, view.whole, way, bare, cell)
            ascent, tone = ground.ascent, (DUSTY if view.weathered else 1.0) * ground.tone
            moved = Vec3(ground.aside, ground.along, 0.0)
        elif high > 0.0:
            rocky = rocky_hills(view.rocks, observer.optical_altitude)
            size = hill_size(middle, frame.tables.bottom, uneven, rocky, view)
            size *= 1.0 + (SNOWED - 1.0) * snow + (HILLY - 1.0) * bare
            from_there = reach if observer.optical_altitude < LOW else 1e9
            hill = hills(
                finest, blur, from_there / cell, view.whole, way, True, cell, view.grain_fall, -1.0
            )
            ascent = high * size * hill.ascent
            tone = uneven * hill.tone
            wood = leaf * grown(reach, observer.optical_altitude, near)
            wood *= woods(finest, blur, view.whole, hill.tone)
            height = high * size * max(hill.height - GROUND, 0.0)
            if wood > 0.0 and observer.optical_altitude < LOW:
                trees = canopy(finest, blur, view.whole, wood, way)
                height += cell * trees.height
                ascent += trees.ascent
                leaves = trees.tone
        # the texture lies on the face of a cube
        face = face_of(middle)
        whole, way, place = faced(view.whole, face), faced(way, face), faced(place, face)
        part = faced(view.part, face)
        away = max(sqrt(place.x * place.x + place.y * place.y), 1e-3 * cell)
        higher = Vec3(place.x * height / (away * cell), place.y * height / (away * cell), 0.0)
        finest = plus(faced(finest, face), higher)
        row, shorter = finest, blur
        low = observer.optical_altitude
        # all of a hill beyond the horizon lies at one place
        distant = low < LOW and reach > 0.9 * sqrt(2.0 * low * frame.tables.bottom)
        soft = 0.0
        if airless and low < LOW:
            soft = SOFT * min(max((reach - CRISP) / (NEAR - CRISP), 0.0), 1.0)
        if cosine < GRAZING and snow < 0.5:
            row = seen_row(place, low, ROW * view.pixel_angle, cell, leaf, whole, part)
            row = plus(row, higher)
            shorter += min(4.0 - 4.0 * cosine / GRAZING, 1.0) * (footprint * cosine / cell - blur)
            smooth = 1.0 if distant else soft
            shorter = max(shorter, smooth * COARSER * view.pixel_angle * reach / cell)
        dark, open_ground, rough = 1.0, 1.0, 0.0
        stones = view.rocks > 0.0 and observer.optical_altitude < LOW
        if stones:
            rough = PITTED if airless else 1.0
        texture = land_texture(
            finest, row, shorter, footprint / cell, whole, way, leaf, snow, not airless, rough
        )
        sine, glow = sqrt(max(1.0 - mu_s * mu_s, 0.0)), 1.0 / max(mu_s, LOWEST_GLOW)
        stony = rocks(
            finest,
            whole,
            Vec3(-place.x / away, -place.y / away, observer.optical_altitude / away),
            Vec3(sine * way.x, sine * way.y, mu_s),
            glow,
            (1.0 + FEWER * soft) * view.pixel_angle * reach / cell,
            blur,
            cell,
            max(1.0 - leaf - snow, 0.0),
            view.rocks,
            BLOCKS if airless else STONES,
        )
        ascent += texture.ascent
        if pitted:
            pits = land_craters(
                place, faced(middle, face), plus(finest, moved), whole, way, mu_s, cosine,
                view.pixel_angle * reach, bare, view,
            )  # fmt: skip
            dark = max(1.0 + pits.tone, 0.1)
            level = 1.0 if distant else (LEVEL * high if soft > 0.0 else 0.0)
            open_ground = 1.0 + (1.0 - level) * (pits.light - 1.0)
        color[11] = stony.light + stony.open * open_ground * texture_light(mu_s, ascent)
        if stones:
            open_sky = max(1.0 - ascent * glow * sine, LEAST_SKY)
            color[SKY] = stony.sky + stony.bare * (open_sky - 1.0)
        change = stony.bare * texture.tone * (SOIL if airless else (DRIFTS if stones else 1.0))
        hue += stony.hue + stony.bare * texture.hue
        tone *= LOUD
        dark *= (1.0 - (1.0 - SHADY) * wood) / (1.0 - woody * ((1.0 - SHADY) * COVER + COMMON))
        dark *= stony.tone * leaves
        if view.mapped:
            red = dark * unmixed(color[0], view.water.x, share)
            green = dark * unmixed(color[1], view.water.y, share)
            blue = dark * unmixed(color[2], view.water.z, share)
            red = textured(red * max(1.0 + view.grain.x * tone, 0.0), change + hue)
            green = textured(green * max(1.0 + view.grain.y * tone, 0.0), change)
            blue = textured(blue * max(1.0 + view.grain.z * tone, 0.0), change - hue)
            land_and_water(red, green, blue, share, texture.shore, spot, view, color)
        else:
            color[8] = dark * (1.0 + view.grain.x * tone + change)
