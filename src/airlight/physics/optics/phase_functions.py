"""Phase functions, normalised to 1 over the sphere.

The argument ``nu`` is the cosine of the scattering angle, +1 for forward scattering: for a line of
sight and the direction towards the star, nu = view · sun.
"""

from __future__ import annotations

import math
from typing import Final

from airlight.kernel import kernel

#: 1/(4π): the phase function of isotropic scattering. [sr⁻¹]
INV_4PI: Final = 1.0 / (4.0 * math.pi)


@kernel
def rayleigh(nu: float, depolarisation: float) -> float:
    r"""Rayleigh phase function with depolarisation. [sr⁻¹]

    .. math:: p = \frac{3}{16\pi(1+2\gamma)}\left[(1+3\gamma) + (1-\gamma)\nu^2\right],
              \qquad \gamma = \frac{\delta}{2-\delta}

    Parameters
    ----------
    nu : float
        Cosine of the scattering angle. [1]
    depolarisation : float
        δ for unpolarised light, 0 (isotropic molecules) to 0.5 (rods). [1]

    References
    ----------
    Chandrasekhar (1960), Radiative Transfer, §18. δ = 0.035 is Penndorf (1957):
    0.7629 (1 + 0.932 ν²)/4π.

    Examples
    --------
    >>> f"{4 * math.pi * rayleigh(0.0, 0.035):.4f}"
    '0.7629'
    """
    gamma = depolarisation / (2.0 - depolarisation)
    return 0.75 * INV_4PI * ((1.0 + 3.0 * gamma) + (1.0 - gamma) * nu * nu) / (1.0 + 2.0 * gamma)


@kernel
def rayleigh_modified(nu: float) -> float:
    """Empirical Rayleigh phase function of computer graphics, 0.8 (1.4 + 0.5 ν)/4π. [sr⁻¹]

    **Not** normalised: it integrates to 1.12, and violates energy conservation; no planet file can
    select it. It darkens the antisolar sky, where Rayleigh scattering is symmetric.

    Parameters
    ----------
    nu : float
        Cosine of the scattering angle; linear, not squared. [1]

    References
    ----------
    Schafhitzel, Falk & Ertl (2007), Real-Time Rendering of Planets with Atmospheres, after
    Nishita's simplification; Elek (2009) prints the same form.

    Examples
    --------
    >>> f"{4 * math.pi * rayleigh_modified(0.0):.2f}"  # ν averages to 0: the integral over 4π
    '1.12'
    """
    return 0.8 * INV_4PI * (1.4 + 0.5 * nu)


@kernel
def cornette_shanks(nu: float, g: float) -> float:
    r"""Cornette-Shanks phase function. [sr⁻¹]

    .. math:: p = \frac{3}{8\pi}\,\frac{1-g^2}{2+g^2}\,\frac{1+\nu^2}{(1+g^2-2g\nu)^{3/2}}

    Its mean cosine is not g but 3g(4+g²)/(5(2+g²)): 0.8436 at g = 0.8.

    Parameters
    ----------
    nu : float
        Cosine of the scattering angle. [1]
    g : float
        Parameter between -1 and 1; positive is forward. [1]

    References
    ----------
    Cornette & Shanks (1992), Applied Optics 31, 3152, eq. 8. doi:10.1364/AO.31.003152

    Examples
    --------
    >>> cornette_shanks(0.3, 0.0) == rayleigh(0.3, 0.0)  # g = 0 is Rayleigh
    True
    """
    base = (1.0 - g) * (1.0 - g) + 2.0 * g * (1.0 - nu)
    return (
        1.5 * INV_4PI * (1.0 - g * g) / (2.0 + g * g) * (1.0 + nu * nu) / (base * math.sqrt(base))
    )


@kernel
def henyey_greenstein(nu: float, g: float) -> float:
    r"""Henyey-Greenstein phase function. [sr⁻¹]

    .. math:: p = \frac{1}{4\pi}\,\frac{1-g^2}{(1+g^2-2g\nu)^{3/2}}

    Its Legendre moments are exactly g^l.

    Parameters
    ----------
    nu : float
        Cosine of the scattering angle. [1]
    g : float
        Mean cosine, between -1 and 1; positive is forward. [1]

    References
    ----------
    Henyey & Greenstein (1941), Astrophysical Journal 93, 70, eq. 2. doi:10.1086/144246

    Examples
    --------
    >>> f"{4 * math.pi * henyey_greenstein(1.0, 0.5):.1f}"  # (1 + g)/(1 - g)²
    '6.0'
    """
    base = (1.0 - g) * (1.0 - g) + 2.0 * g * (1.0 - nu)
    return INV_4PI * (1.0 - g * g) / (base * math.sqrt(base))


@kernel
def double_henyey_greenstein(nu: float, g1: float, g2: float, alpha: float) -> float:
    """Two Henyey-Greenstein lobes: α HG(g₁) + (1-α) HG(g₂). [sr⁻¹]

    Parameters
    ----------
    nu : float
        Cosine of the scattering angle. [1]
    g1, g2 : float
        Mean cosine of each lobe, between -1 and 1. [1]
    alpha : float
        Weight of the first lobe, 0 to 1. [1]

    References
    ----------
    Kattawar (1975), JQSRT 15, 839. doi:10.1016/0022-4073(75)90095-3

    Examples
    --------
    >>> double_henyey_greenstein(0.2, 0.7, -0.3, 1.0) == henyey_greenstein(0.2, 0.7)
    True
    """
    first = henyey_greenstein(nu, g1)
    second = henyey_greenstein(nu, g2)
    return alpha * first + (1.0 - alpha) * second  # type: ignore[no-any-return]
