"""Stretches and starlight out of the transmittance table, against quadrature of the air itself."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight import Medium, ParameterError, load_planet
from airlight.geometry.path import ray_length
from airlight.kernel import vectorized
from airlight.tables.columns import columns
from airlight.tables.irradiance import IrradianceLayout
from airlight.tables.stretches import star_transmittance, stretch_transmittance
from airlight.tables.table import Table
from airlight.tables.transmittance import TransmittanceLayout


@pytest.fixture(scope="module")
def medium() -> Medium:
    return Medium.from_planet(load_planet("earth-atmosphere-plus"), [680.0, 550.0, 440.0])


@pytest.fixture(scope="module")
def table(medium: Medium) -> Table:
    layout = TransmittanceLayout(bottom_radius=medium.bottom_radius, top_radius=medium.top_radius)
    places = layout.places()
    length = vectorized(ray_length)(places.r, places.mu, 0.0, medium.top_radius)
    depth = columns(places.r, places.mu, length, medium.bottom_radius, medium.density)
    values = np.exp(-depth @ medium.extinction).reshape(*layout.shape, 3)
    return Table(
        name="transmittance", quantity="transmittance", unit="1", layout=layout,
        channels=("680", "550", "440"), values=values,
    )  # fmt: skip


def test_stretches_are_what_quadrature_says(medium: Medium, table: Table) -> None:
    # A second method. The table's own error is up to 6e-3 of T at the horizon; a ratio doubles it.
    rng = np.random.default_rng(7)
    r = medium.bottom_radius + 60e3 * rng.random(400) ** 2
    mu = np.cos(np.pi * rng.random(400))
    length = rng.random(400) * vectorized(ray_length)(
        r, mu, medium.bottom_radius, medium.top_radius
    )
    exact = np.exp(
        -columns(r, mu, length, medium.bottom_radius, medium.density) @ medium.extinction
    )
    got = stretch_transmittance(table, r, mu, length)
    assert_allclose(got, exact, atol=1.2e-2)
    assert np.median(np.abs(got - exact)) < 1e-4


def test_two_stretches_multiply_to_one(table: Table) -> None:
    # T(p, q) T(q, s) = T(p, s): ratios telescope exactly, upwards as well as down to the ground.
    for mu in (0.3, -0.5):
        r, first, second = 6370e3, 4e3, 9e3
        end = np.sqrt(r**2 + first**2 + 2.0 * r * first * mu)
        one = stretch_transmittance(table, r, mu, first)
        other = stretch_transmittance(table, end, (r * mu + first) / end, second)
        assert_allclose(
            one * other, stretch_transmittance(table, r, mu, first + second), rtol=1e-12
        )


def test_half_a_disc_on_the_horizon_gives_half_the_light(table: Table) -> None:
    # By symmetry of the disc; above and below it by more than its radius all and nothing.
    bottom = 6360e3
    radius = 0.00465
    whole = star_transmittance(table, bottom, 0.0, 0.0) * 0.0 + table.look_up(
        bottom, 0.0, to_ground=False
    )
    assert_allclose(star_transmittance(table, bottom, 0.0, radius), 0.5 * whole, rtol=1e-12)
    assert_array_equal(star_transmittance(table, bottom, -0.006, radius), 0.0)
    assert_allclose(
        star_transmittance(table, bottom, 0.3, radius), table.look_up(bottom, 0.3), rtol=1e-12
    )


def test_another_table_is_refused() -> None:
    layout = IrradianceLayout(bottom_radius=1.0, top_radius=1.1)
    table = Table(
        name="skylight", quantity="irradiance", unit="1", layout=layout, channels=("550",),
        values=np.zeros((*layout.shape, 1)),
    )  # fmt: skip
    with pytest.raises(ParameterError, match="skylight"):
        stretch_transmittance(table, 1.0, 1.0, 0.05)
