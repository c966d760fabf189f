"""Exposure: factor from radiance to display, explicit, by camera settings, or metered."""

from __future__ import annotations

import math
from math import log2
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.image.glare import COARSEST, FINEST, TOTAL
from airlight.image.xyz import luminance
from airlight.kernel import compiled_loop, inlined, kernel
from airlight.kernel.large_arrays import release
from airlight.physics.constants import LUMINOUS_EFFICACY

#: Default exposure for the sunlit Earth, if none is measured. [EV]
DEFAULT_EXPOSURE: Final = -4.0
#: Largest magnitude of an exposure. [EV]
MOST_EXPOSURE: Final = 100.0

#: Displayed level of the key of a sunlit picture, largest level of its bright quarter at the
#: quarter's lower end, and of its highlights. [1]
_KEY: Final = 0.35
_BRIGHT: Final = 0.55
_HIGHLIGHT: Final = 1.5
#: Fractions of the picture below the bright quarter and below the highlights, and fraction of its
#: darkest part, which the key ignores.
_QUARTER: Final = 0.75
_BRIGHT_SHARE: Final = 0.98
_SHADE: Final = 0.25
#: Pixels darker than this fraction of the bright end are ignored, such as black space.
_DARK: Final = 1e-4
#: Luminance below which the exposure follows the eye's dark adaptation: that of a sky half an hour
#: after sunset, which should look like dusk. [cd m⁻²]
_PHOTOPIC: Final = 30.0
#: Factor of the key where most of the picture is black space, and exponent of the fraction that is
#: not: as photographers expose a planet, a mostly dark picture with bright parts. [1]
_LOW_KEY: Final = 0.6
_LIT: Final = 1.0 / 3.0
#: Exponent of brightness as a function of luminance. [Stevens & Stevens 1963]
_BRIGHTNESS: Final = 1.0 / 3.0
#: Fraction of the picture that the glare of a star may fill with the level ``_HIGHLIGHT``. [1]
_GLOW: Final = 0.04
#: Largest further reduction of the exposure if this makes the surroundings darker. [EV]
_SUBJECT: Final = 8.0
#: Displayed level of the brightest part of a disc that is the subject. [1]
_DISC: Final = 0.8
#: Radiance that glare spreads at an angle, times its square, per irradiance, see ``glare``. [1]
_SPREAD: Final = TOTAL / (2.0 * math.pi * math.log(COARSEST / FINEST))
#: Luminance of a moonless, starless night; darker pictures are not brightened further. [cd m⁻²]
_NIGHT: Final = 1e-4
#: Displayed level of the key of a long exposure by night, and luminance below which it falls, as
#: exposures are not longer. [1, cd m⁻²]
_LONG_EXPOSURE: Final = 0.055
_LONGEST: Final = 1e-3
#: Approximate number of pixels sampled, every k-th row and column.
SAMPLE: Final = 32_768
#: Rows that are sampled before the memory of a large picture is released.
_ROWS: Final = 8
#: Exposure at which a sensor of ISO 1 saturates [lx s], and the light that passes a lens.
_SATURATION: Final = 78.0
_LENS: Final = 0.65


def exposure_factor(exposure: float) -> float:
    """Exposure factor of radiance: 2^EV.

    Parameters
    ----------
    exposure : float
        Exposure, -100 to 100. [EV]

    Returns
    -------
    float
        Factor. [1]

    Raises
    ------
    ParameterError
        If it is outside that range, or not a number.

    Examples
    --------
    >>> exposure_factor(-2.0)
    0.25
    """
    limits = -MOST_EXPOSURE <= exposure <= MOST_EXPOSURE if _is_number(exposure) else False
    if not limits:
        raise ParameterError("exposure", exposure, '-100 to 100 EV, or "auto"')
    return math.pow(2.0, float(exposure))


def _is_number(value: object) -> bool:
    return isinstance(value, (int, float, np.number))


def camera_exposure(iso: float, aperture: float, shutter: float) -> float:
    r"""Saturation-based exposure of a camera: sensor saturation is 1.

    .. math:: L_\mathrm{sat} = \frac{78}{S} \frac{N^2}{q\,t}, \quad q = 0.65

    Parameters
    ----------
    iso : float
        Sensitivity S. [ISO]
    aperture : float
        Focal length over the diameter of the lens, N. [1]
    shutter : float
        Exposure time t. [s]

    Returns
    -------
    float
        Exposure, within ±100. [EV]

    Raises
    ------
    ParameterError
        If a number is not above 0.

    References
    ----------
    ISO 12232:2019, saturation-based speed, with q for a lens transmittance of 0.9.

    Examples
    --------
    >>> f"{camera_exposure(iso=100.0, aperture=16.0, shutter=1 / 100):.2f}"  # "sunny 16"
    '-5.49'
    """
    for name, value in (("iso", iso), ("aperture", aperture), ("shutter", shutter)):
        if not (_is_number(value) and 0.0 < value < math.inf):
            raise ParameterError(name, value, "above 0, finite")
    saturating = _SATURATION / iso * aperture**2 / (_LENS * shutter)
    return min(max(log2(LUMINOUS_EFFICACY / saturating), -MOST_EXPOSURE), MOST_EXPOSURE)


