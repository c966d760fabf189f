r"""Geometric albedo of a semi-infinite conservative Rayleigh atmosphere.

Chandrasekhar (1950), Radiative Transfer, sections 44 and 45: diffuse reflection by a semi-infinite
atmosphere, from three H-functions of the characteristic functions

.. math:: \Psi_0 = \tfrac{3}{16}(3 - \mu^2), \quad \Psi_1 = \tfrac38 \mu^2 (1 - \mu^2), \quad
          \Psi_2 = \tfrac{3}{32} (1 - \mu^2)^2 .

Dlugach & Yanovitskij (1974), Icarus 22, 66, have 0.751, as the tests of PICASO quote their table
(Batalha et al. 2019, ApJ 878, 70). Its albedos for isotropic scattering are up to 0.0007 below the
exact ones; the error is taken as one unit of the third digit.

Both neglect polarisation: with it the albedo is 0.798 (Prather 1974, ApJ 192, 787, not checked
against the paper), 6 % more; by Monte Carlo 0.796 (Schmid, Joos & Tschan 2006, A&A 452, 657, Table
3).
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.quadrature import gauss_legendre
from airlight.planets import Planet
from airlight.planets.matter.phases import Rayleigh
from airlight.planets.matter.profiles import Exponential
from airlight.solver import Solution
from airlight.studies.observables.disc import disc_reflectance
from airlight.validation.planets import VAST, one_constituent
from airlight.validation.published.row import PublishedRow, PublishedSection
from airlight.validation.suite import SuiteRun, Threshold

FloatArray = NDArray[np.float64]

#: Target of the difference from the exact albedo. [%]
ALBEDO_THRESHOLD: Final = 0.5
#: Optical depth of the gas: white ground replaces the remaining gas with an error of e^-16.
DEPTH: Final = 8.0
_SCALE_HEIGHT: Final = 8e3
_WAVELENGTH: Final = 550.0
_POINTS: Final = 60
_STEPS: Final = 2000


def h_function(mu: FloatArray, weights: FloatArray, psi: FloatArray) -> FloatArray:
    r"""Chandrasekhar's H-function of a characteristic function.

    .. math:: \frac{1}{H(\mu)} = \sqrt{1 - 2 \int_0^1 \Psi\, d\mu'}
              + \int_0^1 \frac{\mu' \Psi(\mu') H(\mu')}{\mu + \mu'} d\mu'

    Parameters
    ----------
    mu, weights, psi : array, shape (n,)
        Quadrature points from 0 to 1, weights, and the characteristic function. [1]

    Returns
    -------
    array, shape (n,)
        [1]

    References
    ----------
    Chandrasekhar (1950), section 38, eq. 14.
    """
    rest = np.sqrt(max(1.0 - 2.0 * float(weights @ psi), 0.0))
    kernel = mu * psi * weights / (mu[:, None] + mu)
    h = np.ones_like(mu)
    for _ in range(_STEPS):
        # Half a step: whole steps oscillate about the solution.
        better = 0.5 * (h + 1.0 / (rest + kernel @ h))
        if np.abs(better - h).max() < 1e-13:
            break
        h = better
    return h


def rayleigh_constant(mu: FloatArray, weights: FloatArray, h: FloatArray) -> FloatArray:
    r"""Constant c of the reflection function, from conservation of energy, shape (n,). [1]

    Energy is conserved for each :math:`\mu_0`, so that the n results are equal.
    """
    taken = weights * h * mu * mu[:, None] * h[:, None] / (mu + mu[:, None])
    constant = 0.375 * (taken * (3.0 + mu * mu[:, None])).sum(axis=1)
    linear = 0.375 * (taken * (mu + mu[:, None])).sum(axis=1)
    return np.asarray((constant - 2.0 * mu) / linear)


def exact_albedo() -> float:
    r"""Geometric albedo of a semi-infinite conservative Rayleigh atmosphere. [1]

    .. math:: p = \tfrac{3}{32} \int_0^1 \mu \left[ H_0^2 (3 - 2 c \mu + \mu^2)
              + 4 \mu^2 (1 - \mu^2) H_1^2 + (1 - \mu^2)^2 H_2^2 \right] d\mu

    from Chandrasekhar's scattering function (section 44, eq. 51) at :math:`\mu = \mu_0`,
    backscattering.

    Examples
    --------
    >>> f"{exact_albedo():.4f}"  # Dlugach & Yanovitskij (1974): 0.751
    '0.7518'
    """
    rule = gauss_legendre(_POINTS)
    mu, weights = rule.nodes, rule.weights
    sine2 = 1.0 - mu**2
    h0 = h_function(mu, weights, 3.0 / 16.0 * (3.0 - mu**2))
    h1 = h_function(mu, weights, 0.375 * mu**2 * sine2)
    h2 = h_function(mu, weights, 3.0 / 32.0 * sine2**2)
    c = float(rayleigh_constant(mu, weights, h0).mean())
    back = h0**2 * (3.0 - 2.0 * c * mu + mu**2)
    back += 4.0 * mu**2 * sine2 * h1**2 + sine2**2 * h2**2
    return float(3.0 / 32.0 * weights @ (mu * back))


def geometric_albedo(solution: Solution) -> FloatArray:
    """Geometric albedo for the ground radius, shape (nl,). [1]"""
    values, _ = disc_reflectance(solution, np.zeros(1), solution.medium.bottom_radius)
    return np.asarray(values[0])


def rayleigh_planet() -> Planet:
    """Large sphere with a Rayleigh atmosphere of optical depth 8 over white ground, point star."""
    return one_constituent(
        "gas without end",
        VAST * 6360e3,
        100e3,
        albedo=1.0,
        profile=Exponential(scale_height=_SCALE_HEIGHT),
        scattering=DEPTH / _SCALE_HEIGHT,
        phase_function=Rayleigh(),
    )


def rayleigh_sphere(run: SuiteRun) -> PublishedSection:
    """Albedo of the sphere against published and exact values."""
    ours, polarised = (
        float(
            geometric_albedo(
                run.solve(rayleigh_planet(), (_WAVELENGTH,), polarisation=polarisation)
            )[0]
        )
        for polarisation in (False, True)
    )
    names = ("Rayleigh sphere: geometric albedo", "geometric albedo of polarised light")
    dlugach = "Dlugach & Yanovitskij (1974), to a unit of the last digit"
    chandrasekhar = "Chandrasekhar (1950), sections 44 and 45"
    prather = "Prather (1974); 0.796 by Schmid et al. (2006)"
    exact = PublishedRow("geometric albedo, exact solution", exact_albedo(), ours, chandrasekhar)
    name, source = (
        "Rayleigh sphere: difference from the exact albedo",
        "accuracy that counts as done, energy",
    )
    return PublishedSection(
        title="Sphere of gas that absorbs nothing",
        rows=[
            PublishedRow(names[0], 0.751, ours, dlugach, error=0.001),
            exact,
            PublishedRow(names[1], 0.798, polarised, prather),
        ],
        aims=[Threshold(name, exact.percent, ALBEDO_THRESHOLD, "%", source)],
        note="Rayleigh's phase function without depolarisation, scalar transfer but in the last "
        "row; gas of optical depth 8 over white ground stands for gas without end, a sphere a "
        "thousand times the Earth for a plane.",
    )
