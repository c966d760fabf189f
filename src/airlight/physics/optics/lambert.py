"""Lambertian reflection (Lambert 1760)."""

from __future__ import annotations

from typing import Any

from airlight.kernel import kernel


def largest_albedo(ground: Any) -> float:
    """Largest albedo that conserves energy, of a ``Reflection``. [1]"""
    return 1.0


@kernel
def brdf_direct(ground, mu_s, mu_r, nu):
    """Direct reflectance factor: the albedo.

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
    >>> brdf_direct(None, 0.5, 0.2, 0.1)
    (1.0, 0.0)
    """
    return 1.0, 0.0


@kernel
def brdf_diffuse(ground, mu_r):
    """Diffuse reflectance factor: the albedo.

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
    >>> brdf_diffuse(None, 0.2)
    (1.0, 0.0)
    """
    return 1.0, 0.0
