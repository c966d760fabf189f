"""Parameter of the viewer: its name, path, unit, range and control."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any, Final

from airlight.errors import ParameterError
from airlight.plain_text import is_plain

Value = float | str | bool

#: Kinds of controls.
KINDS: Final = ("number", "choice", "switch", "text")
#: Longest text that can be typed. [character]
LONGEST_TEXT: Final = 1000


@dataclass(frozen=True, kw_only=True)
class Parameter:
    """Declaration of a parameter, sufficient to build its control in any host.

    Attributes
    ----------
    path : str
        Path, as in the overrides of a planet file (``shell.top_radius``,
        ``constituents[0].scattering[2]``), or of the view (``view.altitude``).
    label : str
        Label of a few words, without the unit.
    group : str
        Group of the control: ``planet``, ``shell``, ``ground``, ``star``, the name of a
        constituent; ``camera``, ``sun``, ``display``, ``light``.
    help : str
        Help text of one sentence.
    kind : str
        Kind of the control: ``number``, ``choice``, ``switch`` or ``text``.
    unit : str
        Unit of the number; ``1`` for none.
    low, high : float
        Ends of the slider. [unit]
    least, most : float
        Limits of a typed number, equal to the slider's ends or beyond. [unit] For a text, limits
        of its length. [character]
    scale : str
        Scale of the slider, ``linear`` or ``log``; 0 lies at the low end of ``log``.
    step : float
        Step of an arrow key, added on a linear scale, a factor on ``log``. [unit] or [1]
    wraps : bool
        Whether the number is periodic, as an azimuth is.
    options : tuple of str
        Options of a choice.
    mode : str
        ``standard``: always shown; ``advanced``: composition, shown in the advanced mode.
    part_of : str
        Path of the list that contains the item, so that a host may collapse it; else empty.
    synonyms : tuple of str
        Synonyms, matched by the search.
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
    synonyms: tuple[str, ...] = ()

    def checked(self, value: Any) -> Value:
        """Validate a value, wrapping it into the range if the parameter is periodic.

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
            if not is_plain(value.replace("\n", " ") if math.isinf(self.most) else value):
                raise ParameterError(self.path, value, "letters without control characters")
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
        """All fields as JSON values, without infinite limits."""
        fields = asdict(self)
        fields["options"] = list(self.options)
        fields["synonyms"] = list(self.synonyms)
        return {
            name: value
            for name, value in fields.items()
            if not (isinstance(value, float) and math.isinf(value))
        }

    def answers(self, search: str) -> bool:
        """Whether each word of a search is in its label, group, synonyms, help or path.

        Examples
        --------
        >>> zoom = Parameter(path="view.field_of_view", label="field of view", group="camera",
        ...                  help="-", synonyms=("zoom",))
        >>> zoom.answers("Zoom"), zoom.answers("camera view"), zoom.answers("ozone")
        (True, True, False)
        """
        parts = (self.label, self.group, *self.synonyms, self.help, self.path)
        text = " ".join(parts).lower()
        return all(word in text for word in search.lower().split())

    def at(self, share: float) -> float:
        """Value [unit] at a fraction of the slider, 0 at its low end, 1 at its high end."""
        if self.scale == "log":
            return float(self.low * (self.high / self.low) ** share)
        return self.low + (self.high - self.low) * share


def _slack(limit: float) -> float:
    """Tolerance of a limit against rounding; 0 for an infinite limit. [the limit's unit]"""
    return 1e-12 * abs(limit) if math.isfinite(limit) else 0.0
