"""The table of differences: some rows computed again, by other means."""

from __future__ import annotations

import math
import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.cli import main
from airlight.errors import ParameterError
from airlight.validation.errata.errata import errata, markdown
from airlight.validation.errata.erratum import SOURCES, Erratum


@cache
def table():
    return errata()


def row(source, printed):
    """Row of a source whose printed text begins with the argument."""
    (found,) = [one for one in table() if one.source.startswith(source) and printed in one.printed]
    return found


def test_only_the_number_density_with_its_digits_in_order_gives_the_printed_coefficients():
    # the first notes print 6.55, 17.3 and 23.0: half the last digit of each
    densities = row("AP1", "N_R")
    printed = np.array([6.55, 17.3, 23.0])
    assert_allclose(densities.as_here, printed, rtol=0, atol=0.05)
    assert_allclose(densities.as_here[0], 6.55, rtol=0, atol=5e-3)
    # 8π³(n²-1)²/(3Nλ⁴): the ratio is that of the densities
    ratio = np.array(densities.as_printed) / densities.as_here
    assert_allclose(ratio, 2.545 / 2.454, rtol=1e-12)


def test_modified_rayleigh_by_its_mean():
    # cos θ averages to 0 and cos²θ to 1/3 over the sphere
    phase = row("AP1", "7/5")
    assert_allclose(phase.as_printed, [0.8 * 1.9, 0.8 * 1.9, 0.8 * (1.4 + 0.5 / 3)], rtol=1e-12)
    assert_allclose(phase.as_here, [0.8 * 1.9, 0.8 * 0.9, 0.8 * 1.4], rtol=1e-12)


def test_aerosol_of_the_later_notes():
    # 3.996/(3.996 + 4.40) against 3.996/4.44
    aerosol = row("AP2", "β_M^a")
    assert_allclose(aerosol.as_printed[0], 3.996 / 8.396, rtol=1e-12)
    assert_allclose(aerosol.as_here[0], 0.9, rtol=1e-12)


def test_printed_orders_lose_light_over_bright_ground():
    # D comes late and A⁽²⁾ is gone: the sky can only be darker, by less than the ground's share
    orders = row("AP2", "H⁽²⁾")
    loss = 1.0 - orders.as_printed[0] / orders.as_here[0]
    assert 1e-3 < loss < 0.3


def test_bruneton_s_root_is_the_golden_length():
    # the golden columns: 195.559 km from the ground at 60°
    root = row("BT", "sin θ")
    assert_allclose(root.as_here, 195.559, rtol=0, atol=5e-4)
    r, top = 6360.0, 6460.0
    sine = math.sqrt(3.0) / 2.0
    assert_allclose(root.as_printed, -0.5 * r + math.sqrt(top**2 - r**2 * sine), rtol=1e-12)


def test_zenith_angle_at_q_by_the_law_of_sines():
    # r sin z is kept along a straight ray
    angle = row("BT", "μ_d")
    z = math.radians(80.0)
    r, d = 6360.0, 200.0
    at_q = math.hypot(r * math.sin(z), r * math.cos(z) + d)
    expected = math.degrees(math.asin(r * math.sin(z) / at_q))
    assert_allclose(angle.as_here, expected, rtol=1e-12)
    assert_allclose(angle.as_printed, 80.0, rtol=1e-12)


def test_oxygen_s_column_in_closed_form():
    # H(1 - e^{-12.5}) and H(e^{12.5} - 1), H = 8 km
    oxygen = row("OS", "e^{+h/H}")
    assert_allclose(oxygen.as_here, 8.0 * -math.expm1(-12.5), rtol=1e-12)
    assert_allclose(oxygen.as_printed, 8.0 * math.expm1(12.5), rtol=1e-12)


def test_sizes_as_printed_grow_without_end():
    # r^{(1-3b)/b} e^{±r/(ab)}, b = 0.3, a = 1.6 µm
    sizes = row("OS", "e^{+r/(ab)}")
    for radius, printed, here in zip((5.0, 10.0), sizes.as_printed, sizes.as_here, strict=True):
        power = (radius / 1.6) ** ((1.0 - 0.9) / 0.3)
        exponent = (radius - 1.6) / 0.48
        assert_allclose([printed, here], power * np.exp([exponent, -exponent]), rtol=1e-10)
    assert sizes.as_printed[1] > sizes.as_printed[0] > 1.0 > sizes.as_here[0] > sizes.as_here[1]


def test_two_lobes_as_printed_integrate_to_as_much_as_6_8():
    # HG integrates to 1: what is left are the numerators, (1+g₁²)/(1-g²)
    lobes = row("OS Eq 16", "twice")
    assert_allclose(lobes.as_here, 1.0, rtol=1e-10)
    assert_allclose(lobes.as_printed[0], 6.8, rtol=0, atol=0.05)
    sets = [(0.889, 0.094, 0.743), (0.03, 0.094, 0.743), (0.4, 0.89, 0.04), (0.67, 0.099, 0.01)]
    expected = [(1 + g1**2) * (a / (1 - g1**2) + (1 - a) / (1 - g2**2)) for g1, g2, a in sets]
    assert_allclose(lobes.as_printed, expected, rtol=1e-9)


def test_air_mass_of_pickering_is_the_published_one():
    # Pickering 2002 at 0°, 1°, 5°, 10°: 38.75, 26.64, 10.33, 5.581
    mass = row("OS Eq 21", "244")
    assert_allclose(mass.as_here, [38.75, 26.64, 10.33, 5.581], rtol=0, atol=5e-3)
    pvlib = pytest.importorskip("pvlib")
    zenith = 90.0 - np.array([0.0, 1.0, 5.0, 10.0])
    reference = pvlib.atmosphere.get_relative_airmass(zenith, model="pickering2002")
    assert_allclose(mass.as_here, reference, rtol=1e-10)


