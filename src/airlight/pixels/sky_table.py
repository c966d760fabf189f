"""Table of the sky around one observer: one line of sight a texel.

A texel holds fourth roots, so that light that falls e-fold from one texel to the next is still
accurate to a per cent between them, and nothing is negative. Where some of the ground is water a
third part follows sky and ground: the sky that is seen mirrored at the ground's end of each line.
"""

from __future__ import annotations

from math import cos, pi, sqrt
from typing import Final, NamedTuple

from airlight.geometry.refraction import refraction_angle, turned
from airlight.geometry.shell import distance_to_bottom, distance_to_top, first_intersection
from airlight.kernel import inlined, kernel
from airlight.kernel.lanes import INVERSE_PI, LANES, fourth_root, load, maximum, splat, store
from airlight.mappings.sky_view import direction_from_row, impact_from_row
from airlight.optics.cox_munk import mean_square_slope
from airlight.pixels.ground_angles import mirrored_line, refraction_to_ground, star_from
from airlight.solvers.moments.irradiance import ground_light
from airlight.solvers.moments.march import march
from airlight.solvers.moments.source import read_phase

#: Position of the last row of the sky, seen from outside, in rows inside the top.
INSIDE = 0.1
#: Least sine of the zenith angle of a texel of Q and U, which refer to a vertical line's azimuth:
#: all azimuths meet there, and single precision cannot tell them apart. [1]
UPRIGHT: Final = 5e-3


class Observer(NamedTuple):
    """Position of the observer, and direction of the star.

    Attributes
    ----------
    r : float
        Distance from the centre, as optical radius inside the shell. [m]
    optical_altitude : float
        ``r`` less the optical radius of the ground, which single precision has from ``r`` to half a
        metre only. [m]
    outside : bool
        Whether the observer is above the top of the shell.
    horizon_mu, horizon_sine : float
        Cosine and sine of the horizon's zenith angle. [1]
    sun_x, sun_z : float
        Horizontal and vertical component towards the star, whose vertical plane contains the
        frame's first axis. [1]
    seen_x, seen_z : float
        Components towards the apparent star. [1]
    orders : int
        1: light scattered once; 0: all other light; 2: both.
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


@kernel
def half_sine_between(x, y, z, sun_x, sun_z):
    """Half-angle sine sin(θ/2) between a direction and the star, from the vectors' difference. [1]

    Parameters
    ----------
    x, y, z : float
        Direction in the observer's frame, a unit vector. [1]
    sun_x, sun_z : float
        Components as in ``Observer``. [1]
    """
    across = (x - sun_x) * (x - sun_x) + y * y
    return min(0.5 * sqrt(across + (z - sun_z) * (z - sun_z)), 1.0)


@inlined
def line_of_sight(mu, sine, cos_azimuth, to_ground, observer, tables):
    """Find the stretch of a line of sight that lies in the air.

    Parameters
    ----------
    mu, sine, cos_azimuth, to_ground, observer, tables :
        Arguments of ``look``.

    Returns
    -------
    r, start_mu, start_mu_s, nu, length : float
        Radius of its start [m], cosines of its and of the star's zenith angle there [1] and of
        the angle between line and star [1], and its length [m].
    """
    nu = min(max(sine * cos_azimuth * observer.sun_x + mu * observer.sun_z, -1.0), 1.0)
    r, start_mu, start_mu_s = observer.r, mu, observer.sun_z
    if observer.outside:
        impact = observer.r * sine
        r = tables.top
        across, up = first_intersection(min(impact, tables.top), sine, tables.top)
        start_mu = -sqrt(max((tables.top - impact) * (tables.top + impact), 0.0)) / tables.top
        start_mu_s = star_from(across, up, tables.top, cos_azimuth, observer.sun_x, observer.sun_z)
    length = distance_to_top(r, start_mu, tables.top)
    if to_ground:
        length = distance_to_bottom(r, start_mu, tables.bottom)
    return r, start_mu, start_mu_s, nu, length


@inlined
def star_on_ground(sine, cos_azimuth, r, start_mu, nu, length, column, observer, tables):
    """Cosine of the star's zenith angle at the end of a line of sight, and angle of refraction.

    Parameters
    ----------
    sine, cos_azimuth, observer, tables :
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
    impact = observer.r * sine
    across, up = first_intersection(min(impact, tables.bottom), sine, tables.bottom)
    mu_s = star_from(across, up, tables.bottom, cos_azimuth, observer.sun_x, observer.sun_z)
    angle = 0.0
    if tables.refraction_strength > 0.0:
        angle = refraction_angle(r, start_mu, tables.refraction_strength, column)
        slant = (r * start_mu + length) / tables.bottom
        mu_s, _ = turned(slant, mu_s, nu, angle)
        mu_s = min(max(mu_s, -1.0), 1.0)
    return mu_s, angle


