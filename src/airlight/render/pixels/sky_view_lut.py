"""Sky-view LUT (Hillaire 2020, CGF 39, 13): radiance by direction from one observer.

Texels hold fourth roots, which keep interpolation positive and accurate to 1 % where radiance
changes by a factor e between texels. With water, the table of ``sea_sky`` follows sky and ground.
"""

from __future__ import annotations

from math import cos, pi, sqrt
from typing import Final, NamedTuple

import numpy as np

from airlight.geometry.mappings.sky_view import direction_from_row, impact_from_row
from airlight.geometry.refraction import refraction_angle, turned
from airlight.geometry.shell import distance_to_bottom, distance_to_top, first_intersection
from airlight.geometry.vectors import Vec3, dot, minus, scaled
from airlight.kernel import inlined, kernel
from airlight.kernel.lanes import INVERSE_PI, LANES, fourth_root, lane_view, maximum, splat
from airlight.render.pixels.ground_angles import ground_angles, refraction_to_ground, star_from
from airlight.render.pixels.sea_sky import (
    mean_facet,
    mirror_place,
    mirrored_sky,
    sea_sky_texel,
)
from airlight.solver.moments.irradiance import ground_light
from airlight.solver.moments.march import march, ring_shade_on
from airlight.solver.moments.march_tables import FACETS, MIRRORED, MarchTerms, Segment
from airlight.solver.moments.source import read_phase
from airlight.solver.tables.ring_shadow import no_rings, ring_line

#: Offset of the last sky row from the top of the shell, from outside. [rows]
INSIDE = 0.1
#: Smallest sine of the zenith angle of texels of Q and U, whose meridian plane is undefined at the
#: zenith. [1]
UPRIGHT: Final = 5e-3

#: Radius of a disc with the area of a square, over its side. [1]
DISC: Final = 0.564
#: Cosine of the view-zenith angle below which a pixel on the planet counts as no wider. [1]
FLATTEST: Final = 0.2


class Observer(NamedTuple):
    """Observer and direction of the star.

    Attributes
    ----------
    r : float
        Distance from the centre; the optical radius inside the shell. [m]
    optical_altitude : float
        ``r`` minus the optical radius of the ground, stored separately for single precision. [m]
    outside : bool
        Whether the observer is above the top of the shell.
    horizon_mu, horizon_sine : float
        Cosine and sine of the horizon's zenith angle. [1]
    sun_x, sun_z : float
        Horizontal and vertical component towards the star, whose azimuth is 0. [1]
    seen_x, seen_z : float
        Components towards the apparent star. [1]
    orders : int
        1: single scattering; 0: multiple scattering; 2: both.
    centre : Vec3
        Centre of the planet from the camera. [m]
    flattening : float
        Flattening of the planet, 0 of a sphere. [1]
    ground_x, ground_y, ground_z : Vec3
        Axes of the planet's frame; the third is the north pole, normal to the rings. [1]
    forward, filter_axis : Vec3
        Optical axis of the camera, and axis of its filter. [1]
    """

    r: float
    optical_altitude: float
    outside: bool
    horizon_mu: float
    horizon_sine: float
    sun_x: float
    sun_z: float
    seen_x: float
    seen_z: float
    orders: int
    centre: Vec3
    flattening: float
    ground_x: Vec3
    ground_y: Vec3
    ground_z: Vec3
    forward: Vec3
    filter_axis: Vec3


class SightLine(NamedTuple):
    """Line of sight.

    Attributes
    ----------
    mu, sine, cos_azimuth : float
        Cosine and sine of its zenith angle, cosine of its azimuth. [1]
    half_sine : float
        sin(θ/2) of the angle to the apparent star. [1]
    to_ground : bool
        Whether it ends on the ground.
    ray : Vec3
        Direction in the observer's frame; zero without the shadow of rings. [1]
    width : float
        Angular width over which the shadow of rings is averaged. [rad]
    """

    mu: float
    sine: float
    cos_azimuth: float
    half_sine: float
    to_ground: bool
    ray: Vec3
    width: float


@kernel
def half_sine_between(ray, sun_x, sun_z):
    """sin(θ/2) of the angle between a direction and the star, from their chord. [1]

    Parameters
    ----------
    ray : Vec3
        Direction in the observer's frame, a unit vector. [1]
    sun_x, sun_z : float
        Components as in ``Observer``. [1]
    """
    across = (ray.x - sun_x) * (ray.x - sun_x) + ray.y * ray.y
    return min(0.5 * sqrt(across + (ray.z - sun_z) * (ray.z - sun_z)), 1.0)


