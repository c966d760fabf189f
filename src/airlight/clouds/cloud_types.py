"""Generated clouds: a ``CloudField`` from a type and its parameters."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.anvil import storm_extinction
from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_grid import CloudGrid
from airlight.clouds.fibres import fibre_extinction, trail
from airlight.clouds.heaps import CONGESTUS, heap_extinction
from airlight.clouds.layers import ALTOCUMULUS, STRATOCUMULUS, STRATUS, layer_extinction
from airlight.planets.clouds import (
    Altocumulus,
    Cirrus,
    CloudType,
    Cumulonimbus,
    CumulusCongestus,
    CumulusHumilis,
    Stratocumulus,
    Stratus,
)

FloatArray = NDArray[np.float64]

#: Side of the box by default. [m]
SIZE: Final = 25.6e3
#: Weight of the distance from the thickest cloud in the choice of a side. [1]
_CLEAR: Final = 0.05
#: Relative extinction by type: ``(grid, random, cell=, cover=, shear=)``.
GENERATORS: Final[dict[type[CloudType], Callable[..., FloatArray]]] = {
    Stratus: partial(layer_extinction, pattern=STRATUS),
    Stratocumulus: partial(layer_extinction, pattern=STRATOCUMULUS),
    CumulusHumilis: heap_extinction,
    CumulusCongestus: partial(heap_extinction, shape=CONGESTUS),
    Cumulonimbus: storm_extinction,
    Altocumulus: partial(layer_extinction, pattern=ALTOCUMULUS),
    Cirrus: fibre_extinction,
}


def cloud_field(
    clouds: CloudType,
    *,
    size: float = SIZE,
    spacing: float | None = None,
    levels: int | None = None,
    latitude: float = 0.0,
    longitude: float = 0.0,
) -> CloudField:
    """Field of generated clouds; the same for the same parameters.

    Cover and mean optical depth of the cloudy columns of a periodic box are those of the clouds.

    Parameters
    ----------
    clouds : CloudType
        Kind and parameters.
    size : float
        Side of the box, rounded to whole cells. [m]
    spacing : float, optional
        Horizontal width of a cell; by default that of the type. [m]
    levels : int, optional
        Number of levels; by default that of the type.
    latitude, longitude : float
        The place, in the middle of the box. [deg]
    """
    step = clouds.spacing if spacing is None else spacing
    columns = max(round(size / step), 4)
    grid = CloudGrid(
        columns=columns, levels=levels or clouds.levels, spacing=step, depth=clouds.depth
    )
    random = np.random.default_rng(int(clouds.seed))
    relative = np.zeros(grid.shape)
    if clouds.cover > 0.0:
        parts = {"cell": clouds.cell, "cover": clouds.cover, "shear": clouds.shear}
        if isinstance(clouds, CumulusHumilis | CumulusCongestus):
            parts["organisation"] = clouds.organisation
        relative = GENERATORS[type(clouds)](grid, random, **parts)
    extinction = scaled(relative, grid, clouds.optical_depth)
    return CloudField(
        extinction=extinction if clouds.beyond == "periodic" else isolated(extinction),
        spacing=(step, step, grid.level),
        base=clouds.base,
        latitude=latitude,
        longitude=longitude,
        beyond=clouds.beyond,
        trail=trail(clouds.shear) if isinstance(clouds, Cirrus) else 0.0,
    )


def scaled(relative: FloatArray, grid: CloudGrid, optical_depth: float) -> NDArray[np.float32]:
    """Extinction whose cloudy columns have a mean optical depth. [m⁻¹]"""
    columns = relative.sum(axis=2) * grid.level
    cloudy = columns > 0.0
    if not cloudy.any():
        return np.zeros(grid.shape, np.float32)
    return np.asarray(relative * (optical_depth / columns[cloudy].mean()), np.float32)


def isolated(extinction: NDArray[np.float32]) -> NDArray[np.float32]:
    """Periodic field without the clouds at its sides, which are moved to where few clouds are.

    Parameters
    ----------
    extinction : array, shape (nx, ny, nz)
        Extinction. [m⁻¹]
    """
    from scipy.ndimage import label

    depth, found = extinction.sum(axis=2), extinction
    for axis in (0, 1):
        along = depth.sum(axis=1 - axis)
        count = along.size
        far = np.abs((np.arange(count) - int(along.argmax())) / count % 1.0 - 0.5)
        cover = (depth > 0.0).mean(axis=1 - axis)
        side = int((np.maximum(cover, np.roll(cover, 1)) + _CLEAR * far).argmin())
        found = np.roll(found, -side, axis=axis)
    clouds, _ = label(found.any(axis=2))
    cut = np.unique(np.concatenate([clouds[0], clouds[-1], clouds[:, 0], clouds[:, -1]]))
    whole = found * ~np.isin(clouds, cut)[..., None]
    return whole if whole.sum() > 0.5 * found.sum() else found
