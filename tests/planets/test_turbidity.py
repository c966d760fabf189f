import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.errors import ParameterError
from airlight.planets.matter.turbidity import LiteralTurbidity, Turbidity


def test_turbidity_is_an_optical_depth_over_the_gas():
    # Its definition: τ(550) = (T - 1) τ_R, spread over the column.
    haze = Turbidity(turbidity=3.0, rayleigh_optical_depth=0.1, junge=4.0)
    assert_allclose(haze.scattering_coefficients([550.0], 1200.0), 2 * 0.1 / 1200.0, rtol=1e-14)
    assert_array_equal(haze.absorption_coefficients([550.0], 1200.0), [0.0])


@pytest.mark.parametrize("v", [2.0, 3.0, 4.0, 6.0])
def test_scattering_follows_the_power_of_junge(v):
    # λ^-(v-2); Ångström's exponent is v - 2.
    nm = np.array([440.0, 550.0, 680.0])
    by_junge = Turbidity(optical_depth=0.1, junge=v).scattering_coefficients(nm, 1e3)
    by_angstrom = Turbidity(optical_depth=0.1, angstrom=v - 2).scattering_coefficients(nm, 1e3)
    assert_allclose(by_junge, 1e-4 * (nm / 550) ** (2 - v), rtol=1e-13)
    assert_allclose(by_angstrom, by_junge, rtol=1e-13)


def test_single_scattering_albedo_splits_the_depth():
    # The definition of the albedo.
    haze = Turbidity(optical_depth=0.2, angstrom=1.3, single_scattering_albedo=0.9)
    nm = [440.0, 680.0]
    scattering, absorption = (
        haze.scattering_coefficients(nm, 1e3),
        haze.absorption_coefficients(nm, 1e3),
    )
    assert_allclose(scattering / (scattering + absorption), 0.9, rtol=1e-13)


def test_literal_turbidity_is_eq_17_as_printed():
    # The specification: 1.064e-4 /m at T = 2 and 550 nm; half the last printed digit.
    haze = LiteralTurbidity(turbidity=2.0)
    assert_allclose(haze.scattering_coefficients([550.0], 1.0), 1.064e-4, rtol=0, atol=5e-8)
    # C(T) is proportional to T - 1, and there is no haze at T = 1.
    twice = LiteralTurbidity(turbidity=3.0).scattering_coefficients([550.0], 1.0)
    assert_allclose(twice, 2 * haze.scattering_coefficients([550.0], 1.0), rtol=1e-13)
    assert_array_equal(LiteralTurbidity(turbidity=1.0).scattering_coefficients([550.0], 1.0), [0])
    # λ^-2 K between red and blue.
    red, blue = haze.scattering_coefficients([680.0, 440.0], 1.0)
    assert_allclose(red / blue, (440 / 680) ** 2 * 0.0096 / 0.0089, rtol=1e-13)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: LiteralTurbidity(turbidity=2.0, junge=3.0), r"junge is 3\.0; allowed: 4 to 4"),
        (
            lambda: Turbidity(turbidity=0.5, rayleigh_optical_depth=0.1, junge=4.0),
            "turbidity is 0.5",
        ),
        (
            lambda: Turbidity(turbidity=2.0, junge=4.0),
            "rayleigh_optical_depth is required with turbidity",
        ),
        (
            lambda: Turbidity(optical_depth=0.1, rayleigh_optical_depth=0.1, junge=4.0),
            "rayleigh_optical_depth requires turbidity",
        ),
        (lambda: Turbidity(junge=4.0), "turbidity is missing; allowed: either turbidity"),
        (
            lambda: Turbidity(optical_depth=0.1),
            "junge is missing; allowed: either junge or angstrom",
        ),
        (lambda: Turbidity(optical_depth=0.1, junge=7.0), r"junge is 7\.0; allowed: 2 to 6"),
        (
            lambda: Turbidity(optical_depth=0.1, junge=4.0, single_scattering_albedo=1.1),
            r"single_scattering_albedo is 1\.1; allowed: 0 to 1",
        ),
        (
            lambda: Turbidity(optical_depth=0.1, junge=4.0).phase_function([550.0]),
            "phase_function is required with turbidity",
        ),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(make, message):
    # Field, value, range.
    with pytest.raises(ParameterError, match=f"^{message}"):
        make()
