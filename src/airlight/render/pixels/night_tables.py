"""Tables of the light of the night: airglow, and city lights scattered by the air."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import numpy.typing as npt
from numpy.typing import NDArray

from airlight.render.pixels.airglow import AIRGLOW_VALUES, airglow_tables
from airlight.render.pixels.skyglow import SKYGLOW_VALUES, skyglow_table

if TYPE_CHECKING:
    from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]


class NightTables(NamedTuple):
    """Tables of ``ViewUniforms`` that a solution determines.

    Attributes
    ----------
    airglow_layers, airglow_extinction : array
        Results of ``airglow_tables``.
    skyglow_layers : array
        Result of ``skyglow_table``.
    """

    airglow_layers: FloatArray
    airglow_extinction: FloatArray
    skyglow_layers: FloatArray


def night_tables(solution: MomentsSolution, weights: npt.ArrayLike | None = None) -> NightTables:
    """Tables of a solution.

    Parameters
    ----------
    weights : array, shape (nl, 3), optional
        Argument of ``LightSource.colors``.
    """
    return NightTables(*airglow_tables(solution, weights), skyglow_table(solution.medium))


def no_night(constituents: int) -> NightTables:
    """Tables of a dark night."""
    shapes = (AIRGLOW_VALUES, constituents, SKYGLOW_VALUES)
    return NightTables(*(np.zeros((1, size)) for size in shapes))
