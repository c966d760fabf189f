"""Weighted power mapping: golden weights, both ends of every region, both sides of the horizon."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from airlight.geometry.mappings import power
from airlight.geometry.mappings.weighted_power import (
    LOWER,
    SURFACE,
    UPPER,
    lower_weight,
    region_coordinate,
    surface_weight,
    view_coordinate,
    view_from_coordinate,
    view_region,
)
from airlight.geometry.shell import horizon_cosine
from airlight.kernel import vectorized

#: Earth, Mars, Titan, and a shell as thick as its planet. [m]
SHELLS = [(6360e3, 6460e3), (3389.5e3, 3509.5e3), (2575e3, 3175e3), (1e6, 2e6)]
#: The notes' weights, none on the ground at h = 0, and an empty S. w_L1, w_S1, w_S0
WEIGHTS = [(20 / 32, 4 / 32, 4 / 32), (20 / 32, 4 / 32, 0.0), (0.5, 0.0, 0.0), (0.0, 0.1, 0.2)]


def _state(
    relative: float, shell: tuple[float, float], weights: tuple[float, float, float]
) -> tuple[float, float, float]:
    """Horizon, w_L and w_S at a relative altitude, altitude by power 2."""
    bottom, top = shell
    h = relative * (top - bottom)
    u = power.altitude_coordinate(h, top - bottom, 2.0)
    horizon = horizon_cosine(bottom + h, bottom)
    return horizon, lower_weight(u, weights[0]), surface_weight(u, weights[1], weights[2])


def test_weights_and_horizon_are_the_golden_numbers() -> None:
    # Worked by hand from the notes' formulas with AP2's radii; printed to these digits.
    h = np.array([0.0, 1e3, 1e4, 3e4, 1e5])
    u = vectorized(power.altitude_coordinate)(h, 1e5, 2.0)
    assert_allclose(
        vectorized(lower_weight)(u, 20 / 32), [0, 0.0625, 0.198, 0.342, 0.625], atol=5e-4
    )
    assert_allclose(
        vectorized(surface_weight)(u, 4 / 32, 4 / 32), [0.125, 0.1375, 0.165, 0.193, 0.25],
        atol=5e-4,
    )  # fmt: skip
    assert_allclose(
        vectorized(horizon_cosine)(6360e3 + h, 6360e3),
        [0.0, -0.017731, -0.056011, -0.096787, -0.175272],
        rtol=0, atol=5e-7,
    )  # fmt: skip


@pytest.mark.parametrize("weights", WEIGHTS)
@pytest.mark.parametrize("shell", SHELLS)
@pytest.mark.parametrize("relative", [0.0, 1e-6, 0.01, 0.3, 1.0])
def test_both_ends_of_every_region_return(
    shell: tuple[float, float], relative: float, weights: tuple[float, float, float]
) -> None:
    # Straight down, the horizon from the ground's side and from the sky's, the horizontal,
    # straight up: each comes back, on its own side.
    horizon, w_l, w_s = _state(relative, shell, weights)
    powers = (2.0, 2.0, 2.0)
    if w_s > 0.0:
        assert view_coordinate(-1.0, True, horizon, *powers, w_l, w_s) == 0.0
        assert view_from_coordinate(0.0, horizon, *powers, w_l, w_s) == (-1.0, True)
        below = np.nextafter(w_s, 0.0)
        mu, ground = view_from_coordinate(below, horizon, *powers, w_l, w_s)
        assert ground
        assert_allclose(mu, horizon, rtol=0, atol=1e-15)
        assert_allclose(view_coordinate(mu, True, horizon, *powers, w_l, w_s), w_s, atol=1e-8)
    assert view_coordinate(horizon, False, horizon, *powers, w_l, w_s) == w_s
    mu, ground = view_from_coordinate(w_s, horizon, *powers, w_l, w_s)
    assert not ground
    assert mu == (horizon if w_l > 0.0 else 0.0)
    assert view_coordinate(0.0, False, horizon, *powers, w_l, w_s) == w_l + w_s
    assert view_from_coordinate(w_l + w_s, horizon, *powers, w_l, w_s) == (0.0, False)
    if w_l > 0.0:
        mu, ground = view_from_coordinate(np.nextafter(w_l + w_s, 0.0), horizon, *powers, w_l, w_s)
        assert not ground
        # A step of one rounding in v is divided by the weight (1e-3 of the axis at 1e-6 up).
        assert_allclose(mu, 0.0, rtol=0, atol=1e-12)
    assert view_coordinate(1.0, False, horizon, *powers, w_l, w_s) == 1.0
    assert view_from_coordinate(1.0, horizon, *powers, w_l, w_s) == (1.0, False)


@given(
    relative=st.floats(0.0, 1.0),
    v=st.floats(0.0, 1.0),
    shell=st.sampled_from(SHELLS),
    weights=st.sampled_from(WEIGHTS),
    p=st.tuples(*[st.floats(1.0, 3.0)] * 3),
)
def test_every_coordinate_returns(
    relative: float,
    v: float,
    shell: tuple[float, float],
    weights: tuple[float, float, float],
    p: tuple[float, float, float],
) -> None:
    # mu → v → mu: in this direction powers > 1 never magnify a rounding by more than p / weight;
    # mu itself stands for differences from the horizon down to 1e-16.
    horizon, w_l, w_s = _state(relative, shell, weights)
    mu, ground = view_from_coordinate(v, horizon, *p, w_l, w_s)
    assert -1.0 <= mu <= 1.0
    assert ground == (v < w_s)
    again, side = view_from_coordinate(
        view_coordinate(mu, ground, horizon, *p, w_l, w_s), horizon, *p, w_l, w_s
    )
    assert_allclose(again, mu, rtol=0, atol=2e-12)
    if abs(v - w_s) > 1e-6:  # the horizon itself is the sky's
        assert side == ground


@pytest.mark.parametrize("relative", [0.0, 0.1, 1.0])
def test_axis_is_continuous_and_rises_from_straight_down_to_straight_up(relative: float) -> None:
    # The one-minus term of v_S joins the regions at w_S; U and L join at w_L + w_S.
    horizon, w_l, w_s = _state(relative, SHELLS[0], WEIGHTS[0])
    v = np.linspace(0.0, 1.0, 4001)
    mu = np.array([view_from_coordinate(x, horizon, 2.0, 2.0, 2.0, w_l, w_s)[0] for x in v])
    assert (np.diff(mu) >= 0.0).all()
    # The steepest slope is S's at the bottom end, 2 (1 + cosφ_H) / w_S, or U's, 2 / w_U.
    steepest = max(2.0 * (1.0 + horizon) / w_s, 2.0 / (1.0 - w_l - w_s))
    assert np.diff(mu).max() <= steepest / 4000 * 1.001


def test_regions_keep_their_place_when_the_weights_change() -> None:
    # Region and place are free of the weights; the axis is made from them.
    horizon = horizon_cosine(6400e3, 6360e3)
    assert view_region(-1.0, True, horizon, 2.0, 2.0, 2.0) == (SURFACE, 0.0)
    assert view_region(horizon, True, horizon, 2.0, 2.0, 2.0) == (SURFACE, 1.0)
    assert view_region(horizon, False, horizon, 2.0, 2.0, 2.0) == (LOWER, 0.0)
    assert view_region(0.0, False, horizon, 2.0, 2.0, 2.0) == (UPPER, 0.0)
    region, x = view_region(0.25, False, horizon, 2.0, 2.0, 2.0)
    assert (region, x) == (UPPER, 0.5)
    assert region_coordinate(region, x, 0.5, 0.25) == 0.875


def test_mixed_readings_of_the_weights_leave_no_sky_at_the_top() -> None:
    # physics: reading (8/32, 4/32) as slope and offset gives w_U = 0 at the top; the inverse
    # then still answers, with straight up.
    w_l, w_s = lower_weight(1.0, 20 / 32), surface_weight(1.0, 8 / 32, 4 / 32)
    assert w_l + w_s == 1.0
    assert view_from_coordinate(1.0, -0.175, 2.0, 2.0, 2.0, w_l, w_s) == (1.0, False)
