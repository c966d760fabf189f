"""Solution of an atmosphere in the shadow of a moon, for points and directions in space."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.geometry.occulted_star import OccultedStar
from airlight.kernel import compiled_loop
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.kernel.without_refcount import without_refcount
from airlight.solver.eclipsed.eclipsed_field import eclipsed_field
from airlight.solver.eclipsed.eclipsed_march import (
    TOTAL,
    EclipsedLine,
    eclipsed_ground_light,
    line_eclipsed,
    new_eclipse,
)
from airlight.solver.eclipsed.shadow_tables import ShadowTables, shadow_axes
from airlight.solver.lines_of_sight import enter_shell
from airlight.solver.moments.packing import pack

if TYPE_CHECKING:
    from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Lines of sight in one block of work.
_BLOCK: Final = 256


class EclipsedSolution:
    """Radiance of a planet while a moon occults part of the star.

    Parameters
    ----------
    solution : MomentsSolution
        Unshadowed solution of the planet.
    star : OccultedStar
        Star and moon, in any frame around the planet's centre.
    cache : bool
        Whether to read the field from the cache on disk, and to write it there.

    Attributes
    ----------
    axes : array, shape (3, 3)
        Axes of the shadow's frame in that of ``star``, as rows. [1]
    """

    def __init__(
        self,
        solution: MomentsSolution,
        star: OccultedStar,
        *,
        cache: bool = True,
        progress: Progress | None = None,
        cancel: Cancel | None = None,
    ) -> None:
        self.solution = solution
        self.axes = shadow_axes(star)
        drawn = solution.geometry.medium.bottom_radius
        scale = solution.medium.bottom_radius / drawn
        self._star = star.moved(self.axes, scale)
        self.shadow: ShadowTables = eclipsed_field(
            solution, self._star, cache=cache, progress=progress, cancel=cancel
        )

    def relative_radiance(self, points: ArrayLike, directions: ArrayLike) -> FloatArray:
        """Radiance per irradiance of the unshadowed star, shape (n, nl). [sr⁻¹]

        Parameters
        ----------
        points : array, shape (n, 3)
            Observers, from the planet's centre. [m]
        directions : array, shape (n, 3)
            Unit vectors. [1]
        """
        solution, geometry = self.solution, self.solution.geometry
        at = np.atleast_2d(np.asarray(points, float)) @ self.axes.T
        along = np.atleast_2d(np.asarray(directions, float)) @ self.axes.T
        at, along = (np.ascontiguousarray(one) for one in np.broadcast_arrays(at, along))
        r = np.linalg.norm(at, axis=-1)
        up = at / r[:, None]
        towards = np.array([self._star.star_x, self._star.star_y, self._star.star_z])
        mu = np.clip(np.einsum("nk,nk->n", up, along), -1.0, 1.0)
        sine = np.linalg.norm(np.cross(up, along), axis=-1)
        lines = enter_shell(
            r,
            mu,
            sine,
            np.clip(up @ towards, -1.0, 1.0),
            np.clip(along @ towards, -1.0, 1.0),
            solution.medium.bottom_radius,
            solution.medium.top_radius,
        )
        drawn = geometry.optical_lines(lines)
        seen = geometry.apparent_nu(drawn)
        half_sine = np.sqrt(np.maximum(0.5 * (1.0 - seen), 0.0))
        phase = pack(geometry.medium.phase_function(seen))
        way = np.where(r > solution.medium.top_radius, _way(r, mu, sine, solution), 0.0)
        start = at + way[:, None] * along
        start *= (drawn.r / np.linalg.norm(start, axis=-1))[:, None]
        count = solution.wavelengths.size
        out = np.zeros((r.size, count))

        def run(index: int) -> None:
            rows = slice(index * _BLOCK, (index + 1) * _BLOCK)
            result = np.zeros((drawn.r[rows].size, solution.tables.lanes), np.float32)
            lengths = np.stack([drawn.length[rows], half_sine[rows]], axis=-1)
            eclipse = new_eclipse(solution.tables, self.shadow)
            ends = drawn.to_ground[rows]
            _lines(start[rows], along[rows], lengths, ends, phase[rows], eclipse, result)
            out[rows] = result[:, :count]

        run_blocks(run, -(-r.size // _BLOCK))
        return out

    def relative_ground_irradiance(self, points: ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Direct and diffuse irradiance of the ground, per that of the unshadowed star.

        Parameters
        ----------
        points : array, shape (n, 3)
            Directions, or points, from the planet's centre, projected onto the ground.

        Returns
        -------
        star, sky : array, shape (n, nl)
            Irradiances. [1]
        """
        at = np.atleast_2d(np.asarray(points, float)) @ self.axes.T
        tables = self.solution.tables
        at *= (tables.bottom / np.linalg.norm(at, axis=-1))[:, None]
        out = np.empty((len(at), 2, tables.lanes), np.float32)
        _ground(at, new_eclipse(tables, self.shadow), out)
        found = out[:, :, : self.solution.wavelengths.size].astype(float)
        return found[:, 0], found[:, 1]


def _way(r: FloatArray, mu: FloatArray, sine: FloatArray, solution: MomentsSolution) -> FloatArray:
    top = solution.medium.top_radius
    square = np.maximum(top * top - np.square(r * sine), 0.0)
    return np.asarray(np.maximum(-r * mu - np.sqrt(square), 0.0))


@compiled_loop
def _lines(start, along, lengths, to_ground, phase, eclipse, out):
    lanes = eclipse.tables.lanes
    eclipse = without_refcount(eclipse)
    result = np.empty((2, lanes), np.float32)
    for k in range(to_ground.size):
        a, b, length, half_sine = start[k], along[k], lengths[k, 0], lengths[k, 1]
        line = EclipsedLine(a[0], a[1], a[2], b[0], b[1], b[2], length, half_sine)
        if line.length <= 0.0 and not to_ground[k]:
            continue
        line_eclipsed(line, to_ground[k], TOTAL, phase[k], eclipse, result)
        out[k] = result[0]


@compiled_loop
def _ground(at, eclipse, out):
    eclipse = without_refcount(eclipse)
    for k in range(at.shape[0]):
        eclipsed_ground_light(at[k, 0], at[k, 1], at[k, 2], TOTAL, eclipse)
        out[k] = eclipse.work.irradiance
