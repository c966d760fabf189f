"""Section 6 of the physics text: relative air masses of straight and of bent light."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.geometry.shell import distance_to_top
from airlight.kernel import vectorized
from airlight.physics.optics.air_mass import air_mass_pickering2002
from airlight.physics.optics.density_profile import DensitySegments, exponential
from airlight.physics.optics.refracting_shell import RefractingShell
from airlight.solver.tables.columns import columns

BOTTOM, THICK = 6377e3, 250e3
DENSITY = DensitySegments.from_rows([exponential(7996.0, THICK), exponential(1200.0, THICK)])

#: Altitude [deg]; gas straight, gas bent, Pickering, haze straight, haze bent. The first number is
#: printed as 35.42: it is R/H·exp(R/H)·K₁(R/H) = 35.411.
TABLE = [
    (0.0, "35.41", "39.47", "38.75", "91.4", "103.8"),
    (1.0, "24.88", "26.47", "26.64", "41.7", "43.7"),
    (5.0, "10.14", "10.28", "10.33", "11.21", "11.26"),
    (10.0, "5.551", "5.574", "5.581", "5.72", "5.73"),
]


def half_digit(printed: str) -> float:
    """Half of the last printed digit."""
    return 0.5 * 10.0 ** -len(printed.partition(".")[2])


def air_masses(bottom: float, top: float, density: DensitySegments, altitude: float) -> np.ndarray:
    mu = np.sin(np.radians(altitude))
    length = vectorized(distance_to_top)(bottom, mu, top)
    column = columns(bottom, mu, length, bottom, density)
    return np.asarray(column / columns(bottom, 1.0, top - bottom, bottom, density))


@pytest.mark.parametrize("row", TABLE)
def test_air_masses_match_the_table_of_section_6(row: tuple[float, ...]) -> None:
    altitude, gas, gas_bent, pickering, haze, haze_bent = row
    straight = air_masses(BOTTOM, BOTTOM + THICK, DENSITY, float(altitude))
    shell = RefractingShell.build(DENSITY, np.array([2.93e-4, 0.0]), BOTTOM, BOTTOM + THICK)
    bent = air_masses(shell.bottom, shell.top, shell.density, float(altitude))
    ours = (straight[0], bent[0], air_mass_pickering2002(altitude), straight[1], bent[1])
    for value, printed in zip(ours, (gas, gas_bent, pickering, haze, haze_bent), strict=True):
        assert_allclose(value, float(printed), rtol=0, atol=half_digit(str(printed)))


def test_straight_air_mass_on_the_horizon_is_the_bessel_function_s() -> None:
    # An exact integral: ∫ exp(-(r-R)/H) ds = R exp(R/H) K₁(R/H) for a shell without a top.
    from scipy.special import k1e

    ratio = BOTTOM / 7996.0
    exact = ratio * k1e(ratio)
    assert_allclose(air_masses(BOTTOM, BOTTOM + THICK, DENSITY, 0.0)[0], exact, rtol=1e-6)


def test_pickering_agrees_with_pvlib() -> None:
    # A second program: pvlib's model "pickering2002", on zenith angles.
    import pvlib

    zenith = np.linspace(0.0, 90.0, 181)
    theirs = pvlib.atmosphere.get_relative_airmass(zenith, model="pickering2002")
    assert_allclose(air_mass_pickering2002(90.0 - zenith), theirs, rtol=1e-12)
