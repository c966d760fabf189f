"""Data for a page that solves edited planets: passes, optical coefficients, amounts.

Only values that leave rays and densities unchanged can be edited: scattering and absorption of each
constituent, and brightness of the ground. ``web/solving/edited_air.js`` computes the coefficients,
and ``web/solving/solver.js`` runs the passes.
"""

from __future__ import annotations

import json
from dataclasses import asdict, replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.physics.optics.reflection import largest_albedo
from airlight.planets.medium import REFRACTION_COLUMN
from airlight.render.gpu.solver.plan import SolverPlan
from airlight.render.gpu.solver.planning import plan_for
from airlight.render.gpu.solver.solver import THICKEST
from airlight.render.pixels.render_tables import WAVELENGTHS
from airlight.solver.moments.delta_m import Optics
from airlight.solver.moments.forward_peak import inverse_peak_fraction, peak_broadening
from airlight.solver.moments.iterate import POLARISED_OVER_RELAXATION
from airlight.solver.moments.levels import finer_weights
from airlight.solver.moments.packing import filled
from airlight.solver.moments.settings import QUALITIES, MomentsSettings
from airlight.solver.moments.setup import (
    NUMERICAL_DIFFUSION,
    OPTICALLY_DEEP,
)
from airlight.solver.moments.solution import MomentsSolution
from airlight.solver.moments.stopping import Stopping
from airlight.solver.moments.synthetic_acceleration import DEGREE, ORDER
from airlight.solver.refracted_geometry import RefractedGeometry
from airlight.viewer.browser.tables_text import DIGITS, as_text, deflated, rounded
from airlight.viewer.browser.web_shaders import solver_shaders

#: Largest amount of a constituent that a page solves, relative to the planet's. [1]
MOST: Final = 10.0
#: Names in the picture of the solver plan's tables that it shares.
SHARED: Final = {
    **{name: name for name in ("first_nodes", "row", "place", "ahead", "back")},
    "start": "harmonic",
}
_TOLERANCE: Final = 2e-3
#: Factor of the extinction of thick atmospheres for which a page's nodes and rays are placed, and
#: beyond which it solves no edit: radiances below the clouds of Venus have errors of 14 % at twice
#: the optical depth for which the nodes were placed. [1]
_HEADROOM: Final = 2.0


def page_settings() -> MomentsSettings:
    """Solver settings of a page: ``preview``, with the degree of optically thick media."""
    preview = QUALITIES["preview"]
    return replace(preview, degree=preview.thick_degree, tolerance=_TOLERANCE)


def solver_data(
    solution: MomentsSolution, settings: MomentsSettings | None = None
) -> dict[str, Any]:
    """Data of the solver as JSON values, read by ``web/solving/solver.js``.

    Parameters
    ----------
    solution : MomentsSolution
        Solution of the unedited planet at three or four wavelengths.
    settings : MomentsSettings, optional
        Settings of the solver; by default ``page_settings()``.
    """
    chosen = page_settings() if settings is None else settings
    medium = solution.medium
    geometry = RefractedGeometry.of(medium)
    own = float(Optics.chosen(geometry.medium, chosen).transport_depth.max())
    plan = plan_for(geometry, chosen, extinction_headroom=_HEADROOM if own > THICKEST else 1.0)
    made = plan.as_dict()
    stopping = Stopping.of_passes(chosen)
    del made["shaders"]
    drawn, optics = geometry.medium, plan.setup.optics
    return {
        "plan": made,
        "uniforms": [float(x) for x in plan.solve.reshape(-1)],
        "scalars": _tables(plan, made["tables"]),
        "shaders": deflated(json.dumps(solver_shaders())),
        "stopping": asdict(stopping),
        "air": {
            "names": [name for name in drawn.names if name != REFRACTION_COLUMN],
            "scattering": _table(_four(drawn.scattering)),
            "absorption": _table(_four(drawn.absorption)),
            "phases": _table(np.moveaxis(_four(np.moveaxis(optics.phases, 1, 2)), 2, 1)),
            "polarised_elements": _table(
                np.moveaxis(_four(np.moveaxis(optics.polarised_elements, 1, 2)), 2, 1)
            ),
            "columns": _table(drawn.columns),
            "degree": optics.degree,
            "albedo": _four(drawn.ground_albedo).tolist(),
            "brightest": largest_albedo(drawn.reflection),
            "day": [float(x) for x in plan.setup.day_weight],
            "thickest": max(THICKEST, _HEADROOM * own),
        },
        "synthetic": {
            **_synthetic(plan),
            "stopping": {
                **asdict(Stopping.of_sweeps(QUALITIES["preview"])),
                "most_sweeps": stopping.most_sweeps,
            },
        },
        "picture": {
            "shared": SHARED,
            "ends": [float(x) for x in plan.setup.march_ends],
            "levels": int(plan.sizes["levels"]),
            "peaks": _peaks(optics),
        },
    }


def _peaks(optics: Optics) -> dict[str, Any]:
    """Forward peaks of the solver's degree, in which those of the picture may differ."""
    gain = peak_broadening(optics)
    table = np.zeros((1, 1, 1)) if gain is None else gain
    values = _four(table).astype(np.float32)
    return {
        "broadened": float(gain is not None),
        "inverse_peak_fraction": _table(_four(inverse_peak_fraction(optics))),
        "broadening": as_text(rounded(values, DIGITS), WAVELENGTHS),
        "shape": list(table.shape[:2]),
    }


def _synthetic(plan: SolverPlan) -> dict[str, Any]:
    """Parameters of synthetic acceleration for optically thick media, as on the CPU."""
    setup, degree = plan.setup, int(plan.sizes["degree"])
    cubics = finer_weights(setup.gathering.radii.size, setup.refinement).astype(np.float32)
    return {
        "thicker": THICKEST,
        "degree": min(degree, DEGREE),
        "order": min(degree, ORDER),
        "cubics": as_text(cubics, cubics.shape[1] + 1),
        "over_relaxation": POLARISED_OVER_RELAXATION.tolist(),
        "diffusion_length": setup.optics.depths.diffusion_length / setup.grid.bottom_radius,
        "grid_diffusion": NUMERICAL_DIFFUSION,
        "deep": OPTICALLY_DEEP,
    }


def _tables(plan: SolverPlan, places: dict[str, Any]) -> dict[str, str]:
    """Encode the tables as text, each as differences along the axis that compresses best."""
    found = {}
    for name, place in places.items():
        if place["texture"] != "scalars":  # the page computes those of the wavelengths
            continue
        start, shape = place["start"], place["shape"]
        values = plan.tables["scalars"][start : start + int(np.prod(shape)), 0]
        if name == "ratios":
            found[name] = as_text(rounded(values, DIGITS), shape[-1] * shape[-2])
        elif name in ("amount", "column"):
            found[name] = as_text(rounded(values, DIGITS), plan.sizes["constituents"])
        else:
            found[name] = min((as_text(values, n) for n in (1, shape[-1])), key=len)
    return found


def _four(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Pad values of shape (..., w) to four wavelengths by repeating the last."""
    return np.asarray(filled(np.asarray(values, np.float64))[..., :WAVELENGTHS])


def _table(values: NDArray[np.float64]) -> dict[str, Any]:
    """Array in the layout of tables in the emitted JavaScript."""
    return {"values": values.reshape(-1).tolist(), "shape": list(values.shape)}
