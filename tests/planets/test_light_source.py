"""Light sources: their properties, apart from their direction."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight import ParameterError, Scene, load_planet, solve
from airlight.image.four_wavelengths import few_wavelengths
from airlight.image.spectral import sun_color
from airlight.planets.medium import Medium
from airlight.scene.light_position import LightPosition

NM = few_wavelengths(4)


@pytest.fixture(scope="module")
def solution():
    return solve(load_planet("earth-atmosphere-plus"), NM, "preview")


def test_a_scene_and_its_solution_have_as_many_lights(solution):
    # They correspond in order: a direction here, a disc and an irradiance there.
    assert len(Scene().lights) == len(solution.lights) == 1


def test_the_star_is_a_light_source_of_its_planet(solution):
    star = solution.planet.star
    (light,) = solution.lights
    assert light.name == "star"
    assert_allclose(np.degrees(light.angular_radius), star.angular_radius_degrees, rtol=1e-12)
    assert_array_equal(light.irradiance, star.irradiances(NM))
    assert_array_equal(light.spectrum([555.0]), star.irradiances([555.0]))


def test_a_medium_alone_knows_its_light_where_it_was_sampled():
    # Without the planet there is no spectrum between the wavelengths.
    medium = Medium.from_planet(load_planet("earth-atmosphere-plus"), NM)
    (light,) = medium.lights
    assert light.spectrum is None
    assert_array_equal(light.irradiance, medium.solar_irradiance)


def test_the_light_itself_has_the_star_s_colour(solution):
    # Of radiance 1 per irradiance at every wavelength, like a white mirror: the sun's own XYZ.
    (light,) = solution.lights
    spectrum = solution.planet.star.irradiances
    assert_allclose(light.colors().sum(axis=0), sun_color(spectrum), rtol=1e-9)


def test_a_light_stands_where_the_sun_stood(solution):
    # Azimuth 0 is the star's side: towards +x, at its zenith angle from +z.
    (position,) = Scene(sun_zenith=60.0).lights
    assert_allclose(position.direction, [np.sqrt(0.75), 0.0, 0.5], atol=1e-12)
    assert_array_equal(Scene(sun_zenith=60.0).sun_direction, position.direction)


def test_radiance_is_irradiance_times_the_solution_at_the_light(solution):
    # The terms of a future sum over lights: the relative radiance, whatever the source.
    lines, _ = solution.lines_of_sight(altitude=0.0, sun_zenith=60.0, view_zenith=30.0, azimuth=9.0)
    expected = solution.relative_radiance(lines)[0] * solution.lights[0].irradiance
    got = solution.radiance(altitude=0.0, sun_zenith=60.0, view_zenith=30.0, azimuth=9.0)
    assert_allclose(np.ravel(got), expected, rtol=1e-12)


def test_sources_beside_the_star_are_refused_and_not_left_out(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    # No solver knows a second source: its light would be missing, that is 0.
    earth = load_planet("earth-bruneton", {"name": "two stars"})
    twice = earth.lights([550.0]) * 2
    monkeypatch.setattr(type(earth), "lights", lambda self, nm: twice)
    with pytest.raises(ParameterError, match="lights is 2; allowed: 1"):
        Medium.from_planet(earth, [550.0])


def test_a_light_without_a_source_is_refused() -> None:
    # A planet has a single star, of index 0.
    sources = load_planet("earth-bruneton").lights([550.0])
    for index in (1, -1):
        with pytest.raises(ParameterError, match=r"light\.index"):
            LightPosition(zenith=60.0, index=index).source(sources)
