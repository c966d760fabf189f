"""``solve``: from a planet to its light."""

from __future__ import annotations

from numpy.typing import ArrayLike

from airlight.kernel.threads import Cancel, Progress
from airlight.planets.medium import Medium
from airlight.planets.planet import Planet
from airlight.solvers.moments.settings import settings_for
from airlight.solvers.moments.solution import MomentsSolution
from airlight.solvers.moments.solution import solve as solve_by_moments


def solve(
    planet: Planet,
    wavelengths: ArrayLike | None = None,
    quality: str = "default",
    *,
    cache: bool = True,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> MomentsSolution:
    """Solve for the light of a planet's air.

    Parameters
    ----------
    planet : Planet
        From ``load_planet``, or made in Python.
    wavelengths : array, shape (nl,), optional
        Any number; the planet's own without it. [nm]
    quality : str
        ``"preview"``, ``"default"`` or ``"fine"``.
    cache : bool
        Whether to look for the solution on disk first, and to leave it there.
    progress : callable, optional
        Called as ``progress(done, total, message)``.
    cancel : callable, optional
        Asked often; True stops with ``Cancelled``.

    Returns
    -------
    Solution
        Answers ``radiance``, ``transmittance`` and ``irradiance`` for any observer and sun.

    Raises
    ------
    ParameterError
        If a wavelength is outside what the planet's file covers, or the quality has no such name.
    ConvergenceError
        If the orders of scattering do not converge within the settings' bound.

    Examples
    --------
    >>> from airlight import load_planet, solve
    >>> solution = solve(load_planet("earth-atmosphere-plus"), quality="preview", cache=False)
    >>> sky = solution.radiance(altitude=0, sun_zenith=60, view_zenith=[0, 60], azimuth=90)
    >>> sky.dims, bool((sky.sel(wavelength=440) > sky.sel(wavelength=680)).all())
    (('dim_0', 'wavelength'), True)
    """
    settings = settings_for(quality)
    medium = Medium.from_planet(planet, planet.wavelengths if wavelengths is None else wavelengths)
    solution = solve_by_moments(medium, settings, cache=cache, progress=progress, cancel=cancel)
    solution.planet = planet
    return solution
