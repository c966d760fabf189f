"""Four wavelengths take half the work of eight, and come out the same, as do more than eight."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight import load_planet, solve
from airlight.planets.medium import Medium
from airlight.solver.moments.first_order import first_order_radius, first_order_radius_narrow
from airlight.solver.moments.iterate import gather
from airlight.solver.moments.packing import filled, pack_light
from airlight.solver.moments.settings import settings_for
from airlight.solver.moments.setup import Setup
from airlight.solver.moments.sweep import sweep_radius, sweep_radius_narrow
from airlight.solver.refracted_geometry import RefractedGeometry


@pytest.mark.parametrize("name", ["earth", "mars-standard"])
def test_pairs_give_the_orders_that_eight_wavelengths_give(name: str) -> None:
    # A second method: other registers, the same sums. Single precision of sums of a hundred terms,
    # relative to the mean radiance; bent light and straight, degrees 4 and 6, an odd number of
    # azimuths and an even one.
    planet = load_planet(name)
    medium = Medium.from_planet(planet, planet.wavelengths[:3])
    batch = Setup(geometry=RefractedGeometry.of(medium), settings=settings_for("preview")).batch(
        slice(None)
    )
    assert batch.narrow
    setup = batch.setup
    once = (setup.column_rows, setup.star_ratios, setup.geometry.refraction_table)
    first, sky = gather(batch, first_order_radius_narrow, *once)
    wanted, wanted_sky = gather(batch, first_order_radius, *once)
    mean = wanted[:, :, :1].clip(1e-12)
    assert_allclose(first / mean, wanted / mean, rtol=0, atol=1e-5)
    assert_allclose(sky, wanted_sky, rtol=1e-5, atol=1e-12)
    packed = pack_light(wanted, wanted_sky[:1], batch.level, setup.refinement)
    pairs = pack_light(wanted, wanted_sky[:1], batch.level, setup.refinement, narrow=True)
    wanted, wanted_sky = gather(batch, sweep_radius, *packed, batch.all_degrees)
    second, sky = gather(batch, sweep_radius_narrow, *pairs, batch.all_degrees)
    mean = wanted[:, :, :1].clip(1e-12)
    assert_allclose(second / mean, wanted / mean, rtol=0, atol=1e-5)
    assert_allclose(sky, wanted_sky, rtol=1e-5, atol=1e-12)


@pytest.mark.parametrize("name", ["earth", "mars-standard"])
def test_more_than_eight_wavelengths_have_the_light_of_each(name: str) -> None:
    # From the ground and from space, of the ground too: moments and irradiances of three blocks.
    planet = load_planet(name)
    many = np.linspace(420.0, 680.0, 17)
    lines = {
        "altitude": [2.0, 2.0, 4e5, 4e5], "sun_zenith": [60.0, 92.0, 30.0, 85.0],
        "view_zenith": [45.0, 80.0, 180.0, 110.0], "azimuth": [90.0, 20.0, 0.0, 40.0],
    }  # fmt: skip
    whole = solve(planet, many, "preview", cache=False)
    few = solve(planet, many[[0, 9, 16]], "preview", cache=False)
    got, wanted = (np.asarray(one.radiance(**lines)) for one in (whole, few))
    assert_allclose(got[:, [0, 9, 16]], wanted, rtol=2e-4)


def test_lanes_without_a_wavelength_repeat_others() -> None:
    assert_array_equal(filled(np.arange(3)), [0, 1, 2, 2, 0, 1, 2, 2])
    assert_array_equal(filled(np.arange(6)), [0, 1, 2, 3, 4, 5, 5, 5])
    assert_array_equal(filled(np.arange(9)), [0, 1, 2, 3, 4, 5, 6, 7, *[8] * 8])
