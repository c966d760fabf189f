"""Table in a texture: its type for the emitter, and its read functions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from airlight.render.gpu.emit.dialect import ShaderDialect
from airlight.render.gpu.emit.shader_types import (
    F32,
    FLAT_SHIFT,
    I32,
    PACKED_SHIFT,
    VEC4,
    ShaderTable,
)


@dataclass(frozen=True)
class TextureTable:
    """Array in a flat texture, or image in its own texture.

    Attributes
    ----------
    name : str
        Name; functions are ``read_NAME`` and, for each axis, ``size_NAME_AXIS``.
    texture : str
        Name of the texture.
    rank : int
        Number of axes.
    spectral : bool
        Whether elements are texels of four wavelengths.
    start : str
        Float expression of the first texel; empty for 0.
    lengths : str
        Expression of a float vector of axis lengths; empty if no length is read.
    first : int
        Component of ``lengths`` with the first axis.
    pair : bool
        Whether the last axis has length two, as it does not fit into ``lengths``.
    by_number : bool
        Whether scalars are read from texels of four.
    packed : bool
        Whether the texture has packed texels, with longer rows.
    image : bool
        Whether it is an image, read by row and column.
    axes : tuple of str
        Expressions of the lengths of the axes after the first, as floats, if no vector has them.
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
    axes: tuple[str, ...] = ()

    @property
    def table(self) -> ShaderTable:
        """Table for the emitter."""
        return ShaderTable(self.name, self.rank, self.spectral, self.image)

    def reader(self, dialect: ShaderDialect, texture: str) -> str:
        """Source of the read and size functions.

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
        """Length of each axis, by constant index into ``lengths``."""
        if not self.lengths:
            return ["0"] * bool(self.axes) + [dialect.convert(one, I32) for one in self.axes]
        named = self.rank - 1 if self.pair else self.rank
        places = [f"{self.lengths}[{axis + self.first}]" for axis in range(named)]
        return [dialect.convert(one, I32) for one in places] + ["2"] * self.pair

    def _sizes(self, dialect: ShaderDialect, lengths: Sequence[str]) -> str:
        return "".join(
            dialect.function(f"size_{self.name}_{axis}", [], I32, [length])
            for axis, length in enumerate(lengths)
        )
