"""Instants: coordinated universal time as a count of days, and as text."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from typing import TYPE_CHECKING, Final

from airlight.errors import ParameterError

if TYPE_CHECKING:
    from astronomy import Time

#: Epoch: 2000-01-01 12:00 UTC.
EPOCH: Final = datetime(2000, 1, 1, 12, tzinfo=UTC)
#: First and last year: the theory of the planets is truncated for these centuries.
YEARS: Final = (1700, 2199)
#: Seconds of a day.
_DAY: Final = 86400.0


def days_of(time: datetime, field: str = "time") -> float:
    """Days from 2000-01-01 12:00 UTC to an instant.

    Parameters
    ----------
    time : datetime
        Instant, with its zone.
    field : str
        Field named in the error.

    Raises
    ------
    ParameterError
        If it is not a datetime, has no zone, or is outside the years 1700 to 2199.

    Examples
    --------
    >>> days_of(datetime(2000, 1, 2, 0, tzinfo=UTC))
    0.5
    """
    if not isinstance(time, datetime):
        raise ParameterError(field, time, "a datetime with its zone")
    if time.tzinfo is None:
        raise ParameterError(field, time.isoformat(), "a time with its zone")
    moment = time.astimezone(UTC)
    if not YEARS[0] <= moment.year <= YEARS[1]:
        raise ParameterError(field, time.isoformat(), f"the years {YEARS[0]} to {YEARS[1]}")
    return (moment - EPOCH).total_seconds() / _DAY


def time_at(days: float) -> datetime:
    """Instant some days after 2000-01-01 12:00 UTC; to the microsecond.

    Examples
    --------
    >>> time_at(0.5).isoformat()
    '2000-01-02T00:00:00+00:00'
    """
    return EPOCH + timedelta(days=days)


def universal_time(time: datetime) -> str:
    """Instant as text, in coordinated universal time, to the second.

    Examples
    --------
    >>> universal_time(time_at(0.5))
    '2000-01-02T00:00:00Z'
    """
    rounded = time.astimezone(UTC) + timedelta(microseconds=500_000)
    return rounded.replace(microsecond=0, tzinfo=None).isoformat() + "Z"


def ephemeris_time(days: float) -> Time:
    """Instant for astronomy-engine, which does not distinguish UTC from UT1 (less than 0.9 s)."""
    from astronomy import Time

    return Time(days)
