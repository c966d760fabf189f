"""Hills, valleys and woods between the resolution of maps and that of the texture of land.

Decoration: fractal relief of cells from a texel of the map (7 km on Earth) to a sixty-fourth of
it, each with half the height of the next coarser one, so that slopes have no scale of their own.
Crests are sharp and rough, valleys smooth: finer relief grows with the height of coarser one, as in
the multifractals of Musgrave, Kolb & Mace (1989, SIGGRAPH Comput. Graph. 23(3), 41), and is bent by
it, so that valleys wander; slopes leave the bend out. On green land there are woods of trees with
domes for crowns.
"""

from __future__ import annotations

from math import sqrt
from typing import Final, NamedTuple

from airlight.geometry.gradient_noise import sloping_noise, smooth_noise
from airlight.geometry.vectors import Vec3
from airlight.kernel import kernel
from airlight.scene.ground_detail import along_lattice

#: Number of octaves of hills, and cells of the coarsest over the finest of ``ground_detail``.
OCTAVES: Final = 7
COARSEST: Final = 65536.0
#: Number of coarsest octaves that change the reflectance: finer ones are texture of the land.
TONED: Final = 4
#: Distance in cells at which an octave begins around a low observer, who stands on level ground,
#: and growth of its height with the distance in cells. [1]
BEGIN: Final = 0.5
GROWTH: Final = 0.6
#: Mean of the size of the noise, which crests are measured from. [1]
HALF: Final = 0.33
#: Noise over which crests are rounded. [1]
CREST: Final = 0.05
#: Cells of woods and of their edges; height of trees, and size of their crowns: on Earth 460 m
#: to 29 m, 14 m and 14 m.
WOODS: Final = 4096.0
CROWNS: Final = 128.0
TREES: Final = 125.0
#: Cells of stands of one height: on Earth 115 m.
STANDS: Final = 1024.0
#: Ascent of crowns over the slope of their noise, steepest ascent, and change of the reflectance
#: with the height of crowns and from leaf to leaf, by eye. [1]
SIDES: Final = 0.6
STEEPEST: Final = 0.45
GAPS: Final = 1.1
LEAFY: Final = 0.25
#: Mean of the noise of crowns, of 100 000 places. [1]
CROWN: Final = 0.333
#: Noise above which there are woods, and width of their edges. [1]
WOODED: Final = 0.2
EDGE: Final = 0.05


class Hills(NamedTuple):
    """Hills at a place.

    Attributes
    ----------
    height : float
        Height over that of the coarsest octave. [1]
    ascent : float
        Ascent along a horizontal direction, per height of the coarsest octave. [m⁻¹]
    tone : float
        Relative change of the reflectance over that of the coarsest octave. [1]
    """

    height: float
    ascent: float
    tone: float


class Canopy(NamedTuple):
    """Trees at a place.

    Attributes
    ----------
    height : float
        Height. [finest cell]
    ascent : float
        Ascent of their crowns along a horizontal direction, of mean 0. [1]
    tone : float
        Reflectance over that of the wood, of mean 1: gaps between crowns are dark. [1]
    """

    height: float
    ascent: float
    tone: float


@kernel
def lattice_place(finest, whole, scale):
    """Place on the lattice of cells of a size. [cell]

    Parameters
    ----------
    finest, whole : Vec3
        Place from the observer's lattice point [finest cell], and that point.
    scale : float
        Size of the cells. [finest cell]
    """
    inverse = 1.0 / scale
    return Vec3(
        along_lattice(whole.x, finest.x, inverse),
        along_lattice(whole.y, finest.y, inverse),
        along_lattice(whole.z, finest.z, inverse),
    )


