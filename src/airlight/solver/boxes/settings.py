"""Settings and quality levels of the solver of boxes: directions, moments and tolerance."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Final

from airlight.errors import ParameterError
from airlight.solver.quality import settings_by_name

#: Highest degree of the harmonics of a source.
_MOST_DEGREE: Final = 15


@dataclass(frozen=True, kw_only=True)
class BoxSettings:
    """Directions, moments and tolerance of the solver of boxes.

    Attributes
    ----------
    zenith_angles : int
        Gauss angles of directions in each hemisphere.
    azimuths : int
        Azimuths of directions, a multiple of 4.
    degree : int
        Highest degree of the harmonics of the source; phase functions are scaled by their moment
        of the next degree (delta-M).
    stored_degree : int
        Highest degree of the moments of a solution.
    beam_points : int
        Points across a column from which the beam is followed to the sun, along each axis.
    refinement : int
        Largest number of cells of the solver along each axis of a cell of the field.
    largest_depth : float
        Scaled optical depth of a cell above which it is refined. [1]
    most_cells : int
        Number of cells up to which cells are refined.
    tolerance : float
        Largest estimated error of the mean radiance, root mean square over its own. [1]
    max_sweeps : int
        Largest number of sweeps.
    """

    zenith_angles: int
    azimuths: int
    degree: int
    stored_degree: int
    beam_points: int
    refinement: int
    largest_depth: float
    most_cells: int
    tolerance: float
    max_sweeps: int

    def __post_init__(self) -> None:
        if not 1 <= self.degree <= _MOST_DEGREE:
            raise ParameterError("degree", self.degree, f"1 to {_MOST_DEGREE}")
        if not 1 <= self.stored_degree <= self.degree:
            raise ParameterError("stored_degree", self.stored_degree, f"1 to {self.degree}")
        if self.azimuths < 4 or self.azimuths % 4:
            raise ParameterError("azimuths", self.azimuths, "a multiple of 4")

    def as_text(self) -> str:
        """Settings on one line, for reports and fingerprints."""
        return " ".join(f"{name}={value}" for name, value in asdict(self).items())


QUALITIES: Final = {
    "preview": BoxSettings(
        zenith_angles=3,
        azimuths=8,
        degree=3,
        stored_degree=3,
        beam_points=1,
        refinement=1,
        largest_depth=4.0,
        most_cells=200_000,
        tolerance=7e-3,
        max_sweeps=60,
    ),
    "default": BoxSettings(
        zenith_angles=4,
        azimuths=12,
        degree=5,
        stored_degree=5,
        beam_points=2,
        refinement=2,
        largest_depth=1.5,
        most_cells=400_000,
        tolerance=2e-3,
        max_sweeps=100,
    ),
    "high": BoxSettings(
        zenith_angles=6,
        azimuths=16,
        degree=7,
        stored_degree=7,
        beam_points=3,
        refinement=3,
        largest_depth=0.7,
        most_cells=800_000,
        tolerance=5e-4,
        max_sweeps=200,
    ),
}


def settings_for(quality: str | BoxSettings) -> BoxSettings:
    """Settings of a named quality level; settings are returned unchanged."""
    return settings_by_name(quality, QUALITIES)
