"""Hills before the sky, in pictures of low observers."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from airlight import Camera, Scene, load_planet, render
from airlight.solver.moments.solution import MomentsSolution


@pytest.mark.parametrize(
    ("latitude", "longitude", "altitude", "broken"),
    [(48.0, 11.0, 2.0, True), (0.0, -150.0, 2.0, False), (48.0, 11.0, 1500.0, False)],
)
def test_hills_break_the_horizon_of_land_before_a_low_observer(
    solved: Callable[..., MomentsSolution],
    latitude: float,
    longitude: float,
    altitude: float,
    broken: bool,
) -> None:
    # Of the map alone the horizon is level; beyond the largest angle of hills, 2.9°, the sky of
    # both pictures is the same to the last bit.
    solution = solved(load_planet("earth"), (680.0, 550.0, 440.0), "preview")
    camera = Camera(width=160, height=90, look_zenith=90.0, field_of_view=20.0)
    plain, detailed = (
        render(
            solution,
            Scene(
                camera=camera,
                altitude=altitude,
                sun_zenith=50.0,
                latitude=latitude,
                longitude=longitude,
                ground=ground,
            ),
        ).rgb
        for ground in ("plain", "detailed")
    )
    per_degree = 160.0 / 20.0
    dip = np.degrees(np.sqrt(2.0 * altitude / 6371e3))
    horizon = int(45.0 + per_degree * dip) - 2
    assert_array_equal(
        detailed[: int(45.0 - 3.2 * per_degree)], plain[: int(45.0 - 3.2 * per_degree)]
    )
    changed = np.abs(detailed[:horizon] - plain[:horizon]) > 0.05 * plain[:horizon]
    assert changed.any() == broken
