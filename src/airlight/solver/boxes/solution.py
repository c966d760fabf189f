"""``BoxSolution``: light of a box of cloud, and radiance along lines of sight."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import isqrt
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_optics import REFERENCE, CloudOptics
from airlight.errors import ConflictError, ParameterError
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.solver.boxes.beam import BeamCells
from airlight.solver.boxes.directions import degrees, harmonics
from airlight.solver.boxes.forward_peak import peak_depth, peak_table
from airlight.solver.boxes.light import BoxLight
from airlight.solver.boxes.scaled_optics import BoxOptics, overlap, scaled_optics
from airlight.solver.boxes.settings import BoxSettings
from airlight.solver.boxes.view import ViewLines, ViewTables, view_block
from airlight.solver.report import Report

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Lines of sight of a block of work.
_BLOCK: Final = 256


class BoxRays(NamedTuple):
    """Light along lines of sight.

    Attributes
    ----------
    radiance : array, shape (n, w)
        Radiance from the box and the ground over the beam's irradiance. [sr⁻¹]
    transmittance : array, shape (n, w)
        Transmittance of the line for light from behind the box, delta-M scaled. [1]
    distance : array, shape (n,)
        Distance at which the line leaves the box or meets the ground. [m]
    grounded : array of bool, shape (n,)
        Whether it meets the ground.
    """

    radiance: FloatArray
    transmittance: FloatArray
    distance: FloatArray
    grounded: NDArray[np.bool_]


@dataclass(frozen=True, eq=False, kw_only=True)
class BoxSolution:
    """Light of a box, over the irradiance of the beam at its top, normal to it.

    Attributes
    ----------
    field : CloudField
    optics : CloudOptics
    light : BoxLight
    settings : BoxSettings
    levels : array, shape (nz + 1,)
        Altitudes of the edges of the levels: ``below`` levels between ground and field, then those
        of the field. [m]
    moments : array of float32, shape (nx, ny, nz, terms, w)
        Mean moments of the diffuse radiance over a cell, in real spherical harmonics
        (``boxes.directions``) of the direction in which light propagates. [1]
    depth : array of float32, shape (nx, ny, nz)
        Optical depth of the cloud at 550 nm along the beam, from the top of the box to the middle
        of a cell, delta-M scaled; ``depth_factors`` scales it to the wavelengths. [1]
    down, direct : array of float32, shape (nx, ny, w)
        Diffuse and direct irradiance of the ground. [1]
    up : array of float32, shape (nx, ny, w)
        Irradiance upwards at the top. [1]
    absorbed : array, shape (w,)
        Mean power absorbed between ground and top over the horizontal area. [1]
    report : Report
        Provenance; ``energy`` is the energy balance error of a periodic box.
    """

    field: CloudField
    optics: CloudOptics
    light: BoxLight
    settings: BoxSettings
    levels: FloatArray
    moments: Float32Array
    depth: Float32Array
    down: Float32Array
    direct: Float32Array
    up: Float32Array
    absorbed: FloatArray
    report: Report

    @property
    def below(self) -> int:
        """Number of levels below the field."""
        layers: int = self.field.extinction.shape[2]
        return int(self.levels.size) - 1 - layers

    @property
    def degree(self) -> int:
        """Highest degree of the moments."""
        return isqrt(int(self.moments.shape[3])) - 1

    @cached_property
    def scaled(self) -> BoxOptics:
        """Delta-M scaled coefficients on the levels."""
        return scaled_optics(self.optics, self.light.air, self.levels, self.settings.degree)

    @property
    def scaled_at_reference(self) -> float:
        """Scaled extinction of the cloud at 550 nm over the unscaled one. [1]"""
        nm, values = np.asarray(self.optics.wavelengths), self.scaled.cloud
        order = np.argsort(nm)
        return float(np.interp(REFERENCE, nm[order], (values / self._extinction)[order]))

    @property
    def _extinction(self) -> FloatArray:
        return np.maximum(np.asarray(self.optics.extinction, np.float64), 1e-30)

    @property
    def depth_factors(self) -> FloatArray:
        """Scaled depths of the cloud at the wavelengths over ``depth``, shape (w,). [1]"""
        return self.scaled.cloud / self.scaled_at_reference

    @property
    def unscaled_depth(self) -> Float32Array:
        """``depth`` without delta-M scaling. [1]"""
        return self.depth / np.float32(self.scaled_at_reference)

    def radiance(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        *,
        progress: Progress | None = None,
        cancel: Cancel | None = None,
    ) -> FloatArray:
        """Radiance along lines of sight, with the sky beyond if that is a function.

        Parameters
        ----------
        origins : array, shape (n, 3)
            Coordinates in the box: east and north of its middle, and altitude. [m]
        directions : array, shape (n, 3)
            Unit vectors away from the observer. [1]

        Returns
        -------
        array, shape (n, w)
            Radiance over the irradiance of the beam. [sr⁻¹]

        Raises
        ------
        ConflictError
            If the light has a beam of its own, which is not that in a plane.
        """
        rays = self.rays(origins, directions, progress=progress, cancel=cancel)
        if not callable(self.light.sky):
            return rays.radiance
        looking = np.broadcast_to(np.asarray(directions, np.float64), (len(rays.radiance), 3))
        up = (looking[:, 2] > 0.0) & ~rays.grounded
        found = rays.radiance.copy()
        if up.any():
            sky = self.light.sky_at(-looking[up], found.shape[1])
            found[up] += rays.transmittance[up] * sky
        return found

    def rays(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        *,
        progress: Progress | None = None,
        cancel: Cancel | None = None,
    ) -> BoxRays:
        """Light along lines of sight inside the box; parameters as those of ``radiance``."""
        if self.light.beam is not None:
            raise ConflictError("beam", "must be that in a plane, for lines of sight")
        start, looking = np.broadcast_arrays(
            np.atleast_2d(np.asarray(origins, np.float64)),
            np.atleast_2d(np.asarray(directions, np.float64)),
        )
        if start.ndim != 2 or start.shape[1] != 3 or not np.all(np.isfinite(start)):
            raise ParameterError("origins", f"shape {start.shape}", "finite, shape (n, 3)")
        if not np.all(np.abs(np.linalg.norm(looking, axis=1) - 1.0) < 1e-3):
            raise ParameterError("directions", "of another length", "unit vectors, shape (n, 3)")
        count, wavelengths = len(start), self.moments.shape[-1]
        nu = np.clip(looking @ np.array(self.light.towards), -1.0, 1.0)
        lines = ViewLines(
            np.ascontiguousarray(start),
            np.ascontiguousarray(looking),
            harmonics(-looking, self.degree),
            np.ascontiguousarray(self.optics.phase.values(nu, self.optics.wavelengths)),
            np.empty((count, wavelengths)),
            np.empty((count, wavelengths)),
            np.empty(count),
        )
        tables = self._tables
        blocks = -(-count // _BLOCK)
        run_blocks(
            lambda n: view_block(n * _BLOCK, min((n + 1) * _BLOCK, count), lines, tables),
            blocks,
            progress=progress,
            cancel=cancel,
            message="light of clouds",
        )
        return BoxRays(
            lines.radiance, lines.transmittance, np.abs(lines.distance), lines.distance < 0.0
        )

    @cached_property
    def _tables(self) -> ViewTables:
        field, light, scaled = self.field, self.light, self.scaled
        nx, ny, _ = field.extinction.shape
        clear = np.zeros((self.below, ny, nx), np.float32)
        cells = BeamCells(
            np.ascontiguousarray(np.concatenate([clear, field.extinction.transpose(2, 1, 0)])),
            self.levels,
            (field.west, field.south),
            (float(field.spacing[0]), float(field.spacing[1])),
            field.beyond == "periodic",
            self.below,
            field.interpolated,
            0.0,
        )
        thickness = np.diff(self.levels)[:, None]
        above = np.cumsum((scaled.air * thickness)[::-1], axis=0)[::-1]
        return ViewTables(
            cells,
            self.moments,
            degrees(self.degree),
            scaled.cloud,
            scaled.cloud_single,
            np.ascontiguousarray(scaled.cloud_source[: self.degree + 1]),
            scaled.air,
            np.ascontiguousarray(scaled.air_source[:, : self.degree + 1]),
            self._air_phase,
            np.concatenate([above, np.zeros((1, above.shape[1]))]),
            self.down,
            np.broadcast_to(light.albedo, (self.moments.shape[-1],)).astype(np.float64),
            (light.towards[0], light.towards[1], light.cosine),
            peak_table(self.optics, self.settings.degree),
            peak_depth(self.optics, self.settings.degree),
        )

    @property
    def _air_phase(self) -> FloatArray:
        """Scattering of the air by degree, see ``ViewTables.air_phase``."""
        air = self.light.air
        if air is None:
            return np.zeros((self.levels.size - 1, 1, self.moments.shape[-1]))
        degree = np.arange(air.moments.shape[-1])
        scattering = (air.extinction * air.albedo)[..., None] * air.moments
        scattering = scattering * (2 * degree + 1) / (4.0 * np.pi)
        return np.ascontiguousarray(
            np.einsum("kn,nwl->klw", overlap(air.edges, self.levels), scattering)
        )
