"""Lines of sight that meet a body without air."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal

from airlight.kernel import vectorized
from airlight.render.pixels.bare_body import sphere_distance


def test_a_line_meets_a_sphere_where_a_point_of_it_has_unit_distance() -> None:
    # Near the ground and far away: the end of the line is on the sphere, on the observer's side.
    for distance in (1.0 + 1e-6, 1.5, 3.0, 60.0):
        angle = np.linspace(0.0, 1.0, 50) * np.arcsin(1.0 / distance) * 0.999
        along, across = distance * np.cos(angle), distance * np.sin(angle)
        power = (distance - 1.0) * (distance + 1.0)
        length = np.asarray(vectorized(sphere_distance)(along, across, power))
        assert_allclose((along - length) ** 2 + across**2, 1.0, rtol=1e-9)
        assert (length <= along).all()
        missed = vectorized(sphere_distance)(distance * np.array([-1.0]), 0.0, power)
        assert_array_equal(missed, -1.0)
    assert sphere_distance(3.0, 1.001, 9.002) == -1.0
