"""Sub-grid detail of clouds: mean, spectrum, band limit."""

import numpy as np

from airlight.clouds.cloud_detail import CONTRAST, FALL, OCTAVES, cloud_detail
from airlight.kernel import kernel, vectorized

PLACES = np.random.default_rng(5).uniform(0.0, 25.6e3, (3, 200_000))


@kernel
def _first(east, north, altitude, width, cell):
    """Factor of the extinction. [1]"""
    return cloud_detail(east, north, altitude, width, cell)[0]


def _factor(width, cell=100.0):
    return vectorized(_first)(*PLACES, width, cell)


def test_detail_has_mean_one_and_the_variance_of_the_octaves_shown():
    for width, octaves in ((0.5, OCTAVES), (25.0, 1)):
        factor = _factor(width)
        np.testing.assert_allclose(factor.mean(), 1.0, atol=0.01)
        expected = CONTRAST**2 * sum(FALL ** (2 * k) for k in range(octaves))
        # lattices of noise are sampled unevenly by chance
        np.testing.assert_allclose(np.log(factor).var(), expected, rtol=0.05)


def test_footprints_wider_than_half_a_cell_see_no_detail():
    assert cloud_detail(123.0, 45.0, 900.0, 50.0, 100.0) == (1.0, 0.0, 0.0, 0.0)
    assert _factor(49.0).std() < 0.02


def test_displacements_stay_below_a_cell():
    moves = np.array([cloud_detail(*place, 0.5, 100.0)[1:] for place in PLACES[:, :2000].T])
    assert np.abs(moves).max() < 150.0
    assert np.all(np.abs(moves.mean(axis=0)) < 5.0)
    assert np.all(moves.std(axis=0) > 5.0)


def test_steps_through_the_detail_are_continuous():
    there = np.array([cloud_detail(x, 40.0, 900.0, 1.0, 100.0)[0] for x in np.arange(0, 300, 0.05)])
    assert np.abs(np.diff(there)).max() < 0.05


def test_an_octave_appears_without_a_leap():
    """As an observer comes nearer, all parts of the detail are continuous."""
    width = np.geomspace(0.5, 60.0, 4000)
    seen = np.array([cloud_detail(1234.0, 567.0, 890.0, one, 100.0) for one in width])
    leaps = np.abs(np.diff(seen, axis=0)).max(axis=0)
    assert np.all(leaps < [0.02, 0.4, 0.4, 0.2]), leaps
