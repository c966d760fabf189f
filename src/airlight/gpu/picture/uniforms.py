"""The single uniform struct of all shaders, declared here for every language."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final, get_type_hints

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.gpu.emit.dialect import ShaderDialect
from airlight.gpu.emit.shader_types import BOOL, F32, I32, Scalar, Uniform
from airlight.gpu.emit.wgsl import WGSL
from airlight.optics.reflection import Reflection
from airlight.pixels.pixel import Display, Screen
from airlight.pixels.shown import FIELD_TABLES, SCALAR_TABLES, SPECTRAL_TABLES, Shown
from airlight.pixels.sky_table import Observer

#: Types of those fields of NamedTuples that are uniforms; the other fields are tables.
_KINDS: Final = {float: F32, int: I32, bool: BOOL}
#: Numbers that shaders may read, with their types: the fields of the formulas' arguments, and two
#: of the host alone, the first row of a strip and whether pixels are marched.
NUMBERS: Final[dict[str, Scalar]] = {
    **{
        name: _KINDS[kind]
        for bundle in (Shown, Reflection, Observer, Screen, Display)
        for name, kind in get_type_hints(bundle).items()
        if kind in _KINDS
    },
    "first_row": F32,
    "exact": BOOL,
}
SWITCHES: Final = frozenset(name for name, kind in NUMBERS.items() if kind == BOOL)
#: Separate vectors: contributions of the wavelengths to a channel.
CHANNELS: Final = ("red", "green", "blue")
#: Tables: a vec4f each, with its start in its texture and the lengths of its first three axes.
TABLES: Final = (*SCALAR_TABLES, *SPECTRAL_TABLES, *FIELD_TABLES, "levels", "texels")

#: Vector and component of each number.
_PLACES: Final = {
    **{name: (f"numbers_{i // 4}", "xyzw"[i % 4]) for i, name in enumerate(NUMBERS)},
    **{f"{channel}_{i}": (channel, "xyzw"[i]) for channel in CHANNELS for i in range(4)},
}


def uniform(name: str) -> Uniform:
    """Number of the struct, for the emitter.

    Parameters
    ----------
    name : str
        Name from ``NUMBERS``.
    """
    vector, component = _PLACES[name]
    return Uniform(f"frame.{vector}.{component}", NUMBERS[name])


def vectors() -> tuple[str, ...]:
    """Names of all vec4f of the struct, in order."""
    numbers = dict.fromkeys(vector for vector, _ in _PLACES.values())
    return (*numbers, *(f"table_{name}" for name in TABLES))


def struct_text(dialect: ShaderDialect = WGSL) -> str:
    """Struct and its declaration.

    Parameters
    ----------
    dialect : ShaderDialect
        Shading language.
    """
    return dialect.uniforms("frame", vectors(), 0, 0)


def layout() -> dict[str, Any]:
    """Position of each number in the struct, in floats, for a host in another language.

    Examples
    --------
    >>> layout()["numbers"]["top"], layout()["floats"] % 4
    (1, 0)
    """
    names = vectors()
    numbers = {
        name: 4 * names.index(member) + "xyzw".index(component)
        for name, (member, component) in _PLACES.items()
    }
    tables = {name: 4 * names.index(f"table_{name}") for name in TABLES}
    return {"floats": 4 * len(names), "numbers": numbers, "tables": tables}


def packed(
    values: Mapping[str, float], tables: Mapping[str, tuple[int, ...]]
) -> NDArray[np.float32]:
    """Values of the struct as an array of floats.

    Parameters
    ----------
    values : mapping
        Values of the numbers of ``layout``; those left out are 0.
    tables : mapping
        Start in its texture, and lengths of the axes, of each table of ``TABLES``.

    Raises
    ------
    ParameterError
        If a name is not in the struct, or a number is not representable in single precision.
    """
    where = layout()
    out = np.zeros(where["floats"], np.float32)
    for name, value in values.items():
        if name not in where["numbers"]:
            raise ParameterError("uniform", name, ", ".join(where["numbers"]))
        with np.errstate(over="ignore"):
            out[where["numbers"][name]] = value
    for name, shape in tables.items():
        first = where["tables"][name]
        out[first : first + 4] = (*shape, 0, 0, 0)[:4]
    if not np.isfinite(out).all():
        wrong = next(name for name, i in where["numbers"].items() if not np.isfinite(out[i]))
        raise ParameterError(wrong, values[wrong], "a number of single precision")
    return out
