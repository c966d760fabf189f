"""Declarations of the parameters of observer, sun and camera.

Scene files, films, options of commands, the viewer's controls and the checks of ``Scene`` and
``Camera`` take range, unit, help and slider from here.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

from airlight.physics.units import Measure
from airlight.planets.schema.field import Field
from airlight.scene.compass import read_bearing
from airlight.scene.flight import LOWEST_ALTITUDE
from airlight.scene.ground_detail import GROUNDS
from airlight.scene.limits import DEEPEST_ALTITUDE, HIGHEST_ALTITUDE, within
from airlight.scene.projections import PROJECTIONS

_ROUND: Final = (0.0, 360.0)
_HALF_ROUND: Final = (-180.0, 180.0)
_TURNS: Final = (-360.0, 360.0)
_PLACES: Final = ("place", "position", "location", "where")

LATITUDE: Final = Field(
    label="latitude",
    help="Latitude of the observer, north positive.",
    unit="deg",
    range=(-90.0, 90.0),
    example="59.3 deg",
    synonyms=_PLACES,
)
LONGITUDE: Final = Field(
    label="longitude",
    help="Longitude of the observer, east positive.",
    unit="deg",
    range=_TURNS,
    slider=_HALF_ROUND,
    example="18.1 deg",
    synonyms=_PLACES,
)
ALTITUDE: Final = Field(
    label="altitude",
    help="Altitude of the observer above the ground.",
    unit="m",
    range=(DEEPEST_ALTITUDE, HIGHEST_ALTITUDE),
    slider=(LOWEST_ALTITUDE, 1e9),
    scale="log",
    example="400 km",
    synonyms=("height", "elevation", "how high", "space", "orbit", "up"),
)
SUN_ZENITH: Final = Field(
    label="sun zenith",
    help="Zenith angle of the sun at the observer.",
    note="Beyond 90 deg it has set.",
    unit="deg",
    range=(0.0, 180.0),
    example="72 deg",
    synonyms=(
        *("sun height", "sun elevation", "time of day", "hour", "sunset", "sunrise", "twilight"),
        *("night", "noon", "evening", "morning"),
    ),
)
SUN_AZIMUTH: Final = Field(
    label="sun bearing",
    help="Compass bearing of the sun.",
    unit="deg",
    range=_TURNS,
    slider=_ROUND,
    example="105 deg or ESE",
    read=read_bearing,
    synonyms=("sun direction", "sun azimuth", "time of day", "hour"),
)
LOOK_ZENITH: Final = Field(
    label="zenith angle",
    help="Zenith angle of the line of sight; 90 deg is horizontal.",
    unit="deg",
    range=(0.0, 180.0),
    example="80 deg",
    synonyms=("pitch", "tilt", "look up", "look down", "camera"),
)
LOOK_AZIMUTH: Final = Field(
    label="azimuth",
    help="Azimuth of the line of sight from the sun's side, 90 deg to its right.",
    unit="deg",
    range=_TURNS,
    example="30 deg",
)
LOOK_BEARING: Final = Field(
    label="heading",
    help="Compass bearing of the line of sight: 0 north, 90 deg east.",
    unit="deg",
    range=_TURNS,
    slider=_ROUND,
    example="225 deg or SW",
    read=read_bearing,
    synonyms=("direction", "azimuth", "yaw", "compass", "look around"),
)
ROLL: Final = Field(
    label="roll",
    help="Clockwise rotation of the camera about its line of sight.",
    unit="deg",
    range=_TURNS,
    slider=_HALF_ROUND,
    example="0 deg",
    synonyms=("bank", "horizon", "tilt", "rotate"),
)
POLARISER: Final = Field(
    label="polariser",
    help="Axis of an ideal polarising filter, counterclockwise from the camera's up.",
    unit="deg",
    range=_TURNS,
    slider=_HALF_ROUND,
    example="90 deg",
    synonyms=("polarizer", "polarisation", "polarization", "rotate"),
)
DEHAZE: Final = Field(
    label="haze removal",
    help="Fraction of the haze over sunlit ground that pictures from space leave out.",
    range=(0.0, 1.0),
    initial=0.9,
    example="0.5",
    synonyms=("dehaze", "haze", "contrast", "clarity", "washed out", "fog"),
)
PROJECTION: Final = Field(
    label="projection",
    help="Projection of the picture.",
    kind="choice",
    choices=lambda: tuple(PROJECTIONS),
    synonyms=("fisheye", "panorama", "lens", "cube map", "360"),
)
#: For observers near a planet, without parallel projections.
NEAR_PROJECTION: Final = replace(
    PROJECTION,
    choices=lambda: tuple(name for name, form in PROJECTIONS.items() if not form.parallel),
)
FIELD_OF_VIEW: Final = Field(
    label="field of view",
    help="Angle from left to right, or across a fisheye.",
    unit="deg",
    range=(1e-4, 360.0),
    slider=(1.0, 170.0),
    example="40 deg",
    synonyms=("zoom", "fov", "lens", "focal length", "telephoto", "wide angle"),
)
EXTENT: Final = Field(
    label="extent",
    help="Length from left to right for `orthographic`, by default the whole disc.",
    unit="m",
    range=(1.0, HIGHEST_ALTITUDE),
    example="14000 km",
)
GROUND: Final = Field(
    label="ground",
    help="Ground below the map's resolution: `detailed` by noise, as decoration.",
    kind="choice",
    choices=lambda: tuple(GROUNDS),
    synonyms=("detail", "noise", "texture", "terrain"),
)


def within_range(name: str, value: Measure, declared: Field) -> float:
    """Value as a float within the range of its declaration. [unit of the declaration]

    Examples
    --------
    >>> within_range("scene.sun_zenith", 200.0, SUN_ZENITH)
    Traceback (most recent call last):
    ...
    airlight.errors.ParameterError: scene.sun_zenith is 200.0; allowed: 0 to 180 deg
    """
    return within(name, value, *declared.range, declared.unit)
