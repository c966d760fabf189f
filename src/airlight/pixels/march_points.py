"""Resolution of the march of pictures: points of a panel, panels of a leg, by quality."""

from __future__ import annotations

from typing import Final, NamedTuple

from airlight.solvers.moments.solution import MomentsSolution


class MarchPoints(NamedTuple):
    """Resolution of the march of a picture.

    Attributes
    ----------
    points : tuple of int
        Points of a panel: for steep stretches by day, for most, for those that graze the ground.
    panels : int
        Number of panels of a leg.
    """

    points: tuple[int, int, int]
    panels: int


#: Resolution for pixels, which need less than queries; also that of shaders except in software.
FEW: Final = MarchPoints((8, 12, 24), 1)
#: Resolution for fine solutions.
MANY: Final = MarchPoints((20, 20, 24), 2)
#: Resolution by the panels per leg of the solution's own march.
BY_PANELS: Final = {1: FEW, 2: FEW}


def march_points(solution: MomentsSolution) -> MarchPoints:
    """Resolution for pictures of a solution, as low as its own grid allows.

    Parameters
    ----------
    solution : MomentsSolution
        Solution of the planet.
    """
    return BY_PANELS.get(solution.settings.march_panels, MANY)
