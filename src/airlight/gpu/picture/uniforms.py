"""The one uniform struct of all shaders, declared here for every language."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.gpu.emit.dialect import ShaderDialect
from airlight.gpu.emit.shader_types import BOOL, F32, I32, Uniform
from airlight.gpu.emit.wgsl import WGSL
from airlight.pixels.shown import FIELD_TABLES, SCALAR_TABLES, SPECTRAL_TABLES

#: Members of the struct, each a vec4f, and what its four numbers are called.
MEMBERS: Final[dict[str, tuple[str, ...]]] = {
    "shell": ("bottom", "top", "star_radius", "bend"),
    "counts": ("constituents", "degree", "radii", "suns"),
    "peaks": ("phase_nodes", "first_peak", "second_peak", "orders"),
    "observer": ("r", "outside", "horizon_mu", "horizon_sine"),
    "star": ("sun_x", "sun_z", "seen_x", "seen_z"),
    "screen": ("width", "height", "field_of_view", "projection"),
    "camera_right": ("right_x", "right_y", "right_z", "pixel_angle"),
    "camera_up": ("up_x", "up_y", "up_z", "disc"),
    "camera_forward": ("forward_x", "forward_y", "forward_z", "exact"),
    "planet_x": ("xx", "xy", "xz", "mapped"),
    "planet_y": ("yx", "yy", "yz", "map_levels"),
    "planet_z": ("zx", "zy", "zz", "draws_disc"),
    "red": ("red_0", "red_1", "red_2", "red_3"),
    "green": ("green_0", "green_1", "green_2", "green_3"),
    "blue": ("blue_0", "blue_1", "blue_2", "blue_3"),
    "display": ("exposure", "tone_map", "encoding", "first_row"),
    "sky": ("sky_columns", "sky_rows", "keeps_peaks"),
}
#: Numbers that are whole, and those that are switches.
WHOLE: Final = frozenset(
    {
        "constituents", "degree", "radii", "suns", "phase_nodes", "first_peak", "second_peak",
        "orders", "projection", "tone_map", "encoding", "sky_columns", "sky_rows", "map_levels",
    }
)  # fmt: skip
SWITCHES: Final = frozenset({"outside", "exact", "mapped", "keeps_peaks", "draws_disc"})
#: Tables: a vec4f each, where it starts in its texture and the lengths of its first three axes.
TABLES: Final = (*SCALAR_TABLES, *SPECTRAL_TABLES, *FIELD_TABLES, "levels", "texels")

_PLACES: Final = {
    name: (member, "xyzw"[i]) for member, names in MEMBERS.items() for i, name in enumerate(names)
}


def uniform(name: str) -> Uniform:
    """A number of the struct, for the emitter.

    Parameters
    ----------
    name : str
        One of those in ``MEMBERS``.
    """
    member, component = _PLACES[name]
    kind = I32 if name in WHOLE else BOOL if name in SWITCHES else F32
    return Uniform(f"frame.{member}.{component}", kind)


def vectors() -> tuple[str, ...]:
    """Names of all vec4f of the struct, in order."""
    return (*MEMBERS, *(f"table_{name}" for name in TABLES))


def struct_text(dialect: ShaderDialect = WGSL) -> str:
    """The struct and its declaration.

    Parameters
    ----------
    dialect : ShaderDialect
        The language.
    """
    return dialect.uniforms("frame", vectors(), 0, 0)


def layout() -> dict[str, Any]:
    """Where each number stands in the struct, counted in floats: for a host in another language.

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
    """The struct's bytes, as numbers.

    Parameters
    ----------
    values : mapping
        Every number of ``MEMBERS`` that is not 0.
    tables : mapping
        For each table of ``TABLES``: start in its texture, and lengths of its axes.

    Raises
    ------
    ParameterError
        If a name is not one of the struct, or a number has no single precision.
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
