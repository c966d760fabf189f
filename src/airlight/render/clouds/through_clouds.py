"""``ThroughClouds``: transmittance of clouds on lines of sight to space, without their light."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.vectors import Vec3
from airlight.kernel import compiled_loop
from airlight.kernel.lanes import LANES, lane_view, store
from airlight.kernel.without_refcount import without_refcount
from airlight.render.clouds.clear_distance import clear_distances
from airlight.render.clouds.cloud_deck import CloudDeck
from airlight.render.clouds.cloud_march import add_clouds
from airlight.render.clouds.cloud_tables import (
    LAYERS,
    SOLVED,
    CloudTables,
    LayerTables,
    new_cloud_work,
)
from airlight.render.clouds.detail_levels import Cells, stacked
from airlight.render.clouds.directions import harmonic_norms
from airlight.render.clouds.higher_orders import no_inner
from airlight.render.clouds.layer_geometry import layer_geometry
from airlight.render.clouds.sight_extent import sight_extents
from airlight.render.pixels.sky_view_window import SkyViewWindow
from airlight.solver.moments.packing import pack

if TYPE_CHECKING:
    from airlight.scene import Scene
    from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]


class ThroughClouds:
    """Clouds before stars and bodies behind the air of a planet.

    Parameters
    ----------
    decks : sequence of CloudDeck
        Clouds.
    solution, scene : MomentsSolution, Scene
        Solution, and scene in whose local frame, with the first light at azimuth 0, rays are.
    """

    def __init__(self, decks: Sequence[CloudDeck], solution: MomentsSolution, scene: Scene) -> None:
        self._solution = solution
        self._clouds = _dark_tables(decks, solution, scene)

    def transmittance(self, rays: FloatArray) -> FloatArray:
        """Transmittance by clouds of lines of sight, shape (n, nl). [1]

        Parameters
        ----------
        rays : array, shape (n, 3)
            Unit vectors. [1]
        """
        tables = self._solution.tables
        out = np.ones((len(rays), tables.lanes), np.float32)
        _transmittances(
            np.ascontiguousarray(rays), self._clouds, tables, new_cloud_work(self._clouds), out
        )
        return np.asarray(out[:, : self._solution.wavelengths.size], np.float64)


@compiled_loop
def _transmittances(rays, clouds, tables, work, out):
    clouds, tables, work, out = without_refcount((clouds, tables, work, out))
    for k in range(rays.shape[0]):
        ray = Vec3(rays[k, 0], rays[k, 1], rays[k, 2])
        sine = np.hypot(ray.x, ray.y)
        impact = clouds.eye * sine
        to_ground = ray.z < 0.0 and impact < clouds.radius
        extent = sight_extents(ray, sine, to_ground, clouds, work)
        if extent.last > extent.first:
            add_clouds(ray, 0.0, extent, False, clouds, tables, work)
            for at in range(0, tables.lanes, LANES):
                store(out[k], at, lane_view(work.clear, at)[1])


def _dark_tables(
    decks: Sequence[CloudDeck], solution: MomentsSolution, scene: Scene
) -> CloudTables:
    """Tables of clouds without light."""
    radius, nl = solution.medium.bottom_radius, solution.wavelengths.size
    return CloudTables(
        radius=radius,
        eye=radius + scene.altitude,
        base=radius + min(deck.field.base for deck in decks),
        top=radius + max(deck.field.top for deck in decks),
        pixel_angle=float(scene.camera.pixel_angle),
        layers=tuple(_dark_layer(deck, solution, scene) for deck in decks),
        window=SkyViewWindow.whole(0, 0),
        air=pack(np.zeros((1, 2, LAYERS, nl))),
        beyond=pack(np.zeros((1, 3, nl))),
    )


def _dark_layer(deck: CloudDeck, solution: MomentsSolution, scene: Scene) -> LayerTables:
    """Tables of one of the clouds."""
    nl = solution.wavelengths.size
    geometry = layer_geometry(deck.field, scene, solution.medium.bottom_radius)
    cells = np.ascontiguousarray(deck.field.extinction.transpose(2, 1, 0))
    whole = pack(np.asarray(deck.optics_at(solution.wavelengths).extinction)[None])
    dark = np.zeros((1, 2 * SOLVED), np.float32)
    finest = Cells(
        extinction=cells,
        clear=clear_distances(deck.field),
        depth=cells,
        base_depth=cells[0],
        source=dark[None, None, None],
        down=dark[None],
    )
    return LayerTables(
        **geometry,
        sun=Vec3(0.0, 0.0, 1.0),
        **stacked([finest]),
        inner=no_inner(),
        mean_visibility=1.0,
        solved_extinction=dark + np.float32(1.0),
        spectrum=pack(np.zeros((SOLVED, nl))),
        scaled=whole,
        whole=whole,
        single=pack(np.zeros((1, nl))),
        phase=pack(np.zeros((2, 1, nl))),
        phase_f12=pack(np.zeros((2, 1, nl))),
        norms=harmonic_norms(0),
        beam=pack(np.zeros((2, 2, nl))),
        beam_low=-1.0,
        beam_high=1.0,
        slant=np.ones(2),
        local=np.ones((2, 1, 2 * SOLVED), np.float32),
    )
