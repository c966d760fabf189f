"""Parameter objects read from tables of a planet file by their declared fields."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Final, Self, get_args, get_origin

from airlight.errors import Collector, ParameterError, changed
from airlight.planets.schema.field import WAVELENGTHS, Field, FileTable, Wavelengths
from airlight.planets.schema.measures import converted, text_of
from airlight.planets.schema.toml_table import TomlTable


class TomlModel:
    """Base of parameter objects whose fields are declared by ``Field``.

    Attributes
    ----------
    keyword : str
        Word or key that selects this kind of table.
    has_wavelengths : bool
        Whether the table has its own list of wavelengths.
    extra_keys : tuple of Field
        Keys of the table that are alternatives to fields.
    mode : str
        See ``Field``.
    """

    keyword: ClassVar[str] = ""
    has_wavelengths: ClassVar[bool] = False
    extra_keys: ClassVar[tuple[Field, ...]] = ()
    mode: ClassVar[str] = "standard"

    @classmethod
    def declared(cls, table: FileTable | None = None) -> tuple[Field, ...]:
        """Keys of its table, in the order of the fields."""
        extra = [key.named(key.name, cls.mode) for key in cls.extra_keys]
        return (*fields_of(cls).values(), *([WAVELENGTHS] if cls.has_wavelengths else []), *extra)

    @classmethod
    def read(cls, table: TomlTable, wavelengths: Wavelengths = None) -> Self:
        """Read the object from a table of a planet file.

        Parameters
        ----------
        wavelengths : tuple of float, optional
            Wavelengths of its lists, if the table has none. [nm]
        """
        collector = Collector()
        values: dict[str, Any] | None = None
        with collector:
            values = cls.read_values(table, wavelengths)
        if values is None:  # unread tables are no unknown keys
            table.note(key.name for key in cls.declared())
        with collector:
            table.finish()
        made: Self | None = None
        with collector:
            made = None if values is None else cls.from_values(table, values)
        collector.raise_all()
        assert made is not None
        return made

    @classmethod
    def read_values(
        cls, table: TomlTable, wavelengths: Wavelengths = None, **known: Any
    ) -> dict[str, Any]:
        """Values of the table, by field; keys that it leaves out are absent.

        Parameters
        ----------
        table, wavelengths
            See ``read``.
        **known
            Values by field that are not read.
        """
        if cls.has_wavelengths:
            wavelengths = table.wavelengths()
        found: dict[str, Any] = dict(known)
        collector = Collector()
        for field, key in fields_of(cls).items():
            if field not in known:
                with collector:
                    found[field] = key.read_from(table, wavelengths)
        collector.raise_all()
        return {field: value for field, value in found.items() if value is not None}

    @classmethod
    def from_values(cls, table: TomlTable, values: Mapping[str, Any]) -> Self:
        """Object with these fields; errors name the key of the file."""
        names = {field: key.name for field, key in fields_of(cls).items()}
        with table.prefix_errors():
            try:
                return cls(**values)
            except ParameterError as error:
                raise changed(error, lambda one: _renamed(one, names)) from None

    @classmethod
    def default_table(cls, old: FileTable, thickness: float) -> dict[str, Any]:
        """Default table of this kind, for an editor.

        Parameters
        ----------
        old : mapping
            Table that it replaces.
        thickness : float
            Thickness of the shell. [m]

        Returns
        -------
        dict
            Table as in a planet file, without ``kind``.
        """
        table: dict[str, Any] = {}
        for key in fields_of(cls).values():
            if key.initial_fraction is not None:
                height = converted(key.initial_fraction * thickness, key.unit, key.shown_unit)
                table[key.name] = text_of(float(f"{height:.4g}"), key.shown_unit)
            elif key.initial is not None:
                table[key.name] = key.initial
        return table


def _renamed(error: ParameterError, names: Mapping[str, str]) -> ParameterError:
    """Error with the key's name instead of the field's."""
    return error.named(names.get(error.field, error.field))


_FIELDS: Final[dict[type[Any], dict[str, Field]]] = {}


def fields_of(cls: type[Any]) -> dict[str, Field]:
    """Declarations of a class's fields, with names and defaults filled in."""
    if cls not in _FIELDS:
        _FIELDS[cls] = _declared_fields(cls)
    return _FIELDS[cls]


def _declared_fields(cls: type[Any]) -> dict[str, Field]:
    found = {}
    for name, info in cls.__pydantic_fields__.items():
        key = _key_in(Annotated[info.annotation, *info.metadata, None])
        if key is not None:
            required = info.is_required()
            found[name] = dataclasses.replace(
                key.of_type(info.annotation).named(key.name or name, cls.mode),
                left_out=info.default if key.left_out is None and not required else key.left_out,
                required=required if key.required is None else key.required,
            )
    return found


def _key_in(hint: Any) -> Field | None:
    """Declaration within an annotation; None without one."""
    if get_origin(hint) is Annotated:
        for one in hint.__metadata__:
            if isinstance(one, Field):
                return one
    return next((key for key in map(_key_in, get_args(hint)) if key is not None), None)
