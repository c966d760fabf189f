"""Short formula of live pictures against the ephemeris, and its calendar against Python's."""

from __future__ import annotations

import math
from datetime import UTC, datetime, timedelta

import numpy as np
import pytest

from airlight.geometry.ephemeris.instant import days_of
from airlight.geometry.ephemeris.sun_formula import (
    NUMBERED,
    date_after,
    days_of_date,
    point_below_sun,
)
from airlight.geometry.ephemeris.sun_vector import solar_point
from airlight.geometry.ephemeris.world import WORLDS
from airlight.physics.constants import ASTRONOMICAL_UNIT

#: Bounds of the module's docstring [deg], and of the distance. Measured: 0.0082, 0.0444, 0.2038;
#: 7.5e-5, 1.9e-4, 2.7e-3.
BOUNDS = {"earth": (0.01, 1e-4), "mars": (0.05, 3e-4), "titan": (0.25, 4e-3)}


def test_all_worlds_have_a_formula() -> None:
    assert set(NUMBERED) <= set(WORLDS)


@pytest.mark.parametrize("name", NUMBERED)
def test_sun_is_within_the_stated_bound_from_1950_to_2050(name: str) -> None:
    index, (angle, share) = NUMBERED.index(name), BOUNDS[name]
    for days in np.random.default_rng(3).uniform(-18_262.0, 18_262.0, 400):
        point = solar_point(WORLDS[name], float(days))
        latitude, longitude, distance = point_below_sun(index, float(days))
        east = math.remainder(longitude - point.longitude, 360.0)
        off = math.hypot(latitude - point.latitude, east * math.cos(math.radians(latitude)))
        assert off < angle
        assert abs(distance * ASTRONOMICAL_UNIT / point.distance - 1.0) < share


def test_dates_are_python_s() -> None:
    for year in (1950, 1999, 2000, 2001, 2024, 2026, 2050):
        for day in (0, 58, 59, 364):
            time = datetime(year, 1, 1, 7, 30, tzinfo=UTC) + timedelta(days=day)
            ours = days_of_date(year, day + 1.0, 7.5)
            assert ours == pytest.approx(days_of(time), abs=1e-9)


@pytest.mark.parametrize("hours", [0.5, 40.0, 9000.0, -0.5, -9000.0, 20000.0])
def test_later_dates_are_python_s(hours: float) -> None:
    start = datetime(2024, 12, 30, 18, tzinfo=UTC)
    later = start + timedelta(hours=hours)
    year, day, hour = date_after(2024.0, 365.0, 18.0, hours)
    assert (year, day) == (later.year, later.timetuple().tm_yday)
    assert hour == pytest.approx(later.hour + later.minute / 60.0, abs=1e-9)
