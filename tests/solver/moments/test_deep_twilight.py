"""Light of the deep twilight, which fades by orders of magnitude between the nodes of the suns."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.solver import solve
from airlight.solver.moments.grid import fading_places, make_grid
from airlight.solver.moments.levels import Depths
from airlight.solver.moments.settings import QUALITIES

#: Every quarter of a degree from the end of civil twilight on.
SUNS = np.arange(96.0, 110.01, 0.25)


def test_places_between_nodes_make_fading_light_exact() -> None:
    # By definition: lerp(M s)/lerp(s), with s = 1/sqrt(M), of an exponential M is that exponential.
    nodes = np.array([-20.0, -17.0, -15.5, -15.0, -11.0])
    elevation = np.linspace(-20.0, -11.0, 181)
    rate = 1.1
    place = fading_places(elevation, nodes, rate)
    node = np.minimum(place.astype(int), nodes.size - 2)
    share = place - node
    low, high = np.exp(rate * nodes[node]), np.exp(rate * nodes[node + 1])
    light = ((1.0 - share) * low**0.5 + share * high**0.5) / (
        (1.0 - share) * low**-0.5 + share * high**-0.5
    )
    assert_allclose(light, np.exp(rate * elevation), rtol=1e-12)


def test_places_between_nodes_that_light_does_not_fade_between_are_even() -> None:
    # The limit of the formula: sinh xh is xh.
    nodes = np.array([-3.0, -1.0, 0.0])
    assert_allclose(fading_places(np.array([-2.0, -0.75]), nodes, 1e-9), [0.5, 1.25], rtol=1e-12)


@pytest.mark.parametrize("top", [6371.1e3, 6471e3, 70000e3])
def test_place_of_a_node_is_its_index(top: float) -> None:
    # By definition. The table is linear between its 8192 steps in the cosine, so that a place is
    # off by what a step spans where nodes are closer than that.
    altitude = (top - 6371e3) * np.linspace(0.0, 1.0, 4097) ** 2
    grid, _ = make_grid(6371e3, top, 12, 56, Depths(altitude, np.zeros(4097)), np.arange(4097.0))
    assert (np.diff(grid.place) > 0.0).all()
    even = np.linspace(-1.0, 1.0, grid.place.size)
    index = np.interp(grid.sun_cosines, even, grid.place)
    spans = np.interp(grid.sun_cosines, 0.5 * (even[1:] + even[:-1]), np.diff(grid.place))
    assert_allclose(np.abs(index - np.arange(56.0)) / np.maximum(spans, 0.01), 0.0, atol=1.0)


@pytest.mark.parametrize(
    ("planet", "quality", "error", "bend"),
    [
        ("earth", "preview", 0.15, 0.25),
        ("earth", "default", 0.05, 0.10),
        ("mars", "preview", 0.10, 0.15),
    ],
)
def test_twilight_fades_smoothly_to_110_degrees(
    planet: str, quality: str, error: float, bend: float
) -> None:
    # Second method: a grid of suns three times as dense, all else the same, which errs by a ninth.
    # The zenith and the horizons towards the sun and away from it; values, and slopes from one sun
    # to the next.
    settings = QUALITIES[quality]
    got, truth = (
        np.log10(
            solve(planet, [550.0], one, cache=False)
            .radiance(
                altitude=0.0,
                sun_zenith=SUNS[:, None],
                view_zenith=np.array([0.0, 85.0, 85.0]),
                azimuth=np.array([0.0, 0.0, 180.0]),
            )
            .values[..., 0]
        )
        for one in (settings, replace(settings, sun_angles=3 * settings.sun_angles))
    )
    assert_allclose(got, truth, rtol=0.0, atol=np.log10(1.0 + error))
    assert_allclose(np.diff(got, axis=0), np.diff(truth, axis=0), rtol=bend)
