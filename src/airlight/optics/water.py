"""Reflection by the sea: mirroring facets, foam, and light that comes back from below.

The facets are Cox and Munk's (``cox_munk``), their refractive index that of sea water at all
wavelengths. Foam covers a share of the sea that grows with the wind (Monahan & O'Muircheartaigh
1980, J. Phys. Oceanogr. 10, 2094, eq. 5) and reflects 0.22 of the light alike into all directions,
the mean over a patch's life (Koepke 1984, Appl. Opt. 23, 1816). What is left goes below: of it the
fraction ``albedo`` of all light comes back, through the surface both ways.
"""

from __future__ import annotations

from typing import Any

from airlight.kernel import kernel
from airlight.optics.cox_munk import glint_factor, mean_mirrored, mirrored_fraction

#: Reflectance of foam. [1]
FOAM = 0.22


def largest_albedo(ground: Any) -> float:
    """Largest albedo that conserves energy, of a ``Reflection``, at all winds. [1]"""
    return 0.93


@kernel
def foam_share(wind):
    """Share of the sea that foam covers, 2.95e-6 U^3.52. [1]

    Parameters
    ----------
    wind : float
        Wind speed 10 m above the sea. [m s⁻¹]

    Examples
    --------
    >>> round(foam_share(10.0), 4)
    0.0098
    """
    return 2.95e-6 * wind**3.52


@kernel
def mean_gloss(wind):
    """Fraction of a uniform sky's light that surface and foam send back. [1]

    Parameters
    ----------
    wind : float
        Wind speed. [m s⁻¹]

    Examples
    --------
    >>> round(mean_gloss(5.0), 3), round(mean_gloss(20.0), 3)
    (0.056, 0.064)
    """
    foam = foam_share(wind)
    return (1.0 - foam) * mean_mirrored(wind) + foam * FOAM


@kernel
def wet_shares(wind, mu_s, leaving, nu):
    """Both shares of water at once, which a pixel asks for.

    Parameters
    ----------
    wind : float
        Wind speed. [m s⁻¹]
    mu_s, leaving, nu : float
        Cosines as in ``reflection.star_factor``. [1]

    Returns
    -------
    star_matte, star_gloss, sky_matte, sky_gloss : float
        Results of ``star_share`` and of ``sky_share``. [1]
    """
    foam, through = foam_share(wind), 1.0 - mean_mirrored(wind)
    free, white = 1.0 - foam, foam * FOAM
    mirrored = mirrored_fraction(leaving, wind)
    matte = free * (1.0 - mirrored) / through
    star_matte = matte * (1.0 - mirrored_fraction(mu_s, wind)) / through
    glint = glint_factor(mu_s, leaving, nu, wind)
    return star_matte, free * glint + white, matte, free * mirrored + white


@kernel
def star_share(ground, mu_s, leaving, nu):
    """Reflectance factor in the light of a star: what comes from below, and the glint with foam.

    Parameters
    ----------
    ground : Reflection
    mu_s, leaving, nu : float
        Cosines as in ``reflection.star_factor``. [1]

    Returns
    -------
    matte, gloss : float
        Factor of the albedo, and part without it. [1]
    """
    matte, gloss, _, _ = wet_shares(ground.wind, mu_s, leaving, nu)
    return matte, gloss


@kernel
def sky_share(ground, leaving):
    """Reflectance factor under a uniform sky: what comes from below, and mirrored sky with foam.

    Parameters
    ----------
    ground : Reflection
    leaving : float
        Cosine as in ``reflection.sky_factor``. [1]

    Returns
    -------
    matte, gloss : float
        Factor of the albedo, and part without it. [1]
    """
    foam, mirrored = foam_share(ground.wind), mirrored_fraction(leaving, ground.wind)
    matte = (1.0 - foam) * (1.0 - mirrored) / (1.0 - mean_mirrored(ground.wind))
    return matte, (1.0 - foam) * mirrored + foam * FOAM