@inlined
def weighted_index(weight, first, share):
    """Index at which the cumulative weight from ``first`` on reaches a fraction of the total."""
    total = 0.0
    for i in range(first, weight.size):
        total += weight[i]
    reached = 0.0
    for i in range(first, weight.size):
        reached += weight[i]
        if reached >= share * total:
            return i
    return weight.size - 1


@kernel
def adapted_key(bright):
    """Displayed value of a picture's key, for the state of adaptation of the eye. [1]

    Parameters
    ----------
    bright : float
        Luminance of the key. [cd m⁻²]
    """
    return _KEY / (1.0 + _PHOTOPIC / max(bright, _NIGHT)) ** _BRIGHTNESS


@kernel
def shown_key(bright):
    """Displayed value of a picture's key: to the adapted eye, or by a long exposure at night. [1]

    Parameters
    ----------
    bright : float
        Luminance of the key. [cd m⁻²]
    """
    long = _LONG_EXPOSURE * min(max(bright, _NIGHT) / _LONGEST, 1.0)
    return max(adapted_key(bright), long)


@kernel
def seen_share(exposure):
    """Brightness to the adapted eye over that in a picture, at the key of an exposure. [1]

    Parameters
    ----------
    exposure : float
        Factor of the exposure, above 0. [1]
    """
    bright = max(_LONG_EXPOSURE * LUMINOUS_EFFICACY / exposure, _LONGEST)
    return min(adapted_key(bright) / shown_key(bright), 1.0)


@compiled_loop
def exposure_of(bright, weight, black):
    """Exposure of a picture, see ``automatic_exposure``. [EV]

    Parameters
    ----------
    bright : array, shape (n,)
        Luminances above 0, ascending, not empty. [W m⁻² sr⁻¹]
    weight : array, shape (n,)
        Weights of these pixels. [1]
    black : float
        Weight of black pixels. [1]
    """
    first = 0
    dark = _DARK * bright[weighted_index(weight, first, 0.99)]
    while bright[first] < dark:
        first += 1
    quarter = bright[weighted_index(weight, first, _QUARTER)]
    high = bright[weighted_index(weight, first, _BRIGHT_SHARE)]
    total, count = 0.0, 0.0
    for i in range(weighted_index(weight, first, _SHADE), bright.size):
        total += weight[i] * log2(bright[i])
        count += weight[i]
    key = 2.0 ** (total / max(count, 1e-300))
    lit, whole = 0.0, black
    for i in range(bright.size):
        whole += weight[i]
        if i >= first:
            lit += weight[i]
    shown = shown_key(LUMINOUS_EFFICACY * key)
    # lamps may be as bright in a long exposure as they are above the rest of it
    longer = shown / adapted_key(LUMINOUS_EFFICACY * key)
    dimmed = max((lit / max(whole, 1e-300)) ** _LIT, _LOW_KEY)
    factor = dimmed * shown / max(key, _NIGHT / LUMINOUS_EFFICACY)
    factor = min(factor, longer * shown / _KEY * min(_BRIGHT / quarter, _HIGHLIGHT / high))
    return min(max(log2(factor), -MOST_EXPOSURE), MOST_EXPOSURE)