@inlined
def look(
    mu, sine, cos_azimuth, half_sine, to_ground, mirrored, separated_phases, air, peaks, polarised,
    observer, tables, work, result,
):  # fmt: skip
    """Light along one line of sight, and that of a ground behind the air.

    Parameters
    ----------
    mu, sine, cos_azimuth : float
        Direction: cosine and sine of the zenith angle, cosine of the azimuth. [1]
    half_sine : float
        sin(θ/2) of the angle to the apparent star. [1]
    to_ground : bool
        Whether the line ends on the ground.
    mirrored : bool
        Whether the light is asked of the sky that water at that end mirrors, without the air in
        front of it. It is spread as the facets are: a peaked phase function is read no closer to
        the star than that.
    separated_phases : bool
        Whether the air's radiance has the single scattering of the peaked constituents.
    air, peaks, polarised, work : bool, bool, bool, MarchWorkspace
        Arguments of ``march``.
    observer, tables : Observer, MarchTables
        Observer, and tables of the solution.
    result : array, shape (4·w,), or (6·w,) if ``polarised``
        Receives the air's radiance, that of a white Lambert ground behind it [sr⁻¹], the single
        scattering by the two peaked constituents [1], and Q and U of the air's light. [sr⁻¹]

    Returns
    -------
    float
        Angle of refraction of a line that ends on the ground. [rad]
    """
    r, start_mu, start_mu_s, nu, length = line_of_sight(
        mu, sine, cos_azimuth, to_ground, observer, tables
    )
    angle, orders = 0.0, observer.orders
    if mirrored:
        if tables.refraction_strength > 0.0:
            angle = refraction_to_ground(mu, sine, observer, tables, work.columns_total)
        r, orders = tables.bottom, 2
        start_mu, start_mu_s, nu = mirrored_line(
            sine * cos_azimuth, mu, sine, angle, observer, tables
        )
        length = distance_to_top(r, start_mu, tables.top)
        spread = 0.25 * mean_square_slope(tables.ground.wind)
        half_sine = sqrt(min(0.5 * (1.0 - nu) + spread, 1.0))
    phases_towards(half_sine, separated_phases or mirrored, tables.phase, tables, work.phase)
    if polarised:
        phases_towards(half_sine, separated_phases, tables.phase_f12, tables, work.phase_f12)
    march(
        r, start_mu, start_mu_s, nu, half_sine, length, orders, air, peaks, polarised, work.phase,
        work.phase_f12, tables, work, result,
    )  # fmt: skip
    if air and to_ground and not mirrored:
        mu_s, angle = star_on_ground(
            sine, cos_azimuth, r, start_mu, nu, length, work.columns_total[tables.constituents - 1],
            observer, tables,
        )  # fmt: skip
        ground_light(mu_s, observer.orders, tables, work)
        for at in range(0, tables.lanes, LANES):
            received = load(work.irradiance, at) + load(work.irradiance, tables.lanes + at)
            behind = received * INVERSE_PI * load(result, tables.lanes + at)
            store(result, tables.lanes + at, behind)
    else:
        for at in range(0, tables.lanes, LANES):
            store(result, tables.lanes + at, splat(0.0))
    return angle


