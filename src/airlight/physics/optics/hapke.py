r"""Hapke reflectance of regolith: grains, opposition surge and rough ground.

.. math:: r = \frac{w}{4 \pi} \frac{\mu_{0e}}{\mu_{0e} + \mu_e}
          \left[p(g) (1 + B(g)) + H(\mu_{0e}) H(\mu_e) - 1\right] S(i, e, \psi)

with the radiance r per normal irradiance, the phase angle g, the double Henyey-Greenstein phase
function p, the shadow-hiding opposition surge B, Hapke's (2002) approximation of Chandrasekhar's H
function, and effective cosines and shadowing S of mean slope θ̄ (Hapke 1984). Coherent backscatter
and porosity are left out: Sato et al. (2014) set them to 0 and 1.

As a law of the ground it is normalised so that the spherical albedo is ``albedo``: the grains give
the shape at all wavelengths, ``albedo`` the level and the colour.

References
----------
Hapke (1984), Icarus 59, 41. Hapke (2002), Icarus 157, 523. Hapke (2012), Theory of Reflectance and
Emittance Spectroscopy, 2nd edition, eqs. 12.46 to 12.55.
"""

from __future__ import annotations

from functools import lru_cache
from math import acos, exp, log, pi, radians, sqrt, tan
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import kernel, vectorized

FloatArray = NDArray[np.float64]

#: Published grains w, b, c, B₀, h [1] and mean slope θ̄ [deg].
#:
#: ``moon``: Sato et al. (2014), JGR Planets 119, 1775, at 643 nm: medians of w, b and h between
#: 30° S and 30° N in the LROC parameter map WAC_HAPKEPARAMMAP, c and B₀ by their eqs. 2 and 4, θ̄
#: of their Table 1. They print b = 0.26 and 0.23, h = 0.050 and 0.074 for maria and highlands.
#:
#: ``mars``: Vincendon (2013), Planetary and Space Science 76, 87, mean surface; its c of 0.6 is
#: taken as the share of the backward lobe, (1 + c)/2 here, as rovers' photometry counts it.
#:
#: ``triton``: Hillier et al. (1994), Icarus 109, 296, abstract: w of 0.98 or higher, asymmetries of
#: -0.35 to -0.45 for most units, θ̄ of 14°; the first end of these and 0.99 are taken, no surge.
REGOLITHS: Final = {
    "moon": (0.3854, 0.2375, 0.3253, 1.686, 0.0672, 23.4),
    "mars": (0.85, 0.12, 0.2, 1.0, 0.05, 17.0),
    "triton": (0.99, 0.35, 1.0, 0.0, 0.05, 14.0),
}

#: Slope below which ground is level. [1]
_LEVEL: Final = 1e-6
#: Points per axis of the integrals over the hemisphere.
_POINTS: Final = 48


class Regolith(NamedTuple):
    """Grains and roughness of the ground, and its directional albedo.

    Attributes
    ----------
    grain_albedo : float
        Single-scattering albedo w of a grain. [1]
    lobe, backward : float
        Asymmetry b of both lobes of its phase function, and the excess c of the backward lobe, of
        the share (1 + c)/2. [1]
    surge, surge_width : float
        Amplitude B₀ and angular width h of the opposition surge. [1]
    slope : float
        Tangent of the mean slope angle θ̄. [1]
    scale : float
        Reciprocal of its spherical albedo. [1]
    constant, linear, square, cube, level : float
        Fit of the directional albedo over the spherical albedo, see ``brdf_diffuse``. [1]
    """

    grain_albedo: float
    lobe: float
    backward: float
    surge: float
    surge_width: float
    slope: float
    scale: float
    constant: float
    linear: float
    square: float
    cube: float
    level: float


#: Regolith of the Moon: ``regolith(*REGOLITHS["moon"])``.
MOON: Final = Regolith(
    grain_albedo=0.3854,
    lobe=0.2375,
    backward=0.3253,
    surge=1.686,
    surge_width=0.0672,
    slope=0.43273864224742586,
    scale=8.954599633720342,
    constant=1.0792338424561692,
    linear=-0.49418011405060974,
    square=0.7527248064523618,
    cube=-0.47622916169460555,
    level=0.1089065290116546,
)


@kernel
def grain_phase(cosine, lobe, backward):
    """Double Henyey-Greenstein phase function of a grain, of mean 1 over the sphere. [1]

    Parameters
    ----------
    cosine : float
        Cosine of the phase angle. [1]
    lobe, backward : float
        Fields of ``Regolith``. [1]

    Examples
    --------
    >>> round(grain_phase(1.0, 0.2, 1.0), 6)  # (1 - b²)/(1 - b)³
    1.875
    """
    spread, twice = 1.0 + lobe * lobe, 2.0 * lobe * cosine
    back, ahead = spread - twice, spread + twice
    towards = 0.5 * (1.0 + backward) / (back * sqrt(back))
    away = 0.5 * (1.0 - backward) / (ahead * sqrt(ahead))
    return (1.0 - lobe * lobe) * (towards + away)


