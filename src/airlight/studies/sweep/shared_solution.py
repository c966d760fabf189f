"""Solution shared by the tasks of a process: solved, or read from disk, once."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final

from airlight.kernel.cache import Cache
from airlight.planets.planet import Planet
from airlight.solver import solve
from airlight.studies.distribution.fingerprint import digest

if TYPE_CHECKING:
    from airlight.kernel.threads import Progress
    from airlight.solver.moments.solution import MomentsSolution

#: Solution of the last task, which the next one mostly shares.
_CACHED: Final[Cache[str, MomentsSolution]] = Cache(1)


def shared_solution(
    planet: Planet,
    wavelengths: Sequence[float],
    quality: str,
    *,
    polarisation: bool = True,
    cache: bool = True,
    progress: Progress | None = None,
) -> MomentsSolution:
    """Solution of a planet; the last is cached in memory.

    Parameters
    ----------
    planet : Planet
        Planet.
    wavelengths : sequence of float
        Wavelengths. [nm]
    quality : str
        Quality as for ``airlight.solve``.
    polarisation : bool
        Whether light is polarised, as for ``airlight.solve``.
    cache : bool
        Whether it is looked for on disk, and kept there.
    progress : callable, optional
        See ``airlight.kernel.threads``.
    """
    key = digest((planet, tuple(wavelengths), quality, polarisation))

    def solved() -> MomentsSolution:
        return solve(
            planet, wavelengths, quality, polarisation=polarisation, cache=cache, progress=progress
        )

    return _CACHED.of(key, solved)
