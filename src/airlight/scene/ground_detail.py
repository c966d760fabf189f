"""Procedural noise on the ground below the resolution of its map; it is not data.

Octaves of gradient noise, each half of the previous scale, from a map texel to about 10 cm, of mean
0. Scales below two pixels are omitted, with a fade between two and four. Coordinates are relative
to the point below the observer, for single precision.

The noise displaces the places at which maps are read between texels. Displacements of an octave
have 0.55 of those of the next coarser one, a Hausdorff dimension of 1.14: coasts have 1.02 (South
Africa) to 1.25 (Britain; Mandelbrot 1967, Science 156, 636). Water is where its interpolated
share exceeds a half; the colours of texels meet at edges, which the noise breaks.
"""

from __future__ import annotations

from math import exp, floor, log, pi, sqrt
from typing import Final, NamedTuple

from airlight.geometry.gradient_noise import GRADIENT_DEVIATION, PERIOD, gradient_noise, quintic
from airlight.kernel import kernel

#: Least height of an observer over detailed ground, whose horizon is not at the eye. [m]
LEAST_HEIGHT: Final = 0.01
#: Number of sizes of cells, and ratio between them; noise has one more octave between each two.
OCTAVES: Final = 9
STEP: Final = 4
#: Period of the finest cells, a multiple of all others' periods.
WHOLE_PERIOD: Final = PERIOD * STEP ** (OCTAVES - 1)
#: Contrast of the coarsest octave where there is no map, and ratio of successive octaves'. [1]
PLAIN_CONTRAST: Final = 0.04
PLAIN_FALL: Final = 1.0
#: Standard deviation of the displacement by the coarsest octave. [texel]
DISPLACED: Final = 0.09
#: Ratio of the displacements of an octave and the next coarser one. [1]
DISPLACED_FALL: Final = 0.6
#: Width of shallow water along a coast. [texel]
SHOAL: Final = 0.25
#: Share of the colours between texels that has the edges of ``edged``, by eye. [1]
EDGED: Final = 0.8
#: Coefficients b and q of the logit b x (1 + q x²) of the normal distribution at x, within 2e-4 of
#: probability (Page 1977, J. R. Stat. Soc. C 26, 75), and largest x. [1]
_LOGIT: Final = 1.5957691
_CUBIC: Final = 0.044715
_FARTHEST: Final = 8.0
#: Cover of thin clouds, at the edges of thicker ones; difference between the shares of places with
#: thin and with thick ones, over that of a half; and width of edges over that of thick parts, by
#: eye. [1]
THIN: Final = 0.4
NESTED: Final = 1.55
GRADUAL: Final = 0.4
#: Width of the coast where it is seen from near, 29 m on Earth. [texel]
SHARPEST: Final = 1.0 / 256.0
#: Rows of the map that defines the cells where the planet has none.
NOMINAL_ROWS: Final = 1024
#: Options: the map alone, or with its detail.
GROUNDS: Final = ("plain", "detailed")


class GroundNoise(NamedTuple):
    """Sums of octaves of noise, with the coarsest of standard deviation 1 and mean 0.

    Attributes
    ----------
    north, east : float
        For displacements. [1]
    """

    north: float
    east: float


@kernel
def finest_cell(radius, rows):
    """Size of the finest noise cells. [m]

    Parameters
    ----------
    radius : float
        Radius of the ground. [m]
    rows : float
        Number of rows of its map.
    """
    return 3.141592653589793 * radius / (rows * float(STEP ** (OCTAVES - 1)))


@kernel
def lattice_origin(component, radius, cell):
    """Lattice coordinate of the point below the observer along one axis: integer and fraction.

    Parameters
    ----------
    component : float
        Component of the unit vector from the planet's centre to that point. [1]
    cell : float
        Size of the finest cells. [m]

    Returns
    -------
    whole, part : float
        Index of the cell, modulo the period, and fraction before the point. [1]

    Examples
    --------
    >>> lattice_origin(-0.5, 5.0, 2.0)  # -1.25 cells, of a period of 16777216
    (16777214.0, 0.75)
    """
    place = component * radius / cell
    whole = floor(place)
    return float(whole % WHOLE_PERIOD), place - whole


