"""Interface of table layouts: positions of texels and interpolation between them.

A layout maps physical quantities to the axes of a table. Interpolation is linear along every axis,
and never across the horizon.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import ParameterError
from airlight.geometry.shell import meets_ground
from airlight.kernel import vectorized
from airlight.physics.units import values_in

FloatArray = NDArray[np.float64]

#: Largest number of texels of a table.
MOST_TEXELS = 1 << 26


@dataclass(frozen=True, kw_only=True)
class Axis:
    """Description of an axis of a table.

    Attributes
    ----------
    name : str
        Name of the quantity: ``r``, ``mu``, ``mu_s``, ``nu`` or ``altitude``.
    size : int
        Number of texels along it.
    mapping : str
        Mapping from the quantity to x in [0, 1]; texel k of n has x = k/(n-1).
    unit : str
        Unit of the quantity.
    parameters : mapping
        Parameters of the mapping.
    """

    name: str
    size: int
    mapping: str
    unit: str
    parameters: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if not 2 <= self.size <= MOST_TEXELS:
            raise ParameterError(f"size of axis {self.name}", self.size, f"2 to {MOST_TEXELS}")


@dataclass(frozen=True)
class Positions:
    """Points and directions in the shell at which a table is evaluated, as flat arrays.

    Attributes
    ----------
    r, mu, mu_s, nu : array, shape (n,)
        Radius [m]; cosines of view zenith, sun zenith and the angle between view and sun. [1]
    to_ground : array of bool, shape (n,)
        Whether the line of sight ends on the ground.
    """

    r: FloatArray
    mu: FloatArray
    mu_s: FloatArray
    nu: FloatArray
    to_ground: NDArray[np.bool_]

    @classmethod
    def of(
        cls,
        r: ArrayLike,
        mu: ArrayLike = 1.0,
        mu_s: ArrayLike = 1.0,
        nu: ArrayLike = 0.0,
        *,
        bottom_radius: float,
        to_ground: ArrayLike | None = None,
    ) -> Positions:
        """Points from arrays that broadcast; ``to_ground`` by default follows from the geometry."""
        cosines = [
            values_in(one, "1", name) for one, name in ((mu, "mu"), (mu_s, "mu_s"), (nu, "nu"))
        ]
        arrays = np.broadcast_arrays(values_in(r, "m", "r"), *cosines)
        flat = [np.ascontiguousarray(array).ravel() for array in arrays]
        if to_ground is None:
            ends = np.asarray(vectorized(meets_ground)(flat[0], flat[1], bottom_radius), bool)
        else:
            ends = np.broadcast_to(np.asarray(to_ground, bool), arrays[0].shape).ravel()
        r, mu, mu_s, nu = flat
        return cls(r, mu, mu_s, nu, np.ascontiguousarray(ends))

    def __len__(self) -> int:
        return self.r.size

    def __getitem__(self, rows: slice | NDArray[Any]) -> Positions:
        return Positions(
            self.r[rows], self.mu[rows], self.mu_s[rows], self.nu[rows], self.to_ground[rows]
        )

    def joined(self, other: Positions) -> Positions:
        """Concatenation with other points."""
        return Positions(
            *(
                np.concatenate([getattr(self, one), getattr(other, one)])
                for one in ("r", "mu", "mu_s", "nu", "to_ground")
            )
        )


class TableLayout(ABC):
    """Positions of a table's texels and interpolation between them.

    Attributes
    ----------
    kind : str
        Name of the layout in manifests.
    bottom_radius, top_radius : float
        Radii of the ground and of the top of the shell. [m]
    """

    kind: ClassVar[str]
    bottom_radius: float
    top_radius: float

    @property
    @abstractmethod
    def axes(self) -> tuple[Axis, ...]:
        """Axes in array order, without the channels, which are last."""

    @property
    @abstractmethod
    def texture_axes(self) -> tuple[tuple[str, ...], ...]:
        """Names of the axes along width, height and depth of a texture, slowest first."""

    @abstractmethod
    def positions(self) -> Positions:
        """Points of all texels, the last axis running fastest."""

    @abstractmethod
    def interpolate(self, values: NDArray[Any], positions: Positions) -> FloatArray:
        """Linear interpolation between texels.

        Parameters
        ----------
        values : array, shape (..., channels)
            Stored values, float32 or float64.
        positions : Positions
            Points, n of them.
        """

    @abstractmethod
    def parameters(self) -> dict[str, Any]:
        """Parameters in a manifest: ``layout_of(layout.kind, layout.parameters())`` is equal."""

    @property
    def shape(self) -> tuple[int, ...]:
        """Texels along each axis."""
        return tuple(axis.size for axis in self.axes)

    def _check_shell(self) -> None:
        if not 0.0 < self.bottom_radius < self.top_radius < np.inf:
            raise ParameterError(
                "bottom_radius, top_radius",
                (self.bottom_radius, self.top_radius),
                "0 m < bottom_radius < top_radius",
            )
        if np.prod([float(axis.size) for axis in self.axes]) > MOST_TEXELS:
            raise ParameterError("size", self.shape, f"at most {MOST_TEXELS} texels")
