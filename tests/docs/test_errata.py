"""docs/errata.md: every number of the page, computed again from the printed and from our form."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.geometry.mappings import weighted_power
from airlight.geometry.shell import distance_to_top, radius_along
from airlight.kernel import vectorized
from airlight.physics.constants import BOLTZMANN
from airlight.physics.optics.air_mass import air_mass_pickering2002
from airlight.physics.optics.anomalous_diffraction import efficiencies
from airlight.physics.optics.density_profile import row_column
from airlight.physics.optics.legendre import legendre_moments, phase_integral
from airlight.physics.optics.phase_functions import (
    INV_4PI,
    double_henyey_greenstein,
    henyey_greenstein,
    rayleigh_modified,
)
from airlight.physics.optics.rayleigh import (
    cross_section,
    king_factor_from_depolarisation,
    number_density,
    scale_height,
)
from airlight.physics.optics.refractive_index import (
    AIR_TEMPERATURE,
    CO2_TEMPERATURE,
    STANDARD_PRESSURE,
    air_refractivity_peck1972,
    co2_refractivity_bideau_mehu1973,
)
from airlight.physics.optics.size_distribution import gamma_density
from airlight.planets import Medium, load_planet
from airlight.solver.direct.settings import DirectSettings
from airlight.solver.direct.solution import solve

PAGE = Path(__file__).parents[2] / "docs" / "errata.md"
#: Radii of the later notes and of Bruneton, and wavelengths of the OpenSpace paper.
BOTTOM, TOP = 6360e3, 6460e3
WAVELENGTHS = (680.0, 550.0, 440.0)
#: Table 1 of the paper: its dust of Mars and the lobes it prints for it.
LOBES = (0.889, 0.094, 0.743)
PRINTED_LOBES = ((0.03, 0.094, 0.743), (0.4, 0.89, 0.04), (0.67, 0.099, 0.01))
DUST_INDEX = (1.52 + 0.001j, 1.52 + 0.006j, 1.52 + 0.013j)
MARS_DENSITY = 2.8e23


def page_rows():
    """Cells of the page's table, without its two heading lines."""
    lines = [line for line in PAGE.read_text(encoding="utf-8").splitlines() if line[:1] == "|"]
    return [[c.strip() for c in re.split(r"(?<!\\)\|", line)[1:-1]] for line in lines[2:]]


def page_numbers(source, printed):
    """Numbers on both sides of the arrow of the row of a source and printed text."""
    (effect,) = [row[3] for row in page_rows() if row[0].startswith(source) and printed in row[1]]
    number = r"[-\d.e+]+"
    pattern = rf": ((?:{number}(?:, )?)+|–) → ((?:{number}(?:, )?)+)"
    left, right = re.search(pattern, effect).groups()
    return tuple([] if t == "–" else [float(x) for x in t.split(", ")] for t in (left, right))


def rayleigh_earth_notes():
    def coefficients(density):
        return 1e6 * density * cross_section((650.0, 510.0, 475.0), 3e-4, density)

    return coefficients(2.454e25), coefficients(2.545e25)


def modified_rayleigh():
    def printed(nu):
        return 0.8 * INV_4PI * (1.4 + 0.5 * nu * nu)

    ends = np.array([1.0, -1.0])
    both = printed, vectorized(rayleigh_modified)
    return tuple([*(phase(ends) / INV_4PI), phase_integral(phase)] for phase in both)


def lost_minus():
    ground, height = 6.371e6, 1e3
    return [math.exp(-(ground + height) * ground / 8e3)], [math.exp(-height / 8e3)]


def lost_dot():
    angle = math.radians(60.0)
    return [math.degrees(math.acos(f(angle))) for f in (math.sin,)], [60.0]


def aerosol_absorption():
    def values(name):
        medium = Medium.from_planet(load_planet(name), [550.0])
        return [medium.single_scattering_albedo[1, 0], medium.vertical_optical_depth[1, 0]]

    return values("earth-atmosphere-plus-literal"), values("earth-atmosphere-plus")


