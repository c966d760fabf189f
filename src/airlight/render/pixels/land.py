"""Decoration of land in pictures: hills, woods, coasts and texture, on the colours of the map."""

from __future__ import annotations

from math import cos, pi, sqrt
from typing import Final

from airlight.geometry.gradient_noise import smooth_noise
from airlight.geometry.vectors import Vec3, components, plus, scaled
from airlight.kernel import inlined, kernel
from airlight.render.pixels.coast import land_and_water
from airlight.render.pixels.cratered_land import highlands, land_craters
from airlight.render.pixels.ground_angles import columns_to_ground
from airlight.render.pixels.land_from_above import land_from_above
from airlight.render.pixels.longer_columns import lengthen
from airlight.render.pixels.oblate import point_below
from airlight.render.pixels.relief import height_at
from airlight.scene.ground_detail import unmixed
from airlight.scene.ground_place import latitude_longitude, map_color
from airlight.scene.hills import COARSEST, CROWNS, canopy, hills, woods
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
#: Height of the coarsest octave of hills in a plain over its cells, 200 m on Earth, and its ratio
#: to differences of height between texels of the map of heights. [1]
LEAST: Final = 0.027
RUGGED: Final = 3.0
#: Cells of hilly regions over those of the coarsest octave, and height of hills in the plains
#: between them over that in hilly ones. [1]
REGION: Final = 8.0
PLAIN: Final = 0.2
#: Altitude over which hills hide nothing; distance of the nearest and of the farthest hills that
#: do, distance of the nearest per altitude, and largest width of trees' crowns, by eye: their sides
#: have no detail of their own. [m], [1], [pixel]
LOW: Final = 1000.0
NEAR: Final = 250.0
FAR: Final = 20e3
AWAY: Final = 12.0
WIDEST: Final = 24.0
#: Steepest line of sight that is compared with hills. [1]
STEEP: Final = 0.05
#: Number of distances at which heights are compared, and of halvings of the last step.
STEPS: Final = 20
HALVINGS: Final = 4
#: Height of noise that lies on level ground, and highest value. [1]
GROUND: Final = 0.0
TOP: Final = 0.6
#: Largest angle of elevation of hills over their height. [finest cell⁻¹]
STEEPEST: Final = 6.5e-6
#: Largest height of the coarsest octave around a low observer. [m]
HIGHEST: Final = 700.0
#: Contrast of hills over that of the grain of the map, which is half of that of its land. [1]
LOUD: Final = 3.0
#: Green reflectances between which contrast falls, and what is left of it on brighter land: median
#: deviations in squares of four texels of the packaged map of Earth are 0.12 of the mean of land of
#: 0.06 to 0.2, 0.05 of that of 0.3 to 0.4 and 0.03 of that of 0.4 to 0.6. [1]
DARK: Final = 0.2
BRIGHT: Final = 0.45
EVEN: Final = 0.3
#: Share of hills on snow. [1]
SNOWED: Final = 0.3
#: Cosine of the zenith angle of a line of sight below which land is seen in rows. [1]
GRAZING: Final = 0.35
#: Reflectance of woods over that of what is between them. [1]
SHADY: Final = 0.4
#: Mean share of woods on green land. [1]
COVER: Final = 0.394
#: What mean reflectance loses as woods are where the ground between them would be bright, of 12 000
#: places with the contrast of the packaged map of Earth. [1]
COMMON: Final = 0.031
#: Height of hills in highlands with craters over that of others: median slopes of the Moon's are
#: 7.5° there and 2.0° on the maria (Rosenburg et al. 2011, JGR 116, E02001). [1]
HILLY: Final = 3.0
#: Contrast of ground where wind moves sand and dust over that of its map, by eye. [1]
DUSTY: Final = 2.5
#: Finest texture of hills beyond the horizon, by eye. [pixel]
BEYOND: Final = 8.0


@kernel
def leafiness(red, green, snow):
    """Share of green plants, 0 to 1, by the reflectances of a map. [1]"""
    ratio = green / max(red, 1e-3)
    return min(max(4.0 * (ratio - 0.85), 0.0), 1.0) * (1.0 - snow)


@kernel
def snowiness(red, blue):
    """Share of snow, 0 to 1, by the reflectances of a map. [1]"""
    return min(max(5.0 * (min(red, blue) - 0.3), 0.0), 1.0)


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


@kernel
def near_hills(altitude, cell, pixel_angle):
    """Distance at which hills begin. [m]

    Parameters
    ----------
    altitude : float
        Altitude of the observer. [m]
    cell, pixel_angle : float
        ``detail_cell`` [m] and ``pixel_angle`` [rad] of the camera.
    """
    narrow = CROWNS * cell / (WIDEST * max(pixel_angle, 1e-7))
    return max(NEAR, max(AWAY * altitude, narrow))


