"""Run of a suite of the validation report, and its result: thresholds, tables and pictures.

A suite compares computed values with an authority and returns a ``Suite``, which the report
formats.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from numpy.typing import ArrayLike

from airlight.errors import AirlightWarning, Cancelled
from airlight.kernel.threads import Cancel, Progress
from airlight.planets import Planet
from airlight.solver import Solution, solve
from airlight.studies.reports.parts import Cell, Mark, Part, ReportPicture, ReportTable, Text, cells

__all__ = [
    "Threshold",
    "Cell",
    "Mark",
    "Part",
    "ReportPicture",
    "Suite",
    "SuiteRun",
    "ReportTable",
    "Text",
    "cells",
]


@dataclass(frozen=True, kw_only=True)
class SuiteRun:
    """Circumstances of a suite's work.

    Attributes
    ----------
    data : Path, optional
        Folder of reference data, for the suites that need it.
    quality : str or settings
        Quality of the moments solver, where a suite does not choose it.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``.
    """

    data: Path | None = None
    quality: Any = "default"
    progress: Progress | None = None
    cancel: Cancel | None = None

    @property
    def folder(self) -> Path:
        """Folder of reference data of a suite that needs it."""
        assert self.data is not None
        return self.data

    def step(self, done: int, total: int, message: str) -> None:
        """Tell the progress.

        Raises
        ------
        Cancelled
            If ``cancel`` returned True.
        """
        if self.cancel is not None and self.cancel():
            raise Cancelled("cancelled")
        if self.progress is not None:
            self.progress(done, total, message)

    def solve(
        self,
        planet: Planet,
        wavelengths: ArrayLike,
        quality: Any = None,
        *,
        solver: str = "moments",
        polarisation: bool = True,
    ) -> Solution:
        """Solution, neither read from the disk nor kept there: a report is of this version.

        Parameters
        ----------
        planet, wavelengths, solver, polarisation
            See ``airlight.solve``.
        quality : str or settings, optional
            Quality instead of that of the run.
        """
        tell: Progress | None = None
        if self.progress is not None:
            progress = self.progress

            def tell(done: int, total: int, message: str) -> None:
                progress(done, total, f"{planet.name}, {solver}: {message}")

        # The suites say what bands that are left out change.
        with warnings.catch_warnings(action="ignore", category=AirlightWarning):
            return solve(
                planet,
                wavelengths,
                self.quality if quality is None else quality,
                solver=solver,
                polarisation=polarisation,
                cache=False,
                progress=tell,
                cancel=self.cancel,
            )


@dataclass(frozen=True)
class Threshold:
    """Measured number and its upper limit.

    Attributes
    ----------
    name : str
        Description of the quantity, such as ``"default quality, median error"``.
    result : float
        Measured number; NaN is a failure.
    target : float
        Upper limit, in the same unit.
    unit : str
        Unit, such as ``"%"``; empty for a pure number or a count.
    source : str
        Authority for the limit.
    """

    name: str
    result: float
    target: float
    unit: str = ""
    source: str = ""

    @property
    def texts(self) -> tuple[str, str]:
        """Result and target with their unit."""
        return (
            f"{self.result:.4g} {self.unit}".strip(),
            f"≤ {self.target:.4g} {self.unit}".strip(),
        )

    @property
    def fraction(self) -> float:
        """Result over target; of a target of 0 the result, infinite if it is not a number. [1]"""
        found = self.result / self.target if self.target > 0.0 else self.result
        return found if math.isfinite(found) else math.inf

    @property
    def passed(self) -> bool:
        """Whether the threshold is met."""
        return math.isfinite(self.result) and self.result <= self.target


@dataclass(frozen=True, kw_only=True)
class Suite:
    """Result of one suite.

    Attributes
    ----------
    name, title : str
        Name and heading, set by ``airlight.validation.run``.
    summary : str
        Two or three sentences: comparison, result, limitations.
    thresholds : sequence of Threshold
        Thresholds that decide whether the suite passes.
    parts : sequence of Part
        Tables, pictures and texts, in reading order.
    settings : sequence of str
        Planet, wavelengths, quality and seeds, as needed to repeat the run.
    seconds : float
        Wall time, set by ``airlight.validation.run``. [s]
    not_run : str
        Reason for omitting it, such as ``"requires reference data"``; empty if it ran.
    """

    name: str = ""
    title: str = ""
    summary: str = ""
    thresholds: Sequence[Threshold] = ()
    parts: Sequence[Part] = ()
    settings: Sequence[str] = ()
    seconds: float = 0.0
    not_run: str = ""

    @property
    def nearest(self) -> Threshold | None:
        """Threshold whose result is the largest fraction of its target; None without any."""
        return max(self.thresholds, key=lambda one: one.fraction, default=None)

    @property
    def passed(self) -> bool:
        """Whether every threshold is met; True without thresholds, and if it was not run."""
        return all(threshold.passed for threshold in self.thresholds)
