"""Colour from few wavelengths: their choice, and a matrix to linear sRGB fitted to a star."""

from __future__ import annotations

from functools import cache
from itertools import product
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import ParameterError
from airlight.image.spectral import (
    EYE,
    Irradiance,
    checked_wavelengths,
    eye_rgb,
    irradiance_at,
    on_eye_grid,
    rgb_weights,
    sun_color,
)
from airlight.image.xyz import RGB_TO_XYZ
from airlight.physics.constants import DOBSON_UNIT
from airlight.physics.spectra.ozone import ozone_cross_section
from airlight.physics.units import values_in

FloatArray = NDArray[np.float64]

#: Wavelengths of pictures with few wavelengths, by their number. [nm]
CHOSEN: Final = {3: (450.0, 550.0, 620.0), 4: (440.0, 500.0, 560.0, 620.0)}
#: Four wavelengths where methane absorbs, whose band is at 620 nm: the best multiples of 10 nm for
#: the discs of the giant planets (Karkoschka 1998), ΔE 1 or less; ``CHOSEN`` err by up to 25. [nm]
BESIDE_METHANE: Final = (450.0, 500.0, 570.0, 650.0)
#: Numbers of wavelengths that can be fitted: one has no freedom, many are for ``rgb_weights``.
_FEWEST: Final = 2
_MOST: Final = 8
#: Powers n of λ⁻ⁿ of the initial light: gas; fine, coarse and grey haze or ground; red ground.
_SOURCES: Final = (4.0, 2.0, 1.0, 0.0, -1.0)
#: Optical depths at 550 nm removed by scattering by gas; 0.097 is Earth's zenith.
_GAS: Final = (0.0, 0.1, 0.3, 0.8, 2.0, 4.0)
#: Optical depths at 550 nm removed by haze, which goes with λ^-1.3.
_HAZE: Final = (0.0, 0.5)
#: Layers of 300 Dobson units passed: 1 at noon, some tens at dusk.
_OZONE: Final = (0.0, 3.0, 10.0, 30.0)
#: Logistic edges of blue absorbers (iron oxides, tholins, sulphur): middle, width, depth.
_EDGES: Final = (450.0, 480.0, 510.0, 540.0, 570.0)
_WIDTHS: Final = (15.0, 30.0, 45.0)
_DEPTHS: Final = (0.3, 1.0, 2.0, 4.0)
#: Powers of the initial light of such spectra.
_COLORED_SOURCES: Final = (0.0, 2.0, -1.0)
#: XYZ of D65, and the luminance to which each spectrum is exposed before the comparison.
_WHITE: Final = np.array([0.95047, 1.0, 1.08883])
_EXPOSED: Final = 0.5
#: CIE94 weights: decrease of the sensitivity to chroma and to hue with chroma.
_CHROMA: Final = 0.045
_HUE: Final = 0.015


@cache
def typical_light() -> NDArray[np.float64]:
    r"""Radiance over the star's irradiance, up to a factor, for light of atmospheres.

    With x = λ / 550 nm, scattered or reflected light attenuated by gas, haze and ozone,

    .. math:: x^{-n} \exp(-\tau_g x^{-4} - \tau_h x^{-1.3} - N \sigma_{O_3}(\lambda)),

    from a zenith to a setting sun and the blue of dusk, and light that has lost its blue,

    .. math:: x^{-n} \exp\left(-\frac{d}{1 + e^{(\lambda - \lambda_e) / w}}\right),

    by dust, tholins and sulphur. Narrow bands (methane on Titan, water and oxygen on Earth) are not
    included, as four wavelengths cannot resolve them.

    Returns
    -------
    array, shape (420, 471)
        Spectra at 360 to 830 nm. [1]

    References
    ----------
    Ångström (1929) for λ^-1.3 of haze; ozone as in ``airlight.physics.spectra.ozone``.
    """
    x = EYE / 550.0
    ozone = 300.0 * DOBSON_UNIT * ozone_cross_section(EYE)
    weakened = [
        x**-source * np.exp(-gas * x**-4.0 - haze * x**-1.3 - layers * ozone)
        for source, gas, layers, haze in product(_SOURCES, _GAS, _OZONE, _HAZE)
    ]
    colored = [
        x**-source * np.exp(-depth / (1.0 + np.exp((EYE - edge) / width)))
        for edge, width, depth, source in product(_EDGES, _WIDTHS, _DEPTHS, _COLORED_SOURCES)
    ]
    light = np.array([*weakened, *colored])
    light.flags.writeable = False
    return light


