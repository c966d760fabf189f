"""Hills before a low observer: their height, and lines of sight that end on them."""

from __future__ import annotations

from math import cos, pi, sqrt
from typing import Final

from airlight.geometry.gradient_noise import smooth_noise
from airlight.geometry.vectors import Vec3, components, plus, scaled
from airlight.kernel import inlined, kernel
from airlight.render.pixels.ground_angles import columns_to_ground
from airlight.render.pixels.ground_clouds import CLOUD_VALUES
from airlight.render.pixels.longer_columns import lengthen
from airlight.render.pixels.relief import height_at
from airlight.scene.craters import highland
from airlight.scene.ground_place import latitude_longitude, map_color
from airlight.scene.hills import COARSEST, CROWNS, canopy, hills, woods

#: Height of the coarsest octave of hills in a plain over its cells, 200 m on Earth, and its ratio
#: to differences of height between texels of the map of heights. [1]
LEAST: Final = 0.027
RUGGED: Final = 3.0
#: Height of hills of rocky ground before a low observer over that of others, by eye. [1]
ROCKY: Final = 4.0
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
#: Largest height of the coarsest octave around a low observer, but for rocky ground. [m]
HIGHEST: Final = 700.0
#: Largest angle of elevation of hills, below that of lines of sight that are compared. [rad]
WIDEST_ANGLE: Final = 0.048
#: Share of hills on snow. [1]
SNOWED: Final = 0.3
#: Height of hills in highlands with craters over that of others: median slopes of the Moon's are
#: 7.5° there and 2.0° on the maria (Rosenburg et al. 2011, JGR 116, E02001). [1]
HILLY: Final = 3.0
#: Index of the distance of what is seen over that of the end of the line of sight, if more than 1.
BEYOND: Final = 13 + CLOUD_VALUES


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
    share = min(max((distance - near) / (2.0 * near), 0.0), 1.0)
    return share * share


@kernel
def rocky_hills(share, altitude):
    """Height of hills of rocky ground over that of others, before a low observer. [1]

    Parameters
    ----------
    share : float
        Share of the ground below rocks. [1]
    altitude : float
        Altitude of the observer. [m]

    Examples
    --------
    >>> rocky_hills(0.07, 2.0), rocky_hills(0.0, 2.0), rocky_hills(0.07, 1000.0)
    (4.0, 1.0, 1.0)
    """
    if share <= 0.0:
        return 1.0
    return 1.0 + (ROCKY - 1.0) * min(max(2.0 - 2.0 * altitude / LOW, 0.0), 1.0)


@kernel
def grown(distance, altitude, near):
    """Share of the height of trees at a distance: a low observer stands on open ground. [1]"""
    if altitude > LOW:
        return 1.0
    return min(max(2.0 * (distance / near - 2.0), 0.0), 1.0)


@inlined
def hill_size(place, bottom, uneven, rocky, view):
    """Height of the coarsest octave of hills, by differences of the map of heights. [m]

    Decoration, by eye: hilly regions and plains of some tens of kilometres.

    Parameters
    ----------
    place : Vec3
        Place from the centre, in the planet's frame, over the radius. [1]
    bottom : float
        Radius of the ground. [m]
    uneven, rocky : float
        Height of hills in plains over that of dark land, and result of ``rocky_hills``. [1]
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
    return size * rocky * min(max(hilly, PLAIN * rocky), 1.0)


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
    cell, rocky = view.detail_cell, rocky_hills(view.rocks, altitude)
    size = hill_size(middle, tables.bottom, 1.0, rocky, view)
    if view.craters > 0.0 and view.mapped:
        size *= 1.0 + (HILLY - 1.0) * highland(color[1])
    size = min(size, min(HIGHEST * sqrt(rocky), WIDEST_ANGLE * cell / STEEPEST)) * (
        1.0 + (SNOWED - 1.0) * snow
    )
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
            least = (above - wooded) / size
            hill = hills(
                finest,
                blur,
                distance / cell,
                view.whole,
                aside,
                False,
                cell,
                view.grain_fall,
                least,
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