@kernel
def risen(distance, altitude, near):
    """Share of the height of hills at a distance: a low observer stands on level ground. [1]"""
    if altitude > LOW:
        return 1.0
    return min(max((distance - near) / (2.0 * near), 0.0), 1.0)


@kernel
def grown(distance, altitude, near):
    """Share of the height of trees at a distance: a low observer stands on open ground. [1]"""
    if altitude > LOW:
        return 1.0
    return min(max(2.0 * (distance / near - 2.0), 0.0), 1.0)


@inlined
def hill_size(place, bottom, uneven, view):
    """Height of the coarsest octave of hills, by differences of the map of heights. [m]

    Decoration, by eye: hilly regions and plains of some tens of kilometres.

    Parameters
    ----------
    place : Vec3
        Place from the centre, in the planet's frame, over the radius. [1]
    bottom : float
        Radius of the ground. [m]
    uneven : float
        Height of hills in plains over that of dark land. [1]
    view : ViewUniforms
        Camera with its maps.
    """
    size = uneven * LEAST * COARSEST * view.detail_cell
    if view.relieved:
        latitude, longitude = latitude_longitude(place)
        angle = pi / view.over_rows
        parallel = max(cos(latitude), 0.05)
        here = height_at(latitude, longitude, 0, view)
        north = height_at(latitude + angle, longitude, 0, view)
        east = height_at(latitude, longitude + angle / parallel, 0, view)
        size += RUGGED * sqrt((north - here) * (north - here) + (east - here) * (east - here))
    region = bottom / (REGION * COARSEST * view.detail_cell)
    hilly = 0.6 + 3.0 * smooth_noise(place.x * region, place.y * region, place.z * region)
    return size * min(max(hilly, PLAIN), 1.0)


@inlined
def land_color(place, view, color):
    """Map values of a place, into ``color``. [1]

    Parameters
    ----------
    place : Vec3
        Place from the centre, in the planet's frame; any unit.
    view, color :
        Arguments of ``detailed_land``.
    """
    latitude, longitude = latitude_longitude(place)
    map_color(
        view.texels,
        view.map_rows,
        view.map_columns,
        view.map_levels,
        latitude,
        longitude,
        0.0,
        color,
        0,
    )


@inlined
def seen_hill(ray, frame, color):
    """Line of sight to the level ground below the place where one meets hills.

    A line that meets none remains. Of hills beyond the horizon it ends before that.

    Parameters
    ----------
    ray : Vec3
        Direction in the observer's frame. [1]
    frame : FrameTables
        What the pixels read.
    color : array, shape (GROUND_VALUES,)
        Workspace.

    Returns
    -------
    ray, beyond : Vec3, float
        Direction, and distance of the hills over that of the ground at its end. [1]
    """
    observer, view, tables = frame.observer, frame.camera, frame.tables
    altitude = observer.optical_altitude
    sine = sqrt(ray.x * ray.x + ray.y * ray.y)
    if not view.detailed or observer.outside or altitude > LOW or abs(ray.z) > STEEP * sine:
        return ray, 1.0
    horizon = sqrt(2.0 * altitude * tables.bottom)
    near, edge = near_hills(altitude, view.detail_cell, view.pixel_angle), 0.95 * horizon
    far = max(FAR, edge)
    if far < 2.0 * near or (tables.ground.wet and not view.mapped):
        return ray, 1.0
    along, climb = Vec3(ray.x / sine, ray.y / sine, 0.0), ray.z / sine
    if altitude + near * (climb + 0.5 * near / tables.bottom) <= 0.0:
        return ray, 1.0
    aside = components(along, observer.ground_x, observer.ground_y, observer.ground_z)
    up = components(Vec3(0.0, 0.0, 1.0), observer.ground_x, observer.ground_y, observer.ground_z)
    middle = plus(up, scaled(aside, 0.3 * far / tables.bottom))
    leaf, snow = 0.0, 0.0
    if view.mapped:
        land_color(middle, view, color)
        if color[3] > 0.5:
            return ray, 1.0
        snow = snowiness(color[0], color[2])
        leaf = leafiness(color[0], color[1], snow)
    size = min(hill_size(middle, tables.bottom, 1.0, view), HIGHEST) * (1.0 + (SNOWED - 1.0) * snow)
    cell = view.detail_cell
    trees = 250.0 * cell * leaf
    step = (far / near) ** (1.0 / STEPS)
    before, distance, found, met, halvings = near, near * step, 0.0, 0.0, 0
    over, under = 1.0, -1.0
    while distance < far and halvings <= HALVINGS:
        above = altitude + distance * (climb + 0.5 * distance / tables.bottom)
        share = risen(distance, altitude, near)
        height = 0.0
        wooded = trees * grown(distance, altitude, near)
        if above > 0.0 and above < size * min(TOP, STEEPEST * distance / cell - GROUND) + wooded:
            finest = Vec3(
                view.part.x + distance * aside.x / cell,
                view.part.y + distance * aside.y / cell,
                view.part.z + distance * aside.z / cell,
            )
            blur = view.pixel_angle * distance / cell
            hill = hills(
                finest, blur, distance / cell, view.whole, aside, False, cell, view.grain_fall
            )
            height = share * size * max(hill.height - GROUND, 0.0)
            if above >= height and above < height + wooded:
                wood = leaf * grown(distance, altitude, near)
                wood *= woods(finest, blur, view.whole, hill.tone)
                if wood > 0.0:
                    crown = canopy(finest, blur, view.whole, wood, aside)
                    height += cell * crown.height
        if above <= height:
            found, met, under = distance, above, above - height
        else:
            before, over = distance, above - height
        if found > 0.0:
            halvings += 1
            distance = 0.5 * (before + found)
        else:
            distance *= step
    if met <= 0.0:
        return ray, 1.0
    if view.mapped:
        land_color(plus(up, scaled(aside, found / tables.bottom)), view, color)
        if color[3] > 0.5:
            return ray, 1.0
    # what is seen of a tree from bottom to top lies behind one another
    found = before + (found - before) * over / max(over - under, 1e-3)
    end = min(found, edge)
    down = -altitude / end - 0.5 * end / tables.bottom
    length = sqrt(1.0 + down * down)
    return Vec3(along.x / length, along.y / length, down / length), found / end


