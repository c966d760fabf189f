"""Surface albedo of a region, relative to the planetary mean."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from airlight.image.upsampling import reflectance_basis
from airlight.physics.optics.water import mean_specular

FloatArray = npt.NDArray[np.float64]


class GroundMeans(NamedTuple):
    """Means of a map of the ground, over a region or over the whole planet.

    Attributes
    ----------
    color : tuple of float, length 3
        Linear sRGB reflectance. [1]
    water : float
        Fraction of water. [1]
    cover : float
        Cloud cover. [1]
    """

    color: tuple[float, float, float]
    water: float
    cover: float

    def reflectances(self, wavelengths: npt.ArrayLike, wind: float | None) -> FloatArray:
        """Reflectance under a uniform sky, without clouds, shape (nl,). [1]

        Parameters
        ----------
        wavelengths : array, shape (nl,)
            Wavelengths. [nm]
        wind : float or None
            Wind speed over water, whose reflection is then specular. [m s⁻¹]
        """
        known = np.clip(reflectance_basis(wavelengths) @ np.asarray(self.color), 0.0, 1.0)
        specular = 0.0 if wind is None else float(mean_specular(wind))
        return np.asarray(known + self.water * specular)


@dataclass(frozen=True, kw_only=True)
class LocalGround:
    """Surface albedo around an observer, and that of the whole planet.

    Parameters
    ----------
    latitude, longitude : float
        Coordinates of the point below the observer, north and east positive. [deg]
    altitude : float
        Altitude of the observer. [m]
    reach : float
        Radius of half of the weight, along the ground. [m]
    here, planet : GroundMeans
        Weighted means over the region, and means over the planet.
    """

    latitude: float
    longitude: float
    altitude: float
    reach: float
    here: GroundMeans
    planet: GroundMeans

    def ratio(self, wavelengths: npt.ArrayLike, wind: float | None) -> FloatArray:
        """Reflectance over that of the planet, shape (nl,); 1 where the planet's is 0. [1]"""
        here = self.here.reflectances(wavelengths, wind)
        planet = self.planet.reflectances(wavelengths, wind)
        return np.asarray(np.divide(here, planet, out=np.ones_like(here), where=planet > 0.0))

    def __str__(self) -> str:
        north = f"{abs(self.latitude):.4g}°{'N' if self.latitude >= 0.0 else 'S'}"
        east = f"{abs(self.longitude):.4g}°{'E' if self.longitude >= 0.0 else 'W'}"
        return (
            f"{north} {east}, seen by the air of an observer at {self.altitude:.4g} m, half of it "
            f"within {self.reach / 1e3:.3g} km"
        )
