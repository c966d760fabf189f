"""Layouts of tables: texels are where they say, nothing crosses the horizon, on any planet."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.errors import ParameterError
from airlight.geometry.mappings.scattering import sun_coordinate, view_coordinate
from airlight.geometry.mappings.transmittance import altitude_coordinate, radius_from_coordinate
from airlight.geometry.shell import horizon_cosine
from airlight.kernel import vectorized
from airlight.solver.tables.atmosphere_plus import MAPPINGS, AtmospherePlusLayout, at_azimuth
from airlight.solver.tables.bruneton import BrunetonLayout
from airlight.solver.tables.irradiance import IrradianceLayout
from airlight.solver.tables.layout import Positions, TableLayout
from airlight.solver.tables.table import Table, layout_of, stored
from airlight.solver.tables.transmittance import TransmittanceLayout

#: Earth, Mars, Titan, and a small planet with 1 km of air. [m]
SHELLS = [(6360e3, 6460e3), (3389.5e3, 3509.5e3), (2575e3, 3175e3), (1e5, 1.01e5)]
LAYOUTS: list[tuple[type[TableLayout], dict[str, Any]]] = [
    (TransmittanceLayout, {"radii": 12, "views": 20}),
    (IrradianceLayout, {"radii": 5, "sun_angles": 9}),
    (BrunetonLayout, {"radii": 6, "views": 12, "sun_angles": 7, "angles": 5}),
    *((AtmospherePlusLayout, {"altitudes": 6, "views": 33, "sun_angles": 7, "mapping": one})
      for one in MAPPINGS),
    (AtmospherePlusLayout, {"altitudes": 6, "views": 33, "sun_angles": 7, "surface_offset": 0.0}),
    (AtmospherePlusLayout, {"altitudes": 6, "views": 33, "sun_angles": 7, "lower_weight": 0.0}),
]  # fmt: skip

every_layout = pytest.mark.parametrize(("kind", "sizes"), LAYOUTS)
every_shell = pytest.mark.parametrize("shell", SHELLS)
of_scattering = pytest.mark.parametrize(("kind", "sizes"), LAYOUTS[2:])


def made(kind: type[TableLayout], sizes: dict[str, Any], shell: tuple[float, float]) -> TableLayout:
    return kind(bottom_radius=shell[0], top_radius=shell[1], **sizes)


def filled(layout: TableLayout, values: np.ndarray) -> Table:
    return Table(
        name="x", quantity="a test", unit="1", layout=layout, channels=("a",),
        values=np.asarray(values, float).reshape(*layout.shape, 1),
    )  # fmt: skip


@every_shell
@every_layout
def test_look_up_at_a_texel_gives_its_value(
    kind: type[TableLayout], sizes: dict[str, Any], shell: tuple[float, float]
) -> None:
    # Interpolation at a node is the node's value; here every value is another.
    layout = made(kind, sizes, shell)
    values = np.random.default_rng(3).random(int(np.prod(layout.shape)))
    positions = layout.positions()
    own = np.ones(len(positions), bool)
    if isinstance(layout, BrunetonLayout):
        # A texel whose angle no view and sun can have stands at the nearest possible one.
        nu = np.broadcast_to(np.linspace(-1.0, 1.0, layout.angles), layout.shape).ravel()
        own = (np.abs(positions.nu - nu) < 1e-12) & (positions.r > shell[0])
    if isinstance(layout, (TransmittanceLayout, BrunetonLayout)):
        # On the ground every view down, at the top every view up has the same length 0.
        own &= (positions.r < shell[1]) & (positions.r > shell[0])
    if isinstance(layout, AtmospherePlusLayout):
        # On the ground the region between horizon and horizontal is empty.
        own &= (positions.r > shell[0]) | (np.abs(positions.mu) > 1e-9)
    assert own.sum() > 0.1 * own.size
    looked = filled(layout, values).at(positions[own])[:, 0]
    # The view's coordinate comes from a square root: 1e-16 becomes 1e-8 of a texel next to
    # straight up or down; nearly all are exact to rounding.
    assert_allclose(looked, values[own], rtol=0, atol=3e-6)
    assert np.percentile(np.abs(looked - values[own]), 80) < 1e-8


@every_shell
@of_scattering
def test_sky_and_ground_are_never_mixed(
    kind: type[TableLayout], sizes: dict[str, Any], shell: tuple[float, float]
) -> None:
    # All texels of the ground hold 1e6, all of the sky 1: any mixture would show, also next to
    # the horizon, at any altitude.
    layout = made(kind, sizes, shell)
    table = filled(layout, np.where(layout.positions().to_ground, 1e6, 1.0))
    rng = np.random.default_rng(4)
    r = shell[0] + (shell[1] - shell[0]) * np.concatenate([[1e-6, 1.0], rng.random(400) ** 3])
    horizon = vectorized(horizon_cosine)(r, shell[0])
    for step in (1e-12, 1e-6, 1e-3, 0.1, 0.5):
        for sign, value in ((1.0, 1.0), (-1.0, 1e6)):
            mu = np.clip(horizon + sign * step, -1.0, 1.0)
            looked = table.look_up(r, mu, 0.3, 0.1, to_ground=sign < 0.0)
            assert_allclose(looked[:, 0], value, rtol=1e-12)
            if step >= 1e-6:
                assert_allclose(table.look_up(r, mu, 0.3, 0.1)[:, 0], value, rtol=1e-12)


@every_shell
def test_bruneton_s_look_up_reproduces_what_is_linear_in_its_coordinates(
    shell: tuple[float, float],
) -> None:
    # Linear interpolation is exact for linear functions: a second computation from the mappings.
    layout = BrunetonLayout(
        bottom_radius=shell[0], top_radius=shell[1], radii=5, views=10, sun_angles=6, angles=4
    )
    lowest = layout.grid.lowest

    def function(p: Positions, nu: np.ndarray) -> np.ndarray:
        x = vectorized(view_coordinate)(p.r, p.mu, p.to_ground, *shell)
        s = vectorized(sun_coordinate)(p.mu_s, lowest, *shell)
        return vectorized(altitude_coordinate)(p.r, *shell) + 10.0 * x + 100.0 * s + 1000.0 * nu

    texels = layout.positions()
    angles = np.broadcast_to(np.linspace(-1.0, 1.0, 4), layout.shape).ravel()
    table = filled(layout, function(texels, angles))
    rng = np.random.default_rng(5)
    height, view, sun, nu = rng.random((4, 500))
    # On the ground and at the top views of length 0 share a coordinate: rows 1 to 3 of 0 to 4.
    positions = Positions.of(
        vectorized(radius_from_coordinate)(0.25 + 0.5 * height, *shell),
        2.0 * view - 1.0,
        lowest + (1.0 - lowest) * sun,
        2.0 * nu - 1.0,
        bottom_radius=shell[0],
    )
    # Square roots of roundings again, times the weight 10.
    assert_allclose(table.at(positions)[:, 0], function(positions, positions.nu), rtol=0, atol=1e-5)


@every_layout
def test_a_layout_is_made_again_from_its_parameters(
    kind: type[TableLayout], sizes: dict[str, Any]
) -> None:
    # What a manifest keeps: name and parameters.
    layout = made(kind, sizes, SHELLS[2])
    assert layout_of(layout.kind, layout.parameters()) == layout
    assert tuple(axis.size for axis in layout.axes) == layout.shape
    names = [name for axis in layout.texture_axes for name in axis]
    assert sorted(names) == sorted(axis.name for axis in layout.axes)


@every_shell
@of_scattering
def test_texels_lie_inside_the_shell_and_ends_are_exact(
    kind: type[TableLayout], sizes: dict[str, Any], shell: tuple[float, float]
) -> None:
    # By definition: ground and top, straight down and straight up, sun overhead.
    layout = made(kind, sizes, shell)
    positions = layout.positions()
    assert (positions.r.min(), positions.r.max()) == shell
    assert positions.mu.max() == 1.0
    if sizes.get("surface_offset") != 0.0:
        assert positions.mu.min() == -1.0
    assert_allclose(positions.mu_s.max(), 1.0, atol=1e-12)
    assert (np.abs(positions.nu) <= 1.0).all()
    down = positions.mu < vectorized(horizon_cosine)(positions.r, shell[0]) - 1e-9
    assert positions.to_ground[down].all()


def test_a_table_s_azimuth_is_that_of_its_positions() -> None:
    # cos of the angle between two directions, from their vectors.
    layout = AtmospherePlusLayout(
        bottom_radius=6360e3, top_radius=6460e3, altitudes=3, views=9, sun_angles=7, azimuth=50.0
    )
    p = layout.positions()
    view, sun = np.arccos(p.mu), np.arccos(p.mu_s)
    around = np.radians(50.0)
    v = [np.sin(view) * np.cos(around), np.sin(view) * np.sin(around), np.cos(view)]
    s = [np.sin(sun), np.zeros_like(sun), np.cos(sun)]
    assert_allclose(p.nu, v[0] * s[0] + v[2] * s[2], rtol=0, atol=1e-15)
    assert_allclose(at_azimuth(p, 180.0).nu, np.cos(view + sun), rtol=0, atol=1e-15)


def test_suns_below_the_table_get_its_last_value() -> None:
    # Below the limit that comes from the planet nothing is left to tell apart.
    layout = made(*LAYOUTS[2], SHELLS[0])
    values = np.random.default_rng(6).random(layout.shape)
    table = filled(layout, values)
    lowest = layout.grid.lowest  # type: ignore[attr-defined]
    below = table.look_up(6400e3, 0.4, [lowest, -0.7, -1.0], 0.2)
    assert_allclose(below, below[:1] * np.ones((3, 1)), rtol=1e-12)


@pytest.mark.parametrize("largest", [1e-12, 1.0, 3e4, 1e9])
def test_halves_hold_every_value_without_overflow(largest: float) -> None:
    # A half has 11 bits; below 2⁻¹⁴ steps of 2⁻²⁴.
    values = largest * 10.0 ** -np.linspace(0.0, 14.0, 1001)
    halves, scale = stored(values, "half")
    assert halves.dtype == np.float16
    assert np.isfinite(halves).all()
    assert_allclose(halves.astype(float) * scale, values, rtol=2.0**-11, atol=scale * 2.0**-25)
    assert scale * 2.0**-24 <= 2.0 * largest * 2.0**-39
    assert_array_equal(stored(np.zeros(3), "half")[0], np.zeros(3, np.float16))


@pytest.mark.parametrize(
    ("wrong", "field"),
    [
        ({"mapping": "cubic"}, "mapping"),
        ({"views": 1}, "size of axis mu"),
        ({"view_power": 0.5}, "view_power"),
        ({"lower_weight": 0.9}, "lower_weight, surface_slope, surface_offset"),
        ({"surface_slope": -0.1}, "lower_weight, surface_slope, surface_offset"),
        ({"surface_slope": 0.0, "surface_offset": 0.0}, "surface_slope, surface_offset"),
        ({"azimuth": np.nan}, "azimuth"),
        ({"top_radius": 6e6}, "bottom_radius, top_radius"),
        ({"sun_angles": 1 << 20, "views": 1 << 10}, "size"),
    ],
)
def test_what_cannot_be_is_refused(wrong: dict[str, Any], field: str) -> None:
    with pytest.raises(ParameterError) as error:
        AtmospherePlusLayout(**{"bottom_radius": 6360e3, "top_radius": 6460e3, **wrong})
    assert error.value.field == field


def test_odd_halves_and_unknown_layouts_are_refused() -> None:
    shell = {"bottom_radius": 6360e3, "top_radius": 6460e3}
    with pytest.raises(ParameterError, match="size of axis mu is 5"):
        BrunetonLayout(**shell, views=5)
    with pytest.raises(ParameterError, match="allowed: bruneton-transmittance"):
        layout_of("octahedral", shell)
    with pytest.raises(ParameterError, match="parameters of layout"):
        layout_of("bruneton-irradiance", {**shell, "rings": 3})
    layout = IrradianceLayout(**shell, radii=2, sun_angles=2)
    with pytest.raises(ParameterError, match="shape of x"):
        Table(name="x", quantity="", unit="1", layout=layout, channels=("a",),
              values=np.zeros((2, 2)))  # fmt: skip
