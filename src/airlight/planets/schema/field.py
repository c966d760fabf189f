"""Declaration of a key of a planet file: range, unit, default, choices, control.

A ``Field`` annotates a field of a parameter object and validates its values; reader, overrides,
controls and the key tables of the documentation follow from it.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from types import NoneType, UnionType
from typing import Any, Protocol, Union, get_args, get_origin

import pydantic
from pydantic import BeforeValidator, GetCoreSchemaHandler, ValidationInfo
from pydantic_core import CoreSchema

from airlight.errors import Collector, ParameterError
from airlight.plain_text import is_plain
from airlight.planets.parameters import inside, numbers
from airlight.planets.schema.measures import converted
from airlight.planets.schema.toml_table import TomlTable
from airlight.planets.spectral import LONGEST, SHORTEST, PerWavelength, check_spectral

Wavelengths = tuple[float, ...] | None
#: A table of a planet file, as the TOML parser gives it.
FileTable = Mapping[str, Any]


def always(table: FileTable) -> bool:
    """Show the key in an editor for every table that omits it."""
    return True


def never(table: FileTable) -> bool:
    """Show the key in an editor only if the file has it."""
    return False


class KindOfTable(Protocol):
    """Class, or union of classes, whose objects are read from one kind of table."""

    def declared(self, table: FileTable | None = None) -> tuple[Field, ...]:
        """Keys that this table may have, or any table of the kind."""

    def read(self, table: TomlTable, wavelengths: Wavelengths = None) -> Any:
        """Read the object from a table of a planet file."""


def _no_choices() -> tuple[str, ...]:
    return ()


@dataclass(frozen=True, kw_only=True)
class Field:
    """Declaration of a key of a kind of table.

    Attributes
    ----------
    help : str
        Help of one sentence.
    label : str
        Label of a few words; the name in the file by default.
    name : str
        Name in the file, if different from the field's; ``*`` in a table whose keys are names.
    note : str
        Further sentences for the key tables of the documentation, after ``help``.
    kind : str
        ``number`` (also lists of numbers, and ``words`` instead), ``choice``, ``text``, ``switch``,
        ``table``; by default that of the field's type.
    unit : str
        Unit of the field, of ``range``, and of a number without a unit.
    range : (float, float)
        Allowed values, or lengths of a text. [unit]
    open_ends : bool
        Whether the ends are excluded.
    example : str
        Value as a file may write it, for errors; of a table, the form itself.
    spectral : bool
        Whether a list beside ``wavelengths`` is allowed, as for a field of type ``Spectral``.
    listed : bool
        Whether the value is a list of numbers or tables, as for a field that is a tuple.
    read : callable, optional
        ``read(table, name, wavelengths)``, if the form in the file differs from the field's.
    required : bool, optional
        Whether the key is required; default: whether the field has no default.
    left_out : object
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
    table : class or union of classes, optional
        Kind of the table, or of the tables of a list, under the key.
    prefix : str
        Prefix of the labels of the keys within that table.
    per, per_unit : str
        Key of the list that this list belongs to, and unit in which that list is shown.
    mode : str
        ``standard`` or ``advanced``: by coefficients, or by composition; that of the class by
        default.
    synonyms : tuple of str
        Synonyms for an editor's search.
    """

    help: str
    label: str = ""
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
    left_out: Any = None
    offered: Callable[[FileTable], bool] = never
    shown: str = ""
    slider: tuple[float, float] | None = None
    input_range: tuple[float, float] | None = None
    scale: str = "linear"
    initial: Any = None
    initial_fraction: float | None = None
    choices: Callable[[], tuple[str, ...]] = _no_choices
    placeholder: str = ""
    table: KindOfTable | None = None
    prefix: str = ""
    per: str = ""
    per_unit: str = "nm"
    mode: str = ""
    synonyms: tuple[str, ...] = ()

    # --- of the field -------------------------------------------------------------------------

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        whole = self.of_type(source)
        optional = NoneType in get_args(source)

        def validated(value: Any, info: ValidationInfo) -> Any:
            if optional and value is None:
                return None
            return whole.checked(value, info.field_name or "value")

        return BeforeValidator(validated).__get_pydantic_core_schema__(source, handler)

    def of_type(self, source: Any) -> Field:
        """Declaration completed by the type of the field."""
        types = get_args(source) if get_origin(source) in (Union, UnionType) else (source,)
        items = [get_args(one)[0] for one in types if get_origin(one) is tuple]
        kind = self.kind
        if kind == "number" and float not in types:
            if bool in types:
                kind = "switch"
            elif str in types:
                kind = "text" if self.choices is _no_choices else "choice"
            elif self.table is not None and Any not in types:
                kind = "table"
        spectral = self.spectral or PerWavelength in types
        return replace(
            self,
            kind=kind,
            spectral=spectral,
            listed=self.listed or float in items or (kind == "table" and bool(items)),
            per=self.per or ("wavelengths" if spectral else ""),
        )

    def named(self, name: str, mode: str) -> Field:
        """Declaration under a name in the file, with label and mode filled in."""
        label = self.label or name.replace("_", " ")
        return replace(self, name=name, label=label, mode=self.mode or mode)

    def checked(self, value: Any, field: str) -> Any:
        """Validated value of the field."""
        low, high = self.range
        if self.table is not None and not self.listed:
            base: Any = getattr(self.table, "base", self.table)
            if isinstance(value, base):
                return value
            if self.kind != "number" or (
                dataclasses.is_dataclass(value) and not isinstance(value, PerWavelength)
            ):
                raise ParameterError(field, value, f"one of {base.__name__}")
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

    def read_from(self, table: TomlTable, wavelengths: Wavelengths) -> Any:
        """Value of the key in a table of the file, in ``unit``; None if omitted."""
        name = self.name
        if not self.required and name not in table:
            return None
        if self.read is not None:
            return self.read(table, name, wavelengths)
        if self.table is not None and (self.kind == "table" or isinstance(table.raw(name), dict)):
            return self._table_from(table, wavelengths)
        if self.kind == "choice":
            return table.choice(name, self.choices())
        if self.kind == "text":
            return table.text(name, self.example)
        if self.kind == "switch":
            return table.switch(name)
        if self.listed:
            return table.numbers(name, self.unit, self.example)
        if self.spectral:
            return table.spectral(name, self.unit, self.example, wavelengths)
        return table.number(name, self.unit, self.example)

    def _table_from(self, table: TomlTable, wavelengths: Wavelengths) -> Any:
        """Object of the key's table, or one for each table of its list."""
        assert self.table is not None
        if not self.listed:
            return self.table.read(table.table(self.name, self.example), wavelengths)
        made, collector = [], Collector()
        for one in table.tables(self.name, self.example):
            with collector:
                made.append(self.table.read(one, wavelengths))
        collector.raise_all()
        return tuple(made)

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


def key(base: Field | None = None, *, default: Any = ..., **declared: Any) -> Any:
    """Field of a parameter object with its declaration, as its default value.

    Parameters
    ----------
    base : Field, optional
        Declaration that the following change; none by default.
    default : object
        Default value of the field; without it the field is required.
    **declared
        Attributes of ``Field``.
    """
    info = pydantic.Field(default, kw_only=True)
    info.metadata.append(Field(**declared) if base is None else replace(base, **declared))
    return info


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
