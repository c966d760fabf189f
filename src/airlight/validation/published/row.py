"""Published numbers against those of airlight: tables and thresholds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, Literal

from airlight.validation.suite import Mark, ReportTable, Threshold, cells

Compare = Literal["ratio", "difference"]

#: Headings of a table of rows.
COLUMNS: Final = cells(
    "quantity | published | airlight | airlight over published | stated error | source"
)


@dataclass(frozen=True)
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
        name, source = (
            f"{self.what}: difference from the published",
            f"error or range that {self.source}, states",
        )
        return Threshold(name, self.departure, self.error, self.unit, source)

    @property
    def cells(self) -> tuple[str, ...]:
        """Cells under ``COLUMNS``."""
        compared = (
            f"{self.ours / self.published:.3f}"
            if self.compare == "ratio"
            else f"{self.ours - self.published:+.3f}"
        )
        unit = self.unit if self.unit in ("", "°", "′") else f" {self.unit}"
        published = self.stated or f"{self.published:.4g}{unit}"
        error = "" if self.error is None else f"± {self.error:.2g}"
        return (self.what, published, f"{self.ours:.4g}{unit}", compared, error, self.source)

    @property
    def mark(self) -> Mark:
        """Mark of the row in its table."""
        if self.threshold is None:
            return ""
        return "pass" if self.threshold.passed else "fail"


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
        """Thresholds of the rows, then the targets."""
        return [threshold for row in self.rows if (threshold := row.threshold) is not None] + list(
            self.aims
        )

    @property
    def table(self) -> ReportTable:
        """Table of the report."""
        differences = all(row.compare == "difference" for row in self.rows)
        heading = "airlight less published" if differences else "airlight over published"
        return ReportTable(
            title=self.title,
            columns=[heading if name == "airlight over published" else name for name in COLUMNS],
            rows=[row.cells for row in self.rows],
            marks=[row.mark for row in self.rows],
            note=self.note,
        )
