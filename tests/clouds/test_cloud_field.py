"""Cloud fields: values at points, and rejected boxes."""

import numpy as np
import pytest

from airlight.clouds.cloud_field import CloudField
from airlight.errors import ParameterError


def _field(**changes):
    cells = np.arange(24, dtype=np.float32).reshape(2, 3, 4) * 1e-3
    return CloudField(
        **{"extinction": cells, "spacing": (100.0, 50.0, 25.0), "base": 1000.0} | changes
    )


def test_values_at_centres_are_those_of_the_cells():
    for interpolated in (True, False):
        field = _field(interpolated=interpolated)
        x, y, z = np.meshgrid(
            [-50.0, 50.0], [-50.0, 0.0, 50.0], 1012.5 + 25.0 * np.arange(4), indexing="ij"
        )
        np.testing.assert_allclose(field.at(x, y, z), field.extinction, rtol=1e-6)


def test_a_clear_box_ends_and_a_periodic_one_repeats():
    clear, periodic = _field(), _field(beyond="periodic")
    places = np.array([0.0, 60.0]), np.array([10.0, -20.0]), np.array([1030.0, 1080.0])
    shifted = places[0] + 200.0, places[1] - 150.0, places[2]
    assert np.all(clear.at(*shifted) == 0.0)
    np.testing.assert_allclose(periodic.at(*shifted), periodic.at(*places), rtol=1e-12)
    assert np.all(periodic.at(0.0, 0.0, np.array([999.0, 1100.5])) == 0.0)


def test_columns_add_up():
    np.testing.assert_allclose(
        _field().column_optical_depth[1, 2], 25.0e-3 * (20 + 21 + 22 + 23), rtol=1e-6
    )
    assert _field().top == 1100.0


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"extinction": np.full((1, 1, 1), -1e-3)}, "extinction"),
        ({"extinction": np.full((1, 1, 1), np.nan)}, "extinction"),
        ({"extinction": np.zeros((2, 2))}, "shape"),
        ({"spacing": (1.0, 0.0, 1.0)}, "spacing"),
        ({"base": np.nan}, "base"),
        ({"beyond": "mirror"}, "clear, periodic"),
    ],
)
def test_a_bad_box_gets_one_line(changes, message):
    with pytest.raises(ParameterError, match=message):
        _field(**changes)
