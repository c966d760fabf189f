"""Uniform struct and textures of shaders, from the fields of the NamedTuples that formulas take.

A number is a float of the struct. A table lies behind others in its texture; a vec4f of the struct
has its start and the lengths of its first three axes.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.gpu.emit.dialect import ShaderDialect
from airlight.gpu.emit.shader_types import (
    BOOL,
    F32,
    I32,
    Constant,
    Scalar,
    StructValue,
    Uniform,
    Value,
)
from airlight.gpu.emit.texture_table import TextureTable
from airlight.kernel.shader_fields import CHOICE, Always, InTexture, ShaderField, shader_fields

Float32Array = NDArray[np.float32]
#: Start of a table in its texture, and lengths of its axes.
Place = tuple[int, ...]
#: Numbers whose values are known when a shader is written.
Fixed = tuple[tuple[str, int | bool], ...]

_SCALARS: Final = {float: F32, int: I32, bool: BOOL}


@dataclass(frozen=True, eq=False)
class UniformStruct:
    """Numbers and tables of a group of shaders.

    Parameters
    ----------
    name : str
        Name of the uniform.
    bundles : tuple of type
        NamedTuples with the numbers and tables; two may share a number.
    more : tuple of str
        Vectors of the host alone: numbers of four wavelengths.

    Attributes
    ----------
    numbers : dict from str to Scalar
        Numbers with their types.
    tables : dict from str to TextureTable
        Tables by name.
    choices : tuple of str
        Switches, and indices that are fixed for a whole picture.
    textures : dict from str to int
        Textures of the tables, in the order of the declarations, with their numbers per texel.
    """

    name: str
    bundles: tuple[Any, ...]
    more: tuple[str, ...] = ()
    numbers: dict[str, Scalar] = field(init=False, default_factory=dict)
    tables: dict[str, TextureTable] = field(init=False, default_factory=dict)
    choices: tuple[str, ...] = field(init=False, default=())
    textures: dict[str, int] = field(init=False, default_factory=dict)
    _places: dict[str, tuple[str, str]] = field(init=False, default_factory=dict)
    _layout: dict[str, Any] = field(init=False, default_factory=dict)

    def __post_init__(self) -> None:
        choices = []
        for one in (one for bundle in self.bundles for one in _leaves(bundle)):
            if isinstance(one.mark, InTexture):
                self.tables[one.name] = self._table(one.name, one.mark)
                self.textures.setdefault(one.mark.texture, one.mark.channels)
                continue
            if isinstance(one.mark, Always):
                continue
            if one.kind not in _SCALARS:
                raise TypeError(f"{one.name} is an array without a mark of its texture")
            self.numbers[one.name] = _SCALARS[one.kind]
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
                name, mark.texture, mark.rank, mark.channels == 4, packed=mark.packed,
                image=mark.image,
            )  # fmt: skip
        where = f"{self.name}.table_{name}"
        return TextureTable(
            name, mark.texture, mark.rank, mark.spectral, f"{where}.x", where, 1,
            pair=mark.rank == 4,
        )  # fmt: skip

    # --- in the shader ------------------------------------------------------------------------

    def uniform(self, name: str) -> Uniform:
        """Number of the struct, for the emitter.

        Parameters
        ----------
        name : str
            Name from ``numbers``.
        """
        vector, component = self._places[name]
        return Uniform(f"{self.name}.{vector}.{component}", self.numbers[name])

    def struct_value(self, kind: Any, fixed: Fixed = ()) -> StructValue:
        """NamedTuple for the emitter: its fields are tables, uniforms or constants.

        Parameters
        ----------
        kind : type
            NamedTuple from ``bundles``, or a group of fields inside one.
        fixed : tuple
            Names and values of numbers that are bound as constants.
        """
        known = dict(fixed)
        fields: dict[str, Value] = {}
        for one in shader_fields(kind):
            if _is_group(one):
                fields[one.name] = self.struct_value(one.kind, fixed)
            elif isinstance(one.mark, Always):
                fields[one.name] = Constant(one.mark.value)
            elif one.name in known:
                fields[one.name] = Constant(known[one.name])
            elif one.name in self.tables:
                fields[one.name] = self.tables[one.name].table
            else:
                fields[one.name] = self.uniform(one.name)
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
        """Names of all vec4f of the struct, in order."""
        numbers = dict.fromkeys(vector for vector, _ in self._places.values())
        placed = (name for name, table in self.tables.items() if table.start)
        return (*numbers, *(f"table_{name}" for name in placed))

    def text(self, dialect: ShaderDialect, binding: int = 0) -> str:
        """Struct and its declaration.

        Parameters
        ----------
        dialect : ShaderDialect
            Shading language.
        binding : int
            Slot in group 0.
        """
        return dialect.uniforms(self.name, self.vectors(), 0, binding)

    # --- on the host --------------------------------------------------------------------------

    def layout(self) -> dict[str, Any]:
        """Position of each number in the struct, in floats, for a host in another language."""
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
        """Choices bound as constants, which a software GPU need not test for every pixel.

        Parameters
        ----------
        numbers : mapping
            Values by name; those left out are 0.
        """
        return tuple(
            (name, bool(value) if self.numbers[name] == BOOL else int(value))
            for name, value in ((name, numbers.get(name, 0)) for name in self.choices)
        )

    def laid_out(
        self, arrays: Mapping[str, NDArray[Any]]
    ) -> tuple[dict[str, Float32Array], dict[str, Place]]:
        """Contents of textures from the arrays of their tables, one behind the other.

        Parameters
        ----------
        arrays : mapping
            Arrays of numbers, any shape, or of texels, shape (n, 4), by the names of tables.

        Returns
        -------
        textures : dict
            Texels of each texture that has a table among them, shape (n, 1) or (n, 4).
        places : dict
            Start and lengths of the axes of each table.
        """
        parts: dict[str, list[Float32Array]] = {}
        places: dict[str, Place] = {}
        for name, table in self.tables.items():
            if name not in arrays:
                continue
            channels = self.textures[table.texture]
            before = parts.setdefault(table.texture, [])
            shape = arrays[name].shape if channels == 1 else arrays[name].shape[:1]
            places[name] = (sum(part.shape[0] for part in before), *shape)
            before.append(np.ascontiguousarray(arrays[name], np.float32).reshape(-1, channels))
        return {name: np.concatenate(part) for name, part in parts.items()}, places

    def packed(self, values: Mapping[str, float], places: Mapping[str, Place]) -> Float32Array:
        """Values of the struct as an array of floats.

        Parameters
        ----------
        values : mapping
            Values of the numbers of ``layout``; those left out are 0.
        places : mapping
            Places of tables from ``laid_out``.

        Raises
        ------
        ParameterError
            If a name is not in the struct, or a number is not representable in single precision.
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
            raise ParameterError(wrong, values[wrong], "a number of single precision")
        return out


def _is_group(one: ShaderField) -> bool:
    return hasattr(one.kind, "_fields")


def _leaves(bundle: Any) -> Iterable[ShaderField]:
    """Numbers and tables of a NamedTuple and of those inside it."""
    for one in shader_fields(bundle):
        if _is_group(one):
            yield from _leaves(one.kind)
        else:
            yield one
