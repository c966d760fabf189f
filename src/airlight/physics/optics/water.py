"""Reflection by the sea: glint, whitecaps, and water-leaving radiance.

Glint is that of Cox-Munk facets (``cox_munk``), with one refractive index of sea water at all
wavelengths. Whitecap coverage increases with wind (Monahan & O'Muircheartaigh 1980, J. Phys.
Oceanogr. 10, 2094, eq. 5); the effective reflectance of foam is 0.22, Lambertian, the mean over a
patch's lifetime (Koepke 1984, Appl. Opt. 23, 1816). ``albedo`` is the fraction of incident light
that leaves the water again, including both transmissions.
"""

from __future__ import annotations

from typing import Any

from airlight.kernel import kernel
from airlight.physics.optics.cox_munk import glint_factor, mean_mirrored, mirrored_fraction

#: Reflectance of foam. [1]
FOAM = 0.22


def largest_albedo(ground: Any) -> float:
    """Largest albedo that conserves energy: the transmittance of the surface at all winds. [1]"""
    return 0.93


@kernel
def foam_fraction(wind):
    """Whitecap coverage, 2.95e-6 U^3.52. [1]

    Parameters
    ----------
    wind : float
        Wind speed 10 m above the sea. [m s⁻¹]

    Examples
    --------
    >>> round(foam_fraction(10.0), 4)
    0.0098
    """
    return 2.95e-6 * wind**3.52


@kernel
def mean_specular(wind):
    """Spherical albedo of surface and foam. [1]

    Parameters
    ----------
    wind : float
        Wind speed. [m s⁻¹]

    Examples
    --------
    >>> round(mean_specular(5.0), 3), round(mean_specular(20.0), 3)
    (0.056, 0.064)
    """
    foam = foam_fraction(wind)
    return (1.0 - foam) * mean_mirrored(wind) + foam * FOAM


@kernel
def water_reflectances(wind, mu_s, mu_r, nu, sparkle):
    """``brdf_direct`` and ``brdf_diffuse`` of water together, for renderers.

    Parameters
    ----------
    wind : float
        Wind speed. [m s⁻¹]
    mu_s, mu_r, nu : float
        Cosines as in ``reflection.direct_reflectance``. [1]
    sparkle : float
        Glint relative to that of all facets: 1, or that of a pixel that resolves waves. [1]

    Returns
    -------
    star_diffuse, star_specular, sky_diffuse, sky_specular : float
        Results of ``brdf_direct`` and of ``brdf_diffuse``. [1]
    """
    foam, through = foam_fraction(wind), 1.0 - mean_mirrored(wind)
    free, white = 1.0 - foam, foam * FOAM
    mirrored = mirrored_fraction(mu_r, wind)
    diffuse = free * (1.0 - mirrored) / through
    star_diffuse = diffuse * (1.0 - mirrored_fraction(mu_s, wind)) / through
    glint = sparkle * glint_factor(mu_s, mu_r, nu, wind)
    return star_diffuse, free * glint + white, diffuse, free * mirrored + white


@kernel
def brdf_direct(ground, mu_s, mu_r, nu):
    """Direct reflectance factor: water-leaving light (diffuse), glint and foam (specular).

    Parameters
    ----------
    mu_s, mu_r, nu : float
        Cosines as in ``reflection.direct_reflectance``. [1]

    Returns
    -------
    diffuse, specular : float
        Factor of the albedo, and part without it. [1]
    """
    diffuse, specular, _, _ = water_reflectances(ground.wind, mu_s, mu_r, nu, 1.0)
    return diffuse, specular


@kernel
def brdf_diffuse(ground, mu_r):
    """Diffuse reflectance factor: water-leaving light (diffuse), mirrored sky and foam (specular).

    Parameters
    ----------
    mu_r : float
        Cosine as in ``reflection.diffuse_reflectance``. [1]

    Returns
    -------
    diffuse, specular : float
        Factor of the albedo, and part without it. [1]
    """
    foam, mirrored = foam_fraction(ground.wind), mirrored_fraction(mu_r, ground.wind)
    diffuse = (1.0 - foam) * (1.0 - mirrored) / (1.0 - mean_mirrored(ground.wind))
    return diffuse, (1.0 - foam) * mirrored + foam * FOAM
