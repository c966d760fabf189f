"""Difference from a source document: the printed form, the form used here, its effect."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Final

#: Significant digits of the values: the fewest, and the most if needed to distinguish both sides.
_FEWEST, _MOST = 4, 9

#: The source documents, by the short names that the rows begin with.
SOURCES: Final = {
    "AP1": "J. Boody, Atmosphere Plus notes, the first notes, in two prints (1a, 1b)",
    "AP2": "J. Boody, Atmosphere Plus notes, the later notes",
    "BT": "Atmosphere Ⅱ, a walk through the transmittance of Bruneton (2017), in Chinese",
    "OS": "Costa, Bock, Emmart, Hansen, Ynnerman & Silva (2021), Interactive Visualization of "
    "Atmospheric Effects for Celestial Bodies, IEEE TVCG 27, 785. doi:10.1109/TVCG.2020.3030333",
}


@dataclass(frozen=True, kw_only=True)
class Erratum:
    """A row of the table of differences.

    Parameters
    ----------
    source : str
        Position in the source, such as ``OS Eq 14``.
    printed, here : str
        Text of the source, and the form that replaces it.
    quantity : str
        Quantity computed both ways; empty if no number follows.
    unit : str
        Unit of the numbers.
    as_printed, as_here : tuple of float
        Values of the quantity by the printed form and by ours; empty where it has none.
    remark : str
        Reason, in a few words.

    Examples
    --------
    >>> row = Erratum(
    ...     source="BT", printed="sin θ", here="sin²θ", quantity="at 30°", as_printed=(0.5,),
    ...     as_here=(0.25,),
    ... )
    >>> row.effect
    'at 30°: 0.5 → 0.25'
    """

    source: str
    printed: str
    here: str
    quantity: str = ""
    unit: str = ""
    as_printed: tuple[float, ...] = ()
    as_here: tuple[float, ...] = ()
    remark: str = ""

    @property
    def effect(self) -> str:
        """Value by both forms, and the remark, on one line."""
        if not self.quantity:
            return self.remark
        unit = f" {self.unit}" if self.unit else ""
        pairs = " → ".join(_both(self.as_printed, self.as_here))
        after = f"; {self.remark}" if self.remark else ""
        return f"{self.quantity}: {pairs}{unit}{after}"


def floats(values: Iterable[object]) -> tuple[float, ...]:
    """Convert numbers of any type to a tuple of floats."""
    return tuple(float(value) for value in values)  # type: ignore[arg-type]


def _both(printed: tuple[float, ...], here: tuple[float, ...]) -> tuple[str, str]:
    """Format both sides, each pair with enough digits to distinguish it."""
    if len(printed) != len(here):
        return _shown(printed), _shown(here)
    pairs = [_pair(a, b) for a, b in zip(printed, here, strict=True)]
    return ", ".join(a for a, _ in pairs), ", ".join(b for _, b in pairs)


def _pair(printed: float, here: float) -> tuple[str, str]:
    for digits in range(_FEWEST, _MOST):
        shown = (f"{printed:.{digits}g}", f"{here:.{digits}g}")
        if shown[0] != shown[1]:
            break
    return shown if printed != here else (f"{printed:.{_FEWEST}g}",) * 2


def _shown(values: tuple[float, ...]) -> str:
    return ", ".join(f"{value:.{_FEWEST}g}" for value in values) or "–"
