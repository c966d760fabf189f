"""Table in a flat texture: its type for the emitter, and its reader in each language."""

from __future__ import annotations

from dataclasses import dataclass

from airlight.gpu.emit.dialect import ShaderDialect
from airlight.gpu.emit.shader_types import F32, FLAT_SHIFT, I32, PACKED_SHIFT, VEC4, Table


@dataclass(frozen=True)
class TextureTable:
    """Array in a flat texture, or a picture in a texture of its own.

    Attributes
    ----------
    name : str
        Its functions in the shader are ``read_NAME`` and ``size_NAME``.
    texture : str
        Texture that holds it.
    rank : int
        Number of axes.
    spectral : bool
        Whether an element is a texel of four wavelengths rather than a single number.
    start : str
        Expression of its first texel, a float; empty if it begins the texture.
    lengths : str
        Expression of a vector with the lengths of its axes, as floats; empty if none is read.
    first : int
        Component of that vector that holds the first axis.
    pair : bool
        Whether the last axis, which does not fit into the vector, has the length two.
    by_number : bool
        Whether single numbers are read from texels of four.
    packed : bool
        Whether the texture is one of packed texels, which has longer rows.
    image : bool
        Whether the texture is a picture, read at row and column.
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
    packed: bool = False
    image: bool = False

    @property
    def table(self) -> Table:
        """Table for the emitter."""
        return Table(self.name, self.rank, self.spectral, self.image)

    def reader(self, dialect: ShaderDialect, texture: str) -> str:
        """Functions with which a shader reads the table.

        Parameters
        ----------
        dialect : ShaderDialect
            Shading language.
        texture : str
            Name of the texture in the shader.
        """
        if self.image:
            return self._image_reader(dialect, texture)
        start = f" + {dialect.converted(self.start, I32)}" if self.start else ""
        at = "(index >> 2)" if self.by_number else "index"
        kind = VEC4 if self.spectral else F32
        component = "[index & 3]" if self.by_number else "" if self.spectral else ".x"
        lines = [
            dialect.kept("place", I32, f"{at}{start}"),
            dialect.fetched(texture, "place", PACKED_SHIFT if self.packed else FLAT_SHIFT)
            + component,
        ]
        read = dialect.function(f"read_{self.name}", [("index", I32)], kind, lines)
        return self._size(dialect) + read

    def _image_reader(self, dialect: ShaderDialect, texture: str) -> str:
        fetched = dialect.image_fetched(texture, "row", "column")
        length = dialect.image_length(texture, "axis")
        places = [("row", I32), ("column", I32)]
        size = dialect.function(f"size_{self.name}", [("axis", I32)], I32, [length])
        return size + dialect.function(f"read_{self.name}", places, VEC4, [fetched])

    def _size(self, dialect: ShaderDialect) -> str:
        if not self.lengths:
            return ""
        axis = "min(axis, 2)" if self.pair else "axis"
        more = f" + {self.first}" if self.first else ""
        length = dialect.converted(f"{self.lengths}[{axis}{more}]", I32)
        if self.pair:
            length = dialect.chosen("axis == 3", "2", length)
        return dialect.function(f"size_{self.name}", [("axis", I32)], I32, [length])
