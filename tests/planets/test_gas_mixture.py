"""Gases by composition: derived quantities and refused input."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.physics.constants import AVOGADRO, LOSCHMIDT
from airlight.physics.optics import rayleigh
from airlight.physics.optics.molecules import MOLECULES
from airlight.planets import Constituent, replace
from airlight.planets.matter.gas_mixture import GasMixture
from airlight.planets.matter.gases import GasScattering, RefractiveScattering
from airlight.planets.matter.phases import HenyeyGreenstein
from airlight.planets.matter.profiles import Exponential, Uniform
from airlight.planets.spectral import PerWavelength

NM = np.array([680.0, 550.0, 440.0])
DRY_AIR = {"N2": 0.78084, "O2": 0.20946, "Ar": 0.00934, "CO2": 0.0004}
AIR = GasMixture(composition=DRY_AIR, temperature=288.15, pressure=101_325.0, gravity=9.80665)


def beta(gas, nm=NM):
    return gas.scattering_coefficients(nm, 1.0)


def test_dry_air_is_the_reference_earth():
    # the golden table is Peck-Reeder air with Bates's King factor; Bodhaine et al. (1999) put
    # the sources of refractivity and King factor within 0.3 % of each other
    assert_allclose(1e6 * beta(AIR), [4.848, 11.487, 28.710], rtol=3e-3)


def test_dry_air_has_the_bulk_of_the_standard_atmosphere():
    # U.S. Standard Atmosphere (1976): 28.9644 g/mol at 314 ppm CO2, 8434.5 m, 2.5470e25 per m³
    assert_allclose(1e3 * AIR.molar_mass, 28.9644, rtol=0, atol=5e-3)
    assert_allclose(AIR.scale_height, 8434.5, rtol=1e-4)
    assert_allclose(AIR.number_density, 2.5470e25, rtol=5e-5)
    # Peck & Reeder at 644.02492 nm, Table III: 27638.092e-8
    assert_allclose(AIR.refractivities([644.02492]), 2.7638092e-4, rtol=1e-3)


def test_dry_air_meets_two_published_fits_of_its_cross_section():
    # Nicolet (1984) to Bates (1984): 4.02e-28/λ^(4+x) cm², within 0.5 % from 0.2 to 1 µm;
    # Bucholtz (1995): 3.01577e-28 λ^-(3.55212 + 1.35579λ + 0.11563/λ) up to 0.5 µm, 4.01061e-28
    # λ^-(3.99668 + 0.00110298λ + 0.0271393/λ) beyond. 0.3 % each for the sources of the
    # refractivities (Bodhaine et al. 1999).
    nm = np.array([360.0, 440.0, 500.0, 550.0, 680.0, 830.0])
    um = 1e-3 * nm
    found = AIR.cross_sections(nm)
    x = np.where(um < 0.55, 0.389 * um + 0.09426 / um - 0.3228, 0.04)
    assert_allclose(found, 4.02e-32 / um ** (4.0 + x), rtol=8e-3)
    short = 3.01577e-32 * um ** -(3.55212 + 1.35579 * um + 0.11563 / um)
    long = 4.01061e-32 * um ** -(3.99668 + 0.00110298 * um + 0.0271393 / um)
    assert_allclose(found, np.where(um <= 0.5, short, long), rtol=4e-3)


@pytest.mark.parametrize(
    ("state", "golden", "digits"),
    [
        ({"reference_density": 2.8e23}, [0.1397, 0.3317, 0.8304], 0.0),
        ({"pressure": 610.0, "temperature": 215.0}, [0.1023, 0.2429, 0.6081], 0.0025),
    ],
)
def test_carbon_dioxide_is_the_golden_mars(state, golden, digits):
    # OS Table 1 put right, δ = 0.09: half the last digit, and of N = 2.05e23 where it is rounded
    mars = GasMixture(composition={"CO2": 1.0}, depolarisation=0.09, **state)
    tolerance = 5e-5 + digits * np.array(golden)
    assert np.all(np.abs(1e6 * beta(mars) - golden) <= tolerance)
    # Alms's King factor instead is 1.6 to 2.2 % lower
    own = beta(replace(mars, depolarisation=None)) / beta(mars) - 1.0
    assert np.all((own > -0.023) & (own < -0.015))


def test_mars_has_its_scale_height():
    # RT/(Mg), 215 K and 3.72 m/s²: about 11 km
    mars = GasMixture(
        composition={"CO2": 0.957, "N2": 0.027, "Ar": 0.016},
        temperature=215.0,
        pressure=610.0,
        gravity=3.72,
    )
    assert_allclose(mars.scale_height, 11e3, rtol=0.02)


def test_openspace_standard_set_follows_from_its_refractivity_and_state():
    # Edlén (1953) at 15 °C, to 0 °C; δ = 0.035. The golden row has the limit n → 1 of the
    # cross-section, which the comparison divides out.
    s2 = (1e3 / NM) ** 2
    edlen = 1e-8 * (6432.8 + 2_949_810.0 / (146.0 - s2) + 25_540.0 / (41.0 - s2))
    given = PerWavelength(wavelengths=tuple(NM), values=tuple(edlen * 2.68731 / 2.54743))
    gas = replace(
        AIR,
        temperature=None,
        pressure=None,
        reference_density=2.68731e25,
        refractivity=given,
        depolarisation=0.035,
    )
    limit = ((given.at(NM) + 1.0) ** 2 + 2.0) ** 2 / 9.0
    assert_allclose(1e6 * beta(gas) * limit, [5.1771, 12.2590, 30.5967], rtol=0, atol=5e-5)


def test_first_atmosphere_plus_set_follows_from_its_refractivity_and_density():
    # n = 1.0003, N = 2.545e25, isotropic molecules: half the last digits of 6.55, 17.3, 23.0
    gas = GasMixture(
        composition=DRY_AIR, reference_density=2.545e25, refractivity=3e-4, depolarisation=0.0
    )
    found = 1e6 * beta(gas, [650.0, 510.0, 475.0])
    assert np.all(np.abs(found - [6.55, 17.3, 23.0]) <= [5e-3, 5e-2, 5e-2])


def test_one_gas_alone_is_that_gas():
    # the mean of one value is that value
    mixture = GasMixture(composition={"CO2": 1.0}, temperature=215.0, pressure=610.0)
    single = GasScattering(gas="co2", temperature=215.0, pressure=610.0)
    assert_allclose(beta(mixture), single.coefficients(NM), rtol=1e-14)
    assert_allclose(mixture.refractivities(NM), single.refractivities(NM), rtol=1e-14)
    assert_allclose(mixture.depolarisations(NM), single.depolarisations(NM), rtol=1e-12)


def test_the_column_of_scattering_hardly_depends_on_the_temperature():
    # β·H = σ p N_A/(M g): pressure and gravity fix the column, whatever the temperature
    depths = []
    for temperature in (180.0, 240.0, 300.0):
        gas = replace(AIR, temperature=temperature)
        depths.append(beta(gas) * gas.scale_height)
    expected = AIR.cross_sections(NM) * AIR.pressure * AVOGADRO / (AIR.molar_mass * AIR.gravity)
    assert_allclose(depths, np.broadcast_to(expected, (3, 3)), rtol=1e-12)


@pytest.mark.parametrize(
    "composition", [DRY_AIR, {"H2": 0.5, "CO2": 0.5}, {"N2O": 0.3, "Ar": 0.6, "CH4": 0.1}]
)
def test_a_mixture_scatters_what_its_gases_scatter_into_every_direction(composition):
    # light scattered by different molecules adds up: Σ x σ P, gas by gas
    gas = GasMixture(composition=composition, temperature=288.15, pressure=101_325.0)
    nu = np.linspace(-1.0, 1.0, 21)
    total = 0.0
    for name, fraction in gas.composition:
        alone = replace(gas, composition={name: 1.0})
        sigma = fraction * MOLECULES[name].cross_sections(NM)
        total = total + sigma * alone.phase_function(NM).values(nu, NM)
    found = gas.cross_sections(NM) * gas.phase_function(NM).values(nu, NM)
    assert_allclose(found, total, rtol=1e-12)


def test_the_cross_section_of_the_mean_refractivity_is_too_small():
    # Eberhard (2010): the mean of squares exceeds the square of the mean, so that the common
    # approximation underestimates; hydrogen with a refractivity four times helium's by a quarter
    half = GasMixture(composition={"H2": 0.5, "He": 0.5}, temperature=273.15, pressure=101_325.0)
    short_cut = rayleigh.cross_section(
        NM, half.refractivities(NM), half.number_density, half.king_factors(NM)
    )
    n = [MOLECULES[name].refractivities(NM) for name in ("H2", "He")]
    expected = (0.5 * (n[0] + n[1])) ** 2 / (0.5 * (n[0] ** 2 + n[1] ** 2))
    assert_allclose(short_cut / half.cross_sections(NM), expected, rtol=1e-4)


def test_refractivity_follows_the_density_as_lorentz_and_lorenz_say():
    # (n²-1)/(n²+2) ∝ N, here at 34 times the Loschmidt constant (the ground of Venus)
    gas = GasMixture(composition={"CO2": 1.0}, reference_density=34.0 * LOSCHMIDT)
    thin = MOLECULES["CO2"].refractivities(NM) + 1.0
    dense = gas.refractivities(NM) + 1.0
    ratio = (dense**2 - 1.0) / (dense**2 + 2.0) / ((thin**2 - 1.0) / (thin**2 + 2.0))
    assert_allclose(ratio, 34.0, rtol=1e-10)
    # 1.0151 at 550 nm; proportional n - 1 would be 1.01531
    assert_allclose(dense[1], 1.0 + 34.0 * (thin[1] - 1.0), rtol=5e-5)


def test_a_given_refractivity_is_moved_from_its_state_to_the_gas():
    # at its own state it is unchanged, and its cross-section does not depend on the gas's pressure
    given = {"refractivity": 2.93e-4, "refractivity_temperature": 273.15}
    gas = replace(AIR, **given, refractivity_pressure=101_325.0)
    same = replace(gas, temperature=273.15)
    assert_allclose(same.refractivities(NM), 2.93e-4, rtol=1e-12)
    assert_allclose(replace(gas, pressure=10.0).cross_sections(NM), same.cross_sections(NM))
    assert_allclose(gas.refractivities(NM), 2.93e-4 * 273.15 / 288.15, rtol=1e-4)


def test_fractions_within_a_percent_of_1_are_divided_by_their_sum():
    # 0.99 and 1.01 times the same air are the same air; a gas of fraction 0 is dropped
    for factor in (0.992, 1.008):
        other = {name: factor * fraction for name, fraction in DRY_AIR.items()}
        gas = replace(AIR, composition={**other, "SO2": 0.0})
        assert_allclose(beta(gas), beta(AIR), rtol=1e-12)
        assert gas.limits == AIR.limits


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"composition": {"N2": 0.5}}, "composition is 0.5"),
        ({"composition": {"N2": 0.78, "X": 0.22}}, "composition is 'X'"),
        ({"composition": {"N2": 1.2, "O2": -0.2}}, "composition.N2"),
        ({"composition": {"N2": 1.0, "O2": float("nan")}}, "composition.O2"),
        ({"composition": {}}, "composition is 0"),
        ({"composition": 3}, "composition"),
        ({"composition": "N2"}, "composition"),
        ({"temperature": None}, "pressure requires temperature"),
        ({"pressure": None}, "number_density is missing"),
        ({"reference_density": 2.8e25}, "number_density"),
        ({"depolarisation": 0.7}, "depolarisation is 0.7; allowed: 0 to 0.5, that of a linear"),
        ({"depolarisation": -0.1}, "depolarisation"),
        ({"refractivity": 4.5e-6}, "refractivity"),
        ({"refractivity_pressure": 1e5}, "refractivity is required"),
        (
            {"refractivity": 2.9e-4, "refractivity_pressure": 1e5},
            "refractivity_pressure requires refractivity_temperature",
        ),
        ({"gravity": 0.0}, "gravity"),
        ({"gravity": None, "colour": 3}, "field of GasMixture"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(change, field):
    with pytest.raises(ParameterError) as caught:
        replace(AIR, **change)
    assert str(caught.value).startswith(field)
    assert "\n" not in str(caught.value)


def test_the_refractivity_of_another_state_is_refused():
    # the mistake of OS Table 1's Mars: n of carbon dioxide at 0 °C and 1 atm, N of Mars; the
    # coefficients come out 9213 times too large
    mars = {"composition": {"CO2": 1.0}, "temperature": 215.0, "pressure": 610.0}
    with pytest.raises(ParameterError, match=r"allowed: 3\.4\S* within 10 % at this temperature"):
        GasMixture(**mars, refractivity=4.5019e-4)
    right = GasMixture(
        **mars,
        refractivity=4.5019e-4,
        refractivity_temperature=273.15,
        refractivity_pressure=101_325.0,
    )
    assert_allclose(beta(right, [550.0]), beta(GasMixture(**mars), [550.0]), rtol=1e-4)


def test_a_scale_height_needs_temperature_and_gravity():
    with pytest.raises(ParameterError, match="gravity is required"):
        _ = replace(AIR, gravity=None).scale_height
    bare = GasMixture(composition={"N2": 1.0}, reference_density=1e25, gravity=9.8)
    with pytest.raises(ParameterError, match="temperature is required"):
        _ = bare.scale_height
    assert beta(bare).shape == (3,)


def test_mixtures_can_be_pickled_and_varied():
    # frozen values: equal after a round trip
    assert pickle.loads(pickle.dumps(AIR)) == AIR
    assert_allclose(beta(replace(AIR, pressure=2.0 * AIR.pressure)), 2.0 * beta(AIR), rtol=1e-12)


def test_every_kind_of_gas_says_its_refractivity_and_nothing_else_does():
    # the same air three times, at the ground: Peck & Reeder, 2.7782e-4 at 550 nm
    profile = Exponential(scale_height=8e3)
    state = {"temperature": 288.15, "pressure": 101_325.0}
    by_name = GasScattering(gas="air", **state)
    by_number = RefractiveScattering(refractivity=2.9308e-4, temperature=273.15, pressure=101325.0)
    moved = replace(by_number, ground_number_density=AIR.number_density)
    gases = [
        Constituent(name="name", profile=profile, scattering=by_name),
        Constituent(name="number", profile=profile, scattering=moved),
        Constituent(name="composition", profile=profile, matter=AIR),
    ]
    for gas in gases:
        assert_allclose(gas.refractivities([550.0], 1e5), 2.7782e-4, rtol=1e-3)
    dust = Constituent(
        name="dust",
        profile=Uniform(),
        scattering=1e-6,
        phase_function=HenyeyGreenstein(asymmetry=0.7),
    )
    assert_allclose(dust.refractivities(NM, 1e5), 0.0, rtol=0, atol=0)
