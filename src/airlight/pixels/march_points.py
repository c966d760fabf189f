"""How finely pictures march: points of a panel and panels of a leg, by a solution's quality."""

from __future__ import annotations

from typing import Final, NamedTuple

from airlight.solvers.moments.solution import MomentsSolution


class MarchPoints(NamedTuple):
    """How finely a picture marches.

    Attributes
    ----------
    points : tuple of int
        Of a panel: for steep stretches by day, for most, for those that graze the ground.
    panels : int
        Of a leg.
    """

    points: tuple[int, int, int]
    panels: int


#: A pixel needs less than a query. Shaders march so too, but for devices in software.
FEW: Final = MarchPoints((8, 12, 24), 1)
#: Of fine solutions.
MANY: Final = MarchPoints((20, 20, 24), 2)
#: By the panels a leg of the solution's own march.
BY_PANELS: Final = {1: FEW, 2: FEW}


def march_points(solution: MomentsSolution) -> MarchPoints:
    """Points for pictures of a solution: as few as its own grid allows.

    Parameters
    ----------
    solution : MomentsSolution
    """
    return BY_PANELS.get(solution.settings.march_panels, MANY)
