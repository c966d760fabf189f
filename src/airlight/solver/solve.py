"""``solve``: radiative transfer of a planet by any of the solvers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from importlib import import_module
from typing import TYPE_CHECKING, Any, Final, Literal, overload

import numpy as np

from airlight.errors import ConflictError, ParameterError
from airlight.kernel.first_compilation import FIRST_COMPILATION
from airlight.kernel.memory import check_memory
from airlight.kernel.threads import Cancel, Progress
from airlight.physics.units import values_in
from airlight.planets.medium import Medium
from airlight.planets.omitted_absorption_bands import warn_of_omitted_bands
from airlight.planets.reading.reader import PlanetLike, load_planet
from airlight.solver.band_columns import BandColumns
from airlight.solver.band_solution import BandSolution
from airlight.solver.solution import Solution

if TYPE_CHECKING:
    from airlight.physics.units import Measures
    from airlight.planets.planet import Planet
    from airlight.solver.direct.settings import DirectSettings
    from airlight.solver.direct.solution import DirectSolution
    from airlight.solver.moments.settings import MomentsSettings
    from airlight.solver.moments.solution import MomentsSolution
    from airlight.solver.montecarlo.settings import MonteCarloSettings
    from airlight.solver.montecarlo.solution import MonteCarloSolution

#: Modules of the solvers, imported on demand. Each has ``solve(medium, settings, *, cache,
#: progress, cancel)``, and beside it a module ``settings`` with ``settings_for``.
SOLVERS: Final = {
    "moments": "airlight.solver.moments.solve",
    "direct": "airlight.solver.direct.solution",
    "montecarlo": "airlight.solver.montecarlo.solution",
}


@overload
def solve(
    planet: PlanetLike,
    wavelengths: Measures | None = None,
    quality: str | MomentsSettings = "default",
    *,
    solver: Literal["moments"] = "moments",
    polarisation: bool = True,
    cache: bool = True,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> MomentsSolution: ...


@overload
def solve(
    planet: PlanetLike,
    wavelengths: Measures | None = None,
    quality: str | DirectSettings = "default",
    *,
    solver: Literal["direct"],
    polarisation: bool = True,
    cache: bool = True,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> DirectSolution: ...


@overload
def solve(
    planet: PlanetLike,
    wavelengths: Measures | None = None,
    quality: str | MonteCarloSettings = "default",
    *,
    solver: Literal["montecarlo"],
    polarisation: bool = True,
    cache: bool = True,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> MonteCarloSolution: ...


@overload
def solve(
    planet: PlanetLike,
    wavelengths: Measures | None = None,
    quality: Any = "default",
    *,
    solver: str = "moments",
    bandwidth: Measures | None,
    polarisation: bool = True,
    cache: bool = True,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Solution: ...


@overload
def solve(
    planet: PlanetLike,
    wavelengths: Measures | None = None,
    quality: Any = "default",
    *,
    solver: str,
    polarisation: bool = True,
    cache: bool = True,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Solution: ...


def solve(
    planet: PlanetLike,
    wavelengths: Measures | None = None,
    quality: Any = "default",
    *,
    solver: str = "moments",
    bandwidth: Measures | None = None,
    polarisation: bool = True,
    cache: bool = True,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Solution:
    """Solve the radiative transfer of a planet's atmosphere.

    Parameters
    ----------
    planet : Planet, str, Path or Solution
        Planet, name of a preset, or path of a planet file; a solution stands for its planet. One
        with clouds is solved by ``IndependentColumns``, whatever the solver.
    wavelengths : array, shape (nl,), optional
        Wavelengths, any number; default: the planet's. Text (``"0.4:0.7:0.1 um"``) and quantities
        of another length are converted. [nm]
    quality : str or Settings
        Name ``"preview"``, ``"default"`` or ``"fine"``, or the solver's own settings.
    solver : str
        ``"moments"``, for all uses; ``"direct"``, successive orders by the equations of the
        Atmosphere Plus notes, slow; ``"montecarlo"``, the reference, with standard errors.
    bandwidth : float or array, shape (nl,), optional
        Full widths of bands around the wavelengths, at most 100 nm: results are means over them,
        lines of gases by k-distributions, and the planet's ``gases`` are included; default: single
        wavelengths, without them. Not with ``"montecarlo"``. [nm]
    polarisation : bool
        Whether transfer is polarised, which changes radiance by some percent; ``"direct"`` is
        always scalar.
    cache : bool
        Whether to read the solution from the cache on disk, and to write it there.
    progress : callable, optional
        Called as ``progress(done, total, message)``.
    cancel : callable, optional
        Polled frequently; True stops with ``Cancelled``.

    Returns
    -------
    Solution
        Solution with ``radiance``, ``transmittance`` and ``irradiance`` for any observer and sun.

    Raises
    ------
    ParameterError
        If a wavelength is outside the range of the planet's file, or the planet, solver or quality
        is unknown.
    ConvergenceError
        If the orders of scattering do not converge within the settings' limit.

    Warns
    -----
    AirlightWarning
        If absorption bands of the planet's gases are omitted at these wavelengths, except those of
        pictures. If the solution violates energy conservation by more than its quality allows
        (1 %; ``"preview"``: 3 %).

    Examples
    --------
    >>> import airlight
    >>> solution = airlight.solve("earth-atmosphere-plus", quality="preview", cache=False)
    >>> sky = solution.radiance(altitude="2 km", sun_zenith=60, view_zenith=[0, 60], azimuth=90)
    >>> sky.dims, bool((sky.sel(wavelength=440) > sky.sel(wavelength=680)).all())
    (('view_zenith', 'wavelength'), True)
    """
    if solver not in SOLVERS:
        raise ParameterError("solver", solver, ", ".join(SOLVERS))
    if solver == "montecarlo" and bandwidth is not None:
        raise ConflictError("bandwidth", "requires solver moments or direct")
    if solver == "moments":
        from airlight.solver.moments.loops import LOOPS

        FIRST_COMPILATION.expect(LOOPS)
    planet = load_planet(planet)
    module = SOLVERS[solver]
    settings = import_module(f"{module.rpartition('.')[0]}.settings").settings_for(quality)
    if not polarisation and hasattr(settings, "polarisation"):
        settings = replace(settings, polarisation=False)
    given = planet.wavelengths if wavelengths is None else wavelengths
    nm = np.atleast_1d(values_in(given, "nm", "wavelengths"))

    if solver == "moments":
        _check_memory(settings, nm.size)

    def solved(one: Planet, report: Progress | None) -> Solution:
        if bandwidth is None:
            bands, whole = None, one
            medium = Medium.from_planet(one, nm, progress=report, cancel=cancel)
        else:
            whole = one.with_gases
            bands = BandColumns.of(one, nm, bandwidth, progress=report, cancel=cancel)
            medium = bands.columns
            if solver == "moments":
                _check_memory(settings, medium.wavelengths.size)
        warn_of_omitted_bands(whole, nm)
        solution: Solution = import_module(module).solve(
            medium, settings, cache=cache, progress=report, cancel=cancel
        )
        if bands is not None:
            solution = BandSolution(bands, solution)
        return solution.of(one)

    if planet.clouds:
        return _solve_columns(planet, solved, progress).of(planet)
    return solved(planet, progress)


def _solve_columns(
    planet: Planet, solved: Callable[[Planet, Progress | None], Solution], progress: Progress | None
) -> Solution:
    """Mean of the solutions of the columns of a planet with clouds."""
    from airlight.clouds.columns import planet_columns
    from airlight.solver.independent_columns import IndependentColumns, SolvedColumn

    parts = planet_columns(planet)

    def share(number: int) -> Progress | None:
        if progress is None:
            return None
        return lambda done, total, message: progress(
            number * total + done, len(parts) * total, message
        )

    return IndependentColumns(
        [SolvedColumn(one.fraction, solved(one.planet, share(k))) for k, one in enumerate(parts)]
    )


def solution_of(
    given: Solution | PlanetLike,
    wavelengths: Callable[[Planet], Measures] | None = None,
    *,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Solution:
    """Solution of a planet at quality ``default``; a solution is returned as it is.

    Parameters
    ----------
    given : Solution, Planet, str or Path
        Solution, or what ``solve`` takes for a planet.
    wavelengths : callable, optional
        Function from a planet to its wavelengths; default: the planet's. [nm]
    """
    if isinstance(given, Solution):
        return given
    planet = load_planet(given)
    nm = None if wavelengths is None else wavelengths(planet)
    return solve(planet, nm, progress=progress, cancel=cancel)


def _check_memory(settings: MomentsSettings, wavelengths: int) -> None:
    """Raise an error for wavelengths whose solution does not fit into free memory.

    Estimate: twice the size of the moments in float64; measured: 1.7 times at ``preview``, once at
    ``default``.
    """
    from airlight.solver.moments.harmonics import moment_count

    fields = settings.radii * settings.sun_angles * moment_count(settings.degree)
    check_memory(16.0 * fields * wavelengths, f"the light of {wavelengths} wavelengths")
