"""Radiances that tasks compute, by a solution that the tasks of a process share."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel.cache import Cache
from airlight.planets.planet import Planet
from airlight.solver import solve
from airlight.solver.stokes_frame import (
    STOKES,
    angle_of_polarisation,
    degree_of_polarisation,
)
from airlight.studies.distribution.fingerprint import digest

if TYPE_CHECKING:
    import xarray

    from airlight.kernel.threads import Progress
    from airlight.solver.moments.solution import MomentsSolution

#: Solution of the last task, which the next one mostly shares.
_CACHED: Final[Cache[str, MomentsSolution]] = Cache(1)


@dataclass(frozen=True, kw_only=True)
class RadianceTask:
    """Planet, wavelengths and accuracy of radiances.

    Attributes
    ----------
    wavelengths : tuple of float
        Wavelengths. [nm]
    quality : str
        Quality as for ``airlight.solve``.
    polarisation : bool
        Whether transfer is polarised.
    stokes : bool
        Whether I, Q and U, degree and angle of polarisation are computed.
    cache : bool
        Whether the solution is looked for on disk, and kept there.
    """

    key = digest((planet, tuple(wavelengths), quality, polarisation))

    def solved() -> MomentsSolution:
        return solve(
            planet, wavelengths, quality, polarisation=polarisation, cache=cache, progress=progress
        )

    return _CACHED.of(key, solved)
