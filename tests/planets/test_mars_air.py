"""The air of preset ``mars``: the COSPAR reference atmosphere, row by row."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose

from airlight.planets import load_planet
from airlight.planets.matter.profiles import Sounding

#: Seiff (1982), in Pitts et al. (1990), NASA JSC-24455: altitude [km], temperature [K], pressure
#: [Pa], density [kg/m^3], as Mars-GRAM lists them; every fourth kilometre.
TABLE = np.array([
    (0, 214.0, 636, 1.55e-2), (4, 213.4, 441, 1.08e-2), (8, 209.2, 306, 7.65e-3),
    (12, 201.4, 209, 5.44e-3), (16, 194.6, 142, 3.81e-3), (20, 188.3, 94.7, 2.63e-3),
    (24, 182.5, 62.5, 1.79e-3), (28, 177.5, 40.7, 1.20e-3), (32, 172.5, 26.3, 7.97e-4),
    (36, 167.5, 16.8, 5.24e-4), (40, 162.4, 10.6, 3.40e-4), (44, 158.0, 6.56, 2.17e-4),
    (48, 154.1, 4.03, 1.37e-4), (52, 150.3, 2.45, 8.52e-5), (56, 147.2, 1.47, 5.23e-5),
    (60, 144.2, 0.878, 3.18e-5), (64, 142.0, 0.519, 1.91e-5), (68, 140.0, 0.304, 1.14e-5),
    (72, 139.0, 0.178, 6.70e-6), (76, 139.0, 0.104, 3.91e-6), (80, 139.0, 6.08e-2, 2.29e-6),
    (84, 139.0, 3.56e-2, 1.34e-6), (88, 139.0, 2.09e-2, 7.85e-7), (92, 139.0, 1.22e-2, 4.61e-7),
    (96, 139.0, 7.20e-3, 2.71e-7), (100, 139.0, 4.23e-3, 1.59e-7),
])  # fmt: skip


def sounding(constituent: int) -> Sounding:
    profile = load_planet("mars").constituents[constituent].profile
    assert isinstance(profile, Sounding)
    return profile


def test_fourteen_temperatures_give_back_the_pressures_of_the_reference_atmosphere():
    # hydrostatic balance, an independent column of the table: three printed digits are 0.5 % at
    # worst, and 0.5 K between the kept rows add up to 0.3 % of the pressure by 50 km, 0.8 % by 100
    air = sounding(0).air
    altitude, temperature, pressure, density = TABLE.T
    low = altitude <= 50.0
    for rows, share in ((low, 8e-3), (~low, 13e-3)):
        h = 1e3 * altitude[rows]
        assert_allclose(air.temperature(h), temperature[rows], rtol=0, atol=0.51)
        assert_allclose(636.0 * air.pressure_ratio(h), pressure[rows], rtol=share)
        assert_allclose(1.55e-2 * air.density_ratio(h), density[rows], rtol=share)


def test_dust_of_mars_is_mixed_with_its_gas():
    # Tomasko et al. (1999): one profile for both
    mars = load_planet("mars")
    edges, gas = mars.constituents[0].profile.row(mars.thickness)
    dust_edges, dust = mars.constituents[1].profile.row(mars.thickness)
    assert_allclose(dust_edges, edges, rtol=0, atol=0)
    assert_allclose(dust, gas, rtol=0, atol=0)
