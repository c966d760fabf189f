"""Reflection alike into all directions (Lambert 1760)."""

from __future__ import annotations

from typing import Any

from airlight.kernel import kernel


def largest_albedo(ground: Any) -> float:
    """Largest albedo that conserves energy, of a ``Reflection``. [1]"""
    return 1.0


@kernel
def star_share(ground, mu_s, leaving, nu):
    """Reflectance factor in the light of a star: the albedo.

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
    >>> star_share(None, 0.5, 0.2, 0.1)
    (1.0, 0.0)
    """
    return 1.0, 0.0


@kernel
def sky_share(ground, leaving):
    """Reflectance factor under a uniform sky: the albedo.

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
    >>> sky_share(None, 0.2)
    (1.0, 0.0)
    """
    return 1.0, 0.0
