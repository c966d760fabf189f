"""Pictures with even layers of cloud."""

from functools import lru_cache
from importlib.resources import files

import numpy as np
import pytest

from airlight import Camera, Scene, load_planet
from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_optics import CloudOptics, droplets
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


def layer(depth):
    """Even layer of an optical depth."""
    return CloudsAround(
        CloudField(
            extinction=np.full((4, 4, 8), depth / 500.0, np.float32),
            spacing=(500.0, 500.0, 62.5),
            base=1000.0,
            beyond="periodic",
        ),
        lambda nm: optics(tuple(np.asarray(nm).tolist())),
        quality="default",
    )


def look(air, zenith, clouds=None, altitude=2.0, azimuth=90.0, field_of_view=0.3):
    camera = Camera(
        width=4,
        height=3,
        field_of_view=field_of_view,
        look_zenith=zenith,
        look_azimuth=azimuth,
    )
    scene = Scene(altitude=altitude, sun_zenith=40.0, camera=camera)
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
        (2.0, 0.0, 0.06),
        (2.0, 60.0, 0.045),
        (2.0, 80.0, 0.11),
        (500.0, 180.0, 0.06),  # the ground below the layer
        (1e4, 180.0, 0.06),
        (1e4, 120.0, 0.06),
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
