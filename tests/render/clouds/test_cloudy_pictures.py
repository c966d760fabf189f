"""Pictures with even layers of cloud."""

from dataclasses import replace
from functools import lru_cache
from importlib.resources import files

import numpy as np
import pytest

from airlight import Camera, Scene, load_planet
from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_optics import CloudOptics, droplets
from airlight.render.clouds.cloud_deck import CloudDeck
from airlight.render.clouds.clouds_around import CloudsAround
from airlight.render.render import render
from airlight.render.solve_planet import solve_planet

pytestmark = pytest.mark.slow

NM = (440.0, 520.0, 600.0, 680.0)


@pytest.fixture(scope="module")
def air():
    return solve_planet(load_planet("earth-atmosphere-plus"), NM, "preview", polarisation=False)


@lru_cache
def optics(nm):
    return CloudOptics.of_particles(droplets(10e-6, 0.1), nm)


def deck(depth, base=1000.0, levels=8):
    """Even deck of an optical depth in levels of 62.5 m."""
    field = CloudField(
        extinction=np.full((4, 4, levels), depth / (62.5 * levels), np.float32),
        spacing=(500.0, 500.0, 62.5),
        base=base,
        beyond="periodic",
    )
    return CloudDeck(field, lambda nm: optics(tuple(np.asarray(nm).tolist())))


def layer(depth):
    """Even layer of an optical depth."""
    return CloudsAround((deck(depth),), quality="default")


def look(air, zenith, clouds=None, altitude=2.0, azimuth=90.0, field_of_view=0.3, sun=40.0):
    camera = Camera(
        width=4,
        height=3,
        field_of_view=field_of_view,
        look_zenith=zenith,
        look_azimuth=azimuth,
    )
    scene = Scene(altitude=altitude, sun_zenith=sun, camera=camera)
    return render(air, scene, clouds=clouds).rgb.mean((0, 1))


@pytest.mark.parametrize("zenith", [0.0, 60.0, 80.0])
def test_a_cloud_without_depth_is_not_there(air, zenith):
    np.testing.assert_allclose(look(air, zenith, layer(1e-6)), look(air, zenith), rtol=3e-3)


@pytest.mark.parametrize("zenith", [180.0, 120.0])
def test_ground_below_a_cloud_without_depth_is_lit_by_the_box(air, zenith):
    """The sky light of the box is that of the spherical solution within 0.3 %."""
    seen = look(air, zenith, layer(1e-6), altitude=1e4)
    np.testing.assert_allclose(seen, look(air, zenith, altitude=1e4), rtol=3e-3)


@pytest.fixture(scope="module")
def thick(tmp_path_factory):
    """The same planet with a layer of optical depth 10 as a constituent."""
    text = files("airlight").joinpath("planets/presets/earth-atmosphere-plus.toml").read_text()
    cloud = """
[[constituents]]
name = "cloud"
particles = { index = "water", sizes = { kind = "gamma", effective_radius = "10 um", \
effective_variance = 0.1 }, optical_depth = 10, at = "550 nm" }
profile = { kind = "layered", layers = [{ width = "1 km" }, { width = "500 m", \
constant_term = 1 }, {}] }
"""
    path = tmp_path_factory.mktemp("planets") / "overcast.toml"
    path.write_text(text + cloud)
    return load_planet(path)


@pytest.fixture(scope="module")
def overcast(thick):
    return solve_planet(thick, NM, "preview", polarisation=False)


@pytest.mark.parametrize(
    ("altitude", "zenith", "within"),
    [
        # chosen after the first results: 0.9, 0.8, 2.0, 1.5, 1.5, 0.1 and 1.7 %
        (2.0, 0.0, 0.02),
        (2.0, 60.0, 0.02),
        (2.0, 80.0, 0.03),
        (500.0, 180.0, 0.025),  # the ground below the layer
        (1e4, 180.0, 0.025),
        (1e4, 120.0, 0.02),
        (5000.0, 60.0, 0.02),  # air above the tops; chosen before
        (4e5, 180.0, 0.025),
    ],
)
def test_even_layer_is_that_of_the_one_dimensional_solution(
    air, overcast, altitude, zenith, within
):
    seen = look(air, zenith, layer(10.0), altitude=altitude)
    np.testing.assert_allclose(seen, look(overcast, zenith, altitude=altitude), rtol=within)


def test_a_picture_of_three_wavelengths_has_the_light_of_clouds(thick):
    """The one-dimensional solution of the same wavelengths; boxes solve four together."""
    planet, nm = load_planet("earth-atmosphere-plus"), (440.0, 550.0, 680.0)
    air, overcast = (
        solve_planet(one, nm, "preview", polarisation=False) for one in (planet, thick)
    )
    np.testing.assert_allclose(look(air, 0.0, layer(10.0)), look(overcast, 0.0), rtol=0.06)


@pytest.mark.parametrize(("zenith", "within"), [(75.0, 0.04), (85.0, 0.15)])
def test_overcast_falls_towards_the_horizon_as_in_one_dimension(air, overcast, zenith, within):
    """The source is linear down to the base: constant in its lowest half level, 6 and 21 %."""
    seen, expected = (
        look(one, zenith, clouds)[1] / look(one, 0.0, clouds)[1]
        for one, clouds in ((air, layer(10.0)), (overcast, None))
    )
    assert seen == pytest.approx(expected, rel=within)