@kernel
def star_limited(exposure, brightest, irradiance, picture):
    r"""Exposure of a picture with a star in view. [EV]

    The star's glare, a E / θ², may have 1.5 times white on a 25th of the picture,

    .. math:: 2^\mathrm{EV} \le \frac{1.5 \cdot 0.04\, Ω}{π a E}.

    If that darkens the surroundings by n stops, the star becomes the subject: n more stops are
    subtracted, at most eight, until its disc is 0.8 of white.

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
    glow = log2(_HIGHLIGHT * _GLOW * picture / (math.pi * _SPREAD * irradiance))
    lost = exposure - glow
    if lost <= 0.0:
        return exposure
    return min(glow, max(glow - min(lost, _SUBJECT), log2(_DISC / brightest)))


@compiled_loop
def exposure_with_stars(bright, weight, near, light, lights, black, picture):
    """Exposure of a picture with stars in view. [EV]

    Pixels away from stars are metered by ``exposure_of``, limited by each star (``star_limited``).
    If these are black, as in space, the limit is the exposure; if there are none, as in a
    telescope, all pixels are metered.

    Parameters
    ----------
    bright : array, shape (n,)
        Luminances above 0, ascending, one at least. [W m⁻² sr⁻¹]
    weight, near : array, shape (n,)
        Solid angles of the pixels away from and near stars; the other one is 0. [sr]
    light : array, shape (n,)
        Index of the star near each pixel. [1]
    black : float
        Solid angle of black pixels away from stars. [sr]
    picture : float
        Solid angle of the picture. [sr]
    """
    away, around = 0.0, 0.0
    for i in range(bright.size):
        away += weight[i]
        around += near[i]
    exposure = MOST_EXPOSURE
    if away > 0.0:
        exposure = exposure_of(bright, weight, black)
    elif black <= 0.0 or around <= 0.0:
        exposure = max(exposure_of(bright, near, 0.0), log2(_DISC / bright[bright.size - 1]))
    limit = exposure
    for k in range(lights):
        brightest, irradiance = 0.0, 0.0
        for i in range(bright.size):
            if near[i] > 0.0 and abs(light[i] - k) < 0.5:
                brightest = bright[i]
                irradiance += near[i] * bright[i]
        if irradiance > 0.0:
            limit = min(limit, star_limited(exposure, brightest, irradiance, picture))
    return min(max(limit, -MOST_EXPOSURE), MOST_EXPOSURE)


def sampling_step(height: int, width: int) -> int:
    """Step between metered rows and columns of a picture. [pixel]"""
    return max(1, math.isqrt(height * width // SAMPLE))


def sampled(rgb: NDArray[np.floating], step: int) -> NDArray[np.float64]:
    """Subsampled picture.

    Parameters
    ----------
    rgb : array, shape (height, width, 3)
        Picture.
    step : int
        Step between rows and columns. [pixel]

    Returns
    -------
    array, shape (ceil(height / step), ceil(width / step), 3)
        Copy.
    """
    rows = rgb[::step, ::step]
    out = np.empty(rows.shape)
    for number, row in enumerate(rows):
        out[number] = row
        if number % _ROWS == 0:  # a row of a large picture brings its neighbours into memory
            release(rgb)
    return out


def automatic_exposure(
    rgb: NDArray[np.floating], weights: NDArray[np.floating] | None = None
) -> float:
    r"""Automatic exposure of a picture, for a simulated state of adaptation.

    Pixels below 1e-4 of the highlights are excluded, so that black space does not overexpose the
    planet. With the key :math:`\bar L`, the geometric mean of the brightest three quarters, and the
    75 and 98 % quantiles :math:`L_{75}` and :math:`L_{98}` of luminance,

    .. math:: 2^\mathrm{EV} = a(\bar L)\,\min\left(
              \frac{0.35\,d}{\bar L}, \frac{0.55}{L_{75}}, \frac{1.5}{L_{98}}\right),
              \quad a(L) = \left(1 + \frac{30\ \mathrm{cd\,m^{-2}}}
              {\max(L, 10^{-4}\ \mathrm{cd\,m^{-2}})}\right)^{-1/3}

    where :math:`\bar L` is at least 1e-4 cd m⁻², and :math:`d` is the cube root of the fraction of
    the picture that is not black space, at least 0.6. By day a is 1, independent of the light
    level; in the dark the picture darkens with the cube root of luminance.

    Parameters
    ----------
    rgb : array, shape (height, width, 3)
        Linear sRGB; of a large picture some 30 000 pixels on a regular grid are used.
        [W m⁻² sr⁻¹]
    weights : array, shape (height, width), optional
        Weights of the pixels, such as solid angles; default: equal.

    Returns
    -------
    float
        Exposure, -100 to 100; the night's for a black picture. [EV]

    References
    ----------
    Reinhard et al. (2002), ACM Trans. Graph. 21, 267, on the key; Krawczyk, Myszkowski & Seidel
    (2005), SCCG, 195, on keys that depend on luminance; Stevens & Stevens (1963), J. Opt. Soc. Am.
    53, 375, on the cube root. The constants are airlight's.

    Examples
    --------
    >>> grey = np.full((2, 2, 3), 10.0)
    >>> f"{automatic_exposure(0.5 * grey) - automatic_exposure(grey):.2f}"  # half the light
    '1.00'
    """
    height, width = rgb.shape[:2]
    step = sampling_step(height, width)
    bright = luminance(sampled(rgb, step)).ravel()
    weight = np.ones(bright.size) if weights is None else weights[::step, ::step].ravel()
    counted = np.isfinite(bright) & (bright > 0.0) & (weight > 0.0)
    black = float(weight[np.isfinite(bright) & ~counted].sum())
    bright, weight = bright[counted], np.asarray(weight[counted], dtype=np.float64)
    if bright.size == 0:
        return night_exposure()
    order = np.argsort(bright)
    return float(exposure_of(bright[order], weight[order], black))


def night_exposure() -> float:
    """Exposure of a picture without any light: that of a night without moon or stars. [EV]"""
    return float(exposure_of(np.full(1, _NIGHT / LUMINOUS_EFFICACY), np.ones(1), 0.0))


@kernel
def eased(before, wanted, seconds, time_constant):
    """Exposure with exponential adaptation e^{-t/τ} towards another. [EV]

    Parameters
    ----------
    before, wanted : float
        Initial and final exposure. [EV]
    seconds : float
        Elapsed time. [s]
    time_constant : float
        Time constant τ; 0 for no delay. [s]
    """
    if time_constant <= 0.0:
        return wanted
    return wanted + (before - wanted) * math.exp(-seconds / time_constant)
