"""Layout of a table of transmittance to the top of the shell, Bruneton's 2017 (r, mu).

Only rays that miss the ground are covered. Values are not stored in half precision, as the sun
remains visible at 1e-5.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.mappings.transmittance import (
    altitude_coordinate,
    cosine_from_coordinate,
    direction_coordinate,
    radius_from_coordinate,
)
from airlight.kernel import vectorized
from airlight.solver.tables.bilinear import bilinear
from airlight.solver.tables.layout import Axis, FloatArray, Positions, TableLayout


@dataclass(frozen=True, kw_only=True)
class TransmittanceLayout(TableLayout):
    """Layout with the axes (r, mu): distance to the horizon; distance to the top.

    Parameters
    ----------
    bottom_radius, top_radius : float
        Radii of the ground and of the top of the shell. [m]
    radii, views : int
        Texels along each axis.
    """

    kind: ClassVar[str] = "bruneton-transmittance"
    bottom_radius: float
    top_radius: float
    radii: int = 64
    views: int = 256

    def __post_init__(self) -> None:
        self._check_shell()

    @property
    def axes(self) -> tuple[Axis, ...]:
        """See ``TableLayout``."""
        shell = {"bottom_radius": self.bottom_radius, "top_radius": self.top_radius}
        return (
            Axis(
                name="r",
                size=self.radii,
                unit="m",
                parameters=shell,
                mapping="sqrt((r² - bottom²) / (top² - bottom²))",
            ),
            Axis(
                name="mu",
                size=self.views,
                unit="1",
                parameters=shell,
                mapping="(d - d_min) / (d_max - d_min); d: distance to the top, "
                "d_min = top - r, d_max = sqrt(r² - bottom²) + sqrt(top² - bottom²)",
            ),
        )

    @property
    def texture_axes(self) -> tuple[tuple[str, ...], ...]:
        """See ``TableLayout``."""
        return (("mu",), ("r",), ())

    def positions(self) -> Positions:
        """See ``TableLayout``; the sun's angles are arbitrary."""
        x = np.linspace(0.0, 1.0, self.radii)
        y = np.linspace(0.0, 1.0, self.views)
        r = vectorized(radius_from_coordinate)(x, self.bottom_radius, self.top_radius)
        r = np.clip(r, self.bottom_radius, self.top_radius)[:, None]
        mu = vectorized(cosine_from_coordinate)(y, r, self.bottom_radius, self.top_radius)
        return Positions.of(r, mu, bottom_radius=self.bottom_radius, to_ground=False)

    def interpolate(self, values: NDArray[Any], positions: Positions) -> FloatArray:
        """See ``TableLayout``; 0 for rays that meet the ground."""
        shell = (self.bottom_radius, self.top_radius)
        out = np.empty((len(positions), values.shape[-1]))
        x = vectorized(altitude_coordinate)(positions.r, *shell)
        y = vectorized(direction_coordinate)(positions.r, positions.mu, *shell)
        bilinear(values, x, y, out)
        out[positions.to_ground] = 0.0
        return out

    def parameters(self) -> dict[str, Any]:
        """See ``TableLayout``."""
        return {
            "bottom_radius": self.bottom_radius,
            "top_radius": self.top_radius,
            "radii": self.radii,
            "views": self.views,
        }
