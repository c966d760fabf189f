"""The first order by quadrature: gas and aerosol apart, thick air, a disc that sets."""

from __future__ import annotations

import csv
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.geometry.path import ray_length
from airlight.geometry.shell import meets_ground
from airlight.geometry.sun_disc import star_elevation
from airlight.planets import Constituent, Ground, Medium, Planet, Star
from airlight.planets.matter.phases import HenyeyGreenstein
from airlight.planets.matter.profiles import Uniform
from airlight.solver.lines_of_sight import LinesOfSight, enter_shell
from airlight.solver.single_scattering import reflected_once, single_scattering
from airlight.solver.star_light import direct_irradiance

RGB = (680.0, 550.0, 440.0)
R, TOP = 6360e3, 6460e3

#: Section 11 of the physics text: altitude [m], sun zenith, view zenith, azimuth [deg], gas and
#: aerosol at 680, 550, 440 nm [sr⁻¹]; None where it is only said to be about 0.
TABLE = [
    (0, 0, 0, 0, (5.185366e-3, 1.117972e-2, 2.398102e-2),
     (1.826243e-2, 1.684971e-2, 1.480460e-2)),
    (0, 60, 0, 0, (3.134886e-3, 6.446098e-3, 1.314929e-2),
     (1.123048e-4, 9.646411e-5, 7.606759e-5)),
    (0, 85, 80, 0, (1.851332e-2, 2.316154e-2, 2.202125e-2),
     (4.915177e-2, 2.350074e-2, 6.715066e-3)),
    (0, 85, 80, 180, (1.754372e-2, 2.114934e-2, 1.948629e-2),
     (8.225719e-5, 3.885843e-5, 1.083821e-5)),
    (0, 94, 0, 0, (8.23933e-5, 4.81661e-5, 9.09019e-5), None),
    (30e3, 30, 90, 90, (2.129340e-3, 4.336579e-3, 1.166657e-2), None),
    (100e3, 30, 180, 0, (4.511166e-3, 9.520487e-3, 2.097659e-2),
     (2.305006e-5, 1.972848e-5, 1.563138e-5)),
]  # fmt: skip


def lines_at(
    altitude: np.ndarray, sun: np.ndarray, view: np.ndarray, azimuth: np.ndarray
) -> LinesOfSight:
    """Lines of sight from angles in degrees."""
    sun, view, azimuth = np.radians(sun), np.radians(view), np.radians(azimuth)
    mu, mu_s = np.cos(view), np.cos(sun)
    nu = np.clip(mu * mu_s + np.sin(view) * np.sin(sun) * np.cos(azimuth), -1.0, 1.0)
    return enter_shell(R + altitude, mu, np.sin(view), mu_s, nu, R, TOP)


def one_line(
    r: float, mu: float, mu_s: float, nu: float, bottom: float, top: float
) -> LinesOfSight:
    return LinesOfSight(
        *(np.array([x]) for x in (r, mu, mu_s, nu)),
        length=np.array([ray_length(r, mu, bottom, top)]),
        to_ground=np.array([bool(meets_ground(r, mu, bottom))]),
    )


def test_gas_and_aerosol_meet_their_own_golden_columns(
    reference_earth: Callable[..., Planet], tell: Callable[[str], None]
) -> None:
    # An authority converged to 1e-13, printed with seven digits (twilight: with six, and 7e-7).
    medium = Medium.from_planet(reference_earth(albedo=0.0), RGB)
    rows = np.array([row[:4] for row in TABLE], float)
    lines = lines_at(*rows.T)
    light = single_scattering(medium, lines) * medium.phase_function(lines.nu)
    gas = np.array([row[4] for row in TABLE])
    tell(f"golden gas: largest error {np.abs(light[:, 0] / gas - 1.0).max():.1e}")
    assert_allclose(light[:, 0], gas, rtol=2e-6)
    printed = [k for k, row in enumerate(TABLE) if row[5] is not None]
    aerosol = np.array([TABLE[k][5] for k in printed], float)
    tell(f"golden aerosol: largest error {np.abs(light[printed, 1] / aerosol - 1.0).max():.1e}")
    assert_allclose(light[printed, 1], aerosol, rtol=2e-6)
    assert_allclose(light[4, 1, 0], 2.5e-12, rtol=0.02)  # "about" there: half its last digit
    assert_allclose(light[5, 1], 4e-14, rtol=0.15)
    assert_array_equal(light[:, 2], 0.0)  # ozone scatters nothing


def test_first_order_meets_an_independent_quadrature(
    reference_earth: Callable[..., Planet], reference_data: Path, tell: Callable[[str], None]
) -> None:
    # Another program's quadrature, from noon to deep twilight, ground to space; its own error in
    # twilight is said to be below 1e-4 (seven digits are printed).
    with (reference_data / "spherical-monte-carlo.csv").open() as stream:
        rows = [r for r in csv.DictReader(stream) if r["scene"] == "full-cornette-shanks"]
    rows = [r for r in rows if r["ground_albedo"] == "0.3"][::3]
    names = ("altitude_m", "sun_zenith_deg", "view_zenith_deg", "azimuth_deg")
    lines = lines_at(*np.array([[float(r[name]) for name in names] for r in rows]).T)
    medium = Medium.from_planet(reference_earth(albedo=0.3), RGB)
    light = (single_scattering(medium, lines) * medium.phase_function(lines.nu)).sum(axis=1)
    for got, name in (
        (light, "single_scattering"),
        (reflected_once(medium, lines), "ground_direct"),
    ):
        known = np.array([[float(r[f"{name}_{nm:.0f}nm"]) for nm in RGB] for r in rows])
        bright = known > 1e-7
        error = np.abs(got[bright] / known[bright] - 1.0)
        tell(f"{name}: {error.size} values, median {np.median(error):.1e}, max {error.max():.1e}")
        assert error.size > 300
        assert np.median(error) < 1e-5
        assert_allclose(got[bright], known[bright], rtol=1e-4)
        assert_allclose(got[~bright], known[~bright], rtol=0, atol=1e-9)


