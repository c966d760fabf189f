"""Presets of the gallery, with family, kind and a characteristic view."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import groupby
from typing import Final, Literal

from airlight.planets.planet import Planet
from airlight.scene import Camera, Scene
from airlight.scene.observer import horizon_zenith

#: Kinds of presets: a planet; a variation of it; a planet of a program or paper.
Kind = Literal["reference", "variation", "literature"]

#: Size of the thumbnails. [pixel]
WIDTH: Final = 240
HEIGHT: Final = 135


@dataclass(frozen=True)
class Look:
    """Observer, sun and camera of a thumbnail.

    Attributes
    ----------
    altitude : float
        Altitude as a fraction of the shell's thickness; negative: in ground radii. [1]
    below_horizon : float
        Angle of the line of sight below the horizon; 180 looks straight down. [deg]
    aside : float
        Azimuth of the line of sight from the sun. [deg]
    sun_zenith : float
        Zenith angle of the sun. [deg]
    field_of_view : float
        Angle between the left and the right edge. [deg]
    latitude, longitude : float
        Point below the observer. [deg]
    sun_azimuth : float
        Compass bearing of the sun. [deg]
    """

    altitude: float
    below_horizon: float
    aside: float
    sun_zenith: float
    field_of_view: float = 60.0
    latitude: float = 38.0
    longitude: float = 14.0
    sun_azimuth: float = 240.0

    def scene(self, planet: Planet, width: int = WIDTH, height: int = HEIGHT) -> Scene:
        """Scene of a planet.

        Parameters
        ----------
        planet : Planet
            Planet whose radii the altitude is relative to.
        """
        altitude = self.altitude * (planet.top_radius - planet.bottom_radius)
        if self.altitude < 0.0:
            altitude = -self.altitude * planet.bottom_radius
        zenith = horizon_zenith(altitude, planet.bottom_radius) + self.below_horizon
        camera = Camera(
            width=width,
            height=height,
            field_of_view=self.field_of_view,
            look_zenith=min(max(zenith, 0.0), 180.0),
            look_azimuth=self.aside,
        )
        names = ("sun_zenith", "latitude", "longitude", "sun_azimuth")
        given = {name: getattr(self, name) for name in names}
        return Scene(camera=camera, altitude=altitude, **given)


#: Limb from above the atmosphere; atmosphere over ground from above; low sun from the ground;
#: daytime on the ground; the sky after sunset; the whole planet, half lit; north above.
_LIMB: Final = Look(12.0, 11.0, -58.0, 74.0, latitude=34.0, sun_azimuth=110.0)
_ABOVE: Final = Look(4.0, 14.0, 60.0, 62.0)
_SUNSET: Final = Look(2e-5, -8.0, 8.0, 86.0)
_DAY: Final = Look(2e-5, -12.0, 60.0, 65.0)
_DUSK: Final = Look(2e-5, -14.0, 0.0, 93.0)
_WHOLE: Final = Look(-3.2, 180.0, 0.0, 62.0, 58.0, latitude=20.0, longitude=15.0, sun_azimuth=250.0)
_NORTH_UP: Final = Look(-4.0, 180.0, 70.0, 62.0, 58.0, latitude=20.0, sun_azimuth=290.0)
_BACKLIT: Final = Look(-3.2, 180.0, 0.0, 160.0, 58.0, sun_azimuth=250.0)


@dataclass(frozen=True)
class Preset:
    """Preset of the gallery.

    Attributes
    ----------
    name : str
        Name of the preset, one of ``planet_names()``.
    label : str
        Short caption below the picture.
    family : str
        Planet of the preset.
    kind : str
        See ``Kind``.
    look : Look
        View of the thumbnail.
    """

    name: str
    label: str
    family: str
    kind: Kind
    look: Look


#: All presets in the order of the gallery: by family, beginning with the planet itself.
PRESETS: Final = (
    Preset("earth", "Earth", "Earth", "reference", _LIMB),
    Preset("earth-hazy", "hazy", "Earth", "variation", _ABOVE),
    Preset("earth-volcanic", "after an eruption", "Earth", "variation", _DUSK),
    Preset("early-earth", "2.7 billion years ago", "Earth", "variation", _WHOLE),
    Preset("earth-atmosphere-plus", "Atmosphere Plus", "Earth", "literature", _LIMB),
    Preset("earth-atmosphere-plus-2025", "Atmosphere Plus 2025", "Earth", "literature", _LIMB),
    Preset(
        "earth-atmosphere-plus-literal", "Atmosphere Plus, as printed", "Earth", "literature", _LIMB
    ),
    Preset("earth-bruneton", "Bruneton 2017", "Earth", "literature", _LIMB),
    Preset("earth-openspace", "OpenSpace", "Earth", "literature", _LIMB),
    Preset("earth-openspace-advanced", "OpenSpace, advanced", "Earth", "literature", _LIMB),
    Preset("earth-openspace-dense", "OpenSpace, twice the air", "Earth", "literature", _LIMB),
    Preset(
        "earth-openspace-depolarisation", "OpenSpace, depolarised", "Earth", "literature", _LIMB
    ),
    Preset("earth-openspace-dust", "OpenSpace, 6 times the dust", "Earth", "literature", _LIMB),
    Preset("earth-openspace-refractive", "OpenSpace, refractive", "Earth", "literature", _LIMB),
    Preset("mars", "Mars", "Mars", "reference", _SUNSET),
    Preset("mars-rayleigh", "without dust", "Mars", "variation", _DAY),
    Preset("mars-standard", "by coefficients", "Mars", "variation", _DAY),
    Preset("mars-openspace", "OpenSpace", "Mars", "literature", _DAY),
    Preset("venus", "Venus", "Venus", "reference", _WHOLE),
    Preset("titan", "Titan", "Titan", "reference", _WHOLE),
    Preset("mercury", "Mercury", "Mercury", "reference", _WHOLE),
    Preset("moon", "Moon", "Moon", "reference", _WHOLE),
    Preset("jupiter", "Jupiter", "Jupiter", "reference", _WHOLE),
    Preset("saturn", "Saturn", "Saturn", "reference", _NORTH_UP),
    Preset("uranus", "Uranus", "Uranus", "reference", _WHOLE),
    Preset("neptune", "Neptune", "Neptune", "reference", _WHOLE),
    Preset("triton", "Triton", "Triton", "reference", _BACKLIT),
    Preset("pluto", "Pluto", "Pluto", "reference", _BACKLIT),
    Preset("exoplanet", "TRAPPIST-1 e", "exoplanets", "reference", _SUNSET),
)


def preset(name: str) -> Preset | None:
    """Preset of the gallery by name; None for other planets."""
    return next((one for one in PRESETS if one.name == name), None)


def families() -> dict[str, tuple[Preset, ...]]:
    """Presets by family, in the gallery's order.

    Examples
    --------
    >>> [one.name for one in families()["Mars"]]
    ['mars', 'mars-rayleigh', 'mars-standard', 'mars-openspace']
    """
    return {family: tuple(group) for family, group in groupby(PRESETS, lambda one: one.family)}
