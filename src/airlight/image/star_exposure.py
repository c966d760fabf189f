"""Exposure of pictures with stars in view: their glare, and their discs as the subject."""

from __future__ import annotations

import math
from math import log2
from typing import Final

from airlight.image.exposure import MOST_EXPOSURE, exposure_of, unlit_exposure
from airlight.image.glare import COARSEST, FINEST, TOTAL
from airlight.kernel import compiled_loop, kernel

#: Displayed level that the glare of a star may have on a fraction of the picture. [1]
_GLARING: Final = 1.5
_GLOW: Final = 0.04
#: Darkening of a star's surroundings from which on the star is the subject. [EV]
_SURROUNDINGS: Final = 2.0
#: Shares of the picture of a disc that begins to be the subject, as the sun in a field of view of
#: 20°, and that is it alone, as in one of 4°. [1]
_SMALL, _LARGE = 1.0 / 1200.0, 1.0 / 60.0
#: Displayed level of the brightest part of a disc that is the subject, on a black sky. [1]
_DISC: Final = 0.8
#: Least contrast of a disc that is not one with its sky. [1]
_CONTRAST: Final = 1e-3
#: Radiance that glare spreads at an angle, times its square, per irradiance, see ``glare``. [1]
_SPREAD: Final = TOTAL / (2.0 * math.pi * math.log(COARSEST / FINEST))


@kernel
def star_limited(exposure, brightest, irradiance, picture):
    r"""Exposure of a picture with a star in view. [EV]

    The star's glare, a E / θ², may have 1.5 times white on a 25th of the picture,

    .. math:: 2^\mathrm{EV} \le \frac{1.5 \cdot 0.04\, Ω}{π a E}.

    If that darkens the surroundings by two stops, the star becomes the subject: the exposure passes
    to that which shows its disc as 0.8 of white while the disc grows from 1/1200 to 1/60 of the
    picture, as photographers stop down until they see its edge, and then its limb darkening.

    Parameters
    ----------
    exposure : float
        Exposure for the pixels away from the star. [EV]
    brightest : float
        Largest luminance near the star. [W m⁻² sr⁻¹]
    irradiance : float
        Irradiance E of the star and its surroundings, above 0. [W m⁻²]
    picture : float
        Solid angle Ω of the picture. [sr]

    Examples
    --------
    >>> f"{2.0 ** star_limited(100.0, 2e6, 136.0, 1e-4) * 2e6:.2f}"  # the sun through a telescope
    '0.80'
    """
    glow = log2(_GLARING * _GLOW * picture / (math.pi * _SPREAD * irradiance))
    lost = exposure - glow
    if lost <= 0.0:
        return exposure
    share = irradiance / (brightest * picture)
    part = min(max(log2(share / _SMALL) / log2(_LARGE / _SMALL), 0.0), 1.0)
    part *= min(lost / _SURROUNDINGS, 1.0)
    return glow + part * min(log2(_DISC / brightest) - glow, 0.0)


@compiled_loop
def exposure_with_stars(bright, weight, near, light, cool, lights, black, picture, white):
    """Exposure of a picture with stars in view. [EV]

    Pixels away from stars are metered by ``exposure_of``, limited by each star (``star_limited``).
    If these are black, as in space, the star is the subject, beside bodies which space may hold; if
    there are none, as in a telescope, all pixels are metered, and the brightest is at least 0.8
    times its contrast to the darkest: a crescent leaves the sky of dusk its own exposure.

    Parameters
    ----------
    bright : array, shape (n,)
        Light of the pixels above 0, ascending, one at least. [W m⁻² sr⁻¹]
    weight, near : array, shape (n,)
        Solid angles of the pixels away from and near stars; the other one is 0. [sr]
    light : array, shape (n,)
        Index of the star near each pixel. [1]
    cool : array, shape (n,)
        Argument of ``exposure_of``. [1]
    black : float
        Solid angle of black pixels away from stars. [sr]
    picture : float
        Solid angle of the picture. [sr]
    white : float
        Argument of ``exposure_of``. [W m⁻² sr⁻¹]
    """
    away, around = 0.0, 0.0
    for i in range(bright.size):
        away += weight[i]
        around += near[i]
    exposure = MOST_EXPOSURE
    if away > 0.0:
        exposure = exposure_of(bright, weight, cool, black, white)
    elif black <= 0.0 or around <= 0.0:
        most = bright[bright.size - 1]
        contrast = max(1.0 - bright[0] / most, _CONTRAST)
        exposure = max(exposure_of(bright, near, cool, 0.0, 0.0), log2(_DISC * contrast / most))
    elif white > 0.0:
        exposure = unlit_exposure(white)
    limit = exposure
    if away <= 0.0 and white > 0.0:
        exposure += _SURROUNDINGS
    for k in range(lights):
        brightest, irradiance = 0.0, 0.0
        for i in range(bright.size):
            if near[i] > 0.0 and abs(light[i] - k) < 0.5:
                brightest = bright[i]
                irradiance += near[i] * bright[i]
        if irradiance > 0.0:
            limit = min(limit, star_limited(exposure, brightest, irradiance, picture))
    return min(max(limit, -MOST_EXPOSURE), MOST_EXPOSURE)
