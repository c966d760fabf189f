"""Settings and quality levels of the moments solver: grid sizes and tolerances."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Final

from airlight.solver.quality import settings_by_name


@dataclass(frozen=True, kw_only=True)
class MomentsSettings:
    """Grid sizes and tolerances of the moments solver.

    Attributes
    ----------
    degree : int
        Highest degree of the harmonics for optically thin aerosol.
    thick_degree : int
        Highest degree for multiple scattering by forward peaks (dust, haze).
    radii, sun_angles : int
        Nodes in radius and in sun elevation.
    zenith_angles : int
        Directions on each side of the local horizon in optically thick media.
    horizon_angles, high_angles : int
        Directions next to the local horizon and farther from it, on each side, in optically thin
        media; the latter are increased with the degree.
    azimuths : int
        Directions over half a turn; at least three quarters of the degree.
    nodes : int
        Points per leg of a ray of a sweep.
    tolerance : float
        Largest remaining relative change of a converged iteration. [1]
    max_sweeps : int
        Largest number of sweeps.
    column_radii, column_directions : int
        Shape of the table of columns to the star.
    march_nodes, march_panels : int
        Points per panel and panels per leg of a ray march.
    cut_nodes : tuple of int
        Points per panel with layers aloft, see ``quadratures``.
    cut_panels : int
        Panels per leg there, before those of the layers.
    layer_degree : int
        Highest degree with thin layers, along which double scattering matters.
    energy_tolerance : float
        Largest energy balance error without a warning, over the incident energy. [1]
    polarisation : bool
        Whether transfer is polarised rather than scalar.
    """

    degree: int
    thick_degree: int
    radii: int
    sun_angles: int
    zenith_angles: int
    horizon_angles: int
    high_angles: int
    azimuths: int
    nodes: int
    tolerance: float
    max_sweeps: int
    column_radii: int
    column_directions: int
    march_nodes: int
    march_panels: int
    cut_nodes: tuple[int, int, int, int]
    cut_panels: int
    layer_degree: int = 16
    energy_tolerance: float = 1e-2
    polarisation: bool = True

    def as_text(self) -> str:
        """Settings on one line, for reports and fingerprints."""
        return " ".join(f"{name}={value}" for name, value in asdict(self).items())


QUALITIES: Final = {
    "preview": MomentsSettings(
        degree=4,
        thick_degree=6,
        layer_degree=12,
        radii=14,
        sun_angles=36,
        zenith_angles=6,
        horizon_angles=3,
        high_angles=4,  # as many as its thick degree needs: a fit crosses from one to the other
        azimuths=4,
        nodes=8,
        tolerance=1e-2,
        max_sweeps=100,
        column_radii=64,
        column_directions=144,
        march_nodes=16,
        march_panels=1,
        cut_nodes=(16, 16, 16, 16),
        cut_panels=1,
        energy_tolerance=3e-2,
    ),
    "default": MomentsSettings(
        degree=9,
        thick_degree=16,
        radii=24,
        sun_angles=58,
        zenith_angles=12,
        horizon_angles=6,
        high_angles=5,
        azimuths=7,
        nodes=14,
        tolerance=2e-3,
        max_sweeps=60,
        column_radii=128,
        column_directions=256,
        march_nodes=20,
        march_panels=2,
        cut_nodes=(20, 24, 28, 20),
        cut_panels=1,
    ),
    "fine": MomentsSettings(
        degree=16,
        thick_degree=24,
        layer_degree=24,
        radii=40,
        sun_angles=104,
        zenith_angles=20,
        horizon_angles=10,
        high_angles=10,
        azimuths=20,
        nodes=20,
        tolerance=1e-4,
        max_sweeps=200,
        column_radii=160,
        column_directions=288,
        march_nodes=24,
        march_panels=4,
        cut_nodes=(24, 24, 24, 24),
        cut_panels=4,
    ),
}


def settings_for(quality: str | MomentsSettings) -> MomentsSettings:
    """Settings of a named quality level; settings are returned unchanged."""
    return settings_by_name(quality, QUALITIES)