def test_depolarisation_stops_at_a_rod():
    # (6+3δ)/(6-7δ) at 0.558 and 0.5: 7.5/2.5
    raised = row("OS Fig 1", "20 x")
    assert_allclose(raised.as_here, 3.0, rtol=1e-12)
    assert_allclose(raised.as_printed, (6 + 3 * 0.558) / (6 - 7 * 0.558), rtol=1e-12)


def test_mars_s_rayleigh_is_9213_times_too_large():
    # 0.1397, 0.3317, 0.8304 e-6 /m: half the last digit; 9213 to its last digit
    mars = row("OS", "(1.2871")
    assert_allclose(mars.as_here, [0.1397, 0.3317, 0.8304], rtol=0, atol=5e-5)
    assert "9213 times" in mars.remark
    # it is n of 0 °C and 1 atm with N of Mars: (2.687e25/2.8e23)², to the digits of 2.8
    ratio = mars.as_printed[0] / mars.as_here[0]
    assert_allclose(ratio, (2.6868e25 / 2.8e23) ** 2, rtol=2e-3)


def test_densities_of_mars_by_the_ideal_gas():
    # p = N k T
    density = row("OS", "2.8e29")
    assert_allclose(density.as_here, 2.8e23 * 1.380649e-23 * 215.0, rtol=1e-12)
    assert_allclose(density.as_printed[0] / density.as_here[0], 1e12, rtol=1e-12)
    # R T/(M g) of 215 K, 43.34 g/mol, 3.73 m/s²: about 11 km
    assert_allclose(row("OS", "H_R = 8").as_here, 11.06, rtol=0, atol=5e-3)


def test_indices_of_table_1():
    # 1.00045588: half the last digit; 1.00028091 is Edlén's, 9e-9 from Peck and Reeder's
    assert_allclose(row("OS", "m(440)").as_here[0], 1.00028091, rtol=0, atol=1e-8)
    assert_allclose(row("OS", "n_CO₂(440)").as_here[0], 1.00045588, rtol=0, atol=5e-9)


def test_dust_of_mars_by_anomalous_diffraction():
    # the golden check: Q_ext 1.949, 1.977, 2.098, albedo .980, .874, .748
    dust = row("OS", "n = 1.52")
    assert dust.as_printed == ()
    assert_allclose(dust.as_here, [1.949, 1.977, 2.098, 0.980, 0.874, 0.748], rtol=0, atol=5e-4)
    albedo = row("OS", "T in")
    assert_allclose(albedo.as_here, [0.980, 0.874, 0.748], rtol=0, atol=5e-4)
    # 0.434 · 0.65e-16 · π (2π/550 nm)² · 0.16 over 53.61771e-6/0.98979 per metre: about 35
    eq17 = 0.434 * 0.65e-16 * math.pi * (2.0 * math.pi / 550e-9) ** 2 * 0.16
    assert_allclose(albedo.as_printed[1], eq17 / (53.61771e-6 / 0.98979), rtol=1e-12)
    assert_allclose(albedo.as_printed[1], 35.0, rtol=0.05)


def test_mean_cosine_of_two_lobes_is_the_weighted_mean():
    lobes = row("OS Table 1, Mars", "g₁ (.03")
    assert_allclose(lobes.as_here, 0.743 * 0.889 + 0.257 * 0.094, rtol=1e-9)
    assert_allclose(lobes.as_printed[1], 0.04 * 0.4 + 0.96 * 0.89, rtol=1e-9)


def test_every_row_says_where_what_and_what_for():
    for one in table():
        assert one.source.split()[0] in SOURCES
        assert one.printed
        assert one.here
        assert one.effect
        assert "\n" not in one.effect
        assert all(map(math.isfinite, (*one.as_printed, *one.as_here)))
    assert len({(one.source, one.printed) for one in table()}) == len(table())


def test_one_source_is_its_part_of_the_table():
    assert errata("BT") == tuple(one for one in table() if one.source == "BT")
    with pytest.raises(ParameterError, match="source is 'XX'; allowed: AP1, AP2, BT, OS"):
        errata("XX")


def test_numbers_are_shown_in_as_many_digits_as_tell_them_apart():
    close = Erratum(
        source="OS", printed="a", here="b", quantity="n", as_printed=(1.00028276, 2.0),
        as_here=(1.00028091, 2.0),
    )  # fmt: skip
    assert close.effect == "n: 1.000283, 2 → 1.000281, 2"


def test_the_page_is_a_table_that_markdown_can_read():
    page = markdown(table())
    rows = [line for line in page.splitlines() if line.startswith("|")]
    assert len(rows) == len(table()) + 2
    # a threshold within a cell is escaped: each line has four cells
    assert all(len(re.findall(r"(?<!\\)\|", line)) == 5 for line in rows)


def test_the_docs_have_the_page_of_today():
    # written by `airlight errata -o docs/errata.md`
    kept = Path(__file__).parents[2] / "docs" / "errata.md"
    assert kept.read_text(encoding="utf-8") == markdown(table())


def test_the_command_prints_and_writes(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert main(["errata", "--source", "BT"]) == 0
    out = capsys.readouterr().out
    assert "195.6 km" in out
    assert "OS" not in out
    assert main(["errata", "--source", "BT", "-o", str(tmp_path / "bt.md")]) == 0
    assert (tmp_path / "bt.md").read_text(encoding="utf-8") == markdown(errata("BT"))
    for words, part in (
        (["--source", "XX"], "--source is 'XX'"),
        (["-o", str(tmp_path / "a.html")], "ends in .md"),
    ):
        capsys.readouterr()
        assert main(["errata", *words]) == 2
        assert part in capsys.readouterr().err