@inlined
def phases_towards(half_sine, separated_phases, table, tables, phase):
    """Element of all constituents' phase matrices; 0 for the peaked ones unless kept. [sr⁻¹]

    Parameters
    ----------
    half_sine : float
        sin(θ/2). [1]
    separated_phases : bool
        Whether those of the peaked constituents are kept.
    table : array
        ``phase`` or ``phase_f12`` of the tables.
    tables : MarchTables
        Tables of the solution.
    phase : array, shape (c·w,)
        Receives the elements. [sr⁻¹]
    """
    read_phase(half_sine, table, tables.phase_nodes, tables.lanes * tables.constituents, phase)
    if not separated_phases:
        for at in range(0, tables.lanes, LANES):
            if tables.separated_1 >= 0:
                store(phase, tables.lanes * tables.separated_1 + at, splat(0.0))
            if tables.separated_2 >= 0:
                store(phase, tables.lanes * tables.separated_2 + at, splat(0.0))


@inlined
def direction_of_texel(column, row, columns, rows, observer, tables):
    """Line of sight of a texel.

    Parameters
    ----------
    column, row, columns, rows, observer, tables :
        Arguments of ``sky_texel``.

    Returns
    -------
    mu, sine, cos_azimuth : float
        Cosine and sine of its zenith angle, cosine of its azimuth. [1]
    half_sine : float
        sin(θ/2) of the angle to the apparent star. [1]
    """
    sky = row < rows
    at = row_coordinate(row, rows, observer.outside)
    cos_azimuth = cos(pi * column / (columns - 1))
    if observer.outside:
        sine = impact_from_row(at, sky, tables.bottom, tables.top) / observer.r
        mu = -sqrt(max((1.0 - sine) * (1.0 + sine), 0.0))
    else:
        mu, sine = direction_from_row(at, sky, observer.horizon_mu, observer.horizon_sine)
    side = sqrt(max((1.0 - cos_azimuth) * (1.0 + cos_azimuth), 0.0))
    half_sine = half_sine_between(
        sine * cos_azimuth, sine * side, mu, observer.seen_x, observer.seen_z
    )
    return mu, sine, cos_azimuth, half_sine


@kernel
def row_coordinate(row, rows, outside):
    """Coordinate of a row of the table in its half. [1]

    From outside the last row of the sky lies slightly inside the top of the shell: at the top
    itself a line has zero length, and fourth roots fall too steeply towards zero.

    Parameters
    ----------
    row, rows : int
        Arguments of ``sky_texel``.
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
def sky_texel(column, row, columns, rows, air, peaks, polarised, observer, tables, work, result):
    """Texel of the table: fourth roots of the results of ``look``.

    Q and U may be negative, and I + Q and I + U are stored.

    Parameters
    ----------
    column, row : int
        Indices; the first ``rows`` of 3·rows are the sky's, from the horizon up, the next the
        ground's, and the last the mirrored sky's, of the same lines.
    columns, rows : int
        Numbers of azimuths from 0 to π, ends included, and of rows of one half.
    air, peaks, polarised, observer, tables, work, result :
        Arguments of ``look``.
    """
    mirrored = row >= 2 * rows
    shown = air and tables.ground.wet and observer.orders != 1
    if shown or not mirrored:
        line = row - rows if mirrored else row
        mu, sine, cos_azimuth, half_sine = direction_of_texel(
            column, line, columns, rows, observer, tables
        )
        if polarised and sine < UPRIGHT:
            sine = UPRIGHT
            mu = sqrt(1.0 - UPRIGHT * UPRIGHT) * (1.0 if mu > 0.0 else -1.0)
        look(
            mu, sine, cos_azimuth, half_sine, line >= rows, mirrored, False, air, peaks, polarised,
            observer, tables, work, result,
        )  # fmt: skip
    for at in range(0, tables.lanes, LANES):
        if polarised:
            for layer in range(4, 6):
                both = load(result, at) + load(result, tables.lanes * layer + at)
                store(result, tables.lanes * layer + at, fourth_root(maximum(both, 0.0)))
        for layer in range(4):
            root = splat(0.0)
            # The mirrored sky has its peaks in the light of the air.
            if not mirrored or (shown and layer < 2):
                root = fourth_root(load(result, tables.lanes * layer + at))
            store(result, tables.lanes * layer + at, root)
