"""The ground below the air and the star above it."""

from __future__ import annotations

import math
from typing import Annotated, Any, Final

import numpy as np
import numpy.typing as npt
from pydantic import BeforeValidator, ValidationInfo

from airlight.constants import ASTRONOMICAL_UNIT, SOLAR_RADIUS
from airlight.errors import ParameterError
from airlight.planets.parameters import MISSING, between, parameters
from airlight.planets.spectral import (
    EVERYWHERE,
    Limits,
    Spectral,
    check_spectral,
    spectral,
    spectral_at,
    spectral_limits,
    table_limits,
)

FloatArray = npt.NDArray[np.float64]

#: The spectrum that stands for the sun, as measured at 1 au.
SUN: Final = "astm-g173"


def _albedo(value: Any, info: ValidationInfo) -> Any:
    """A number, values per wavelength, or the name of a table of reflectances."""
    from airlight.spectra.tables import read_spectrum, spectrum_names

    if not isinstance(value, str):
        return check_spectral(value, "albedo", 0.0, 1.0)
    tables = [read_spectrum(name) for name in spectrum_names()]
    reflectances = [table.name for table in tables if table.unit == "1" and table.values.ndim == 1]
    if value not in reflectances:
        raise ParameterError("albedo", value, ", ".join(["0 to 1", *reflectances]))
    return value


@parameters
class Ground:
    """A ground that reflects alike into all directions (Lambert).

    Parameters
    ----------
    albedo : float, PerWavelength or str
        Share of light that is reflected, 0 to 1, or the name of a table of it. [1]
    map : str, optional
        Name of a picture of the ground, used where the ground is seen; the light that the ground
        sends back into the air comes from ``albedo``.
    """

    albedo: Annotated[Any, BeforeValidator(_albedo)] = 0.0
    map: str | None = None

    def __post_init__(self) -> None:
        if self.map is not None and not 1 <= len(self.map) <= 100:
            raise ParameterError("map", self.map, "a name of 1 to 100 letters")

    @property
    def limits(self) -> Limits:
        """The wavelengths at which the albedo is known. [nm]"""
        if isinstance(self.albedo, str):
            return table_limits(self.albedo)
        return spectral_limits(self.albedo)

    def albedos(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """The albedo, shape (nl,). [1]"""
        if not isinstance(self.albedo, str):
            return spectral_at(self.albedo, wavelengths)
        from airlight.spectra.tables import read_spectrum

        return np.clip(read_spectrum(self.albedo).at(wavelengths), 0.0, 1.0)


@parameters
class Star:
    """The light that comes in: a measured spectrum, given values, or a black body.

    Exactly one of ``spectrum``, ``irradiance`` and ``temperature`` is given.

    Parameters
    ----------
    spectrum : str, optional
        ``"astm-g173"``, the sun at 1 au; it is scaled to ``distance``.
    irradiance : float or PerWavelength, optional
        At the planet, 0 to 1e9. [W m⁻² nm⁻¹]
    temperature : float, optional
        Of a black body, seen at ``distance``; needs ``radius``. [K]
    distance : float, optional
        From the star to the planet; 1 au if the spectrum is the sun's. [m]
    radius : float, optional
        Of the star; the nominal solar radius if the spectrum is the sun's. [m]
    angular_radius : float, optional
        Half the angle that the star fills in the sky, 0 (a point) to 30; from radius and
        distance if it is not given. [deg]

    Examples
    --------
    >>> f"{Star(spectrum='astm-g173').angular_radius_degrees:.4f}"
    '0.2665'
    """

    spectrum: str | None = None
    irradiance: Annotated[Spectral, spectral(0.0, 1e9, "W/m^2/nm")] | None = None
    temperature: Annotated[float, between(100.0, 1e6, "K")] | None = None
    distance: Annotated[float, between(1e6, 1e16, "m")] | None = None
    radius: Annotated[float, between(1e3, 1e13, "m")] | None = None
    angular_radius: Annotated[float, between(0.0, 30.0, "deg")] | None = None

    def __post_init__(self) -> None:
        kinds = {
            "spectrum": self.spectrum,
            "irradiance": self.irradiance,
            "temperature": self.temperature,
        }
        given = [name for name, value in kinds.items() if value is not None]
        if len(given) != 1:
            shown = " and ".join(given) if given else MISSING
            raise ParameterError("light", shown, "one of spectrum, irradiance, temperature")
        if self.spectrum is not None and self.spectrum != SUN:
            raise ParameterError("spectrum", self.spectrum, f"{SUN!r}")
        if self.temperature is not None:
            for name in ("distance", "radius"):
                if getattr(self, name) is None:
                    raise ParameterError(name, MISSING, "a length, beside a temperature")
        if self.irradiance is not None and self.distance is not None and self.radius is None:
            raise ParameterError("distance", self.distance, "none beside an irradiance")
        if self._radius is not None and self._distance is not None:
            if self._radius > 0.5 * self._distance:
                raise ParameterError("radius", self._radius, "at most half the distance")
        elif self.angular_radius is None:
            raise ParameterError("angular_radius", MISSING, "an angle such as '0.2678 deg'")

    @property
    def _distance(self) -> float | None:
        if self.distance is None and self.spectrum is not None:
            return ASTRONOMICAL_UNIT
        return self.distance

    @property
    def _radius(self) -> float | None:
        return SOLAR_RADIUS if self.radius is None and self.spectrum is not None else self.radius

    @property
    def angular_radius_degrees(self) -> float:
        """Half the angle that the star fills in the sky. [deg]"""
        if self.angular_radius is not None:
            return self.angular_radius
        assert self._radius is not None
        assert self._distance is not None
        return math.degrees(math.asin(self._radius / self._distance))

    @property
    def limits(self) -> Limits:
        """The wavelengths at which the light is known. [nm]"""
        if self.spectrum is not None:
            return table_limits(self.spectrum)
        if self.irradiance is not None:
            return spectral_limits(self.irradiance)
        return EVERYWHERE

    def irradiances(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Spectral irradiance at the planet, on a plane that faces the star, shape (nl,).

        [W m⁻² nm⁻¹]
        """
        if self.irradiance is not None:
            return spectral_at(self.irradiance, wavelengths)
        assert self._distance is not None
        if self.spectrum is not None:
            from airlight.spectra.sun import solar_irradiance

            return solar_irradiance(wavelengths) * (ASTRONOMICAL_UNIT / self._distance) ** 2
        from airlight.spectra.blackbody import star_irradiance

        assert self.temperature is not None
        assert self.radius is not None
        return star_irradiance(wavelengths, self.temperature, self.radius, self._distance)
