"""Phase functions of a constituent, one class each."""

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
from airlight.planets.schema.tagged_union import TaggedUnion

__all__ = [
    "INTEGRAL_TOLERANCE", "PHASES", "CornetteShanks", "DoubleHenyeyGreenstein", "FormulaPhase",
    "HenyeyGreenstein", "PhaseFunction", "PhaseRow", "Rayleigh", "TabulatedPhase",
]  # fmt: skip

#: Kinds of ``phase_function = { kind = … }``.
PHASES: Final[TaggedUnion[PhaseFunction]] = TaggedUnion(
    (
        Rayleigh,
        HenyeyGreenstein,
        CornetteShanks,
        DoubleHenyeyGreenstein,
        TabulatedPhase,
    ),
    label="phase function",
    help="Shape of the phase function.",
)