@inlined
def haze_beyond(ray, sine, beyond, frame, work):
    """Carry light of a line of sight on to hills beyond the ground at its end.

    The air is even along it: the columns grow with the distance, by ``lengthen``.

    Parameters
    ----------
    ray, sine, beyond : Vec3, float, float
        Direction of the line, sine of its zenith angle, and result of ``seen_hill``. [1]
    frame, work : FrameTables, MarchWorkspace
        What the pixels read; the workspace has the light of the line, which is changed.
    """
    tables = frame.tables
    columns_to_ground(ray.z, sine, frame.observer, tables, work.columns_total, work.columns_so_far)
    lengthen(beyond, tables.extinction, frame, work)


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
        cell, snow, leaf, uneven = view.detail_cell, 0.0, 0.0, 1.0
        if view.mapped:
            snow = snowiness(color[0], color[2])
            uneven = max(unevenness(color[1], observer.optical_altitude), snow)
            leaf = leafiness(color[0], color[1], snow)
        pitted, bare = view.craters > 0.0, 0.0  # where craters last there is no wind
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
            size = hill_size(middle, frame.tables.bottom, uneven, view)
            size *= 1.0 + (SNOWED - 1.0) * snow + (HILLY - 1.0) * bare
            from_there = reach if observer.optical_altitude < LOW else 1e9
            hill = hills(
                finest, blur, from_there / cell, view.whole, way, True, cell, view.grain_fall
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
        if cosine < GRAZING and snow < 0.5:
            row = seen_row(place, low, ROW * view.pixel_angle, cell, leaf, whole, part)
            row = plus(row, higher)
            shorter += min(4.0 - 4.0 * cosine / GRAZING, 1.0) * (footprint * cosine / cell - blur)
            if distant:
                shorter = max(shorter, BEYOND * view.pixel_angle * reach / cell)
        dark, open_ground = 1.0, 1.0
        texture = land_texture(
            finest, row, shorter, footprint / cell, whole, way, leaf, snow, not pitted
        )
        sine = sqrt(max(1.0 - mu_s * mu_s, 0.0))
        stony = rocks(
            finest,
            whole,
            Vec3(-place.x / away, -place.y / away, observer.optical_altitude / away),
            Vec3(sine * way.x, sine * way.y, mu_s),
            view.pixel_angle * reach / cell,
            blur,
            cell,
            max(1.0 - leaf - snow, 0.0),
            view.rocks,
        )
        ascent += texture.ascent
        if pitted:
            pits = land_craters(
                place, faced(middle, face), plus(finest, moved), whole, way, mu_s, cosine,
                view.pixel_angle * reach, bare, view,
            )  # fmt: skip
            dark = max(1.0 + pits.tone, 0.1)
            open_ground = 1.0 if distant else pits.light
        color[11] = stony.light + stony.open * open_ground * texture_light(mu_s, ascent)
        change = stony.bare * texture.tone
        hue += stony.bare * texture.hue
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
