"""Sun of a view by date and time."""

from __future__ import annotations

import math
from collections.abc import Mapping
from datetime import datetime, timedelta
from typing import Final

from airlight.geometry.ephemeris.sun_formula import NUMBERED, date_after
from airlight.scene.sun_time import sun_on_date
from airlight.viewer.parameters.parameter import Value
from airlight.viewer.parameters.second_light import BY_DATE, with_moon

#: Paths of the switch, and of date, place and sun.
CLOCK: Final = "view.clock"
DATE: Final = ("view.year", "view.day", "view.hour")
PLACE: Final = ("view.latitude", "view.longitude")
#: Paths available only for a planet with a ``body``.
OF_DATE: Final = (CLOCK, *DATE, BY_DATE)
SUN: Final = ("view.sun_zenith", "view.sun_azimuth")


def with_sky(
    body: object, view: Mapping[str, Value], changes: Mapping[str, Value]
) -> dict[str, Value]:
    """Changes of a view, completed by sun and Moon."""
    return with_moon(body, view, with_sun(body, view, changes))


def with_sun(
    body: object, view: Mapping[str, Value], changes: Mapping[str, Value]
) -> dict[str, Value]:
    """Changes of a view, completed by the sun from date and place, or by switching to manual.

    Parameters
    ----------
    body : object
        Key ``body`` of the planet; None if its sun cannot follow a date.
    view : mapping
        Values before, by path.
    changes : mapping
        Validated changes, by path.

    Returns
    -------
    dict
        Changes. A date turns the switch on, a sun moved manually turns it off; while it is on, the
        sun follows date and place.

    Examples
    --------
    >>> from airlight.viewer.parameters.view_parameters import DEFAULTS
    >>> view = {**DEFAULTS, "view.latitude": 59.33, "view.longitude": 18.07}
    >>> changed = with_sun("earth", view, {"view.hour": 20.0 + 10.0 / 60.0})
    >>> changed["view.clock"], f"{changed['view.sun_zenith']:.1f}"
    (True, '91.0')
    """
    if not any(path in changes for path in (CLOCK, *DATE, *PLACE, *SUN)):
        return dict(changes)
    if body not in NUMBERED:
        return {**changes, CLOCK: False} if view[CLOCK] or changes.get(CLOCK) else dict(changes)
    dated = any(path in changes for path in DATE)
    aimed = any(path in changes for path in SUN)
    on = bool(view[CLOCK])
    if CLOCK in changes:
        on = bool(changes[CLOCK])
    elif dated and not aimed:
        on = True
    elif aimed and not any(path in changes for path in PLACE):
        on = False
    if not on:
        return {**changes, CLOCK: False} if view[CLOCK] else dict(changes)
    after = {**view, **changes}
    latitude, longitude = (float(after[path]) for path in PLACE)
    year, day, hour = (float(after[path]) for path in DATE)
    world = float(NUMBERED.index(str(body)))
    zenith, azimuth = sun_on_date(
        world, latitude, longitude, math.floor(year), math.floor(day), hour
    )
    return {**changes, CLOCK: True, SUN[0]: zenith, SUN[1]: azimuth % 360.0}


def date_later(view: Mapping[str, Value], hours: float) -> dict[str, float]:
    """Year, day and hour after some hours, within the years of the sliders. [h]

    Examples
    --------
    >>> date_later({"view.year": 2026.0, "view.day": 365.0, "view.hour": 23.0}, 2.0)
    {'view.year': 2027.0, 'view.day': 1.0, 'view.hour': 1.0}
    """
    year, day, hour = (float(view[path]) for path in DATE)
    later = date_after(math.floor(year), math.floor(day), hour, hours)
    return dict(zip(DATE, later, strict=True))


def date_text(view: Mapping[str, Value]) -> str:
    """Date and time of a view, to the minute.

    Examples
    --------
    >>> date_text({"view.year": 2026.0, "view.day": 172.0, "view.hour": 20.1667})
    '2026-06-21 20:10 UTC'
    """
    year, day, hour = (float(view[path]) for path in DATE)
    start = datetime(math.floor(year), 1, 1)
    moment = start + timedelta(days=math.floor(day) - 1, minutes=round(60.0 * hour))
    return f"{moment:%Y-%m-%d %H:%M} UTC"
