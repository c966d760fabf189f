"""The single uniform struct of all shaders of pictures, with their tables."""

from __future__ import annotations

from typing import Annotated, Final, NamedTuple

import numpy as np

from airlight.color.displayed import Display
from airlight.gpu.emit.uniform_struct import UniformStruct
from airlight.kernel.shader_fields import image
from airlight.pixels.pixel import ViewUniforms
from airlight.pixels.sky_view import Observer
from airlight.solvers.moments.march_tables import MarchTables

#: Separate vectors: contributions of the wavelengths to a channel.
CHANNELS: Final = ("red", "green", "blue")


class Strip(NamedTuple):
    """Strip of a picture.

    Attributes
    ----------
    first_row, first_column : float
        Row and column of the picture that are the target's first. [pixel]
    """

    first_row: float
    first_column: float


class Lens(NamedTuple):
    """Picture in linear light, and the pyramid of its glare.

    Attributes
    ----------
    glare : float
        Amount of glare. [1]
    glare_total : float
        Sum of the shares of all levels. [1]
    circle : bool
        Whether the picture ends at a circle.
    level_share : float
        Share of the level that is spread. [1]
    level_more : bool
        Whether there is a coarser level.
    picture, level, coarser : array, shape (height, width)
        Linear sRGB of the picture, of a level, and what the next coarser ones have spread.
        [W m⁻² sr⁻¹]
    """

    glare: float
    glare_total: float
    circle: bool
    level_share: float
    level_more: bool
    picture: Annotated[np.ndarray, image("picture")]
    level: Annotated[np.ndarray, image("level")]
    coarser: Annotated[np.ndarray, image("coarser")]


#: Numbers and tables that the shaders of pictures may read.
FRAME: Final = UniformStruct(
    "frame", (MarchTables, Observer, ViewUniforms, Display, Lens, Strip), CHANNELS
)
#: Textures of the sky-view LUT: those of the air, of its two peaks, and of Q and U.
LAYERS: Final = tuple(
    table.texture
    for table in FRAME.tables.values()
    if not (table.start or table.image or table.packed)
)
