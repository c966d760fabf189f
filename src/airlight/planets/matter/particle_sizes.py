"""The sizes of particles as parameter objects."""

from __future__ import annotations

from typing import Annotated

from airlight.optics import size_distribution as distribution
from airlight.optics.size_distribution import Sizes
from airlight.planets.parameters import between, parameters

_Radius = Annotated[float, between(1e-10, 1e-3, "m")]


@parameters
class GammaSizes:
    """Gamma distribution of radii, as Hansen & Travis (1974) write it.

    Parameters
    ----------
    effective_radius : float
        Mean radius by area, 1e-10 to 1e-3. [m]
    effective_variance : float
        Above 0, below 1/2. [1]
    """

    effective_radius: _Radius
    effective_variance: Annotated[float, between(0.0, 0.5, above=True, below=True)]

    def moment(self, power: float) -> float:
        """Mean of r^power. [m^power]"""
        return distribution.gamma_moment(power, self.effective_radius, self.effective_variance)

    def sizes(self, count: int) -> Sizes:
        """Nodes over the distribution."""
        return distribution.gamma_sizes(self.effective_radius, self.effective_variance, count)


@parameters
class LogNormalSizes:
    """Log-normal distribution of radii.

    Parameters
    ----------
    median_radius : float
        Half of the particles are smaller, 1e-10 to 1e-3. [m]
    geometric_deviation : float
        σ_g, 1 to 5; 1 is one radius for all. [1]
    """

    median_radius: _Radius
    geometric_deviation: Annotated[float, between(1.0, 5.0)]

    def moment(self, power: float) -> float:
        """Mean of r^power. [m^power]"""
        if self.geometric_deviation == 1.0:
            return float(self.median_radius**power)
        return distribution.log_normal_moment(power, self.median_radius, self.geometric_deviation)

    def sizes(self, count: int) -> Sizes:
        """Nodes over the distribution."""
        if self.geometric_deviation == 1.0:
            return distribution.single_size(self.median_radius)
        return distribution.log_normal_sizes(self.median_radius, self.geometric_deviation, count)


@parameters
class SingleSize:
    """All particles of one radius: their light shows every ripple.

    Parameters
    ----------
    radius : float
        1e-10 to 1e-3. [m]
    """

    radius: _Radius

    def moment(self, power: float) -> float:
        """Mean of r^power. [m^power]"""
        return float(self.radius**power)

    def sizes(self, count: int) -> Sizes:
        """The one radius, however many nodes are asked for."""
        return distribution.single_size(self.radius)


ParticleSizes = GammaSizes | LogNormalSizes | SingleSize