@inlined
def line_of_sight(line, observer, tables):
    """Segment of a line of sight inside the shell.

    Parameters
    ----------
    line, observer, tables :
        Arguments of ``look``.

    Returns
    -------
    way : float
        Distance of its start from the observer. [m]
    r, start_mu, start_mu_s, nu, length : float
        Radius at its start [m], view-zenith and star-zenith cosines there [1], cosine between line
        and star [1], and length [m].
    """
    mu, sine, cos_azimuth, to_ground = line.mu, line.sine, line.cos_azimuth, line.to_ground
    nu = min(max(sine * cos_azimuth * observer.sun_x + mu * observer.sun_z, -1.0), 1.0)
    way, r, start_mu, start_mu_s = 0.0, observer.r, mu, observer.sun_z
    if observer.outside:
        impact = observer.r * sine
        r = tables.top
        across, up = first_intersection(min(impact, tables.top), sine, tables.top)
        half = sqrt(max((tables.top - impact) * (tables.top + impact), 0.0))
        way, start_mu = -observer.r * mu - half, -half / tables.top
        start_mu_s = star_from(across, up, tables.top, cos_azimuth, observer.sun_x, observer.sun_z)
    length = distance_to_top(r, start_mu, tables.top)
    if to_ground:
        length = distance_to_bottom(r, start_mu, tables.bottom)
    return way, r, start_mu, start_mu_s, nu, length


@inlined
def star_on_ground(line, r, start_mu, nu, length, column, observer, tables):
    """Star-zenith cosine at the end of a line of sight, and angle of refraction.

    Parameters
    ----------
    line, observer, tables :
        Arguments of ``look``.
    r, start_mu, nu, length : float
        Results of ``line_of_sight``.
    column : float
        Column of the last constituent, along the line. [m]

    Returns
    -------
    mu_s, angle : float
        Cosine [1] and angle [rad].
    """
    impact = observer.r * line.sine
    across, up = first_intersection(min(impact, tables.bottom), line.sine, tables.bottom)
    mu_s = star_from(across, up, tables.bottom, line.cos_azimuth, observer.sun_x, observer.sun_z)
    angle = 0.0
    if tables.refraction_strength > 0.0:
        angle = refraction_angle(r, start_mu, tables.refraction_strength, column)
        slant = (r * start_mu + length) / tables.bottom
        mu_s, _ = turned(slant, mu_s, nu, angle)
        mu_s = min(max(mu_s, -1.0), 1.0)
    return mu_s, angle


@inlined
def look(line, air, peaks, polarised, observer, tables, work):
    """March one line of sight: path radiance, and radiance of a white ground behind it.

    Single scattering by separated constituents is excluded. The result is ``work.radiance``: the
    air's radiance, that of a white Lambert ground behind it [sr⁻¹], the single scattering by the
    two peaked constituents [1], and with ``polarised`` Q and U of the air's light. [sr⁻¹]

    Parameters
    ----------
    line : SightLine
        Line of sight.
    air, peaks, polarised : bool
        ``MarchTerms``.
    work : MarchWorkspace
        Argument of ``march``.
    observer, tables : Observer, MarchTables
        Observer, and tables of the solution.

    Returns
    -------
    float
        Angle of refraction of a line that ends on the ground. [rad]
    """
    half_sine, to_ground = line.half_sine, line.to_ground
    way, r, start_mu, start_mu_s, nu, length = line_of_sight(line, observer, tables)
    angle = 0.0
    unseparated_phases(half_sine, tables.phase, tables, work.phase)
    if polarised:
        unseparated_phases(half_sine, tables.phase_f12, tables, work.phase_f12)
    ring = no_rings()
    if tables.rings.ringed and dot(line.ray, line.ray) > 0.0:
        start, sun = scaled(line.ray, way), Vec3(observer.sun_x, 0.0, observer.sun_z)
        blur = DISC * line.width * way / max(abs(start_mu), FLATTEST)
        ring = ring_line(minus(start, observer.centre), line.ray, observer.ground_z, sun, blur)
    segment = Segment(r, start_mu, start_mu_s, nu, half_sine, length, ring)
    terms = MarchTerms(air, peaks, polarised)
    march(segment, observer.orders, terms, tables, work, work.radiance)
    if air and to_ground:
        column = work.columns_total[tables.constituents - 1]
        mu_s, angle = star_on_ground(line, r, start_mu, nu, length, column, observer, tables)
        ground_light(mu_s, observer.orders, tables, work)
        left = ring_shade_on(length, segment, tables)
        for at in range(0, tables.lanes, LANES):
            received, found = lane_view(work.irradiance, at), lane_view(work.radiance, at)
            found[1] = (received[0] + received[1]) * np.float32(left) * INVERSE_PI * found[1]
    else:
        for at in range(0, tables.lanes, LANES):
            found = lane_view(work.radiance, at)
            found[1] = splat(0.0)
    return angle


@inlined
def unseparated_phases(half_sine, table, tables, phase):
    """Phase matrix element of all constituents; 0 if separated. [sr⁻¹]

    Parameters
    ----------
    half_sine : float
        sin(θ/2). [1]
    table : array
        ``phase`` or ``phase_f12`` of the tables.
    tables : MarchTables
        Tables of the solution.
    phase : array, shape (nc, w)
        Receives the elements. [sr⁻¹]
    """
    read_phase(half_sine, table, phase)
    for at in range(0, tables.lanes, LANES):
        elements = lane_view(phase, at)
        if tables.separated_1 >= 0:
            elements[tables.separated_1] = splat(0.0)
        if tables.separated_2 >= 0:
            elements[tables.separated_2] = splat(0.0)


