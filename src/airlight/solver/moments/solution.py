"""Solution of the moments solver: radiance by ray marches through the moments."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Self

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.geometry.refraction import refraction_angle, turned
from airlight.geometry.vectors import Vec3, start_vectors
from airlight.image.upsampling import reflectance_basis
from airlight.kernel import compiled_loop
from airlight.kernel.lanes import LANES, lane_view, load
from airlight.kernel.threads import run_blocks
from airlight.kernel.without_refcount import without_refcount
from airlight.physics.optics.reflection import cos_reflected
from airlight.planets.light_source import LightSource
from airlight.planets.without_clouds import check_clear
from airlight.solver.lines_of_sight import LinesOfSight
from airlight.solver.moments.energy_balance import imbalance
from airlight.solver.moments.forward_peak import inverse_peak_fraction, peak_broadening
from airlight.solver.moments.irradiance import (
    direct_irradiance,
    direct_normal_irradiance,
    ground_radiance,
    sky_irradiance,
)
from airlight.solver.moments.iterate import FALLBACK_SCHEMES, Moments
from airlight.solver.moments.march import march, ring_shade_on
from airlight.solver.moments.march_tables import (
    MarchTables,
    MarchTerms,
    Segment,
    new_workspace,
    quadratures,
)
from airlight.solver.moments.packing import filled, pack, pack_light
from airlight.solver.moments.settings import MomentsSettings
from airlight.solver.moments.setup import Setup
from airlight.solver.refracted_geometry import RefractedGeometry
from airlight.solver.report import Report
from airlight.solver.solution import Solution
from airlight.solver.tables.column_ratios import column_rows, rational_mean_density
from airlight.solver.tables.columns import ColumnTable, density_table
from airlight.solver.tables.ring_shadow import Rings, ring_line, ring_tables

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Range of altitudes in which a layer boundary needs ``cut_nodes``, over the shell's thickness. [1]
_MIDDLE = (0.05, 0.5)
#: Number of blocks of work, for load balancing, and limits of the lines of sight in a block.
_SHARES, _FEWEST, _MOST = 8, 256, 2048


def _face(source: LightSource) -> Float32Array:
    """Table ``MarchTables.face`` of a source; one texel without a face."""
    count = source.wavelengths.size
    if source.face is None:
        return pack(np.ones((1, 1, count)))
    return pack(source.face @ reflectance_basis(source.wavelengths).T)


def moments_solution(given: Solution, consumer: str) -> MomentsSolution:
    """The same solution, for a consumer that reads its moments.

    Raises
    ------
    ConflictError
        If its planet has three-dimensional clouds: it is a mean of independent columns.
    ParameterError
        If it is of another solver.
    """
    if isinstance(given, MomentsSolution):
        return given
    if isinstance(given, Solution) and given.planet is not None:
        check_clear(given.planet, consumer)
    name = given.report.solver if isinstance(given, Solution) else type(given).__name__
    raise ParameterError("solution", name, "a solution of the moments solver")


class MomentsSolution(Solution):
    """Solution by the moments solver.

    Parameters
    ----------
    medium : Medium
        Solved medium.
    settings : MomentsSettings
        Grid sizes and tolerance.
    moments : Moments
        Result of the iteration.
    seconds : float
        Wall time of the solve; 0 from the cache. [s]
    geometry : RefractedGeometry, optional
        Refracted geometry of the medium, if known.
    """

    def __init__(
        self,
        medium: Medium,
        settings: MomentsSettings,
        moments: Moments,
        seconds: float,
        geometry: RefractedGeometry | None = None,
    ) -> None:
        self.medium = medium
        self.geometry = RefractedGeometry.of(medium) if geometry is None else geometry
        self.settings = settings
        self.moments = moments
        unbalanced = imbalance(moments.energy, medium.wavelengths, settings.energy_tolerance)
        self.report = Report(
            solver="moments",
            settings=f"{settings.as_text()} degree_used={moments.degree}",
            sweeps=moments.sweeps,
            residual=tuple(float(x) for x in moments.residual),
            seconds=seconds,
            energy=tuple(float(x) for x in moments.energy),
            note="; ".join(
                one for one in (FALLBACK_SCHEMES[moments.scheme].note, unbalanced) if one
            ),
        )

    @cached_property
    def setup(self) -> Setup:
        """Grid, rays and optics derived from the medium, evaluated lazily."""
        return Setup(geometry=self.geometry, settings=self.settings)

    def with_light(self, source: LightSource, *, secondary: bool = False) -> Self:
        """Solution under another light source; see ``Solution``."""
        tables = self.tables._replace(
            star_radius=source.angular_radius,
            darkening=pack(source.darkenings.T),
            face=_face(source),
        )
        other = super().with_light(source, secondary=secondary)
        other.geometry = replace(self.geometry, medium=self.geometry.medium.with_light(source))
        other.tables = tables  # all else is independent of the source
        return other

    @cached_property
    def tables(self) -> MarchTables:
        """Tables of the ray march, for all wavelengths, with the quadrature of queries."""
        moments, medium, settings = self.moments, self.geometry.medium, self.settings
        level, expansion, grid = self.setup.level(slice(None)), self.setup.expansion, moments.grid
        field, sky = pack_light(
            filled(moments.field), filled(moments.sky), level, moments.refinement
        )
        shell = medium.bottom_radius, medium.top_radius
        table = ColumnTable(*shell, self.setup.column_radii, moments.columns)
        optics = self.setup.optics
        air, broadening = optics.air(slice(None)), peak_broadening(optics)
        ends = self.setup.march_ends
        low, high = (part * medium.thickness for part in _MIDDLE)
        cut = bool(((ends > low) & (ends < high)).any())
        return MarchTables(
            bottom=grid.bottom_radius,
            top=grid.top_radius,
            star_radius=self.lights[0].angular_radius,
            refraction_strength=self.geometry.refraction_strength,
            lanes=air.ground.albedo.size,
            panels=settings.cut_panels if cut else settings.march_panels,
            culls_opaque=1,
            constituents=len(medium.names),
            degree=expansion.degree,
            radii=grid.radii.size,
            sun_angles=grid.sun_cosines.size,
            phase_nodes=medium.phase_table.shape[2],
            separated_1=-1,
            separated_2=-1,
            broadened=broadening is not None,
            first_nodes=medium.density.first_nodes,
            column_rows=column_rows(table, medium.density),
            columns=rational_mean_density(table),
            density=density_table(medium.density),
            strongest=medium.extinction.max(axis=1),
            brightest=medium.scattering.max(axis=1),
            refraction_table=self.geometry.refraction_table,
            ends=ends,
            row=grid.row,
            place=grid.place,
            start=expansion.start,
            ahead=expansion.ahead,
            back=expansion.back,
            rules=quadratures(settings.cut_nodes if cut else (settings.march_nodes,) * 4),
            scaled_extinction=air.extinction,
            extinction=pack(medium.extinction),
            scattering=pack(medium.scattering),
            moments=air.moments,
            polarised_moments=air.polarised_moments,
            phase=pack(np.moveaxis(medium.phase_table, 2, 0)),
            phase_f12=pack(self._phase_f12(medium)),
            inverse_peak_fraction=pack(inverse_peak_fraction(optics)),
            broadening=pack(
                np.zeros((1, 1, self.wavelengths.size)) if broadening is None else broadening
            ),
            darkening=pack(self.lights[0].darkenings.T),
            face=_face(self.lights[0]),
            basis=pack(medium.map_basis.T),
            field=field,
            sky=sky,
            ground=air.ground,
            rings=_rings(medium),
        )

    def _phase_f12(self, medium: Medium) -> FloatArray:
        """Elements F₁₂ of the phase matrices on the nodes of the phase table, (nodes, nc, nl)."""
        nodes, constituents = medium.phase_table.shape[2], len(medium.names)
        if not self.polarised:
            return np.zeros((nodes, constituents, self.wavelengths.size))
        return medium.phase_f12(1.0 - 2.0 * np.linspace(0.0, 1.0, nodes) ** 2)

    @property
    def polarised(self) -> bool:
        """See ``Solution``."""
        return self.settings.polarisation

    @property
    def shaded_by_rings(self) -> bool:
        """See ``Solution``."""
        return True

    def relative_stokes(self, lines: LinesOfSight, *, order: int | None = None) -> FloatArray:
        """See ``Solution``; all orders, or only the first."""
        orders = 2 if order is None else 1
        return self._lines(
            self.geometry.optical_lines(lines), orders, self.tables, None, True, stokes=True
        )[2]

    def relative_radiance(self, lines: LinesOfSight, *, order: int | None = None) -> FloatArray:
        """See ``Solution``; all orders, or only the first."""
        return self.radiance_per_irradiance(lines, 2 if order is None else 1)

    def radiance_per_irradiance(
        self,
        lines: LinesOfSight,
        orders: int,
        *,
        tables: MarchTables | None = None,
        scatterers: Sequence[int] | None = None,
        ground: bool = True,
    ) -> FloatArray:
        """Radiance, or a component of it, per irradiance of the star along lines of sight.

        Parameters
        ----------
        lines : LinesOfSight
            n lines of sight.
        orders : int
            1: first order of scattering and reflection; 0: all higher orders; 2: both.
        tables : MarchTables, optional
            Modified tables, instead of ``self.tables``.
        scatterers : sequence of int, optional
            Constituents of single scattering; default: all.
        ground : bool
            Whether to include the radiance of the ground.

        Returns
        -------
        array, shape (n, nl)
            Radiance. [sr⁻¹]
        """
        lines = self.geometry.optical_lines(lines)
        chosen = self.tables if tables is None else tables
        return self._lines(lines, orders, chosen, scatterers, ground)[0]

    def path_and_total_radiance(
        self, lines: LinesOfSight, orders: int
    ) -> tuple[FloatArray, FloatArray]:
        """Path radiance, and total radiance with that of the ground.

        Returns
        -------
        air, whole : array, shape (n, nl)
            Radiance per irradiance of the star. [sr⁻¹]
        """
        whole, _, _, air = self._lines(
            self.geometry.optical_lines(lines), orders, self.tables, None, True
        )
        return air, whole

    def segments(
        self, lines: LinesOfSight, length: FloatArray, *, tables: MarchTables | None = None
    ) -> tuple[FloatArray, FloatArray]:
        """Path radiance and transmittance of segments of lines of sight.

        Parameters
        ----------
        lines : LinesOfSight
            n lines of sight, from ``geometry.optical_lines``.
        length : array, shape (n,)
            Lengths in the optical radius, from ``geometry.optical_length``, at most those of the
            lines. [m]

        Returns
        -------
        radiance : array, shape (n, nl)
            Path radiance per irradiance of the star, all orders. [sr⁻¹]
        transmittance : array, shape (n, nl)
            Delta-M scaled transmittance. [1]
        """
        part = replace(lines, length=length)
        return self._lines(part, 2, self.tables if tables is None else tables, None, False)[:2]

    def _lines(
        self,
        lines: LinesOfSight,
        orders: int,
        chosen: MarchTables,
        scatterers: Sequence[int] | None,
        ground: bool,
        *,
        stokes: bool = False,
    ) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """March of lines from ``geometry.optical_lines``.

        Results: radiance [sr⁻¹] and transmittance [1], each (n, nl); I, Q and U, (n, 3, nl), 0
        without ``stokes`` [sr⁻¹]; path radiance, (n, nl) [sr⁻¹].
        """
        seen = self.geometry.apparent_nu(lines)
        n, count = lines.r.size, self.wavelengths.size
        out, transmittance, air = (np.empty((n, count)) for _ in range(3))
        polarised = np.zeros((n, 3, count))
        ends = lines.to_ground if ground else np.zeros_like(lines.to_ground)
        block = min(max(-(-n // _SHARES), _FEWEST), _MOST)
        sights = lines.r, lines.mu, lines.mu_s, lines.nu, lines.length, lines.pole

        def run(index: int) -> None:
            rows = slice(index * block, min((index + 1) * block, n))
            phases = self.geometry.medium.phase_function(seen[rows])
            if scatterers is not None:
                silent = [c for c in range(phases.shape[1]) if c not in scatterers]
                phases[:, silent] = 0.0
            phase = pack(phases)
            half_sine = np.sqrt(np.maximum(0.5 * (1.0 - seen[rows]), 0.0))
            phase_f12 = phase
            if stokes:
                phase_f12 = pack(self.geometry.medium.phase_f12(seen[rows]))
            result = np.empty((len(phase), 6 if stokes else 3, chosen.lanes), np.float32)
            some = (*(one[rows] for one in sights), half_sine)
            work = new_workspace(chosen)
            _march_all(some, ends[rows], orders, stokes, phase, phase_f12, chosen, work, result)
            out[rows], transmittance[rows], air[rows] = result[:, :3, :count].swapaxes(0, 1)
            if stokes:
                polarised[rows] = result[:, [0, 4, 5], :count]

        run_blocks(run, -(-n // block))
        return out, transmittance, polarised, air

    def relative_direct_irradiance(self, r: FloatArray, mu_s: FloatArray) -> FloatArray:
        """See ``Solution``."""
        work = new_workspace(self.tables)
        x = self.geometry.optical_radius(r)
        return self._received(x, lambda tables, out: direct_irradiance(x, mu_s, tables, work, out))

    def relative_normal_irradiance(self, r: FloatArray, mu_s: FloatArray) -> FloatArray:
        """Direct normal irradiance per that outside the atmosphere, shape (n, nl). [1]

        Parameters
        ----------
        r, mu_s : array, shape (n,)
            Radii [m] and cosines of the star's zenith angle [1].
        """
        work = new_workspace(self.tables)
        x = self.geometry.optical_radius(r)
        return self._received(
            x, lambda tables, out: direct_normal_irradiance(x, mu_s, tables, work, out)
        )

    def relative_beam(self, r: FloatArray, mu_s: FloatArray) -> tuple[FloatArray, FloatArray]:
        """See ``Solution``."""
        work, x = new_workspace(self.tables), self.geometry.optical_radius(r)

        def received(loop: Callable[..., None]) -> FloatArray:
            def fill(tables: MarchTables, out: Float32Array) -> None:
                loop(x, mu_s, tables._replace(scaled_extinction=tables.extinction), work, out)

            return self._received(x, fill)

        return received(direct_irradiance), received(direct_normal_irradiance)

    def relative_sky_irradiance(self, r: FloatArray, mu_s: FloatArray) -> FloatArray:
        """See ``Solution``."""
        x = self.geometry.optical_radius(r)
        radii = self.moments.grid.radii
        return self._received(x, lambda tables, out: sky_irradiance(x, mu_s, radii, tables, out))

    def _received(
        self, r: FloatArray, fill: Callable[[MarchTables, Float32Array], None]
    ) -> FloatArray:
        result = np.empty((r.size, self.tables.lanes), np.float32)
        fill(self.tables, result)
        return result[:, : self.wavelengths.size].astype(float)


@compiled_loop
def _march_all(sights, to_ground, orders, stokes, phase, phase_f12, tables, work, out):
    tables, work = without_refcount((tables, work))
    r, mu, mu_s, nu, length, pole, half_sine = sights
    bottom, ground = tables.bottom, np.empty(tables.lanes, np.float32)
    terms = MarchTerms(True, False, stokes)
    for k in range(r.size):
        ray_x, ray_y, sun_x = start_vectors(mu[k], mu_s[k], nu[k])
        ring = ring_line(
            Vec3(0.0, 0.0, r[k]),
            Vec3(ray_x, ray_y, mu[k]),
            Vec3(pole[k, 0], pole[k, 1], pole[k, 2]),
            Vec3(sun_x, 0.0, mu_s[k]),
            0.0,
        )
        segment = Segment(r[k], mu[k], mu_s[k], nu[k], half_sine[k], length[k], ring)
        work.phase[:] = phase[k]
        work.phase_f12[:] = phase_f12[k]
        march(segment, orders, terms, tables, work, work.radiance)
        for at in range(0, tables.lanes, LANES):  # instead of the peaks
            found = lane_view(work.radiance, at)
            found[2] = found[0]
        if to_ground[k]:
            mu_s_ground = (r[k] * mu_s[k] + length[k] * nu[k]) / bottom
            if tables.refraction_strength > 0.0:
                mu_ground = (r[k] * mu[k] + length[k]) / bottom
                angle = refraction_angle(
                    r[k],
                    mu[k],
                    tables.refraction_strength,
                    work.columns_total[tables.constituents - 1],
                )
                mu_s_ground, _ = turned(mu_ground, mu_s_ground, nu[k], angle)
            mu_s_ground = min(max(mu_s_ground, -1.0), 1.0)
            mu_r = cos_reflected(r[k], mu[k], bottom)
            ground_radiance(mu_s_ground, mu_r, nu[k], orders, tables, work, ground)
            left = np.float32(ring_shade_on(length[k], segment, tables))
            for at in range(0, tables.lanes, LANES):
                found = lane_view(work.radiance, at)
                found[0] += found[1] * load(ground, at) * left
        out[k] = work.radiance[: out.shape[1]]


def _rings(medium: Medium) -> Rings:
    """Rings of a planet, their albedos in lanes."""
    rings = ring_tables(medium.rings, medium.wavelengths)
    return rings._replace(ring_albedo=pack(rings.ring_albedo))
