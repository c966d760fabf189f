"""Second light of a view: the Moon, by date and time or set manually, or a second star."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Final

from airlight.geometry.ephemeris.moon_formula import moon_on_date
from airlight.geometry.ephemeris.sun_formula import NUMBERED
from airlight.scene.light_position import LightPosition
from airlight.scene.moon_light import MoonLight
from airlight.scene.star_light import StarLight
from airlight.viewer.parameters.parameter import Value

#: Names of the kinds of the second light.
NONE, MOON, STAR = KINDS = ("none", "moon", "second sun")
#: Paths: kind, whether the Moon follows the date, position and size, temperature of a star.
LIGHT: Final = "view.second_light"
BY_DATE: Final = "view.moon_by_date"
PLACED: Final = (
    "view.second_zenith",
    "view.second_azimuth",
    "view.moon_phase",
    "view.second_radius",
)
TEMPERATURE: Final = "view.second_temperature"
#: Paths of the sun's clock that are used here.
_CLOCK: Final = "view.clock"
_DATE: Final = ("view.year", "view.day", "view.hour")
_SITE: Final = ("view.latitude", "view.longitude")
#: World with a moon.
_EARTH: Final = "earth"


def with_moon(
    body: object, view: Mapping[str, Value], changes: Mapping[str, Value]
) -> dict[str, Value]:
    """Changes of a view, completed by the Moon from date and place.

    Parameters
    ----------
    body : object
        Key ``body`` of the planet; only Earth's moon follows a date.
    view : mapping
        Values before, by path.
    changes : mapping
        Validated changes, by path, with the sun that follows from them.

    Returns
    -------
    dict
        Changes. The Moon follows date and time with the sun, until the second light is set
        manually. Moving a second light that is off turns the Moon on; a temperature turns a second
        star on.

    Examples
    --------
    >>> from airlight.viewer.parameters.view_parameters import DEFAULTS
    >>> changed = with_moon("earth", {**DEFAULTS, "view.clock": True}, {"view.hour": 20.0})
    >>> changed["view.second_light"], round(changed["view.moon_phase"])
    ('moon', 91)
    >>> with_moon("earth", DEFAULTS, {"view.second_zenith": 30.0})["view.second_light"]
    'moon'
    """
    by_hand = any(path in changes for path in (LIGHT, *PLACED, TEMPERATURE))
    if not by_hand and not any(path in changes for path in (BY_DATE, _CLOCK, *_DATE, *_SITE)):
        return dict(changes)
    after = {**view, **changes}
    found = dict(changes)
    if by_hand and BY_DATE not in changes and _CLOCK not in changes:
        if view[BY_DATE] and body in NUMBERED:
            found[BY_DATE] = False
        if LIGHT not in changes and view[LIGHT] == NONE:
            found[LIGHT] = STAR if TEMPERATURE in changes else MOON
        return found
    if not (after[BY_DATE] and after[_CLOCK]):
        return found
    if body != _EARTH:
        if after[LIGHT] == MOON:
            found[LIGHT] = NONE
        return found
    latitude, longitude = (float(after[path]) for path in _SITE)
    year, day, hour = (float(after[path]) for path in _DATE)
    zenith, azimuth, phase, radius = moon_on_date(
        latitude, longitude, math.floor(year), math.floor(day), hour
    )
    values = (zenith, azimuth % 360.0, phase, radius)
    return {**found, LIGHT: MOON, **dict(zip(PLACED, values, strict=True))}


def second_lights(view: Mapping[str, Value]) -> tuple[LightPosition, ...]:
    """Secondary lights of a view.

    Examples
    --------
    >>> from airlight.viewer.parameters.view_parameters import DEFAULTS
    >>> second_lights(DEFAULTS)
    ()
    """
    if view[LIGHT] == NONE:
        return ()
    zenith, bearing, phase, radius = (float(view[path]) for path in PLACED)
    azimuth = math.remainder(bearing - float(view["view.sun_azimuth"]), 360.0)
    if view[LIGHT] == MOON:
        # A page has no map of the Moon.
        moon = MoonLight(
            zenith=zenith, azimuth=azimuth, phase=phase, angular_radius=radius, seas=False
        )
        return (moon,)
    star = StarLight.black_body(float(view[TEMPERATURE]), radius)
    return (StarLight(zenith=zenith, azimuth=azimuth, star=star),)
