"""Columns of layers of airglow, and rayleighs."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.physics.optics.airglow import airglow_emissions, layer_columns, line_radiance

RADIUS = 6.371e6


@pytest.mark.parametrize("zenith", [0.0, 60.0, 85.0, 90.0])
def test_a_thin_layer_obeys_van_rhijn_s_law(zenith: float) -> None:
    # The law is exact for a layer without thickness; this one has 10 m.
    sine, cosine = np.sin(np.radians(zenith)), np.cos(np.radians(zenith))
    height = 95e3
    near, far = layer_columns(
        RADIUS + height - 5.0, RADIUS + height + 5.0, RADIUS * sine, RADIUS * cosine
    )
    assert near == 0.0
    assert_allclose(far, 1.0 / np.sqrt(1.0 - (RADIUS * sine / (RADIUS + height)) ** 2), rtol=1e-8)


@pytest.mark.parametrize("tangent", [60e3, 88e3, 91e3, 95e3, 101e3])
def test_a_column_is_the_integral_over_the_profile(tangent: float) -> None:
    # A sum over the line, past the layer, in it and from outside: second method, by its step.
    low, high, impact = RADIUS + 88e3, RADIUS + 102e3, RADIUS + tangent
    s = np.linspace(-2e6, 2e6, 400_001)
    r = np.sqrt(impact**2 + s**2)
    shape = np.maximum((high**2 - r**2) * (r**2 - low**2), 0.0)
    up = np.linspace(low, high, 20_001)
    vertical = np.trapezoid((high**2 - up**2) * (up**2 - low**2), up)
    near, far = layer_columns(low, high, impact, -2e6)
    assert_allclose([near, far], [0.5 * np.trapezoid(shape, s) / vertical] * 2, rtol=1e-5)


def test_an_observer_in_a_layer_sees_what_lies_ahead() -> None:
    # Symmetry: forwards and backwards together are the whole line.
    low, high, impact = RADIUS + 88e3, RADIUS + 102e3, RADIUS + 80e3
    start = np.sqrt((RADIUS + 95e3) ** 2 - impact**2)
    whole = sum(layer_columns(low, high, impact, -3e6))
    both = sum(layer_columns(low, high, impact, start)) + sum(
        layer_columns(low, high, impact, -start)
    )
    assert_allclose(both, whole, rtol=1e-12)


def test_a_rayleigh_has_its_radiance() -> None:
    # Baker & Romick (1976), Appl. Opt. 15, 1966: 1.58e-11 / λ W cm⁻² sr⁻¹ for λ in nm.
    assert_allclose(line_radiance(1.0, 557.7), 1e4 * 1.58e-11 / 557.7, rtol=3e-3)


def test_unknown_airglow_is_refused() -> None:
    with pytest.raises(ParameterError, match=r"^airglow is 'mars'; allowed: none, earth$"):
        airglow_emissions("mars")
