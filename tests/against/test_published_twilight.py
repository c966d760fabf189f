"""Earth in the standard atmosphere beside published light about sunset; nothing is fitted.

The tables of docs/planets.md come from ``python benchmarks/twilight.py``.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import solve
from airlight.errors import ParameterError
from airlight.solvers.solution import Solution
from airlight.validation.published.twilight import (
    average_aerosol,
    ground_illuminance,
    illuminance,
    illuminance_seidelmann1992,
    paranal_zenith_v,
    standard_earth,
    v_magnitude,
    zenith_v_patat2006,
)

NM = tuple(float(nm) for nm in range(400, 721, 40))


def test_the_sun_outside_the_air_has_its_illuminance_and_magnitude() -> None:
    # 133.1 klx from this spectrum (physics text, section 9); a sky as bright as the sun spread over
    # a steradian is 26.57 mag fainter per square arcsecond, 2.5 log10 of 4.2545e10 less.
    assert_allclose(illuminance(NM, np.ones(len(NM))), 133.1e3, rtol=1e-3)
    assert_allclose(v_magnitude(NM, np.ones(len(NM))), -26.76 + 26.572, rtol=0, atol=1e-3)


@pytest.mark.parametrize("altitude", [-12.0, -5.0, -0.8, 5.0, 20.0])
def test_the_supplement_s_cubics_meet(altitude: float) -> None:
    # They are fits of one curve, said to be good to 0.02 in the logarithm.
    low, high = (illuminance_seidelmann1992(altitude + step) for step in (-1e-6, 1e-6))
    assert_allclose(np.log10(low), np.log10(high), rtol=0, atol=0.04)


@pytest.mark.parametrize("function", [illuminance_seidelmann1992, zenith_v_patat2006])
def test_altitudes_beyond_the_measurements_are_refused(function) -> None:
    with pytest.raises(ParameterError, match="altitude is -40"):
        function(-40.0)


@pytest.fixture(scope="module")
def average_day() -> Solution:
    return solve(standard_earth(average_aerosol()), NM, "default")


@pytest.fixture(scope="module")
def earth() -> Solution:
    return solve(standard_earth(), NM, "default")


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
    # 2635 m up, with the night's own light; Patat's nights scatter by 0.2 mag.
    found = paranal_zenith_v(earth, altitude)
    assert_allclose(found, zenith_v_patat2006(altitude), rtol=0, atol=0.35)
