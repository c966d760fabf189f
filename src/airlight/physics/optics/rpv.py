r"""Reflection of land by the law of Rahman, Pinty & Verstraete (RPV), over that of Lambert's.

Vegetation and rough soil are brighter than a flat surface where sun or view are low: leaves and
clods stand upright. With the cosines μ₀ and μ of incidence and reflection, and the phase angle g,

.. math:: \frac{π f}{a} = \frac{1}{N} \left(μ_0 μ (μ_0 + μ)\right)^{k - 1}
          \frac{1 - Θ^2}{(1 + 2 Θ \cos g + Θ^2)^{3/2}}, \quad k = \tfrac{3}{4},\ Θ = -0.1

without the hot spot, N so that the bihemispherical albedo is a. Cosines below 0.1 count as that:
the law was fitted to angles up to 75° to 80°, and diverges. The numbers are a choice among those of
vegetation and soil, k between 0.5 and 0.9 and Θ between -0.3 and 0.

References
----------
Rahman, Pinty & Verstraete (1993), "Coupled surface-atmosphere reflectance (CSAR) model. 2", J.
Geophys. Res. 98, 20791, eqs. 3 to 5.
"""

from __future__ import annotations

from math import sqrt
from typing import Final

from airlight.kernel import kernel

#: Asymmetry Θ; the exponent k - 1 is -1/4, two square roots.
ASYMMETRY: Final = -0.1
#: Norm N: the law's bihemispherical albedo without it.
NORM: Final = 1.3886
#: Directional albedo of the law over its bihemispherical one, times the fourth root of the cosine,
#: within 6 %: its mean over the hemisphere is 1.
DIFFUSE: Final = 0.877
#: Smallest cosine. [1]
LOWEST: Final = 0.1


@kernel
def land_direct(mu_s, mu_r, nu):
    """Reflectance of land in a beam over its albedo. [1]

    Parameters
    ----------
    mu_s, mu_r, nu : float
        Cosines as in ``reflection.direct_reflectance``. [1]

    Examples
    --------
    >>> round(land_direct(1.0, 1.0, -1.0), 2), round(land_direct(0.1, 0.1, 0.98), 2)
    (0.82, 2.55)
    """
    star, back = max(mu_s, LOWEST), max(mu_r, LOWEST)
    spread = sqrt(star * back * (star + back))
    lobe = 1.0 - 2.0 * ASYMMETRY * nu + ASYMMETRY * ASYMMETRY
    return (1.0 - ASYMMETRY * ASYMMETRY) / (NORM * sqrt(spread) * lobe * sqrt(lobe))


@kernel
def land_diffuse(mu_r):
    """Reflectance of land under isotropic light over its albedo. [1]

    Parameters
    ----------
    mu_r : float
        Cosine as in ``reflection.diffuse_reflectance``. [1]

    Examples
    --------
    >>> round(land_diffuse(1.0), 2), round(land_diffuse(0.1), 2)
    (0.88, 1.56)
    """
    return DIFFUSE / sqrt(sqrt(max(mu_r, LOWEST)))


@kernel
def unsaturated(factor, reflectance):
    """Factor of the reflectance of land, from that of dark land. [1]

    Light that is reflected several times fills the shadows of bright land.

    Parameters
    ----------
    factor : float
        Factor of dark land, whose mean is 1. [1]
    reflectance : float
        Albedo. [1]

    Examples
    --------
    >>> unsaturated(3.0, 0.0), unsaturated(3.0, 0.5), unsaturated(3.0, 1.0)
    (3.0, 2.0, 1.0)
    """
    return 1.0 + (1.0 - reflectance) * (factor - 1.0)
