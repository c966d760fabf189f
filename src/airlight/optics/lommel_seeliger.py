"""Reflection by dark, porous ground, as of the Moon and of airless rocks: Lommel and Seeliger.

Light scattered once in a half space of isotropic grains (Seeliger 1888; Hapke 2012, "Theory of
Reflectance and Emittance Spectroscopy", eq. 8.35a; spherical albedo as there): the BRDF is
proportional to 1/(μ₀ + μ). The factor is chosen so that the ground under a uniform sky reflects
the fraction ``albedo``.
"""

from __future__ import annotations

from math import log
from typing import Any

from airlight.kernel import kernel

#: 3/(8 (1 - ln 2)): the hemispherical mean of c (1 - μ ln((1 + μ)/μ)), doubled, is then 1.
_SCALE = 3.0 / (8.0 * (1.0 - log(2.0)))
#: Smallest sum of the cosines, for lines that graze the ground while the star sets.
_LEVEL = 1e-4


def largest_albedo(ground: Any) -> float:
    """Largest albedo that conserves the energy of a level beam, of a ``Reflection``: 0.409. [1]"""
    return 0.5 / _SCALE


@kernel
def star_share(ground, mu_s, leaving, nu):
    """Reflectance factor in the light of a star: c/(μ₀ + μ) of the albedo.

    Parameters
    ----------
    ground : Reflection
    mu_s, leaving, nu : float
        Cosines as in ``reflection.star_factor``. [1]

    Returns
    -------
    matte, gloss : float
        Factor of the albedo, and part without it. [1]

    Examples
    --------
    >>> matte, gloss = star_share(None, 1.0, 1.0, -1.0)
    >>> round(matte, 4), gloss  # full phase, overhead
    (0.611, 0.0)
    """
    return _SCALE / max(max(mu_s, 0.0) + leaving, _LEVEL), 0.0


@kernel
def sky_share(ground, leaving):
    """Reflectance factor under a uniform sky: 2c (1 - μ ln((1 + μ)/μ)) of the albedo.

    Parameters
    ----------
    ground : Reflection
    leaving : float
        Cosine as in ``reflection.sky_factor``. [1]

    Returns
    -------
    matte, gloss : float
        Factor of the albedo, and part without it. [1]

    Examples
    --------
    >>> matte, gloss = sky_share(None, 0.0)
    >>> round(matte * largest_albedo(None), 6), gloss
    (1.0, 0.0)
    """
    cosine = max(leaving, 1e-9)
    return 2.0 * _SCALE * (1.0 - cosine * log((1.0 + cosine) / cosine)), 0.0
