"""Events of a day: rise and set of sun and moon, dusk and dawn, noon."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

from airlight.geometry.ephemeris.sky import Place, moon_after, sun_after
from airlight.geometry.ephemeris.solar_time import true_solar_time

#: Refraction at the horizon of Earth, as almanacs take it. [deg] 34', Explanatory Supplement to
#: the Astronomical Almanac (2013), section 12.3.
_LIFT: Final = 34.0 / 60.0
#: Number of samples of a day for bracketing crossings, and precision of an event. [day]
_SAMPLES: Final = 96
_PRECISION: Final = 1e-7


@dataclass(frozen=True)
class Event:
    """Event of a day.

    Attributes
    ----------
    name : str
        Name.
    body : str
        ``sun`` or ``moon``.
    altitude : float
        True altitude of the body's centre. [deg]
    limb : bool
        Whether the altitude is that of the upper limb, on Earth with the refraction of almanacs.
    rising : bool
        Whether the body rises through that altitude.
    """

    name: str
    body: str
    altitude: float
    limb: bool
    rising: bool


def _events() -> dict[str, Event]:
    found = {
        f"{body}{word}": Event(f"{body}{word}", body, 0.0, True, word == "rise")
        for body in ("sun", "moon")
        for word in ("rise", "set")
    }
    for kind, altitude in (("civil", -6.0), ("nautical", -12.0), ("astronomical", -18.0)):
        for word in ("dawn", "dusk"):
            name = f"{kind}-{word}"
            found[name] = Event(name, "sun", altitude, False, word == "dawn")
    return found


#: Events by name, but for ``noon``.
EVENTS: Final = _events()
#: Names of times of day.
WORDS: Final = (*EVENTS, "noon")
#: Names of the half days in which the sun has a given elevation.
HALVES: Final = ("morning", "evening")


def sun_at(elevation: float, half: str) -> Event:
    """Event of the sun's centre at a true elevation [deg], in a half of ``HALVES``.

    Examples
    --------
    >>> sun_at(5.0, "evening").rising
    False
    """
    return Event(f"{half} {elevation:g}deg", "sun", elevation, False, half == HALVES[0])


class NoEvent(Exception):
    """Event that does not occur, with the lowest and highest altitude of its body. [deg]"""

    def __init__(self, body: str, lowest: float, highest: float) -> None:
        self.body, self.lowest, self.highest = body, lowest, highest
        super().__init__(f"the {body} stays between {lowest:.1f}° and {highest:.1f}°")


def time_of_event(name: str | Event, place: Place, start: float, end: float) -> float:
    """First time of an event between two times.

    Parameters
    ----------
    name : str or Event
        Word of ``WORDS``, or an event of ``sun_at``. Rise and set are of the upper limb at the
        horizontal, on Earth with 34' of refraction as in almanacs; at civil, nautical and
        astronomical dawn and dusk the sun's centre is 6°, 12° and 18° below the horizontal, without
        refraction.
    place : Place
        Place; events are those on its ground.

    Returns
    -------
    float
        Days since 2000-01-01 12:00 UTC, to 0.01 s.

    Raises
    ------
    NoEvent
        If it does not occur: midnight sun, a day without moonrise.

    Examples
    --------
    >>> from airlight.geometry.ephemeris.instant import time_at
    >>> greenwich = Place(latitude=51.48, longitude=0.0)
    >>> time_at(time_of_event("sunset", greenwich, 9665.5, 9666.5)).isoformat()[:16]  # 2026-06-19
    '2026-06-19T20:20'
    """
    if name == "noon":
        world, longitude = place.world, place.longitude
        return clock_time(lambda days: true_solar_time(world, longitude, days), 12.0, start, end)
    event = EVENTS[name] if isinstance(name, str) else name
    ground = Place(body=place.body, latitude=place.latitude, longitude=place.longitude)

    def above(days: float) -> float:
        seen = (sun_after if event.body == "sun" else moon_after)(ground, days)
        wanted = event.altitude
        if event.limb:
            wanted -= seen.angular_radius + (_LIFT if place.body == "earth" else 0.0)
        return (seen.altitude - wanted) * (1.0 if event.rising else -1.0)

    def altitude(days: float) -> float:
        return (sun_after if event.body == "sun" else moon_after)(ground, days).altitude

    times = [start + (end - start) * k / _SAMPLES for k in range(_SAMPLES + 1)]
    values = [above(t) for t in times]
    k = 0
    while k < _SAMPLES:
        if values[k] < 0.0 <= values[k + 1]:
            return _root(above, times[k], times[k + 1])
        if k > 0 and values[k - 1] < values[k] > values[k + 1] and -1.0 < values[k] < 0.0:
            # A short period above the limit, between two samples.
            peak = _peak(above, times[k - 1], times[k + 1])
            if above(peak) >= 0.0:
                return _root(above, times[k - 1], peak)
        dip = k > 0 and values[k - 1] > values[k] < values[k + 1] and 0.0 <= values[k] < 1.0
        if dip:
            low = _peak(lambda t: -above(t), times[k - 1], times[k + 1])
            if above(low) < 0.0:
                return _root(above, low, times[k + 1])
        k += 1
    heights = [altitude(t) for t in times]
    raise NoEvent(event.body, min(heights), max(heights))


def clock_time(clock: Callable[[float], float], hour: float, start: float, end: float) -> float:
    """Time at which a 24-hour clock shows an hour.

    Parameters
    ----------
    clock : callable
        Hour of the clock at a time in days. [h]
    hour : float
        Hour, 0 to 24. [h]
    start, end : float
        Times about one day of the clock apart. [day]
    """
    turn = end - start
    days = start + turn * ((hour - clock(start)) % 24.0) / 24.0
    for _ in range(12):
        step = math.remainder(hour - clock(days), 24.0) / 24.0 * turn
        days += step
        if abs(step) < _PRECISION:
            break
    return days


def _root(function: Callable[[float], float], low: float, high: float) -> float:
    """Upward zero crossing, by bisection."""
    while high - low > _PRECISION:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if function(middle) < 0.0 else (low, middle)
    return high


def _peak(function: Callable[[float], float], low: float, high: float) -> float:
    """Maximum of a unimodal function, by ternary search."""
    while high - low > 1e-5:
        third = (high - low) / 3.0
        if function(low + third) < function(high - third):
            low += third
        else:
            high -= third
    return 0.5 * (low + high)