@kernel
def along_lattice(whole, beyond, inverse):
    """Lattice coordinate along one axis, to a period; exact products, as sizes are powers of 2.

    Parameters
    ----------
    whole : float
        Result of ``lattice_origin``.
    beyond : float
        Distance from that lattice point. [finest cell]
    inverse : float
        Size of the finest cells over that of these. [1]
    """
    start = whole * inverse
    return start - PERIOD * float(floor(start / PERIOD)) + beyond * inverse


@kernel
def ground_detail(place, footprint, cell, whole, part):
    """``GroundNoise`` of a place.

    Parameters
    ----------
    place : Vec3
        Ground position relative to the point below the observer, in the planet's frame. [m]
    footprint : float
        Longer axis of the pixel footprint. [m]
    whole, part : Vec3
        Results of ``lattice_origin`` along each axis.
    """
    north, east, scale = 0.0, 0.0, 1
    for _octave in range(2 * OCTAVES - 1):
        north *= DISPLACED_FALL
        east *= -DISPLACED_FALL
        shown = min(0.5 * cell * scale / footprint - 1.0, 1.0)
        if shown > 0.0:
            period = float(PERIOD * scale)
            # The cell numbers are integers and stay exact; the remainder is small where this octave
            # is shown.
            noise = shown * gradient_noise(
                (whole.x - period * floor(whole.x / period)) / scale
                + (part.x + place.x / cell) / scale,
                (whole.y - period * floor(whole.y / period)) / scale
                + (part.y + place.y / cell) / scale,
                (whole.z - period * floor(whole.z / period)) / scale
                + (part.z + place.z / cell) / scale,
            )
            north += noise
            east += noise
        scale *= 2
    inverse = 1.0 / GRADIENT_DEVIATION
    return GroundNoise(north * inverse, east * inverse)


@kernel
def pixel_width(level):
    """Width of a pixel, at most that of a texel. [texel]

    Parameters
    ----------
    level : float
        Mip level of the pixel, negative where texels are larger. [1]

    Examples
    --------
    >>> pixel_width(1.0), pixel_width(-2.0), pixel_width(-9.0)
    (1.0, 0.25, 0.00390625)
    """
    return max(2.0 ** min(level, 0.0), SHARPEST)


@kernel
def displacement(width, noise, rows):
    """Angle by which a map is read beside a place between texels. [rad]

    Parameters
    ----------
    width : float
        Result of ``pixel_width``. [texel]
    noise : float
        ``north`` or ``east`` of ``GroundNoise``. [1]
    rows : float
        Number of rows of the map.
    """
    return DISPLACED * (1.0 - width) * min(max(noise, -3.0), 3.0) * pi / rows


@kernel
def edged(value, least, most, width):
    """Value between texels, between edges at which it is the mean of those around it. [1]

    The fade of ``quintic``, twice: odd about the mean, so that a straight edge keeps its place.
    Values that are none of those between, as in narrow strips, remain.

    Parameters
    ----------
    value : float
        Interpolated value. [1]
    least, most : float
        Extremes of those a texel away. [1]
    width : float
        Result of ``pixel_width``. [texel]

    Examples
    --------
    >>> edged(0.5, 0.0, 1.0, 0.1), round(edged(0.7, 0.0, 1.0, 0.0), 3), edged(0.7, 0.0, 1.0, 1.0)
    (0.5, 0.913, 0.7)
    """
    span = max(most - least, 1e-6)
    part = min(max((value - least) / span, 0.0), 1.0)
    return value + EDGED * (1.0 - width) * (quintic(quintic(part)) - part) * span


@kernel
def moved_coast(share, moved):
    """Share of water between texels of land and of water, of a coast that is displaced. [1]

    The interpolated share rises by 1 in a texel at a straight coast; where it is 0 or 1 there is
    none.

    Parameters
    ----------
    share : float
        Interpolated share of water. [1]
    moved : float
        Displacement. [texel]

    Examples
    --------
    >>> moved_coast(0.5, 0.01), moved_coast(1.0, 0.01)
    (0.51, 1.0)
    """
    return share + 4.0 * share * (1.0 - share) * moved


@kernel
def sharper_share(share, width):
    """Share of water in a pixel smaller than the texels. [1]

    The coast is where the share interpolated between texels is a half; it is as wide as the pixel.

    Examples
    --------
    >>> sharper_share(0.4, 1.0), sharper_share(0.4, 0.125), sharper_share(0.5, 0.125)
    (0.4, 0.0, 0.5)
    """
    return min(max(0.5 + (share - 0.5) / width, 0.0), 1.0) if width < 1.0 else share


