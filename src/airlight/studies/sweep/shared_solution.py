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
    from airlight.solver.solution import Solution

#: Solution of the last task, which the next task usually shares.
_CACHED: Final[Cache[str, Solution]] = Cache(1)


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
    bandwidth : float, optional
        Full width of bands around the wavelengths. [nm]
    """

    planet: Planet
    wavelengths: tuple[float, ...]
    quality: str = "default"
    polarisation: bool = True
    stokes: bool = False
    cache: bool = True
    bandwidth: float | None = None

    def solution(self, progress: Progress | None = None) -> Solution:
        """Solution of the planet; the last is cached in memory."""
        key = digest(
            (self.planet, self.wavelengths, self.bandwidth, self.quality, self.polarisation)
        )

        def solved() -> Solution:
            return solve(
                self.planet,
                wavelengths=self.wavelengths,
                quality=self.quality,
                bandwidth=self.bandwidth,
                polarisation=self.polarisation,
                cache=self.cache,
                progress=progress,
            )

        return _CACHED.of(key, solved)

    def layers(self, **where: Any) -> list[NDArray[np.float64]]:
        """Radiance of lines of sight, or ``stokes_layers``; arguments of ``radiance``."""
        found = self.solution().radiance(**where, stokes=self.stokes)
        return stokes_layers(found) if self.stokes else [np.asarray(found, np.float64)]


def stokes_layers(found: xarray.DataArray) -> list[NDArray[np.float64]]:
    """I, Q and U, degree and angle of polarisation.

    Parameters
    ----------
    found : xarray.DataArray, with the dimension ``stokes``
        I, Q and U. [W m⁻² sr⁻¹ nm⁻¹]
    """
    parts = [found.sel(stokes=name) for name in STOKES]
    parts += [degree_of_polarisation(found), angle_of_polarisation(found)]
    return [np.asarray(part, np.float64) for part in parts]
