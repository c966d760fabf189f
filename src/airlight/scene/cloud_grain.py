"""Procedural texture of the cloud layer below the resolution of its map; it is not data.

Octaves of gradient noise, each half of the previous scale, from eight texels downwards; a part of
it is folded. The coarsest ones are folded to bands and cells with clear sky between, which gather
the clouds, finer ones to puffs. The places of an octave are displaced by the coarser ones, which
draws puffs out to wisps. Variance falls as k^(-5/3), that of cloud water (Davis et al. 1997, JAS
54, 241), so that clouds above a threshold have all sizes; of few clouds, which are cumulus, more of
it is in fine octaves. Edges are soft in some regions, as those of veils, whose finer fibres are
longer for their width, and hard in others.
"""

from __future__ import annotations

from math import exp, floor, sqrt
from typing import Final, NamedTuple

from airlight.geometry.gradient_noise import (
    DEVIATION,
    GRADIENT_DEVIATION,
    PERIOD,
    gradient_noise,
    sloping_gradient_noise,
    smooth_noise,
)
from airlight.geometry.vectors import Vec3
from airlight.kernel import kernel
from airlight.scene.ground_detail import OCTAVES as GROUND_OCTAVES
from airlight.scene.ground_detail import STEP, WHOLE_PERIOD, along_lattice

#: Number of octaves, and of the coarsest ones that gather clouds.
OCTAVES: Final = 10
GROUPS: Final = 2
#: Step of the cover of a map; covers that are nearer to none or to all have no texture. [1]
STEP_OF_COVER: Final = 1.0 / 255.0
#: Cells of the coarsest octave and of the softness of edges, 8 and 16 texels, over the finest of
#: ``ground_detail``.
COARSEST: Final = 8 * STEP ** (GROUND_OCTAVES - 1)
SOFTNESS: Final = 2 * COARSEST
#: Ratio of the contrasts of an octave and the next coarser one, 2^(-1/3), and its growth as cover
#: falls below a half, by eye: few clouds are small ones in groups. [1]
FALL: Final = 0.7937
FEWER: Final = 0.12
#: Mean and standard deviation of the magnitude of ``gradient_noise``, of a million places. [1]
FOLDED: Final = 0.1100
FOLDED_DEVIATION: Final = 0.0772
#: Shares of folded noise, with creases, and of plain noise, with round puffs: the sum of their
#: squares is 1, as both are uncorrelated. By eye. [1]
PUFFED: Final = 0.35
OPEN: Final = 0.937
#: The same of octaves that gather clouds, along lines where the noise is small. By eye. [1]
GATHERED: Final = -0.3
SPREAD: Final = 0.954
#: Skewness p³ f + 3 p (1 - p²) m of octaves of a share p of folded noise, whose skewness f is 0.770
#: and whose mean product m with the square of plain noise is 1.207, of 200 000 places. [1]
PUFFED_SKEWNESS: Final = 1.145
GATHERED_SKEWNESS: Final = -1.009
#: Standard deviations beyond which the correction of the skewness stays. [1]
FARTHEST: Final = 2.5
#: Displacement of places by coarser octaves, over the width of a cell and their sum, and its growth
#: with the softness of edges, by eye. [1]
WARPED: Final = 0.04
WISPS: Final = 0.07
#: Reciprocal of the width of the edges of clouds in standard deviations of the coarsest octave,
#: and change of its logarithm with noise of its own, by eye. [1]
EDGE: Final = 1.5
VARIED: Final = 2.2
#: Limits of what edges add to the ratio of contrasts: soft clouds are smooth. By eye. [1]
SMOOTHEST: Final = 0.8
ROUGHEST: Final = 1.1
#: Share of the coarsest octave of puffs without clouds, and its growth with their cover; twice that
#: of the next one, up to 1. By eye. [1]
SMALL: Final = 0.35
GROWING: Final = 1.5
#: Octaves of veils from eight texels down, length over width of the two coarsest, which doubles at
#: two of three finer ones, ratio of the contrasts of an octave and the next coarser one,
#: displacement by coarser ones, and of all across parallels by the coarsest, by eye. [1]
VEILS: Final = 7
DRAWN: Final = 1.0
THREADED: Final = 0.75
BENT: Final = 0.2
TURNED: Final = 0.1
#: Ratio of the heights of tops over that of the contrasts, of an octave and the next coarser one:
#: light is scattered from slope to slope within some hundred metres. By eye. [1]
SMOOTH: Final = 0.5


class CloudGrain(NamedTuple):
    """Texture at a place.

    Attributes
    ----------
    noise : float
        Sum of octaves without its skewness, with the coarsest of standard deviation 1 and mean 0.
        [1]
    variance : float
        Its variance, less where fine octaves are not shown. [1]
    edge : float
        Reciprocal of the width of edges, in standard deviations of the coarsest octave. [1]
    ascent : float
        Growth of the height of tops along a direction, over a standard deviation of the coarsest
        octave of puffs; displacements of places count as even. A reflection of every octave at a
        place turns it round and leaves the rest, so that its mean is 0 for every noise. [m⁻¹]
    """

    noise: float
    variance: float
    edge: float
    ascent: float


