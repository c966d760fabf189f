"""Worlds with ephemerides: name, day, year, and rotation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from airlight.errors import ParameterError


@dataclass(frozen=True, kw_only=True)
class Spin:
    """Rotation elements of a world in the International Celestial Reference Frame.

    Attributes
    ----------
    right_ascension, declination : float
        Direction of the north pole. [deg]
    meridian : float
        Angle W from the ascending node of the equator to the prime meridian at J2000. [deg]
    rate : float
        Rate of change of that angle. [deg day⁻¹]
    """

    right_ascension: float
    declination: float
    meridian: float
    rate: float


@dataclass(frozen=True, kw_only=True)
class World:
    """World with a known orbit and rotation.

    Attributes
    ----------
    name : str
        Name, as the key ``body`` of a planet file has it.
    orbit : str
        Planet with its orbit about the sun, by astronomy-engine's name.
    spin : Spin or None
        Rotation elements; None: those of astronomy-engine for ``orbit``.
    orbit_radius : float
        Radius of its orbit about that planet, which it faces with longitude 0; 0 for a planet. [m]
    solar_day : float
        Length of its mean solar day. [day]
    year : float
        Tropical year. [day]
    deepest_basin : float
        Altitude of its lowest ground outside seas and ice, 0 or less. [m]
    has_moon : bool
        Whether the ephemeris of a moon is available.
    """

    name: str
    orbit: str
    spin: Spin | None = None
    orbit_radius: float = 0.0
    solar_day: float
    year: float
    deepest_basin: float
    has_moon: bool = False


#: Rotation of Titan, which is synchronous: Archinal et al. (2018), Celestial Mechanics and
#: Dynamical Astronomy 130, 22, Table 2 (the constants of Archinal et al. 2011).
_TITAN: Final = Spin(
    right_ascension=39.4827, declination=83.4279, meridian=186.5855, rate=22.5769768
)

#: Worlds by name. Days: Earth's; Mars's and its year, Allison & McEwen (2000), Planetary and Space
#: Science 48, 215; Titan's from its rotation and Saturn's sidereal year of 10759.22 days, with
#: 10747 days between its spring equinoxes (Williams, NASA Saturn Fact Sheet). Basins: the shore of
#: the Dead Sea, 430 m below the sea in 2017 and falling by more than a metre a year; the floor of
#: Hellas, Smith et al. (1999), Science 284, 1495; Titan's map of Lorenz et al. (2013), Icarus 225,
#: 367. The others' days and years: NASA's Planetary Fact Sheets, of Pluto the sidereal year; the
#: Moon's: its synodic month and the draconic year, of Cassini's laws; their basins are not given.
#: Triton, whose pole turns about Neptune's, has none.
WORLDS: Final = {
    "earth": World(
        name="earth",
        orbit="Earth",
        solar_day=1.0,
        year=365.24219,
        deepest_basin=-440.0,
        has_moon=True,
    ),
    "mars": World(
        name="mars",
        orbit="Mars",
        solar_day=1.0274912517,
        year=686.9725,
        deepest_basin=-8200.0,
    ),
    "titan": World(
        name="titan",
        orbit="Saturn",
        spin=_TITAN,
        orbit_radius=1.22187e9,
        solar_day=360.0 / (22.5769768 - 360.0 / 10759.22),
        year=10747.0,
        deepest_basin=-1700.0,
    ),
    "mercury": World(
        name="mercury", orbit="Mercury", solar_day=175.942, year=87.968, deepest_basin=0.0
    ),
    "venus": World(name="venus", orbit="Venus", solar_day=116.75, year=224.695, deepest_basin=0.0),
    "moon": World(name="moon", orbit="Moon", solar_day=29.530589, year=346.62, deepest_basin=0.0),
    "jupiter": World(
        name="jupiter", orbit="Jupiter", solar_day=0.41358, year=4330.595, deepest_basin=0.0
    ),
    "saturn": World(
        name="saturn", orbit="Saturn", solar_day=0.444, year=10746.94, deepest_basin=0.0
    ),
    "uranus": World(
        name="uranus", orbit="Uranus", solar_day=0.71833, year=30588.74, deepest_basin=0.0
    ),
    "neptune": World(
        name="neptune", orbit="Neptune", solar_day=0.67125, year=59799.9, deepest_basin=0.0
    ),
    "pluto": World(name="pluto", orbit="Pluto", solar_day=6.3872, year=90560.0, deepest_basin=0.0),
}


def world_named(name: str) -> World:
    """World by its name.

    Raises
    ------
    ParameterError
        If there is none of that name.

    Examples
    --------
    >>> f"{world_named('titan').solar_day:.2f}"
    '15.97'
    """
    if name not in WORLDS:
        raise ParameterError("body", name, ", ".join(WORLDS))
    return WORLDS[name]
