"""Transits: an isothermal limb in closed form, opaque and empty planets, bent light."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose
from spheres import HEIGHT, RADIUS, sphere

from airlight import load_planet, replace
from airlight.planets import Star
from airlight.solver.moments.solution import MomentsSolution
from airlight.studies.observables.transit import transit

Solved = Callable[..., MomentsSolution]
GREEN = (550.0,)


@pytest.mark.parametrize("depth", [0.1, 0.5, 2.0])
def test_an_isothermal_limb_is_as_high_as_the_closed_form_says(
    depth: float, solved: Solved
) -> None:
    # h = H (γ + ln τ), τ the depth of the ray that grazes the ground, if it is well above 1
    # (de Wit & Seager 2013, Science 342, 1473, eq. S4); exact to H/R and to e^-τ
    found = transit(solved(sphere(depth, 0.3), GREEN, "preview"))
    slant = depth * math.sqrt(2.0 * math.pi * RADIUS / HEIGHT)
    height = HEIGHT * (np.euler_gamma + math.log(slant))
    assert_allclose(found.radius - RADIUS, height, rtol=3e-3, atol=30.0)
    assert found.error.max() < 1.0
    assert found.lowest == RADIUS
    assert not found.limited_by_refraction


def test_without_air_the_ground_is_what_blocks(solved: Solved) -> None:
    found = transit(solved(sphere(0.0, 0.3), GREEN, "preview"))
    assert_allclose(found.radius, RADIUS, rtol=1e-9)


def test_refraction_hides_the_lower_air_of_the_earth_from_its_star(solved: Solved) -> None:
    # Bétrémieux & Kaltenegger (2014), ApJ 791, 7: for the Earth before the sun rays below
    # 12.75 km do not reach the observer; García Muñoz et al. (2012), ApJ 755, 103: 12 to 14 km.
    # A star of three times the angular size shows rays from farther down.
    earth = load_planet("earth")
    found = transit(solved(earth, GREEN, "preview"))
    height = found.lowest - earth.bottom_radius
    assert found.limited_by_refraction
    assert 12e3 < height < 14.5e3
    near = replace(earth, star=Star(spectrum="astm-g173", angular_radius=0.8))
    lower = transit(solved(near, GREEN, "preview")).lowest
    assert lower < found.lowest - 4e3
    straight = transit(solved(replace(earth, refraction="none"), GREEN, "preview"))
    assert straight.lowest == earth.bottom_radius
    assert (straight.radius <= found.radius + 1e-3).all()
