"""Stars of the catalogue over one planet: where they stand, their light, and by day."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import Camera, MoonLight, ParameterError, Scene, load_planet, render, solve
from airlight.color.display import to_display
from airlight.ephemeris.instant import days_of, ephemeris_time
from airlight.ephemeris.sky import Place, horizon_axes
from airlight.paint.star_points import add_catalogue
from airlight.solvers.moments.solution import MomentsSolution
from airlight.system.stars import stars

NIGHT = datetime(2026, 1, 15, 21, 30, tzinfo=UTC)
ALPS = Place(latitude=46.5, longitude=8.0)


@pytest.fixture(scope="module")
def earth() -> MomentsSolution:
    return solve(load_planet("earth"), (680.0, 550.0, 440.0), "preview")


def sirius() -> tuple[float, float]:
    """True zenith angle and bearing of Sirius by another way of the same ephemeris. [deg]"""
    from astronomy import Body, DefineStar, Equator, Horizon, Observer, Refraction

    time, seen_from = ephemeris_time(days_of(NIGHT)), Observer(46.5, 8.0, 0.0)
    DefineStar(Body.Star1, 6.7525, -16.7161, 8.6)  # J2000, hours and degrees
    place = Equator(Body.Star1, time, seen_from, ofdate=True, aberration=True)
    seen = Horizon(time, seen_from, place.ra, place.dec, Refraction.Airless)
    return 90.0 - seen.altitude, seen.azimuth


def looking_at_sirius(**more: float) -> Scene:
    zenith, bearing = sirius()
    camera = Camera(width=120, height=80, field_of_view=6.0, look_zenith=zenith)
    return Scene(
        camera=camera, altitude=500.0, sun_zenith=143.0, latitude=46.5, longitude=8.0,
        sun_azimuth=bearing, time=NIGHT, **more,
    )  # fmt: skip


def test_a_star_stands_where_the_ephemeris_has_it() -> None:
    # aberration, 0.006°, and the rounding of the catalogue, 0.001°
    east, north, up = horizon_axes(ALPS, days_of(NIGHT)) @ stars().directions[0]
    zenith, bearing = sirius()
    assert_allclose(np.degrees(np.arccos(up)), zenith, atol=0.01)
    assert_allclose(np.degrees(np.arctan2(east, north)) % 360.0, bearing, atol=0.012)


def test_a_star_sends_its_light_through_the_air(earth: MomentsSolution) -> None:
    # The law: irradiance times transmittance, spread over pixels by their solid angle; 1 % for the
    # pixels' own angle off the axis and for the star's lift.
    scene = looking_at_sirius()
    rgb = np.zeros((80, 120, 3), np.float32)
    add_catalogue(rgb, scene, earth, "earth")
    row, column = np.unravel_index(int(rgb[..., 1].argmax()), (80, 120))
    assert abs(row - 39.5) < 2.0  # lifted by less than two pixels
    assert abs(column - 59.5) < 1.5
    angle = scene.camera.pixel_angle**2
    got = rgb[row - 2 : row + 3, column - 2 : column + 3].sum(axis=(0, 1)) * angle
    source = earth.lights[0]
    weights = source.colors() / source.irradiance[:, None]
    zenith, _ = sirius()
    through = np.asarray(earth.transmittance(altitude=500.0, view_zenith=zenith))
    wanted = (through * stars().irradiances(earth.wavelengths)[0]) @ weights
    assert_allclose(got, wanted, rtol=0.01)


def test_stars_are_outshone_by_day_and_hidden_by_the_moon(earth: MomentsSolution) -> None:
    zenith, _ = sirius()
    day = replace(looking_at_sirius(), sun_zenith=50.0)
    frame = render(earth, day)
    lit = frame.rgb.copy()
    add_catalogue(lit, day, earth, "earth")
    shown = [to_display(one, frame.exposure, dither=False).astype(int) for one in (lit, frame.rgb)]
    assert np.abs(shown[0] - shown[1]).max() <= 3
    hidden = looking_at_sirius(others=(MoonLight(zenith=zenith, azimuth=0.0),))  # type: ignore[arg-type]
    rgb, free = np.zeros((2, 80, 120, 3), np.float32)
    add_catalogue(rgb, hidden, earth, "earth")
    add_catalogue(free, looking_at_sirius(), earth, "earth")
    assert rgb.max() < 0.01 * free.max()


def test_stars_need_a_time_and_the_earth(earth: MomentsSolution) -> None:
    rgb = np.zeros((80, 120, 3), np.float32)
    for scene, body in ((Scene(), "earth"), (looking_at_sirius(), "mars")):
        with pytest.raises(ParameterError, match="a place and time on Earth"):
            add_catalogue(rgb, scene, earth, body)
