"""The single uniform struct of all shaders of pictures, with their tables."""

from __future__ import annotations

from typing import Final, NamedTuple

from airlight.gpu.emit.uniform_struct import UniformStruct
from airlight.pixels.pixel import Display, Screen
from airlight.pixels.sky_table import Observer
from airlight.solvers.moments.march_tables import MarchTables

#: Separate vectors: contributions of the wavelengths to a channel.
CHANNELS: Final = ("red", "green", "blue")


class Strip(NamedTuple):
    """Strip of a picture.

    Attributes
    ----------
    first_row : float
        Row of the picture that is the target's first. [pixel]
    """

    first_row: float


#: Numbers and tables that the shaders of pictures may read.
FRAME: Final = UniformStruct("frame", (MarchTables, Observer, Screen, Display, Strip), CHANNELS)
#: Textures of the table of the sky: those of the air, then those of its two peaks.
LAYERS: Final = tuple(table.texture for table in FRAME.tables.values() if not table.start)
