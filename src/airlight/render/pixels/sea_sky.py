"""Sea-sky LUT: radiance of the sky above water, and its mean over the facets that reflect it.

It contains the radiance of the sky at the ground by the star's zenith cosine, elevation and
azimuth from the star; it follows sky and ground in the sky-view LUT. The mean over the facets of a
line of sight, weighted by their visible area, Fresnel reflectance and visibility of the sky, is a
layer of the LUT with the texels of its ground; the mean of what the facets of resolved waves show
follows there, so that waves have the sea's mean.
"""

from __future__ import annotations

from math import exp, sqrt
from typing import Final, NamedTuple

import numpy as np

from airlight.geometry.shell import distance_to_top
from airlight.geometry.vectors import Vec3
from airlight.kernel import inlined, kernel
from airlight.kernel.lanes import LANES, fourth_root, lane_view, splat
from airlight.physics.optics.cox_munk import (
    facing_limit,
    facing_slope,
    mean_square_slope,
    mirrored_by,
    steepest_mirror,
)
from airlight.solver.moments.march import march
from airlight.solver.moments.march_tables import FACETS, MIRRORED, MarchTerms, Segment
from airlight.solver.moments.source import read_phase
from airlight.solver.tables.ring_shadow import no_rings

#: Elevations, as squares of the cosine of the zenith angle, and azimuths, by sin(φ/2).
ELEVATIONS: Final = 18
AZIMUTHS: Final = 20
SLICE: Final = ELEVATIONS * AZIMUTHS
#: Step of the star's zenith cosine between slices, and lowest cosine: a star 20° below the horizon.
STEP: Final = 0.032
DARKEST: Final = -0.35
#: Facets along and across the line of sight; spacing across in standard deviations. [1]
ALONG: Final = 9
ACROSS: Final = 7
SPACING: Final = 0.85
#: Spacing along it of the facets of resolved waves, and width of the horizon's edge that one
#: mirrors, as it stands for shorter waves too, in standard deviations. [1]
WAVE_SPACING: Final = 0.75
WAVE_BLUR: Final = 1.2
#: Largest slope along the line of sight, in standard deviations. [1]
STEEPEST: Final = 3.6
#: Square of sin(θ/2) by which phase functions are blurred, over the mean-square slope. Facets of
#: the sum are farther apart, but more would dim the aureole: 0.012 by 2.5 %. [1]
BLUR: Final = 0.003


class SunSlices(NamedTuple):
    """Slices of the sea-sky LUT, one per zenith angle of the star.

    Attributes
    ----------
    first, step : float
        Star's zenith cosine of the first, and step. [1]
    number : int
        Number of slices.
    """

    first: float
    step: float
    number: int


class MirrorPlace(NamedTuple):
    """End of a line of sight on water, for the look-up of what its facets mirror.

    Attributes
    ----------
    cosine : float
        Cosine of the zenith angle towards the observer. [1]
    sun_up, sun_ahead, sun_aside : float
        Direction of the star: upwards, along the horizontal direction of the line and across. [1]
    start : int
        First texel of the lower of two slices.
    part : float
        Fraction of the distance to the next slice. [1]
    """

    cosine: float
    sun_up: float
    sun_ahead: float
    sun_aside: float
    start: int
    part: float


@kernel
def sun_slices(observer, window):
    """``SunSlices`` of the star's zenith cosines that an observer sees, up to the horizon.

    They end at the horizon, or at the points under the star and opposite to it.

    Parameters
    ----------
    observer, window : Observer, SkyViewWindow
        Observer, and window of the sky-view LUT.
    """
    low = observer.sun_z * observer.horizon_sine + observer.sun_x * observer.horizon_mu
    high = observer.sun_z * observer.horizon_sine - observer.sun_x * observer.horizon_mu
    if observer.sun_z > observer.horizon_sine:
        high = 1.0
    if -observer.sun_z > observer.horizon_sine:
        low = DARKEST
    low = min(max(low, DARKEST), 1.0 - 1e-3)
    high = max(high, low + 1e-3)
    most = window.columns * window.rows // SLICE
    count = min(2 + int((high - low) / STEP), most)
    return SunSlices(low, (high - low) / (count - 1), count)


@kernel
def sea_sky_size(observer, window):
    """Number of texels of the sea-sky LUT; arguments of ``sun_slices``."""
    return SLICE * sun_slices(observer, window).number


