"""Ground in a basin: the air goes on below the level that altitudes count from."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import Medium, ParameterError, Planet, load_planet, lowered_ground, solve
from airlight.geometry.ephemeris.world import WORLDS
from airlight.physics.optics.density_profile import DensitySegments
from airlight.planets.lowered_ground import Continued, stands_on_floor
from airlight.planets.matter.profiles import Exponential, Layers, Tent, Uniform
from airlight.planets.parameters import replace

NM = (680.0, 550.0, 440.0)


def density(profile: Continued, altitudes: list[float], thickness: float) -> np.ndarray:
    heights = np.array(altitudes) + profile.depth
    return DensitySegments.from_rows([profile.row(thickness + profile.depth)]).at(heights)[0]


def test_an_exponential_is_continued_exactly() -> None:
    # The law exp(-h/H), also below 0.
    profile = Continued(profile=Exponential(scale_height=2e3), depth=430.0)
    altitudes = [-430.0, -200.0, 0.0, 5e3]
    assert_allclose(
        density(profile, altitudes, 1e5), np.exp(-np.array(altitudes) / 2e3), rtol=1e-12
    )


def test_the_standard_atmosphere_is_continued_to_the_dead_sea() -> None:
    # The law of a layer of constant lapse rate, (T/T0)^(g M/(R L) - 1), of geopotential altitude,
    # which differs from the true one by 0.03 m there; the ICAO's tables go on below 0 by it. Its
    # temperature rises downwards, the continued scale height does not: 4e-4.
    layers = load_planet("earth").constituents[0].profile
    assert isinstance(layers, Layers)
    lapse, temperature = 6.5e-3, 288.15
    power = 9.80665 * 28.9644e-3 / (8.31432 * lapse) - 1.0
    wanted = (1.0 + 430.0 * lapse / temperature) ** power
    found = density(Continued(profile=layers, depth=430.0), [-430.0], 1e5)[0]
    assert_allclose(found, wanted, rtol=5e-4)


def test_what_is_nothing_at_the_level_stays_nothing_and_uniform_air_uniform() -> None:
    # Exact limits of a density that goes on with its scale height.
    tent = Continued(profile=Tent(center=25e3, half_width=15e3), depth=400.0)
    assert_allclose(density(tent, [-400.0, 0.0, 25e3], 1e5), [0.0, 0.0, 1.0], atol=1e-15)
    uniform = Continued(profile=Uniform(), depth=400.0)
    assert_allclose(density(uniform, [-400.0, 0.0], 1e5), 1.0)


@pytest.mark.parametrize(("name", "altitude"), [("earth", -430.0), ("mars", -8200.0)])
def test_the_air_above_the_level_is_the_planet_s_own(name: str, altitude: float) -> None:
    # Coefficients refer to the level, so that nothing above it changes; below it lies a column of
    # H (exp(depth/H) - 1) of an exponential of that scale height.
    planet = load_planet(name)
    low = lowered_ground(planet, altitude)
    assert low.top_radius == planet.top_radius
    one, other = (Medium.from_planet(p, NM) for p in (planet, low))
    assert_allclose(other.extinction, one.extinction, rtol=1e-12)
    heights = np.array([0.0, 1e3, 10e3, 30e3])
    assert_allclose(other.density.at(heights - altitude), one.density.at(heights), rtol=1e-9)
    assert (other.columns >= one.columns * (1.0 - 1e-12)).all()
    deeper = other.density.at(0.0)[0]
    share = (other.columns[0] - one.columns[0]) / -altitude
    assert 1.0 < share < deeper


def test_hellas_has_the_pressure_that_its_floor_has() -> None:
    # The lower end of what is measured and modelled there: 1030 to 1240 Pa over a Martian year
    # (Haberle et al. 2001, JGR 106, 23317), against 6.1 to 6.9 hPa at the level: a factor of 2.0,
    # with 15 % for the preset's isothermal floor.
    low = lowered_ground(load_planet("mars"), -8200.0)
    assert_allclose(Medium.from_planet(low, NM).density.at(0.0)[0], 2.0, rtol=0.15)


def test_light_at_the_dead_sea_is_dimmed_by_the_column_above_it() -> None:
    # Beer's law by the columns of the standard atmosphere: 4 to 6 % more air than at the sea.
    planet = load_planet("earth")
    at_sea, low = (solve(one, NM, "preview") for one in (planet, lowered_ground(planet, -430.0)))
    depth = [-np.log(np.asarray(one.transmittance(altitude=0.0, view_zenith=0.0)))
             for one in (at_sea, low)]  # fmt: skip
    assert (depth[1] > 1.03 * depth[0]).all()
    assert (depth[1] < 1.2 * depth[0]).all()


def test_every_world_s_basin_is_allowed_and_nothing_below() -> None:
    # The limit itself is included.
    for name, world in WORLDS.items():
        planet = load_planet(name)
        floor = lowered_ground(planet, world.deepest_basin)
        assert_allclose(floor.thickness, planet.thickness - world.deepest_basin)
        with pytest.raises(ParameterError, match="the deepest basin of"):
            lowered_ground(planet, world.deepest_basin - 1.0)


def test_a_planet_without_basins_and_air_that_is_too_steep_are_refused() -> None:
    with pytest.raises(ParameterError, match="0 m or more"):
        lowered_ground(load_planet("exoplanet"), -1.0)
    steep: Planet = load_planet("earth")
    fog = replace(steep.constituents[1], profile=Exponential(scale_height=20.0))
    steep = replace(steep, constituents=(steep.constituents[0], fog))
    with pytest.raises(ParameterError, match="scale height at the reference level"):
        Medium.from_planet(lowered_ground(steep, -430.0), NM)


def test_an_observer_stands_on_the_floor() -> None:
    # Eyes 2 m above it; at the bottom of the deepest basin it is not lower than that.
    planet = load_planet("earth")
    for altitude, height in ((-1.0, 2.0), (-430.0, 2.0), (-440.0, 0.0), (5.0, 5.0)):
        floor, above = stands_on_floor(planet, altitude)
        assert_allclose(above, height)
        assert_allclose(floor.bottom_radius + above, planet.bottom_radius + altitude, rtol=1e-15)
