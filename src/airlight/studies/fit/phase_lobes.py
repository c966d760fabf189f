"""Free phase function of a constituent: two Henyey-Greenstein lobes in place of its own."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

from airlight.errors import ConflictError, ParameterError
from airlight.planets.medium import Medium
from airlight.planets.planet import Planet
from airlight.planets.reading.nested_tables import Tables, get, put
from airlight.studies.fit.settings import FitSettings

#: End of a name that stands for the parameters of both lobes.
WORD: Final = ".phase_function"
#: Asymmetry and weight of the forward lobe at the start. [1]
FORWARD: Final = 0.9
WEIGHT: Final = 0.15
#: Bounds of the asymmetries and the weight; lobes do not change places. [1]
LOBES: Final = {"asymmetry_1": (0.75, 0.98), "asymmetry_2": (-0.2, 0.75), "weight": (0.0, 1.0)}
#: Wavelength of the mean cosine at the start. [nm]
_AT: Final = 550.0


def with_lobes(settings: FitSettings, tables: Tables, planet: Planet) -> tuple[FitSettings, Tables]:
    r"""Settings and tables in which every ``NAME.phase_function`` has become two lobes.

    .. math:: p = w\, p_{HG}(g_1) + (1 - w)\, p_{HG}(g_2)

    with the mean cosine of the constituent's own phase function at the start. One lobe has either
    the aureole or the rest of the sky right, but not both.

    Parameters
    ----------
    settings : FitSettings
    tables : dict
        Tables of the planet's file.
    planet : Planet
        Planet of these tables.

    Raises
    ------
    ParameterError
        If there is no such constituent.
    ConflictError
        If its phase function follows from particles.
    """
    free: list[str] = []
    bounds = dict(settings.bounds)
    for name in settings.free:
        if not name.endswith(WORD):
            free.append(name)
            continue
        tables = _lobes(tables, planet, name)
        for key, limits in LOBES.items():
            free.append(f"{name}.{key}")
            bounds.setdefault(f"{name}.{key}", limits)
    return replace(settings, free=free, bounds=bounds), tables


def _lobes(tables: Tables, planet: Planet, name: str) -> Tables:
    """Tables in which a constituent scatters in two lobes of its mean cosine."""
    names = [str(one.get("name", "")) for one in tables.get("constituents", [])]
    own = name.removesuffix(WORD)
    if own not in names:
        raise ParameterError("free", name, f"the phase function of one of {', '.join(names)}")
    path = f"constituents[{names.index(own)}]{WORD}"
    if get(tables, path) is None:
        raise ConflictError(name, "requires a constituent with a phase function in the file")
    low, high = planet.wavelength_limits
    medium = Medium.from_planet(planet, [min(max(_AT, low), high)])
    cosine = float(medium.phase_moments(1)[names.index(own), 0, 1])
    rest = (cosine - WEIGHT * FORWARD) / (1.0 - WEIGHT)
    lowest, highest = LOBES["asymmetry_2"]
    lobes = {"asymmetry_1": FORWARD, "asymmetry_2": min(max(rest, lowest), highest)}
    return put(tables, path, {"kind": "double-henyey-greenstein", **lobes, "weight": WEIGHT})