@inlined
def sea_sky_texel(number, shown, window, air, peaks, observer, tables, work):
    """Texel of the sea-sky LUT: radiance of the sky above water, in ``work.radiance``. [sr⁻¹]

    Parameters
    ----------
    number : int
        Index in the sea-sky LUT; texels beyond its end are black.
    shown : bool
        Whether the sea-sky LUT is read.
    window, air, peaks, observer, tables, work :
        Arguments of ``sky_view_texel``.
    """
    slices = sun_slices(observer, window)
    which = number // SLICE
    if shown and which < slices.number:
        row = (number - which * SLICE) // AZIMUTHS
        column = number - which * SLICE - row * AZIMUTHS
        level, half = row / (ELEVATIONS - 1), column / (AZIMUTHS - 1)
        mu, mu_s = level * level, slices.first + which * slices.step
        level = sqrt(max((1.0 - mu) * (1.0 + mu) * (1.0 - mu_s) * (1.0 + mu_s), 0.0))
        nu = min(max(mu * mu_s + level * (1.0 - 2.0 * half * half), -1.0), 1.0)
        blur = BLUR * mean_square_slope(tables.ground.wind)
        half_sine = sqrt(min(0.5 * (1.0 - nu) + blur, 1.0))
        read_phase(half_sine, tables.phase, work.phase)
        length = distance_to_top(tables.bottom, mu, tables.top)
        segment = Segment(tables.bottom, mu, mu_s, nu, half_sine, length, no_rings())
        march(segment, 2, MarchTerms(air, peaks, False), tables, work, work.radiance)
    for at in range(0, tables.lanes, LANES):
        found = lane_view(work.radiance, at)
        root = splat(0.0)
        if shown and which < slices.number:
            root = fourth_root(found[0])
        for layer in range(MIRRORED):
            found[layer] = splat(0.0)
        found[0] = root


@inlined
def mirror_place(mu_s, mu_r, nu, side, observer, window):
    """``MirrorPlace`` at the end of a line of sight.

    Parameters
    ----------
    mu_s, mu_r, nu : float
        Results of ``ground_angles``. [1]
    side : float
        Sign of the star's component across the line of sight.
    observer, window : Observer, SkyViewWindow
        Observer, and window of the sky-view LUT.
    """
    slices = sun_slices(observer, window)
    level = sqrt(max((1.0 - mu_r) * (1.0 + mu_r), 1e-12))
    across = sqrt(max((1.0 - mu_s) * (1.0 + mu_s), 0.0))
    ahead = min(max((nu + mu_r * mu_s) / level, -across), across)
    aside = side * sqrt(max((across - ahead) * (across + ahead), 0.0))
    at = min(max((mu_s - slices.first) / slices.step, 0.0), slices.number - 1.0)
    lower = min(int(at), slices.number - 2)
    first = (window.sky_count + window.ground_count) * window.column_count
    return MirrorPlace(mu_r, mu_s, ahead, aside, first + lower * SLICE, at - lower)


@inlined
def add_mirrored(share, ray, layer, place, sky, tables, work):
    """Add the light of one facet to the mirrored sky.

    Parameters
    ----------
    share : float
        Share of that light. [1]
    ray : Vec3
        Direction that the facet mirrors: along the horizontal direction of the line of sight,
        across it and upwards. [1]
    layer : int
        Index in ``work.radiance`` of the sum that it is added to.
    place : MirrorPlace
        End of the line of sight.
    sky : array, shape (texels, w)
        Layer of the sky-view LUT that contains the sea-sky LUT. [sr^-¼]
    tables, work : MarchTables, MarchWorkspace
        Tables; workspace. [sr⁻¹]
    """
    if share > 0.0:
        level = ray.x * ray.x + ray.y * ray.y
        level *= (1.0 - place.sun_up) * (1.0 + place.sun_up)
        turn = (ray.x * place.sun_ahead + ray.y * place.sun_aside) / sqrt(max(level, 1e-12))
        column = sqrt(min(max(0.5 - 0.5 * turn, 0.0), 1.0)) * (AZIMUTHS - 1)
        row = sqrt(ray.z) * (ELEVATIONS - 1)
        i, j = min(int(row), ELEVATIONS - 2), min(int(column), AZIMUTHS - 2)
        near = place.start + i * AZIMUTHS + j
        down, right = row - i, column - j
        near_left = np.float32((1.0 - down) * (1.0 - right))
        near_right = np.float32((1.0 - down) * right)
        far_left = np.float32(down * (1.0 - right))
        far_right = np.float32(down * right)
        later, sooner = np.float32(place.part), np.float32(1.0 - place.part)
        for at in range(0, tables.lanes, LANES):
            roots, total = lane_view(sky, at), lane_view(work.radiance, at)
            root = sooner * (
                roots[near] * near_left
                + roots[near + 1] * near_right
                + roots[near + AZIMUTHS] * far_left
                + roots[near + AZIMUTHS + 1] * far_right
            )
            root = root + later * (
                roots[near + SLICE] * near_left
                + roots[near + SLICE + 1] * near_right
                + roots[near + SLICE + AZIMUTHS] * far_left
                + roots[near + SLICE + AZIMUTHS + 1] * far_right
            )
            square = root * root
            total[layer] = total[layer] + square * square * np.float32(share)


