"""Parts of a suite of the validation report: thresholds, tables, pictures and text.

A suite compares computed values with an authority and returns a ``Suite``, which the report
formats.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from airlight.kernel.threads import Cancel, Progress
from airlight.studies.reports.parts import Cell, Mark, Part, ReportPicture, ReportTable, Text

__all__ = [
    "Threshold",
    "Cancel",
    "Cell",
    "Mark",
    "Part",
    "ReportPicture",
    "Progress",
    "Suite",
    "ReportTable",
    "Text",
]


@dataclass(frozen=True, kw_only=True)
class Threshold:
    """Measured number and its upper limit.

    Attributes
    ----------
    name : str
        Description of the quantity, such as ``"default quality, median error"``.
    got : float
        Measured number; NaN is a failure.
    allowed : float
        Upper limit, in the same unit.
    unit : str
        Unit, such as ``"%"``; empty for a pure number or a count.
    source : str
        Authority for the limit.
    """

    name: str
    got: float
    allowed: float
    unit: str = ""
    source: str = ""

    @property
    def passed(self) -> bool:
        """Whether the threshold is met."""
        return math.isfinite(self.got) and self.got <= self.allowed


@dataclass(frozen=True, kw_only=True)
class Suite:
    """Result of one suite.

    Attributes
    ----------
    name : str
        Name of the suite.
    title : str
        Heading of its section.
    summary : str
        Two or three sentences: comparison, result, limitations.
    thresholds : sequence of Threshold
        Thresholds that decide whether the suite passes.
    parts : sequence of Part
        Tables, pictures and texts, in reading order.
    settings : sequence of str
        Planet, wavelengths, quality and seeds, as needed to repeat the run.
    seconds : float
        Wall time, set by the caller. [s]
    not_run : str
        Reason for omitting it, such as ``"requires reference data"``; empty if it ran.
    """

    name: str
    title: str
    summary: str
    thresholds: Sequence[Threshold] = ()
    parts: Sequence[Part] = ()
    settings: Sequence[str] = ()
    seconds: float = 0.0
    not_run: str = ""

    @property
    def passed(self) -> bool:
        """Whether every threshold is met; True without thresholds, and if it was not run."""
        return all(threshold.passed for threshold in self.thresholds)
