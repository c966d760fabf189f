"""Layout of a table of diffuse horizontal irradiance, Bruneton's 2017 (r, mu_s)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.mappings.irradiance import (
    radius_coordinate,
    radius_from_coordinate,
    sun_coordinate,
    sun_from_coordinate,
)
from airlight.kernel import vectorized
from airlight.solver.tables.bilinear import bilinear
from airlight.solver.tables.layout import Axis, FloatArray, Positions, TableLayout


@dataclass(frozen=True, kw_only=True)
class IrradianceLayout(TableLayout):
    """Layout with the axes (r, mu_s), both linear.

    Parameters
    ----------
    bottom_radius, top_radius : float
        Radii of the ground and of the top of the shell. [m]
    radii, sun_angles : int
        Texels along each axis.
    """

    kind: ClassVar[str] = "bruneton-irradiance"
    bottom_radius: float
    top_radius: float
    radii: int = 16
    sun_angles: int = 64

    def __post_init__(self) -> None:
        self._check_shell()

    @property
    def axes(self) -> tuple[Axis, ...]:
        """See ``TableLayout``."""
        shell = {"bottom_radius": self.bottom_radius, "top_radius": self.top_radius}
        linear = "(r - bottom) / (top - bottom)"
        return (
            Axis(name="r", size=self.radii, unit="m", parameters=shell, mapping=linear),
            Axis(name="mu_s", size=self.sun_angles, unit="1", mapping="(mu_s + 1) / 2"),
        )

    @property
    def texture_axes(self) -> tuple[tuple[str, ...], ...]:
        """See ``TableLayout``."""
        return (("mu_s",), ("r",), ())

    def positions(self) -> Positions:
        """See ``TableLayout``; the view's angles are arbitrary."""
        x = np.linspace(0.0, 1.0, self.radii)
        r = vectorized(radius_from_coordinate)(x, self.bottom_radius, self.top_radius)
        mu_s = vectorized(sun_from_coordinate)(np.linspace(0.0, 1.0, self.sun_angles))
        return Positions.of(
            r[:, None], 1.0, mu_s, bottom_radius=self.bottom_radius, to_ground=False
        )

    def interpolate(self, values: NDArray[Any], positions: Positions) -> FloatArray:
        """See ``TableLayout``."""
        out = np.empty((len(positions), values.shape[-1]))
        x = vectorized(radius_coordinate)(positions.r, self.bottom_radius, self.top_radius)
        bilinear(values, x, vectorized(sun_coordinate)(positions.mu_s), out)
        return out

    def parameters(self) -> dict[str, Any]:
        """See ``TableLayout``."""
        return {
            "bottom_radius": self.bottom_radius,
            "top_radius": self.top_radius,
            "radii": self.radii,
            "suns": self.sun_angles,
        }
