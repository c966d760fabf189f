"""Polarised light of the suite: tables, neutral points, and thresholds that can fail."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.planets import load_planet
from airlight.solver import solve
from airlight.validation.cases import CASES
from airlight.validation.polarised.flat_air import coulson_values, differences, flat_rayleigh
from airlight.validation.polarised.histories import (
    PLANETS,
    Beside,
    PolarisedPlanet,
    beside,
    line_table,
    summary,
)
from airlight.validation.polarised.light import neutral_distances
from airlight.validation.polarised.round_air import reference_sky, round_rayleigh
from airlight.validation.run import SUITES
from airlight.validation.suite import SuiteRun


def test_the_suite_is_registered_and_needs_no_data() -> None:
    # What `airlight validate --suite polarisation` finds.
    assert SUITES["polarisation"].files == ()


def test_flat_air_has_the_polarisation_of_the_corrected_coulson_tables() -> None:
    # Natraj, Li & Yung (2009): `default` quality, 0.45 % of I and 0.002 of Q/I and U/I; `fine`,
    # which the suite judges, has 0.09 %.
    values = coulson_values()[0.0]
    solution = solve(flat_rayleigh(0.0), (550.0,), cache=False)
    light, degree = differences(solution, values)
    assert_allclose(light, 0.0, atol=0.45)
    assert_allclose(degree, 0.0, atol=0.002)


def test_a_round_sky_is_that_of_another_program() -> None:
    # SASKTRAN 2 by builders/polarised_sky.py: `preview` quality, 1.5 % of I, 0.02 of the degree:
    # histories are within 0.002 of ours where theirs differs by 0.017, sun 80°, view 30°.
    sky = reference_sky()
    rows = (sky.depth == 0.5) & (sky.zenith < 80.0)
    found = solve(round_rayleigh(0.5), (550.0,), "preview", cache=False).radiance(
        altitude=0.0, sun_zenith=sky.sun[rows], view_zenith=sky.zenith[rows],
        azimuth=sky.azimuth[rows], stokes=True,
    ).values[..., 0]  # fmt: skip
    known = sky.stokes[rows]
    assert_allclose(found[:, 0], known[:, 0], rtol=0.015)
    assert_allclose(found[:, 1:] / found[:, :1], known[:, 1:] / known[:, :1], atol=0.02)


@pytest.mark.parametrize(
    ("sun", "names"), [(88.0, {"Arago", "Babinet"}), (50.0, {"Babinet", "Brewster"})]
)
def test_neutral_points_are_where_they_were_found(sun: float, names: set[str]) -> None:
    # AMS, Glossary of Meteorology: about 20° from the sun or the point opposite, nearer to a high
    # sun (Coulson 1988); 10° to 25°.
    solution = solve(load_planet("earth-atmosphere-plus"), (550.0,), "preview")
    found = neutral_distances(solution, sun)
    for name in names:
        assert 10.0 < found[name] < 25.0


def test_light_that_is_off_is_not_explained_by_noise() -> None:
    # The threshold can fail: the same answers agree, 2 % of I or 0.03 of the degree do not.
    one = np.broadcast_to([[1.0], [0.3], [-0.2]], (1, 3, 1)).astype(float)
    same = Beside(
        ours=one, scalar=one[:, 0], known=one, error=np.full_like(one, 1e-4), nu=np.zeros(1)
    )
    assert not same.disagree.any()
    assert replace(same, ours=one * 1.02).disagree.all()
    turned = one + np.array([[0.0], [0.03], [0.0]])
    assert replace(same, ours=turned).disagree.all()


def test_the_table_of_a_planet_counts_what_is_left_out() -> None:
    # Four lines: judged and off by 4 standard errors of I; in the aureole; dark; noisy.
    known = np.tile([[1.0], [0.2], [0.1]], (4, 1, 3))
    known[2] *= 1e-8
    error = np.full_like(known, 0.005) * known[:, :1]
    error[3] *= 10.0
    ours = known.copy()
    ours[0, 0] += 0.02
    found = Beside(ours=ours, scalar=ours[:, 0], known=known, error=error,
                   nu=np.array([0.0, 1.0, 0.0, 0.0]))  # fmt: skip
    cells = summary(found)
    assert cells[1:4] == ("3 of 12", "3, 3, 3", "0.50")
    assert cells[-3:] == ("0, 100, 100", "16.0, 0.0, 0.0", "3")
    rows = line_table(PLANETS[-1], CASES[:4], len(CASES), found).rows
    assert [row[-1] for row in rows] == ["not explained", "aureole", "dark", "noisy"]
    assert rows[0][1] == "+2.00 ± 0.50"


@pytest.mark.validation
@pytest.mark.parametrize("name", ["earth", "mars-standard"])
def test_moments_are_histories_within_their_noise(name: str) -> None:
    # Two methods, one wavelength, every fourth line of sight of the grid.
    air, planet = PolarisedPlanet(planet=name), load_planet(name)
    found = beside(SuiteRun(), planet, air, CASES[::4], (440.0,))
    assert found.disagree.sum() <= 1
