"""Upload of a solution: textures, and positions of the tables in them."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from airlight.image.texels import CHANNELS
from airlight.kernel.large_arrays import release
from airlight.kernel.shader_fields import numbers_of
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.device.flat import MAX_ROWS, flat_rows, flat_texture, packed_texture
from airlight.render.gpu.emit.shader_types import FLAT_WIDTH
from airlight.render.gpu.emit.uniform_struct import Place
from airlight.render.gpu.picture.uniforms import FRAME
from airlight.render.gpu.solver.solver import fields_on
from airlight.render.pixels.capacity import check_capacity
from airlight.render.pixels.night_tables import night_tables
from airlight.render.pixels.render_tables import pack_texels, render_tables
from airlight.render.pixels.view_uniforms import overlay_uniforms, size_uniforms
from airlight.scene.ground_overlay import ground_overlay
from airlight.scene.surface_map import SurfaceMap, surface_map
from airlight.solver.moments.march_tables import MarchTables

if TYPE_CHECKING:
    from airlight.solver.moments.solution import MomentsSolution


@dataclass(frozen=True)
class SolutionTables:
    """Tables of a solution in the layout of the shaders, in CPU memory.

    Attributes
    ----------
    uniforms : dict
        Values of uniforms.
    textures : dict
        Contents of the textures ``scalars``, ``spectra`` and ``fields``, shape (n, 1) or (n, 4).
    places : dict
        Start and axes of each table.
    """

    uniforms: dict[str, float]
    textures: dict[str, NDArray[np.float32]]
    places: dict[str, Place]

    @classmethod
    def of(
        cls,
        solution: MomentsSolution,
        tables: MarchTables | None = None,
        weights: NDArray[np.float64] | None = None,
    ) -> SolutionTables:
        """Tables of a solution.

        Parameters
        ----------
        solution : MomentsSolution
            Solution of at most four wavelengths.
        tables : MarchTables, optional
            Tables from ``render_tables``; computed by default.
        weights : array, shape (nl, 3), optional
            Linear sRGB per radiance; by default ``picture_weights``.
        """
        count = solution.wavelengths.size
        if tables is None:
            tables = render_tables(solution)
        check_capacity(count, tables.constituents)
        values = tables._asdict() | tables.ground._asdict() | tables.ground.layer._asdict()
        values |= tables.rings._asdict()
        values |= night_tables(solution, weights)._asdict()
        layout = {name: FRAME.tables[name] for name in values if name in FRAME.tables}
        textures, places = FRAME.laid_out(
            {
                name: pack_texels(values[name], count) if table.spectral else values[name]
                for name, table in layout.items()
            }
        )
        known = numbers_of(tables)
        uniforms = {name: value for name, value in known.items() if name in FRAME.numbers}
        return cls(uniforms, textures, places)


@dataclass(frozen=True)
class SolutionTextures:
    """Tables of a solution on the GPU, with the ground maps.

    Attributes
    ----------
    uniforms, places : dict
        Values as in ``SolutionTables``, and those of the maps.
    textures : dict
        Textures by their names in the shaders.
    """

    uniforms: dict[str, float]
    places: dict[str, Place]
    textures: dict[str, Any]

    @classmethod
    def of(
        cls,
        device: Device,
        solution: MomentsSolution,
        tables: MarchTables | None = None,
        *,
        maps: bool = True,
        weights: NDArray[np.float64] | None = None,
    ) -> SolutionTextures:
        """Upload a solution; renderers of the device share ground maps.

        Parameters
        ----------
        device : Device
            Device from ``open_device``.
        solution, tables, weights :
            Arguments of ``SolutionTables.of``.
        """
        medium, made = solution.medium, SolutionTables.of(solution, tables, weights)
        solved = fields_on(device, solution)
        textures: dict[str, Any] = {} if solved is None else {"fields": solved}
        for one, contents in made.textures.items():
            if one not in textures:
                textures[one] = flat_texture(device, uneven(contents), one)
        name = medium.surface.picture if maps else None
        found = None if name is None else surface_map(name)
        textures["ground"] = map_texture(device, found, "ground", name)
        over = medium.surface.overlay if maps else (None, None, None)
        overlay = ground_overlay(*over)
        textures["overlay"] = map_texture(device, overlay, "overlay", over)
        uniforms = made.uniforms | overlay_uniforms(solution, weights)
        uniforms |= size_uniforms(found, overlay, uniforms["decked"])
        return cls(uniforms, made.places, textures)


def map_texture(device: Device, found: SurfaceMap | None, label: str, name: Hashable) -> Any:
    """Texture of a ground map, which all renderers of a device share; a texel without a map."""
    texture = device.maps.get((label, name))
    if texture is None:
        texels = np.zeros(CHANNELS, np.uint8) if found is None else found.flat
        texture = device.maps[label, name] = packed_texture(device, texels, label)
        release(texels)
    return texture


def uneven(texels: NDArray[np.float32]) -> NDArray[np.float32]:
    """Texels padded so that the number of rows is not a power of two.

    Mesa recompiles a shader, which takes seconds to minutes, when a texture's height changes to or
    from a power of two.
    """
    rows = flat_rows(len(texels))
    if rows & (rows - 1) or rows == MAX_ROWS:
        return texels
    more = FLAT_WIDTH * (rows + (2 if rows == 1 else 1)) - len(texels)
    return np.pad(texels, ((0, more), (0, 0)))