@kernel
def multiple_scattering(mu, grain_albedo):
    """Hapke's (2002) approximation of Chandrasekhar's H function, within 1 %. [1]

    Parameters
    ----------
    mu : float
        Cosine of incidence or emergence. [1]
    grain_albedo : float
        Single-scattering albedo. [1]

    References
    ----------
    Hapke (2002), Icarus 157, 523, eq. 13.

    Examples
    --------
    >>> round(multiple_scattering(1.0, 1.0), 3)  # Chandrasekhar (1960), table XI: 2.908
    2.885
    """
    x = max(mu, 1e-6)
    root = sqrt(max(1.0 - grain_albedo, 0.0))
    diffusive = (1.0 - root) / (1.0 + root)
    single = diffusive + 0.5 * (1.0 - 2.0 * diffusive * x) * log((1.0 + x) / x)
    return 1.0 / (1.0 - grain_albedo * x * single)


@kernel
def tilted(mu, slope):
    """Cosine of a slope that faces a beam of zenith cosine mu, over that of level ground. [1]

    η(x)/χ of Hapke (1984), eq. 47, and the exponentials E₁ and E₂.

    Returns
    -------
    eta, first, second : float
        η/χ, E₁ and E₂. [1]
    """
    sine = sqrt(max((1.0 - mu) * (1.0 + mu), 1e-12))
    steep = mu / (sine * slope)
    first = exp(-(2.0 / pi) * steep)
    second = exp(-steep * steep / pi)
    return mu + sine * slope * second / (2.0 - first), first, second


@kernel
def hapke_reflectance(mu_s, mu_r, cosine, regolith):
    """Reflectance factor of regolith, π times its BRDF, not normalised. [1]

    Parameters
    ----------
    mu_s, mu_r : float
        Cosines of incidence and emergence. [1]
    cosine : float
        Cosine of the phase angle. [1]
    regolith : Regolith
        Parameters of the ground.
    """
    incident, emergent = min(max(mu_s, 1e-6), 1.0), min(max(mu_r, 1e-6), 1.0)
    cosine = min(max(cosine, -1.0), 1.0)
    half_tangent = sqrt((1.0 - cosine) / max(1.0 + cosine, 1e-12))
    surge = regolith.surge / (1.0 + half_tangent / regolith.surge_width)
    slope, shadow = regolith.slope, 1.0 / incident
    lit, seen = incident, emergent
    if slope > _LEVEL:
        incident_sine = sqrt(max((1.0 - incident) * (1.0 + incident), 1e-12))
        emergent_sine = sqrt(max((1.0 - emergent) * (1.0 + emergent), 1e-12))
        turn = (cosine - incident * emergent) / (incident_sine * emergent_sine)
        turn = min(max(turn, -1.0), 1.0)
        if turn > 1.0 - 1e-12:  # below, roots would magnify a rounding at opposition
            turn = 1.0
        azimuth, folded = acos(turn) / pi, 0.5 * (1.0 - turn)
        same = exp(-2.0 * sqrt((1.0 - turn) / max(1.0 + turn, 1e-12)))
        chi = 1.0 / sqrt(1.0 + pi * slope * slope)
        incident_eta, incident_first, incident_second = tilted(incident, slope)
        emergent_eta, emergent_first, emergent_second = tilted(emergent, slope)
        if incident >= emergent:  # the sun is higher
            below = 2.0 - emergent_first - azimuth * incident_first
            lifted = (turn * emergent_second + folded * incident_second) / below
            lit = incident + incident_sine * slope * lifted
            lifted = (emergent_second - folded * incident_second) / below
            seen = emergent + emergent_sine * slope * lifted
            own = incident / incident_eta
        else:
            below = 2.0 - incident_first - azimuth * emergent_first
            lifted = (incident_second - folded * emergent_second) / below
            lit = incident + incident_sine * slope * lifted
            lifted = (turn * incident_second + folded * emergent_second) / below
            seen = emergent + emergent_sine * slope * lifted
            own = emergent / emergent_eta
        # S over μ₀, in which the factors χ of μₑ, η(e) and η(i) cancel.
        shadow = seen / (emergent_eta * incident_eta * (1.0 - same + same * own))
        lit, seen = chi * lit, chi * seen
    grains = grain_phase(cosine, regolith.lobe, regolith.backward) * (1.0 + surge)
    several = multiple_scattering(lit, regolith.grain_albedo)
    several = several * multiple_scattering(seen, regolith.grain_albedo) - 1.0
    return 0.25 * regolith.grain_albedo * lit / (lit + seen) * (grains + several) * shadow


