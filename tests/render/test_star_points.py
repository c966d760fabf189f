"""Stars of the catalogue over one planet: where they stand, their light, and by day."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import (
    Camera,
    MoonLight,
    ParameterError,
    Scene,
    load_planet,
    local_ground,
    render,
    solve,
)
from airlight.geometry.ephemeris.instant import days_of, ephemeris_time
from airlight.geometry.ephemeris.sky import Place, horizon_axes, horizon_axes_by_sun, sun_after
from airlight.geometry.ephemeris.sun_vector import meridian_axes
from airlight.geometry.ephemeris.world import WORLDS
from airlight.image.display import to_display
from airlight.render.star_points import add_catalogue
from airlight.scene.system.stars import stars
from airlight.solver.moments.solution import MomentsSolution
from airlight.studies.film import Quality, load_film
from airlight.studies.film.frame_spec import PlanetFrameSpec

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
    transmittance = np.asarray(earth.transmittance(altitude=500.0, view_zenith=zenith))
    wanted = (transmittance * stars().irradiances(earth.wavelengths)[0]) @ weights
    assert_allclose(got, wanted, rtol=0.01)


def test_stars_are_outshone_by_day_and_hidden_by_the_moon(earth: MomentsSolution) -> None:
    zenith, _ = sirius()
    day = replace(looking_at_sirius(), sun_zenith=50.0)
    frame = render(earth, day)
    lit = frame.rgb.copy()
    add_catalogue(lit, day, earth, "earth")
    shown = [to_display(one, frame.exposure, dither=False).astype(int) for one in (lit, frame.rgb)]
    assert np.abs(shown[0] - shown[1]).max() <= 3
    hidden = looking_at_sirius(secondary_lights=(MoonLight(zenith=zenith, azimuth=0.0),))  # type: ignore[arg-type]
    rgb, free = np.zeros((2, 80, 120, 3), np.float32)
    add_catalogue(rgb, hidden, earth, "earth")
    add_catalogue(free, looking_at_sirius(), earth, "earth")
    assert rgb.max() < 0.01 * free.max()


def test_stars_need_a_known_world_and_lines_that_differ(earth: MomentsSolution) -> None:
    rgb = np.zeros((80, 120, 3), np.float32)
    for body in (None, "kepler-22b"):
        with pytest.raises(ParameterError, match="a planet whose body is"):
            add_catalogue(rgb, looking_at_sirius(), earth, body)
    disc = Camera(projection="orthographic", width=120, height=80, extent=14e6)
    with pytest.raises(ParameterError, match="cannot be combined with projection orthographic"):
        add_catalogue(rgb, Scene(camera=disc), earth, "earth")


@pytest.mark.parametrize("body", ["earth", "mars", "titan"])
def test_without_a_time_the_sun_stands_among_its_stars(body: str) -> None:
    # The second method: the ephemeris' own sun at that day, in the frame of the stars, is where the
    # scene has it. Days are interpolated: 0.3°, on Titan, whose year is sampled more coarsely, 1°.
    place = Place(body=body, latitude=35.0, longitude=12.0)
    time = days_of(datetime(2026, 2, 3, 15, 20, tzinfo=UTC))
    sun = sun_after(place, time)
    axes = horizon_axes_by_sun(place, sun.zenith, sun.azimuth)
    towards = sun.direction @ axes
    world = WORLDS[body]
    days = np.linspace(0.0, world.year, 4000)
    suns = np.array([-_heliocentric(world.orbit, day) for day in days])
    apart = np.degrees(np.arccos(np.clip(suns @ towards, -1.0, 1.0)))
    assert apart.min() < (1.0 if body == "titan" else 0.3)
    assert_allclose(axes @ axes.T, np.eye(3), atol=1e-5)


def _heliocentric(orbit: str, days: float) -> np.ndarray:
    from astronomy import Body, HelioVector

    seen = HelioVector(Body[orbit], ephemeris_time(days))
    vector = np.array([seen.x, seen.y, seen.z])
    return np.asarray(vector / np.linalg.norm(vector))


def test_the_pole_stands_at_the_latitude_in_the_north() -> None:
    # The law of the celestial pole, on any world, with or without a time.
    for body, pole in (("earth", (0.0, 0.0, 1.0)), ("mars", None)):
        place = Place(body=body, latitude=59.0, longitude=18.0)
        day = days_of(NIGHT)
        if pole is None:
            pole = tuple(meridian_axes(WORLDS[body], day, 0.0)[2])
        for axes in (horizon_axes(place, day), horizon_axes_by_sun(place, 100.0, 250.0)):
            east, north, up = axes @ np.array(pole)
            # precession since J2000, up to 0.15° in 26 years
            assert_allclose(np.degrees(np.arcsin(up)), 59.0, atol=0.2)
            assert_allclose(np.degrees(np.arctan2(east, north)), 0.0, atol=0.4)


def test_a_sun_that_never_stands_so_gives_the_nearer_solstice() -> None:
    # At the pole the sun's zenith angle is 90° less its declination, which is 23.4° at most.
    place = Place(latitude=90.0, longitude=0.0)
    high, solstice = (horizon_axes_by_sun(place, z, 180.0) for z in (20.0, 66.56))
    assert_allclose(high, solstice, atol=0.02)


def test_a_film_of_a_planet_has_stars() -> None:
    # The second method: the same frame without stars, and the catalogue added to it.
    changes = {"view.stars": True, "view.sun_zenith": "120 deg", "view.look_at": "S/40"}
    film = load_film("earth", changes)
    nm = (680.0, 550.0, 440.0)
    how = Quality(width=96, height=54, wavelengths=nm, quality="preview")
    still = film.frame_spec(0, how)
    assert isinstance(still, PlanetFrameSpec)
    dark = replace(still, stars=False)
    assert still.defined_by != dark.defined_by
    wanted = dark.render().rgb
    sky = np.median(wanted)
    solution = solve(local_ground(
        still.planet, latitude=still.scene.latitude, longitude=still.scene.longitude,
        altitude=still.scene.altitude,
    ), how.wavelengths, how.quality)  # fmt: skip
    add_catalogue(wanted, still.scene, solution, "earth")
    assert wanted.max() > 10.0 * sky
    assert_allclose(still.render().rgb, wanted, rtol=1e-6)
