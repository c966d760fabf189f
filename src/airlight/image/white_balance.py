"""White balance: chromatic adaptation from the light of a scene to the display's white.

A camera does not show colours relative to a fixed white: its ``daylight`` shows a grey card in the
sun as grey. The adopted white is scaled to the display's, D65, in the cone space of Bradford.
"""

from __future__ import annotations

from math import log2
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import ParameterError
from airlight.image.floating import BRIGHTEST, each_pixel
from airlight.image.gamut import WHITE, signed_light
from airlight.image.spectral import Irradiance, sun_color
from airlight.image.xyz import RGB_TO_XYZ, chromaticity, luminance_of, rgb_to_xyz
from airlight.kernel import compiled_loop, inlined, kernel
from airlight.physics.units import quantity

#: Chromaticity x, y of a light.
White = tuple[float, float]

#: Names of the adopted white. ``auto`` is ``daylight`` under a star like the sun, ``d65`` in its
#: dusk and warm in a dark night, ``star`` under others, and ``d65`` where no star is known;
#: ``kelvin`` is that of a given temperature.
WHITE_BALANCES: Final = ("auto", "daylight", "star", "scene", "d65", "kelvin")
#: Colour temperature of photographic daylight. [K; ISO 7589:2002, daylight: 5500 K]
DAYLIGHT: Final = 5500.0
#: Range of the temperature of a white. [K]
COLDEST: Final = 2000.0
HOTTEST: Final = 25000.0
#: Range of the temperature that ``scene`` adopts: beyond, dusk stays blue and a sunset red, as for
#: a camera's automatic white balance. [K]
SCENE_COLDEST: Final = 3500.0
SCENE_HOTTEST: Final = 8000.0
#: Range of temperatures of a star like the sun, the spectral types G and late F. [K]
_LEAST_SUN: Final = 5200.0
_MOST_SUN: Final = 6500.0
#: Exposures between which ``auto`` passes from the sun's light to that of dusk, which comes from
#: the sky and is bluer, and by night, of moonlight and lamps, back. [EV]
_DAY, _DUSK, _DARK, _NIGHT = -2.5, 0.5, 5.0, 7.0
#: Exposures between which ``auto`` passes to the white of a night without a moon, and its
#: chromaticity: between a black body of 3700 K, by which such exposures are balanced, and airglow
#: with starlight, x = 0.41, y = 0.42, whose green photographers take away by tint. [EV], [1]
_MOONLESS, _LONGEST = 13.0, 14.5
NIGHT_X, NIGHT_Y = 0.404, 0.408
#: Displayed light at which a pixel has half its weight in the mean of ``scene``. [1]
_HALF: Final = 0.18
#: Smallest cone response of a white relative to its luminance, which limits the gain of blue under
#: stars below about 2000 K. [1]
_LEAST_CONE: Final = 0.1

#: What may be given as a white balance.
_ALLOWED: Final = f"{', '.join(WHITE_BALANCES[:-1])}, or {COLDEST:g} to {HOTTEST:g} K"

#: XYZ to the sharpened cone responses of Bradford. [Lam 1985; ICC.1:2010, annex E]
XYZ_TO_CONES: Final[NDArray[np.float64]] = np.array(
    [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]]
)
_RGB_TO_CONES: Final = XYZ_TO_CONES @ RGB_TO_XYZ
_CONES_TO_RGB: Final = np.linalg.inv(_RGB_TO_CONES)

# The same numbers as arguments of the kernels.
_X, _Y = WHITE
(_LX, _LY, _LZ), (_MX, _MY, _MZ), (_SX, _SY, _SZ) = XYZ_TO_CONES.tolist()
(_LR, _LG, _LB), (_MR, _MG, _MB), (_SR, _SG, _SB) = _RGB_TO_CONES.tolist()
(_RL, _RM, _RS), (_GL, _GM, _GS), (_BL, _BM, _BS) = _CONES_TO_RGB.tolist()
#: Cone responses of the display's white, of luminance 1.
_WHITE_L, _WHITE_M, _WHITE_S = _RGB_TO_CONES.sum(axis=1).tolist()


@kernel
def black_body_x(temperature):
    """CIE 1931 x of a black body, 1667 to 25 000 K: cubic in the reciprocal temperature. [1]

    Within 6e-4 of the integral of Planck's law.

    References
    ----------
    Kang, Moon, Hong, Lee, Cho & Kim (2002), "Design of advanced color temperature control system
    for HDTV applications", J. Korean Phys. Soc. 41, 865.
    """
    t = 1e3 / temperature
    if temperature <= 4000.0:
        return ((-0.2661239 * t - 0.2343589) * t + 0.8776956) * t + 0.179910
    return ((-3.0258469 * t + 2.1070379) * t + 0.2226347) * t + 0.240390


