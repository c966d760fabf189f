"""Compilation of the rendering loops before a solution exists.

The argument types of a loop follow from the annotations of its NamedTuples; a call with empty
tables of these types and zero pixels compiles it.
"""

from __future__ import annotations

import atexit
from collections import defaultdict
from functools import cache
from typing import TYPE_CHECKING, Any, Final, get_args

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.vectors import Vec3
from airlight.kernel.background_compiler import BackgroundCompiler
from airlight.kernel.lanes import LANES
from airlight.kernel.shader_fields import InTexture, shader_fields
from airlight.render.pixels.night_tables import no_night
from airlight.render.pixels.pixel import FrameTables
from airlight.render.pixels.render_cpu import march_pixels, render_pixels
from airlight.render.pixels.ring_shine import no_shine
from airlight.render.pixels.sky_view_cpu import SkyViewLayers, fill_mirrored, fill_texels
from airlight.render.pixels.sky_view_window import SkyViewWindow
from airlight.render.pixels.view_uniforms import cpu_view_uniforms, observer_from
from airlight.scene import Camera
from airlight.solver.moments.march_tables import MarchTables, new_workspace, quadratures

if TYPE_CHECKING:
    from airlight.render.clouds.cloud_tables import CloudTables

Float32Array = NDArray[np.float32]

#: Loops of a frame with a sky-view LUT, in the order of use; and of a frame without.
SKY_VIEW_LOOPS: Final = (fill_texels, fill_mirrored, render_pixels)
MARCH_LOOPS: Final = (march_pixels,)


def start_render_compiler() -> BackgroundCompiler:
    """Start to compile the loops in another process, unless they are on disk."""
    return BackgroundCompiler(f"{__name__}:compile_loops", SKY_VIEW_LOOPS, MARCH_LOOPS)


def start_sky_view_compiler() -> BackgroundCompiler:
    """Start to compile the loops with a sky-view LUT only."""
    return BackgroundCompiler(f"{__name__}:compile_sky_view_loops", SKY_VIEW_LOOPS)


def cloudy_loops(kinds: int = 1, *, marched: bool = False) -> tuple[Any, ...]:
    """Loops of a frame with some kinds of clouds, marched or by a sky-view LUT, in their order."""
    from airlight.render.clouds import air_table
    from airlight.render.clouds.cloudy_pixel import BY_KINDS, march_cloudy

    pixels = (march_cloudy,) if marched else (fill_texels, fill_mirrored, BY_KINDS[kinds - 1])
    return *pixels, air_table._lines, air_table._fill


def start_cloudy_compiler(kinds: int = 1, *, marched: bool = False) -> BackgroundCompiler:
    """Start to compile the loops with clouds."""
    function = compile_marched_clouds if marched else compile_cloudy_loops
    loops = cloudy_loops(kinds, marched=marched)
    return BackgroundCompiler(f"{__name__}:{function.__name__}", loops, arguments=(kinds,))


@cache
def live_cloudy_compiler(kinds: int = 1, *, marched: bool = False) -> BackgroundCompiler:
    """Process that compiles the loops of live frames with clouds, started by the first call."""
    compiler = start_cloudy_compiler(kinds, marched=marched)
    atexit.register(compiler.close)
    return compiler


def compile_cloudy_loops(kinds: int = 1) -> None:
    """Compile or load the loops with a sky-view LUT and some kinds of clouds."""
    first = _arguments()[: len(SKY_VIEW_LOOPS) - 1]
    _call(cloudy_loops(kinds), [*first, *_cloudy_arguments(kinds)])


def compile_marched_clouds(kinds: int = 1) -> None:
    """Compile or load the loops that march pixels with some kinds of clouds."""
    _call(cloudy_loops(kinds, marched=True), _cloudy_arguments(kinds))


def _cloudy_arguments(kinds: int = 1) -> list[tuple[Any, ...]]:
    """Arguments of the last loops of ``cloudy_loops`` for zero pixels and texels."""
    from airlight.render.clouds.cloud_tables import LAYERS, new_cloud_work
    from airlight.render.clouds.cloudy_pixel import CloudyWorkspace

    px, py, frame, work, weights, rgb = _arguments()[-1]
    clouds, observer, tables = empty_clouds(kinds), frame.observer, frame.tables
    pixels = px, py, frame, CloudyWorkspace(work, clouds, new_cloud_work(clouds)), weights, rgb
    window, lines, nodes = SkyViewWindow(2, 2, *(0,) * 6), np.zeros((0, 7)), np.zeros((0, 1))
    out = np.zeros((0, 1, LAYERS, LANES), np.float32)
    texels = window, observer, tables, (1.0,) * 4, lines, nodes
    return [pixels, texels, (lines, nodes, observer, tables, work, out)]