@inlined
def line_of_texel(column, row, window, observer, tables):
    """Line of sight of a texel, a ``SightLine``; arguments of ``sky_view_texel``."""
    sky = row < window.rows
    at = row_coordinate(row, window.rows, observer.outside)
    cos_azimuth = cos(pi * column / (window.columns - 1))
    if observer.outside:
        sine = impact_from_row(at, sky, tables.bottom, tables.top) / observer.r
        mu = -sqrt(max((1.0 - sine) * (1.0 + sine), 0.0))
    else:
        mu, sine = direction_from_row(at, sky, observer.horizon_mu, observer.horizon_sine)
    side = sqrt(max((1.0 - cos_azimuth) * (1.0 + cos_azimuth), 0.0))
    ray = Vec3(sine * cos_azimuth, sine * side, mu)
    half_sine = half_sine_between(ray, observer.seen_x, observer.seen_z)
    return SightLine(mu, sine, cos_azimuth, half_sine, not sky, Vec3(0.0, 0.0, 0.0), 0.0)


@inlined
def upright(line):
    """Line of sight, or if it is vertical the nearest that has a meridian plane: ``SightLine``."""
    mu, sine = line.mu, line.sine
    if sine < UPRIGHT:
        mu, sine = sqrt(1.0 - UPRIGHT * UPRIGHT) * (1.0 if mu > 0.0 else -1.0), UPRIGHT
    return SightLine(mu, sine, line.cos_azimuth, line.half_sine, line.to_ground, line.ray, 0.0)


@kernel
def row_coordinate(row, rows, outside):
    """Coordinate of a row in its half. [1]

    From outside, the last sky row is slightly inside the top of the shell, as fourth roots are too
    steep at zero length.

    Parameters
    ----------
    row, rows : int
        Index of a row, and number of rows of one half.
    outside : bool
        Whether the observer is outside the shell.

    Examples
    --------
    >>> row_coordinate(8, 9, False), row_coordinate(8, 9, True), row_coordinate(17, 9, True)
    (1.0, 0.9875, 1.0)
    """
    if row >= rows:
        return (row - rows) / (rows - 1)
    inside = INSIDE if outside else 0.0
    return min(row, rows - 1.0 - inside) / (rows - 1)


@inlined
def sky_view_texel(column, row, window, air, peaks, polarised, observer, tables, work):
    """Texel: fourth roots of the results of ``look``, with I + Q and I + U, in ``work.radiance``.

    Parameters
    ----------
    column, row : int
        Indices; of 3·rows, the first third is the sky from the horizon up, the second the ground,
        the last the table of ``sea_sky``.
    window : SkyViewWindow
        Window of the LUT, with its numbers of azimuths and of rows of one half.
    air, peaks, polarised, observer, tables, work :
        Arguments of ``look``.
    """
    if row >= 2 * window.rows:
        shown = air and tables.ground.wet and observer.orders != 1
        number = (row - 2 * window.rows) * window.columns + column
        sea_sky_texel(number, shown, window, air, peaks, observer, tables, work)
    else:
        line = line_of_texel(column, row, window, observer, tables)
        if polarised:
            line = upright(line)
        look(line, air, peaks, polarised, observer, tables, work)
        for at in range(0, tables.lanes, LANES):
            found = lane_view(work.radiance, at)
            if polarised:
                for layer in range(4, 6):
                    found[layer] = fourth_root(maximum(found[0] + found[layer], 0.0))
            for layer in range(4):
                found[layer] = fourth_root(found[layer])


@inlined
def mirrored_texel(column, row, window, sky, observer, tables, work):
    """Texel of the sky that the sea mirrors, a fourth root, in ``work.radiance``.

    Parameters
    ----------
    column, row : int
        Indices as in ``sky_view_texel``: the second third has the mean sky at the end of each line
        to the ground, the last one the mean light there of the facets of resolved waves.
    sky : array, shape (texels, w)
        Layer ``air`` of the LUT, with the table of ``sea_sky``. [sr^-¼]
    window, observer, tables, work :
        Arguments of ``sky_view_texel``.
    """
    filled = row >= window.rows and tables.ground.wet and observer.orders != 1
    facets = row >= 2 * window.rows
    if filled:
        ground = row - window.rows if facets else row
        line = line_of_texel(column, ground, window, observer, tables)
        angle = 0.0
        if tables.refraction_strength > 0.0:
            angle = refraction_to_ground(line.mu, line.sine, observer, tables, work.columns_total)
        mu_s, mu_r, nu = ground_angles(
            line.sine * line.cos_azimuth, line.mu, line.sine, angle, observer, tables
        )
        place = mirror_place(mu_s, mu_r, nu, 1.0, observer, window)
        if facets:
            mean_facet(place, sky, tables, work)
        else:
            mirrored_sky(place, sky, tables, work)
    for at in range(0, tables.lanes, LANES):
        found = lane_view(work.radiance, at)
        root = splat(0.0)
        if filled and facets:
            root = fourth_root(found[FACETS])
        elif filled:
            root = fourth_root(found[MIRRORED])
        found[0] = root
