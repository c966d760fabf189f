"""Shading of a disc in a pixel: limb darkening of stars, phase of moons.

Radiance over its mean is a polynomial in the cosine of emergence μ for each wavelength
(``spectra.limb_darkening``); for moons times the Lommel-Seeliger law, normalised to mean 1, so that
the irradiance is conserved.
"""

from __future__ import annotations

from math import cos, pi, sin, sqrt
from typing import Final, NamedTuple

import numpy as np

from airlight.kernel import inlined, kernel
from airlight.kernel.lanes import lane_view
from airlight.physics.optics.moon_phase import dusty_sphere

#: Number of powers of μ, from 0: as many as ``limb_darkening.COEFFICIENTS``.
POWERS: Final = 6
#: Abscissa of the two-point Gauss rule.
_GAUSS: Final = 3.0**-0.5


#: Uniforms of a moon's shading: phase, and direction of the bright limb.
SHADING: Final = ("phase_sine", "phase_cosine", "phase_share", "limb_x", "limb_y", "limb_z")
#: Uniforms of an occulting moon: direction and angular radius.
OCCULTER: Final = ("occulter_x", "occulter_y", "occulter_z", "occulter_radius")


def shading_uniforms(
    phase: float | None, limb: float, sun_level: float, sun_z: float
) -> dict[str, float]:
    """Uniforms of a disc's shading.

    Parameters
    ----------
    phase, limb : float or None, float
        Fields of ``LightSource``. [deg]
    sun_level, sun_z : float
        Horizontal and vertical component towards the light. [1]

    Examples
    --------
    >>> half = shading_uniforms(90.0, 0.0, 1.0, 0.0)  # on the horizon, lit from above
    >>> half["limb_x"], half["limb_z"], round(half["phase_share"], 2)
    (-0.0, 1.0, 5.31)
    """
    if phase is None:
        return dict.fromkeys(("phased", *SHADING), 0.0)
    values = phase_shading(phase, limb, sun_level, sun_z)
    return {"phased": 1.0, **dict(zip(SHADING, values, strict=True))}


def phase_shading(
    phase: float, limb: float, sun_level: float, sun_z: float
) -> tuple[float, float, float, float, float, float]:
    """Values of ``SHADING`` for a moon; also emitted as JavaScript.

    Parameters
    ----------
    phase, limb, sun_level, sun_z : float
        Arguments of ``shading_uniforms``.
    """
    turn, angle = limb * pi / 180.0, phase * pi / 180.0
    return (
        sin(angle),
        cos(angle),
        2.0 / max(dusty_sphere(phase), 1e-12),
        -sun_z * cos(turn),
        -sin(turn),
        sun_level * cos(turn),
    )


class MoonPhase(NamedTuple):
    """Phase of a moon: sine and cosine of the phase angle α, and 2 / Φ(α) of ``dusty_sphere``."""

    sine: float
    cosine: float
    share: float


class DiscPowers(NamedTuple):
    """Means of μ^k, k = 0 to 5, over a part of a disc, times a radiance per irradiance. [sr⁻¹]"""

    p0: float
    p1: float
    p2: float
    p3: float
    p4: float
    p5: float


@kernel
def moon_shade(mu, toward, phase):
    r"""Radiance of a Lommel-Seeliger sphere over the mean of its whole disc. [1]

    .. math:: \frac{L}{\bar L} = \frac{2}{\Phi(\alpha)} \frac{\mu_0}{\mu_0 + \mu}, \qquad
              \mu_0 = t \sin\alpha + \mu \cos\alpha

    Parameters
    ----------
    mu : float
        Cosine of emergence. [1]
    toward : float
        Coordinate t towards the bright limb, in radii. [1]
    phase : MoonPhase
        Phase of the moon. [1]

    References
    ----------
    Hapke (2012), Theory of Reflectance and Emittance Spectroscopy, eqs. 8.35 and 11.46.

    Examples
    --------
    >>> moon_shade(0.3, 0.8, MoonPhase(0.0, 1.0, 2.0))  # the full disc is even
    1.0
    """
    lit = toward * phase.sine + mu * phase.cosine
    if lit <= 0.0:
        return 0.0
    return phase.share * lit / (lit + max(mu, 0.0))


@inlined
def whole_powers(share):
    """Means of the powers of μ over a whole disc, times ``share``; see ``disc_powers``."""
    two = share * 2.0
    return DiscPowers(share, two / 3.0, share / 2.0, two / 5.0, share / 3.0, two / 7.0)


@kernel
def disc_powers(share, apart, radius, pixel, along, phased, phase):
    """Means of μ^k over the part of a disc in a pixel, times ``share`` and ``moon_shade``. [sr⁻¹]

    Two-point Gauss rule in the squared radius between the inner and outer edge of the pixel,
    clipped at the rim.

    Parameters
    ----------
    share : float
        Radiance of a uniform disc in the pixel, per irradiance. [sr⁻¹]
    apart, radius, pixel : float
        Angles: from the disc's centre to the pixel, radius of the disc, size of the pixel. [rad]
    along : float
        Cosine of the position angle between pixel and bright limb. [1]
    phased : bool
        Whether the disc is a moon's.
    phase : MoonPhase
        Its phase.
    """
    inner = min(max(apart - 0.5 * pixel, 0.0) / radius, 1.0)
    outer = min((apart + 0.5 * pixel) / radius, 1.0)
    middle = 0.5 * (inner * inner + outer * outer)
    half = 0.5 * (outer - inner) * (outer + inner)
    p0, p1, p2, p3, p4, p5 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for point in range(2):
        square = middle + (2.0 * point - 1.0) * _GAUSS * half
        mu = sqrt(max(1.0 - square, 0.0))
        part = 0.5 * share
        if phased:
            part *= moon_shade(mu, sqrt(square) * along, phase)
        p0 += part
        p1 += part * mu
        p2 += part * mu * mu
        p3 += part * mu * mu * mu
        p4 += part * (mu * mu) * (mu * mu)
        p5 += part * (mu * mu) * (mu * mu) * mu
    return DiscPowers(p0, p1, p2, p3, p4, p5)


@inlined
def darkened(powers, tables, at):
    """Unattenuated radiance of the disc in a pixel, per irradiance. [sr⁻¹]

    Parameters
    ----------
    powers : DiscPowers
        Result of ``disc_powers``. [sr⁻¹]
    tables : MarchTables
        Tables of the solution, with ``darkening``.
    at : int
        Index of the first lane.
    """
    darkening = lane_view(tables.darkening, at)
    total = darkening[0] * np.float32(powers.p0) + darkening[1] * np.float32(powers.p1)
    total = total + darkening[2] * np.float32(powers.p2) + darkening[3] * np.float32(powers.p3)
    return total + darkening[4] * np.float32(powers.p4) + darkening[5] * np.float32(powers.p5)