def slab(depth: float, albedo: float = 0.0) -> Medium:
    """Uniform air of a vertical optical depth that scatters all it takes; a point star."""
    planet = Planet(
        name="slab",
        bottom_radius=R,
        top_radius=R + 50e3,
        ground=Ground(albedo=albedo),
        star=Star(irradiance=1.0, angular_radius=0.0),
        constituents=(
            Constituent(
                name="air", profile=Uniform(), scattering=depth / 50e3,
                phase_function=HenyeyGreenstein(asymmetry=0.0),
            ),
        ),
    )  # fmt: skip
    return Medium.from_planet(planet, [550.0])


@pytest.mark.parametrize("depth", [1e-3, 1.0, 30.0, 3000.0])
def test_vertical_light_in_uniform_air_has_closed_forms(depth: float) -> None:
    # A star in the zenith: looking up, every place adds β e^{-τ}; looking down from the top, a
    # place at depth t adds e^{-2t}. Also where a panel holds hundreds of optical depths.
    medium = slab(depth, albedo=0.4)
    bottom, top = medium.bottom_radius, medium.top_radius
    up = single_scattering(medium, one_line(bottom, 1.0, 1.0, 1.0, bottom, top))[0, 0, 0]
    downward = one_line(top, -1.0, 1.0, -1.0, bottom, top)
    down = single_scattering(medium, downward)[0, 0, 0]
    assert_allclose(up, depth * np.exp(-depth), rtol=1e-5)
    assert_allclose(down, -np.expm1(-2.0 * depth) / 2.0, rtol=1e-5)
    assert_allclose(
        reflected_once(medium, downward)[0, 0], 0.4 / np.pi * np.exp(-2.0 * depth), rtol=1e-5
    )


def test_a_line_that_misses_the_air_is_black(reference_earth: Callable[..., Planet]) -> None:
    # There is nothing to scatter.
    medium = Medium.from_planet(reference_earth(albedo=0.3), RGB)
    lines = lines_at(*(np.array([x]) for x in (500e3, 30.0, 60.0, 0.0)))
    assert_array_equal(single_scattering(medium, lines), 0.0)
    assert_array_equal(reflected_once(medium, lines), 0.0)


@pytest.mark.parametrize("sun", [60.0, 89.9, 90.2, 91.0])
def test_a_disc_is_the_mean_of_its_points(
    sun: float, reference_earth: Callable[..., Planet]
) -> None:
    # By the law of superposition. The star is made ten times the sun's size so that what the
    # strips neglect shows; points that set on the way leave the sum of 900 points rough by 1e-3.
    from dataclasses import replace

    radius = np.radians(2.0)
    point = Medium.from_planet(reference_earth(albedo=0.3), [550.0])
    disc = replace(point, star_angular_radius=radius)
    centre = np.array([np.sin(np.radians(sun)), 0.0, np.cos(np.radians(sun))])
    view = np.radians(70.0)
    looks = np.array([np.sin(view) * np.cos(1.0), np.sin(view) * np.sin(1.0), np.cos(view)])
    count = 900
    k = np.arange(count)  # a sunflower: equal areas
    away, turn = radius * np.sqrt((k + 0.5) / count), k * np.pi * (3.0 - np.sqrt(5.0))
    across = np.array([np.cos(np.radians(sun)), 0.0, -np.sin(np.radians(sun))])
    suns = np.cos(away)[:, None] * centre + np.sin(away)[:, None] * (
        np.cos(turn)[:, None] * across + np.sin(turn)[:, None] * np.array([0.0, 1.0, 0.0])
    )
    full = np.full(count, np.cos(view))
    length = np.full(count, ray_length(R, np.cos(view), R, TOP))
    lines = LinesOfSight(
        np.full(count, R), full, suns[:, 2], suns @ looks, length, np.zeros(count, bool)
    )
    one = LinesOfSight(
        np.array([R]), full[:1], centre[2:], np.array([centre @ looks]), length[:1],
        np.zeros(1, bool),
    )  # fmt: skip
    expected = single_scattering(point, lines).mean(axis=0)
    assert_allclose(single_scattering(disc, one)[0, :2], expected[:2], rtol=3e-3)
    level = direct_irradiance(point, lines.r, lines.mu_s).mean(axis=0)
    got = direct_irradiance(disc, one.r, one.mu_s)[0]
    assert_allclose(got, level, rtol=3e-2 if sun > 90.0 else 3e-3, atol=1e-7)


def test_elevation_is_the_angle_above_the_geometric_horizon() -> None:
    # The horizon dips by acos(R/r): a star at zenith angle 90° + dip stands on it.
    r = R + 10e3
    dip = np.arccos(R / r)
    assert_allclose(star_elevation(r, np.cos(np.pi / 2.0 + dip), R), 0.0, atol=1e-9)
    assert_allclose(star_elevation(r, 1.0, R), np.pi / 2.0 + dip, rtol=1e-12)
