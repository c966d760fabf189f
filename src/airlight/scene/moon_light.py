"""Moon as a light of a scene: a sphere of regolith that reflects the star's light."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
import numpy.typing as npt

from airlight.geometry.ephemeris.sky import MoonSighting
from airlight.physics.optics.moon_phase import moon_albedo, moon_brightness
from airlight.physics.units import Measured, measured
from airlight.planets.light_source import LightSource
from airlight.scene.light_position import LightPosition
from airlight.scene.moon_face import moon_face

FloatArray = npt.NDArray[np.float64]

#: A degree. [rad]
RADIAN: Final = math.pi / 180.0
#: Angular radius of the Moon at its mean distance, 384 400 km. [deg]
MEAN_RADIUS: Final = 0.259


@dataclass(frozen=True, kw_only=True)
class MoonLight(LightPosition):
    """Moon as a secondary light, with irradiance and disc by phase.

    Albedo, colour and phase curve are those of Earth's Moon for every planet. It is illuminated by
    the planet's star, at the planet's distance from it.

    Parameters
    ----------
    zenith : float
        True zenith angle, 0 to 180. [deg]
    azimuth : float
        Azimuth from the star's side, to the right. [deg]
    phase : float
        Phase angle, 0 full, 90 half, to 180 new. [deg]
    angular_radius : float
        Angular radius, above 0 to 30; the Moon's is 0.245 to 0.282. [deg]
    limb : float, optional
        Position angle of the bright limb, clockwise from the zenith; by default towards the star.
        [deg]
    north : float, optional
        Position angle of the Moon's north, clockwise from the zenith; by default at right angles to
        the bright limb, on the side of the zenith. [deg]
    near_latitude, near_longitude : float
        Selenographic coordinates of the centre of its disc, -90 to 90 and -180 to 180. [deg]
    seas : bool
        Whether its disc shows the map of its near side.

    Raises
    ------
    ParameterError
        With the field, the value and the allowed range.

    Examples
    --------
    >>> from airlight.planets import load_planet
    >>> star = load_planet("earth").lights([550.0])
    >>> full = MoonLight(zenith=30.0, phase=0.0).source(star)
    >>> f"{full.irradiance[0] / star[0].irradiance[0]:.2g}"  # 13.8 magnitudes, with the surge
    '3.1e-06'
    """

    phase: Measured[float] = measured(0.0)
    angular_radius: Measured[float] = measured(MEAN_RADIUS)
    limb: Measured[float | None] = measured(None)
    north: Measured[float | None] = measured(None)
    near_latitude: Measured[float] = measured(0.0)
    near_longitude: Measured[float] = measured(0.0)
    seas: bool = True

    _word = "moon"

    def __post_init__(self) -> None:
        super().__post_init__()
        self._check("phase", 0.0, 180.0)
        self._check("angular_radius", 1e-6, 30.0)
        self._check("near_latitude", -90.0, 90.0)
        self._check("near_longitude", -180.0, 180.0)
        for name in ("limb", "north"):
            if getattr(self, name) is not None:
                self._check(name, -720.0, 720.0)

    @classmethod
    def seen(cls, moon: MoonSighting, sun_azimuth: float) -> MoonLight:
        """Moon by ephemeris.

        Parameters
        ----------
        moon : MoonSighting
            Moon in the sky of the place.
        sun_azimuth : float
            Compass bearing of the sun. [deg]
        """
        return cls(
            zenith=moon.zenith,
            azimuth=math.remainder(moon.azimuth - sun_azimuth, 360.0),
            phase=moon.phase_angle,
            angular_radius=moon.angular_radius,
            north=moon.north,
            near_latitude=moon.near_latitude,
            near_longitude=moon.near_longitude,
        )

    def radius(self, star: float) -> float:
        """Angular radius of its disc; see ``LightPosition.radius``. [rad]"""
        return math.radians(self.angular_radius)

    def relative_to(self, star: LightPosition) -> MoonLight:
        """Moon with its bright limb towards a star, unless set explicitly.

        Examples
        --------
        >>> setting = LightPosition(zenith=90.0)
        >>> moon = MoonLight(zenith=90.0, azimuth=-40.0)
        >>> moon.relative_to(setting).limb  # the sun is to its right
        90.0
        """
        if self.limb is not None:
            return self
        around = self.azimuth - star.azimuth
        return replace(self, limb=round(bright_limb(self.zenith, around, star.zenith), 9))

    def source(self, sources: tuple[LightSource, ...]) -> LightSource:
        """Source: reflected light of the first source.

        Parameters
        ----------
        sources : tuple of LightSource
            Sources of the planet: ``Solution.lights``.
        """
        star = sources[self.index]
        share = math.sin(math.radians(self.angular_radius)) ** 2
        return LightSource(
            name="moon",
            angular_radius=math.radians(self.angular_radius),
            wavelengths=star.wavelengths,
            irradiance=star.irradiance * share * moon_brightness(star.wavelengths, self.phase),
            spectrum=None if star.spectrum is None else _Reflected(star.spectrum),
            phase=self.phase,
            limb=self._limb,
            face=self._face() if self.seas else None,
        )

    def _face(self) -> FloatArray:
        """Reflectance of its disc. [1]"""
        return moon_face(self._limb - self._north, self.near_latitude, self.near_longitude)

    @property
    def _limb(self) -> float:
        """Position angle of the bright limb. [deg]"""
        return 0.0 if self.limb is None else self.limb

    @property
    def _north(self) -> float:
        """Position angle of the north. [deg]"""
        if self.north is not None:
            return self.north
        sides = (math.remainder(self._limb + turn, 360.0) for turn in (-90.0, 90.0))
        return min(sides, key=abs)

    def metadata(self) -> str:
        """Metadata for file headers."""
        return (
            f"moon, zenith {self.zenith:.10g} deg, azimuth {self.azimuth:.10g} deg, "
            f"phase {self.phase:.10g} deg"
        )


def bright_limb(zenith: float, azimuth: float, star_zenith: float) -> float:
    """Position angle of a moon's bright limb, clockwise from the zenith. [deg]

    Parameters
    ----------
    zenith, azimuth : float
        Direction of the moon; azimuth from the star's side, to the right. [deg]
    star_zenith : float
        Zenith angle of the star. [deg]

    Examples
    --------
    >>> round(bright_limb(40.0, -30.0, 90.0))  # the star is below, to the right
    143
    """
    z, a, s = zenith * RADIAN, azimuth * RADIAN, star_zenith * RADIAN
    right = -math.sin(s) * math.sin(a)
    up = math.cos(s) * math.sin(z) - math.sin(s) * math.cos(z) * math.cos(a)
    return math.atan2(right, up) / RADIAN


@dataclass(frozen=True)
class _Reflected:
    """Stellar spectrum reflected by the full Moon."""

    star: Callable[[npt.ArrayLike], FloatArray]

    def __call__(self, wavelengths: npt.ArrayLike) -> FloatArray:
        return np.asarray(self.star(wavelengths) * moon_albedo(wavelengths))
