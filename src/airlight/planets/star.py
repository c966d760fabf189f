"""Star of a planet: spectrum, distance and size."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any, Final

import numpy as np
import numpy.typing as npt

from airlight.errors import ConflictError, ParameterError
from airlight.physics.constants import ASTRONOMICAL_UNIT, SOLAR_RADIUS, SOLAR_TEMPERATURE
from airlight.physics.spectra.sun import SPECTRA, solar_irradiance
from airlight.physics.units import Measure, quantity, with_powers
from airlight.planets.parameters import MISSING, parameters
from airlight.planets.schema.field import Wavelengths, key
from airlight.planets.schema.toml_model import TomlModel
from airlight.planets.schema.toml_table import TomlTable, spectral_of
from airlight.planets.spectral import (
    EVERYWHERE,
    Limits,
    PerWavelength,
    Spectral,
    power_law_at,
    spectral_limits,
    table_limits,
)

if TYPE_CHECKING:
    from airlight.planets.light_source import LightSource

FloatArray = npt.NDArray[np.float64]

#: Name, in an editor, of a star defined by its temperature.
BLACK_BODY: Final = "black body"
#: Unit of irradiances.
IRRADIANCE: Final = "W/m^2/nm"


def _read_spectrum(table: TomlTable, name: str, wavelengths: Wavelengths) -> str:
    return table.text(name, f"the name of a spectrum: {', '.join(SPECTRA)}")


def _read_irradiance(table: TomlTable, name: str, wavelengths: Wavelengths) -> Any:
    """Read a number, a list, or the spectrum of a file at the planet's distance. [W m⁻² nm⁻¹]"""
    if name not in table:
        return None
    value, field = table.raw(name), table.name_of(name)
    if isinstance(value, str) and value.endswith(".csv"):
        return _spectrum_of_file(table, value, field)
    return spectral_of(value, IRRADIANCE, field, wavelengths)


def _spectrum_of_file(table: TomlTable, name: str, field: str) -> PerWavelength:
    from airlight.physics.spectra.tables import read_spectrum_file

    file = table.beside(name)
    spectrum = read_spectrum_file(file)
    if spectrum.values.ndim != 1:
        raise ParameterError(field, spectrum.columns, "a table with one column of values")
    factor = quantity(f"1 {with_powers(spectrum.unit)}", IRRADIANCE, f"unit of {file.name}")
    if spectrum.distance:
        there = quantity(spectrum.distance, "m", f"distance of {file.name}")
        here = table.optional_number("distance", "m")
        if here is None:
            raise ParameterError(
                table.name_of("distance"),
                MISSING,
                f"a length: the spectrum is for {spectrum.distance}",
            )
        if not (there > 0.0 and here > 0.0):
            raise ParameterError(f"distance of {file.name}", spectrum.distance, "a length above 0")
        factor *= (there / here) ** 2
    with table.prefix_errors():
        return PerWavelength(
            wavelengths=tuple(spectrum.wavelengths.tolist()),
            values=tuple((factor * spectrum.values).tolist()),
        )


