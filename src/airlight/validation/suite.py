"""Parts of a suite of the validation report: bars, tables, pictures and text.

A suite computes something, holds it against an authority and returns a ``Suite``: numbers with the
bar that each must meet, and the tables and pictures that show them. The report only sets them.
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

__all__ = ["Bar", "Cancel", "Cell", "Mark", "Part", "Picture", "Progress", "Suite", "Table", "Text"]

#: What stands in a cell; a float is written with four significant digits.
Cell = str | float | int
#: How a row is set: plain, met or missed its bar, or to be noticed (our own row of a league table).
Mark = Literal["", "pass", "fail", "ours"]


@dataclass(frozen=True, kw_only=True)
class Bar:
    """A number that must not be above its bar.

    Attributes
    ----------
    name : str
        What was measured, such as ``"default quality, median error"``.
    got : float
        What came out; NaN is a failure.
    allowed : float
        The most that it may be, in the same unit.
    unit : str
        Such as ``"%"``; empty for a pure number or a count.
    source : str
        Who sets the bar.
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
class Table:
    """A table of numbers and words.

    Attributes
    ----------
    title : str
        One line.
    columns : sequence of str
        Headings, with units.
    rows : sequence of sequence of Cell
        Each as long as ``columns``.
    marks : sequence of Mark
        How each row is set; empty for all plain.
    note : str
        What a reader must know; below the table.
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
    """A picture with its caption.

    Attributes
    ----------
    title : str
        One line; the file's name in the Markdown version follows from it.
    png : bytes
        The file's contents.
    caption : str
        What is seen, and what to look for.
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


#: What stands in a suite's section, in its order.
Part = Table | Picture | Text


@dataclass(frozen=True, kw_only=True)
class Suite:
    """The result of one suite.

    Attributes
    ----------
    name : str
        As ``airlight validate --suite`` calls it.
    title : str
        Heading of its section.
    summary : str
        Two or three sentences: what is compared with what, what came out, what limits it.
    bars : sequence of Bar
        What decides whether the suite passes.
    parts : sequence of Part
        Tables, pictures and words, in the order of reading.
    settings : sequence of str
        Planet, wavelengths, quality, seeds: what somebody needs to do it again.
    seconds : float
        What it took; set by whoever ran it. [s]
    not_run : str
        Why it was left out, such as ``"needs --data"``; empty if it ran.
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
        """Whether every bar is met; a suite without bars, or that was not run, fails none."""
        return all(bar.passed for bar in self.bars)
