"""Particle size distributions as parameter objects."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import Any, Final

from airlight.physics.optics import size_distribution as distribution
from airlight.physics.optics.size_distribution import SizeNodes
from airlight.planets.matter.state_keys import RADIUS
from airlight.planets.parameters import parameters
from airlight.planets.schema.field import key
from airlight.planets.schema.tagged_union import TaggedUnion
from airlight.planets.schema.toml_model import TomlModel


class ParticleSizes(TomlModel, ABC):
    """Size distribution of particles."""

    mode = "advanced"

    @abstractmethod
    def moment(self, power: int) -> float:
        """Mean of r^power. [m^power]"""

    @abstractmethod
    def sizes(self, count: int) -> SizeNodes:
        """Nodes over the distribution."""

    @classmethod
    def default_table(cls, old: Mapping[str, Any], thickness: float) -> dict[str, Any]:
        """Default table with the radius of the previous table; see ``TomlModel.default_table``."""
        table = super().default_table(old, thickness)
        radii = [value for name, value in old.items() if name.endswith("radius")]
        return {
            name: radii[0] if radii and name.endswith("radius") else value
            for name, value in table.items()
        }


@parameters
class GammaSizes(ParticleSizes):
    """Gamma distribution of radii in the form of Hansen & Travis (1974).

    Parameters
    ----------
    effective_radius : float
        Area-weighted mean radius, 1e-10 to 1e-3. [m]
    effective_variance : float
        Effective variance, above 0, below 1/2. [1]
    """

    keyword = "gamma"

    effective_radius: float = key(RADIUS, help="Mean radius, weighted by area.")
    effective_variance: float = key(
        help="Width of the size distribution.",
        range=(0.0, 0.5),
        open_ends=True,
        example="0.3",
        slider=(0.01, 0.49),
        input_range=(1e-3, 0.499),
        initial=0.2,
    )

    def moment(self, power: int) -> float:
        """Mean of r^power. [m^power]"""
        return distribution.gamma_moment(power, self.effective_radius, self.effective_variance)

    def sizes(self, count: int) -> SizeNodes:
        """Nodes over the distribution."""
        return distribution.gamma_sizes(self.effective_radius, self.effective_variance, count)


@parameters
class LogNormalSizes(ParticleSizes):
    """Log-normal distribution of radii.

    Parameters
    ----------
    median_radius : float
        Median of the radii, 1e-10 to 1e-3. [m]
    geometric_deviation : float
        Geometric standard deviation σ_g, 1 to 5; 1 is a single radius. [1]
    """

    keyword = "log-normal"

    median_radius: float = key(RADIUS, help="Half of the particles are larger.", example="0.5 um")
    geometric_deviation: float = key(
        help="Geometric standard deviation, a factor about the median radius.",
        range=(1.0, 5.0),
        example="1.6",
        slider=(1.0, 3.0),
        initial=1.5,
    )

    def moment(self, power: int) -> float:
        """Mean of r^power. [m^power]"""
        if self.geometric_deviation == 1.0:
            return float(self.median_radius**power)
        return distribution.log_normal_moment(power, self.median_radius, self.geometric_deviation)

    def sizes(self, count: int) -> SizeNodes:
        """Nodes over the distribution."""
        if self.geometric_deviation == 1.0:
            return distribution.single_size(self.median_radius)
        return distribution.log_normal_sizes(self.median_radius, self.geometric_deviation, count)


@parameters
class SingleSize(ParticleSizes):
    """Particles of a single radius, with unsmoothed Mie ripples.

    Parameters
    ----------
    radius : float
        Radius, 1e-10 to 1e-3. [m]
    """

    keyword = "single"

    radius: float = key(RADIUS, help="The same for all.")

    def moment(self, power: int) -> float:
        """Mean of r^power. [m^power]"""
        return float(self.radius**power)

    def sizes(self, count: int) -> SizeNodes:
        """Single radius, whatever the number of nodes."""
        return distribution.single_size(self.radius)


#: Kinds of ``sizes = { kind = … }``.
SIZES: Final[TaggedUnion[ParticleSizes]] = TaggedUnion(
    ParticleSizes,
    (GammaSizes, LogNormalSizes, SingleSize),
    label="sizes",
    help="Size distribution of the radii.",
    mode="advanced",
)
