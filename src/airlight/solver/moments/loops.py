"""Compiled loops of a solve and of its radiance, for the progress of their first compilation."""

from __future__ import annotations

from typing import Final

from airlight.kernel.denormals import _exchange
from airlight.physics.optics.altitude_nodes import _refine
from airlight.physics.optics.density_profile import _relative_densities, segment_density
from airlight.physics.optics.phase_functions import cornette_shanks, rayleigh
from airlight.physics.optics.phase_table import _interpolate
from airlight.solver.moments import convergence, iterate_update
from airlight.solver.moments import synthetic_acceleration as synthetic
from airlight.solver.moments.acceleration import combine
from airlight.solver.moments.delta_m import delta_m_scaling
from airlight.solver.moments.elimination import factorise, substitute
from airlight.solver.moments.first_order import first_order_radius_narrow
from airlight.solver.moments.opaque_culling import norms_into
from airlight.solver.moments.packing import _pack_sun
from airlight.solver.moments.rays import trace_into
from airlight.solver.moments.solution import _march_all
from airlight.solver.moments.sweep import sweep_radius_narrow
from airlight.solver.moments.synthetic_operator import gather_levels, project_radii, synthetic_rows
from airlight.solver.tables.columns import _columns, table_rays

#: Loops in the order in which a solve of at most four wavelengths runs them.
LOOPS: Final = (
    _exchange,
    segment_density,
    _refine,
    _relative_densities,
    rayleigh,
    cornette_shanks,
    _interpolate,
    delta_m_scaling,
    trace_into,
    norms_into,
    table_rays,
    _columns,
    first_order_radius_narrow,
    synthetic_rows,
    gather_levels,
    synthetic._legendre_rows,
    project_radii,
    factorise,
    synthetic.take_terms,
    substitute,
    synthetic.multiply,
    synthetic.spread_onto,
    convergence.replace_unsound,
    _pack_sun,
    sweep_radius_narrow,
    iterate_update._add_orders,
    iterate_update.accelerate_nodes,
    iterate_update.fill_quantities,
    convergence.counted_changes,
    convergence.geometric_tail,
    combine,
    convergence.add_weighted,
    convergence.damp_towards,
    convergence.is_near,
)

#: Loops of the radiance along lines of sight.
RADIANCE_LOOPS: Final = (_march_all,)
