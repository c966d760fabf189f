"""Shading of a disc in a pixel: limb darkening of stars; phase, ground and earthshine of the Moon.

Radiance over its mean is a polynomial in the cosine of emergence μ for each wavelength
(``spectra.limb_darkening``); for the Moon times Hapke's law, normalised to mean 1, so that the
irradiance is conserved, times the reflectance of its near side over its mean, the table ``face``.
Earthshine lights the disc evenly: source and observer are both at the Earth.
"""

from __future__ import annotations

from math import cos, pi, sin, sqrt
from typing import Final, NamedTuple

import numpy as np

from airlight.kernel import inlined, kernel
from airlight.kernel.lanes import lane_view
from airlight.physics.optics.moon_phase import earthlight, moon_disc, moon_reflectance

#: Number of powers of μ, from 0: as many as ``limb_darkening.COEFFICIENTS``.
POWERS: Final = 6
#: Abscissa of the two-point Gauss rule.
_GAUSS: Final = 3.0**-0.5


#: Uniforms of a moon's shading: phase, and direction of the bright limb.
SHADING: Final = (
    "phase_sine",
    "phase_cosine",
    "phase_share",
    "phase_earth",
    "limb_x",
    "limb_y",
    "limb_z",
)
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
    >>> half["limb_x"], half["limb_z"], round(half["phase_earth"], 4)  # earthshine, of the mean
    (-0.0, 1.0, 0.0004)
    """
    if phase is None:
        return dict.fromkeys(("phased", *SHADING), 0.0)
    values = phase_shading(phase, limb, sun_level, sun_z)
    return {"phased": 1.0, **dict(zip(SHADING, values, strict=True))}


def phase_shading(
    phase: float, limb: float, sun_level: float, sun_z: float
) -> tuple[float, float, float, float, float, float, float]:
    """Values of ``SHADING`` for the Moon; also emitted as JavaScript.

    Parameters
    ----------
    phase, limb, sun_level, sun_z : float
        Arguments of ``shading_uniforms``.
    """
    turn, angle = limb * pi / 180.0, phase * pi / 180.0
    sunlit, earthlit = moon_disc(phase), earthlight(phase) * moon_disc(0.0)
    whole = max(sunlit + earthlit, 1e-12)
    return (
        sin(angle),
        cos(angle),
        1.0 / whole,
        earthlit / whole,
        -sun_z * cos(turn),
        -sin(turn),
        sun_level * cos(turn),
    )


class MoonPhase(NamedTuple):
    """Phase of the Moon.

    Attributes
    ----------
    sine, cosine : float
        Of the phase angle. [1]
    share, earth : float
        Reciprocal of the mean of ``moon_reflectance`` times the cosine of incidence over the disc,
        earthshine included; radiance by earthshine over the mean. [1]
    """

    sine: float
    cosine: float
    share: float
    earth: float


class DiscPowers(NamedTuple):
    """Means of μ^k, k = 0 to 5, over a part of a disc, times a radiance per irradiance. [sr⁻¹]"""

    p0: float
    p1: float
    p2: float
    p3: float
    p4: float
    p5: float


class DiscPlace(NamedTuple):
    """Place of a pixel on the disc of a moon, in radii.

    Attributes
    ----------
    toward, aside : float
        Coordinates towards the bright limb, and to the right of it. [1]
    step : float
        Size of the pixel; 0 for a disc without a face. [1]
    """

    toward: float
    aside: float
    step: float


@kernel
def moon_shade(mu, toward, phase):
    r"""Radiance of the Moon over the mean of its whole disc. [1]

    .. math:: \frac{L}{\bar L} = \frac{r(\mu_0, \mu, \alpha) \, \mu_0}{p \Phi(\alpha)} + e, \qquad
              \mu_0 = t \sin\alpha + \mu \cos\alpha

    Parameters
    ----------
    mu : float
        Cosine of emergence. [1]
    toward : float
        Coordinate t towards the bright limb, in radii. [1]
    phase : MoonPhase
        Phase of the Moon.
    """
    lit = toward * phase.sine + mu * phase.cosine
    if lit <= 0.0:
        return phase.earth
    return phase.share * moon_reflectance(lit, mu, phase.cosine) * lit + phase.earth


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


@kernel
def face_level(step, rows):
    """First row and size of a level of a pyramid of faces, whose texels match a pixel.

    Level l has rows / 2^l rows and columns, and follows the finer ones.

    Parameters
    ----------
    step : float
        Size of the pixel, in radii. [1]
    rows : int
        Rows of the finest level, a power of two.

    Examples
    --------
    >>> face_level(0.02, 128), face_level(0.1, 128)  # pixels of 1.3 and of 6.4 texels
    ((0, 128), (224, 16))
    """
    texels = 0.7 * 0.5 * rows * step
    first, size = 0, rows
    while texels > 1.0 and size > 4:
        first, size, texels = first + size, size // 2, 0.5 * texels
    return first, size


@kernel
def face_place(coordinate, size):
    """Position of a coordinate, from -1 to 1, between the centres of a level's texels. [1]"""
    return min(max(0.5 * (1.0 + coordinate) * size - 0.5, 0.0), size - 1.0)


@inlined
def darkened(powers, place, tables, at):
    """Unattenuated radiance of the disc in a pixel, per irradiance. [sr⁻¹]

    Parameters
    ----------
    powers, place : DiscPowers, DiscPlace
        Results of ``star_disc``.
    tables : MarchTables
        Tables of the solution, with ``darkening`` and ``face``.
    at : int
        Index of the first lane.
    """
    darkening = lane_view(tables.darkening, at)
    total = darkening[0] * np.float32(powers.p0) + darkening[1] * np.float32(powers.p1)
    total = total + darkening[2] * np.float32(powers.p2) + darkening[3] * np.float32(powers.p3)
    total = total + darkening[4] * np.float32(powers.p4) + darkening[5] * np.float32(powers.p5)
    if place.step > 0.0:
        face = lane_view(tables.face, at)
        first, size = face_level(place.step, tables.face.shape[1])
        row, column = face_place(-place.toward, size), face_place(place.aside, size)
        above, left = int(row), int(column)
        below, right = min(above + 1, size - 1), min(left + 1, size - 1)
        down, across = np.float32(row - above), np.float32(column - left)
        upper = face[first + above, left] * (np.float32(1.0) - across)
        upper = upper + face[first + above, right] * across
        lower = face[first + below, left] * (np.float32(1.0) - across)
        lower = lower + face[first + below, right] * across
        total = total * (upper * (np.float32(1.0) - down) + lower * down)
    return total