@kernel
def hills(finest, footprint, distance, whole, way, sloping, cell, fall, least):
    """``Hills`` at a place.

    Parameters
    ----------
    finest : Vec3
        Place from the observer's lattice point. [finest cell]
    footprint : float
        Size of the pixel. [finest cell]
    distance : float
        Distance from a low observer. [finest cell]
    whole, way : Vec3
        Result of ``lattice_origin``; horizontal direction of the ascent. [1]
    sloping : bool
        Whether the ascent is asked for.
    cell : float
        Size of the finest cells. [m]
    fall : float
        Ratio of the contrast of land at a scale to that at four times the scale. [1]
    least : float
        Height below which hills are not asked for: their octaves are left out. [1]
    """
    height, ascent, tone, loud, rough = 0.0, 0.0, 0.0, 1.0, 1.0
    scale, bend = COARSEST, 0.0
    for octave in range(OCTAVES):
        # all finer octaves together are not higher than twice the next
        if height + 2.0 * HALF * scale / COARSEST < least:
            break
        shown = min(0.6 * scale / footprint - 1.0, 1.0)
        shown = min(shown, GROWTH * (distance / scale - BEGIN))
        if shown > 0.0:
            at = lattice_place(finest, whole, scale)
            x, y, z = at.x + bend, at.y - bend, at.z + 0.5 * bend
            value, slope = 0.0, 0.0
            if sloping:
                value, slope = sloping_noise(x, y, z, way)
            else:
                value = smooth_noise(x, y, z)
            here = HALF - abs(value)
            part = shown * rough
            height += part * here * scale / COARSEST
            slope *= min(max(value / CREST, -1.0), 1.0)
            ascent -= part * slope / (COARSEST * cell)
            if octave < TONED:
                tone += shown * loud * value
            rough *= min(max(0.8 + 2.0 * here, 0.2), 1.0)
            bend = 2.0 * bend + shown * value
        loud *= sqrt(fall)
        scale *= 0.5
    return Hills(height, ascent, tone)


@kernel
def woods(finest, footprint, whole, tone):
    """Share of woods, 0 to 1: they cover crests rather than valleys. [1]

    Parameters
    ----------
    finest, footprint, whole :
        Arguments of ``hills``.
    tone : float
        ``tone`` of ``Hills``. [1]
    """
    value = tone - WOODED
    fine, part = WOODS, 0.7
    for _octave in range(3):
        shown = min(max(0.6 * fine / footprint - 1.0, 0.0), 1.0)
        if shown > 0.0:
            at = lattice_place(finest, whole, fine)
            value += shown * part * smooth_noise(at.x, at.y, at.z)
        fine *= 0.25
        part *= 0.5
    edge = EDGE + 2.0 * footprint / WOODS
    return min(max(0.5 + value / edge, 0.0), 1.0)


@kernel
def canopy(finest, footprint, whole, wood, way):
    """``Canopy`` of a wood: domes of two sizes, in stands of several heights.

    Parameters
    ----------
    finest, footprint, whole, way :
        Arguments of ``hills``.
    wood : float
        Result of ``woods``. [1]
    """
    at = lattice_place(finest, whole, CROWNS)
    value, slope = sloping_noise(at.x, at.y, at.z, way)
    at = lattice_place(finest, whole, 2.0 * CROWNS)
    broad, broad_slope = sloping_noise(at.x, at.y, at.z, way)
    at = lattice_place(finest, whole, STANDS)
    stands = smooth_noise(at.x, at.y, at.z)
    share = min(max(0.5 + 1.5 * stands, 0.0), 1.0)
    crown = (1.0 - share) * abs(value) + share * abs(broad)
    slope *= (1.0 - share) if value > 0.0 else share - 1.0
    slope += 0.5 * (share if broad > 0.0 else -share) * broad_slope
    at = lattice_place(finest, whole, 0.125 * CROWNS)
    leaves = smooth_noise(at.x, at.y, at.z)
    dome = crown * (2.0 - crown) + 0.08 * leaves
    edge = (1.0 - wood) * (1.0 - wood)
    height = TREES * (1.0 - edge * edge) * max(0.4 + 0.85 * dome + 0.5 * stands, 0.3)
    shown = wood * min(max(0.3 * CROWNS / footprint - 1.0, 0.0), 1.0)
    ascent = SIDES * (1.0 - crown) * slope
    ascent *= shown / sqrt(1.0 + ascent * ascent / (STEEPEST * STEEPEST))
    return Canopy(height, ascent, 1.0 + shown * (GAPS * (crown - CROWN) + LEAFY * leaves))
