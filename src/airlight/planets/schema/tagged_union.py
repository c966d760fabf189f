"""Tables of several kinds, distinguished by the key ``kind`` or by their other keys."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from airlight.errors import ParameterError
from airlight.planets.schema.field import Field, FileTable, Wavelengths
from airlight.planets.schema.toml_model import TomlModel
from airlight.planets.schema.toml_table import TomlTable

Kind = TypeVar("Kind", bound=TomlModel)


@dataclass(frozen=True)
class NestedTable:
    """Kind of table that is a single key with a table of its own.

    Attributes
    ----------
    field : Field
        Declaration of the key.
    """

    field: Field

    @property
    def keyword(self) -> str:
        """Key that distinguishes the kind."""
        return self.field.name

    def declared(self, table: FileTable | None = None) -> tuple[Field, ...]:
        """Single key of the table."""
        return (self.field,)

    def read(self, table: TomlTable, wavelengths: Wavelengths = None) -> Any:
        """Read the object from the table within a table of a planet file."""
        table.note((self.keyword,))
        table.finish()
        return self.field.read_from(table, wavelengths)


@dataclass
class Alternatives(Generic[Kind]):
    """Union of kinds of a table, distinguished by a key, the keyword.

    Attributes
    ----------
    base : type
        Class that all kinds derive from.
    classes : tuple of type
        Classes in the order in which they are listed, each with a ``keyword``.
    """

    base: Any
    classes: tuple[type[Kind] | NestedTable, ...] = ()

    @property
    def keywords(self) -> tuple[str, ...]:
        """Words that distinguish the kinds."""
        return tuple(str(one.keyword) for one in self.classes)

    def of(self, keyword: Any) -> Any:
        """Kind of this word."""
        return next((one for one in self.classes if one.keyword == keyword), None)

    def declared(self, table: FileTable | None = None) -> tuple[Field, ...]:
        """Keys of the table's kind; those of all kinds, each name once, if it has no keyword."""
        for one in self.classes:
            if one.keyword in (table or {}):
                return one.declared(table)
        found: dict[str, Field] = {}
        for one in self.classes:
            for key in one.declared():
                found.setdefault(key.name, key)
        return tuple(found.values())

    def read(self, table: TomlTable, wavelengths: Wavelengths = None) -> Kind:
        """Read the object from a table of a planet file."""
        for one in self.classes:
            if one.keyword in table:
                return one.read(table, wavelengths)
        raise ParameterError(
            f"a key of {table.path}", ", ".join(table.names)[:60], ", ".join(self.keywords)
        )


@dataclass
class TaggedUnion(Alternatives[Kind]):
    """Union of kinds of a table, tagged by the key ``kind``.

    Attributes
    ----------
    label, help : str
        Label and help of the choice among them.
    mode : str
        See ``Field``.
    """

    label: str = ""
    help: str = ""
    mode: str = "standard"

    def declared(self, table: FileTable | None = None) -> tuple[Field, ...]:
        """``kind`` and the keys of the table's kind; those of all kinds without ``kind``."""
        choice = Field(
            name="kind",
            label=self.label,
            help=self.help,
            kind="choice",
            choices=lambda: self.keywords,
            mode=self.mode,
            required=True,
        )
        kind = self.of((table or {}).get("kind"))
        return (choice, *(kind.declared(table) if kind else super().declared()))

    def read(self, table: TomlTable, wavelengths: Wavelengths = None) -> Kind:
        """Read the object from a table of a planet file."""
        kind = self.of(table.choice("kind", self.keywords))
        with table.prefix_errors():
            return kind.read(table, wavelengths)  # type: ignore[no-any-return]

    def default_table(self, keyword: str, old: FileTable, thickness: float) -> dict[str, Any]:
        """Default table of a kind; see ``TomlModel.default_table``."""
        return {"kind": keyword, **self.of(keyword).default_table(old, thickness)}
