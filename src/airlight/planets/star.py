"""Star that lights the planet."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from functools import partial
from typing import Annotated, Final

import numpy as np
import numpy.typing as npt

from airlight.constants import ASTRONOMICAL_UNIT, SOLAR_RADIUS
from airlight.errors import ParameterError
from airlight.planets.parameters import MISSING, parameters
from airlight.planets.schema.key import Key, Wavelengths
from airlight.planets.schema.record import Record
from airlight.planets.schema.section import Section
from airlight.planets.spectral import (
    EVERYWHERE,
    Limits,
    Spectral,
    spectral_at,
    spectral_limits,
    table_limits,
)

FloatArray = npt.NDArray[np.float64]

#: Name of the solar spectrum, as measured at 1 au.
SUN: Final = "astm-g173"
#: Name in an editor of a star that is given by its temperature.
BLACK_BODY: Final = "black body"


def _read_spectrum(section: Section, name: str, wavelengths: Wavelengths) -> str:
    return section.text(name, "the name of a spectrum, 'astm-g173'")


@parameters
class Star(Record):
    """Incoming light: a measured spectrum, given values, or a black body.

    Exactly one of ``spectrum``, ``irradiance`` and ``temperature`` is given.

    Parameters
    ----------
    spectrum : str, optional
        ``"astm-g173"``, the sun at 1 au; it is scaled to ``distance``.
    irradiance : float or PerWavelength, optional
        Irradiance at the planet, 0 to 1e9. [W m⁻² nm⁻¹]
    temperature : float, optional
        Temperature of a black body, seen at ``distance``; needs ``radius``. [K]
    distance : float, optional
        Distance from the star to the planet; 1 au for the solar spectrum. [m]
    radius : float, optional
        Radius of the star; the nominal solar radius for the solar spectrum. [m]
    angular_radius : float, optional
        Half the angle that the star subtends, 0 (a point) to 30; from radius and distance by
        default. [deg]

    Examples
    --------
    >>> f"{Star(spectrum='astm-g173').angular_radius_degrees:.4f}"
    '0.2665'
    """

    has_wavelengths = True

    spectrum: (
        Annotated[
            str,
            Key(
                label="spectrum",
                help="Measured solar spectrum at 1 au, or a black body.",
                note="`distance` scales it.",
                kind="choice",
                read=_read_spectrum,
                words=lambda: (SUN,),
                synonyms=("sunlight", "colour", "color", "kind of star", "red dwarf"),
                stand_in=BLACK_BODY,
                offered=lambda star: "temperature" in star,
            ),
        ]
        | None
    ) = None
    irradiance: (
        Annotated[
            Spectral,
            Key(
                label="irradiance",
                help="Spectral irradiance at the planet, on a plane facing the star.",
                unit="W/m^2/nm",
                range=(0.0, 1e9),
                spectral=True,
                example="1 W/m^2/nm",
                slider=(1e-3, 1e2),
                scale="log",
                per="wavelengths",
            ),
        ]
        | None
    ) = None
    temperature: (
        Annotated[
            float,
            Key(
                label="temperature",
                help="Effective temperature of the star, a black body.",
                synonyms=("colour", "color", "red dwarf", "hot", "cool"),
                note="Needs `radius` and `distance`.",
                unit="K",
                range=(100.0, 1e6),
                example="5772 K",
                slider=(1000.0, 40000.0),
                scale="log",
                mode="advanced",
            ),
        ]
        | None
    ) = None
    radius: (
        Annotated[
            float,
            Key(
                label="radius of the star",
                help="Radius; with the distance it gives irradiance and angular radius.",
                unit="m",
                range=(1e3, 1e13),
                example="695700 km",
                shown="km",
                slider=(1e4, 1e8),
                scale="log",
                mode="advanced",
            ),
        ]
        | None
    ) = None
    distance: (
        Annotated[
            float,
            Key(
                label="distance",
                help="Distance from the star to the planet.",
                unit="m",
                range=(1e6, 1e16),
                example="1 au",
                default="1 au",
                shown="au",
                slider=(0.01, 50.0),
                scale="log",
                offered=lambda star: "spectrum" in star,
            ),
        ]
        | None
    ) = None
    angular_radius: (
        Annotated[
            float,
            Key(
                label="angular radius",
                help="Angular radius of the star's disc; 0 for a point.",
                note="From radius and distance where those are known; required beside an"
                " `irradiance`.",
                unit="deg",
                range=(0.0, 30.0),
                example="0.2678 deg",
                slider=(0.0, 5.0),
            ),
        ]
        | None
    ) = None

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
        """Half the angle that the star subtends at the planet. [deg]"""
        if self.angular_radius is not None:
            return self.angular_radius
        assert self._radius is not None
        assert self._distance is not None
        return math.degrees(math.asin(self._radius / self._distance))

    def at_distance(self, distance: float) -> Star:
        """Star at another distance, and of the size that it has there.

        Parameters
        ----------
        distance : float
            Distance. [m]

        Returns
        -------
        Star
            Star whose angular radius is rounded to three digits, so that solutions of neighbouring
            days are one; itself if it is known only by its irradiance.

        Examples
        --------
        >>> far = Star(spectrum="astm-g173").at_distance(2.0 * ASTRONOMICAL_UNIT)
        >>> far.angular_radius_degrees
        0.133
        """
        if self._distance is None or self._radius is None or self.irradiance is not None:
            return self
        angle = math.degrees(math.asin(self._radius / distance))
        return dataclasses.replace(self, distance=distance, angular_radius=float(f"{angle:.3g}"))

    @property
    def limits(self) -> Limits:
        """Wavelengths at which the light is known. [nm]"""
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

    @property
    def darkening(self) -> Callable[[npt.ArrayLike], FloatArray] | None:
        """Law of the disc's darkening towards its rim, of wavelengths, see ``LightSource``.

        The sun's where the spectrum is the sun's, that of a grey atmosphere where a temperature is
        known; None, a uniform disc, beside an irradiance alone.
        """
        from airlight.spectra.limb_darkening import black_body_darkening, solar_darkening

        if self.spectrum is not None:
            return solar_darkening
        if self.temperature is not None:
            return partial(black_body_darkening, temperature=self.temperature)
        return None
