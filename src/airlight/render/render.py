"""``render``: rows of pixels on all cores, in blocks that bound the memory."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.geometry.quadrature import gauss_legendre
from airlight.kernel import compiled_loop
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.render.shade import Paint, View, shade
from airlight.render.sun_disc import add_sun_disc, seen_direction
from airlight.scene import Scene
from airlight.scene.frame import Frame
from airlight.scene.surface_map import surface_map
from airlight.solvers.moments.march import new_packet
from airlight.solvers.moments.packing import pack
from airlight.solvers.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Pixels in one block of rows: small enough that no core waits long for the last one.
_BLOCK_PIXELS: Final = 1 << 13


@dataclass(frozen=True, kw_only=True)
class March:
    """How finely the renderer marches.

    Attributes
    ----------
    easy_nodes, nodes, grazing_nodes : int
        Points a panel, for the three kinds of stretches that ``march`` tells apart.
    panels : int
        Panels a leg.
    """

    easy_nodes: int
    nodes: int
    grazing_nodes: int
    panels: int


#: By quality level of the solution: a pixel needs less than a query.
MARCHES: Final = {
    "preview": March(easy_nodes=8, nodes=12, grazing_nodes=24, panels=1),
    "default": March(easy_nodes=8, nodes=12, grazing_nodes=24, panels=1),
}
#: Which light is rendered, as ``march`` takes it.
ORDERS: Final = {"all": 2, "single": 1, "multiple": 0}
_FINE: Final = March(easy_nodes=20, nodes=20, grazing_nodes=24, panels=2)


def render(
    solution: MomentsSolution,
    scene: Scene,
    *,
    orders: str = "all",
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Frame:
    """Render what a camera sees of a planet's air, its ground and its star's disc.

    Parameters
    ----------
    solution : MomentsSolution
        Of at least three wavelengths.
    scene : Scene
        Observer, star and camera.
    orders : str
        ``"all"`` light; or ``"single"``, that the air or the ground has scattered or reflected
        once; or ``"multiple"``, more often. The star's own disc is seen in the first alone.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``.

    Returns
    -------
    Frame
        Linear sRGB radiance.

    Raises
    ------
    ParameterError
        If the solution is of another solver: pictures march the moments; or if there are no
        such orders.
    Cancelled
        If ``cancel`` said so.
    """
    if not isinstance(solution, MomentsSolution):
        raise ParameterError(
            "solution", solution.report.solver, "a solution of the moments solver: a picture "
            "marches its moments",
        )  # fmt: skip
    if orders not in ORDERS:
        raise ParameterError("orders", orders, ", ".join(ORDERS))
    camera = scene.camera
    observer = solution.medium.bottom_radius + scene.altitude
    rgb = np.zeros((camera.height, camera.width, 3), np.float32)
    weights = color_weights(solution)
    view = View(
        r=float(solution.paths.optical_radius(np.array(observer))),
        sun=scene.sun_direction,
        sun_seen=seen_direction(scene.sun_direction, solution, scene.altitude),
        ground_frame=scene.ground_frame,
        pixel_angle=camera.pixel_angle,
        orders=ORDERS[orders],
    )
    march = _march_for(solution)
    counts = (march.easy_nodes, march.nodes, march.grazing_nodes)
    rules = tuple(gauss_legendre(count).as_tuple() for count in counts)
    light, paint = solution.light, _paint(solution, weights)
    step = max(1, _BLOCK_PIXELS // camera.width)

    def rows(index: int) -> None:
        chosen = slice(index * step, min((index + 1) * step, camera.height))
        directions = camera.directions(chosen)
        work = solution.workspace(march.grazing_nodes, march.panels)
        packet = new_packet(light.scattering.size)
        _shade_rows(directions, view, paint, light, march.panels, rules, packet, work, rgb[chosen])

    run_blocks(
        rows, -(-camera.height // step), cancel=cancel, progress=progress, message="rendering"
    )
    if orders == "all":
        add_sun_disc(rgb, solution, scene, weights)
    wavelengths = ", ".join(f"{nm:g}" for nm in solution.wavelengths)
    return Frame(
        rgb=rgb,
        metadata={
            "solver": str(solution.report),
            "wavelengths": f"{wavelengths} nm",
            "unit": "W m-2 sr-1, linear sRGB weighted by CIE 1931",
        },
    )


@compiled_loop
def _shade_rows(directions, view, paint, light, panels, rules, packet, work, out):
    for row in range(directions.shape[0]):
        shade(directions[row], view, paint, light, panels, rules, packet, work, out[row])


def _march_for(solution: MomentsSolution) -> March:
    """The renderer's march for a solution: as coarse as its own grid allows."""
    if solution.settings.march_panels == 1:
        return MARCHES["preview"]
    return MARCHES["default"] if solution.settings.march_panels == 2 else _FINE


def color_weights(solution: MomentsSolution) -> FloatArray:
    """Linear sRGB per radiance over irradiance at each wavelength, shape (nl, 3)."""
    return solution.lights[0].colors()


def _paint(solution: MomentsSolution, weights: FloatArray) -> Paint:
    medium = solution.paths.medium
    padded = np.zeros((3, solution.light.air.ground.albedo.size), np.float32)
    padded[:, : weights.shape[0]] = weights.T
    phases = np.moveaxis(medium.phase_table, 2, 0)
    maps: tuple[Float32Array, ...] = (np.zeros((1, 1, 3), np.float32),)
    if medium.ground_map is not None:
        maps = surface_map(medium.ground_map).levels
    starts = np.cumsum([0, *(one.size for one in maps[:-1])])
    return Paint(
        weights=padded.reshape(-1),
        phase=pack(phases),
        phase_nodes=medium.phase_table.shape[2],
        basis=pack(medium.map_basis.T),
        texels=np.concatenate([one.reshape(-1) for one in maps]),
        levels=np.array([(start, *one.shape[:2]) for start, one in zip(starts, maps, strict=True)]),
        mapped=medium.ground_map is not None,
    )
