"""Parts of a suite of the validation report: bars, tables, pictures and text.

A suite computes something, compares it with an authority and returns a ``Suite``: numbers with the
bar that each must meet, and the tables and pictures that show them. The report only lays them out.
"""

from __future__ import annotations

import io
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from airlight.kernel.threads import Cancel, Progress

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = [
    "Bar",
    "Cancel",
    "Cell",
    "Mark",
    "Part",
    "Picture",
    "Progress",
    "Suite",
    "ReportTable",
    "Text",
]

#: Content of a cell; a float is written with four significant digits.
Cell = str | float | int
#: Style of a row: plain, bar met, bar missed, or highlighted (our own row of a league table).
Mark = Literal["", "pass", "fail", "ours"]


@dataclass(frozen=True, kw_only=True)
class Bar:
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
        """Whether the bar is met."""
        return math.isfinite(self.got) and self.got <= self.allowed


@dataclass(frozen=True, kw_only=True)
class ReportTable:
    """Table of numbers and words.

    Attributes
    ----------
    title : str
        Title on one line.
    columns : sequence of str
        Headings, with units.
    rows : sequence of sequence of Cell
        Cells, each row as long as ``columns``.
    marks : sequence of Mark
        Style of each row; empty if all are plain.
    note : str
        Explanation below the table.
    folded : bool
        Whether a long table is closed until the reader opens it.
    """

    title: str
    columns: Sequence[str]
    rows: Sequence[Sequence[Cell]]
    marks: Sequence[Mark] = ()
    note: str = ""
    folded: bool = False

    def __post_init__(self) -> None:
        """Refuse rows that do not fit the headings."""
        wrong = [row for row in self.rows if len(row) != len(self.columns)]
        if wrong:
            raise ValueError(f"{self.title}: a row of {len(wrong[0])} for {len(self.columns)}")
        if self.marks and len(self.marks) != len(self.rows):
            raise ValueError(f"{self.title}: {len(self.marks)} marks for {len(self.rows)} rows")


@dataclass(frozen=True, kw_only=True)
class Picture:
    """Picture with its caption.

    Attributes
    ----------
    title : str
        Title on one line, from which the file's name in the Markdown version follows.
    png : bytes
        Contents of the file.
    caption : str
        Description of the picture and of what to look for.
    """

    title: str
    png: bytes
    caption: str = ""

    @classmethod
    def from_figure(
        cls, figure: Figure, *, title: str, caption: str = "", dpi: int = 80
    ) -> Picture:
        """Draw a matplotlib figure as a small PNG of at most 256 colours."""
        from PIL import Image

        drawn = io.BytesIO()
        figure.savefig(drawn, format="png", dpi=dpi)
        small = io.BytesIO()
        with Image.open(drawn) as image:
            # Lines and letters need few colours: a third of the bytes.
            palette = image.convert("RGB").quantize(colors=128, dither=Image.Dither.NONE)
            palette.save(small, format="png", optimize=True)
        return cls(title=title, png=small.getvalue(), caption=caption)

    @property
    def file_name(self) -> str:
        """Name for the picture as a file.

        Examples
        --------
        >>> Picture(title="Kider 2013-05-27: error, scan by scan", png=b"").file_name
        'kider-2013-05-27-error-scan-by-scan.png'
        """
        return re.sub(r"[^a-z0-9]+", "-", self.title.lower()).strip("-") + ".png"


@dataclass(frozen=True, kw_only=True)
class Text:
    """Paragraphs, plain text, separated by empty lines."""

    text: str


#: Part of a suite's section.
Part = ReportTable | Picture | Text


@dataclass(frozen=True, kw_only=True)
class Suite:
    """Result of one suite.

    Attributes
    ----------
    name : str
        Name for ``airlight validate --suite``.
    title : str
        Heading of its section.
    summary : str
        Two or three sentences: what is compared with what, what came out, what limits it.
    bars : sequence of Bar
        Bars that decide whether the suite passes.
    parts : sequence of Part
        Tables, pictures and texts, in reading order.
    settings : sequence of str
        Planet, wavelengths, quality and seeds, as needed to repeat the run.
    seconds : float
        Wall time, set by the caller. [s]
    not_run : str
        Reason for leaving it out, such as ``"needs --data"``; empty if it ran.
    """

    name: str
    title: str
    summary: str
    bars: Sequence[Bar] = ()
    parts: Sequence[Part] = ()
    settings: Sequence[str] = ()
    seconds: float = 0.0
    not_run: str = ""

    @property
    def passed(self) -> bool:
        """Whether every bar is met; True for a suite without bars, or that was not run."""
        return all(bar.passed for bar in self.bars)