@kernel
def black_body_y(temperature):
    """CIE 1931 y of a black body: cubic in x, see ``black_body_x``. [1]"""
    x = black_body_x(temperature)
    if temperature <= 2222.0:
        return ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683
    if temperature <= 4000.0:
        return ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
    return ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483


@kernel
def mccamy_temperature(x, y):
    """Correlated colour temperature of a chromaticity near the black bodies, 2000 to 12 500 K. [K]

    References
    ----------
    McCamy (1992), Color Res. Appl. 17, 142: n³ times 449, n² 3525, n 6823.3, and 5520.33.
    """
    n = (x - 0.3320) / (0.1858 - y)
    return ((449.0 * n + 3525.0) * n + 6823.3) * n + 5520.33


@kernel
def dusk_share(factor):
    """Share of the light of dusk in the white of ``auto``, by the factor of the exposure. [1]"""
    stops = log2(factor)
    evening = (stops - _DAY) / (_DUSK - _DAY)
    night = (_NIGHT - stops) / (_NIGHT - _DARK)
    return max(min(min(evening, night), 1.0), 0.0)


@kernel
def warm_share(factor):
    """Share of the white of a dark night in that of ``auto``, by the exposure's factor. [1]"""
    return max(min((log2(factor) - _MOONLESS) / (_LONGEST - _MOONLESS), 1.0), 0.0)


@kernel
def white_gains(which, temperature, star_x, star_y, scene_x, scene_y, factor):
    """Gains of the three cone responses that make an adopted white the display's. [1]

    Parameters
    ----------
    which : int
        Index in ``WHITE_BALANCES``.
    temperature : float
        Temperature of ``kelvin``, 2000 to 25 000. [K]
    star_x, star_y : float
        Chromaticity of the star's light outside the air; 0 if there is none. [1]
    scene_x, scene_y : float
        Chromaticity of the scene's mean light, see ``scene_weight``; 0 if there is none. [1]
    factor : float
        Factor of the exposure. [1]

    Returns
    -------
    long, medium, short : float
        Gains, all 1 for the display's own white. [1]
    """
    x, y = star_x, star_y
    if which == 0 and star_y > 0.0:
        hot = mccamy_temperature(star_x, star_y)
        if _LEAST_SUN < hot < _MOST_SUN:
            dusk, warm = dusk_share(factor), warm_share(factor)
            x = black_body_x(DAYLIGHT) + dusk * (_X - black_body_x(DAYLIGHT))
            y = black_body_y(DAYLIGHT) + dusk * (_Y - black_body_y(DAYLIGHT))
            x += warm * (NIGHT_X - x)
            y += warm * (NIGHT_Y - y)
    if which == 1:
        x, y = black_body_x(DAYLIGHT), black_body_y(DAYLIGHT)
    if which == 3:
        x, y = scene_x, scene_y
        if scene_y > 0.0:
            hot = min(max(mccamy_temperature(scene_x, scene_y), SCENE_COLDEST), SCENE_HOTTEST)
            # A colour beyond the formula's range is bluer than all black bodies.
            if scene_y < 0.1858:
                hot = SCENE_HOTTEST
            x, y = black_body_x(hot), black_body_y(hot)
    if which == 5:
        x, y = black_body_x(temperature), black_body_y(temperature)
    if which == 4 or not y > 0.0:
        return 1.0, 1.0, 1.0
    large, small = x / y, (1.0 - x - y) / y
    return (
        _WHITE_L / max(_LX * large + _LY + _LZ * small, _LEAST_CONE),
        _WHITE_M / max(_MX * large + _MY + _MZ * small, _LEAST_CONE),
        _WHITE_S / max(_SX * large + _SY + _SZ * small, _LEAST_CONE),
    )


@inlined
def white_balanced(red, green, blue, long, medium, short):
    """Scalar form of ``adapt``: colour of which the three cone responses have gains."""
    if long == 1.0 and medium == 1.0 and short == 1.0:
        return red, green, blue
    # Infinite light has no cone responses.
    r, g, b = signed_light(red), signed_light(green), signed_light(blue)
    more_long = (long - 1.0) * (_LR * r + _LG * g + _LB * b)
    more_medium = (medium - 1.0) * (_MR * r + _MG * g + _MB * b)
    more_short = (short - 1.0) * (_SR * r + _SG * g + _SB * b)
    return (
        r + (_RL * more_long + _RM * more_medium + _RS * more_short),
        g + (_GL * more_long + _GM * more_medium + _GS * more_short),
        b + (_BL * more_long + _BM * more_medium + _BS * more_short),
    )


