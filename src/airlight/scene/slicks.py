"""Procedural slicks and gusts on the sea, which texture the glint; they are not data.

Octaves of gradient noise, each half of the previous scale, change the logarithm of the
mean-square slope: folded noise to narrow slicks, which have fewer waves, plain noise to gusts. The
places of an octave are displaced by the coarser ones, which draws slicks out to eddies. The glint
keeps its mean over places of normal contrast.
"""

from __future__ import annotations

from math import exp, sqrt
from typing import Final

from airlight.geometry.gradient_noise import GRADIENT_DEVIATION, gradient_noise
from airlight.kernel import kernel
from airlight.scene.cloud_grain import FARTHEST, FOLDED, FOLDED_DEVIATION, turning_place
from airlight.scene.ground_detail import OCTAVES as GROUND_OCTAVES
from airlight.scene.ground_detail import STEP

#: Number of octaves, and cells of the coarsest one, sixteen texels, over the finest of
#: ``ground_detail``.
OCTAVES: Final = 8
COARSEST: Final = 16 * STEP ** (GROUND_OCTAVES - 1)
#: Shares of folded and of plain noise: the sum of their squares is 1.
SLICK: Final = 0.3
GUST: Final = 0.954
#: Skewness of an octave, as of ``cloud_grain``. [1]
SKEWNESS: Final = 1.009
#: Standard deviation of the logarithm of the mean-square slope by the coarsest octave, and ratio to
#: that of the next finer one, by eye; an oil slick has half of the slope or less (Cox & Munk 1954).
#: [1]
CONTRAST: Final = 0.24
FALL: Final = 0.85
#: Displacement of places by coarser octaves, over the width of a cell and their sum. [1]
WARPED: Final = 0.2
#: Square of the facet's slope over the mean-square slope from which on the glint is neglected. [1]
STEEPEST: Final = 12.0


@kernel
def slick_roughness(place, footprint, cell, whole, part):
    """Logarithm of the local mean-square slope over its mean, and its variance. [1]

    Without its skewness, which is removed as in ``cloud_grain``.

    Parameters
    ----------
    place, footprint, cell, whole, part :
        Arguments of ``ground_detail``.
    """
    x, y, z = part.x + place.x / cell, part.y + place.y / cell, part.z + place.z / cell
    total, variance, third, scale, share = 0.0, 0.0, 0.0, float(COARSEST), CONTRAST
    for _octave in range(OCTAVES):
        shown = min(0.5 * cell * scale / footprint - 1.0, 1.0)
        if shown > 0.0:
            moved = WARPED * total / CONTRAST
            at_x, _ = turning_place(whole.x, x, scale)
            at_y, _ = turning_place(whole.y, y, scale)
            at_z, _ = turning_place(whole.z, z, scale)
            noise = gradient_noise(at_x + moved, at_y - moved, at_z + moved)
            folded = (abs(noise) - FOLDED) / FOLDED_DEVIATION
            shown *= share
            total += shown * (SLICK * folded + GUST * noise / GRADIENT_DEVIATION)
            variance += shown * shown
            third += SKEWNESS * shown * shown * shown
        scale *= 0.5
        share *= FALL
    if variance > 0.0:
        square = min(total * total / variance, FARTHEST * FARTHEST)
        total -= third / (6.0 * variance) * (square - 1.0)
        variance -= third * third / (18.0 * variance * variance)
    return total, variance


@kernel
def slick_glint(steep, rougher, variance):
    """Glint of a place over that of the mean mean-square slope. [1]

    exp(-a (e^-g - 1) - g) over its mean for normal g, by Gauss-Hermite quadrature of three points:
    the density of slopes of ``cox_munk.glint_factor`` with the mean-square slope e^g s².

    Parameters
    ----------
    steep : float
        Square of the facet's slope over the mean-square slope, a. [1]
    rougher, variance : float
        Results of ``slick_roughness``, g and v. [1]

    Examples
    --------
    >>> slick_glint(2.0, 0.0, 0.0)
    1.0
    >>> round(slick_glint(0.0, 0.1, 0.0), 4)  # e^-0.1: broader, thus weaker in its centre
    0.9048
    """
    a = min(steep, STEEPEST)
    far = sqrt(3.0 * variance)
    calm, rough = -a * (exp(far) - 1.0) + far, -a * (exp(-far) - 1.0) - far
    mean = (4.0 + exp(calm) + exp(rough)) / 6.0
    return exp(min(-a * (exp(-rougher) - 1.0) - rougher, 5.0)) / mean
