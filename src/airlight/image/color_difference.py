"""Perceptual colour difference: CIE L*a*b* and CIEDE2000."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import ParameterError
from airlight.image.xyz import luminance, rgb_to_xyz

#: Tristimulus values of white, D65, 2° observer.
WHITE: Final[NDArray[np.float64]] = np.array([0.95047, 1.0, 1.08883])
WHITE.flags.writeable = False
#: Luminance to which a reference colour is scaled before the comparison; white has 1.
MIDDLE: Final = 0.5
#: Transition from the cube root of CIE Lab to a straight line: (6/29)³.
_LINEAR: Final = (6.0 / 29.0) ** 3
_SEVENTH: Final = 25.0**7


def xyz_to_lab(xyz: ArrayLike) -> NDArray[np.float64]:
    """CIE L*a*b* of tristimulus values relative to those of white.

    Parameters
    ----------
    xyz : array, shape (..., 3)
        Tristimulus values; white, D65, has Y = 1.

    Returns
    -------
    array, shape (..., 3)
        L*, a*, b*; white has L* = 100.

    References
    ----------
    ISO/CIE 11664-4:2019, eqs. 3 to 8.

    Examples
    --------
    >>> xyz_to_lab(0.5 * WHITE).round(2).tolist()
    [76.07, 0.0, 0.0]
    """
    ratio = np.asarray(xyz, dtype=np.float64) / WHITE
    line = (841.0 / 108.0) * ratio + 4.0 / 29.0
    f = np.where(ratio > _LINEAR, np.cbrt(ratio), line)
    x, y, z = np.moveaxis(f, -1, 0)
    return np.stack([116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)], axis=-1)


def delta_e_2000(lab: ArrayLike, reference: ArrayLike) -> NDArray[np.float64]:
    """CIEDE2000 colour difference; 1 is just noticeable side by side.

    Parameters
    ----------
    lab, reference : array, shape (..., 3)
        L*, a*, b*.

    Returns
    -------
    array, shape (...)
        Differences.

    References
    ----------
    Sharma, Wu & Dalal (2005), The CIEDE2000 Color-Difference Formula, Color Research and
    Application 30, 21, eqs. 2 to 22. doi:10.1002/col.20070

    Examples
    --------
    >>> f"{delta_e_2000([50.0, 2.6772, -79.7751], [50.0, 0.0, -82.7485]):.4f}"  # their Table 1
    '2.0425'
    """
    first, second = (np.asarray(one, dtype=np.float64) for one in (lab, reference))
    l1, a1, b1 = np.moveaxis(first, -1, 0)
    l2, a2, b2 = np.moveaxis(second, -1, 0)
    mean = 0.5 * (np.hypot(a1, b1) + np.hypot(a2, b2))
    stretch = 1.5 - 0.5 * np.sqrt(mean**7 / (mean**7 + _SEVENTH))  # eq. 4, 1 + G
    c1, c2 = np.hypot(stretch * a1, b1), np.hypot(stretch * a2, b2)
    h1 = np.degrees(np.arctan2(b1, stretch * a1)) % 360.0
    h2 = np.degrees(np.arctan2(b2, stretch * a2)) % 360.0
    grey = c1 * c2 == 0.0
    turn = np.where(grey, 0.0, (h2 - h1 + 180.0) % 360.0 - 180.0)  # eq. 10
    dl, dc = l2 - l1, c2 - c1
    dh = 2.0 * np.sqrt(c1 * c2) * np.sin(np.radians(0.5 * turn))  # eq. 11
    lightness, chroma = 0.5 * (l1 + l2), 0.5 * (c1 + c2)
    hue = np.where(grey, h1 + h2, h1 + 0.5 * turn)  # eq. 14; only the cosines of the hue are used

    def cosine(times: float, shift: float) -> NDArray[np.float64]:
        return np.asarray(np.cos(np.radians(times * hue + shift)))

    weight = (
        1.0
        - 0.17 * cosine(1.0, -30.0)
        + 0.24 * cosine(2.0, 0.0)
        + 0.32 * cosine(3.0, 6.0)
        - 0.20 * cosine(4.0, -63.0)
    )
    theta = 30.0 * np.exp(-((((hue - 275.0 + 180.0) % 360.0 - 180.0) / 25.0) ** 2))
    twist = -2.0 * np.sqrt(chroma**7 / (chroma**7 + _SEVENTH)) * np.sin(np.radians(2.0 * theta))
    sl = 1.0 + 0.015 * (lightness - 50.0) ** 2 / np.sqrt(20.0 + (lightness - 50.0) ** 2)
    sc, sh = 1.0 + 0.045 * chroma, 1.0 + 0.015 * chroma * weight
    x, y, z = dl / sl, dc / sc, dh / sh
    return np.asarray(np.sqrt(np.maximum(x * x + y * y + z * z + twist * y * z, 0.0)))


def color_difference(rgb: ArrayLike, reference: ArrayLike) -> NDArray[np.float64]:
    """CIEDE2000 difference of two lights, for adaptation to the reference.

    Both are scaled so that the reference has half the luminance of white.

    Parameters
    ----------
    rgb, reference : array, shape (..., 3)
        Linear sRGB in any unit.

    Returns
    -------
    array, shape (...)
        Differences.

    Raises
    ------
    ParameterError
        If a reference has no luminance.

    Examples
    --------
    >>> f"{color_difference([1.1, 1.1, 1.1], [1.0, 1.0, 1.0]):.2f}"  # a tenth brighter
    '2.11'
    """
    given = np.asarray(reference, dtype=np.float64)
    bright = np.asarray(luminance(given))
    if not (bright > 0.0).all():
        raise ParameterError("luminance of the reference", float(bright.min()), "above 0")
    scale = (MIDDLE / bright)[..., None]
    pair = (xyz_to_lab(rgb_to_xyz(scale * np.asarray(one, np.float64))) for one in (rgb, given))
    return delta_e_2000(*pair)
