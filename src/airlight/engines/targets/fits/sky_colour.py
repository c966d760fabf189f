"""Factors from radiance at three wavelengths to linear sRGB, for programs with one per channel.

Bruneton assumes that sky radiance is sunlight times λ⁻³; here the factors are fitted to the colours
of the planet's sky.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

from airlight.engines.targets.target import FittedFormula
from airlight.image.color_difference import color_difference
from airlight.image.spectral import EYE, eye_rgb, irradiance_at, on_eye_grid
from airlight.planets.picture_wavelengths import picture_wavelengths
from airlight.solver.lines_of_sight import LinesOfSight
from airlight.solver.solution import Solution
from airlight.solver.solve import solve

FloatArray = NDArray[np.float64]

#: Zenith angles of the sun and of views, and azimuths, of the skies in the comparison. [deg]
_SUNS: Final = (20.0, 45.0, 70.0, 85.0)
_VIEWS: Final = (10.0, 35.0, 60.0, 80.0)
_AROUND: Final = (20.0, 90.0, 180.0)
#: Number of wavelengths of the colours: within 0.1 (delta E 2000) of those with sixteen.
_COUNT: Final = "four"
#: Radiance per irradiance below which a sky is not compared. [sr⁻¹]
_DARK: Final = 1e-6
#: Largest logarithm of a factor relative to Bruneton's: a sky without blue does not determine
#: blue's.
_FAR: Final = 0.5
#: Bruneton's exponent of the wavelength.
_POWER: Final = -3.0


@dataclass(frozen=True, kw_only=True, eq=False)
class SkyColour:
    """Factors of the channels.

    Attributes
    ----------
    sky, sun : array, shape (3,)
        Linear sRGB per spectral radiance of sky and star. [nm]
    fitted : tuple of FittedFormula
        Report of the fit.
    """

    sky: FloatArray
    sun: FloatArray
    fitted: tuple[FittedFormula, ...]


def channel_factors(wavelengths: FloatArray, spectrum: FloatArray, power: float) -> FloatArray:
    r"""Factors for the star's spectrum times a power of the wavelength, shape (3,). [nm]

    .. math:: k_c = \int \bar c(\lambda)\, \frac{E(\lambda)}{E(\lambda_c)}
              \left(\frac{\lambda}{\lambda_c}\right)^p d\lambda

    Parameters
    ----------
    wavelengths : array, shape (3,)
        Wavelengths of red, green and blue. [nm]
    spectrum : array, shape (471,)
        Irradiance E of the star at 360 to 830 nm, in any unit.
    power : float
        Power p: 0 for the star. [1]

    References
    ----------
    Bruneton (2017), ``model.cc``, ComputeSpectralRadianceToLuminanceFactors.

    Examples
    --------
    >>> grey = channel_factors(np.array([680.0, 550.0, 440.0]), np.ones(471), 0.0)
    >>> (grey / grey[1]).round(2)  # equal energy is redder than D65
    array([1.27, 1.  , 0.96])
    """
    slope = (EYE[:, None] / wavelengths) ** power
    at = np.interp(wavelengths, EYE, spectrum)
    return np.asarray((spectrum @ (eye_rgb() * slope)) / at)


def fit_sky_colour(solution: Solution) -> SkyColour:
    """Factors of a planet's sky and star.

    Those of the sky minimise the mean CIE DE 2000 over the daytime sky from a solution at four
    wavelengths. Without a planet, or with an opaque atmosphere, Bruneton's power is used.

    Parameters
    ----------
    solution : Solution
        Solution at three wavelengths, the longest first.
    """
    nm = solution.wavelengths
    source = solution.lights[0]
    spectrum = on_eye_grid(source.spectrum)
    # The samples may differ from the spectrum, of which only the shape matters.
    scale = irradiance_at(nm, source.spectrum) / source.irradiance
    sun, sky = (
        channel_factors(nm, spectrum, power) * scale / scale.mean() for power in (0.0, _POWER)
    )
    if solution.planet is None:
        return SkyColour(sky=sky, sun=sun, fitted=())
    more = solve(solution.planet, picture_wavelengths(solution.planet, _COUNT), "preview")
    light = solution.relative_radiance(_lines(solution)) * source.irradiance
    colours = more.relative_radiance(_lines(more)) @ more.lights[0].colors()
    seen = (light > _DARK * source.irradiance).all(axis=-1)
    if not seen.any():
        return SkyColour(sky=sky, sun=sun, fitted=())
    light, colours = light[seen], colours[seen]

    def mean(logarithms: FloatArray) -> float:
        return float(color_difference(light * np.exp(logarithms), colours).mean())

    start = np.log(sky)
    near = [(one - _FAR, one + _FAR) for one in start]
    found = minimize(mean, start, method="Nelder-Mead", bounds=near, options={"xatol": 1e-4})
    best = np.exp(found.x)
    differences = color_difference(light * best, colours)
    fitted = FittedFormula(
        name="colour of the sky",
        form="one factor for each of three wavelengths",
        parameters={
            f"luminance per radiance at {one:g} nm [lm nm/W]": 683.0 * value
            for one, value in zip(nm, best, strict=True)
        },
        errors={
            "delta E 2000, median": float(np.median(differences)),
            "delta E 2000, largest": float(differences.max()),
        },
        where=f"sky from the ground, sun at {', '.join(f'{one:g}' for one in _SUNS)} deg from the "
        "zenith",
    )
    return SkyColour(sky=best, sun=sun, fitted=(fitted,))


def _lines(solution: Solution) -> LinesOfSight:
    sun, view, around = np.meshgrid(_SUNS, _VIEWS, _AROUND, indexing="ij")
    lines, _ = solution.lines_of_sight(
        altitude=0.0, sun_zenith=sun, view_zenith=view, azimuth=around
    )
    return lines
