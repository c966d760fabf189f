"""Places by name: against other sources, and however they are written."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from airlight.errors import ParameterError
from airlight.geometry.ephemeris.gazetteer import find_place, known_places
from airlight.viewer.navigation.places import places_of

ZONES = Path("/usr/share/zoneinfo/zone.tab")


@pytest.mark.parametrize(
    ("name", "body", "expected"),
    [
        ("dead sea", "earth", "Dead Sea"),
        ("ZURICH", "earth", "Zürich (CH)"),
        ("são paulo", "earth", "São Paulo (BR)"),
        ("Birmingham", "earth", "Birmingham (GB)"),  # the larger one
        ("london ca", "earth", "London (CA)"),
        ("Everest", "earth", "Mount Everest"),
        ("curiosity", "mars", "Gale"),
        ("Apollo-11", None, "Apollo 11"),
    ],
)
def test_places_are_found_whatever_case_accents_and_marks(
    name: str, body: str | None, expected: str
) -> None:
    assert find_place(name, body).name == expected


def test_cities_lie_where_the_tz_database_has_them() -> None:
    # A second source: principal locations of zones, to a minute of arc; a city's middle differs by
    # up to 0.3°. Names that both have, of zones named for a city.
    if not ZONES.exists():
        pytest.skip("the system has no tz database")
    met = 0
    for line in ZONES.read_text(encoding="utf-8").splitlines():
        if line.startswith("#"):
            continue
        country, code, zone = line.split("\t")[:3]
        signs = [k for k, letter in enumerate(code) if letter in "+-"]
        halves = code[: signs[1]], code[signs[1] :]
        latitude, longitude = (_degrees(one, 2 + k) for k, one in enumerate(halves))
        try:
            place = find_place(f"{zone.rpartition('/')[2].replace('_', ' ')} {country}", "earth")
        except ParameterError:
            continue
        met += 1
        assert abs(place.latitude - latitude) < 0.3, zone
        east = math.remainder(place.longitude - longitude, 360.0)
        assert abs(east) * math.cos(math.radians(latitude)) < 0.3, zone
    assert met > 150


def _degrees(text: str, digits: int) -> float:
    """Degrees of ±DDMM or ±DDMMSS, or of three digits of degrees."""
    sign, figures = -1.0 if text[0] == "-" else 1.0, text[1:]
    parts = figures[:digits], figures[digits : digits + 2], figures[digits + 2 :]
    return sign * sum(float(one or 0) / 60.0**k for k, one in enumerate(parts))


def test_coordinates_are_on_a_sphere_and_names_unique() -> None:
    for places in known_places().values():
        names = [one.name for one in places]
        assert len(set(names)) == len(names)
        for one in places:
            assert abs(one.latitude) <= 90.0
            assert abs(one.longitude) <= 180.0
    assert [one.name for one in places_of("titan")] == ["Huygens"]
    assert places_of(None) == ()


def test_an_unknown_place_is_refused_with_the_closest_names() -> None:
    with pytest.raises(ParameterError, match="Stockholm"):
        find_place("Stokholm", "earth")
    with pytest.raises(ParameterError, match="this one is on mars"):
        find_place("Jezero", "earth")
