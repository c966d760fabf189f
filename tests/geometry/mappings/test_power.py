"""Linear and power mappings: there and back, exact at both ends, the notes' special cases."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from airlight.geometry.mappings import linear, power

POWERS = st.floats(1.0, 6.0)
#: Titan's shell is 600 km thick, a made-up small planet's 1 km. [m]
THICKNESSES = st.floats(1e3, 6e5)


@given(x=st.floats(0.0, 1.0), thickness=THICKNESSES)
def test_linear_altitude_goes_there_and_back(x: float, thickness: float) -> None:
    # Inverses, to a rounding.
    h = x * thickness
    back = linear.altitude_from_coordinate(linear.altitude_coordinate(h, thickness), thickness)
    assert_allclose(back, h, rtol=4e-16, atol=1e-300)


@given(cosine=st.floats(-1.0, 1.0))
def test_linear_cosine_goes_there_and_back(cosine: float) -> None:
    # Inverses; adding 1 keeps 16 digits behind the point.
    back = linear.cosine_from_coordinate(linear.cosine_coordinate(cosine))
    assert_allclose(back, cosine, rtol=0, atol=2.3e-16)


@given(x=st.floats(0.0, 1.0), p=POWERS, thickness=THICKNESSES)
def test_power_altitude_goes_there_and_back(x: float, p: float, thickness: float) -> None:
    # Inverses; the p-th root and power lose some p roundings.
    h = x * thickness
    u = power.altitude_coordinate(h, thickness, p)
    assert 0.0 <= u <= 1.0
    assert_allclose(power.altitude_from_coordinate(u, thickness, p), h, rtol=1e-13, atol=1e-290)


@given(cosine=st.floats(-1.0, 1.0), p=POWERS)
def test_power_cosine_goes_there_and_back(cosine: float, p: float) -> None:
    # Inverses: v near ½ keeps 1e-16 absolute, and so do cosines, whose slope p|v|^(p-1) ≤ 2p.
    v = power.cosine_coordinate(cosine, p)
    assert 0.0 <= v <= 1.0
    assert_allclose(power.cosine_from_coordinate(v, p), cosine, rtol=0, atol=5e-15)


@given(p=POWERS, thickness=THICKNESSES)
def test_ends_and_middle_are_exact(p: float, thickness: float) -> None:
    # By definition 0, ½ and 1 are mapped without rounding, for every power.
    for h, u in ((0.0, 0.0), (thickness, 1.0)):
        assert power.altitude_coordinate(h, thickness, p) == u
        assert power.altitude_from_coordinate(u, thickness, p) == h
        assert linear.altitude_coordinate(h, thickness) == u
        assert linear.altitude_from_coordinate(u, thickness) == h
    for cosine, v in ((-1.0, 0.0), (0.0, 0.5), (1.0, 1.0)):
        assert power.cosine_coordinate(cosine, p) == v
        assert power.cosine_from_coordinate(v, p) == cosine
        assert linear.cosine_coordinate(cosine) == v
        assert linear.cosine_from_coordinate(v) == cosine


@given(x=st.floats(0.0, 1.0), cosine=st.floats(-1.0, 1.0))
def test_the_first_print_is_powers_two_and_three(x: float, cosine: float) -> None:
    # Atmosphere Plus, first print, section 2.4: √(h/H_a) and ½(1 + sign(c) ∛|c|).
    h = x * 1e5
    assert_allclose(power.altitude_coordinate(h, 1e5, 2.0), np.sqrt(h / 1e5), rtol=4e-16)
    expected = 0.5 * (1.0 + np.cbrt(cosine))
    assert_allclose(power.cosine_coordinate(cosine, 3.0), expected, rtol=0, atol=1e-15)


@given(x=st.floats(0.0, 1.0), cosine=st.floats(-1.0, 1.0))
def test_power_one_is_linear(x: float, cosine: float) -> None:
    # The exact limit that the notes name.
    assert power.altitude_coordinate(x * 1e5, 1e5, 1.0) == linear.altitude_coordinate(x * 1e5, 1e5)
    assert power.cosine_coordinate(cosine, 1.0) == linear.cosine_coordinate(cosine)
