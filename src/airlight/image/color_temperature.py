"""Correlated colour temperature."""

from __future__ import annotations

from functools import cache
from math import inf
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import ParameterError
from airlight.physics.spectra.blackbody import planck_radiance
from airlight.physics.spectra.color_matching import cie_1931

#: Range of reciprocal temperatures in the search for the nearest black body: 1000 K to one so hot
#: that its colour is the limit. [MK⁻¹]
_HOTTEST: Final = 1e-3
_COLDEST: Final = 1000.0
#: Largest distance in u, v from the black-body locus for which a colour temperature is defined.
FARTHEST: Final = 0.05


def uv_1960(xyz: ArrayLike) -> NDArray[np.float64]:
    r"""CIE 1960 chromaticity coordinates.

    .. math:: u = \frac{4 X}{X + 15 Y + 3 Z}, \quad v = \frac{6 Y}{X + 15 Y + 3 Z}

    Parameters
    ----------
    xyz : array, shape (..., 3)
        Tristimulus values, not all zero.

    Returns
    -------
    array, shape (..., 2)
        [1]

    References
    ----------
    CIE 15:2018, Colorimetry, section 9.4.

    Examples
    --------
    >>> uv_1960([0.95047, 1.0, 1.08883]).round(4)  # D65
    array([0.1978, 0.3122])
    """
    x, y, z = np.moveaxis(np.asarray(xyz, dtype=np.float64), -1, 0)
    total = x + 15.0 * y + 3.0 * z
    return np.stack([4.0 * x / total, 6.0 * y / total], axis=-1)


def _black_body(reciprocal: float) -> NDArray[np.float64]:
    """Chromaticity of a black body of a reciprocal temperature [MK⁻¹], shape (2,). [1]"""
    seen = cie_1931()
    return uv_1960(planck_radiance(seen.wavelengths, 1e6 / reciprocal) @ seen.values)


@cache
def _locus() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Reciprocal temperatures [MK⁻¹] and chromaticities of black bodies, shapes (n,), (n, 2)."""
    reciprocals = np.concatenate([[_HOTTEST], np.arange(5.0, _COLDEST + 1.0, 5.0)])
    return reciprocals, np.array([_black_body(float(one)) for one in reciprocals])


def correlated_color_temperature(xyz: ArrayLike) -> float:
    """Temperature of the black body with the nearest chromaticity.

    Parameters
    ----------
    xyz : array, shape (3,)
        Tristimulus values of the light, in any unit.

    Returns
    -------
    float
        Temperature; infinite if bluer than the hottest black body. [K]

    Raises
    ------
    ParameterError
        If the colour is farther than 0.05 from all black bodies from 1000 K up, in u, v.

    References
    ----------
    CIE 15:2018, Colorimetry, section 9.5: least distance in the diagram of u, v (2v/3 of u', v').

    Examples
    --------
    >>> f"{correlated_color_temperature([0.95047, 1.0, 1.08883]):.0f}"  # D65
    '6503'
    """
    from scipy.optimize import minimize_scalar

    light = uv_1960(xyz)
    reciprocals, colors = _locus()
    nearest = int(np.hypot(*(colors - light).T).argmin())
    low = float(reciprocals[max(nearest - 1, 0)])
    high = float(reciprocals[min(nearest + 1, reciprocals.size - 1)])

    def distance(reciprocal: float) -> float:
        return float(np.hypot(*(_black_body(reciprocal) - light)))

    found = minimize_scalar(distance, bounds=(low, high), method="bounded", options={"xatol": 1e-7})
    if not found.fun <= FARTHEST:
        allowed = f"a colour within {FARTHEST:g} in u, v of a black body's"
        raise ParameterError("xyz", np.asarray(xyz).tolist(), allowed)
    if distance(_HOTTEST) <= found.fun:
        return inf
    return 1e6 / float(found.x)