def four_wavelengths(
    irradiance: Irradiance | None = None, limits: tuple[float, float] = (280.0, 1000.0)
) -> tuple[FloatArray, FloatArray]:
    """Four wavelengths, and weights W such that linear sRGB = radiance @ W.

    Parameters
    ----------
    irradiance : callable, array or None
        Spectrum of the star, as in ``rgb_weights``. [W m⁻² nm⁻¹]
    limits : (low, high)
        Wavelength range of a planet. [nm]

    Returns
    -------
    wavelengths : array, shape (4,)
        Wavelengths, ascending. [nm]
    weights : array, shape (4, 3)
        Weights from ``fitted_weights``. [nm]

    Raises
    ------
    ParameterError
        If no visible wavelength lies between the limits or the irradiance is not above 0.

    Examples
    --------
    >>> wavelengths, weights = four_wavelengths()
    >>> wavelengths
    array([440., 500., 560., 620.])
    """
    wavelengths = few_wavelengths(4, *limits)
    return wavelengths, fitted_weights(wavelengths, irradiance)


def few_wavelengths(
    count: int = 4, low: float = 280.0, high: float = 1000.0, *, methane: bool = False
) -> FloatArray:
    """Three or four wavelengths of a picture, within the limits of a planet.

    They minimise the mean fourth power of the error over ``typical_light`` under the sun, among
    multiples of 20 nm (four) or 10 nm (three), at least 30 nm apart. For a star of 2600 K the error
    is 0.3 ΔE above that of the best four.

    Parameters
    ----------
    count : int
        Number of wavelengths, 3 or 4.
    low, high : float
        Limits of the wavelengths. [nm]
    methane : bool
        Whether methane absorbs: four wavelengths are then beside its bands.

    Returns
    -------
    array, shape (count,)
        Wavelengths, ascending; evenly spaced where the limits exclude the chosen wavelengths. [nm]

    Raises
    ------
    ParameterError
        If the count is not 3 or 4, or no visible wavelength lies between the limits.
    """
    if count not in CHOSEN:
        raise ParameterError("count", count, "3 or 4")
    beside = methane and count == len(BESIDE_METHANE)
    chosen = np.array(BESIDE_METHANE if beside else CHOSEN[count])
    first, last = max(low, chosen[0]), min(high, chosen[-1])
    if not first < last:
        raise ParameterError("low, high", (low, high), "limits that include visible wavelengths")
    if first == chosen[0] and last == chosen[-1]:
        return chosen
    return np.linspace(first, last, count)


def fitted_weights(wavelengths: ArrayLike, irradiance: Irradiance | None = None) -> FloatArray:
    r"""Weights W such that linear sRGB = radiance @ W, for few wavelengths.

    The weights minimise the colour difference for typical spectra of atmospheres,
    :math:`s_k(\lambda)` of ``typical_light`` times the star's irradiance E,

    .. math:: \min_M \sum_k \Big| J_k \Big( \sum_i s_k(\lambda_i) M_i
              - \int s_k E\, (\bar r, \bar g, \bar b)\, d\lambda \Big) \Big|^2
              \quad\text{where}\quad \sum_i M_i = \int E\, (\bar r, \bar g, \bar b)\, d\lambda,

    and W is M over E at the wavelengths. J is the derivative of CIE94's difference at the true
    colour exposed to half the luminance of white, so the fit is linear. The condition makes colour
    and luminance exact for the star's own light and its reflection by grey surfaces.

    With the four of ``few_wavelengths`` the median error on Earth and Mars is 0.3 ΔE (CIE 2000),
    against 4 to 11 for ``rgb_weights`` with three wavelengths and 2 to 3 with four (docs/live.md);
    3 on Titan, whose methane has narrower bands, and up to 6 under the clouds of Venus at dusk.

    Parameters
    ----------
    wavelengths : array, shape (n,)
        Wavelengths, 2 to 8, distinct, any order, 360 to 830. [nm]
    irradiance : callable, array or None
        Spectrum of the star, as in ``rgb_weights``.

    Returns
    -------
    array, shape (n, 3)
        Weights, as those of ``rgb_weights``. [nm]

    Raises
    ------
    ParameterError
        If a wavelength is repeated or out of range, the number is out of range, or an irradiance is
        not positive.

    References
    ----------
    CIE 116 (1995), for the colour difference; CIE 15 (2004), L*a*b*.

    Examples
    --------
    >>> at = few_wavelengths(4)
    >>> sun = irradiance_at(at, None)
    >>> (sun @ fitted_weights(at) / sun_color()).round(12)  # the sun has its colour
    array([1., 1., 1.])
    """
    at = checked_wavelengths(wavelengths)
    if not _FEWEST <= at.size <= _MOST:
        raise ParameterError("wavelengths", at.tolist(), f"{_FEWEST} to {_MOST} wavelengths")
    if at.min() < EYE[0] or at.max() > EYE[-1]:
        raise ParameterError("wavelengths", at.tolist(), "360 to 830 nm")
    local = irradiance_at(at, irradiance)
    light = typical_light()
    true = light @ (on_eye_grid(irradiance)[:, None] * eye_rgb())
    seen = _seen_differences(true)
    samples = np.array([np.interp(at, EYE, one) for one in light])
    # The condition eliminates the last wavelength, whose row is the remainder of the star's colour.
    free = samples[:, :-1] - samples[:, -1:]
    whole = sun_color(irradiance)
    missing = np.einsum("kij,kj->ki", seen, true - samples[:, -1:] * whole)
    system = np.einsum("kij,kn->kinj", seen, free).reshape(missing.size, -1)
    rows = np.linalg.lstsq(system, missing.ravel(), rcond=None)[0].reshape(-1, 3)
    return np.vstack([rows, whole - rows.sum(axis=0)]) / local[:, None]


