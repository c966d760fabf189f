"""Correlated colour temperature: black bodies have their own, daylights have the CIE's."""

from __future__ import annotations

from math import inf

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.image.color_temperature import correlated_color_temperature
from airlight.physics.spectra.blackbody import planck_radiance
from airlight.physics.spectra.color_matching import cie_1931


def tristimulus(x: float, y: float) -> list[float]:
    return [x / y, 1.0, (1.0 - x - y) / y]


@pytest.mark.parametrize("temperature", [1500.0, 2856.0, 5772.0, 6500.0, 25e3, 200e3])
def test_a_black_body_has_its_own_temperature(temperature: float) -> None:
    # The definition; the search ends within 1e-7 per MK of its reciprocal.
    seen = cie_1931()
    xyz = planck_radiance(seen.wavelengths, temperature) @ seen.values
    assert_allclose(correlated_color_temperature(3.0 * xyz), temperature, rtol=1e-4)


@pytest.mark.parametrize(
    ("x", "y", "temperature"),
    [
        # CIE 15:2018, Table T.3: D50, D55, D65, D75 to the temperatures of their names times
        # 1.4388/1.4380, and illuminant A, 2856 K; x and y to four or five digits
        (0.34567, 0.35851, 5003.0),
        (0.33243, 0.34744, 5503.0),
        (0.31272, 0.32903, 6504.0),
        (0.29903, 0.31488, 7504.0),
        (0.44758, 0.40745, 2856.0),
    ],
)
def test_daylights_have_their_temperatures(x: float, y: float, temperature: float) -> None:
    # The phases of daylight are drawn a little off the temperatures of their names: 0.1 %.
    assert_allclose(correlated_color_temperature(tristimulus(x, y)), temperature, rtol=1e-3)


def test_light_bluer_than_all_black_bodies_is_infinitely_hot() -> None:
    # The limit of a black body's colour is x 0.2399, y 0.2342 (Planck's law in λ^-4).
    assert correlated_color_temperature(tristimulus(0.235, 0.225)) == inf


def test_a_color_far_from_all_black_bodies_is_refused() -> None:
    # sRGB's green: no black body is near.
    with pytest.raises(ParameterError, match=r"within 0\.05"):
        correlated_color_temperature(tristimulus(0.30, 0.60))
    assert np.isfinite(correlated_color_temperature(tristimulus(0.36, 0.36)))
