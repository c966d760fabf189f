"""Colour differences, against the published pairs and colour-science."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.image.color_difference import WHITE, color_difference, delta_e_2000, xyz_to_lab

# Sharma, Wu & Dalal (2005), Table 1: L, a, b of both colours and the difference. The pairs were
# chosen for the branches of the hue: across 0°, grey colours, opposite hues.
PAIRS = [
    (50.0, 2.6772, -79.7751, 50.0, 0.0, -82.7485, 2.0425),
    (50.0, -1.1848, -84.8006, 50.0, 0.0, -82.7485, 1.0000),
    (50.0, 0.0, 0.0, 50.0, -1.0, 2.0, 2.3669),
    (50.0, 2.49, -0.001, 50.0, -2.49, 0.0009, 7.1792),
    (50.0, 2.49, -0.001, 50.0, -2.49, 0.0011, 7.2195),
    (50.0, -0.001, 2.49, 50.0, 0.0009, -2.49, 4.8045),
    (50.0, 2.5, 0.0, 73.0, 25.0, -18.0, 27.1492),
    (50.0, 2.5, 0.0, 61.0, -5.0, 29.0, 22.8977),
    (60.2574, -34.0099, 36.2677, 60.4626, -34.1751, 39.4387, 1.2644),
    (22.7233, 20.0904, -46.6940, 23.0331, 14.9730, -42.5619, 2.0373),
    (2.0776, 0.0795, -1.1350, 0.9033, -0.0636, -0.5514, 0.9082),
]


@pytest.mark.parametrize("pair", PAIRS)
def test_ciede2000_of_the_published_pairs(pair):
    # half the last printed digit; the formula is symmetric in its colours
    assert_allclose(delta_e_2000(pair[:3], pair[3:6]), pair[6], rtol=0, atol=5.1e-5)
    assert_allclose(delta_e_2000(pair[3:6], pair[:3]), pair[6], rtol=0, atol=5.1e-5)


def test_lab_is_that_of_colour_science():
    with np.printoptions():  # colour-science changes how NumPy prints, for everyone
        colour = pytest.importorskip("colour")
    xyz = np.array([[0.2, 0.3, 0.9], [1e-4, 2e-4, 5e-3], [1.2, 1.0, 0.4]])
    white = colour.XYZ_to_xy(WHITE)
    assert_allclose(xyz_to_lab(xyz), colour.XYZ_to_Lab(xyz, white), atol=1e-9)
    assert_allclose(xyz_to_lab(WHITE), [100.0, 0.0, 0.0], atol=1e-12)


def test_difference_does_not_depend_on_the_unit_of_light():
    rgb, reference = np.array([[3.0, 2.0, 1.0]]), np.array([[2.0, 2.0, 2.0]])
    assert_allclose(color_difference(7.0 * rgb, 7.0 * reference), color_difference(rgb, reference))
    assert color_difference(reference, reference) == 0.0


def test_black_reference_is_refused():
    with pytest.raises(ParameterError, match="above 0"):
        color_difference([1.0, 1.0, 1.0], [0.0, 0.0, 0.0])