@kernel
def shoal(share):
    """Share of the light of the land's colour that comes from the bottom of water at a coast. [1]

    Decoration; its mean over the texel of a straight coast is a third of ``SHOAL``.

    Parameters
    ----------
    share : float
        Interpolated share of water, a half at the coast. [1]

    Examples
    --------
    >>> shoal(0.5), shoal(0.9)
    (1.0, 0.0)
    """
    part = min(max(1.0 - (share - 0.5) / SHOAL, 0.0), 1.0)
    return part * part


@kernel
def normal_distribution(x):
    """Share Φ of a normal distribution below x standard deviations. [1]

    Examples
    --------
    >>> round(normal_distribution(1.0), 3), round(normal_distribution(-2.0), 4)
    (0.841, 0.0227)
    """
    near = min(max(x, -_FARTHEST), _FARTHEST)
    return 1.0 / (1.0 + exp(-_LOGIT * near * (1.0 + _CUBIC * near * near)))


@kernel
def normal_quantile(share):
    """Inverse of ``normal_distribution``, by the sine hyperbolic that solves its cubic. [1]

    Examples
    --------
    >>> round(normal_quantile(0.01), 2), round(normal_quantile(normal_distribution(1.5)), 9)
    (-2.32, 1.5)
    """
    size = sqrt(4.0 / (3.0 * _CUBIC))
    logit = 3.0 / (size * _LOGIT) * log(share / (1.0 - share))
    third = log(abs(logit) + sqrt(logit * logit + 1.0)) / 3.0
    return 0.5 * size * (exp(third) - exp(-third)) * (1.0 if logit > 0.0 else -1.0)


@kernel
def above_threshold(cover, sharp, noise, variance):
    """Share of clouds at a place, of mean ``cover``. [1]

    Φ(g (n - t)) of normal noise n of variance σ² above a threshold t, with an edge of the width
    1/g, has the mean c for t = -√(1 + g² σ²) Φ⁻¹(c)/g.

    Parameters
    ----------
    cover : float
        Mean, between 0 and 1. [1]
    sharp : float
        Reciprocal of the width of edges, g. [1]
    noise, variance : float
        Noise and its variance. [1]

    Examples
    --------
    >>> round(above_threshold(0.3, 0.0, 1.0, 1.0), 9)
    0.3
    """
    level = sqrt(1.0 + sharp * sharp * variance) * normal_quantile(cover)
    return normal_distribution(level + sharp * noise)


@kernel
def grained_cover(cover, width, noise, variance, edge):
    """Cover of a cloud layer with noise between texels: clouds and gaps whose mean is the map's.

    Clouds are thin at their edges, which are sharp, and thicken towards cores: the sum of a wide
    and of a narrow threshold. None and full cover are kept. [1]

    Parameters
    ----------
    cover : float
        Cover of the map. [1]
    width : float
        Result of ``pixel_width``. [texel]
    noise, variance, edge : float
        Noise, its variance, and the reciprocal of the width of edges, as of ``CloudGrain``. [1]

    Examples
    --------
    >>> round(grained_cover(0.3, 1.0, 1.0, 1.0, 1.2), 9), grained_cover(1.0, 0.1, 1.0, 1.0, 1.2)
    (0.3, 1.0)
    """
    if cover <= 0.0 or cover >= 1.0:
        return min(max(cover, 0.0), 1.0)
    sharp = edge * (1.0 - width)
    apart = NESTED * cover * (1.0 - cover)
    base = above_threshold(cover + (1.0 - THIN) * apart, sharp, noise, variance)
    core = above_threshold(cover - THIN * apart, GRADUAL * sharp, noise, variance)
    return THIN * base + (1.0 - THIN) * core


@kernel
def unmixed(color, water, share):
    """Reflectance of the land in a texel that is partly water, in one channel. [1]

    Of texels with more than three fifths of water, whose errors would grow, it is darker.

    Parameters
    ----------
    color, water : float
        Reflectance of the texel and of the map's water. [1]
    share : float
        Share of water. [1]

    Examples
    --------
    >>> round(unmixed(0.25, 0.02, 0.5), 6), unmixed(0.3, 0.02, 0.0)
    (0.48, 0.3)
    """
    return min(max((color - share * water) / max(1.0 - share, 0.4), 0.0), 1.0)
