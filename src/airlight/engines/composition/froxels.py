"""Froxels: path radiance and transmittance on a grid of screen cells and distances.

Nodes hold, per wavelength, path radiance and optical depth over distance, which are smooth in thin
and saturated air. Interpolation is linear across the screen and cubic in the logarithm of distance.
One pixel of each cell is marched to measure the error; cells above the tolerance, and pixels with
nodes at the ground or the top of the atmosphere, are marched completely.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.engines.composition.path_radiance import PathRadiance
from airlight.kernel import compiled_loop
from airlight.kernel.threads import run_blocks
from airlight.physics.cubic_curves import catmull_rom

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Pixels between nodes.
CELL: Final = 16
#: Steps of distance over a factor of ten.
STEPS: Final = 16
#: Largest error of a cell, relative to the light of a grey surface behind its path.
BAR: Final = 2e-3
#: Most nodes of distance; nearer surfaces are marched.
_MOST: Final = 96
#: Pixels of one block of work.
_BLOCK: Final = 1 << 14


@dataclass(frozen=True, eq=False)
class Froxels:
    """Froxel grid of a band of rows.

    Attributes
    ----------
    nearest : float
        Distance of the second node. [m]
    values : array, shape (rows, columns, distances, 2·nl), float32
        Radiance over distance [sr⁻¹ m⁻¹] and optical depth over distance [m⁻¹].
    usable : array of bool, shape (rows, columns, distances)
        Whether the segment of a node ends inside the atmosphere.
    """

    nearest: float
    values: Float32Array
    usable: NDArray[np.bool_]

    @classmethod
    def fill(
        cls, air: PathRadiance, directions: FloatArray, nearest: float, farthest: float
    ) -> Froxels:
        """Fill all nodes by marching.

        Parameters
        ----------
        air : PathRadiance
            Path radiance in front of the observer.
        directions : array, shape (rows, columns, 3)
            Unit vectors of the nodes of the screen, in the observer's local frame. [1]
        nearest, farthest : float
            Distances between which the table is to be read. [m]
        """
        steps = int(np.ceil(STEPS * np.log10(max(farthest / nearest, 1.0)))) + 1
        steps = min(steps, _MOST)
        nearest = max(nearest, farthest * 10.0 ** (-(steps - 1) / STEPS))
        # one node before the nearest and one beyond the farthest, which the cubic needs
        distance = nearest * 10.0 ** (np.arange(-1, steps + 1) / STEPS)
        rows, columns = directions.shape[:2]
        every = np.repeat(directions.reshape(-1, 3), distance.size, axis=0)
        away = np.tile(distance, rows * columns)
        light, through, whole = air.before(every, away, below=True)
        depth = -np.log(np.maximum(through, 1e-35))
        values = np.concatenate([light, depth], axis=-1) / away[:, None]
        shape = (rows, columns, distance.size)
        return cls(
            nearest,
            np.ascontiguousarray(values.reshape(*shape, -1), np.float32),
            ~whole.reshape(shape),
        )

    def read(
        self, x: FloatArray, y: FloatArray, distances: FloatArray
    ) -> tuple[FloatArray, FloatArray, NDArray[np.bool_]]:
        """Interpolate the grid.

        Parameters
        ----------
        x, y : array, shape (n,)
            Screen positions from the upper left node. [nodes]
        distances : array, shape (n,)
            Distances. [m]

        Returns
        -------
        radiance, transmittance, usable :
            As from ``PathRadiance.before``, shape (n, nl), and whether all nodes around are
            usable, shape (n,).
        """
        count = self.values.shape[3] // 2
        out = np.empty((x.size, 2 * count), np.float32)
        good = np.empty(x.size, np.bool_)
        z = np.log10(distances / self.nearest) * STEPS + 1.0

        def run(index: int) -> None:
            part = slice(index * _BLOCK, (index + 1) * _BLOCK)
            _read(x[part], y[part], z[part], self.values, self.usable, out[part], good[part])

        run_blocks(run, -(-x.size // _BLOCK))
        amounts = out.astype(np.float64) * distances[:, None]
        return amounts[:, :count], np.exp(-np.maximum(amounts[:, count:], 0.0)), good


@compiled_loop
def _read(x, y, z, values, usable, out, good):
    """Interpolation: linear in x and y, Catmull-Rom in z."""
    rows, columns, steps, lanes = values.shape
    for k in range(x.size):
        i = min(max(int(x[k]), 0), columns - 2)
        j = min(max(int(y[k]), 0), rows - 2)
        s = int(z[k])
        good[k] = 1 <= s <= steps - 3 and z[k] >= 1.0
        s = min(max(s, 1), steps - 3)
        e, f, t = x[k] - i, y[k] - j, z[k] - s
        for lane in range(lanes):
            out[k, lane] = np.float32(0.0)
        for node in range(4):
            cubic = catmull_rom(node, t)
            for corner in range(4):
                right, down = corner % 2, corner // 2
                weight = np.float32(cubic * (e if right else 1.0 - e) * (f if down else 1.0 - f))
                at = s - 1 + node
                if not usable[j + down, i + right, at]:
                    good[k] = False
                for lane in range(lanes):
                    out[k, lane] += weight * values[j + down, i + right, at, lane]
