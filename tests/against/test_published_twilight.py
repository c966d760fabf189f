"""Earth in the standard atmosphere beside published light about sunset; nothing is fitted.

The tables of docs/planets.md come from ``python benchmarks/twilight.py``.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import solve
from airlight.errors import ParameterError
from airlight.physics.spectra.sun import solar_irradiance
from airlight.planets import Medium, load_planet
from airlight.solver.solution import Solution
from airlight.validation.published.twilight import (
    average_aerosol,
    ground_illuminance,
    illuminance,
    illuminance_seidelmann1992,
    paranal_zenith_v,
    v_magnitude,
    zenith_v_patat2006,
)

NM = tuple(float(nm) for nm in range(400, 721, 40))
# Luminance hardly counts the band of water at 720 nm: the weight of the eye is 1e-3 of the largest.
pytestmark = pytest.mark.filterwarnings("ignore:Earth. absorption bands of H2O")


def test_the_sun_outside_the_air_has_its_illuminance_and_magnitude() -> None:
    # 133.1 klx from this spectrum (physics text, section 9); a sky as bright as the sun spread over
    # a steradian is 26.57 mag fainter per square arcsecond, 2.5 log10 of 4.2545e10 less.
    assert_allclose(illuminance(NM, np.ones(len(NM))), 133.1e3, rtol=1e-3)
    assert_allclose(v_magnitude(NM, np.ones(len(NM))), -26.76 + 26.572, rtol=0, atol=1e-3)


@pytest.mark.parametrize("altitude", [-12.0, -5.0, -0.8, 5.0, 20.0])
def test_the_supplement_s_cubics_meet(altitude: float) -> None:
    # They are fits of one curve, said to be good to 0.02 in the logarithm (Urban & Seidelmann 2013,
    # Table 12.8): two that meet differ by twice that at most.
    low, high = (illuminance_seidelmann1992(altitude + step) for step in (-1e-6, 1e-6))
    assert_allclose(np.log10(low), np.log10(high), rtol=0, atol=0.04)


@pytest.mark.parametrize("function", [illuminance_seidelmann1992, zenith_v_patat2006])
def test_altitudes_beyond_the_measurements_are_refused(function) -> None:
    with pytest.raises(ParameterError, match="altitude is -40"):
        function(-40.0)


def test_the_passband_of_v_weighs_energy() -> None:
    # The mean wavelength of Bessell's V, 551.21 nm by the Spanish Virtual Observatory's Filter
    # Profile Service: light of an even spectrum against light that grows in proportion to the
    # wavelength. Counted as photons it would be 2.6 nm more.
    nm = np.arange(400.0, 721.0)
    even = 1.0 / solar_irradiance(nm)
    mean = 10.0 ** (0.4 * (v_magnitude(nm, even) - v_magnitude(nm, nm * even)))
    assert_allclose(mean, 551.21, rtol=0, atol=0.05)


@pytest.mark.slow
def test_the_average_aerosol_is_that_of_opac_s_mixture() -> None:
    # A second method: exact Mie theory of the components of ``earth-hazy`` in the numbers of Hess
    # et al. (1998), Table 3, continental average: 7000, 0.4 and 8300 /cm³ in place of 15700, 0.6
    # and 34300. Half the last printed digit of Table 4.
    nm = [350.0, 500.0, 550.0, 800.0]
    hazy = Medium.from_planet(load_planet("earth-hazy"), nm)
    parts = [hazy.names.index(name) for name in ("water-soluble", "insoluble", "soot")]
    numbers = np.array([[7000.0 / 15700.0], [0.4 / 0.6], [8300.0 / 34300.0]])
    scattering = numbers * hazy.scattering[parts]
    extinction = (numbers * hazy.extinction[parts]).sum(axis=0)
    cosine = (scattering * hazy.phase_moments(1)[parts, :, 1]).sum(axis=0) / scattering.sum(axis=0)

    ours = Medium.from_planet(load_planet("earth", average_aerosol()), nm)
    aerosol = ours.names.index("aerosol")
    assert_allclose(ours.extinction[aerosol, 2], extinction[2], rtol=0, atol=0.5e-6)
    assert_allclose(
        ours.single_scattering_albedo[aerosol, 2], scattering.sum(axis=0)[2] / extinction[2],
        rtol=0, atol=5e-4,
    )  # fmt: skip
    assert_allclose(ours.phase_moments(1)[aerosol, 2, 1], cosine[2], rtol=0, atol=5e-4)
    # 8 km (1 - exp(-2 km/8 km)) of it, and 0.018 above, which all continental types have: the
    # polluted one 0.327 - 0.309, the clean one 0.064 - 0.046.
    column = 8e3 * -np.expm1(-0.25) * extinction[2] + 0.018
    depth = ours.vertical_optical_depth[aerosol]
    assert_allclose(depth[2], column, rtol=0, atol=5e-4)
    # Ångström exponents; between a dozen wavelengths the list is linear.
    for low, high in ((0, 1), (1, 3)):
        step = np.log(nm[high] / nm[low])
        exponents = np.log(depth[low] / depth[high]), np.log(extinction[low] / extinction[high])
        assert_allclose(exponents[0] / step, exponents[1] / step, rtol=0, atol=0.02)


@pytest.fixture(scope="module")
def average_day() -> Solution:
    return solve(load_planet("earth", average_aerosol()), NM, "default")


@pytest.fixture(scope="module")
def earth() -> Solution:
    return solve(load_planet("earth"), NM, "default")


@pytest.mark.slow
@pytest.mark.parametrize("altitude", [5.0, 2.0, 0.0, -1.0, -3.0, -5.0, -6.0, -8.0, -10.0])
def test_illuminance_is_the_supplement_s_within_a_quarter(
    altitude: float, average_day: Solution
) -> None:
    # Measurements of average clear days; ours has the average continental aerosol.
    found = ground_illuminance(average_day, altitude)
    assert_allclose(found, illuminance_seidelmann1992(altitude), rtol=0.25)


@pytest.mark.slow
@pytest.mark.parametrize("altitude", [-5.0, -6.0, -8.0, -10.0, -12.0])
def test_zenith_in_twilight_is_paranal_s(altitude: float, earth: Solution) -> None:
    # 2635 m up, with the night's own light; Patat's measurements scatter by 0.18 mag.
    found = paranal_zenith_v(earth, altitude)
    assert_allclose(found, zenith_v_patat2006(altitude), rtol=0, atol=0.35)
