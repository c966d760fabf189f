"""Parts of a report page: tables, pictures and text."""

from __future__ import annotations

import io
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Content of a cell; a float is written with four significant digits.
Cell = str | float | int
#: Style of a row: plain, threshold met, threshold missed, or highlighted (our row of a ranking).
Mark = Literal["", "pass", "fail", "ours"]


def cell_text(cell: Cell) -> str:
    """Text of a cell; floats have four significant digits.

    Examples
    --------
    >>> cell_text(0.123456), cell_text(7), cell_text("7.50")
    ('0.1235', '7', '7.50')
    """
    return f"{cell:.4g}" if isinstance(cell, float) else str(cell)


def cells(line: str) -> tuple[str, ...]:
    """Headings, or cells of a row, from one line with bars between them, as in Markdown.

    Examples
    --------
    >>> cells("sun zenith [°] |  | error [%]")
    ('sun zenith [°]', '', 'error [%]')
    """
    return tuple(cell.strip() for cell in line.split("|"))


def _slug(title: str) -> str:
    """Title in lower-case letters, digits and hyphens."""
    return re.sub(r"[^a-z0-9]+", "-", title.lower()).strip("-")


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
        Whether the table is initially collapsed.
    """

    title: str
    columns: Sequence[str]
    rows: Sequence[Sequence[Cell]]
    marks: Sequence[Mark] = ()
    note: str = ""
    folded: bool = False

    @property
    def file_name(self) -> str:
        """Name for the table as a file.

        Examples
        --------
        >>> ReportTable(title="Worst, by scene", columns=(), rows=()).file_name
        'worst-by-scene.csv'
        """
        return f"{_slug(self.title)}.csv"

    def __post_init__(self) -> None:
        """Raise an error for rows that do not match the headings."""
        wrong = [row for row in self.rows if len(row) != len(self.columns)]
        if wrong:
            raise ValueError(f"{self.title}: a row of {len(wrong[0])} for {len(self.columns)}")
        if self.marks and len(self.marks) != len(self.rows):
            raise ValueError(f"{self.title}: {len(self.marks)} marks for {len(self.rows)} rows")


@dataclass(frozen=True, kw_only=True)
class ReportPicture:
    """Picture with its caption.

    Attributes
    ----------
    title : str
        Title on one line, from which the file's name in the Markdown version follows.
    png : bytes
        Contents of the file.
    caption : str
        Description of the picture.
    """

    title: str
    png: bytes
    caption: str = ""

    @classmethod
    def from_figure(
        cls, figure: Figure, *, title: str, caption: str = "", dpi: int = 80
    ) -> ReportPicture:
        """Picture from a matplotlib figure, as a PNG of at most 256 colours."""
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
        >>> ReportPicture(title="Kider 2013-05-27: error, scan by scan", png=b"").file_name
        'kider-2013-05-27-error-scan-by-scan.png'
        """
        return f"{_slug(self.title)}.png"


@dataclass(frozen=True, kw_only=True)
class Text:
    """Paragraphs, plain text, separated by empty lines."""

    text: str


#: Part of a suite's section.
Part = ReportTable | ReportPicture | Text