@kernel
def brdf_direct(ground, mu_s, mu_r, nu):
    """Direct reflectance factor: that of Hapke over the spherical albedo, times the albedo.

    Parameters
    ----------
    mu_s, mu_r, nu : float
        Cosines as in ``reflection.direct_reflectance``. [1]

    Returns
    -------
    diffuse, specular : float
        Factor of the albedo, and part without it. [1]
    """
    return ground.regolith.scale * hapke_reflectance(mu_s, mu_r, -nu, ground.regolith), 0.0


@kernel
def brdf_diffuse(ground, mu_r):
    """Diffuse reflectance factor: c₀ + c₁ μ + c₂ μ² + c₃ μ³ + c₄ μ ln((1 + μ)/μ) times the albedo.

    A fit of the integral of ``brdf_direct`` over the hemisphere, within 0.5 % up to θ̄ = 30°.

    Parameters
    ----------
    mu_r : float
        Cosine as in ``reflection.diffuse_reflectance``. [1]

    Returns
    -------
    diffuse, specular : float
        Factor of the albedo, and part without it. [1]
    """
    x, fit = min(max(mu_r, 1e-9), 1.0), ground.regolith
    smooth = fit.constant + x * (fit.linear + x * (fit.square + x * fit.cube))
    return smooth + fit.level * x * log((1.0 + x) / x), 0.0


def largest_albedo(ground: Any) -> float:
    """Largest albedo whose directional albedo is at most 1 everywhere. [1]"""
    most = max(brdf_diffuse(ground, x)[0] for x in np.linspace(0.0, 1.0, 65).tolist())
    return float(1.0 / most)


@lru_cache(maxsize=64)
def regolith(
    grain_albedo: float,
    lobe: float,
    backward: float,
    surge: float,
    surge_width: float,
    roughness: float,
) -> Regolith:
    """Regolith with its spherical and directional albedo, by quadrature over the hemisphere.

    Parameters
    ----------
    grain_albedo, lobe, backward, surge, surge_width : float
        Fields of ``Regolith``. [1]
    roughness : float
        Mean slope angle θ̄, 0 to 45. [deg]
    """
    grains = (grain_albedo, lobe, backward, surge, surge_width, tan(radians(roughness)))
    bare = Regolith(*grains, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    nodes, weights = (0.5 * one for one in np.polynomial.legendre.leggauss(_POINTS))
    nodes += 0.5
    directional = directional_albedo(nodes, bare)
    spherical = 2.0 * float((weights * nodes) @ directional)
    x = nodes
    basis = np.stack([np.ones_like(x), x, x**2, x**3, x * np.log((1.0 + x) / x)], axis=-1)
    fit = np.linalg.lstsq(basis, directional / spherical, rcond=None)[0]
    fit /= 2.0 * float((weights * nodes) @ (basis @ fit))
    return Regolith(*grains, 1.0 / spherical, *fit.tolist())


def directional_albedo(mu: FloatArray, ground: Regolith) -> FloatArray:
    """Directional-hemispherical reflectance of regolith, by quadrature. [1]

    Parameters
    ----------
    mu : array, shape (n,)
        Cosines of incidence. [1]
    ground : Regolith
        Parameters; its fit is not read.
    """
    nodes, weights = (0.5 * one for one in np.polynomial.legendre.leggauss(_POINTS))
    nodes += 0.5
    # Azimuths crowd at 0, where the surge is.
    steps = nodes * nodes
    around = 2.0 * nodes * weights
    incident, emergent, turn = np.meshgrid(mu, nodes, np.cos(pi * steps), indexing="ij")
    sines = np.sqrt((1.0 - incident**2) * (1.0 - emergent**2))
    cosine = incident * emergent + sines * turn
    factor = reflectances(ground)(incident, emergent, cosine)
    return np.asarray(factor @ around @ (2.0 * weights * nodes))


def reflectances(ground: Regolith) -> Any:
    """Function of arrays: ``hapke_reflectance(mu_s, mu_r, cosine)`` of a regolith.

    Parameters
    ----------
    ground : Regolith
        Parameters; its fit is not read.
    """
    numbers = ground[:6]
    compiled = vectorized(_of_numbers)
    return lambda mu_s, mu_r, cosine: compiled(mu_s, mu_r, cosine, *numbers)


@kernel
def _of_numbers(mu_s, mu_r, cosine, grain_albedo, lobe, backward, surge, surge_width, slope):
    """``hapke_reflectance`` of numbers, for arrays. [1]"""
    ground = Regolith(
        grain_albedo, lobe, backward, surge, surge_width, slope, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0
    )
    return hapke_reflectance(mu_s, mu_r, cosine, ground)
