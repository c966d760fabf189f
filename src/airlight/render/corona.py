r"""Solar corona: K and F corona, from a mean of eclipse observations.

Surface brightness at a distance ρ from the sun's centre, in solar radii, over that of the disc's
centre:

.. math:: \frac{L(\rho)}{L(0)} = 10^{-6} \left(\frac{0.0532}{\rho^{2.5}} + \frac{1.425}{\rho^7}
                                  + \frac{2.565}{\rho^{17}}\right)

Streamers are neglected; the spectrum is that of the disc.

Source: Baumbach (1937), Astronomische Nachrichten 263, 121, doi:10.1002/asna.19372630602.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

#: Coefficients and exponents.
_TERMS: Final = ((0.0532, 2.5), (1.425, 7.0), (2.565, 17.0))
#: Distance at which the corona is faded out, as zodiacal light is not rendered. [radii]
OUTERMOST: Final = 30.0


def corona(angle: npt.ArrayLike, star_radius: float, darkening: FloatArray) -> FloatArray:
    """Radiance of the corona, per irradiance of the sun, shape (n, nl). [sr⁻¹]

    Parameters
    ----------
    angle : array, shape (n,)
        Angles from the sun's centre. [rad]
    star_radius : float
        Angular radius of the sun. [rad]
    darkening : array, shape (nl, 6)
        Limb-darkening coefficients, see ``physics.spectra.limb_darkening``. [1]

    Returns
    -------
    array
        Radiance; 0 on the disc and beyond ``OUTERMOST``.

    Examples
    --------
    >>> sun, law = 0.00465, np.array([[1.0, 0.0, 0.0, 0.0, 0.0, 0.0]])
    >>> bright = corona([0.00466, 2 * 0.00465], sun, law)[:, 0]
    >>> (bright * np.pi * sun**2).round(8)  # a millionth of the disc, a fiftieth of that
    array([3.92e-06, 2.00e-08])
    """
    distance = np.atleast_1d(np.asarray(angle, float)) / star_radius
    outside = (distance > 1.0) & (distance < OUTERMOST)
    at = np.where(outside, distance, 1.0)
    bright = 1e-6 * sum(factor * at**-power for factor, power in _TERMS)
    fading = (1.0 - np.minimum(distance / OUTERMOST, 1.0) ** 2) ** 2
    centre = darkening.sum(axis=1) / (math.pi * math.sin(star_radius) ** 2)
    return np.asarray(np.where(outside, bright * fading, 0.0)[:, None] * centre)
