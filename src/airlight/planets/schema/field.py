"""Declaration of a key of a planet file: range, unit, default, choices, control.

A ``Field`` annotates a field of a parameter object and validates its values; reader, overrides,
controls and the key tables of the documentation follow from it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from pydantic import BeforeValidator, GetCoreSchemaHandler, ValidationInfo
from pydantic_core import CoreSchema

from airlight.errors import ParameterError
from airlight.plain_text import is_plain
from airlight.planets.parameters import inside, numbers
from airlight.planets.schema.measures import converted
from airlight.planets.schema.toml_table import TomlTable
from airlight.planets.spectral import LONGEST, SHORTEST, check_spectral

Wavelengths = tuple[float, ...] | None
#: A table of a planet file, as the TOML parser gives it.
FileTable = Mapping[str, Any]


def always(table: FileTable) -> bool:
    """Show the key in an editor for every table that omits it."""
    return True


def never(table: FileTable) -> bool:
    """Show the key in an editor only if the file has it."""
    return False


class Prebuilt:
    """Base of parameter objects that are valid values of a key."""


def _no_choices() -> tuple[str, ...]:
    return ()


@dataclass(frozen=True, kw_only=True)
class Field:
    """Declaration of a key of a kind of table.

    Attributes
    ----------
    label, help : str
        Label of a few words; help of one sentence.
    name : str
        Name in the file, if different from the field's; ``*`` in a table whose keys are names.
    note : str
        Further sentences for the handbook, after ``help``.
    kind : str
        ``number`` (also lists of numbers, and ``words`` instead), ``choice``, ``text``, ``switch``,
        ``table``.
    unit : str
        Unit of the field, of ``range``, and of a number without a unit.
    range : (float, float)
        Allowed values, or lengths of a text. [unit]
    open_ends : bool
        Whether the ends are excluded.
    example : str
        Example of a value in a file, for errors.
    spectral : bool
        Whether a list over ``wavelengths`` is allowed.
    listed : bool
        Whether the value is a list of numbers.
    read : callable, optional
        ``read(section, name, wavelengths)``, if the form in the file differs from the field's.
    required : bool, optional
        Whether the key is required; default: whether the field has no default.
    default : object
        Value of an omitted key, if different from the field's default.
    offered : callable
        Whether an editor shows the key for a table that omits it.
    shown : str
        Unit in an editor; ``unit`` by default.
    slider : (float, float), optional
        Ends of its slider; ``range`` by default. [shown]
    input_range : (float, float), optional
        Range in an editor, if narrower than ``range``. [shown]
    scale : str
        Scale of the slider: ``linear`` or ``log``.
    initial : object
        Initial value in a new table, as in a file.
    initial_fraction : float, optional
        Initial value over the shell's thickness.
    choices : callable
        Allowed words, looked up at each use.
    placeholder : str
        Word shown by an editor if the key has to be omitted.
    table : str
        Kind of the table, or of the tables of a list, under the key.
    prefix : str
        Prefix of the labels of the keys within that table.
    per, per_unit : str
        Key of the list that this list belongs to, and unit in which that list is shown.
    mode : str
        ``standard`` (coefficients) or ``advanced`` (composition).
    within : str
        Table of the file that contains the key, if not at the top.
    synonyms : tuple of str
        Synonyms for an editor's search.
    """

    label: str
    help: str
    name: str = ""
    note: str = ""
    kind: str = "number"
    unit: str = "1"
    range: tuple[float, float] = (-math.inf, math.inf)
    open_ends: bool = False
    example: str = "1"
    spectral: bool = False
    listed: bool = False
    read: Callable[[TomlTable, str, Wavelengths], Any] | None = None
    required: bool | None = None
    default: Any = None
    offered: Callable[[FileTable], bool] = never
    shown: str = ""
    slider: tuple[float, float] | None = None
    input_range: tuple[float, float] | None = None
    scale: str = "linear"
    initial: Any = None
    initial_fraction: float | None = None
    choices: Callable[[], tuple[str, ...]] = _no_choices
    placeholder: str = ""
    table: str = ""
    prefix: str = ""
    per: str = ""
    per_unit: str = "nm"
    mode: str = "standard"
    within: str = ""
    synonyms: tuple[str, ...] = ()

    # --- of the field -------------------------------------------------------------------------

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        return BeforeValidator(self._validated).__get_pydantic_core_schema__(source, handler)

    def _validated(self, value: Any, info: ValidationInfo) -> Any:
        return self.checked(value, info.field_name or "value")

    def checked(self, value: Any, field: str) -> Any:
        """Validated value of the field."""
        low, high = self.range
        if self.table and isinstance(value, Prebuilt):
            return value
        if self.kind == "choice" and self.choices is not _no_choices:
            if value not in self.choices():
                raise ParameterError(field, value, " or ".join(map(repr, self.choices())))
        elif self.kind == "text":
            if math.isfinite(high) and not (isinstance(value, str) and low <= len(value) <= high):
                raise ParameterError(field, value, f"{low:.0f} to {high:.0f} letters")
            text = value if math.isfinite(high) else str(value).replace("\n", " ")
            if isinstance(text, str) and not is_plain(text):
                raise ParameterError(field, value, "letters without control characters")
        elif self.kind == "number" and math.isfinite(high):
            if self.choices is not _no_choices and isinstance(value, str):
                if value in self.choices():
                    return value
                allowed = f"{low:g} to {high:g} {self.unit_text}".rstrip()
                raise ParameterError(field, value, f"{allowed}, or {', '.join(self.choices())}")
            if self.listed:
                return numbers(value, field, low, high, self.unit_text)
            if self.spectral:
                return check_spectral(value, field, low, high, self.unit_text)
            ends = self.open_ends
            return inside(value, field, low, high, self.unit_text, above=ends, below=ends)
        return value

    @property
    def unit_text(self) -> str:
        """Unit in errors: ``/m`` for ``1/m``, empty for ``1``."""
        return self.unit.removeprefix("1")

    @property
    def unit_words(self) -> str:
        """Unit in tables: ``W m⁻² nm⁻¹`` for ``W/m^2/nm``, empty for ``1``.

        Examples
        --------
        >>> Field(label="g", help="-", unit="m/s^2").unit_words
        'm s⁻²'
        """
        top, *below = self.unit.split("/")
        parts = ([] if top == "1" else [top]) + [_inverse(part) for part in below]
        return " ".join(parts)

    # --- of the file --------------------------------------------------------------------------

    def read_from(self, section: TomlTable, wavelengths: Wavelengths) -> Any:
        """Value of the key in a table of the file, in ``unit``; None if omitted."""
        name = self.name
        if not self.required and name not in section:
            return None
        if self.read is not None:
            return self.read(section, name, wavelengths)
        if self.kind == "choice":
            return section.choice(name, self.choices())
        if self.kind == "text":
            return section.text(name, self.example)
        if self.kind == "switch":
            return section.switch(name)
        if self.listed:
            return section.numbers(name, self.unit, self.example)
        if self.spectral:
            return section.spectral(name, self.unit, self.example, wavelengths)
        return section.number(name, self.unit, self.example)

    # --- of an editor -------------------------------------------------------------------------

    @property
    def shown_unit(self) -> str:
        """Unit in an editor."""
        return self.shown or self.unit.removeprefix("1") or "1"

    @property
    def limits(self) -> tuple[float, float]:
        """Lowest and highest value that an editor accepts. [shown]"""
        if self.input_range is not None or self.kind != "number":
            return self.input_range or self.range
        return tuple(  # type: ignore[return-value]
            converted(end, self.unit, self.shown_unit) if math.isfinite(end) else end
            for end in self.range
        )

    @property
    def ends(self) -> tuple[float, float]:
        """Ends of the slider. [shown]"""
        return self.slider or self.limits


def _inverse(unit: str) -> str:
    """Inverse of a unit: ``s⁻²`` for ``s^2``."""
    name, _, power = unit.partition("^")
    return f"{name}⁻{'¹²³'[int(power or 1) - 1]}"


#: List of wavelengths that the other lists of a table belong to.
WAVELENGTHS = Field(
    name="wavelengths",
    label="wavelength",
    help="Wavelengths of the lists in this table.",
    unit="nm",
    range=(SHORTEST, LONGEST),
    slider=(300.0, 1000.0),
    listed=True,
    example="680, 550, 440 nm",
    mode="advanced",
    required=False,
)