def orders():
    planet = load_planet("earth-atmosphere-plus", {"ground.albedo": 0.3})
    medium = Medium.from_planet(planet, [440.0])
    # coarse tables: both sums are 0.4 % off together
    coarse = DirectSettings(
        radii=10, views=12, sun_angles=16, scatter_angles=6, zenith_steps=6, azimuth_steps=12,
        steps=12, pass_steps=8, orders=12, keep_orders=False,
    )  # fmt: skip

    def zenith(literal):
        solution = solve(medium, replace(coarse, literal=literal), cache=False)
        return solution.radiance(altitude=0.0, sun_zenith=30.0, view_zenith=0.0).values.ravel()

    return zenith("atmosphere-plus-2"), zenith("")


def weights():
    def top(slope, offset):
        lower = weighted_power.lower_weight(1.0, weighted_power.DEFAULT_LOWER_WEIGHT)
        surface = weighted_power.surface_weight(1.0, slope, offset)
        return [surface, 1.0 - lower - surface]

    slope = weighted_power.DEFAULT_SURFACE_SLOPE
    offset = weighted_power.DEFAULT_SURFACE_OFFSET
    return top(slope + offset, offset), top(slope, offset)


def bruneton_root():
    sine = math.sqrt(0.75)
    printed = -0.5 * BOTTOM + math.sqrt(TOP**2 - BOTTOM**2 * sine)
    return [1e-3 * printed], [1e-3 * distance_to_top(BOTTOM, 0.5, TOP)]


def zenith_angle_at_q():
    mu, d = math.cos(math.radians(80.0)), 200e3
    at_q = (BOTTOM * mu + d) / radius_along(BOTTOM, mu, d)
    return [80.0], [math.degrees(math.acos(at_q))]


def oxygen_column():
    edges = np.array([0.0, 100e3])
    both = [row_column((edges, np.array([[1.0, s / 8e3, 0.0, 0.0]]))) for s in (1.0, -1.0)]
    return [1e-3 * both[0]], [1e-3 * both[1]]


def sizes():
    radii = np.array([1.6e-6, 5e-6, 10e-6])
    here = gamma_density(radii, 1.6e-6, 0.3)
    printed = here * np.exp(2.0 * radii / (1.6e-6 * 0.3))
    return printed[1:] / printed[0], here[1:] / here[0]


def two_lobes():
    def printed(nu, g1, g2, alpha):
        lobe = vectorized(henyey_greenstein)
        first = alpha / (1.0 - g1 * g1) * lobe(nu, g1)
        return (1.0 + g1 * g1) * (first + (1.0 - alpha) / (1.0 - g2 * g2) * lobe(nu, g2))

    here = vectorized(double_henyey_greenstein)
    return tuple(
        [phase_integral(lambda nu, f=f, s=s: f(nu, *s)) for s in (LOBES, *PRINTED_LOBES)]
        for f in (printed, here)
    )


def particle_height():
    medium = Medium.from_planet(load_planet("earth-openspace"), [550.0])
    return medium.extinction[1] * medium.columns[0], medium.extinction[1] * medium.columns[1]


def pickering():
    altitudes = np.array([0.0, 1.0, 5.0, 10.0])
    lift = 244.0 / (165.0 + 47.0 * altitudes) ** 1.1
    return 1.0 / np.sin(np.radians(altitudes + lift)), air_mass_pickering2002(altitudes)


def king_factor():
    raised = 20.0 * 0.0279
    return [king_factor_from_depolarisation(raised)], [king_factor_from_depolarisation(0.5)]


def earth_extinction():
    medium = Medium.from_planet(load_planet("earth-openspace"), [550.0])
    return [1.0 / 0.1], medium.single_scattering_albedo[1]


