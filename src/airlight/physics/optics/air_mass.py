"""Relative air mass: the column along a ray from the ground over the vertical column."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from airlight.errors import ParameterError
from airlight.physics.units import values_in

FloatArray = npt.NDArray[np.float64]


def air_mass_pickering2002(altitude: npt.ArrayLike) -> FloatArray:
    r"""Air mass of the Earth's molecular atmosphere by Pickering's fit, with refraction.

    .. math:: AM = \frac{1}{\sin\left(h + 244/(165 + 47 h^{1.1})\right)}

    It applies to the Earth's scale height, not to low haze: on the horizon it is 38.7, against 104
    for a scale height of 1.2 km.

    Parameters
    ----------
    altitude : array, shape (...)
        Apparent altitude above the horizon, 0 to 90. [deg]

    Returns
    -------
    array, shape (...)
        Ratio of columns. [1]

    Raises
    ------
    ParameterError
        If an altitude is out of its range.

    References
    ----------
    Pickering (2002), DIO 12, 3, footnote 39. Costa et al. (2021), IEEE TVCG 27, 785, eq. 21,
    prints the exponent outside the bracket: (165 + 47 h)^1.1.

    Examples
    --------
    >>> air_mass_pickering2002([0.0, 1.0, 5.0, 10.0]).round(3).tolist()
    [38.749, 26.644, 10.334, 5.581]
    """
    h = values_in(altitude, "deg", "altitude")
    wrong = ~((h >= 0.0) & (h <= 90.0))
    if wrong.any():
        raise ParameterError("altitude", float(h[wrong].flat[0]), "0 to 90 deg above the horizon")
    return np.asarray(1.0 / np.sin(np.radians(h + 244.0 / (165.0 + 47.0 * h**1.1))))