@compiled_loop
def adapted_pixels(colors, out, long, medium, short):
    """``white_balanced`` of all colours."""
    for i in range(colors.shape[0]):
        out[i, 0], out[i, 1], out[i, 2] = white_balanced(
            np.float64(colors[i, 0]), np.float64(colors[i, 1]), np.float64(colors[i, 2]),
            long, medium, short,
        )  # fmt: skip


def adapt(rgb: ArrayLike, gains: tuple[float, float, float]) -> NDArray[Any]:
    r"""Colours adapted from an adopted white to the display's, by linear Bradford.

    .. math:: c' = M^{-1} \operatorname{diag}(g)\,M\,c, \quad g = \frac{M c_{65}}{M c_w}

    Parameters
    ----------
    rgb : array, shape (..., 3)
        Linear sRGB in any unit; channels may be negative.
    gains : (float, float, float)
        Gains of the cone responses, from ``white_gains``; their reciprocals undo the adaptation.

    Returns
    -------
    array, shape (..., 3)
        Linear sRGB, same unit and floating type.

    References
    ----------
    Lam (1985), "Metamerism and colour constancy", University of Bradford; without its exponent of
    blue, as in ICC.1:2010, annex E.

    Examples
    --------
    >>> from airlight.image.xyz import xyz_to_rgb
    >>> warm = xyz_to_rgb([1.09850, 1.0, 0.35585])  # illuminant A
    >>> adapt(warm, white_gains(2, 0.0, 0.44757, 0.40745, 0.0, 0.0, 1.0)).round(3)
    array([1., 1., 1.])
    """
    return each_pixel(adapted_pixels, rgb, *gains)


def star_white(spectrum: Irradiance | None) -> White:
    """Chromaticity of a star's light outside the air.

    Parameters
    ----------
    spectrum : callable, array or None
        As for ``sun_color``; None is the sun.

    Examples
    --------
    >>> x, y = star_white(None)
    >>> f"{x:.4f} {y:.4f}"
    '0.3234 0.3327'
    """
    x, y = chromaticity(rgb_to_xyz(sun_color(spectrum))).tolist()
    return x, y


@kernel
def scene_weight(red, green, blue, factor):
    r"""Weight of a pixel in the scene's mean light: its share of the displayed colours.

    .. math:: w = \frac{1}{Y f + 0.18}

    with the luminance Y and the factor f of the exposure, so that a sun's disc counts like a few
    grey pixels and black space not at all. 0 for light that is not finite.

    References
    ----------
    Buchsbaum (1980), J. Franklin Inst. 310, 1, on the assumption that the mean is grey.
    """
    bright = luminance_of(red, green, blue)
    return 1.0 / (max(bright, 0.0) * factor + _HALF) if abs(bright) < BRIGHTEST else 0.0


@compiled_loop
def scene_sum(colors, factor, out):
    """Sum of colours by ``scene_weight``, added to ``out``."""
    for i in range(colors.shape[0]):
        red, green, blue = colors[i, 0], colors[i, 1], colors[i, 2]
        weight = scene_weight(np.float64(red), np.float64(green), np.float64(blue), factor)
        if weight > 0.0:
            out[0] += weight * red
            out[1] += weight * green
            out[2] += weight * blue


def scene_white(rgb: NDArray[np.floating[Any]], factor: float) -> White:
    """Chromaticity of a scene's mean light; (0, 0) if there is none.

    Parameters
    ----------
    rgb : array, shape (..., 3)
        Linear sRGB. [W m⁻² sr⁻¹]
    factor : float
        Factor of the exposure. [1]

    Examples
    --------
    >>> grey = np.ones((2, 2, 3))
    >>> x, y = scene_white(grey, 0.2)
    >>> f"{x:.4f} {y:.4f}"
    '0.3127 0.3290'
    """
    total = np.zeros(3)
    scene_sum(rgb.reshape(-1, 3), factor, total)
    xyz = rgb_to_xyz(total)
    if not xyz[1] > 0.0:
        return 0.0, 0.0
    x, y = chromaticity(xyz).tolist()
    return x, y


def white_temperature(value: str | float) -> float:
    """Temperature of an adopted white, from a number or a text such as ``5200 K``. [K]

    Raises
    ------
    ParameterError
        If it is not 2000 to 25 000 K; the message lists the names as well.
    """
    try:
        return check_temperature(quantity(value, "K", "white_balance", bare=True))
    except ParameterError:
        raise ParameterError("white_balance", value, _ALLOWED) from None


def check_temperature(kelvin: float) -> float:
    """Validated temperature of an adopted white, 2000 to 25 000. [K]"""
    if not COLDEST <= kelvin <= HOTTEST:
        raise ParameterError("white_temperature", kelvin, f"{COLDEST:g} to {HOTTEST:g} K")
    return float(kelvin)
