"""A table in a flat texture: what the emitter knows of it, and how each language reads it."""

from __future__ import annotations

from dataclasses import dataclass

from airlight.gpu.emit.dialect import ShaderDialect
from airlight.gpu.emit.shader_types import F32, I32, VEC4, Table


@dataclass(frozen=True)
class TextureTable:
    """An array in a flat texture.

    Attributes
    ----------
    name : str
        Its functions in the shader are ``read_NAME`` and ``size_NAME``.
    texture : str
        In which it stands.
    rank : int
        Number of axes.
    spectral : bool
        Whether an element is a texel of four wavelengths rather than one number.
    start : str
        Expression of its first texel, a float; empty where it begins the texture.
    lengths : str
        Expression of a vector with the lengths of its axes, as floats; empty where nobody asks.
    first : int
        Component of that vector with the first axis.
    pair : bool
        Whether the last axis, for which the vector has no room, is two long.
    by_number : bool
        Whether single numbers are read of texels of four.
    """

    name: str
    texture: str
    rank: int = 1
    spectral: bool = False
    start: str = ""
    lengths: str = ""
    first: int = 0
    pair: bool = False
    by_number: bool = False

    @property
    def table(self) -> Table:
        """What the emitter knows of it."""
        return Table(self.name, self.rank, self.spectral)

    def reader(self, dialect: ShaderDialect, texture: str) -> str:
        """The functions by which a shader reads it.

        Parameters
        ----------
        dialect : ShaderDialect
        texture : str
            Name of the texture in the shader.
        """
        start = f" + {dialect.converted(self.start, I32)}" if self.start else ""
        at = "(index >> 2)" if self.by_number else "index"
        kind = VEC4 if self.spectral else F32
        component = "[index & 3]" if self.by_number else "" if self.spectral else ".x"
        lines = [
            dialect.kept("place", I32, f"{at}{start}"),
            dialect.fetched(texture, "place") + component,
        ]
        read = dialect.function(f"read_{self.name}", [("index", I32)], kind, lines)
        return self._size(dialect) + read

    def _size(self, dialect: ShaderDialect) -> str:
        if not self.lengths:
            return ""
        axis = "min(axis, 2)" if self.pair else "axis"
        more = f" + {self.first}" if self.first else ""
        length = dialect.converted(f"{self.lengths}[{axis}{more}]", I32)
        if self.pair:
            length = dialect.chosen("axis == 3", "2", length)
        return dialect.function(f"size_{self.name}", [("axis", I32)], I32, [length])