def earth_index():
    density = number_density(AIR_TEMPERATURE, STANDARD_PRESSURE)
    factor = king_factor_from_depolarisation(0.035)

    def values(refractivity):
        sigma = float(cross_section(440.0, refractivity, density, factor))
        return [1.0 + refractivity, 1e6 * density * sigma]

    return values(2.8276e-4), values(float(air_refractivity_peck1972(440.0)))


def mars_coefficients(refractivities):
    """Rayleigh coefficients of Table 1's carbon dioxide. [1e-6 m⁻¹]"""
    density = number_density(CO2_TEMPERATURE, STANDARD_PRESSURE)
    factor = king_factor_from_depolarisation(0.09)
    return 1e6 * MARS_DENSITY * cross_section(WAVELENGTHS, refractivities, density, factor)


def mars_rayleigh():
    here = mars_coefficients(co2_refractivity_bideau_mehu1973(WAVELENGTHS))
    return [1287.1, 3056.0, 7640.6], here


def mars_pressure():
    return [2.8e35 * BOLTZMANN * 215.0], [MARS_DENSITY * BOLTZMANN * 215.0]


def mars_index():
    both = [4.4661e-4, 4.5019e-4, 4.5558e-4], co2_refractivity_bideau_mehu1973(WAVELENGTHS)
    return tuple([1.0 + index[2], mars_coefficients(index)[2]] for index in both)


def dust():
    pairs = [efficiencies(1.6e-6, nm, m) for nm, m in zip(WAVELENGTHS, DUST_INDEX, strict=True)]
    return np.array(pairs).T


def dust_index():
    extinction, scattering = dust()
    return [], [*extinction, *(scattering / extinction)]


def dust_lobes():
    lobes = vectorized(double_henyey_greenstein)

    def cosine(lobe):
        return legendre_moments(lambda nu: lobes(nu, *lobe), 1)[1]

    return [cosine(lobe) for lobe in PRINTED_LOBES], [cosine(LOBES)] * 3


def mars_scale_height():
    return [8.0], [1e-3 * scale_height(215.0, 43.34e-3, 3.73)]


def dust_albedo():
    # Eq 17 at T = 2, v = 4, over OpenSpace's extinction of 53.61771e-3/0.98979 per km
    wavenumber = 2.0 * np.pi / (1e-9 * np.array(WAVELENGTHS))
    eq17 = 0.434 * 0.65e-16 * np.pi * wavenumber**2 * np.array([0.31, 0.16, 0.27])
    extinction, scattering = dust()
    return eq17 / (53.61771e-6 / 0.98979), scattering / extinction


#: Source and printed text of each row with numbers, and the function of its numbers.
ROWS = {
    ("AP1", "N_R"): rayleigh_earth_notes,
    ("AP1", "7/5"): modified_rayleigh,
    ("AP1 1b", "h(P)"): lost_minus,
    ("AP1 1b", "det("): lost_dot,
    ("AP2", "β_M^a"): aerosol_absorption,
    ("AP2", "D = C"): lambda: ([-0.05], [0.05 / math.pi]),
    ("AP2", "H⁽²⁾"): orders,
    ("AP2", "w_S"): weights,
    ("BT", "sin θ"): bruneton_root,
    ("BT", "μ_d"): zenith_angle_at_q,
    ("OS Eq 14", "e^"): oxygen_column,
    ("OS Eq 19", "e^"): sizes,
    ("OS Eq 16", "twice"): two_lobes,
    ("OS Eq 18", "e^"): particle_height,
    ("OS Eq 21", "244"): pickering,
    ("OS Fig 1", "20 x"): king_factor,
    ("OS Table 1, Earth", "β_ext"): earth_extinction,
    ("OS Table 1, Earth", "m(440)"): earth_index,
    ("OS Table 1, Mars", "β_R"): mars_rayleigh,
    ("OS Table 1, Mars", "2.8e29"): mars_pressure,
    ("OS Table 1, Mars", "n_CO₂"): mars_index,
    ("OS Table 1, Mars", "n = 1.52"): dust_index,
    ("OS Table 1, Mars", "g₁ (.03"): dust_lobes,
    ("OS Table 1, Mars", "H_R"): mars_scale_height,
    ("OS Table 1, Mars", "T in"): dust_albedo,
}


