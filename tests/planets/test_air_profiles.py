"""Profiles ``layers`` and ``sounding`` of a planet file: what they read, refuse and make of it."""

from __future__ import annotations

import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.physics.optics.density_profile import DensitySegments
from airlight.planets.matter.profiles import Layers, Profile, Sounding
from airlight.planets.reading.reader import read_planet

PLANET = """
name = "Test"
[shell]
bottom_radius = "6371 km"
top_radius = "6471 km"
[ground]
albedo = 0.1
[star]
spectrum = "astm-g173"
angular_radius = "0.2665 deg"
[[constituents]]
name = "air"
gas = {{ composition = {{ N2 = 0.79, O2 = 0.21 }}, temperature = "288.15 K", pressure = "1 atm" }}
profile = {{ {0} }}
"""
WEIGHT = 'molar_mass = "28.9644 g/mol", gravity = "9.80665 m/s^2"'
STANDARD = f'kind = "layers", temperature = "288.15 K", {WEIGHT}'


def profile(text: str) -> Profile:
    return read_planet(PLANET.format(text), "test.toml").constituents[0].profile


def density(one: Profile, *altitudes: float) -> list[float]:
    return DensitySegments.from_rows([one.row(100e3)]).at(altitudes)[0].tolist()


def test_layers_by_altitude_and_by_pressure_are_the_same_air():
    # A second method: base pressures of the U.S. Standard Atmosphere, to seven digits.
    rates = 'lapse_rates = "6.5, 0, -1 K/km"'
    high = profile(f'{STANDARD}, {rates}, altitudes = "0, 11, 20 km"')
    heavy = profile(f'{STANDARD}, {rates}, pressures = "1013.25, 226.3206, 54.74889 hPa"')
    assert isinstance(heavy, Layers)
    assert_allclose(heavy.air.altitudes, [0.0, 11e3, 20e3], rtol=2e-5)
    assert_allclose(density(heavy, 5e3, 30e3), density(high, 5e3, 30e3), rtol=1e-4)
    # Table I at 5 km of geopotential altitude: 0.73612 kg/m^3 of 1.2250
    assert_allclose(density(high, 5e3), [0.73612 / 1.225], rtol=1e-4)


def test_measured_rows_are_met_and_their_weight_stands_in_for_a_column():
    # U.S. Standard Atmosphere at 0, 5, 11 km: kg/m^3; and the same rows without their altitudes or
    # their pressures, which then follow from the gas's weight. Gravity falls by 0.3 % to 11 km.
    warmth = 'kind = "sounding", temperatures = "288.15, 255.676, 216.774 K"'
    heights, weights = 'altitudes = "0, 5, 11 km"', 'pressures = "1013.25, 540.48, 226.99 hPa"'
    radius = f'{WEIGHT}, gravity_radius = "6356.766 km"'
    expected = [1.0, 0.73643 / 1.225, 0.36480 / 1.225]
    whole = profile(f"{warmth}, {heights}, {weights}")
    assert_allclose(density(whole, 0.0, 5e3, 11e3), expected, rtol=4e-5)
    assert_allclose(
        density(profile(f"{warmth}, {heights}, {radius}"), 0.0, 5e3, 11e3), expected, rtol=2e-4
    )
    lifted = profile(f"{warmth}, {weights}, {radius}")
    assert isinstance(lifted, Sounding)
    assert lifted.air is not None
    assert_allclose([lifted.air.geometric(h) for h in lifted.air.altitudes], [0, 5e3, 11e3],
                    rtol=1e-4, atol=0.1)  # fmt: skip
    assert_allclose(density(lifted, 0.0, 5e3, 11e3), expected, rtol=2e-4)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (f'{STANDARD}, lapse_rates = "0 K/km"', "altitudes is missing; allowed: altitudes or"),
        (
            f'{STANDARD}, lapse_rates = "0 K/km", altitudes = "1 km"',
            r"altitudes\[0\] is 1000.0; allowed: 0 m",
        ),
        (
            f'{STANDARD}, lapse_rates = "0 K/km", altitudes = "0, 2 km"',
            "one for each of 2 bases",
        ),
        (
            f'{STANDARD}, lapse_rates = "0, 0 K/km", altitudes = "0, 0 km"',
            r"altitudes\[1\] is 0.0",
        ),
        (
            f'{STANDARD}, lapse_rates = "0, 0 K/km", pressures = "10, 20 Pa"',
            r"pressures\[1\] is 20.0; allowed: less than 10 Pa",
        ),
        (
            f'{STANDARD}, lapse_rates = "30, 0 K/km", altitudes = "0, 11 km"',
            r"lapse_rates\[0\] is 0.03; allowed: a temperature of at least 1 K",
        ),
        (
            f'{STANDARD}, lapse_rates = "2 K/m", altitudes = "0 km"',
            r"lapse_rates\[0\] is 2.0; allowed: -1 to 1 K/m",
        ),
        ('kind = "sounding", temperatures = "280, 270 K"', "altitudes is missing"),
        (
            'kind = "sounding", temperatures = "280, 270 K", altitudes = "0, 1 km"',
            "molar_mass is required unless both altitudes and pressures are given",
        ),
        (
            'kind = "sounding", temperatures = "280 K", altitudes = "0 km"',
            "temperatures is .* 2 to 1000 rows",
        ),
        (
            'kind = "sounding", temperatures = "280, 270 K", pressures = "1, 2 Pa"',
            r"pressures\[1\] is 2.0; allowed: less than 1 Pa",
        ),
        (
            'kind = "sounding", temperatures = "280, 270 K", altitudes = "0, 1, 2 km"',
            "one for each of 2 temperatures",
        ),
    ],
)
def test_impossible_air_is_refused_with_its_key(text, message):
    with pytest.raises(ParameterError, match=rf"constituents\[0\]\.profile.*{message}"):
        profile(text)
