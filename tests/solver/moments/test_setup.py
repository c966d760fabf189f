"""Set-up of a solve, which CPU and GPU read."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal

from airlight import load_planet
from airlight.planets.medium import Medium
from airlight.solver.moments.settings import settings_for
from airlight.solver.moments.setup import Setup
from airlight.solver.refracted_geometry import RefractedGeometry

NM = [450.0, 530.0, 600.0, 680.0]


def setup_of(name: str, quality: str = "preview", **changes: float) -> Setup:
    changed = {path.replace("__", "."): value for path, value in changes.items()}
    medium = Medium.from_planet(load_planet(name, changed), NM)
    return Setup(geometry=RefractedGeometry.of(medium), settings=settings_for(quality))


def test_lanes_without_a_wavelength_repeat_others():
    # A register has eight lanes; lanes without a wavelength must compute nothing exceptional, and
    # either half has all of few wavelengths.
    batch = setup_of("earth").batch(slice(1, 3))
    assert batch.used == 2
    for values in (batch.level.T, batch.thick, batch.lateral_threshold, batch.air.ground.albedo):
        assert values.shape[0] == 8
        assert_array_equal(values, values[[0, 1, 1, 1] * 2])


def test_blocks_together_say_what_one_block_says():
    # Wavelengths are independent, except for the culling of rays and the numerical diffusion.
    setup = setup_of("mars-standard")
    whole, parts = setup.batch(slice(None)), [setup.batch(slice(0, 2)), setup.batch(slice(2, 4))]
    assert_array_equal(np.concatenate([one.thick[:2] for one in parts]), whole.thick[:4])
    assert_array_equal(np.concatenate([one.level[:, :2] for one in parts], 1), whole.level[:, :4])
    assert max(one.grid_diffusion for one in parts) == whole.grid_diffusion


def test_azimuths_hold_every_multiple_of_the_degree():
    # Midpoints of b even steps integrate cos mφ to 0 for 0 < m < 2b, and 1 to a turn.
    setup = setup_of("mars-standard")
    totals = setup.azimuths.multiples.sum(axis=1)
    assert setup.azimuths.multiples.shape[0] == setup.degree + 1
    assert_allclose(totals[0], 2.0 * np.pi, rtol=1e-6)
    assert_allclose(totals[1:], 0.0, atol=1e-5)


def test_an_edit_of_coefficients_keeps_the_table_of_columns():
    # Columns depend on the profiles alone: the same object, which an edit does not recompute.
    before, after = setup_of("earth"), setup_of("earth", ground__albedo=0.5)
    assert after.table is before.table
    assert after.ratios is before.ratios
    assert setup_of("mars-standard").table is not before.table


def test_light_is_gathered_at_the_ground_and_at_the_top():
    # Thick air has more levels than radii that gather light; both have the same ends.
    setup = setup_of("early-earth")
    assert setup.refinement > 1
    assert setup.gathering.radii.size == (setup.grid.radii.size - 1) // setup.refinement + 1
    assert_array_equal(setup.gathering.radii[[0, -1]], setup.grid.radii[[0, -1]])


def test_infinitely_thick_air_is_by_day_what_its_levels_say():
    # Its weight is 1 with the star in the zenith and 0 with it in the nadir, never falling.
    day_weight = setup_of("earth").day_weight
    assert day_weight[0] == 0.0
    assert day_weight[-1] == 1.0
    assert (np.diff(day_weight) >= 0.0).all()
