"""Direction of a light of a scene, and its source."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.scene.directions import direction
from airlight.scene.limits import within

if TYPE_CHECKING:
    from airlight.planets.light_source import LightSource


@dataclass(frozen=True, kw_only=True)
class LightPosition:
    """Direction of a light in the observer's local frame.

    Its source is one of the planet's light sources; lights with other sources, such as a moon, are
    subclasses that override ``source``.

    Parameters
    ----------
    zenith : float
        True zenith angle at the observer. [deg]
    azimuth : float
        Azimuth from the star's side, to the right. [deg]
    index : int
        Index of its source among those of the planet.

    Examples
    --------
    >>> LightPosition(zenith=90.0).direction.round(12) + 0.0
    array([1., 0., 0.])
    """

    zenith: float
    azimuth: float = 0.0
    index: int = 0

    #: Name of the light in errors.
    _word = "light"

    def __post_init__(self) -> None:
        self._check("zenith", 0.0, 180.0)
        self._check("azimuth", -720.0, 720.0)

    def _check(self, name: str, low: float, high: float) -> None:
        """Convert and validate an angle. [deg]"""
        value = within(f"{self._word}.{name}", getattr(self, name), low, high, "deg")
        object.__setattr__(self, name, value)

    @property
    def direction(self) -> NDArray[np.float64]:
        """Unit vector towards the light, shape (3,). [1]"""
        return direction(self.zenith, self.azimuth)

    def radius(self, star: float) -> float:
        """Angular radius of its disc. [rad]

        Parameters
        ----------
        star : float
            Angular radius of the planet's star. [rad]
        """
        return star

    def relative_to(self, star: LightPosition) -> LightPosition:
        """Light with a disc that may depend on the first light of the scene."""
        return self

    def source(self, sources: tuple[LightSource, ...]) -> LightSource:
        """Source of the light.

        Parameters
        ----------
        sources : tuple of LightSource
            Sources of the planet: ``Solution.lights``.
        """
        if not 0 <= self.index < len(sources):
            raise ParameterError("light.index", self.index, f"0 to {len(sources) - 1}")
        return sources[self.index]

    def metadata(self) -> str:
        """Metadata for file headers."""
        return f"light, zenith {self.zenith:.10g} deg, azimuth {self.azimuth:.10g} deg"
