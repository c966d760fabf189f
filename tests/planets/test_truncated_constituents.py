"""Air that ends at the top of the shell: named with what a formula says is missing."""

from __future__ import annotations

import math
import re

import pytest

from airlight.planets import load_planet
from airlight.planets.truncated_constituents import truncated_constituents


@pytest.mark.parametrize("kilometres", [20, 40, 60])
def test_the_share_is_that_of_an_exponential(kilometres: int) -> None:
    # the column above z is exp(-z/H) of all; H = 8 km of Bruneton's molecules
    planet = load_planet("earth-bruneton", {"shell.top_radius": f"{6360 + kilometres} km"})
    found = re.search(
        r", ([\d.]+) of its scale heights up: ([\d.e-]+) % of", truncated_constituents(planet)[0]
    )
    assert found is not None
    assert float(found[1]) == pytest.approx(kilometres / 8.0, abs=0.06)
    # two digits are printed
    assert float(found[2]) == pytest.approx(100.0 * math.exp(-kilometres / 8.0), rel=0.06)


def test_layers_that_end_by_themselves_are_not_named() -> None:
    planet = load_planet("earth-bruneton", {"shell.top_radius": "6424 km"})
    assert truncated_constituents(planet) == []