def picture_weights(wavelengths: ArrayLike, irradiance: Irradiance | None = None) -> FloatArray:
    """Weights of a picture: fitted for the wavelengths of ``few_wavelengths``, or integrated.

    Parameters
    ----------
    wavelengths : array, shape (n,)
        Wavelengths. [nm]
    irradiance : callable, array or None
        Spectrum of the star, as in ``rgb_weights``.

    Returns
    -------
    array, shape (n, 3)
        Weights, as those of ``rgb_weights``. [nm]

    Examples
    --------
    >>> bool((picture_weights(few_wavelengths(4)) == fitted_weights(few_wavelengths(4))).all())
    True
    """
    at = values_in(wavelengths, "nm", "wavelengths")
    if tuple(at) in (*CHOSEN.values(), BESIDE_METHANE):
        return fitted_weights(at, irradiance)
    return rgb_weights(at, irradiance)


def _seen_differences(rgb: FloatArray) -> FloatArray:
    """Derivatives of (lightness, chroma, hue) of CIE94 by linear sRGB, shape (n, 3, 3).

    Each light is exposed to half the luminance of white.
    """
    xyz = rgb @ RGB_TO_XYZ.T
    exposure = _EXPOSED / xyz[:, 1:2]
    response, slope = _lightness(exposure * xyz / _WHITE)
    slope = slope * exposure / _WHITE
    a = 500.0 * (response[:, 0] - response[:, 1])
    b = 200.0 * (response[:, 1] - response[:, 2])
    chroma = np.maximum(np.hypot(a, b), 1e-9)
    by_chroma, by_hue = 1.0 + _CHROMA * chroma, 1.0 + _HUE * chroma
    lab = np.zeros((*chroma.shape, 3, 3))
    lab[:, 0, 1] = 116.0 * slope[:, 1]
    lab[:, 1, 0], lab[:, 1, 1] = 500.0 * slope[:, 0], -500.0 * slope[:, 1]
    lab[:, 2, 1], lab[:, 2, 2] = 200.0 * slope[:, 1], -200.0 * slope[:, 2]
    turn = np.zeros_like(lab)
    turn[:, 0, 0] = 1.0
    turn[:, 1, 1], turn[:, 1, 2] = a / chroma / by_chroma, b / chroma / by_chroma
    turn[:, 2, 1], turn[:, 2, 2] = -b / chroma / by_hue, a / chroma / by_hue
    return np.asarray(turn @ lab @ RGB_TO_XYZ)


def _lightness(ratio: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Function f of CIE 1976 L*a*b* and its derivative."""
    bright = ratio > 216.0 / 24389.0
    root = np.cbrt(np.maximum(ratio, 216.0 / 24389.0))
    straight = 24389.0 / 27.0 / 116.0
    return (
        np.where(bright, root, straight * ratio + 16.0 / 116.0),
        np.where(bright, 1.0 / (3.0 * root**2), straight),
    )
