"""The phase functions that a constituent can have: one more is a class of its own, listed here."""

from __future__ import annotations

from typing import Final

from airlight.planets.matter.phases.formulas import (
    CornetteShanks,
    DoubleHenyeyGreenstein,
    HenyeyGreenstein,
    Rayleigh,
)
from airlight.planets.matter.phases.phase_function import (
    INTEGRAL_TOLERANCE,
    FormulaPhase,
    PhaseFunction,
    PhaseRow,
)
from airlight.planets.matter.phases.tabulated import TabulatedPhase
from airlight.planets.schema.kinds import Kinds

__all__ = [
    "INTEGRAL_TOLERANCE", "PHASES", "CornetteShanks", "DoubleHenyeyGreenstein", "FormulaPhase",
    "HenyeyGreenstein", "PhaseFunction", "PhaseRow", "Rayleigh", "TabulatedPhase",
]  # fmt: skip

#: What ``phase_function = { kind = … }`` may name.
PHASES: Final[Kinds[PhaseFunction]] = Kinds(
    (
        Rayleigh,
        HenyeyGreenstein,
        CornetteShanks,
        DoubleHenyeyGreenstein,
        TabulatedPhase,
    ),
    label="phase function",
    help="Its form over the scattering angle.",
)
