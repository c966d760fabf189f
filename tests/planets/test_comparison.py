"""Differences between two planets, and their size."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.planets import Medium, load_planet, planet_names
from airlight.planets.comparison import ALL, common_wavelengths, compare
from airlight.planets.parameter_values import composition_of, parameter_values

GREEN = (550.0,)


def found(rows, part, quantity):
    """The only row of a part and quantity."""
    (row,) = [row for row in rows if (row.part, row.quantity) == (part, quantity)]
    return row


def quantities(rows):
    return {(row.part, row.quantity) for row in rows}


@pytest.mark.parametrize("name", planet_names())
def test_a_planet_does_not_differ_from_itself(name):
    planet = load_planet(name)
    assert compare(planet, planet) == ()


def test_one_changed_key_is_all_that_differs_and_by_what_it_was_changed():
    # the ground alone: no optical depth, no phase function, nothing of the star
    earth = load_planet("earth-atmosphere-plus")
    rows = compare(earth, load_planet("earth-atmosphere-plus", {"ground.albedo": 0.25}), GREEN)
    assert quantities(rows) == {("ground", "albedo")}
    assert (rows[0].first, rows[0].second, rows[0].wavelength) == (0.1, 0.25, 550.0)
    assert_allclose([rows[0].absolute, rows[0].percent], [0.15, 150.0], rtol=1e-12)


def test_the_other_way_round_the_differences_change_sign():
    first, second = load_planet("earth"), load_planet("earth-openspace")
    there, back = compare(first, second, GREEN), compare(second, first, GREEN)
    ways = [
        {(row.part, row.quantity): row.absolute for row in rows if row.absolute is not None}
        for rows in (there, back)
    ]
    assert ways[0].keys() == ways[1].keys()
    for key, difference in ways[0].items():
        assert_allclose(ways[1][key], -difference, rtol=1e-12)


def test_the_misprint_of_atmosphere_plus_changes_the_albedo_from_0_9_to_0_476():
    # 3.996/4.44 and 3.996/8.396, and the resulting values of the whole air
    names = ("earth-atmosphere-plus", "earth-atmosphere-plus-literal")
    rows = compare(*(load_planet(name) for name in names), GREEN)
    albedo = found(rows, "aerosol", "single-scattering albedo")
    assert_allclose([albedo.first, albedo.second], [0.9, 3.996 / 8.396], rtol=1e-12)
    depth = found(rows, "aerosol", "optical depth")
    # 1.2 km within 100 km
    assert_allclose(depth.absolute, (8.396e-6 - 4.44e-6) * 1200.0, rtol=1e-12)
    # nothing else of the aerosol, and of the whole air only its depth and albedo: the scattering
    # is the same in both
    assert quantities(rows) == {
        ("aerosol", "absorption coefficient"),
        ("aerosol", "optical depth"),
        ("aerosol", "single-scattering albedo"),
        (ALL, "optical depth"),
        (ALL, "single-scattering albedo"),
    }


def test_what_one_planet_lacks_has_no_optical_depth_there():
    rows = compare(load_planet("earth"), load_planet("earth-openspace"), GREEN)
    gone = found(rows, "ozone", "constituent")
    assert (gone.first, gone.second, gone.absolute) == ("there", None, None)
    ozone = found(rows, "ozone", "optical depth")
    # 345 DU at 3.314e-25 m², which 225 K makes 0.3 % smaller: 0.0306
    assert_allclose([ozone.first, ozone.second], [0.0306, 0.0], rtol=0, atol=5e-5)
    assert_allclose(ozone.percent, -100.0, rtol=1e-12)


def test_henyey_greenstein_s_lobes_are_its_closed_form():
    # p(±1) = (1±g)/(1∓g)²/4π: 0.85 against 0.7
    path = "aerosol.phase_function.asymmetry"
    rows = compare(load_planet("earth-openspace"), load_planet("earth-openspace", {path: 0.7}))
    for word, sign in (("forward", 1.0), ("backward", -1.0)):
        row = next(
            row for row in rows if (row.part, row.quantity) == ("aerosol", f"phase function {word}")
        )
        g = sign * np.array([0.85, 0.7])
        expected = (1.0 + g) / (1.0 - g) ** 2 / (4.0 * np.pi)
        assert_allclose([row.first, row.second], expected, rtol=1e-9)


def test_the_whole_air_s_mean_cosine_is_weighted_by_what_scatters():
    # air scatters symmetrically: the mean is the aerosol's times its share of the scattering
    planets = [load_planet("earth-openspace"), load_planet("earth-atmosphere-plus")]
    row = found(compare(*planets, GREEN), ALL, "mean cosine")
    for value, planet, g in zip((row.first, row.second), planets, (0.85, 0.8436), strict=True):
        medium = Medium.from_planet(planet, GREEN)
        scattered = medium.scattering[:, 0] * medium.columns
        # Cornette-Shanks at g = 0.8 has 0.8436: its last digit
        assert_allclose(value, g * scattered[1] / scattered.sum(), rtol=0, atol=5e-5)


def test_planets_known_at_different_wavelengths_meet_where_both_are_known():
    first, second = load_planet("earth-atmosphere-plus-2025"), load_planet("earth")
    assert common_wavelengths(first, second) == (650.0, 510.0, 475.0)
    assert common_wavelengths(load_planet("mars"), second) == (680.0, 550.0, 440.0)


def test_planets_known_nowhere_together_are_compared_without_light():
    star = {
        "wavelengths": "2600, 2700 nm", "irradiance": ["1 W/m^2/nm", "1 W/m^2/nm"],
        "angular_radius": "0.25 deg",
    }  # fmt: skip
    changes = {"star": star, "ground.albedo": 0.2}
    infrared = load_planet(
        "earth",
        {
            **changes,
            "refraction": "none",
            "ground.map": None,
            "constituents": [
                {
                    "name": "air",
                    "profile": {"kind": "exponential", "scale_height": "8 km"},
                    "wavelengths": "2600, 2700 nm",
                    "absorption": "1e-6, 2e-6 /m",
                }
            ],
        },
    )
    visible = load_planet("earth")
    assert common_wavelengths(visible, infrared) == ()
    rows = compare(visible, infrared)
    assert {row.wavelength for row in rows} == {None}
    assert found(rows, "air", "column height").absolute < 0.0


def test_parameters_of_nested_parts_are_listed_with_their_units():
    earth = load_planet("earth")
    values = parameter_values(earth.constituents[0], earth.thickness, GREEN)
    assert values["temperature", "K", None] == 288.15
    assert values["pressure", "Pa", None] == 101325.0
    # U.S. Standard Atmosphere (1976), equation 18
    assert_allclose(values["profile gravity radius", "m", None], 6_356_766.0, rtol=1e-9)
    # physics: 11.487e-6 /m at 550 nm; its gases by composition give 0.06 % more
    assert_allclose(values["scattering coefficient", "m⁻¹", 550.0], 11.487e-6, rtol=1e-3)


def test_long_tables_differ_though_they_are_equally_long():
    table = [0.0] * 12
    altitudes = [f"{h} m" for h in range(12)]
    changes = [{**dict.fromkeys(("kind",), "tabulated")} for _ in range(2)]
    for index, change in enumerate(changes):
        densities = [*table]
        densities[3 + index] = 1.0
        change |= {"altitudes": altitudes, "densities": densities}
    sides = [load_planet("earth-openspace", {"aerosol.profile": one}) for one in changes]
    row = found(compare(*sides, GREEN), "aerosol", "profile densities")
    assert row.first.startswith("12 values")
    assert row.first != row.second


def test_a_gas_says_what_follows_from_its_composition():
    # Mars by the paper: RT/(Mg) with 44.0095 g/mol, N as given, F = (6+3δ)/(6-7δ), n - 1 of 0 °C
    # and one atmosphere thinned to N, all by hand
    planet = load_planet("mars-openspace")
    values = composition_of(planet.constituents[0], GREEN)
    height = 8.314462618 * 215.0 / (44.0095e-3 * 3.73)
    assert_allclose(values["scale height", "m"], height, rtol=1e-4)
    assert values["number density", "m⁻³"] == (2.8e23,)
    assert_allclose(values["King factor", ""], (6 + 0.27) / (6 - 0.63), rtol=1e-12)
    # the Lorentz-Lorenz relation changes the proportion by at most 2e-4
    assert_allclose(values["n - 1", ""], 4.5019e-4 * 2.8e23 / 2.68678e25, rtol=3e-4)
    assert values["depolarisation", ""] == (0.09,)
    # a constituent given by coefficients has no matter
    assert composition_of(load_planet("earth-openspace").constituents[1], GREEN) == {}


def test_standard_and_advanced_mode_of_one_earth_side_by_side():
    # coefficients on one side, composition on the other
    rows = compare(load_planet("earth-openspace"), load_planet("earth-openspace-advanced"), GREEN)
    given = found(rows, "air", "given as")
    assert (given.first, given.second) == ("coefficients", "gas-mixture")
    # f(0.0279)/f(0.035) - 1 = -1.2 %
    assert_allclose(found(rows, "air", "scattering coefficient").percent, -1.2, rtol=0, atol=0.05)
    assert found(rows, "air", "molar mass").first is None
