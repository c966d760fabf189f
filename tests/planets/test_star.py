"""Stars of another temperature."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.planets.star import Star


@pytest.mark.parametrize("kelvin", [1500.0, 3000.0, 10000.0])
def test_a_star_of_another_temperature_gives_as_much_energy(kelvin: float) -> None:
    # the nominal solar constant, 1361 W/m² (IAU 2015 resolution B3), of which a ten-thousandth is
    # beyond the integral's ends
    star = Star(spectrum="astm-g173", distance=2.0 * 149_597_870_700.0).of_temperature(kelvin)
    nm = np.geomspace(50.0, 1e6, 20_001)
    total = np.trapezoid(star.irradiances(nm), nm)
    assert_allclose(total, 1361.0 / 4.0, rtol=1e-3)
    # and as the sun's again it is as large as the sun, of 695 700 km
    again = star.of_temperature(5772.0).angular_radius_degrees
    assert_allclose(again, np.degrees(np.arcsin(695_700.0 / (2.0 * 149_597_870.7))), rtol=1e-12)


def test_what_cannot_have_a_temperature_is_refused() -> None:
    with pytest.raises(ParameterError, match=r"^star.temperature is 300.0; allowed: 557 to 1e6 K"):
        Star(spectrum="astm-g173").of_temperature(300.0)
    with pytest.raises(ParameterError, match=r"star.temperature cannot be combined with"):
        Star(irradiance=1.0, angular_radius=0.3).of_temperature(3000.0)
