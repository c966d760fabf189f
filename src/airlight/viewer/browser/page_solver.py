"""What a page is given to solve the planet anew: the passes, the air's numbers, the amounts.

Only what leaves rays and densities as they are can be changed: how much each constituent scatters
and absorbs, and how bright the ground is. ``web/solving/edited_air.js`` makes the
coefficients from it, and ``web/solving/solver.js`` runs the passes.
"""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.gpu.solver.plan import SolverPlan
from airlight.gpu.solver.planning import THICKEST, ThickAir, plan_for
from airlight.gpu.solver.tables import SCALARS
from airlight.pixels.shown import WAVELENGTHS
from airlight.planets.medium import BENDING
from airlight.solvers.light_paths import LightPaths
from airlight.solvers.moments import convergence
from airlight.solvers.moments.packing import filled
from airlight.solvers.moments.settings import QUALITIES, Settings
from airlight.solvers.moments.solution import MomentsSolution
from airlight.solvers.moments.stopping import Stopping
from airlight.viewer.browser.tables_text import DIGITS, as_text, deflated, rounded
from airlight.viewer.browser.web_shaders import solver_shaders
from airlight.viewer.parameters.parameter import Parameter

#: How much of a constituent there may be, in parts of what the planet has.
MOST: Final = 10.0
#: Tables of the solver's plan that a picture reads too, by their names there.
SHARED: Final = {
    "row": "row", "place": "place", "start": "harmonic", "ahead": "ahead", "back": "back",
}  # fmt: skip
_TOLERANCE: Final = 2e-3


def page_settings() -> Settings:
    """How finely a page solves: like ``preview``, with the degree that thick dust needs."""
    preview = QUALITIES["preview"]
    return replace(preview, degree=preview.thick_degree, tolerance=_TOLERANCE)


def amount_parameters(solution: MomentsSolution) -> tuple[Parameter, ...]:
    """The parameters of a planet that a page solves for: factors, 1 in the beginning."""
    medium = solution.medium
    found = [
        Parameter(
            path=f"air.amounts[{index}]", label="amount", group=name, low=0.1, high=MOST,
            least=0.0, most=MOST, scale="log", step=1.1,
            help="Factor of what it scatters and absorbs, at all wavelengths.",
        )
        for index, name in enumerate(medium.names)
    ]  # fmt: skip
    brightest = float(medium.ground_albedo.max())
    if brightest > 0.0:
        found.append(
            Parameter(
                path="air.ground", label="brightness", group="ground", low=0.0,
                high=1.0 / brightest, least=0.0, most=1.0 / brightest, step=0.1,
                help="Factor of the ground's reflectance, and of its picture.",
            )
        )  # fmt: skip
    return tuple(found)


def solver_data(
    solution: MomentsSolution, settings: Settings | None = None
) -> dict[str, Any] | None:
    """What ``web/solving/solver.js`` reads, as JSON takes it.

    Parameters
    ----------
    solution : MomentsSolution
        Of the planet that is edited, of three or four wavelengths.
    settings : Settings, optional
        How finely an edit is solved; ``page_settings()`` without it.

    Returns
    -------
    dict or None
        None where the air is too thick for successive orders of scattering.
    """
    chosen = page_settings() if settings is None else settings
    medium = solution.medium
    paths = LightPaths.of(medium)
    try:
        plan = plan_for(paths, chosen)
    except ThickAir:
        return None
    made = plan.as_dict()
    stopping = Stopping.of_passes(chosen)
    del made["shaders"]
    drawn = paths.medium
    return {
        "plan": made,
        "uniforms": [float(x) for x in plan.solve.reshape(-1)],
        "scalars": _tables(plan, made["tables"]),
        "shaders": deflated(json.dumps(solver_shaders())),
        "tolerance": stopping.tolerance,
        "most_sweeps": stopping.most_sweeps,
        "stricter": stopping.stricter,
        "night": stopping.night,
        "back": convergence.BACK,
        "air": {
            "names": [name for name in drawn.names if name != BENDING],
            "scattering": _four(drawn.scattering),
            "absorption": _four(drawn.absorption),
            "phases": _four(np.moveaxis(drawn.phase_moments(plan.setup.degree + 1), 2, 1)),
            "columns": [float(x) for x in drawn.columns],
            "albedo": _four(drawn.ground_albedo),
            "day": [float(x) for x in plan.setup.daylight],
            "thickest": THICKEST,
        },
        "picture": {
            "shared": SHARED,
            "ends": [float(x) for x in plan.setup.ends],
            "levels": int(plan.sizes["levels"]),
        },
    }


def _tables(plan: SolverPlan, places: dict[str, Any]) -> dict[str, str]:
    """The tables of numbers as text, each next to its neighbour along the axis that helps most."""
    found = {}
    for name in SCALARS:
        start, shape = places[name]["start"], places[name]["shape"]
        values = plan.scalars[start : start + int(np.prod(shape))]
        if name == "ratios":
            found[name] = as_text(rounded(values, DIGITS), shape[-1] * shape[-2])
        else:
            found[name] = min((as_text(values, n) for n in (1, shape[-1])), key=len)
    return found


def _four(values: NDArray[np.float64]) -> Any:
    """Wavelengths (..., w) as lists of four numbers."""
    return filled(np.asarray(values, np.float64))[..., :WAVELENGTHS].tolist()
