"""Grid, rays and optics derived from a medium, shared by CPU, GPU and browser.

``Setup`` is shared by all wavelengths; ``WavelengthBatch`` adds those that are solved together.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import acos, pi
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel.cache import Cache
from airlight.kernel.lanes import HALF_LANES
from airlight.physics.optics.density_profile import DensitySegments
from airlight.solver.layered_columns import column_radii
from airlight.solver.moments.adaptive_quadrature import adaptive_quadrature
from airlight.solver.moments.convergence import lateral_threshold_of
from airlight.solver.moments.delta_m import Optics, panel_ends
from airlight.solver.moments.grid import MomentsGrid, make_grid
from airlight.solver.moments.harmonics import Harmonics, harmonics, moment_count
from airlight.solver.moments.levels import FEW_NODES
from airlight.solver.moments.opaque_culling import cull_opaque
from airlight.solver.moments.packing import (
    day_weight,
    filled,
    level_weights,
    optically_thick_weights,
)
from airlight.solver.moments.ray_optics import Azimuths, ScaledOptics, SweepTables
from airlight.solver.moments.rays import Rays, trace_rays
from airlight.solver.moments.settings import MomentsSettings
from airlight.solver.refracted_geometry import RefractedGeometry
from airlight.solver.tables.column_ratios import column_rows, rational_mean_density
from airlight.solver.tables.columns import ColumnTable

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Transport optical depth above which numerical diffusion between sun elevations exceeds physical
#: diffusion. Titan has 13 in the blue, Venus 12 to 100. [1]
OPTICALLY_DEEP: Final = 20.0
#: Length of numerical diffusion by interpolation between sun elevations, over the lateral diffusion
#: length and the transport optical depth. [1]
NUMERICAL_DIFFUSION: Final = 6.0 / pi**2
#: Largest scattering eigenvalue of moments aliased by the azimuthal quadrature; that of an aliased
#: pair is twice as large. [1]
_ALIASED: Final = 0.4
#: Distance of a thin layer from the top, over the thickness of the shell, below which the column
#: table has more directions, and their factor.
_CLOSE_TO_TOP: Final = 0.05
_MORE_DIRECTIONS: Final = 8
#: Number of column tables in the cache: edits of coefficients do not change them.
_CACHE_SIZE: Final = 4

_TABLES: Final[Cache[Any, tuple[ColumnTable, FloatArray]]] = Cache(_CACHE_SIZE)


@dataclass(frozen=True, kw_only=True, eq=False)
class Setup:
    """Degree, grid, rays and tables of a solve, evaluated lazily.

    Parameters
    ----------
    geometry : RefractedGeometry
        Refracted geometry of a medium with any number of wavelengths and constituents.
    settings : MomentsSettings
        Grid sizes and tolerance.
    extinction_headroom : float
        Factor of the extinction for which grid and rays are made; above 1 if they are reused after
        edits that increase extinction. [1]
    """

    geometry: RefractedGeometry
    settings: MomentsSettings
    extinction_headroom: float = 1.0

    @property
    def medium(self) -> Medium:
        """Medium in the optical radius."""
        return self.geometry.medium

    @cached_property
    def optics(self) -> Optics:
        """Optics of the medium, truncated at the degree of the harmonics."""
        return Optics.chosen(self.medium, self.settings)

    @property
    def degree(self) -> int:
        """Degree of the harmonics."""
        return self.optics.degree

    @property
    def terms(self) -> int:
        """Number of moments of a node."""
        return moment_count(self.degree)

    @cached_property
    def _nodes(self) -> tuple[MomentsGrid, int]:
        medium, settings, depths = self.medium, self.settings, self.optics.depths
        return make_grid(
            medium.bottom_radius,
            medium.top_radius,
            settings.radii,
            settings.sun_angles,
            depths._replace(scattering=self.extinction_headroom * depths.scattering),
            medium.density.first_nodes,
        )

    @property
    def grid(self) -> MomentsGrid:
        """Nodes in radius and in sun elevation."""
        return self._nodes[0]

    @property
    def refinement(self) -> int:
        """Number of levels of the grid per radius of the sweep."""
        return self._nodes[1]

    @cached_property
    def gathering(self) -> MomentsGrid:
        """Grid with only the radii of the sweep."""
        return self.grid._replace(radii=self.grid.radii[:: self.refinement])

    @cached_property
    def dip(self) -> float:
        """Dip of the horizon, seen from the top of the shell. [rad]"""
        return acos(self.grid.bottom_radius / self.grid.top_radius)

    @cached_property
    def ends(self) -> FloatArray:
        """Altitudes at which panels of a sweep's rays end. [m]"""
        return panel_ends(self.medium, self.grid, self.refinement, sweeps=True)

    @cached_property
    def march_ends(self) -> FloatArray:
        """Altitudes at which panels of lines of sight end. [m]"""
        return panel_ends(self.medium, self.grid, self.refinement)

    @property
    def zenith_angles(self) -> tuple[int, ...]:
        """Numbers of directions on each side of the horizon, as for ``directions``."""
        settings = self.settings
        if self.refinement > 1:
            # From the top of a high shell the bright air ends far above the horizon of the ground.
            depression = 1.0 - (self.grid.bottom_radius / self.grid.top_radius) ** 2
            return (settings.zenith_angles + int(depression * settings.zenith_angles),)
        # n points integrate polynomials of degree 2n - 1, so all harmonics of isotropic light.
        return settings.horizon_angles, max(settings.high_angles, (self.degree + 2) // 2)

    @property
    def ray_nodes(self) -> int:
        """Points per panel of a sweep's ray."""
        if self.refinement > 1:
            return min(self.settings.nodes, FEW_NODES)
        if self.ends.size and not self.optics.depths.layers:
            # Several panels per leg need fewer points each.
            return max(FEW_NODES, 3 * self.settings.nodes // 5)
        return self.settings.nodes

    @cached_property
    def rays(self) -> Rays:
        """Rays of a sweep, for all wavelengths."""
        return trace_rays(
            self.gathering,
            self.medium.density,
            self.extinction_headroom * self.medium.extinction.max(axis=1),
            self.zenith_angles,
            self.ray_nodes,
            refraction_strength=self.geometry.refraction_strength,
            ends=self.ends,
        )

    @cached_property
    def azimuths(self) -> Azimuths:
        """Azimuthal quadrature of a sweep.

        On B midpoints cos mφ is aliased with -cos (2B - m)φ, so that order m is counted twice. If
        the phase moments above B are small, as without forward peaks, three quarters of the degree
        suffice; with large ones, as of backward peaks, the iteration would diverge.
        """
        count = max(self.settings.azimuths, 3 * self.degree // 4)
        if self.optics.largest_moment_beyond(count) > _ALIASED:
            count = max(count, self.degree + 1)
        return even_azimuths(self.degree, count)

    @cached_property
    def expansion(self) -> Harmonics:
        """Harmonics of the moments."""
        return harmonics(self.degree)

    @cached_property
    def column_radii(self) -> FloatArray:
        """Radii of the rows of the table of columns to the star. [m]"""
        return column_radii(self.medium, self.settings.column_radii)

    @property
    def column_directions(self) -> int:
        """Number of directions of the table of columns; more if a thin layer lies close to the top.

        There directions uniform in the distance to the top would not resolve the layer.
        """
        highest = max((layer.bottom for layer in self.optics.depths.layers), default=0.0)
        close = highest > (1.0 - _CLOSE_TO_TOP) * self.medium.thickness
        return self.settings.column_directions * (_MORE_DIRECTIONS if close else 1)

    @property
    def table_shape(self) -> tuple[int, int, int]:
        """Shape of the table of columns to the star."""
        constituents = self.medium.density.edges.shape[0]
        return self.column_radii.size, self.column_directions, constituents

    @cached_property
    def _columns(self) -> tuple[ColumnTable, FloatArray]:
        medium = self.medium
        return _columns(
            medium.bottom_radius,
            medium.top_radius,
            medium.density,
            self.column_radii,
            self.column_directions,
        )

    @property
    def table(self) -> ColumnTable:
        """Table of columns to the star."""
        return self._columns[0]

    @cached_property
    def column_rows(self) -> FloatArray:
        """Fractional rows of the table of columns at the altitude nodes, shape (n,). [1]"""
        return column_rows(self.table, self.medium.density)

    @property
    def ratios(self) -> FloatArray:
        """Column table for rational interpolation. [1]"""
        return self._columns[1]

    @cached_property
    def star_ratios(self) -> Float32Array:
        """``ratios`` with directions last, for lanes, shape (radii, nc, 2, directions). [1]"""
        return np.ascontiguousarray(self.ratios.transpose(0, 2, 3, 1), np.float32)

    @property
    def day_weight(self) -> FloatArray:
        """Level weights in the thick limit, shape (s,): 0 at night, 1 by day. [1]"""
        return day_weight(self.grid.sun_cosines, self.dip)

    def level(self, which: slice) -> Float32Array:
        """Level weights of some wavelengths in groups of eight, shape (s, 8). [1]"""
        depth = self.optics.scattering_depth[which]
        return np.asarray(filled(level_weights(self.grid.sun_cosines, self.dip, depth)))

    def batch(self, which: slice) -> WavelengthBatch:
        """Batch of wavelengths.

        Parameters
        ----------
        which : slice
            Indices of at most eight wavelengths.
        """
        air = self.optics.air(which)
        rays = (
            adaptive_quadrature(self.rays, air, self.ray_nodes)
            if self.refinement > 1
            else self.rays
        )
        rays, norm = cull_opaque(rays, air)
        transport = self.optics.transport_depth[which]
        thick = filled(optically_thick_weights(self.optics.scattering_depth[which]))
        length = self.optics.depths.diffusion_length
        radius = self.medium.bottom_radius
        return WavelengthBatch(
            setup=self,
            which=which,
            air=air,
            rays=rays,
            norm=norm,
            level=self.level(which),
            thick=thick,
            lateral_threshold=np.array(
                [lateral_threshold_of(*one) for one in zip(filled(transport), thick, strict=True)]
            ),
            # Diffusion: a layer of transport depth τ loses π²/(3τ²) of its energy per scattering.
            diffusion_length=length / radius,
            grid_diffusion=NUMERICAL_DIFFUSION * length / radius * float(transport.max()),
            deep=bool(transport.max() > OPTICALLY_DEEP),
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class WavelengthBatch:
    """Wavelengths that are solved together, one per lane.

    Attributes
    ----------
    setup : Setup
        Set-up that all wavelengths share.
    which : slice
        Indices of these wavelengths among all.
    air : ScaledOptics
        Optics of these wavelengths.
    rays : Rays
        Rays without points that are opaque at all of these wavelengths.
    norm : array, shape (r·a·8,)
        Normalisation factors from ``cull_opaque``. [1]
    level : array, shape (s, 8)
        Weights from ``level_weights``. [1]
    thick : array, shape (8,)
        Weight from ``optically_thick_weights``, 0 to 1: exponent of ``convergence.count_at``. [1]
    lateral_threshold : array, shape (8,)
        Fraction of the largest mean radiance below which lateral transport dominates. [1]
    diffusion_length, grid_diffusion : float
        Lateral diffusion length, and the length of the numerical diffusion by interpolation
        between sun elevations, see ``lateral_diffusion_matrix``. [rad]
    deep : bool
        Whether the transport optical depth at any of these wavelengths exceeds ``OPTICALLY_DEEP``.
    """

    setup: Setup
    which: slice
    air: ScaledOptics
    rays: Rays
    norm: Float32Array
    level: Float32Array
    thick: FloatArray
    lateral_threshold: FloatArray
    diffusion_length: float
    grid_diffusion: float
    deep: bool

    @property
    def used(self) -> int:
        """Number of wavelengths; further lanes are padding."""
        return len(range(*self.which.indices(self.setup.medium.wavelengths.size)))

    @property
    def all_degrees(self) -> NDArray[np.int64]:
        """Untruncated degree at each radius of the grid."""
        return np.full(self.setup.grid.radii.size, self.setup.degree)

    @property
    def sweep_tables(self) -> SweepTables:
        """Constants of the sweeps of these wavelengths."""
        setup = self.setup
        return SweepTables(
            setup.grid, self.rays, self.norm, setup.azimuths, self.air, setup.expansion
        )

    @property
    def narrow(self) -> bool:
        """Whether half of the lanes holds all wavelengths, so that a register has two moments."""
        return self.used <= HALF_LANES


def even_azimuths(degree: int, count: int) -> Azimuths:
    """Midpoints of ``count`` even steps over half a turn."""
    phi = (np.arange(count) + 0.5) * (pi / count)
    multiples = np.cos(np.arange(degree + 1)[:, None] * phi) * (2.0 * pi / count)
    sines = np.sin(np.arange(3)[:, None] * phi) * (2.0 * pi / count)
    return Azimuths(np.cos(phi), multiples.astype(np.float32), sines.astype(np.float32))


def _columns(
    bottom: float, top: float, density: DensitySegments, radii: FloatArray, directions: int
) -> tuple[ColumnTable, FloatArray]:
    """Column table and its form for rational interpolation, from a cache."""
    profiles = density.edges.tobytes(), density.coefficients.tobytes()
    key = (bottom, top, directions, radii.tobytes(), *profiles)

    def made() -> tuple[ColumnTable, FloatArray]:
        table = ColumnTable.build(bottom, top, density, (radii.size, directions), radii)
        return table, rational_mean_density(table)

    return _TABLES.of(key, made)
