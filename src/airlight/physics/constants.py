"""Physical constants in SI units, each with its source."""

from __future__ import annotations

from typing import Final

#: Speed of light in vacuum, exact. [m s⁻¹] CODATA 2018.
SPEED_OF_LIGHT: Final = 299_792_458.0
#: Planck constant, exact. [J s] CODATA 2018.
PLANCK: Final = 6.626_070_15e-34
#: Boltzmann constant, exact. [J K⁻¹] CODATA 2018.
BOLTZMANN: Final = 1.380_649e-23
#: Avogadro constant, exact. [mol⁻¹] CODATA 2018.
AVOGADRO: Final = 6.022_140_76e23
#: Molar gas constant, exact (product of the two above). [J mol⁻¹ K⁻¹] CODATA 2018.
GAS_CONSTANT: Final = BOLTZMANN * AVOGADRO
#: Loschmidt constant at 273.15 K and 101 325 Pa. [m⁻³] CODATA 2018.
LOSCHMIDT: Final = 101_325.0 / (BOLTZMANN * 273.15)
#: Dobson unit: 10 µm of gas at 0 °C and 101 325 Pa, as a column of molecules. [m⁻²]
DOBSON_UNIT: Final = LOSCHMIDT * 1e-5
#: Astronomical unit, exact. [m] IAU 2012 Resolution B2.
ASTRONOMICAL_UNIT: Final = 149_597_870_700.0
#: Nominal solar radius. [m] IAU 2015 Resolution B3.
SOLAR_RADIUS: Final = 6.957e8
#: Nominal effective temperature of the sun. [K] IAU 2015 Resolution B3.
SOLAR_TEMPERATURE: Final = 5772.0
#: Maximum luminous efficacy, photopic. [lm W⁻¹] CIE 018:2019 (683.002 for air; here K_cd).
LUMINOUS_EFFICACY: Final = 683.0
