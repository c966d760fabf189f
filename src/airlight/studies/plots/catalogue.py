"""Catalogue of figures with their settings."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from pkgutil import resolve_name
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from airlight.errors import ConflictError, ParameterError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from airlight.kernel.threads import Cancel, Progress
    from airlight.planets.planet import Planet
    from airlight.solver.solution import Solution


@dataclass(frozen=True, kw_only=True)
class Choices:
    """Settings of a figure; None for its defaults.

    Attributes
    ----------
    wavelengths : tuple of float, optional
        Wavelengths of the figure. [nm]
    sun_zenith : float, optional
        Solar zenith angle. [deg]
    altitude : float, optional
        Altitude of the observer. [m]
    quality : str, optional
        Quality of the solution: ``"preview"``, ``"default"`` or ``"fine"``.
    polarisation : bool, optional
        Whether transfer is polarised.
    """

    wavelengths: tuple[float, ...] | None = None
    sun_zenith: float | None = None
    altitude: float | None = None
    quality: str | None = None
    polarisation: bool | None = None


@dataclass(frozen=True, kw_only=True)
class Work:
    """Options of ``solve``: ``cache``, ``progress`` and ``cancel``."""

    cache: bool = True
    progress: Progress | None = None
    cancel: Cancel | None = None


#: Makes a figure of a planet.
Draw: TypeAlias = Callable[["Planet", Choices, Work], "Figure"]


@dataclass(frozen=True)
class PlotKind:
    """Kind of figure.

    Attributes
    ----------
    sentence : str
        Description of the figure.
    takes : tuple of str
        Names of the ``Choices`` that it accepts.
    draw : callable
        Function ``draw(planet, choices, work)`` that returns the figure.
    """

    sentence: str
    takes: tuple[str, ...]
    draw: Draw


def _solve(
    planet: Planet,
    choices: Choices,
    work: Work,
    *,
    solver: str = "moments",
    quality: str = "default",
    colored: bool = False,
) -> Solution:
    from airlight.solver import solve

    nm = choices.wavelengths
    if nm is None and colored:
        from airlight.planets.picture_wavelengths import picture_wavelengths

        nm = tuple(picture_wavelengths(planet).tolist())
    return solve(
        planet,
        nm,
        choices.quality or quality,
        solver=solver,
        polarisation=choices.polarisation is not False,
        cache=work.cache,
        progress=work.progress,
        cancel=work.cancel,
    )


def _given(choices: Choices, *names: str) -> dict[str, Any]:
    """Settings that are not None, by name."""
    pairs = {name: getattr(choices, name) for name in names}
    return {name: value for name, value in pairs.items() if value is not None}


def _of_planet(function: str, *, air: bool = True) -> Draw:
    """Figure of a planet alone, by the module and name of a function; whether it shows the air."""

    def draw(planet: Planet, choices: Choices, work: Work) -> Figure:
        if air:
            from airlight.planets.without_clouds import check_clear

            check_clear(planet, "this figure")
        chosen = _given(choices, "wavelengths", "altitude")
        figure: Figure = resolve_name(f"airlight.studies.plots.{function}")(planet, **chosen)
        return figure

    return draw


def _of_solution(function: str, *, watched: bool = False, **solved: Any) -> Draw:
    """Figure of a planet's solution; ``watched`` ones tell their progress and can be cancelled."""

    def draw(planet: Planet, choices: Choices, work: Work) -> Figure:
        chosen = _given(choices, "sun_zenith", "altitude")
        if watched:
            chosen |= {"progress": work.progress, "cancel": work.cancel}
        solution = _solve(planet, choices, work, **solved)
        figure: Figure = resolve_name(f"airlight.studies.plots.{function}")(solution, **chosen)
        return figure

    return draw


def _spectral_to_rgb(planet: Planet, choices: Choices, work: Work) -> Figure:
    from airlight.studies.plots.spectral_to_rgb import spectral_to_rgb

    return spectral_to_rgb(choices.wavelengths or planet.wavelengths)


def _limb(planet: Planet, choices: Choices, work: Work) -> Figure:
    from airlight.studies.plots.limb import SUN_ZENITHS, limb

    suns = SUN_ZENITHS if choices.sun_zenith is None else (choices.sun_zenith,)
    return limb(_solve(planet, choices, work), suns)


