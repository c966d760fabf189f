"""Forward peaks that several scatterings widen."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import Medium, load_planet, solve
from airlight.geometry.quadrature import gauss_legendre
from airlight.kernel import vectorized
from airlight.physics.optics.phase_functions import henyey_greenstein
from airlight.solver.moments.delta_m import Optics
from airlight.solver.moments.forward_peak import (
    ANGLES,
    DEPTHS,
    MIDDLE,
    inverse_peak_fraction,
    peak_broadening,
)
from extremes import Case, lost

DEGREE = 6
LOBE = vectorized(henyey_greenstein)


def table_of(g: float) -> tuple[np.ndarray, np.ndarray, float]:
    """Depths, additional light of thick particles of one asymmetry, and their peak's part."""
    medium = Medium.from_planet(Case(asymmetry=g, depth=3.0).planet(), [550.0])
    optics = Optics(medium, DEGREE)
    table = peak_broadening(optics)
    assert table is not None
    place = np.arange(DEPTHS - 1) / (DEPTHS - 1)
    return (
        MIDDLE * place / (1.0 - place),
        table[:, :, 0],
        1.0 / float(inverse_peak_fraction(optics)[0, 0]),
    )


@pytest.mark.parametrize("g", [0.9, 0.99])
def test_a_widened_peak_has_the_light_that_was_taken_off_its_way(g: float) -> None:
    # Light of a depth x of peaks goes (1 - exp(-x))/x as far per scattering in them: so the
    # additional light integrates to f ((1 - exp(-x))/x - 1) over the sphere. Between the table's
    # nodes, 128 over 180°, half a per cent is lost, more where it is cut at zero.
    x, table, part = table_of(g)
    rule = gauss_legendre(2000)
    at = rule.nodes  # the fourth root of sin(θ/2)
    phase = LOBE(1.0 - 2.0 * at**8, g)
    weight = 8.0 * np.pi * at**4 * 4.0 * at**3 * rule.weights
    nodes = np.linspace(0.0, 1.0, ANGLES)
    found = [float((np.interp(at, nodes, row) * phase * weight).sum()) for row in table[1:-1]]
    wanted = part * (-np.expm1(-x[1:]) / x[1:] - 1.0)
    few = x[1:] < 5.0
    assert_allclose(np.array(found)[few], wanted[few], rtol=0, atol=5e-3)


def test_few_scatterings_leave_the_exact_phase_function() -> None:
    # Of no depth the light is scattered once, and nothing is added.
    _, table, _ = table_of(0.9)
    assert_allclose(table[0], 0.0, rtol=0, atol=1e-9)


def test_two_scatterings_of_henyey_greenstein_are_one_of_its_square() -> None:
    # Moments g^l squared are those of g². At a small depth x the second scattering adds x/2 of the
    # peak's square, whose moments are f² up to the degree and g^2l beyond, and takes x of the peak.
    g = 0.95
    x, table, part = table_of(g)
    nu = 1.0 - 2.0 * np.linspace(0.0, 1.0, ANGLES) ** 8
    once, twice = LOBE(nu, g), LOBE(nu, g * g)
    for l in range(DEGREE + 1):
        legendre = (2 * l + 1) / (4.0 * np.pi) * np.polynomial.legendre.Legendre.basis(l)(nu)
        once = once + (part - g**l) * legendre
        twice = twice + (part**2 - g ** (2 * l)) * legendre
    depth = x[1]
    third = 0.5 * depth**2 * part  # what is left out: the next term, per light of the peak
    expected = (depth * (0.5 * twice / part - once)) / LOBE(nu, g)
    near = nu > 0.95
    assert_allclose(table[1][near], expected[near], rtol=0, atol=2.0 * third)


@pytest.mark.parametrize(
    ("g", "depth"), [pytest.param(0.99, 3.0, marks=pytest.mark.slow), (0.999, 30.0)]
)
def test_conservative_air_of_sharp_peaks_loses_no_light(g: float, depth: float) -> None:
    # Light that came leaves at the top: 2.6 and 35 % too much left before peaks were widened.
    case = Case(asymmetry=g, depth=depth, albedo=1.0)
    solution = solve(case.planet(), quality="preview", cache=False)
    assert abs(lost(solution, case)) < 0.01


@pytest.mark.slow
def test_the_aureole_of_a_low_sun_in_dust_is_that_of_histories() -> None:
    # The second method: Monte Carlo, within 2 % and three standard errors; 76 % before.
    planet = load_planet("mars")
    planet = replace(planet, star=replace(planet.star, angular_radius=0.0))
    seen = {"altitude": 0.0, "sun_zenith": 85.0, "view_zenith": [84.5, 83.0, 80.0], "azimuth": 0.0}
    ours = solve(planet, [440.0], quality="default", cache=False).radiance(**seen).values
    histories = solve(planet, [440.0], quality="preview", solver="montecarlo").estimate(**seen)
    error = 3.0 * histories["standard_error"].values
    assert (np.abs(ours - histories["radiance"].values) < 0.02 * ours + error).all()
