"""Glint of the star's disc on the sea, and resolved waves of a pixel.

The slopes of a pixel are those of the resolved waves plus a normal variable with the rest of the
variance. Both are mapped to visible slopes by ``cox_munk.facing_slope``, so that the mean over the
waves is the unresolved sea's.
"""

from __future__ import annotations

from math import exp, sqrt
from typing import Final, NamedTuple

import numpy as np

from airlight.geometry.vectors import Vec3, components
from airlight.kernel import inlined
from airlight.kernel.lanes import LANES, lane_view, maximum, splat
from airlight.physics.optics.cox_munk import (
    LEVEL,
    facing_limit,
    facing_normal,
    mean_square_slope,
)
from airlight.render.pixels.sea_sky import add_mirrored, wave_facet
from airlight.scene.sea_waves import sea_slopes
from airlight.solver.moments.march_tables import FACETS, MIRRORED

#: Result of ``disc_spread`` that is neglected.
SMALL: Final = 1e-3


class Waves(NamedTuple):
    """Resolved waves in a pixel.

    Attributes
    ----------
    along, across : float
        Slopes towards the observer and across the line of sight, in standard deviations of the
        slopes of one axis. [1]
    share : float
        Share of the mean-square slope that is resolved. [1]
    """

    along: float
    across: float
    share: float


@inlined
def resolved_waves(ray, sine, place, footprint, observer, view, tables):
    """``Waves`` at the end of a line of sight.

    Parameters
    ----------
    ray : Vec3
        Direction in the observer's frame. [1]
    sine : float
        Sine of its zenith angle. [1]
    place : Vec3
        Its end relative to the point below the observer, in the planet's frame. [m]
    footprint : float
        Longer axis of the pixel's footprint. [m]
    observer, view, tables : Observer, ViewUniforms, MarchTables
        Observer, camera, and tables of the solution.
    """
    x, y = 1.0, 0.0
    if sine > 1e-6:
        x, y = ray.x / sine, ray.y / sine
    ahead = components(Vec3(x, y, 0.0), observer.ground_x, observer.ground_y, observer.ground_z)
    aside = components(Vec3(-y, x, 0.0), observer.ground_x, observer.ground_y, observer.ground_z)
    wind = tables.ground.wind
    rise, drift, share = sea_slopes(
        place, ahead, aside, footprint, wind, view.detail_cell, view.whole, view.part
    )
    inverse = 1.0 / sqrt(0.5 * mean_square_slope(wind))
    return Waves(rise * inverse, drift * inverse, share)


@inlined
def disc_spread(mu_s, mu_r, tables):
    """Variance that the star's disc adds to slopes across the line of sight, over theirs. [1]

    (α/2)²/(μ₀ + μ)² over the variance of the slopes, with the disc's angular radius α: towards the
    horizon the glint is not narrower than the star.

    Parameters
    ----------
    mu_s, mu_r : float
        Cosines of the zenith angles of star and observer. [1]
    tables : MarchTables
        Tables of the solution.
    """
    both = max(mu_s, LEVEL) + mu_r
    square = mean_square_slope(tables.ground.wind)
    return 0.5 * tables.star_radius * tables.star_radius / (both * both * square)


@inlined
def spread_glint(waves, place, tables):
    """Glint of a pixel over that of all facets for a point-like star. [1]

    The density of slopes at the facet that mirrors the star, given the resolved waves, over that
    without. The star's disc adds (α/4)² to their variance along the line of sight, and
    ``disc_spread`` across.

    Parameters
    ----------
    waves : Waves
        Resolved waves.
    place : MirrorPlace
        End of the line of sight.
    tables : MarchTables
        Tables of the solution.
    """
    variance = 0.5 * mean_square_slope(tables.ground.wind)
    deviation = sqrt(variance)
    both = max(place.sun_up, LEVEL) + place.cosine
    across = -place.sun_aside / (both * deviation)
    broad = max(1.0 - waves.share, 0.01) + disc_spread(place.sun_up, place.cosine, tables)
    power = across * across
    left = across - waves.across
    power -= left * left / broad
    if waves.share > 0.0:
        sine = sqrt(max((1.0 - place.cosine) * (1.0 + place.cosine), 0.0))
        limit = facing_limit(place.cosine, deviation)
        along = facing_normal((sine - place.sun_ahead) / (both * deviation), limit)
        disc = 0.25 * tables.star_radius
        long = max(1.0 - waves.share, 0.01) + disc * disc / variance
        left = along - waves.along
        power += along * along - left * left / long
        broad *= long
    return exp(min(max(0.5 * power, -60.0), 60.0)) / sqrt(broad)


@inlined
def mirror_waves(waves, place, sky, tables, work):
    r"""What the resolved waves mirror, in place of the mean at ``MIRRORED``.

    .. math:: L = M \left(1 - w + w \, (s L(\omega) + r B)/B\right)

    with the mean M over all facets, the light of a facet of the resolved slopes, scaled to the
    whole variance, over its mean B (``sea_sky.mean_facet``), and the weight w = √share: the mean
    over waves is M, and their contrast kept to first order.

    Parameters
    ----------
    waves : Waves
        Resolved waves.
    place, sky, tables, work :
        Arguments of ``sea_sky.add_mirrored``; ``work.radiance`` has M at ``MIRRORED`` and B at
        ``FACETS``, which is lost. [sr⁻¹]
    """
    weight = sqrt(waves.share)
    share, rest, ray = wave_facet(
        waves.along / weight, waves.across / weight, place.cosine, tables.ground.wind
    )
    others = np.float32(1.0 - weight + weight * rest)
    for at in range(0, tables.lanes, LANES):
        found = lane_view(work.radiance, at)
        found[MIRRORED] = found[MIRRORED] / maximum(found[FACETS], splat(1e-30))
        found[FACETS] = found[FACETS] * others
    add_mirrored(weight * share, ray, FACETS, place, sky, tables, work)
    for at in range(0, tables.lanes, LANES):
        found = lane_view(work.radiance, at)
        found[MIRRORED] = found[MIRRORED] * found[FACETS]
