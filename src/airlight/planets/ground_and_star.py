"""Ground below the air and star above it."""

from __future__ import annotations

import math
from functools import cache
from typing import Annotated, Any, Final

import numpy as np
import numpy.typing as npt

from airlight.constants import ASTRONOMICAL_UNIT, SOLAR_RADIUS
from airlight.errors import ParameterError
from airlight.optics.reflection import LAWS, Reflection, law_number
from airlight.planets.parameters import MISSING, parameters
from airlight.planets.schema.key import Key, Wavelengths, always
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

#: Wind speeds over water. [m s⁻¹]
WINDS: Final = (0.5, 25.0)
#: Name of the solar spectrum, as measured at 1 au.
SUN: Final = "astm-g173"
#: Name in an editor of a star that is given by its temperature.
BLACK_BODY: Final = "black body"


@cache
def reflectances() -> tuple[str, ...]:
    """Names of the reflectance tables in the package."""
    from airlight.spectra.tables import read_spectrum, spectrum_names

    tables = [read_spectrum(name) for name in spectrum_names()]
    return tuple(one.name for one in tables if one.unit == "1" and one.values.ndim == 1)


def _read_albedo(section: Section, name: str, wavelengths: Wavelengths) -> Any:
    """Read a number, a list, or the name of a table."""
    given = section.raw(name)
    if isinstance(given, str) and given[:1].isalpha():
        return given
    return section.spectral(name, "1", "0.1", wavelengths)


@parameters
class Ground(Record):
    """Ground: how much it reflects, and where to.

    Parameters
    ----------
    albedo : float, PerWavelength or str
        Fraction of light that is reflected, 0 to 1, or the name of a table of it. [1]
    map : str, optional
        Name of a picture of the ground, used where the ground is seen; the light that the ground
        sends back into the air comes from ``albedo``.
    lights : str, optional
        Name of a picture of the lights of towns, which are seen but light no air.
    brightness : float
        Factor of albedo and picture, 0 to 100; no albedo exceeds that of the law, 1 of Lambert's.
        [1]
    law : str
        Name from ``airlight.optics.reflection.LAWS``: ``lambert`` reflects alike into all
        directions, ``lommel-seeliger`` as dark, porous ground does, ``water`` as the open sea.
    wind : float, optional
        Wind speed over water, 0.5 to 25, which roughens it. With it the water of a map mirrors star
        and sky; without it only the law ``water`` does, at 5 m/s. [m s⁻¹]
    """

    has_wavelengths = True

    albedo: Annotated[
        Any,
        Key(
            label="albedo",
            help="Fraction of a uniform sky's light that the ground reflects.",
            note="A number, a list beside `wavelengths`, or the name of a table of reflectances.",
            range=(0.0, 1.0),
            spectral=True,
            read=_read_albedo,
            required=True,
            per="wavelengths",
            words=reflectances,
            synonyms=("ground brightness", "reflectance", "colour", "color", "snow", "sand"),
        ),
    ] = 0.0
    map: (
        Annotated[
            str,
            Key(
                label="map",
                help="Name of the map of the ground, or path of a picture of it.",
                note="`earth`, or a picture of the whole sphere, twice as wide as high, north up,"
                " 180° W on the left, of up to 200 million pixels; a grey one beside it whose name"
                " ends in `-water.png` has the share of water. Used where the ground is seen; the"
                " light that the ground sends back into the air comes from the albedo.",
                kind="text",
                range=(1.0, 100.0),
                example="the name of a map of the ground",
            ),
        ]
        | None
    ) = None
    lights: (
        Annotated[
            str,
            Key(
                label="lights",
                help="Name of a map of the lights of towns, or path of a picture of them.",
                note="`earth`, or a picture as for the map, white for the brightest towns,"
                " 0.2 cd/m²; seen through the air by night; they light no air.",
                kind="text",
                range=(1.0, 100.0),
                example="the name of a map of lights",
            ),
        ]
        | None
    ) = None
    brightness: Annotated[
        float,
        Key(
            label="brightness",
            help="Factor applied to the ground's albedo and to its map.",
            note="Albedos are limited to 1, by Lommel and Seeliger's law to 0.409.",
            range=(0.0, 100.0),
            slider=(0.0, 5.0),
            offered=always,
        ),
    ] = 1.0
    law: Annotated[
        str,
        Key(
            label="law of reflection",
            help="Directions into which the ground reflects: all alike, as porous rock, as water.",
            note="By Lommel and Seeliger's law the full disc of an airless body is as bright at its"
            " limb as in its middle; `water` mirrors, and its albedo is of the light from below.",
            kind="choice",
            words=lambda: tuple(LAWS),
            offered=always,
        ),
    ] = "lambert"
    wind: (
        Annotated[
            float,
            Key(
                label="wind over water",
                help="Wind speed, which roughens the water that mirrors star and sky.",
                note="With it the water of a map mirrors; without it only the law `water` does, at"
                " 5 m/s. Slopes by Cox and Munk (1954).",
                unit="m/s",
                range=WINDS,
                example="5 m/s",
                slider=(0.5, 15.0),
                offered=always,
            ),
        ]
        | None
    ) = None

    @property
    def limits(self) -> Limits:
        """Wavelengths at which the albedo is known. [nm]"""
        if isinstance(self.albedo, str):
            return table_limits(self.albedo)
        return spectral_limits(self.albedo)

    def albedos(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Albedo at wavelengths [nm], shape (nl,). [1]"""
        if isinstance(self.albedo, str):
            from airlight.spectra.tables import read_spectrum

            known = read_spectrum(self.albedo).at(wavelengths)
        else:
            known = spectral_at(self.albedo, wavelengths)
        return np.clip(self.brightness * known, 0.0, LAWS[self.law].LARGEST_ALBEDO)

    @property
    def reflection(self) -> Reflection:
        """Law of reflection with its parameters, for an albedo of 1."""
        wet = self.law == "water" or (self.map is not None and self.wind is not None)
        law, plain = law_number(self.law), Reflection(1.0)
        return Reflection(1.0, law, wet, plain.wind if self.wind is None else self.wind)


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