#: Every kind, from the star's spectrum to the sky.
KINDS: Final[dict[str, PlotKind]] = {
    "solar-spectrum": PlotKind(
        "The star's spectrum at the planet, the visible band in its colours.",
        ("wavelengths",),
        _of_planet("solar_spectrum:solar_spectrum", air=False),
    ),
    "spectral-to-rgb": PlotKind(
        "RGB of pure wavelengths with the normalisations none, sum and peak.",
        ("wavelengths",),
        _spectral_to_rgb,
    ),
    "cie": PlotKind(
        "CIE 1931 matching functions, and the sky's colours in the chromaticity diagram.",
        ("wavelengths", "quality", "polarisation"),
        _of_solution("chromaticity:cie", colored=True),
    ),
    "density": PlotKind(
        "Density of each constituent over altitude, linear and logarithmic.",
        (),
        _of_planet("density:density"),
    ),
    "phase": PlotKind(
        "Phase function of each constituent that scatters, polar and Cartesian.",
        ("wavelengths",),
        _of_planet("phase_functions:phase_functions"),
    ),
    "optical-depth": PlotKind(
        "Vertical optical depth of each constituent over wavelength.",
        ("wavelengths",),
        _of_planet("optical_depth:optical_depth"),
    ),
    "transmittance-surface": PlotKind(
        "Mean transmittance over altitude and view zenith angle, as a surface.",
        ("wavelengths",),
        _of_planet("transmittance:transmittance_surface"),
    ),
    "transmittance-map": PlotKind(
        "Mean transmittance over altitude and view zenith angle, as a map.",
        ("wavelengths",),
        _of_planet("transmittance:transmittance_map"),
    ),
    "mapping-regions": PlotKind(
        "Regions U, L and S of the weighted power mapping, on the ground and aloft.",
        ("altitude",),
        _of_planet("mapping_regions:mapping_regions", air=False),
    ),
    "mapping-comparison": PlotKind(
        "The scattering table on the linear and on the weighted power mapping.",
        ("wavelengths", "quality", "polarisation"),
        _of_solution("mapping_comparison:mapping_comparison", watched=True, colored=True),
    ),
    "sky-profile": PlotKind(
        "Radiance of the sky through the sun and around at the sun's height.",
        ("wavelengths", "sun_zenith", "altitude", "quality", "polarisation"),
        _of_solution("sky_profile:sky_profile"),
    ),
    "polarisation-plane": PlotKind(
        "Degree of polarisation in the plane of sun and zenith, with the neutral points.",
        ("wavelengths", "sun_zenith", "altitude", "quality"),
        _of_solution("polarisation:polarisation_plane"),
    ),
    "polarisation-dome": PlotKind(
        "Degree and angle of polarisation over the sky, with bars along which light swings.",
        ("wavelengths", "sun_zenith", "altitude", "quality"),
        _of_solution("polarisation:polarisation_dome"),
    ),
    "limb": PlotKind(
        "Radiance of the limb over tangent height, seen from space.",
        ("wavelengths", "sun_zenith", "quality", "polarisation"),
        _limb,
    ),
    "order-convergence": PlotKind(
        "Radiance by order of scattering, and what is missing after each.",
        ("wavelengths", "sun_zenith", "quality"),
        _of_solution(
            "order_convergence:order_convergence", watched=True, solver="direct", quality="preview"
        ),
    ),
}


def kind_named(name: str) -> PlotKind:
    """Kind of figure by name."""
    if name not in KINDS:
        raise ParameterError("KIND", name, ", ".join(KINDS))
    return KINDS[name]


def draw(
    planet: Planet, kind: str, choices: Choices | None = None, work: Work | None = None
) -> Figure:
    """Figure of a planet.

    Parameters
    ----------
    kind : str
        One of ``KINDS``.
    choices : Choices, optional
        Settings; unsupported ones raise an error.
    work : Work, optional
        Options for solving the planet, if the figure needs a solution.

    Raises
    ------
    ParameterError
        If there is no such kind, or it does not take one of the settings.
    AirlightError
        If matplotlib is not installed.
    """
    found = kind_named(kind)
    chosen = choices or Choices()
    check_choices(kind, chosen)
    from airlight.studies.plots.figure import require_matplotlib

    require_matplotlib()  # before any long work
    return found.draw(planet, chosen, work or Work())


def check_choices(kind: str, choices: Choices) -> None:
    """Raise an error for settings that a kind of figure does not support."""
    takes = kind_named(kind).takes
    for field in fields(choices):
        value = getattr(choices, field.name)
        if value is not None and field.name not in takes:
            named = ", ".join(one.replace("_", "-") for one in takes) or "nothing"
            raise ConflictError(field.name, f"does not apply to {kind}, which takes {named}")
