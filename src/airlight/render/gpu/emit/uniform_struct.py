"""Uniform struct and texture layout of shaders, from the fields of kernel NamedTuples.

Scalars are floats of the struct. Tables are concatenated in textures; a vec4f of the struct has the
start of each and its first three axis lengths.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, get_origin

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.kernel.shader_fields import CHOICE, Always, InTexture, ShaderField, shader_fields
from airlight.render.gpu.emit.dialect import ShaderDialect
from airlight.render.gpu.emit.shader_types import (
    BOOL,
    SCALARS,
    VEC3,
    Constant,
    Scalar,
    StructValue,
    UniformValue,
    Value,
)
from airlight.render.gpu.emit.texture_table import TextureTable

Float32Array = NDArray[np.float32]
#: Start of a table in its texture, and axis lengths.
Place = tuple[int, ...]
#: Scalars bound as constants.
Fixed = tuple[tuple[str, int | bool], ...]


@dataclass(frozen=True, eq=False, repr=False)
class UniformStruct:
    """Scalars and tables of a group of shaders.

    Parameters
    ----------
    bundles : tuple of type
        NamedTuples with the scalars and tables; they may share scalars.
    more : tuple of str
        Further vectors of four wavelengths.
    named : tuple of (str, type)
        Further NamedTuples, with the beginning of the names of what they hold; so are those inside
        them. Fields that are tuples are left out.

    Attributes
    ----------
    numbers : dict from str to Scalar
        Scalars with their types.
    tables : dict from str to TextureTable
        Tables by name.
    choices : tuple of str
        Booleans, and indices that are constant over a frame.
    textures : dict from str to int
        Textures of the tables in declaration order, with their channels.
    """

    name: str
    bundles: tuple[Any, ...]
    more: tuple[str, ...] = ()
    named: tuple[tuple[str, Any], ...] = ()
    numbers: dict[str, Scalar] = field(init=False, default_factory=dict)
    tables: dict[str, TextureTable] = field(init=False, default_factory=dict)
    choices: tuple[str, ...] = field(init=False, default=())
    textures: dict[str, int] = field(init=False, default_factory=dict)
    _places: dict[str, tuple[str, str]] = field(init=False, default_factory=dict)
    _layout: dict[str, Any] = field(init=False, default_factory=dict)

    def __repr__(self) -> str:
        """Its name, in signatures: the contents fill pages."""
        return f"UniformStruct({self.name!r})"

    def __post_init__(self) -> None:
        choices = []
        every = [
            *((bundle, "") for bundle in self.bundles),
            *((kind, at) for at, kind in self.named),
        ]
        for one in (one for bundle in every for one in _leaves(*bundle)):
            if isinstance(one.mark, InTexture):
                self.tables[one.name] = self._table(one.name, one.mark)
                self.textures.setdefault(one.mark.texture, one.mark.channels)
                continue
            if isinstance(one.mark, Always):
                continue
            if one.kind not in SCALARS:
                raise TypeError(f"{one.name} is an array without a mark of its texture")
            self.numbers[one.name] = SCALARS[one.kind]
            if one.kind is bool or one.mark is CHOICE:
                choices.append(one.name)
        object.__setattr__(self, "choices", tuple(dict.fromkeys(choices)))
        for i, name in enumerate(self.numbers):
            self._places[name] = f"numbers_{i // 4}", "xyzw"[i % 4]
        for name in self.more:
            self._places.update({f"{name}_{i}": (name, "xyzw"[i]) for i in range(4)})
        self._layout.update(self._laid())

    def _table(self, name: str, mark: InTexture) -> TextureTable:
        if mark.whole or mark.packed:
            return TextureTable(
                name,
                mark.texture,
                mark.rank,
                mark.channels == 4,
                packed=mark.packed,
                image=mark.image,
            )
        where, pair = f"{self.name}.table_{name}", mark.rank == 4
        return TextureTable(
            name,
            mark.texture,
            mark.rank,
            mark.spectral,
            f"{where}.x",
            where,
            1,
            pair=pair,
            packed=mark.halved,
        )

    # --- in the shader ------------------------------------------------------------------------

    def uniform(self, name: str) -> UniformValue:
        """Scalar of the struct, for the emitter.

        Parameters
        ----------
        name : str
            Name from ``numbers``.
        """
        vector, component = self._places[name]
        return UniformValue(f"{self.name}.{vector}.{component}", self.numbers[name])

    def struct_value(self, kind: Any, fixed: Fixed = (), start: str = "") -> StructValue:
        """NamedTuple for the emitter, with tables, uniforms and constants as fields.

        Parameters
        ----------
        kind : type
            NamedTuple from ``bundles``, or a nested one.
        fixed : tuple
            Names and values of scalars bound as constants.
        start : str
            Beginning of names, see ``named``.
        """
        known = dict(fixed)
        fields: dict[str, Value] = {}
        for one in shader_fields(kind):
            name = f"{start}{one.name}"
            if one.vector:
                numbers = {of: self.uniform(f"{name}_{of}") for of in one.vector}
                fields[one.name] = StructValue(numbers, VEC3 if one.vector == VEC3.fields else None)
            elif one.is_group:
                inside = f"{name}_" if start else ""
                fields[one.name] = self.struct_value(one.kind, fixed, inside)
            elif isinstance(one.mark, Always):
                fields[one.name] = Constant(one.mark.value)
            elif name in known:
                fields[one.name] = Constant(known[name])
            elif name in self.tables:
                fields[one.name] = self.tables[name].table
            elif get_origin(one.kind) is not tuple:
                fields[one.name] = self.uniform(name)
        return StructValue(fields)

    def read_by(self, body: str) -> list[TextureTable]:
        """Tables that emitted functions read.

        Parameters
        ----------
        body : str
            Text of the functions, in any language.
        """
        called = set(re.findall(r"\b(?:read|size)_(\w+)\(", body))
        return [table for name, table in self.tables.items() if name in called]

    def vectors(self) -> tuple[str, ...]:
        """Fields of the struct, all vec4f, in order."""
        numbers = dict.fromkeys(vector for vector, _ in self._places.values())
        placed = (name for name, table in self.tables.items() if table.start)
        return (*numbers, *(f"table_{name}" for name in placed))

    def text(self, dialect: ShaderDialect, binding: int = 0) -> str:
        """Declaration of the struct.

        Parameters
        ----------
        dialect : ShaderDialect
            Shading language.
        binding : int
            Binding in group 0.
        """
        return dialect.uniforms(self.name, self.vectors(), 0, binding)

    # --- on the host --------------------------------------------------------------------------

    def layout(self) -> dict[str, Any]:
        """Offset of each scalar and table in the struct, in floats, as JSON."""
        return self._layout

    def _laid(self) -> dict[str, Any]:
        names = self.vectors()
        numbers = {
            name: 4 * names.index(member) + "xyzw".index(component)
            for name, (member, component) in self._places.items()
        }
        tables = {
            name: 4 * names.index(f"table_{name}")
            for name, table in self.tables.items()
            if table.start
        }
        return {"floats": 4 * len(names), "numbers": numbers, "tables": tables}

    def fixed(self, numbers: Mapping[str, float]) -> Fixed:
        """``choices`` with their values, to bind as constants for a software GPU.

        Parameters
        ----------
        numbers : mapping
            Values by name; 0 by default.
        """
        return tuple(
            (name, bool(value) if self.numbers[name] == BOOL else int(value))
            for name, value in ((name, numbers.get(name, 0)) for name in self.choices)
        )

    def laid_out(
        self, arrays: Mapping[str, NDArray[Any]]
    ) -> tuple[dict[str, NDArray[Any]], dict[str, Place]]:
        """Texture contents with the tables concatenated.

        Parameters
        ----------
        arrays : mapping
            Arrays of numbers, any shape, or of texels, shape (..., 4), by the names of tables;
            those of 16 bits stay so.

        Returns
        -------
        textures : dict
            Texels of each texture, shape (n, 1) or (n, 4).
        places : dict
            Start and axis lengths of each table.
        """
        parts: dict[str, list[NDArray[Any]]] = {}
        places: dict[str, Place] = {}
        for name, table in self.tables.items():
            if name not in arrays:
                continue
            channels = self.textures[table.texture]
            before = parts.setdefault(table.texture, [])
            shape = arrays[name].shape if channels == 1 else arrays[name].shape[:-1]
            places[name] = (sum(part.shape[0] for part in before), *shape)
            kind = np.float16 if arrays[name].dtype == np.float16 else np.float32
            before.append(np.ascontiguousarray(arrays[name], kind).reshape(-1, channels))
        return {name: np.concatenate(part) for name, part in parts.items()}, places

    def packed(self, values: Mapping[str, float], places: Mapping[str, Place]) -> Float32Array:
        """Contents of the struct.

        Parameters
        ----------
        values : mapping
            Values of the scalars; 0 by default.
        places : mapping
            Positions of tables from ``laid_out``.
        """
        where = self.layout()
        out = np.zeros(where["floats"], np.float32)
        for name, value in values.items():
            if name not in where["numbers"]:
                raise ParameterError("uniform", name, ", ".join(where["numbers"]))
            with np.errstate(over="ignore"):
                out[where["numbers"][name]] = value
        for name, place in places.items():
            out[where["tables"][name] :][:4] = (*place, 0, 0, 0)[:4]
        if not np.isfinite(out).all():
            wrong = next(name for name, i in where["numbers"].items() if not np.isfinite(out[i]))
            raise ParameterError(wrong, values[wrong], "a number within single precision")
        return out


def _leaves(bundle: Any, start: str = "") -> Iterable[ShaderField]:
    """Scalars and tables of a NamedTuple, including nested ones."""
    for one in shader_fields(bundle):
        name = f"{start}{one.name}"
        if one.vector:
            yield from (ShaderField(f"{name}_{of}", float, None) for of in one.vector)
        elif one.is_group:
            yield from _leaves(one.kind, f"{name}_" if start else "")
        elif get_origin(one.kind) is not tuple:
            yield one._replace(name=name)
