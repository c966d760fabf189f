"""Lommel-Seeliger reflection, of dark porous ground such as the Moon's.

Single scattering in a half space of isotropic grains (Seeliger 1888; Hapke 2012, "Theory of
Reflectance and Emittance Spectroscopy", eq. 8.35a): the BRDF is proportional to 1/(μ₀ + μ). It is
normalised so that the spherical albedo is ``albedo``.
"""

from __future__ import annotations

from math import log
from typing import Any

from airlight.kernel import kernel

#: 3/(8 (1 - ln 2)): the hemispherical mean of c (1 - μ ln((1 + μ)/μ)), doubled, is then 1.
_SCALE = 3.0 / (8.0 * (1.0 - log(2.0)))
#: Smallest sum of the cosines, at grazing incidence and reflection.
_LEVEL = 1e-4


def largest_albedo(ground: Any) -> float:
    """Largest albedo whose directional albedo at grazing incidence is at most 1: 0.409. [1]"""
    return 0.5 / _SCALE


@kernel
def brdf_direct(ground, mu_s, mu_r, nu):
    """Direct reflectance factor: c/(μ₀ + μ) times the albedo.

    Parameters
    ----------
    mu_s, mu_r, nu : float
        Cosines as in ``reflection.direct_reflectance``. [1]

    Returns
    -------
    diffuse, specular : float
        Factor of the albedo, and part without it. [1]

    Examples
    --------
    >>> diffuse, specular = brdf_direct(None, 1.0, 1.0, -1.0)
    >>> round(diffuse, 4), specular  # full phase, overhead
    (0.611, 0.0)
    """
    return _SCALE / max(max(mu_s, 0.0) + mu_r, _LEVEL), 0.0


@kernel
def brdf_diffuse(ground, mu_r):
    """Diffuse reflectance factor: 2c (1 - μ ln((1 + μ)/μ)) times the albedo.

    Parameters
    ----------
    mu_r : float
        Cosine as in ``reflection.diffuse_reflectance``. [1]

    Returns
    -------
    diffuse, specular : float
        Factor of the albedo, and part without it. [1]

    Examples
    --------
    >>> diffuse, specular = brdf_diffuse(None, 0.0)
    >>> round(diffuse * largest_albedo(None), 6), specular
    (1.0, 0.0)
    """
    cosine = max(mu_r, 1e-9)
    return 2.0 * _SCALE * (1.0 - cosine * log((1.0 + cosine) / cosine)), 0.0
