"""March resolution for rendering: quadrature points of a panel, panels of a leg."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

if TYPE_CHECKING:
    from airlight.solver.moments.solution import MomentsSolution


class MarchPoints(NamedTuple):
    """March resolution.

    Attributes
    ----------
    points : tuple of int
        Quadrature points of a panel, see ``quadratures``.
    panels : int
        Number of panels of a leg.
    """

    points: tuple[int, int, int, int]
    panels: int


#: Resolution for pixels and for shaders on hardware GPUs; queries need more.
FEW: Final = MarchPoints((8, 12, 24, 4), 1)
#: Resolution for fine solutions.
MANY: Final = MarchPoints((20, 20, 24, 20), 2)
#: Resolution by panels per leg of the solution.
BY_PANELS: Final = {1: FEW, 2: FEW}


def march_points(solution: MomentsSolution) -> MarchPoints:
    """March resolution for rendering a solution."""
    return BY_PANELS.get(solution.settings.march_panels, MANY)
