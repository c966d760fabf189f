"""Panels of a line that are out of sight have no points."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import load_planet, solve

LINES: dict[str, Any] = {
    "altitude": np.array([2.0, 5e4, 4e5])[:, None, None],
    "sun_zenith": np.array([0.0, 60.0, 88.0, 94.0])[:, None],
    "view_zenith": np.array([0.0, 45.0, 80.0, 89.5, 92.0, 100.0, 120.0, 180.0]),
    "azimuth": 30.0,
}


@pytest.mark.parametrize("name", ["earth", "titan", "venus"])
def test_what_is_out_of_sight_is_missed_by_nobody(name: str) -> None:
    # A second method, points in all panels. Of what is hidden a ten-millionth comes through, and it
    # is at most a hundred times as bright as what hides it.
    planet = load_planet(name)
    solution = solve(planet, planet.wavelengths[:3], "preview", cache=False)
    got = np.asarray(solution.radiance(**LINES))
    vars(solution)["tables"] = solution.tables._replace(culls_opaque=0)
    wanted = np.asarray(solution.radiance(**LINES))
    lit = wanted > 1e-6 * wanted.max()
    assert_allclose(got[lit], wanted[lit], rtol=1e-5)
    assert (got != wanted).any() == (name != "earth")
