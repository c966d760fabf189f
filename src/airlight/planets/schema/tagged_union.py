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
class TaggedUnion(Generic[Kind]):
    """Union of kinds of a table, tagged by the key ``kind``.

    Attributes
    ----------
    classes : tuple of type
        Classes in the order in which they are listed; each has a ``keyword``.
    label, help : str
        Label and help of the choice.
    mode : str
        See ``Field``.
    """

    classes: tuple[type[Kind], ...]
    label: str
    help: str
    mode: str = "standard"

    @property
    def keywords(self) -> tuple[str, ...]:
        """Words allowed after ``kind``."""
        return tuple(one.keyword for one in self.classes)

    def of(self, keyword: Any) -> type[Kind] | None:
        """Class of a kind by its keyword."""
        return next((one for one in self.classes if one.keyword == keyword), None)

    def declared(self, table: FileTable | None = None) -> tuple[Field, ...]:
        """``kind`` and the keys of the table's kind; those of all kinds without ``kind``."""
        choice = Field(name="kind", label=self.label, help=self.help, kind="choice",
                     choices=lambda: self.keywords, mode=self.mode, required=True)  # fmt: skip
        kind = self.of((table or {}).get("kind"))
        return (choice, *(kind.declared(table) if kind else merged(self.classes)))

    def read(self, section: TomlTable, wavelengths: Wavelengths = None) -> Kind:
        """Read the object from a table of a planet file."""
        kind = self.of(section.choice("kind", self.keywords))
        assert kind is not None
        with section.prefix_errors():
            return kind.read(section, wavelengths)

    def default_table(self, keyword: str, old: FileTable, thickness: float) -> dict[str, Any]:
        """Default table of a kind; see ``TomlModel.default_table``."""
        kind = self.of(keyword)
        assert kind is not None
        return {"kind": keyword, **kind.default_table(old, thickness)}


@dataclass(frozen=True)
class Alternatives(Generic[Kind]):
    """Union of kinds of a table, distinguished by a key, the keyword.

    Attributes
    ----------
    classes : tuple of type
        Classes, each with a ``keyword``.
    """

    classes: tuple[type[Kind], ...]

    @property
    def keywords(self) -> tuple[str, ...]:
        """Keys that distinguish the kinds."""
        return tuple(one.keyword for one in self.classes)

    def declared(self, table: FileTable | None = None) -> tuple[Field, ...]:
        """Keys of the table's kind; those of all kinds if it has none of the keywords."""
        for one in self.classes:
            if one.keyword in (table or {}):
                return one.declared(table)
        return merged(self.classes)

    def read(self, section: TomlTable, wavelengths: Wavelengths = None) -> Kind:
        """Read the object from a table of a planet file."""
        for one in self.classes:
            if one.keyword in section:
                return one.read(section, wavelengths)
        raise ParameterError(
            f"a key of {section.path}", ", ".join(section.names)[:60], ", ".join(self.keywords)
        )


def merged(classes: tuple[type[Any], ...]) -> tuple[Field, ...]:
    """Keys of several kinds of table, without repetitions of a name."""
    found: dict[str, Field] = {}
    for one in classes:
        for key in one.declared():
            found.setdefault(key.name, key)
    return tuple(found.values())
