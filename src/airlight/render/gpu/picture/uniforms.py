"""Uniform struct and tables of all rendering and display shaders."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Final, NamedTuple

import numpy as np

from airlight.image.displayed import Display
from airlight.kernel.shader_fields import image
from airlight.render.gpu.emit.uniform_struct import UniformStruct
from airlight.render.pixels.bare_body import BareBody
from airlight.render.pixels.pixel import ViewUniforms
from airlight.render.pixels.render_tables import WAVELENGTHS
from airlight.render.pixels.sky_view_lut import Observer
from airlight.render.pixels.view_uniforms import night_uniforms
from airlight.solver.moments.march_tables import MarchTables

if TYPE_CHECKING:
    from airlight.solver.moments.solution import MomentsSolution

#: Colour matrix: weights of the wavelengths in each channel.
CHANNELS: Final = ("red", "green", "blue")


class Strip(NamedTuple):
    """Position of a strip within the frame.

    Attributes
    ----------
    first_row, first_column : float
        Row and column of the target's first texel. [pixel]
    """

    first_row: float
    first_column: float


class Lens(NamedTuple):
    """Linear radiance, and the pyramid of its glare.

    Attributes
    ----------
    glare : float
        Glare relative to a typical lens. [1]
    glare_total : float
        Sum of the weights of all levels. [1]
    circle : bool
        Whether the image circle is smaller than the frame.
    level_share : float
        Weight of the level. [1]
    level_more : bool
        Whether there is a coarser level.
    picture, level, coarser : array, shape (height, width)
        Linear sRGB of the frame, of a level, and spread light of the next coarser levels.
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


def weight_uniforms(weights: np.ndarray) -> dict[str, float]:
    """Uniforms of the colour matrix.

    Parameters
    ----------
    weights : array, shape (nl, 3)
        Linear sRGB per radiance; missing wavelengths weigh nothing.
    """
    matrix = np.zeros((WAVELENGTHS, len(CHANNELS)))
    matrix[: len(weights)] = weights
    return {
        f"{channel}_{i}": float(value)
        for channel, column in zip(CHANNELS, matrix.T, strict=True)
        for i, value in enumerate(column)
    }


def light_uniforms(
    solution: MomentsSolution, lit: MomentsSolution, weights: np.ndarray | None = None
) -> dict[str, float]:
    """Uniforms of a solution under another light: its colour, its radius, and that of the night.

    Parameters
    ----------
    solution : MomentsSolution
        Solution whose tables are read.
    lit : MomentsSolution
        The same from ``with_light``.
    weights : array, shape (nl, 3), optional
        Linear sRGB per radiance; by default ``picture_weights``.
    """
    uniforms = night_uniforms(lit, weights) | {"star_radius": float(lit.tables.star_radius)}
    own, other = (float(one.lights[0].irradiance.sum()) for one in (solution, lit))
    uniforms["airglow"] *= own / other  # the layers are relative to the whole star
    return uniforms | weight_uniforms(lit.lights[0].colors(weights))


#: Uniforms and tables of the rendering shaders.
FRAME: Final = UniformStruct(
    "frame", (MarchTables, Observer, ViewUniforms, Display, Lens, Strip, BareBody), CHANNELS
)
#: Textures of the sky-view LUT: air and ground, separated constituents, Q and U.
LAYERS: Final = tuple(
    table.texture
    for table in FRAME.tables.values()
    if not (table.start or table.image or table.packed)
)
