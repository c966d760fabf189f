"""Table in a flat texture: its type for the emitter, and its reader in each language."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from airlight.gpu.emit.dialect import ShaderDialect
from airlight.gpu.emit.shader_types import F32, FLAT_SHIFT, I32, PACKED_SHIFT, VEC4, Table


@dataclass(frozen=True)
class TextureTable:
    """Array in a flat texture, or a picture in a texture of its own.

    Attributes
    ----------
    name : str
        Its functions in the shader are ``read_NAME`` and, for each axis, ``size_NAME_AXIS``.
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
        start = f" + {dialect.convert(self.start, I32)}" if self.start else ""
        at = "(index >> 2)" if self.by_number else "index"
        kind = VEC4 if self.spectral else F32
        component = "[index & 3]" if self.by_number else "" if self.spectral else ".x"
        lines = [
            dialect.let("place", I32, f"{at}{start}"),
            dialect.fetch(texture, "place", PACKED_SHIFT if self.packed else FLAT_SHIFT)
            + component,
        ]
        read = dialect.function(f"read_{self.name}", [("index", I32)], kind, lines)
        return self._sizes(dialect, self._lengths(dialect)) + read

    def _image_reader(self, dialect: ShaderDialect, texture: str) -> str:
        fetched = dialect.fetch_image(texture, "row", "column")
        places = [("row", I32), ("column", I32)]
        sizes = self._sizes(dialect, [dialect.image_length(texture, str(axis)) for axis in (0, 1)])
        return sizes + dialect.function(f"read_{self.name}", places, VEC4, [fetched])

    def _lengths(self, dialect: ShaderDialect) -> list[str]:
        """Length of each axis, as a constant element of the vector: drivers need not search it."""
        if not self.lengths:
            return []
        named = self.rank - 1 if self.pair else self.rank
        places = [f"{self.lengths}[{axis + self.first}]" for axis in range(named)]
        return [dialect.convert(one, I32) for one in places] + ["2"] * self.pair

    def _sizes(self, dialect: ShaderDialect, lengths: Sequence[str]) -> str:
        return "".join(
            dialect.function(f"size_{self.name}_{axis}", [], I32, [length])
            for axis, length in enumerate(lengths)
        )
