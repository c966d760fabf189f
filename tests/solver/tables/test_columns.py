"""Columns along rays: laws that hold for any air."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import quad

from airlight.geometry.path import ray_length
from airlight.geometry.shell import horizon_cosine
from airlight.kernel import vectorized
from airlight.physics.optics.density_profile import DensitySegments, exponential, tent, uniform
from airlight.solver.tables.column_ratios import rational_mean_density
from airlight.solver.tables.columns import ColumnTable, columns

BOTTOM, TOP = 6360e3, 6460e3
AIR = DensitySegments.from_rows(
    [exponential(8e3, 1e5), exponential(1.2e3, 1e5), tent(25e3, 15e3, 1e5), uniform(1e5)]
)


@pytest.fixture
def rays() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Start radius, cosine and length of rays in all directions."""
    rng = np.random.default_rng(6)
    r = BOTTOM + 1e5 * rng.random(2000) ** 2
    mu = rng.uniform(-1.0, 1.0, r.size)
    mu[::4] = vectorized(horizon_cosine)(r[::4], BOTTOM) + rng.uniform(-0.02, 0.05, r[::4].size)
    mu[1::8] = rng.uniform(-0.01, 0.01, mu[1::8].size)
    return r, mu, vectorized(ray_length)(r, mu, BOTTOM, TOP)


def test_ratios_of_air_that_is_not_there_are_numbers_in_single_precision() -> None:
    # 1/sqrt of a density of 0 was 1e150: infinite in single precision, and 0 of it no number
    nothing = DensitySegments.from_rows([exponential(8e3, 1e5), exponential(1e-2, 1e5)])
    table = ColumnTable.build(BOTTOM, TOP, nothing, (8, 16))
    table = replace(table, values=table.values * [1.0, 0.0])
    ratios = rational_mean_density(table).astype(np.float32)
    assert np.isfinite(ratios).all()
    assert_allclose(ratios[..., 1, 1], 0.0, atol=0.0)


def test_the_column_of_uniform_air_is_the_length(rays: tuple[np.ndarray, ...]) -> None:
    # ∫ ds = s, to rounding: next to a tangent point 1e-9 m of radius are 0.1 m of distance.
    r, mu, length = rays
    assert_allclose(columns(r, mu, length, BOTTOM, AIR)[:, 3], length, rtol=1e-9, atol=0.5)


def test_columns_of_parts_add_up_to_the_whole(rays: tuple[np.ndarray, ...]) -> None:
    # T(a, c) = T(a, b)·T(b, c): the light does not know where a path is cut in two.
    r, mu, length = rays
    share = np.random.default_rng(7).random(r.size)
    first = share * length
    r_cut = np.sqrt(r * r + first * first + 2.0 * r * mu * first)
    mu_cut = np.clip((r * mu + first) / r_cut, -1.0, 1.0)
    whole = columns(r, mu, length, BOTTOM, AIR)
    parts = columns(r, mu, first, BOTTOM, AIR) + columns(r_cut, mu_cut, length - first, BOTTOM, AIR)
    # A start that is rounded to 1e-9 m next to the tangent point moves the cut by up to 0.1 m.
    assert_allclose(parts, whole, rtol=3e-6, atol=0.5)
    extinction = np.array([33.1e-6, 4.44e-6, 1.9e-6, 0.0])
    assert_allclose(np.exp(-parts @ extinction), np.exp(-whole @ extinction), rtol=1e-5, atol=1e-12)


def test_there_and_back_are_the_same_column(rays: tuple[np.ndarray, ...]) -> None:
    # A path has one column, from whichever end it is walked.
    r, mu, length = rays
    r_end = np.sqrt(r * r + length * length + 2.0 * r * mu * length)
    r_end = np.clip(r_end, BOTTOM, TOP)
    mu_back = -np.clip((r * mu + length) / r_end, -1.0, 1.0)
    assert_allclose(
        columns(r_end, mu_back, length, BOTTOM, AIR), columns(r, mu, length, BOTTOM, AIR),
        rtol=1e-5, atol=0.5,
    )  # fmt: skip


@pytest.mark.parametrize("mu", [1.0, 0.3, 0.02, 0.003, 0.0, -0.02, -0.0559])
@pytest.mark.parametrize("altitude", [0.0, 5e3, 20e3, 35e3])
def test_columns_are_the_integrals_of_the_densities(altitude: float, mu: float) -> None:
    # Second method: adaptive quadrature of each profile's own formula over the distance.
    r = BOTTOM + altitude
    if mu < horizon_cosine(r, BOTTOM):
        pytest.skip("meets the ground")
    length = ray_length(r, mu, BOTTOM, TOP)
    profiles = [
        lambda h: np.exp(-h / 8e3), lambda h: np.exp(-h / 1.2e3),
        lambda h: max(0.0, 1.0 - abs(h - 25e3) / 15e3), lambda h: 1.0,
    ]  # fmt: skip
    cuts = {0.0, length, max(-r * mu, 0.0)}
    for corner in (2e3, 6e3, 10e3, 25e3, 40e3, 60e3):
        square = (BOTTOM + corner) ** 2 - r * r * (1.0 - mu * mu)
        if square > 0.0:
            cuts |= {s for s in (-r * mu - square**0.5, -r * mu + square**0.5) if 0.0 < s < length}
    points = sorted(cuts)
    for got, profile in zip(columns(r, mu, length, BOTTOM, AIR), profiles, strict=True):
        truth = sum(
            quad(
                lambda s, f=profile: f(np.sqrt(r * r + s * s + 2 * r * s * mu) - BOTTOM), a, b,
                epsrel=1e-10, epsabs=1e-6, limit=200,
            )[0]
            for a, b in pairwise(points)
        )  # fmt: skip
        assert_allclose(got, truth, rtol=1e-6, atol=1e-3)


def test_a_table_holds_what_quadrature_gives_at_its_ends() -> None:
    # Ground and top, straight up and along the horizon: the corners of the mapping.
    table = ColumnTable.build(BOTTOM, TOP, AIR, (8, 8))
    tangent = np.sqrt((TOP - BOTTOM) * (TOP + BOTTOM))
    up = columns(BOTTOM, 1.0, 1e5, BOTTOM, AIR)
    level = columns(BOTTOM, 0.0, tangent, BOTTOM, AIR)
    limb = columns(TOP, horizon_cosine(TOP, BOTTOM), 2.0 * tangent, BOTTOM, AIR)
    assert_allclose(table.values[0, 0], up, rtol=1e-5)
    assert_allclose(table.values[0, -1], level, rtol=1e-5)
    assert_allclose(table.values[-1, 0], 0.0, atol=1e-6)
    assert_allclose(table.values[-1, -1], limb, rtol=1e-5)
    # The line along the horizon seen from the top is the level ray of the ground, twice.
    assert_allclose(limb, 2.0 * level, rtol=1e-6)
    assert (np.diff(table.values[..., 3], axis=1) > 0.0)[:-1].all()
