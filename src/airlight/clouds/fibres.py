"""Cirrus: generating heads whose falling crystals trail as fibres in the wind.

Crystals leave heads at the top and fall at a constant speed v through the sheared wind, so that a
trail is displaced by -s Δh²/(2 v) at the depth Δh below its head (Heymsfield 1975, JAS 32, 799),
grows from a faint head, spreads, and sublimates towards the base. The wind below the heads turns:
trails are hooks, which no line of sight follows from end to end.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_grid import CloudGrid
from airlight.clouds.power_law_field import power_law_field

FloatArray = NDArray[np.float64]

#: Speed of fall of crystals. [m s⁻¹] Heymsfield & Iaquinta (2000), JAS 57, 916: 0.3 to 1 m/s.
FALL: Final = 0.8
#: Displacement of the end of a trail to the south over that to the west. [1]
TURN: Final = 0.3
#: Longest waves of heads over the distance between their groups: trails are fine. [1]
_HEADS: Final = 0.12
#: Length of heads along the wind over their width, and depth at which trails have the most ice over
#: that of the cloud: heads are faint. By eye. [1]
_DRAWN: Final = 2.0
_GROWN: Final = 0.3


def trail(shear: float) -> float:
    """Displacement of crystals by a shear [s⁻¹] over the square of the depth fallen. [m⁻¹]"""
    return shear / (2.0 * FALL)


def fibre_extinction(
    grid: CloudGrid, random: np.random.Generator, *, cell: float, cover: float, shear: float
) -> FloatArray:
    """Relative extinction of cirrus of a cover, shape of the grid. [1]

    Parameters
    ----------
    grid, random, cell, cover, shear
        See ``heaps.heap_extinction``; ``cell`` is the distance between groups of heads.
    """
    groups = power_law_field(grid, random, slope=-3.0, longest=4.0 * cell, stretch=0.7)
    heads = power_law_field(grid, random, longest=_HEADS * cell, stretch=_DRAWN)
    sources = np.exp(0.8 * groups + 2.0 * heads)
    spectrum = np.fft.fft2(sources)
    waves = np.fft.fftfreq(grid.columns, grid.spacing)
    east, north = waves[:, None], waves[None, :]
    below = grid.depth - grid.heights
    layers = np.empty(grid.shape)
    for level, fallen in enumerate(below):
        # as long as two levels, between which extinction is interpolated
        ends = [trail(shear) * max(fallen + side * grid.level, 0.0) ** 2 for side in (-1.0, 1.0)]
        middle, length = 0.5 * (ends[0] + ends[1]), ends[1] - ends[0]
        turned = TURN * trail(shear) * grid.depth
        spread = max(30.0, 0.5 * grid.spacing) + 0.02 * fallen
        response = (
            np.exp(2j * np.pi * (east * middle + north * turned * fallen))
            * np.sinc(east * length + 2.0 * north * turned * grid.level)
            * np.exp(-2.0 * (np.pi * spread) ** 2 * (east**2 + north**2))
        )
        share = fallen / grid.depth
        water = np.minimum(share / _GROWN, 1.0) ** 2 * np.sqrt(1.0 - share)
        layers[:, :, level] = water * np.fft.ifft2(spectrum * response).real
    layers = np.maximum(layers, 0.0)
    columns = layers.sum(axis=2)
    if cover < 1.0:
        edge = np.quantile(columns, 1.0 - cover)
        layers *= np.maximum(1.0 - edge / np.maximum(columns, 1e-30), 0.0)[..., None]
    return np.asarray(layers)
