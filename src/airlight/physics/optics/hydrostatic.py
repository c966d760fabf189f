r"""Hydrostatic atmosphere in layers of constant lapse rate: temperature, pressure and density.

In hydrostatic equilibrium, :math:`dp = -\rho g\,dh`, an ideal gas with temperature linear in
geopotential altitude has closed forms:

.. math::

    \frac{p}{p_b} = \left(\frac{T_b}{T}\right)^{-g M/(R \Gamma)}, \quad
    T = T_b - \Gamma (H - H_b), \quad
    \frac{p}{p_b} = e^{-g M (H - H_b)/(R T_b)} \text{ where } \Gamma = 0.

Gravity falls with the square of the distance from the centre; over the geopotential altitude
:math:`H = r h/(r + h)` it is constant.

Source: U.S. Standard Atmosphere, 1976 (NOAA-S/T 76-1562), eqs. 18, 23, 33a, 33b, 42.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from typing import Final

import numpy as np
import numpy.typing as npt

from airlight.errors import ParameterError
from airlight.physics.constants import GAS_CONSTANT
from airlight.physics.optics.density_profile import Row
from airlight.physics.units import values_in

FloatArray = npt.NDArray[np.float64]

#: Largest relative error of the density between two nodes of the exponential pieces.
PIECE_TOLERANCE: Final = 5e-5
#: Number of samples of a layer for the number of its pieces.
_SAMPLES: Final = 33
#: Largest number of exponential pieces of a layer.
_MOST_PIECES: Final = 200
#: Smallest temperature within a shell. [K]
_COLDEST: Final = 1.0


def mass_per_length(molar_mass: float, gravity: float) -> float:
    """Temperature over scale height of a gas, M g/R. [K m⁻¹]

    Parameters
    ----------
    molar_mass : float
        Molar mass M. [kg mol⁻¹]
    gravity : float
        Gravitational acceleration g. [m s⁻²]

    Examples
    --------
    >>> f"{1e3 * mass_per_length(28.9644e-3, 9.80665):.3f}"  # K/km
    '34.163'
    """
    return molar_mass * gravity / GAS_CONSTANT


def thickness_of_layer(
    weight: float, temperature: float, lapse_rate: float, pressure_ratio: float
) -> float:
    """Thickness of a layer from its pressure ratio, by the hypsometric equation. [m]

    Parameters
    ----------
    weight : float
        Result of ``mass_per_length``. [K m⁻¹]
    temperature : float
        Temperature at the base. [K]
    lapse_rate : float
        Decrease of temperature with altitude. [K m⁻¹]
    pressure_ratio : float
        Pressure at the top over that at the base. [1]

    Examples
    --------
    >>> weight = mass_per_length(28.9644e-3, 9.80665)
    >>> f"{thickness_of_layer(weight, 288.15, 6.5e-3, 226.3206 / 1013.25):.0f}"  # tropopause
    '11000'
    """
    if lapse_rate == 0.0:
        return -temperature / weight * math.log(pressure_ratio)
    return -temperature / lapse_rate * math.expm1(lapse_rate / weight * math.log(pressure_ratio))


def thickness_between(weight: float, low: float, high: float, pressure_ratio: float) -> float:
    """Thickness of a layer between two levels of given temperature and pressure ratio. [m]

    Parameters
    ----------
    weight : float
        Result of ``mass_per_length``. [K m⁻¹]
    low, high : float
        Temperatures at the base and at the top, between which it is linear over altitude. [K]
    pressure_ratio : float
        Pressure at the top over that at the base. [1]

    Examples
    --------
    >>> weight = mass_per_length(28.9644e-3, 9.80665)
    >>> f"{thickness_between(weight, 288.15, 216.65, 226.3206 / 1013.25):.0f}"  # tropopause
    '11000'
    """
    change = high / low - 1.0
    mean = low if change == 0.0 else low * change / math.log1p(change)
    return -mean / weight * math.log(pressure_ratio)


@dataclass(frozen=True, eq=False)
class HydrostaticLayers:
    """Layers of constant lapse rate of an ideal gas of constant composition.

    Attributes
    ----------
    altitudes : array, shape (n,)
        Geopotential altitudes of the bases, ascending from 0. [m]
    temperatures : array, shape (n,)
        Temperatures there. [K]
    lapse_rates : array, shape (n,)
        Decrease of temperature with geopotential altitude in each layer. [K m⁻¹]
    weight : float
        Result of ``mass_per_length`` at the ground. [K m⁻¹]
    radius : float
        Radius of the ground, for the decrease of gravity; infinite for constant gravity. [m]
    """

    altitudes: FloatArray
    temperatures: FloatArray
    lapse_rates: FloatArray
    weight: float
    radius: float = math.inf

    @classmethod
    def stacked(
        cls,
        altitudes: npt.ArrayLike,
        temperature: float,
        lapse_rates: npt.ArrayLike,
        weight: float,
        radius: float = math.inf,
    ) -> HydrostaticLayers:
        """Layers above a ground of given temperature [K]; arguments as the attributes."""
        bases, rates = np.asarray(altitudes, float), np.asarray(lapse_rates, float)
        falls = np.concatenate([[0.0], np.cumsum(rates[:-1] * np.diff(bases))])
        return cls(bases, temperature - falls, rates, weight, radius)

    def geopotential(self, altitude: npt.ArrayLike) -> FloatArray:
        """Geopotential altitude of a geometric one [m]. [m]"""
        h = values_in(altitude, "m", "altitude")
        return np.asarray(h if math.isinf(self.radius) else self.radius * h / (self.radius + h))

    def geometric(self, altitude: float) -> float:
        """Geometric altitude of a geopotential one, both [m]; infinite from the radius upwards."""
        if math.isinf(self.radius):
            return altitude
        if altitude >= self.radius:
            return math.inf
        return self.radius * altitude / (self.radius - altitude)

    def temperature(self, altitude: npt.ArrayLike) -> FloatArray:
        """Temperature at geometric altitudes [m], shape (...). [K]"""
        at, above = self._layer(self.geopotential(altitude))
        return np.asarray(self.temperatures[at] - self.lapse_rates[at] * above)

    def pressure_ratio(self, altitude: npt.ArrayLike) -> FloatArray:
        """Pressure at geometric altitudes [m] over that at the ground, shape (...). [1]"""
        return np.exp(self._pressure_log(altitude))

    def density_ratio(self, altitude: npt.ArrayLike) -> FloatArray:
        """Density at geometric altitudes [m] over that at the ground, shape (...). [1]"""
        return np.exp(self._density_log(altitude))

    def _pressure_log(self, altitude: npt.ArrayLike) -> FloatArray:
        at, above = self._layer(self.geopotential(altitude))
        return np.asarray(self._base_logs[at] + self._fall(at, above))

    def _density_log(self, altitude: npt.ArrayLike) -> FloatArray:
        """Logarithm of the density ratio, finite where the ratio underflows."""
        cooling = np.log(self.temperatures[0] / self.temperature(altitude))
        return np.asarray(self._pressure_log(altitude) + cooling)

    def _layer(self, geopotential: FloatArray) -> tuple[npt.NDArray[np.intp], FloatArray]:
        """Index of the layer, and geopotential altitude above its base. [m]"""
        at = np.searchsorted(self.altitudes, geopotential, side="right") - 1
        at = np.clip(at, 0, self.altitudes.size - 1)
        return at, np.asarray(geopotential - self.altitudes[at])

    def _fall(self, at: npt.NDArray[np.intp], above: FloatArray) -> FloatArray:
        """Logarithm of the pressure ratio to the base of the layer. [1]"""
        base, rate = self.temperatures[at], self.lapse_rates[at]
        share = np.where(rate == 0.0, 0.0, -rate * above / base)
        safe = np.where(rate == 0.0, 1.0, rate)
        linear = self.weight / safe * np.log1p(share)
        return np.asarray(np.where(rate == 0.0, -self.weight * above / base, linear))

    @property
    def _base_logs(self) -> FloatArray:
        """Logarithm of the pressure ratio of each base to the ground, shape (n,). [1]"""
        layers = np.arange(self.altitudes.size - 1)
        falls = self._fall(layers, np.diff(self.altitudes))
        return np.concatenate([[0.0], np.cumsum(falls)])

    def row(self, thickness: float) -> Row:
        """Segments of the density ratio over a shell; see ``physics.optics.density_profile``.

        Layers are divided into exponential pieces with errors below ``PIECE_TOLERANCE``; an
        isothermal layer under constant gravity is a single, exact piece.

        Parameters
        ----------
        thickness : float
            Thickness of the shell. [m]

        Raises
        ------
        ParameterError
            If the temperature falls below 1 K within the shell.
        """
        inner = [self.geometric(base) for base in self.altitudes[1:].tolist()]
        edges = [0.0, *(h for h in inner if h < thickness), thickness]
        self._check_temperatures(edges)
        nodes = [0.0]
        for low, high in itertools.pairwise(edges):
            nodes += np.linspace(low, high, self._pieces(low, high) + 1)[1:].tolist()
        h = np.array(nodes)
        logs = self._density_log(h)
        rows = np.zeros((h.size - 1, 4))
        rows[:, 0] = np.exp(logs[:-1])
        rows[:, 1] = np.diff(logs) / np.diff(h)
        return h, rows

    def _check_temperatures(self, edges: list[float]) -> None:
        found = self.temperature(np.array(edges))
        coldest = int(found.argmin())
        if found[coldest] < _COLDEST:
            layer = max(coldest - 1, 0)
            raise ParameterError(
                f"lapse_rates[{layer}]",
                float(self.lapse_rates[layer]),
                f"a temperature of at least {_COLDEST:g} K everywhere; at {edges[coldest]:.6g} m"
                f" it would be {found[coldest]:.4g} K",
            )

    def _pieces(self, low: float, high: float) -> int:
        """Number of exponential pieces of one layer between geometric altitudes [m]."""
        logs = self._density_log(np.linspace(low, high, _SAMPLES)[:-1])
        # A chord errs by an eighth of the second difference over its own ends.
        bend = float(np.abs(np.diff(logs, 2)).max()) * (_SAMPLES - 1) ** 2
        needed = math.ceil(math.sqrt(bend / (8.0 * PIECE_TOLERANCE)) - 1e-6)
        return min(max(needed, 1), _MOST_PIECES)
