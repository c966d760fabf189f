r"""Reflection of a surface without air, by the laws of whole spheres of ``moon_phase``.

Radiance per irradiance E on a plane that faces the light, with the cosines μ₀ of incidence and μ of
emergence, and an albedo A (Lambert) or geometric albedo p:

.. math:: L = E \frac{A}{\pi} \mu_0, \qquad L = E \frac{2 p}{\pi} \frac{\mu_0}{\mu_0 + \mu}, \qquad
          L = E \frac{p}{\pi} \frac{r(\mu_0, \mu, \alpha)}{p_1} \mu_0

for Lambert's law, the Lommel-Seeliger law, which makes the full disc uniform, and Hapke's, with the
reflectance factor r and geometric albedo p₁ of the Moon's regolith.
"""

from __future__ import annotations

from math import pi
from typing import Final

from airlight.kernel import kernel
from airlight.kernel.choice import chosen_kernel
from airlight.physics.optics.moon_phase import moon_disc, moon_reflectance


@kernel
def lambert_factor(lit, leaving, cosine):
    """Factor of Lambert's law. [sr⁻¹]

    Examples
    --------
    >>> round(pi * lambert_factor(0.5, 1.0, 0.5), 6)
    0.5
    """
    return lit / pi


@kernel
def lommel_seeliger_factor(lit, leaving, cosine):
    """Factor of the Lommel-Seeliger law. [sr⁻¹]"""
    return 2.0 / pi * lit / max(lit + leaving, 1e-30)


@kernel
def regolith_factor(lit, leaving, cosine):
    """Factor of Hapke's law for the Moon. [sr⁻¹]"""
    return moon_reflectance(lit, leaving, cosine) * lit / pi


#: Factors by the name of the law.
SURFACE_FACTORS: Final = {
    "lambert": lambert_factor,
    "lommel-seeliger": lommel_seeliger_factor,
    "moon": regolith_factor,
}
_factor = chosen_kernel("factor_of_law", list(SURFACE_FACTORS.values()), __name__)


@kernel
def surface_factor(law, lit, leaving, cosine):
    """Reflected radiance over irradiance, for the albedo ``albedo_unit``. [sr⁻¹]

    Parameters
    ----------
    law : int
        Number of the law in ``SURFACE_FACTORS``.
    lit, leaving : float
        Cosines of incidence, a mean over the disc of the light, and of emergence, at least 0. [1]
    cosine : float
        Cosine of the phase angle. [1]

    Examples
    --------
    >>> round(pi * surface_factor(1, 0.5, 1.0, 0.5), 6)
    0.666667
    """
    return _factor(law, lit, leaving, cosine)


def law_number(law: str) -> int:
    """Number of a law in ``SURFACE_FACTORS``."""
    return list(SURFACE_FACTORS).index(law)


def albedo_unit(law: str) -> float:
    """Albedo, or geometric albedo, that ``surface_factor`` of a law has. [1]

    Examples
    --------
    >>> albedo_unit("lambert")
    1.0
    """
    return float(moon_disc(0.0)) if law == "moon" else 1.0
