"""Labelled table: values on a layout, with quantity, unit and provenance, and their look-up."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import ParameterError
from airlight.kernel.threads import run_blocks
from airlight.solver.tables.atmosphere_plus import AtmospherePlusLayout
from airlight.solver.tables.bruneton import BrunetonLayout
from airlight.solver.tables.irradiance import IrradianceLayout
from airlight.solver.tables.layout import FloatArray, Positions, TableLayout
from airlight.solver.tables.transmittance import TransmittanceLayout

#: Every layout by its name in manifests.
LAYOUTS: Final[dict[str, type[TableLayout]]] = {
    layout.kind: layout
    for layout in (TransmittanceLayout, IrradianceLayout, BrunetonLayout, AtmospherePlusLayout)
}
#: Types of stored values, by the names of precisions.
PRECISIONS: Final = {"half": np.float16, "single": np.float32, "double": np.float64}
#: Values in half precision are scaled so that the largest is below this; a half holds 65504.
_LARGEST_HALF: Final = 32768.0
#: Points per block of a look-up.
_BLOCK: Final = 1 << 15


@dataclass(frozen=True, kw_only=True, eq=False)
class Table:
    """Values of one quantity on a layout.

    Parameters
    ----------
    name : str
        Short name: ``transmittance``, ``scattering``.
    quantity : str
        Description of the quantity.
    unit : str
        Unit of the values, after multiplication by ``scale``.
    layout : TableLayout
        Positions of the texels.
    channels : tuple of str
        Names of the values at one texel.
    values : array, shape (..., channels)
        Stored values: float16, float32 or float64.
    scale : float
        Factor of the stored values; 1 except in half precision.
    provenance : mapping of str to str
        Origin of the values.
    """

    name: str
    quantity: str
    unit: str
    layout: TableLayout
    channels: tuple[str, ...]
    values: NDArray[Any]
    scale: float = 1.0
    provenance: Mapping[str, str] = field(default_factory=dict)

    def __repr__(self) -> str:
        axes = " x ".join(f"{axis.name} {axis.size}" for axis in self.layout.axes)
        return f"<Table {self.name}: {axes}; {len(self.channels)} channels, {self.precision}>"

    def __post_init__(self) -> None:
        shape = (*self.layout.shape, len(self.channels))
        if self.values.shape != shape:
            raise ParameterError(f"shape of {self.name}", self.values.shape, str(shape))
        if self.values.dtype not in (np.float16, np.float32, np.float64):
            allowed = "float16, float32 or float64"
            raise ParameterError(f"type of {self.name}", str(self.values.dtype), allowed)

    @property
    def precision(self) -> str:
        """Name of the precision: ``half``, ``single`` or ``double``."""
        return {2: "half", 4: "single", 8: "double"}[self.values.dtype.itemsize]

    @cached_property
    def physical(self) -> NDArray[Any]:
        """Values in their unit, as floats that compiled loops can read."""
        if self.values.dtype == np.float16:
            return self.values.astype(np.float32) * np.float32(self.scale)
        if self.scale == 1.0:
            return np.ascontiguousarray(self.values)
        return np.ascontiguousarray(self.values * self.values.dtype.type(self.scale))

    def at(self, positions: Positions) -> FloatArray:
        """Interpolated values at n points, shape (n, channels), on all cores."""
        out = np.empty((len(positions), len(self.channels)))
        values = self.physical

        def block(index: int) -> None:
            rows = slice(index * _BLOCK, (index + 1) * _BLOCK)
            out[rows] = self.layout.interpolate(values, positions[rows])

        run_blocks(block, -(-len(positions) // _BLOCK))
        return out

    def look_up(
        self,
        r: ArrayLike,
        mu: ArrayLike = 1.0,
        mu_s: ArrayLike = 1.0,
        nu: ArrayLike = 0.0,
        *,
        to_ground: ArrayLike | None = None,
    ) -> FloatArray:
        """Interpolated values at coordinates that broadcast.

        Parameters
        ----------
        r, mu, mu_s, nu : arrays that broadcast to (...)
            Radius [m]; cosines of view zenith, sun zenith and the angle between view and sun [1].
            Coordinates for which the layout has no axis are ignored.
        to_ground : array of bool, optional
            Whether the line of sight ends on the ground; default: by the geometry.

        Returns
        -------
        array, shape (..., channels)
            Values in the table's unit.
        """
        shape = np.broadcast_shapes(*(np.shape(x) for x in (r, mu, mu_s, nu)))
        positions = Positions.of(
            r, mu, mu_s, nu, bottom_radius=self.layout.bottom_radius, to_ground=to_ground
        )
        return self.at(positions).reshape(*shape, len(self.channels))


def stored(values: FloatArray, precision: str) -> tuple[NDArray[Any], float]:
    """Stored values, and their scale.

    For half precision, 6e-8 to 65504, values are divided by the power of two that brings the
    largest just below 32768.

    Parameters
    ----------
    values : array
        Values, finite, 0 or more.
    precision : str
        Name of the precision: ``half``, ``single`` or ``double``.

    Raises
    ------
    ParameterError
        If ``precision`` is unknown.

    Examples
    --------
    >>> halves, scale = stored(np.array([1e-9, 0.5]), "half")
    >>> halves.dtype, scale, (halves * scale).tolist()[1]
    (dtype('float16'), 1.52587890625e-05, 0.5)
    """
    if precision not in PRECISIONS:
        raise ParameterError("precision", precision, ", ".join(PRECISIONS))
    if precision != "half":
        return values.astype(PRECISIONS[precision]), 1.0
    largest = float(np.abs(values).max(initial=0.0))
    if largest == 0.0:
        return values.astype(np.float16), 1.0
    scale = float(2.0 ** np.ceil(np.log2(largest / _LARGEST_HALF)))
    return (values / scale).astype(np.float16), scale


#: Fields of layouts that have another name in a manifest.
_FIELDS: Final = {"suns": "sun_angles"}


def layout_of(kind: str, parameters: Mapping[str, Any]) -> TableLayout:
    """Layout of the name and parameters in a manifest."""
    if kind not in LAYOUTS:
        raise ParameterError("layout", kind, ", ".join(LAYOUTS))
    try:
        return LAYOUTS[kind](**{_FIELDS.get(name, name): one for name, one in parameters.items()})
    except TypeError as error:
        allowed = "parameters of this layout"
        raise ParameterError(f"parameters of layout {kind}", str(error), allowed) from None