@parameters
class Star(TomlModel):
    """Star with a measured spectrum, given irradiances, or a black-body spectrum.

    Exactly one of ``spectrum``, ``irradiance`` and ``temperature`` is given.

    Parameters
    ----------
    spectrum : str, optional
        ``"astm-g173"`` or ``"sao2010"``, which has the lines in half nanometres: the sun at 1 au,
        scaled to ``distance``.
    irradiance : float or PerWavelength, optional
        Irradiance at the planet, 0 to 1e9. [W m⁻² nm⁻¹]
    temperature : float, optional
        Temperature of a black body at ``distance``; requires ``radius``. [K]
    distance : float, optional
        Distance from the star to the planet; 1 au for the solar spectrum. [m]
    radius : float, optional
        Radius of the star; the nominal solar radius for the solar spectrum. [m]
    angular_radius : float, optional
        Angular radius, 0 (a point) to 30; default: from radius and distance. [deg]

    Examples
    --------
    >>> f"{Star(spectrum='astm-g173').angular_radius_degrees:.4f}"
    '0.2665'
    """

    has_wavelengths = True

    spectrum: str | None = key(
        help="Measured solar spectrum at 1 au, or a black body.",
        note="`distance` scales it.",
        read=_read_spectrum,
        choices=lambda: tuple(SPECTRA),
        synonyms=("sunlight", "colour", "color", "kind of star", "red dwarf"),
        placeholder=BLACK_BODY,
        offered=lambda star: "temperature" in star,
        default=None,
    )
    irradiance: Spectral | None = key(
        help="Spectral irradiance at the planet, on a plane facing the star.",
        note="One value or a list, or the path to a CSV file.",
        unit=IRRADIANCE,
        read=_read_irradiance,
        range=(0.0, 1e9),
        example="1 W/m^2/nm",
        slider=(1e-3, 1e2),
        scale="log",
        default=None,
    )
    temperature: float | None = key(
        help="Effective temperature of the star, a black body.",
        synonyms=("colour", "color", "red dwarf", "hot", "cool"),
        note="Needs `radius` and `distance`.",
        unit="K",
        range=(100.0, 1e6),
        example="5772 K",
        slider=(1000.0, 40000.0),
        scale="log",
        mode="advanced",
        default=None,
    )
    radius: float | None = key(
        label="radius of the star",
        help="Radius; with the distance it gives irradiance and angular radius.",
        unit="m",
        range=(1e3, 1e13),
        example="695700 km",
        shown="km",
        slider=(1e4, 1e8),
        scale="log",
        mode="advanced",
        default=None,
    )
    distance: float | None = key(
        help="Distance from the star to the planet.",
        unit="m",
        range=(1e6, 1e16),
        example="1 au",
        left_out="1 au",
        shown="au",
        slider=(0.01, 50.0),
        scale="log",
        offered=lambda star: "spectrum" in star,
        default=None,
    )
    angular_radius: float | None = key(
        help="Angular radius of the star's disc; 0 for a point.",
        note="From radius and distance where those are known; required beside an `irradiance`.",
        unit="deg",
        range=(0.0, 30.0),
        example="0.2678 deg",
        slider=(0.0, 5.0),
        default=None,
    )

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
                    raise ConflictError("temperature", f"requires {name}")
        if self.irradiance is not None and self.distance is not None and self.radius is None:
            raise ConflictError(
                "distance", "cannot be combined with irradiance, unless radius is given"
            )
        if self.known_radius is not None and self.known_distance is not None:
            if self.known_radius > 0.5 * self.known_distance:
                raise ParameterError("radius", self.known_radius, "at most half the distance")
        elif self.angular_radius is None:
            raise ParameterError("angular_radius", MISSING, "an angle such as '0.2678 deg'")

    @property
    def known_distance(self) -> float | None:
        """Distance to the planet; default 1 au for the solar spectrum, otherwise None. [m]"""
        if self.distance is None and self.spectrum is not None:
            return ASTRONOMICAL_UNIT
        return self.distance

    @property
    def known_radius(self) -> float | None:
        """Radius; default that of the sun for the solar spectrum, otherwise None. [m]"""
        return SOLAR_RADIUS if self.radius is None and self.spectrum is not None else self.radius

    @property
    def angular_radius_degrees(self) -> float:
        """Angular radius at the planet. [deg]"""
        if self.angular_radius is not None:
            return self.angular_radius
        assert self.known_radius is not None
        assert self.known_distance is not None
        return math.degrees(math.asin(self.known_radius / self.known_distance))

    def at_distance(self, distance: Measure) -> Star:
        """Star at another distance, with its angular radius there.

        Parameters
        ----------
        distance : float
            Distance. [m]

        Returns
        -------
        Star
            Star with its angular radius rounded to three digits, so that nearby dates share a
            solution; itself if only its irradiance is given.

        Examples
        --------
        >>> far = Star(spectrum="astm-g173").at_distance(2.0 * ASTRONOMICAL_UNIT)
        >>> far.angular_radius_degrees
        0.133
        """
        if self.known_distance is None or self.known_radius is None or self.irradiance is not None:
            return self
        distance = quantity(distance, "m", "distance", bare=True)
        angle = math.degrees(math.asin(self.known_radius / distance))
        return dataclasses.replace(self, distance=distance, angular_radius=float(f"{angle:.3g}"))

    def of_temperature(self, temperature: Measure) -> Star:
        r"""Black body of another temperature at the same distance, with the same total irradiance.

        .. math:: R = R_0\, (T_0 / T)^2

        Parameters
        ----------
        temperature : float
            Effective temperature T. [K]

        Raises
        ------
        ConflictError
            If the star has given irradiances, whose total is not known.

        Examples
        --------
        >>> dwarf = Star(spectrum="astm-g173").of_temperature(2886.0)  # half that of the sun
        >>> round(dwarf.angular_radius_degrees / 0.266568, 2)  # the angle of four solar radii
        4.0
        """
        if self.known_distance is None or self.irradiance is not None:
            raise ConflictError("star.temperature", "cannot be combined with a given irradiance")
        kelvin = quantity(temperature, "K", "star.temperature", bare=True)
        own = SOLAR_TEMPERATURE, SOLAR_RADIUS
        if self.temperature is not None and self.radius is not None:
            own = self.temperature, self.radius
        # The radius is at most half the distance.
        lowest = max(100.0, own[0] * math.sqrt(2.0 * own[1] / self.known_distance))
        if not lowest <= kelvin <= 1e6:
            raise ParameterError("star.temperature", kelvin, f"{math.ceil(lowest)} to 1e6 K")
        radius = own[1] * (own[0] / kelvin) ** 2
        return Star(temperature=kelvin, radius=radius, distance=self.known_distance)

    @property
    def limits(self) -> Limits:
        """Wavelength range of the spectrum. [nm]"""
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
            return power_law_at(self.irradiance, wavelengths)
        assert self.known_distance is not None
        if self.spectrum is not None:
            there = (ASTRONOMICAL_UNIT / self.known_distance) ** 2
            return solar_irradiance(wavelengths, self.spectrum) * there
        from airlight.physics.spectra.blackbody import star_irradiance

        assert self.temperature is not None
        assert self.radius is not None
        return star_irradiance(wavelengths, self.temperature, self.radius, self.known_distance)

    def source(self, name: str, wavelengths: FloatArray) -> LightSource:
        """Light source of the star.

        Parameters
        ----------
        name : str
            Name of the source.
        wavelengths : array, shape (nl,)
            Wavelengths of the samples. [nm]
        """
        from airlight.planets.light_source import LightSource

        return LightSource(
            name=name,
            angular_radius=math.radians(self.angular_radius_degrees),
            wavelengths=wavelengths,
            irradiance=self.irradiances(wavelengths),
            spectrum=self.irradiances,
            darkening=self.darkening,
        )

    @property
    def darkening(self) -> Callable[[npt.ArrayLike], FloatArray] | None:
        """Limb-darkening law as a function of wavelengths, see ``LightSource``.

        That of the sun for the solar spectrum, of a grey atmosphere with a temperature, None (a
        uniform disc) otherwise.
        """
        from airlight.physics.spectra.limb_darkening import black_body_darkening, solar_darkening

        if self.spectrum is not None:
            return solar_darkening
        if self.temperature is not None:
            return partial(black_body_darkening, temperature=self.temperature)
        return None