@kernel
def turning_place(whole, beyond, scale):
    """Coordinate in cells of some finest ones; where these repeat sooner than noise, it turns back.

    Its growth, 1 or -1, is the second result.

    Parameters
    ----------
    whole : float
        Index of a finest cell, modulo ``WHOLE_PERIOD``.
    beyond : float
        Distance from it in finest cells. [1]
    scale : float
        Number of finest cells, a power of 2.

    Examples
    --------
    >>> turning_place(5.0, 0.5, 2.0)
    (2.75, 1.0)
    >>> turning_place(WHOLE_PERIOD - 2.0, 1.0, COARSEST)
    (1.9073486328125e-06, -1.0)
    """
    inverse = 1.0 / scale
    place, turn, growth = along_lattice(whole, beyond, inverse), WHOLE_PERIOD * inverse, 1.0
    if turn < PERIOD:
        place -= turn * floor(place / turn)
        if place > turn - place:
            place, growth = turn - place, -1.0
    return place, growth


@kernel
def cloud_grain(place, footprint, cover, cell, whole, part, way, edge, whole_grain):
    """``CloudGrain`` of a place.

    Its skewness g, of the sum of octaves, is removed to first order (Cornish & Fisher 1938, Rev.
    Int. Stat. Inst. 5, 307): of x standard deviations, g (x² - 1)/6 are subtracted, and
    g²/18 of the variance.

    Parameters
    ----------
    cover : float
        Cover of the map there: few clouds are small ones. [1]
    way : Vec3
        Direction of the ascent, in the planet's frame. [1]
    edge : float
        ``CloudGrain.edge`` if known. [1]
    whole_grain : bool
        Whether edge and ascent are asked for; the edge remains otherwise.
    place, footprint, cell, whole, part :
        Arguments of ``ground_detail``.
    """
    beyond_x, beyond_y = part.x + place.x / cell, part.y + place.y / cell
    beyond_z = part.z + place.z / cell
    if whole_grain:
        scale = float(SOFTNESS)
        x, along_x = turning_place(whole.x, beyond_x, scale)
        y, along_y = turning_place(whole.y, beyond_y, scale)
        z, along_z = turning_place(whole.z, beyond_z, scale)
        edge = EDGE * exp(VARIED * gradient_noise(x, y, z))
    scale = float(COARSEST)
    warped = WARPED + WISPS * max(1.0 - edge / EDGE, 0.0)
    fall = FALL + FEWER * max(0.5 - cover, 0.0)
    fall *= min(max(sqrt(sqrt(edge / EDGE)), SMOOTHEST), ROUGHEST)
    total, variance, third, share = 0.0, 0.0, 0.0, 1.0
    ascent, smooth, coarse = 0.0, 1.0, SMALL + GROWING * cover
    for octave in range(OCTAVES):
        shown = share * min(0.5 * cell * scale / footprint - 1.0, 1.0)
        if octave >= GROUPS:
            shown *= min(coarse, 1.0)
            coarse *= 2.0
        if shown > 0.0:
            x, along_x = turning_place(whole.x, beyond_x, scale)
            y, along_y = turning_place(whole.y, beyond_y, scale)
            z, along_z = turning_place(whole.z, beyond_z, scale)
            moved, inverse = warped * total, 1.0 / (cell * scale)
            x, y, z, noise, growth = x + moved, y - moved, z + moved, 0.0, 0.0
            if whole_grain and octave >= GROUPS:
                along = Vec3(along_x * way.x, along_y * way.y, along_z * way.z)
                noise, growth = sloping_gradient_noise(x, y, z, along)
            else:
                noise = gradient_noise(x, y, z)
            folded, plain, skewness = PUFFED, OPEN, PUFFED_SKEWNESS
            if octave < GROUPS:
                folded, plain, skewness = GATHERED, SPREAD, GATHERED_SKEWNESS
            puffs = (abs(noise) - FOLDED) / FOLDED_DEVIATION
            total += shown * (folded * puffs + plain * noise / GRADIENT_DEVIATION)
            steep = folded / FOLDED_DEVIATION * (1.0 if noise > 0.0 else -1.0)
            steep += plain / GRADIENT_DEVIATION
            ascent += shown * smooth * growth * inverse * steep
            variance += shown * shown
            third += skewness * shown * shown * shown
        share *= fall
        if octave >= GROUPS:
            smooth *= SMOOTH
        scale *= 0.5
    if variance > 0.0:
        deviation = sqrt(variance)
        far = min(max(total / deviation, -FARTHEST), FARTHEST)
        skewed = third / (6.0 * variance * deviation)
        total -= skewed * deviation * (far * far - 1.0)
        variance *= 1.0 - 2.0 * skewed * skewed
    return CloudGrain(total, variance, edge, ascent)


@kernel
def veil_grain(place, footprint, cell, whole, part):
    """Noise of veils, which are drawn out along parallels, and its variance. [1]

    Parameters
    ----------
    place, footprint, cell, whole, part :
        Arguments of ``ground_detail``.
    """
    beyond_x, beyond_y = part.x + place.x / cell, part.y + place.y / cell
    beyond_z = part.z + place.z / cell
    total, variance, scale, share = 0.0, 0.0, float(COARSEST), 1.0
    along, turn = DRAWN * scale, 0.0
    for octave in range(VEILS):
        shown = share * min(0.5 * cell * scale / footprint - 1.0, 1.0)
        if shown > 0.0:
            bent = BENT * total
            x, _ = turning_place(whole.x, beyond_x, along)
            y, _ = turning_place(whole.y, beyond_y, along)
            z, _ = turning_place(whole.z, beyond_z, scale)
            total += shown * smooth_noise(x + bent, y - bent, z + bent + turn) / DEVIATION
            variance += shown * shown
            if octave == 0:
                turn = TURNED * total
        turn *= 2.0
        if octave - 3 * (octave // 3) == 0:
            along *= 0.5
        share *= THREADED
        scale *= 0.5
    return total, variance
