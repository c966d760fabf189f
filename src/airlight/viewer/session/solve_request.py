"""What a session wants to be solved, and the counters that tell what has changed."""

from __future__ import annotations

from typing import NamedTuple

from airlight.viewer.session.planet_state import PlanetState


class Versions(NamedTuple):
    """Counters that grow with every change of their part.

    Attributes
    ----------
    planet : int
        What is solved: planet, switches, wavelengths, quality.
    view : int
        What is rendered: camera, sun, orders, size.
    display : int
        What is shown of it: exposure, tone map.
    """

    planet: int = 0
    view: int = 0
    display: int = 0


class Wanted(NamedTuple):
    """What has to be solved; see ``solving``.

    Attributes
    ----------
    version : int
        Of the planet.
    state : PlanetState
    quality : str
        That follows the preview.
    wavelengths : str
        How many, in a word: one of ``view_parameters.WAVELENGTHS``.
    """

    version: int
    state: PlanetState
    quality: str
    wavelengths: str

    @property
    def key(self) -> tuple[str, str]:
        """Equal where the same has to be solved, the quality apart."""
        return self.state.key, self.wavelengths
