"""Fit of a density profile by an exponential or a tent with the same vertical column.

Scale height, or centre and width, are the least squares fit of the column above each altitude,
which attenuates sunlight. Fits of the mean altitude, or of slant columns at sunset, change colours
of the sky of Earth and Mars by 0.25 ΔE.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import minimize, minimize_scalar

from airlight.errors import ParameterError
from airlight.planets.matter.profiles import Exponential, Profile, Tent

FloatArray = NDArray[np.float64]

#: Zenith angles at which the air mass of a fit is compared. [deg]
ZENITH_ANGLES: Final = (75.0, 88.0)
#: Limits of scale heights and widths, over the thickness of the shell. [1]
_NARROWEST: Final = 1e-3
_WIDEST: Final = 10.0
_NODES: Final = 8001


@dataclass(frozen=True, eq=False, kw_only=True)
class VerticalProfile:
    """Density profile at nodes, in any unit.

    Parameters
    ----------
    altitudes : array, shape (n,)
        Altitudes, ascending from 0 to the shell's thickness. [m]
    densities : array, shape (n,)
        Densities, not all 0.
    bottom_radius : float
        Radius of the ground. [m]
    """

    altitudes: FloatArray
    densities: FloatArray
    bottom_radius: float

    @classmethod
    def sampled(
        cls, density: Callable[[FloatArray], ArrayLike], thickness: float, bottom_radius: float
    ) -> VerticalProfile:
        """Profile sampled from a function, more densely towards the ground.

        Parameters
        ----------
        density : callable
            Density of altitudes [m], shape (n,) to (n,).
        thickness, bottom_radius : float
            Thickness of the shell, and radius of the ground. [m]

        Raises
        ------
        ParameterError
            If the density is 0 everywhere.
        """
        h = thickness * np.linspace(0.0, 1.0, _NODES) ** 2
        values = np.asarray(density(h), float)
        if not values.max() > 0.0:
            raise ParameterError("density", 0.0, "above 0 somewhere in the shell")
        return cls(altitudes=h, densities=values, bottom_radius=bottom_radius)

    @property
    def thickness(self) -> float:
        """Thickness of the shell. [m]"""
        return float(self.altitudes[-1])

    @cached_property
    def above(self) -> FloatArray:
        """Fraction of the column above each altitude, shape (n,), 1 at the ground. [1]"""
        return _above(self.altitudes, self.densities)

    def air_mass(self, zenith_angle: float) -> float:
        """Air mass: slant column from the ground over the vertical column. [1]

        Parameters
        ----------
        zenith_angle : float
            Zenith angle of the line, below 90. [deg]

        Examples
        --------
        >>> flat = VerticalProfile.sampled(lambda h: np.exp(-h / 8e3), 1e5, 1e12)
        >>> f"{flat.air_mass(60.0):.4f}"  # 1/cos
        '2.0000'
        """
        r = self.bottom_radius + self.altitudes
        sine = self.bottom_radius / r * np.sin(np.radians(zenith_angle))
        along = self.densities / np.sqrt((1.0 - sine) * (1.0 + sine))
        vertical = np.trapezoid(self.densities, self.altitudes)
        return float(np.trapezoid(along, self.altitudes) / vertical)

    def of(self, profile: Profile) -> VerticalProfile:
        """Profile of another density at the same nodes."""
        from airlight.physics.optics.density_profile import DensitySegments

        row = profile.row(self.thickness)
        densities = DensitySegments.from_rows([row]).at(self.altitudes)[0]
        return VerticalProfile(
            altitudes=self.altitudes, densities=densities, bottom_radius=self.bottom_radius
        )

    def errors(self, profile: Profile) -> dict[str, float]:
        """Errors of a fit by quantity, for ``FittedFormula``."""
        fit = self.of(profile)
        found = {
            "column above an altitude, largest, of the whole": float(
                np.abs(fit.above - self.above).max()
            )
        }
        for angle in ZENITH_ANGLES:
            ratio = fit.air_mass(angle) / self.air_mass(angle)
            found[f"column at zenith angle {angle:g} deg, relative"] = ratio - 1.0
        return found


def _above(altitudes: FloatArray, densities: FloatArray) -> FloatArray:
    pieces = 0.5 * (densities[1:] + densities[:-1]) * np.diff(altitudes)
    above = np.concatenate([np.cumsum(pieces[::-1])[::-1], [0.0]])
    return above / max(float(above[0]), 1e-300)


def fit_exponential(profile: VerticalProfile) -> Exponential:
    """Least squares fit of the columns above all altitudes by an exponential.

    Examples
    --------
    >>> air = VerticalProfile.sampled(lambda h: np.exp(-h / 8e3), 1e5, 6.36e6)
    >>> f"{fit_exponential(air).scale_height:.1f}"
    '8000.0'
    """
    h, thickness = profile.altitudes, profile.thickness

    def error(logarithm: float) -> float:
        height = np.exp(logarithm)
        fit = (np.exp(-h / height) - np.exp(-thickness / height)) / -np.expm1(-thickness / height)
        return float(np.trapezoid((fit - profile.above) ** 2, h))

    limits = np.log([_NARROWEST * thickness, _WIDEST * thickness])
    found: Any = minimize_scalar(error, bounds=limits, method="bounded", options={"xatol": 1e-9})
    return Exponential(scale_height=float(np.exp(found.x)))


def fit_tent(profile: VerticalProfile) -> Tent:
    """Least squares fit of the columns above all altitudes by a tent.

    Examples
    --------
    >>> ozone = VerticalProfile.sampled(
    ...     lambda h: np.maximum(0.0, 1.0 - abs(h - 25e3) / 15e3), 1e5, 6.36e6)
    >>> tent = fit_tent(ozone)
    >>> f"{tent.center:.0f} {tent.half_width:.0f}"
    '25000 15000'
    """
    h, thickness = profile.altitudes, profile.thickness
    column = np.trapezoid(profile.densities, h)
    mean = float(np.trapezoid(h * profile.densities, h) / column)
    variance = float(np.trapezoid((h - mean) ** 2 * profile.densities, h) / column)
    narrowest, widest = _NARROWEST * thickness, _WIDEST * thickness

    def tent(numbers: FloatArray) -> tuple[float, float]:
        return (
            float(np.clip(numbers[0], 0.0, thickness)),
            float(np.clip(numbers[1], narrowest, widest)),
        )

    def error(numbers: FloatArray) -> float:
        center, half_width = tent(numbers)
        density = np.maximum(0.0, 1.0 - np.abs(h - center) / half_width)
        return float(np.trapezoid((_above(h, density) - profile.above) ** 2, h)) / thickness

    # The variance of a triangle is a sixth of its half width's square.
    start = np.array([mean, max(np.sqrt(6.0 * variance), 2.0 * narrowest)])
    scale = 0.2 * start[1]
    simplex = start + scale * np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    found: Any = minimize(
        error, start, method="Nelder-Mead",
        options={"initial_simplex": simplex, "xatol": 1e-6 * thickness, "fatol": 1e-14},
    )  # fmt: skip
    center, half_width = tent(found.x)
    return Tent(center=center, half_width=half_width)
