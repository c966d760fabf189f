"""Properties of a planet that spherical tables and other programs cannot represent."""

from __future__ import annotations

from typing import Protocol

from airlight.errors import warn
from airlight.planets.rings import Ring, warn_of_rings


class Shaped(Protocol):
    """Planet or medium with rings and a flattening."""

    @property
    def rings(self) -> tuple[Ring, ...]:
        """Rings."""

    @property
    def flattening(self) -> float:
        """Flattening. [1]"""


def warn_of_shape(body: Shaped, consumer: str) -> None:
    """Issue a warning where rings or the flattening of a planet are left out.

    Parameters
    ----------
    body : Planet or Medium
        Planet.
    consumer : str
        What is computed without them.
    """
    warn_of_rings(body.rings, consumer)
    if body.flattening > 0.0:
        warn(
            f"{consumer} of a sphere with the radius of the equator: the flattening, "
            f"{body.flattening:.3g}, is left out; pictures have it"
        )
