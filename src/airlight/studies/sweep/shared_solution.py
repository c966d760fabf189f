"""Solution shared by the tasks of a process."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final

from airlight.planets.planet import Planet
from airlight.solver import solve
from airlight.studies.distribution.fingerprint import digest

if TYPE_CHECKING:
    from airlight.kernel.threads import Progress
    from airlight.solver.moments.solution import MomentsSolution

#: Solution of the last task, which the next task usually shares.
_CACHED: Final[dict[str, MomentsSolution]] = {}


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
    wavelengths : sequence of float
        Wavelengths. [nm]
    quality : str
        Quality as for ``airlight.solve``.
    polarisation : bool
        Whether transfer is polarised.
    cache : bool
        Whether to cache the solution on disk.
    """
    key = digest((planet, tuple(wavelengths), quality, polarisation))
    if key not in _CACHED:
        found = solve(
            planet, wavelengths=wavelengths, quality=quality, polarisation=polarisation,
            cache=cache, progress=progress,
        )  # fmt: skip
        _CACHED.clear()
        _CACHED[key] = found
    return _CACHED[key]
