"""``LightRenderer``: atmosphere and sky of a picture under one light."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.engines.composition.froxels import BAR, CELL, Froxels
from airlight.engines.composition.path_radiance import PathRadiance
from airlight.engines.composition.pinhole import Pinhole
from airlight.engines.composition.placement import PinholeView
from airlight.engines.composition.relight import Relight
from airlight.kernel.threads import run_blocks
from airlight.render.cpu_renderer import CpuRenderer

if TYPE_CHECKING:
    from airlight.render.clouds.before_surfaces import CloudsBefore
    from airlight.render.clouds.clouds_around import CloudsAround
    from airlight.scene import Scene
    from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Pixels of the sky in one block of work.
_BLOCK: Final = 1 << 12


class LightRenderer:
    """Atmosphere and sky of an image under one light."""

    def __init__(
        self,
        scene: Scene,
        solution: MomentsSolution,
        view: PinholeView,
        exact: bool,
        disc: bool,
        clouds: CloudsAround | None,
    ) -> None:
        self._view, self._exact = view, exact
        self._axes = scene.camera.axes
        self.colors = solution.lights[0].colors()
        self._air = PathRadiance(solution, scene)
        self._renderer = CpuRenderer(
            solution,
            scene,
            exact=exact,
            disc=disc,
            clouds=() if clouds is None else clouds.lit(solution, scene),
        )
        self._filled = False
        r = solution.medium.bottom_radius + scene.altitude
        self._relight = Relight(solution, r, scene.sun_direction)
        self._grey = self._air.grey

    def _directions(self, rays: FloatArray) -> FloatArray:
        unit = rays / np.linalg.norm(rays, axis=-1, keepdims=True)
        return np.asarray(unit @ self._axes)

    def _fill(self) -> None:
        """Fill the tables of the renderer once."""
        if not self._filled:
            self._renderer.fill_sky_view()
            self._filled = True

    @cached_property
    def _clouds(self) -> CloudsBefore | None:
        """Clouds before the surfaces."""
        self._fill()
        return self._renderer.clouds_before

    def sky(self, rows: slice, pixels: NDArray[np.bool_]) -> Float32Array:
        """Linear sRGB of sky or ground behind pixels of a band. [W m⁻² sr⁻¹]"""
        self._fill()
        j, i = np.nonzero(pixels)
        px = np.asarray(self._view.left + 0.5 + i, np.float64)
        py = np.asarray(self._view.top + self._view.stretch * (j + rows.start + 0.5), np.float64)
        out = np.empty((px.size, 3), np.float32)

        def run(index: int) -> None:
            part = slice(index * _BLOCK, (index + 1) * _BLOCK)
            self._renderer.render_pixels(px[part], py[part], out[part])

        run_blocks(run, -(-px.size // _BLOCK))
        return out

    def air(
        self, camera: Pinhole, rows: slice, away: FloatArray, solid: NDArray[np.bool_]
    ) -> tuple[FloatArray, FloatArray, tuple[float, float, float]]:
        """Path radiance and transmittance to the surfaces of a band.

        Returns
        -------
        radiance, transmittance : array, shape (n, nl)
            As from ``PathRadiance.before``.
        statistics : (float, float, float)
            Numbers of surfaces and of marched surfaces, and the largest froxel error.
        """
        rays = camera.rays(rows)
        directions = self._directions(rays[solid])
        reached = away[solid]
        n = reached.size
        if n == 0:
            empty = np.empty((0, self.colors.shape[0]))
            return empty, empty, (0.0, 0.0, 0.0)
        finite = np.isfinite(reached)
        if self._exact or not self._air.inside or n < CELL * CELL or not finite.any():
            radiance, transmittance, _ = self._air.before(directions, reached)
            statistics = float(n), float(n), 0.0
        else:
            radiance, transmittance, statistics = self._by_froxels(
                camera, rows, solid, directions, reached
            )
        if self._clouds is not None:
            radiance, transmittance = self._clouds.over(
                directions, reached, radiance, transmittance
            )
        return radiance, transmittance, statistics

    def relit(
        self,
        camera: Pinhole,
        rows: slice,
        away: FloatArray,
        solid: NDArray[np.bool_],
        parts: list[NDArray[Any]],
        transmittance: FloatArray,
    ) -> FloatArray:
        """Linear sRGB of relit surfaces, attenuated by the atmosphere. [W m⁻² sr⁻¹]

        Parameters
        ----------
        camera, rows, away, solid :
            Arguments of ``air``.
        parts : list of array
            Albedo, normals, and visible fraction of the star, of the surfaces.
        transmittance : array, shape (n, nl)
            Transmittance between camera and surfaces. [1]
        """
        albedo, normals, lit = (np.asarray(one, np.float64) for one in parts)
        reached = away[solid]
        # points without depth are placed at the camera to compute their illumination
        points = self._directions(camera.rays(rows)[solid])
        points *= np.where(np.isfinite(reached), reached, 0.0)[:, None]
        turned = normals @ camera.axes.T @ self._axes
        shadow = () if self._clouds is None else self._clouds.on(points)
        light = self._relight.radiance(points, turned, albedo, lit, *shadow)
        return np.asarray((light * transmittance) @ self.colors)

    def _by_froxels(
        self,
        camera: Pinhole,
        rows: slice,
        solid: NDArray[np.bool_],
        directions: FloatArray,
        reached: FloatArray,
    ) -> tuple[FloatArray, FloatArray, tuple[float, float, float]]:
        finite = np.isfinite(reached)
        height = rows.stop - rows.start
        # nodes at the corners of cells, some beyond the picture
        x = CELL * np.arange(-(-camera.width // CELL) + 1.0)
        y = rows.start + CELL * np.arange(-(-height // CELL) + 1.0)
        nodes = camera.rays_at(x, y)
        seen = reached[finite]
        table = Froxels.fill(
            self._air, self._directions(nodes), float(seen.min()), float(seen.max())
        )
        j, i = np.nonzero(solid)
        across, down = (i + 0.5) / CELL, (j + 0.5) / CELL
        read = np.where(finite, reached, table.nearest)
        radiance, transmittance, good = table.read(across, down, read)
        good &= finite
        # the pixel nearest to the middle of each cell
        cell = (j // CELL) * x.size + i // CELL
        off = np.hypot(across % 1.0 - 0.5, down % 1.0 - 0.5) + np.where(good, 0.0, 10.0)
        order = np.lexsort((off, cell))
        first = np.ones(order.size, bool)
        first[1:] = cell[order][1:] != cell[order][:-1]
        probes = order[first]
        probes = probes[good[probes]]
        error = 0.0
        if probes.size:
            light, through, _ = self._air.before(directions[probes], reached[probes])
            wrong = np.abs(radiance[probes] - light)
            wrong += self._grey * np.abs(transmittance[probes] - through)
            wrong = (wrong / np.maximum(light + self._grey * through, 1e-30)).max(axis=1)
            bad = np.zeros(int(cell.max()) + 1, bool)
            bad[cell[probes[wrong > BAR]]] = True
            good &= ~bad[cell]
            error = float(wrong[wrong <= BAR].max(initial=0.0))
        rest = ~good
        if rest.any():
            radiance[rest], transmittance[rest], _ = self._air.before(
                directions[rest], reached[rest]
            )
        return radiance, transmittance, (float(reached.size), float(rest.sum()), error)
