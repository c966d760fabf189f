"""One parameter of the viewer: what it is called, where it lies, and what it may be."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any, Final

from airlight.errors import ParameterError

Value = float | str | bool

#: What a control is made of.
KINDS: Final = ("number", "choice", "switch", "text")
#: Longest text that can be typed.
LONGEST_TEXT: Final = 1000


@dataclass(frozen=True, kw_only=True)
class Parameter:
    """A declared parameter: enough for a window, a notebook or a page to make its control.

    Attributes
    ----------
    path : str
        Where it is: as the overrides of a planet file name it (``shell.top_radius``,
        ``constituents[0].scattering[2]``), or one of the view's own (``view.altitude``).
    label : str
        A few words, without the unit.
    group : str
        Controls that stand together: ``planet``, ``shell``, ``ground``, ``star``, the name of a
        constituent; ``camera``, ``sun``, ``display``, ``light``.
    help : str
        A sentence.
    kind : str
        ``number``, ``choice``, ``switch`` or ``text``.
    unit : str
        That its number is in; ``1`` for none.
    low, high : float
        The ends of a slider. [unit]
    least, most : float
        What may be typed; beyond the slider's ends or equal to them. [unit] Of a text: how many
        letters it has.
    scale : str
        ``linear`` or ``log``, of the slider; a value of 0 lies at the low end of ``log``.
    step : float
        Of an arrow key: added if the scale is linear, a factor if it is ``log``. [unit] or [1]
    wraps : bool
        Whether the number goes round, as an azimuth does.
    options : tuple of str
        Of a choice.
    mode : str
        ``standard``: always shown; ``advanced``: composition, shown in the advanced mode.
    part_of : str
        The list that it is an item of, so that a host may fold the list; empty if it is none.
    """

    path: str
    label: str
    group: str
    help: str
    kind: str = "number"
    unit: str = "1"
    low: float = 0.0
    high: float = 1.0
    least: float = -math.inf
    most: float = math.inf
    scale: str = "linear"
    step: float = 0.01
    wraps: bool = False
    options: tuple[str, ...] = ()
    mode: str = "standard"
    part_of: str = ""

    def checked(self, value: Any) -> Value:
        """The value as the parameter takes it, wrapped round if it goes round.

        Raises
        ------
        ParameterError
            If it is of another kind, or outside.

        Examples
        --------
        >>> heading = Parameter(path="view.heading", label="heading", group="camera", help="-",
        ...                     unit="deg", least=0.0, most=360.0, wraps=True)
        >>> heading.checked(-90)
        270.0
        """
        if self.kind == "switch":
            if not isinstance(value, bool):
                raise ParameterError(self.path, value, "true or false")
            return value
        if self.kind == "choice":
            if not isinstance(value, str) or value not in self.options:
                raise ParameterError(self.path, value, ", ".join(self.options))
            return value
        if self.kind == "text":
            least, most = max(self.least, 0.0), min(self.most, LONGEST_TEXT)
            if not isinstance(value, str) or not least <= len(value) <= most:
                raise ParameterError(self.path, value, f"{least:g} to {most:g} letters")
            return value
        return self._number(value)

    def _number(self, value: Any) -> float:
        unit = "" if self.unit == "1" else f" {self.unit}"
        allowed = f"{self.least:.10g} to {self.most:.10g}{unit}"
        try:
            number = math.nan if isinstance(value, (bool, str, bytes)) else float(value)
        except (TypeError, ValueError, OverflowError):
            number = math.nan
        if not math.isfinite(number):
            raise ParameterError(self.path, value, allowed)
        if self.wraps:
            span = self.most - self.least
            return self.least + math.fmod(math.fmod(number - self.least, span) + span, span)
        # A slider's end may miss the limit by rounding.
        least, most = self.least - _slack(self.least), self.most + _slack(self.most)
        if not least <= number <= most:
            raise ParameterError(self.path, value, allowed)
        return min(max(number, self.least), self.most)

    def as_json(self) -> dict[str, Any]:
        """All fields as JSON takes them: infinite limits are left out."""
        fields = asdict(self)
        fields["options"] = list(self.options)
        return {
            name: value
            for name, value in fields.items()
            if not (isinstance(value, float) and math.isinf(value))
        }

    def at(self, share: float) -> float:
        """The number at a share of the slider, 0 at its low and 1 at its high end. [unit]"""
        if self.scale == "log":
            return float(self.low * (self.high / self.low) ** share)
        return self.low + (self.high - self.low) * share


def _slack(limit: float) -> float:
    """What a number may miss a limit by."""
    return 1e-12 * abs(limit) if math.isfinite(limit) else 0.0
