"""Tables of a solution in textures, and the position of each."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import sqrt
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.gpu.device.device import Device
from airlight.gpu.device.flat import MOST_ROWS, flat_rows, flat_texture
from airlight.gpu.emit.shader_types import FLAT_WIDTH
from airlight.gpu.emit.uniform_struct import Place
from airlight.gpu.picture.uniforms import FRAME
from airlight.gpu.solver.solver import fields_on
from airlight.pixels.capacity import check_capacity
from airlight.pixels.shown import as_texels, shown_solution
from airlight.scene.surface_map import surface_map
from airlight.solvers.moments.march_tables import MarchTables
from airlight.solvers.moments.solution import MomentsSolution

Levels = Sequence[NDArray[np.float32]]

#: Capacity for a map of the ground with its mip levels, which leaves space for their sizes.
_MAP_NUMBERS: Final = FLAT_WIDTH * (MOST_ROWS - 1)


@dataclass(frozen=True)
class SolutionTables:
    """Tables of a solution as the shaders read them, still in memory.

    Attributes
    ----------
    numbers : dict
        Values of uniforms.
    textures : dict
        Contents of the textures ``scalars``, ``spectra`` and ``fields``, shape (n, 1) or (n, 4).
    places : dict
        Start and axes of each table.
    """

    numbers: dict[str, float]
    textures: dict[str, NDArray[np.float32]]
    places: dict[str, Place]

    @classmethod
    def of(cls, solution: MomentsSolution, shown: MarchTables | None = None) -> SolutionTables:
        """Make the tables of a solution; ``shown`` if it is known already.

        Parameters
        ----------
        solution : MomentsSolution
            Solution of at most four wavelengths.
        shown : MarchTables, optional
            The same solution, prepared for a march.

        Raises
        ------
        ParameterError
            If the wavelengths or constituents exceed the capacity of the shaders.
        """
        count = solution.wavelengths.size
        if shown is None:
            shown = shown_solution(solution)
        check_capacity(count, shown.constituents)
        values = shown._asdict() | shown.ground._asdict()
        tables = {name: FRAME.tables[name] for name in values if name in FRAME.tables}
        textures, places = FRAME.laid_out(
            {
                name: as_texels(values[name], count) if table.spectral else values[name]
                for name, table in tables.items()
            }
        )
        numbers = {name: float(values[name]) for name in values if name in FRAME.numbers}
        return cls(numbers, textures, places)


@dataclass(frozen=True)
class SolutionTextures:
    """Tables of a solution on a device, with the ground's map.

    Attributes
    ----------
    numbers, places : dict
        Values as in ``SolutionTables``, including those of the map.
    textures : dict
        Textures by their names in the shaders.
    """

    numbers: dict[str, float]
    places: dict[str, Place]
    textures: dict[str, Any]

    @classmethod
    def of(
        cls,
        device: Device,
        solution: MomentsSolution,
        shown: MarchTables | None = None,
        before: SolutionTextures | None = None,
    ) -> SolutionTextures:
        """Upload a solution; an unchanged map of the ground is not uploaded again.

        Parameters
        ----------
        device : Device
            Device from ``open_device``.
        solution, shown : MomentsSolution, MarchTables
            Arguments of ``SolutionTables.of``.
        before : SolutionTextures, optional
            Textures shown previously, for their map.

        Raises
        ------
        ParameterError
            Errors of ``SolutionTables.of``.
        """
        made = SolutionTables.of(solution, shown)
        solved = fields_on(device, solution)
        textures: dict[str, Any] = {} if solved is None else {"fields": solved}
        for one, contents in made.textures.items():
            if one not in textures:
                textures[one] = flat_texture(device, _uneven(contents), one)
        name = solution.medium.ground_map
        if before is not None and before.textures.get("map of") == name:
            textures["ground"] = before.textures["ground"]
            places = {one: before.places[one] for one in ("levels", "texels")}
        else:
            texels, places = _map_texels(name)
            textures["ground"] = flat_texture(device, _uneven(texels), "ground")
        textures["map of"] = name
        numbers = made.numbers | {
            "mapped": float(name is not None),
            "map_levels": float(places["levels"][1]),
        }
        return cls(numbers, made.places | places, textures)


def _uneven(texels: NDArray[np.float32]) -> NDArray[np.float32]:
    """Texels with an additional row where the number of rows is a power of two.

    Software devices recompile a shader, which takes them seconds to minutes, when a texture's
    height becomes a power of two or ceases to be one: so none is.
    """
    rows = flat_rows(len(texels))
    if rows & (rows - 1) or rows == MOST_ROWS:
        return texels
    more = FLAT_WIDTH * (rows + (2 if rows == 1 else 1)) - len(texels)
    return np.pad(texels, ((0, more), (0, 0)))


def _map_texels(name: str | None) -> tuple[NDArray[np.float32], dict[str, Place]]:
    """Map of the ground and its mip levels; without a map a single black pixel."""
    levels: Levels = (np.zeros((1, 1, 3), np.float32),)
    if name is not None:
        levels = fitting_levels(surface_map(name).levels, _MAP_NUMBERS)
    starts = np.cumsum([0, *(one.size for one in levels[:-1])])
    shapes = np.array(
        [(start, *one.shape[:2]) for start, one in zip(starts, levels, strict=True)], np.float32
    )
    textures, places = FRAME.laid_out(
        {"levels": shapes, "texels": np.concatenate([one.reshape(-1) for one in levels])}
    )
    return textures["ground"], places


def fitting_levels(levels: Levels, room: int) -> Levels:
    """Mip levels of a map whose numbers together fit into a capacity.

    The finest are left out. A map that cannot be halved is reduced to a size that fits: its new
    pixels are means of the old ones whose centres they cover.

    Parameters
    ----------
    levels : tuple of array, each shape (h, w, 3)
        Levels, the full map first.
    room : int
        Capacity in numbers.

    Examples
    --------
    >>> halvings = [np.zeros((h, 2 * h, 3), np.float32) for h in (4, 2, 1)]
    >>> [one.shape[0] for one in fitting_levels(halvings, 32)]
    [2, 1]
    >>> fitting_levels([np.ones((3, 9, 3), np.float32)], 60)[0].shape
    (2, 7, 3)
    """
    kept = list(levels)
    while len(kept) > 1 and sum(one.size for one in kept) > room:
        kept.pop(0)
    if kept[0].size > room:
        height, width = kept[0].shape[:2]
        scale = sqrt(room / kept[0].size)
        kept[0] = _taken_down(kept[0], max(1, int(height * scale)), max(1, int(width * scale)))
    return tuple(kept)


def _taken_down(map_: NDArray[np.float32], height: int, width: int) -> NDArray[np.float32]:
    """Reduce a map to fewer pixels, each the mean of whole old ones."""
    values = map_.astype(np.float64)
    for axis, count in enumerate((height, width)):
        edges = np.rint(np.linspace(0.0, values.shape[axis], count + 1)).astype(np.intp)
        sums = np.add.reduceat(values, edges[:-1], axis=axis)
        shape = [1, 1, 1]
        shape[axis] = count
        values = sums / np.diff(edges).reshape(shape)
    return np.ascontiguousarray(values, np.float32)
