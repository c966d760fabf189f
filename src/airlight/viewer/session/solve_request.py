"""Solve request of a session, and version counters of its parts."""

from __future__ import annotations

from typing import NamedTuple

from airlight.viewer.session.planet_state import PlanetState


class Versions(NamedTuple):
    """Change counters of planet, view and display.

    Attributes
    ----------
    planet : int
        Inputs of the solution: planet, switches, wavelengths, quality.
    view : int
        Inputs of the rendering: camera, sun, orders, size.
    display : int
        Inputs of the display: exposure, tone map.
    """

    planet: int = 0
    view: int = 0
    display: int = 0


class SolveRequest(NamedTuple):
    """Request of a solution; see ``SolverThread``.

    Attributes
    ----------
    version : int
        Version of the planet.
    state : PlanetState
        Planet to solve.
    quality : str
        Quality of the solution that follows the preview.
    wavelengths : str
        Number of wavelengths, a word of ``view_parameters.WAVELENGTHS``.
    """

    version: int
    state: PlanetState
    quality: str
    wavelengths: str

    @property
    def key(self) -> tuple[str, str]:
        """Key of a request, independent of the quality."""
        return self.state.key, self.wavelengths