def test_overcast_zenith_is_brighter_than_the_horizon(air):
    """The CIE standard overcast sky has (1 + 2 cos θ)/3: 2.2 at 80°, above dark ground."""
    zenith, low = (look(air, angle, layer(10.0))[0] for angle in (0.0, 80.0))
    assert 1.6 < zenith / low < 2.4


def test_clouds_of_three_wavelengths_shine():
    three = solve_planet(
        load_planet("earth-atmosphere-plus"), NM[:3], "preview", polarisation=False
    )
    seen = look(three, 180.0, layer(10.0), altitude=1e4)
    assert np.all(seen > 3.0 * look(three, 180.0, altitude=1e4))


@pytest.mark.parametrize("zenith", [180.0, 130.0])
def test_steps_of_wide_pixels_are_not_higher_than_a_level(air, zenith):
    wide, narrow = (
        look(air, zenith, layer(10.0), altitude=1e5, field_of_view=angle) for angle in (2.0, 0.002)
    )
    np.testing.assert_allclose(wide, narrow, rtol=3e-3)


@pytest.mark.parametrize(("altitude", "zenith"), [(2.0, 0.0), (2.0, 60.0), (3000.0, 150.0)])
def test_two_decks_one_above_the_other_are_one_layer(air, altitude, zenith):
    """A layer cut in two; higher orders of the halves pass through the light of the boxes."""
    decks = deck(2.0, levels=4), deck(2.0, base=1250.0, levels=4)
    two = CloudsAround(decks, quality="default")
    found = look(air, zenith, two, altitude)
    np.testing.assert_allclose(found, look(air, zenith, layer(4.0), altitude), rtol=0.05)


@pytest.mark.parametrize(
    "upper", [deck(2.0), deck(2.0, base=1250.0, levels=4)], ids=["the same heights", "upper half"]
)
@pytest.mark.parametrize(("altitude", "zenith"), [(2.0, 60.0), (3000.0, 150.0)])
def test_decks_at_the_same_heights_add_up(air, upper, altitude, zenith):
    """Two even layers, of which one is in the other, against one that has both extinctions."""
    extinction = np.full(8, 2.0 / 500.0, np.float32)
    extinction[8 - upper.field.extinction.shape[2] :] += upper.field.extinction[0, 0]
    lower = deck(2.0)
    cells = np.broadcast_to(extinction, (4, 4, 8)).copy()
    both = CloudDeck(replace(lower.field, extinction=cells), lower.optics_at)
    found, expected = (
        look(air, zenith, CloudsAround(decks, quality="default"), altitude)
        for decks in ((lower, upper), (both,))
    )
    np.testing.assert_allclose(found, expected, rtol=0.02)


@pytest.mark.validation
@pytest.mark.parametrize("sun", [0.0, 80.0])
@pytest.mark.parametrize(
    ("altitude", "zenith"), [(2.0, 60.0), (5000.0, 120.0), (5000.0, 60.0), (4e5, 180.0)]
)
def test_a_deck_without_depth_above_others_is_not_there(air, altitude, zenith, sun):
    """Also for the air above the tops, which is in the light of the clouds below."""
    decks = deck(2.0), deck(1e-6, base=8000.0)
    found, expected = (
        look(air, zenith, CloudsAround(some, quality="default"), altitude, sun=sun)
        for some in (decks, decks[:1])
    )
    np.testing.assert_allclose(found, expected, rtol=4e-3)


def test_sky_above_an_overcast_is_brighter(air):
    """By the light that the clouds reflect, as in the solution with the layer."""
    clear, found = (look(air, 60.0, clouds, 5000.0) for clouds in (None, layer(10.0)))
    assert np.all(found > 1.05 * clear)


@pytest.fixture(scope="module")
def broken():
    """Broken clouds, cover 0.4, of cells that are far narrower than a pixel."""
    random = np.random.default_rng(3)
    columns = np.repeat(np.repeat(random.random((8, 8)) < 0.4, 4, axis=0), 4, axis=1)
    cells = np.repeat(columns[:, :, None], 4, axis=2).astype(np.float32)
    field = replace(
        deck(0.0).field, extinction=cells * np.float32(0.04), spacing=(100.0, 100.0, 62.5)
    )
    return CloudsAround((CloudDeck(field, deck(0.0).optics_at),))


@pytest.mark.parametrize(("zenith", "within"), [(180.0, 0.08), (130.0, 0.09)])
def test_wide_pixels_are_the_mean_of_what_is_in_them(air, broken, zenith, within):
    """Joined cells keep gaps transparent; sides of clouds are as bright as their tops."""
    camera = Camera(width=96, height=96, field_of_view=0.8, look_zenith=zenith, look_azimuth=90.0)
    scene = Scene(altitude=4e5, sun_zenith=40.0, camera=camera, ground="plain")
    narrow = render(air, scene, clouds=broken).rgb
    wide = render(air, replace(scene, camera=replace(camera, width=3, height=3)), clouds=broken).rgb
    np.testing.assert_allclose(wide.mean((0, 1)), narrow.mean((0, 1)), rtol=within)
    # no grain: 1.9 km of a random field of blocks of 400 m
    assert wide[..., 1].std() < 0.3 * narrow[..., 1].std()
