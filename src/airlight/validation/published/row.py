"""Published numbers against those of airlight: tables and thresholds."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, Literal, Protocol

from airlight.errors import AirlightWarning
from airlight.kernel.threads import Cancel, Progress
from airlight.planets import Planet
from airlight.solver import Solution
from airlight.validation.suite import Mark, ReportTable, Threshold


class Solve(Protocol):
    """Solver of a planet at wavelengths [nm] with a quality; see ``solver``."""

    def __call__(
        self, planet: Planet, wavelengths: Sequence[float], quality: object, /, *,
        polarisation: bool = True,
    ) -> Solution:  # fmt: skip
        """Solve; scalar transfer without ``polarisation``."""
        ...


Compare = Literal["ratio", "difference"]

#: Headings of a table of rows.
COLUMNS: Final = ("what", "published", "ours", "ours over it", "stated error", "source")


@dataclass(frozen=True, kw_only=True)
class PublishedRow:
    """Published number and that of airlight.

    Attributes
    ----------
    what : str
        Quantity and conditions.
    published, ours : float
        Published number and that of airlight, in the same unit.
    source : str
        Source of the number.
    unit : str
        Unit; empty for a pure number.
    error : float or None
        Error or half range stated by the source, the threshold of the row; None without one.
    stated : str
        Number as stated by the source, with unit, if not a single number.
    compare : str
        ``"ratio"``, or ``"difference"`` for magnitudes and coordinates.
    """

    what: str
    published: float
    ours: float
    source: str
    unit: str = ""
    error: float | None = None
    stated: str = ""
    compare: Compare = "ratio"

    @property
    def departure(self) -> float:
        """Size of the difference from the published number, in its unit."""
        return abs(self.ours - self.published)

    @property
    def percent(self) -> float:
        """Size of the difference over the published number. [%]"""
        return 100.0 * self.departure / abs(self.published)

    @property
    def threshold(self) -> Threshold | None:
        """Threshold, if the source states an error."""
        if self.error is None:
            return None
        return Threshold(
            name=f"{self.what}: difference from the published", got=self.departure,
            allowed=self.error, unit=self.unit, source=f"error or range that {self.source}, states",
        )  # fmt: skip

    @property
    def cells(self) -> tuple[str | float, ...]:
        """Cells under ``COLUMNS``."""
        compared = (
            f"{self.ours / self.published:.3f}"
            if self.compare == "ratio"
            else f"{self.ours - self.published:+.3f}"
        )
        unit = self.unit if self.unit in ("", "°", "′") else f" {self.unit}"
        return (
            self.what, self.stated or f"{self.published:.4g}{unit}", f"{self.ours:.4g}{unit}",
            compared, "" if self.error is None else f"± {self.error:.2g}", self.source,
        )  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class PublishedSection:
    """Rows of one subject.

    Attributes
    ----------
    title : str
        Title of the table.
    rows : sequence of PublishedRow
    note : str
        Definition of airlight's value, and its dependences.
    aims : sequence of Threshold
        Thresholds over several rows, or of rows without a stated error.
    """

    title: str
    rows: Sequence[PublishedRow]
    note: str = ""
    aims: Sequence[Threshold] = ()

    @property
    def thresholds(self) -> list[Threshold]:
        """Thresholds of the rows, then the aims."""
        return [threshold for row in self.rows if (threshold := row.threshold) is not None] + list(
            self.aims
        )

    @property
    def table(self) -> ReportTable:
        """Table of the report."""
        differences = all(row.compare == "difference" for row in self.rows)
        heading = "ours less it" if differences else "ours over it"
        return ReportTable(
            title=self.title,
            columns=[heading if name == "ours over it" else name for name in COLUMNS],
            rows=[row.cells for row in self.rows],
            marks=[_mark(row) for row in self.rows],
            note=self.note,
        )


def _mark(row: PublishedRow) -> Mark:
    threshold = row.threshold
    if threshold is None:
        return ""
    return "pass" if threshold.passed else "fail"


def solver(progress: Progress | None, cancel: Cancel | None) -> Solve:
    """Solve function with progress and cancellation.

    The cache on disk is not used.
    """
    from airlight.solver import solve

    def solved(
        planet: Planet, wavelengths: Sequence[float], quality: object, /, *,
        polarisation: bool = True,
    ) -> Solution:  # fmt: skip
        def tell(done: int, total: int, message: str) -> None:
            assert progress is not None
            progress(done, total, f"{planet.name}, {message}")

        # Its rows show the effect of omitted bands.
        with warnings.catch_warnings(action="ignore", category=AirlightWarning):
            return solve(
                planet, wavelengths, quality, solver="moments", polarisation=polarisation,
                cache=False, progress=None if progress is None else tell, cancel=cancel,
            )  # fmt: skip

    return solved
