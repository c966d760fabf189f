"""Times as text: with a zone, as local or solar time, or as a word such as sunset."""

from __future__ import annotations

import re
from datetime import UTC, date, datetime, timedelta
from datetime import time as clock_of_day
from typing import Final
from zoneinfo import ZoneInfo, ZoneInfoNotFoundError

from airlight.errors import ConflictError, ParameterError
from airlight.geometry.ephemeris.events import (
    WORDS,
    Event,
    NoEvent,
    clock_time,
    sun_at,
    time_of_event,
)
from airlight.geometry.ephemeris.instant import days_of, time_at
from airlight.geometry.ephemeris.place_text import written_place
from airlight.geometry.ephemeris.sky import Place
from airlight.geometry.ephemeris.solar_time import time_of_season, true_solar_time
from airlight.physics.units import Measure, quantity

#: Time zone of local solar time.
SOLAR: Final = "solar"
_FORM: Final = (
    "a time with its zone, 2026-06-21T22:10+02:00 or 2026-06-21T20:10Z; without, if a zone is set; "
    f"or, also after a date, {', '.join(WORDS)}, evening 5deg (sun's elevation)"
)
_CLOCK = re.compile(r"(?:(\d{4}-\d{2}-\d{2})[T ]+)?(\d{1,2}:\d{2}(?::\d{2}(?:\.\d+)?)?)")
_WORD = re.compile(r"(?:(\d{4}-\d{2}-\d{2})[T ]+)?([a-z-]+)")
_ELEVATION = re.compile(
    r"(?:(\d{4}-\d{2}-\d{2})[T ]+)?(morning|evening) +([+-]?\d{1,2}(?:\.\d+)?) *(?:deg|°)"
)
#: Start of the search for a season if no date is given.
_FIRST_SEASON: Final = date(2000, 1, 1)


def read_time(
    text: str,
    place: Place,
    *,
    zone: str | None = None,
    season: Measure | None = None,
    field: str = "time",
    today: date | None = None,
) -> datetime:
    """Instant from a text, at a place.

    Parameters
    ----------
    text : str
        ISO 8601 with a zone (``2026-06-21T22:10+02:00``, ``…Z``) or without one if ``zone`` is
        given; or, also after a date, a word of ``WORDS`` or the true elevation of the sun's centre,
        ``morning 5deg`` or ``evening -3deg``. Default date: today's.
    place : Place
        Place, for words and solar time.
    zone : str, optional
        Zone of a time without one, and of the days of words: an IANA name such as
        ``Europe/Stockholm``, or ``solar``, local true solar time. A day is by default the mean
        solar day of the place; on other worlds than Earth it begins with the UTC date and lasts a
        solar day there.
    season : float, optional
        Longitude Ls of the sun, 0 to 360: the text is a word or a local true solar time, at the
        passage of the sun there nearest in time; the first passage after the date, 2000-01-01 if
        there is none. [deg]
    field : str
        Field named in errors.
    today : date, optional
        Date instead of today's.

    Returns
    -------
    datetime
        Instant in UTC.

    Raises
    ------
    ParameterError
        If the text is invalid, the zone is unknown or given twice, or the event does not occur on
        that day.

    Examples
    --------
    >>> read_time("2026-06-21T22:10+02:00", Place(latitude=59.33, longitude=18.07)).isoformat()
    '2026-06-21T20:10:00+00:00'
    """
    if season is not None:
        season = quantity(season, "deg", "season", bare=True)
    words = text.strip()
    match = _WORD.fullmatch(words.lower())
    height = _ELEVATION.fullmatch(words.lower())
    day: str | None = None
    event: str | Event | None = None
    if height is not None:
        day, event = height[1], sun_at(float(height[3]), height[2])
    elif match is not None and match[2] in WORDS:
        day, event = match[1], match[2]
    if event is not None:
        start, end = _span(day, place, zone, season, field, today)
        try:
            return time_at(time_of_event(event, place, start, end))
        except NoEvent as none:
            where = written_place(place.latitude, place.longitude)
            allowed = f"times that occur: at {where} on that day {none}"
            raise ParameterError(field, text, allowed) from None
    clock = _CLOCK.fullmatch(words)
    if clock is not None and (season is not None or (zone or "").lower() == SOLAR):
        start, end = _span(clock[1], place, SOLAR, season, field, today)
        try:
            shown = clock_of_day.fromisoformat(clock[2].zfill(5) if ":" in clock[2] else clock[2])
        except ValueError:
            raise ParameterError(field, text, "hours 0 to 23, minutes and seconds") from None
        hour = shown.hour + shown.minute / 60.0 + (shown.second + 1e-6 * shown.microsecond) / 3600.0
        world, longitude = place.world, place.longitude
        return time_at(
            clock_time(lambda days: true_solar_time(world, longitude, days), hour, start, end)
        )
    if season is not None:
        allowed = f"with a solar longitude, a local solar time or {', '.join(WORDS)}"
        raise ParameterError(field, text, allowed)
    try:
        moment = datetime.fromisoformat(words)
    except ValueError:
        raise ParameterError(field, text, _FORM) from None
    if moment.tzinfo is not None:
        if zone is not None:
            raise ConflictError(field, "has a zone: cannot be combined with another zone")
        days_of(moment, field)
        return moment.astimezone(UTC)
    if zone is None or clock is None:
        raise ParameterError(field, text, _FORM)
    return _local(moment, _zone(zone), text, field)


def _local(moment: datetime, zone: ZoneInfo, text: str, field: str) -> datetime:
    """Instant of a local time in a zone; the first of two when clocks are set back."""
    instant = moment.replace(tzinfo=zone).astimezone(UTC)
    if instant.astimezone(zone).replace(tzinfo=None) != moment:
        raise ParameterError(field, text, f"times that exist in {zone.key}")
    days_of(instant, field)
    return instant


def _zone(name: str) -> ZoneInfo:
    try:
        return ZoneInfo(name)
    except (ZoneInfoNotFoundError, ValueError, OSError):
        allowed = "an IANA zone such as Europe/Stockholm, or solar"
        raise ParameterError("zone", name, allowed) from None


def _span(
    day: str | None,
    place: Place,
    zone: str | None,
    season: float | None,
    field: str,
    today: date | None,
) -> tuple[float, float]:
    """Start and end of a day at a place. [day]"""
    world = place.world
    solar = zone is None or zone.lower() == SOLAR
    try:
        named = None if day is None else date.fromisoformat(day)
    except ValueError:
        raise ParameterError(field, day, "a date of the calendar") from None
    if season is not None:
        after = days_of(_midnight(named or _FIRST_SEASON), field)
        passage = time_of_season(world, season, after)
        return passage - 0.5 * world.solar_day, passage + 0.5 * world.solar_day
    if not solar and zone is not None and world.name == "earth":
        civil = _zone(zone)
        first = named or today or datetime.now(civil).date()
        following = first + timedelta(days=1)
        return tuple(  # type: ignore[return-value]
            days_of(datetime.combine(one, clock_of_day(), civil), field)
            for one in (first, following)
        )
    offset = place.longitude / 360.0 if world.name == "earth" else 0.0
    chosen = named or today or (datetime.now(UTC) + timedelta(days=offset)).date()
    start = days_of(_midnight(chosen), field) - offset
    return start, start + world.solar_day


def _midnight(day: date) -> datetime:
    return datetime.combine(day, clock_of_day(), UTC)