def empty_clouds(kinds: int = 1) -> CloudTables:
    """Tables of some kinds of clouds, with one cell."""
    from airlight.render.clouds.cloud_tables import CloudTables, LayerTables
    from airlight.render.clouds.higher_orders import no_inner
    from airlight.render.clouds.patches import PatchEdges

    def table(rank: int, last: int = 1) -> Float32Array:
        return np.zeros((1,) * (rank - 1) + (last,), np.float32)

    norms, number = np.zeros((1, 1)), 1.0
    lanes, cells, up = table(2, LANES), table(3), Vec3(0.0, 0.0, 1.0)
    edges = PatchEdges(table(2), table(2), np.zeros((1, 1)), np.zeros((1, 1, 2)))
    layer = LayerTables(
        radius=number,
        base=number,
        top=number,
        corner_x=number,
        corner_y=number,
        step_x=number,
        step_y=number,
        step_z=number,
        periodic=False,
        detailed=False,
        trail=number,
        east=up,
        north=up,
        up=up,
        sun=up,
        edges=edges,
        levels=np.ones((1, 3), np.int64),
        source_levels=np.ones((1, 3), np.int64),
        extinction=cells,
        clear=cells,
        depth=cells,
        base_depth=table(2),
        mean_visibility=number,
        source=table(5, 8),
        inner=no_inner(),
        down=table(3, 8),
        solved_extinction=table(2, 8),
        spectrum=lanes,
        scaled=lanes,
        whole=lanes,
        single=lanes,
        phase=table(3, LANES),
        phase_f12=table(3, LANES),
        norms=norms,
        beam=table(3, LANES),
        beam_low=-number,
        beam_high=number,
        slant=np.ones(2),
        local=np.ones((2, 1, 8), np.float32),
    )
    return CloudTables(
        radius=number,
        eye=number,
        base=number,
        top=number,
        pixel_angle=number,
        layers=(layer,) * kinds,
        window=SkyViewWindow.whole(2, 2),
        air=table(4, LANES),
        beyond=table(3, LANES),
    )


def compile_loops() -> None:
    """Compile or load all loops by calls with zero pixels."""
    _call((*SKY_VIEW_LOOPS, *MARCH_LOOPS), _arguments())


def compile_sky_view_loops() -> None:
    """Compile or load the loops with a sky-view LUT."""
    _call(SKY_VIEW_LOOPS, _arguments()[: len(SKY_VIEW_LOOPS)])


def _call(loops: tuple[Any, ...], arguments: list[tuple[Any, ...]]) -> None:
    """Call each loop with its arguments."""
    for loop, own in zip(loops, arguments, strict=True):
        loop(*own)


def _arguments() -> list[tuple[Any, ...]]:
    """Arguments of each loop for zero texels and pixels."""
    tables = empty(MarchTables)._replace(rules=quadratures((1, 1, 1, 1)))
    work = new_workspace(tables)
    numbers: Any = defaultdict(float)
    observer = observer_from(numbers)
    layers, window = SkyViewLayers.none(), SkyViewWindow.whole(2, 2)
    view = cpu_view_uniforms(
        numbers, Camera(width=1, height=1), None, None, layers, no_night(1), no_shine(tables)
    )
    weights, rgb = np.zeros((3, LANES), np.float32), np.zeros((1, 3), np.float32)
    none = np.zeros(0)
    pixels = (none, none, FrameTables(1.0, window, observer, view, tables), work, weights, rgb)
    texels = (0, 0, window, observer, tables, work, layers)
    return [texels, texels, pixels, pixels]


def empty(bundle: Any) -> Any:
    """Instance of a NamedTuple with numbers 1 and tables of one element, of the annotated types.

    Parameters
    ----------
    bundle : type
        NamedTuple of numbers, tables with an ``InTexture``, and others.

    Examples
    --------
    >>> empty(MarchTables).columns.shape, empty(MarchTables).field.dtype
    ((1, 1, 1, 1), dtype('float32'))
    """
    values = []
    for one in shader_fields(bundle):
        kind, mark = one.kind, one.mark
        if one.is_group:
            values.append(empty(kind))
        elif isinstance(mark, InTexture):
            lanes = (LANES,) if mark.spectral else ()
            number = _number(kind, spectral=mark.spectral)
            values.append(np.zeros((1,) * mark.rank + lanes, number))
        else:
            values.append(kind(1))
    return bundle(*values)


def _number(kind: Any, *, spectral: bool) -> Any:
    """Element type of a table, from its annotation or that of spectral tables."""
    inner = [one for part in get_args(kind) for one in get_args(part)]
    named = [one for one in inner if isinstance(one, type) and issubclass(one, np.generic)]
    return named[0] if named else np.float32 if spectral else np.float64
