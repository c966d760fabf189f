"""Density profile that is continued below its reference level."""

from __future__ import annotations

from typing import Annotated, Final

import numpy as np

from airlight.errors import ParameterError
from airlight.physics.optics.density_profile import Row
from airlight.planets.matter.profiles.profile import Profile
from airlight.planets.parameters import instance_of, parameters

#: Scale heights below the reference level down to which a profile is continued.
_MOST: Final = 10.0


@parameters
class Continued(Profile):
    """Profile over a ground below its reference level.

    Below the reference level the density continues with its local scale height: exact for an
    exponential, error 4e-4 for 440 m of the U.S. Standard Atmosphere.

    Parameters
    ----------
    profile : Profile
        Profile above the reference level.
    depth : float
        Depth of the ground below the reference level. [m]

    Examples
    --------
    >>> from airlight.planets.matter.profiles import Exponential
    >>> edges, pieces = Continued(profile=Exponential(scale_height=8e3), depth=8e3).row(108e3)
    >>> edges.tolist(), f"{pieces[0, 0]:.6f}"  # e times the density, at the ground
    ([0.0, 8000.0, 108000.0], '2.718282')
    """

    profile: Annotated[Profile, instance_of(Profile)]
    depth: float

    def row(self, thickness: float) -> Row:
        """Segments over a shell of this thickness [m]; see ``physics.optics.density_profile``."""
        edges, pieces = self.profile.row(thickness - self.depth)
        a, b, c, d = (float(one) for one in pieces[0])
        density = max(a + d, 0.0)
        rate = (a * b + c) / density if density > 0.0 else 0.0
        if -rate * self.depth > _MOST:
            allowed = f"at least {self.depth / _MOST:.4g} m to be continued {self.depth:.4g} m down"
            raise ParameterError("scale height at the reference level", -1.0 / rate, allowed)
        below = np.array([[density * np.exp(-rate * self.depth), rate, 0.0, 0.0]])
        return np.append(0.0, edges + self.depth), np.concatenate([below, pieces])

    def column(self, thickness: float) -> float:
        """Vertical column above the reference level. [m]"""
        return self.profile.column(thickness - self.depth)
