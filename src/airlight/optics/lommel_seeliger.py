"""Reflection by dark, porous ground, as of the Moon and of airless rocks: Lommel and Seeliger.

Light scattered once in a half space of isotropic grains (Seeliger 1888; Hapke 2012, "Theory of
Reflectance and Emittance Spectroscopy", eq. 8.35a; spherical albedo as there): the BRDF is
proportional to 1/(μ₀ + μ). The factor is chosen so that the ground under a uniform sky reflects
the fraction ``albedo``.
"""

from __future__ import annotations

from math import log

from airlight.kernel import kernel

#: 3/(8 (1 - ln 2)): the hemispherical mean of c (1 - μ ln((1 + μ)/μ)), doubled, is then 1.
_SCALE = 3.0 / (8.0 * (1.0 - log(2.0)))
#: Albedo above which the ground would send back more of a level beam than arrives: 0.409.
LARGEST_ALBEDO = 0.5 / _SCALE
#: Smallest sum of the cosines, for lines that graze the ground while the star sets.
_LEVEL = 1e-4


@kernel
def brdf_direct(ground, mu_s, mu_r, nu):
    """Reflectance factor in the light of a star: c/(μ₀ + μ) of the albedo.

    Parameters
    ----------
    ground : Reflection
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
    """Reflectance factor under a uniform sky: 2c (1 - μ ln((1 + μ)/μ)) of the albedo.

    Parameters
    ----------
    ground : Reflection
    mu_r : float
        Cosine as in ``reflection.diffuse_reflectance``. [1]

    Returns
    -------
    diffuse, specular : float
        Factor of the albedo, and part without it. [1]

    Examples
    --------
    >>> diffuse, specular = brdf_diffuse(None, 0.0)
    >>> round(diffuse * LARGEST_ALBEDO, 6), specular
    (1.0, 0.0)
    """
    cosine = max(mu_r, 1e-9)
    return 2.0 * _SCALE * (1.0 - cosine * log((1.0 + cosine) / cosine)), 0.0
