r"""Phase matrices: scattering of the Stokes parameters.

With I, Q, U, V referred to the scattering plane, Q > 0 parallel to it, the phase matrix of
molecules and of spheres is

.. math:: \begin{pmatrix} F_{11} & F_{12} & 0 & 0 \\ F_{12} & F_{22} & 0 & 0 \\
          0 & 0 & F_{33} & F_{34} \\ 0 & 0 & -F_{34} & F_{44} \end{pmatrix} .

F₁₁ is the phase function; the others are given here as ratios to it (Hovenier, van der Mee & Domke
2004, Transfer of Polarized Light in Planetary Atmospheres, section 2.4).
"""

from __future__ import annotations

from airlight.kernel import kernel


@kernel
def anisotropy(depolarisation):
    """Fraction Δ of Rayleigh scattering; the rest is isotropic and unpolarised. [1]

    Parameters
    ----------
    depolarisation : float
        Depolarisation factor δ for unpolarised light. [1]

    References
    ----------
    Hansen & Travis (1974), Space Science Reviews 16, 527, eq. 2.16.

    Examples
    --------
    >>> anisotropy(0.0), round(anisotropy(0.5), 12)
    (1.0, 0.4)
    """
    return (1.0 - depolarisation) / (1.0 + 0.5 * depolarisation)


@kernel
def rayleigh_ratios(nu, depolarisation):
    """Ratios F₁₂, F₂₂, F₃₃, F₄₄ to F₁₁ of molecules; F₃₄ is 0. [1]

    Parameters
    ----------
    nu : float
        Cosine of the scattering angle. [1]
    depolarisation : float
        Depolarisation factor δ. [1]

    References
    ----------
    Hansen & Travis (1974), eqs. 2.15 and 2.16, with their Δ' in F₄₄.

    Examples
    --------
    >>> [round(x, 12) + 0.0 for x in rayleigh_ratios(0.0, 0.0)]  # fully polarised, across the plane
    [-1.0, 1.0, 0.0, 0.0]
    """
    part = anisotropy(depolarisation)
    square = nu * nu
    whole = 0.75 * part * (1.0 + square) + (1.0 - part)
    turned = 1.5 * part * nu / whole
    kept = (1.0 - 2.0 * depolarisation) / (1.0 - depolarisation)
    across = -0.75 * part * (1.0 - square) / whole
    return across, 0.75 * part * (1.0 + square) / whole, turned, turned * kept


@kernel
def unpolarising_ratio(nu):
    """F₃₃ and F₄₄ over F₁₁ of particles with only a phase function. [1]

    They do not polarise, F₁₂ = F₃₄ = 0, and F₂₂ = F₁₁ as for spheres. The ratio is that of Rayleigh
    scattering: 1 forward, which preserves polarisation, and -1 backward.
    """
    return 2.0 * nu / (1.0 + nu * nu)
