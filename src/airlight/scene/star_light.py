"""Second star of a scene, as in a binary."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

from airlight.errors import ParameterError
from airlight.physics.units import Measure, quantity
from airlight.planets.light_source import LightSource
from airlight.planets.star import Star
from airlight.scene.light_position import LightPosition
from airlight.scene.limits import within


@dataclass(frozen=True, kw_only=True)
class StarLight(LightPosition):
    """Secondary star, with its own spectrum, angular radius and limb darkening.

    Parameters
    ----------
    zenith : float
        True zenith angle, 0 to 180. [deg]
    azimuth : float
        Azimuth from the first star's side, to the right. [deg]
    star : Star
        Spectrum and size, as in a planet file.

    Raises
    ------
    ParameterError
        If an angle is out of range, or ``star`` is not a ``Star``.

    Examples
    --------
    >>> dwarf = StarLight(zenith=60.0, star=StarLight.black_body(3500.0, 0.3))
    >>> f"{dwarf.star.angular_radius_degrees:.2f}"
    '0.30'
    """

    star: Star

    _word = "star"

    def __post_init__(self) -> None:
        super().__post_init__()
        if not isinstance(self.star, Star):
            raise ParameterError("star", self.star, "a Star")

    @staticmethod
    def black_body(temperature: Measure, angular_radius: Measure) -> Star:
        """Black-body star from temperature and angular radius.

        Parameters
        ----------
        temperature : float
            Effective temperature, 100 to 1e6. [K]
        angular_radius : float
            Angular radius, 1e-6 to 30. [deg]
        """
        kelvin = quantity(temperature, "K", "star.temperature", bare=True)
        return _black_body(kelvin, within("star.angular_radius", angular_radius, 1e-6, 30.0, "deg"))

    def radius(self, star: float) -> float:
        """Angular radius of its disc; see ``LightPosition.radius``. [rad]"""
        return math.radians(self.star.angular_radius_degrees)

    def source(self, sources: tuple[LightSource, ...]) -> LightSource:
        """Source at the wavelengths of the planet's own.

        Parameters
        ----------
        sources : tuple of LightSource
            Sources of the planet: ``Solution.lights``.
        """
        return self.star.source("second star", sources[self.index].wavelengths)

    def metadata(self) -> str:
        """Metadata for file headers."""
        star = self.star
        kind = star.spectrum or (
            "irradiance given" if star.temperature is None else f"{star.temperature:.6g} K"
        )
        return (
            f"second star, zenith {self.zenith:.10g} deg, azimuth {self.azimuth:.10g} deg, {kind}, "
            f"angular radius {star.angular_radius_degrees:.6g} deg"
        )


@lru_cache(maxsize=64)
def _black_body(temperature: float, angular_radius: float) -> Star:
    """Black-body star from temperature [K] and angular radius [deg], cached."""
    far = 1e12
    radius = far * math.sin(math.radians(angular_radius))
    return Star(temperature=temperature, distance=far, radius=radius)