@kernel
def mirror_facet(number, cosine, wind):
    """Facet of the sum over the sea: its share of the light, and the direction that it mirrors.

    Those along the line of sight are denser where they mirror the horizon. The sum is within 0.4 %
    of the integral for a sky that is ten times as bright at the horizon as overhead, for winds of
    0.5 to 12 m/s.

    Parameters
    ----------
    number : int
        Index, 0 to ``ALONG * ACROSS`` - 1.
    cosine, wind : float
        Arguments of ``mirrored_by``.

    Returns
    -------
    share, ray : float, Vec3
        Weight of the facet times its share [1]; direction as in ``add_mirrored`` [1].
    """
    row = number // ACROSS
    deviation = sqrt(0.5 * mean_square_slope(wind))
    low = max(steepest_mirror(cosine), -STEEPEST * deviation)
    step = (row + 0.5) / ALONG
    along = low + (STEEPEST * deviation - low) * step * step
    relative, normal = along / deviation, SPACING * (number - ACROSS * row - 0.5 * (ACROSS - 1))
    share, _rest, ahead, aside, up = mirrored_by(along, normal * deviation, cosine, wind, 0.0)
    sine = sqrt(max((1.0 - cosine) * (1.0 + cosine), 0.0))
    weight = step * max(cosine + sine * along, 0.0)
    weight *= exp(-0.5 * (relative * relative + normal * normal))
    return weight * share, Vec3(ahead, aside, up)


@inlined
def mirrored_sky(place, sky, tables, work):
    r"""Mean radiance of the sky that the sea mirrors, to ``work.radiance`` at ``MIRRORED``.

    .. math:: L = \frac{\sum w_i F_i V_i L(\omega_i)}{\sum w_i F_i V_i}

    over the facets of ``mirror_facet``, with the weights of visible slopes.

    Parameters
    ----------
    place, sky, tables, work :
        Arguments of ``add_mirrored``.
    """
    total = 0.0
    for at in range(0, tables.lanes, LANES):
        found = lane_view(work.radiance, at)
        found[MIRRORED] = splat(0.0)
    for number in range(ALONG * ACROSS):
        share, ray = mirror_facet(number, place.cosine, tables.ground.wind)
        add_mirrored(share, ray, MIRRORED, place, sky, tables, work)
        total += share
    inverse = np.float32(1.0 / max(total, 1e-30))
    for at in range(0, tables.lanes, LANES):
        found = lane_view(work.radiance, at)
        found[MIRRORED] = found[MIRRORED] * inverse


@inlined
def wave_facet(along, across, cosine, wind):
    """Facet of resolved waves: shares of its light from the sky and from other facets.

    Parameters
    ----------
    along, across : float
        Normal variables of its slopes along the line of sight and across. [1]
    cosine, wind : float
        Arguments of ``mirrored_by``.

    Returns
    -------
    share, rest, ray : float, float, Vec3
        Shares [1]; direction as in ``add_mirrored`` [1].
    """
    deviation = sqrt(0.5 * mean_square_slope(wind))
    tilt = deviation * facing_slope(along, facing_limit(cosine, deviation))
    share, rest, ahead, aside, up = mirrored_by(
        tilt, deviation * across, cosine, wind, WAVE_BLUR * deviation
    )
    return share, rest, Vec3(ahead, aside, up)


@inlined
def mean_facet(place, sky, tables, work):
    r"""Mean light of the facets of resolved waves, to ``work.radiance`` at ``FACETS``. [sr⁻¹]

    .. math:: B = \langle s L \rangle + \langle r \rangle B

    over normal slopes, with the shares s and r of ``wave_facet``: facets that mirror other facets
    show their mean. The trapezoidal rule of a normal density is exact to its ends.

    Parameters
    ----------
    place, sky, tables, work :
        Arguments of ``add_mirrored``.
    """
    total, others = 0.0, 0.0
    for at in range(0, tables.lanes, LANES):
        found = lane_view(work.radiance, at)
        found[FACETS] = splat(0.0)
    for number in range(ALONG * ACROSS):
        row = number // ACROSS
        along = WAVE_SPACING * (row - 0.5 * (ALONG - 1))
        across = SPACING * (number - ACROSS * row - 0.5 * (ACROSS - 1))
        weight = exp(-0.5 * (along * along + across * across))
        share, rest, ray = wave_facet(along, across, place.cosine, tables.ground.wind)
        add_mirrored(weight * share, ray, FACETS, place, sky, tables, work)
        total += weight
        others += weight * rest
    inverse = np.float32(1.0 / (total - others))
    for at in range(0, tables.lanes, LANES):
        found = lane_view(work.radiance, at)
        found[FACETS] = found[FACETS] * inverse
