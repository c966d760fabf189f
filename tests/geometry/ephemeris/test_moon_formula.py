"""Moon of live pictures against the ephemeris."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose

from airlight.geometry.ephemeris.moon_formula import moon_at
from airlight.geometry.ephemeris.sky import Place, moon_after, sun_after


def test_moon_is_within_a_tenth_of_a_degree_of_the_ephemeris() -> None:
    # The bound that the module states, of 400 places and times of 1950 to 2050. Its phase is that
    # of the place: from the directions of sun and Moon there, and their distances.
    random = np.random.default_rng(3)
    off, phases = [], []
    for days in random.uniform(-18262.0, 18262.0, 400):
        place = Place(latitude=random.uniform(-80, 80), longitude=random.uniform(-180, 180))
        moon, sun = moon_after(place, days), sun_after(place, days)
        zenith, azimuth, phase, radius = moon_at(place.latitude, place.longitude, days)
        z, a = np.radians(zenith), np.radians(azimuth)
        seen = np.array([np.sin(z) * np.sin(a), np.sin(z) * np.cos(a), np.cos(z)])
        off.append(np.degrees(np.linalg.norm(seen - moon.direction)))
        away = sun.distance * sun.direction - moon.distance * moon.direction
        cosine = -(away @ moon.direction) / np.linalg.norm(away)
        phases.append(phase - np.degrees(np.arccos(cosine)))
        assert_allclose(radius, moon.angular_radius, rtol=4e-3)
    assert max(off) < 0.09
    assert np.mean(off) < 0.025
    assert_allclose(phases, 0.0, atol=0.1)
