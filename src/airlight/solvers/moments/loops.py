"""Compiled loops that a solve of a planet runs, for the count of what is still to be compiled."""

from __future__ import annotations

from typing import Final

from airlight.optics.density_profile import _relative_densities, segment_density
from airlight.optics.phase_functions import cornette_shanks, rayleigh
from airlight.optics.phase_table import _interpolate
from airlight.solvers.moments.acceleration import combine
from airlight.solvers.moments.convergence import change_at, count_at, is_near, rest_after
from airlight.solvers.moments.elimination import factorise, substitute
from airlight.solvers.moments.first_order import first_order_radius
from airlight.solvers.moments.rays import trace_into
from airlight.solvers.moments.reduced_optics import reduce_optics
from airlight.solvers.moments.sweep import sweep_radius
from airlight.solvers.moments.vertical_coupling import _legendre_rows, couple_radius
from airlight.solvers.moments.visible_rays import share_into
from airlight.tables.columns import _columns, table_rays

#: Loops in the order in which a solve runs them.
LOOPS: Final = (
    segment_density,
    _relative_densities,
    rayleigh,
    cornette_shanks,
    _interpolate,
    reduce_optics,
    trace_into,
    share_into,
    table_rays,
    _columns,
    first_order_radius,
    couple_radius,
    _legendre_rows,
    factorise,
    substitute,
    sweep_radius,
    change_at,
    count_at,
    rest_after,
    combine,
    is_near,
)
