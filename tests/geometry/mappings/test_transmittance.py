"""Bruneton's mapping of (r, mu): there and back, at both ends, for any planet."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.geometry.mappings.transmittance import (
    altitude_coordinate,
    cosine_from_coordinate,
    direction_coordinate,
    radius_from_coordinate,
)
from airlight.geometry.shell import distance_to_top, horizon_cosine
from airlight.kernel import vectorized

#: Earth, Mars, Titan, and a shell as thick as its planet. [m]
SHELLS = [(6360e3, 6460e3), (3389.5e3, 3509.5e3), (2575e3, 3175e3), (1e6, 2e6)]


@pytest.mark.parametrize(("bottom", "top"), SHELLS)
def test_altitude_goes_there_and_back(bottom: float, top: float) -> None:
    x = np.linspace(0.0, 1.0, 1001)
    r = vectorized(radius_from_coordinate)(x, bottom, top)
    assert (np.diff(r) > 0.0).all()
    # Next to the ground x² of the shell is a few digits of r: 1e-16 R is 1e-7 in x at x = 1e-3.
    assert_allclose(vectorized(altitude_coordinate)(r, bottom, top), x, rtol=0, atol=1e-8)
    assert_allclose(r[[0, -1]], [bottom, top], rtol=1e-15)


@pytest.mark.parametrize(("bottom", "top"), SHELLS)
def test_direction_goes_there_and_back(bottom: float, top: float) -> None:
    x = np.linspace(0.0, 1.0, 201)[:, None]
    r = vectorized(radius_from_coordinate)(np.linspace(0.0, 0.999, 200), bottom, top)
    mu = vectorized(cosine_from_coordinate)(x, r, bottom, top)
    # mu moves little where x moves much (straight up): 1e-16 in mu is 1e-8 in x.
    assert_allclose(
        vectorized(direction_coordinate)(r, mu, bottom, top), np.broadcast_to(x, mu.shape),
        rtol=0, atol=2e-7,
    )  # fmt: skip
    back = vectorized(cosine_from_coordinate)(
        vectorized(direction_coordinate)(r, mu, bottom, top), r, bottom, top
    )
    assert_allclose(back, mu, rtol=0, atol=1e-12)
    assert (np.diff(mu, axis=0) < 0.0).all()


@pytest.mark.parametrize(("bottom", "top"), SHELLS)
def test_ends_are_the_zenith_and_the_horizon(bottom: float, top: float) -> None:
    # By definition: 0 straight up, 1 along the horizon, at every radius, ground and top included.
    r = np.linspace(bottom, top, 12)
    horizon = vectorized(horizon_cosine)(r, bottom)
    up = vectorized(direction_coordinate)(r[:-1], 1.0, bottom, top)
    assert_allclose(up, 0.0, atol=1e-12)
    assert_allclose(vectorized(direction_coordinate)(r, horizon, bottom, top), 1.0, atol=1e-9)
    assert_allclose(vectorized(cosine_from_coordinate)(0.0, r, bottom, top), 1.0, atol=1e-12)
    assert_allclose(
        vectorized(cosine_from_coordinate)(1.0, r, bottom, top), horizon, rtol=0, atol=1e-9
    )


@pytest.mark.parametrize(("bottom", "top"), SHELLS)
def test_coordinate_is_the_distance_to_the_top(bottom: float, top: float) -> None:
    # The definition of Bruneton (2017): linear in the distance, from r_top - r to ρ + H.
    r = bottom + 0.3 * (top - bottom)
    mu = np.linspace(horizon_cosine(r, bottom) + 1e-9, 1.0, 50)
    distance = vectorized(distance_to_top)(r, mu, top)
    longest = np.sqrt(r**2 - bottom**2) + np.sqrt(top**2 - bottom**2)
    expected = (distance - (top - r)) / (longest - (top - r))
    assert_allclose(
        vectorized(direction_coordinate)(r, mu, bottom, top), expected, rtol=0, atol=1e-9
    )


def test_at_the_very_top_every_direction_upwards_has_left_the_air() -> None:
    # No distance is left, and nothing is divided by it.
    bottom, top = SHELLS[0]
    mu = np.linspace(0.0, 1.0, 11)
    assert_allclose(vectorized(direction_coordinate)(top, mu, bottom, top), 0.0, atol=1e-12)
    assert cosine_from_coordinate(0.0, top, bottom, top) == 1.0
