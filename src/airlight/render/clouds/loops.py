"""Compiled loops of the light of clouds, for the progress of their first compilation."""

from __future__ import annotations

from typing import Final

from airlight.render.clouds import beam_depth, clear_distance
from airlight.solver.boxes import linear
from airlight.solver.boxes.beam import beam_row, mean_beam_row
from airlight.solver.boxes.cell_balance import balance
from airlight.solver.boxes.cell_blocks import block_sums, precondition_rows
from airlight.solver.boxes.rebalance import add_currents, add_losses, correct, level_coefficients
from airlight.solver.boxes.sweep import sweep_level
from airlight.solver.moments.irradiance import (
    direct_irradiance,
    direct_normal_irradiance,
    sky_irradiance,
)
from airlight.solver.moments.levels import fill_levels
from airlight.solver.moments.solution import _march_all
from airlight.solver.moments.synthetic_operator import gather_levels

#: Loops that the light of any clouds runs, beside those of a solution.
LOOPS: Final = (
    fill_levels,
    gather_levels,
    direct_normal_irradiance,
    sky_irradiance,
    direct_irradiance,
    _march_all,
    beam_row,
    mean_beam_row,
    level_coefficients,
    sweep_level,
    add_losses,
    linear.factorise,
    block_sums,
    precondition_rows,
    balance,
    linear._products,
    linear._add_multiples,
    correct,
    add_currents,
    clear_distance._nearest,
    beam_depth._fill,
)