@pytest.mark.parametrize(("source", "printed"), ROWS)
def test_the_page_prints_what_both_forms_give(source, printed):
    # four significant digits, more where the two sides would look the same
    for page, computed in zip(page_numbers(source, printed), ROWS[source, printed](), strict=True):
        assert_allclose(page, np.asarray(computed, float), rtol=5.1e-4, atol=1e-12)


def test_every_row_with_an_arrow_is_computed_again():
    rows = [row for row in page_rows() if re.search(r": .* → ", row[3])]
    assert len(rows) == len(ROWS)
    assert all(len(row) == 4 and all(row) for row in page_rows())


def test_only_the_number_density_with_its_digits_in_order_gives_the_printed_coefficients():
    # the first notes print 6.55, 17.3 and 23.0: half the last digit of each
    printed, here = rayleigh_earth_notes()
    assert_allclose(here, [6.55, 17.3, 23.0], rtol=0, atol=0.05)
    # 8π³(n²-1)²/(3Nλ⁴): the ratio is that of the densities
    assert_allclose(printed / here, 2.545 / 2.454, rtol=1e-12)


def test_bruneton_s_root_is_the_golden_length():
    # the golden columns: 195.559 km from the ground at 60°
    assert_allclose(bruneton_root()[1], 195.559, rtol=0, atol=5e-4)


def test_two_lobes_as_printed_integrate_to_as_much_as_6_8():
    # HG integrates to 1: what is left are the numerators, (1+g₁²)/(1-g²)
    printed, here = two_lobes()
    assert_allclose(here, 1.0, rtol=1e-10)
    expected = [
        (1 + g1**2) * (a / (1 - g1**2) + (1 - a) / (1 - g2**2))
        for g1, g2, a in (LOBES, *PRINTED_LOBES)
    ]
    assert_allclose(printed, expected, rtol=1e-9)


def test_air_mass_of_pickering_is_the_published_one():
    # Pickering 2002 at 0°, 1°, 5°, 10°: 38.75, 26.64, 10.33, 5.581
    assert_allclose(pickering()[1], [38.75, 26.64, 10.33, 5.581], rtol=0, atol=5e-3)


def test_mars_s_rayleigh_is_9213_times_too_large():
    # 0.1397, 0.3317, 0.8304 e-6 /m: half the last digit
    printed, here = mars_rayleigh()
    assert_allclose(here, [0.1397, 0.3317, 0.8304], rtol=0, atol=5e-5)
    # it is n of 0 °C and 1 atm with N of Mars: (2.687e25/2.8e23)², to the digits of 2.8
    assert_allclose(printed[0] / here[0], (2.6868e25 / 2.8e23) ** 2, rtol=2e-3)
    assert f"{printed[1] / here[1]:.0f}" == "9213"


def test_dust_of_mars_by_anomalous_diffraction():
    # the golden check: Q_ext 1.949, 1.977, 2.098, albedo .980, .874, .748
    assert_allclose(dust_index()[1], [1.949, 1.977, 2.098, 0.980, 0.874, 0.748], rtol=0, atol=5e-4)


def test_indices_of_table_1():
    # 1.00045588: half the last digit; 1.00028091 is Edlén's, 9e-9 from Peck and Reeder's
    assert_allclose(earth_index()[1][0], 1.00028091, rtol=0, atol=1e-8)
    assert_allclose(mars_index()[1][0], 1.00045588, rtol=0, atol=5e-9)
    # the printed index of 440 nm is that of 400 nm
    assert_allclose(1.0 + air_refractivity_peck1972(400.0), 1.00028276, rtol=0, atol=1.5e-8)
