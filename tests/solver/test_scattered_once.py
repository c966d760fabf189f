"""The quick quadrature of light scattered once, against the careful one."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.geometry.path import ray_length
from airlight.geometry.shell import meets_ground
from airlight.kernel import vectorized
from airlight.planets import Constituent, Planet, replace
from airlight.planets.matter.phases import HenyeyGreenstein
from airlight.planets.matter.profiles import Tent
from airlight.planets.medium import Medium
from airlight.solver.lines_of_sight import LinesOfSight
from airlight.solver.scattered_once import scattered_once
from airlight.solver.single_scattering import single_scattering


@pytest.mark.parametrize("layer", [None, (10e3, 100.0, 0.3), (3e3, 20.0, 1.0)])
def test_quick_and_careful_quadrature_agree_by_day(
    reference_earth: Callable[..., Planet], layer: tuple[float, float, float] | None
) -> None:
    # Second method: adaptive quadrature of the profiles themselves, without tables. The same with
    # a layer of given centre and half width [m], and optical depth.
    planet = reference_earth(albedo=0.3)
    if layer is not None:
        centre, width, depth = layer
        cloud = Constituent(
            name="cloud", profile=Tent(center=centre, half_width=width), scattering=depth / width,
            phase_function=HenyeyGreenstein(asymmetry=0.8),
        )  # fmt: skip
        planet = replace(planet, constituents=(*planet.constituents, cloud))
    medium = Medium.from_planet(planet, planet.wavelengths)
    bottom, top = medium.bottom_radius, medium.top_radius
    rng = np.random.default_rng(11)
    x, view, sun, around = rng.random((4, 60))
    r = bottom + (top - bottom) * x**2
    mu, mu_s = np.cos(np.pi * view), np.cos(np.radians(80.0) * sun)
    nu = mu * mu_s + np.sqrt((1.0 - mu**2) * (1.0 - mu_s**2)) * np.cos(np.pi * around)
    to_ground = np.asarray(vectorized(meets_ground)(r, mu, bottom), bool)
    lines = LinesOfSight(r, mu, mu_s, nu, vectorized(ray_length)(r, mu, bottom, top), to_ground)
    quick, careful = scattered_once(medium, lines), single_scattering(medium, lines)
    # Interpolated columns and 16 points a panel; the ozone's corners count most.
    assert_allclose(quick, careful, rtol=1e-2, atol=1e-5 * careful.max())
    bright = careful > 1e-3 * careful.max()
    assert np.median(np.abs(quick / np.where(bright, careful, 1.0) - 1.0)[bright]) < 1e-3


def test_a_line_of_no_length_scatters_nothing(reference_earth: Callable[..., Planet]) -> None:
    # A limit.
    planet = reference_earth(albedo=0.3)
    medium = Medium.from_planet(planet, planet.wavelengths)
    one, zero = np.ones(1), np.zeros(1)
    lines = LinesOfSight(
        medium.top_radius * one, one, 0.5 * one, 0.5 * one, zero, zero.astype(bool)
    )
    assert_allclose(scattered_once(medium, lines), 0.0, atol=0)
