"""Places of bodies in one frame, against the sky of an observer and the 2017 eclipse."""

from __future__ import annotations

from datetime import UTC, datetime

import numpy as np
import pytest

from airlight.errors import ParameterError
from airlight.geometry.ephemeris import Place, moon_seen, sub_lunar_point, sub_solar_point, sun_seen
from airlight.geometry.ephemeris.positions import BODIES, position_of
from airlight.scene.system.vectors import frame_of

TIMES = [datetime(1984, 3, 1, 5, tzinfo=UTC), datetime(2017, 8, 21, 18, 26, tzinfo=UTC),
         datetime(2025, 11, 3, 22, 10, tzinfo=UTC)]  # fmt: skip


@pytest.mark.parametrize("time", TIMES)
def test_the_earth_turns_as_its_sub_points_say(time: datetime) -> None:
    # Second method: sidereal time and the equator of date.
    earth = position_of("earth", time)
    axes = frame_of(np.array(earth.pole), earth.prime_meridian)
    for body in ("sun", "moon"):
        x, y, z = axes @ np.array(position_of(body, time).position)
        latitude = np.degrees(np.arctan2(z, np.hypot(x, y)))
        longitude = np.degrees(np.arctan2(y, x))
        if body == "sun":
            point = sub_solar_point("earth", time)
            expected = point.latitude, point.longitude
        else:
            expected = sub_lunar_point(time)
        assert latitude == pytest.approx(expected[0], abs=0.01)
        assert np.remainder(longitude - expected[1] + 180.0, 360.0) == pytest.approx(
            180.0, abs=0.01
        )


def test_the_moon_faces_the_earth_within_its_libration() -> None:
    for time in TIMES:
        moon = position_of("moon", time)
        x, y, z = frame_of(np.array(moon.pole), moon.prime_meridian) @ -np.array(moon.position)
        assert abs(np.degrees(np.arctan2(y, x))) < 8.0
        assert abs(np.degrees(np.arctan2(z, x))) < 7.0


def test_sun_and_moon_meet_over_hopkinsville_in_2017() -> None:
    # Greatest eclipse at 18:25:32 UT, 36.97 N 87.67 W (Espenak, NASA): the Moon 1.03 suns wide,
    # centred within the few minutes of arc that totality leaves.
    place = Place(body="earth", latitude=36.97, longitude=-87.67)
    time = datetime(2017, 8, 21, 18, 25, 32, tzinfo=UTC)
    sun, moon = sun_seen(place, time), moon_seen(place, time)
    apart = np.degrees(np.arccos(np.clip(sun.direction @ moon.direction, -1.0, 1.0)))
    assert apart < 0.01
    assert moon.angular_radius / sun.angular_radius == pytest.approx(1.03, abs=0.01)


def test_bodies_and_times_are_checked() -> None:
    with pytest.raises(ParameterError, match=r"ephemeris is 'vulcan'; allowed: earth, moon"):
        position_of("vulcan", TIMES[0])
    assert all(np.isfinite(position_of(name, TIMES[0]).position).all() for name in BODIES)
