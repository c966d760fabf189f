"""``ThroughClouds``: transmittance of clouds on lines of sight to space, without their light."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_optics import CloudOptics
from airlight.geometry.vectors import Vec3
from airlight.kernel import compiled_loop
from airlight.kernel.lanes import LANES, lane_view, store
from airlight.kernel.without_refcount import without_refcount
from airlight.render.clouds.clear_distance import clear_distances
from airlight.render.clouds.cloud_light import field_axes
from airlight.render.clouds.cloud_march import add_clouds
from airlight.render.clouds.cloud_tables import SOLVED, CloudTables, new_cloud_work
from airlight.render.clouds.directions import harmonic_norms
from airlight.render.clouds.patches import patch_edges
from airlight.render.clouds.sight_extent import sight_extent
from airlight.render.pixels.sky_view_window import SkyViewWindow
from airlight.scene import Scene
from airlight.solver.moments.packing import pack
from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]


class ThroughClouds:
    """Clouds before stars and bodies behind the air of a planet.

    Parameters
    ----------
    field : CloudField
        Clouds.
    optics : CloudOptics
        Optical properties at the wavelengths of the solution.
    solution, scene : MomentsSolution, Scene
        Solution, and scene in whose local frame, with the first light at azimuth 0, rays are.
    """

    def __init__(
        self, field: CloudField, optics: CloudOptics, solution: MomentsSolution, scene: Scene
    ) -> None:
        self._solution = solution
        self._clouds = _dark_tables(field, optics, solution, scene)

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
        extent = sight_extent(
            ray.z, sine, to_ground, clouds.eye, clouds.radius, clouds.base, clouds.top
        )
        if extent.last > extent.first:
            add_clouds(ray, 0.0, extent, clouds, tables, work)
            for at in range(0, tables.lanes, LANES):
                store(out[k], at, lane_view(work.light, at)[2])


def _dark_tables(
    field: CloudField, optics: CloudOptics, solution: MomentsSolution, scene: Scene
) -> CloudTables:
    """Tables of clouds without light."""
    radius, camera = solution.medium.bottom_radius, scene.camera
    east, north, up = field_axes(field, scene)
    nl = solution.wavelengths.size
    cells = np.ascontiguousarray(field.extinction.transpose(2, 1, 0))
    whole = pack(np.asarray(optics.extinction)[None])
    dark = np.zeros((2, 2 * SOLVED), np.float32)
    return CloudTables(
        radius=radius,
        eye=radius + scene.altitude,
        base=radius + field.base,
        top=radius + field.top,
        corner_x=field.west,
        corner_y=field.south,
        step_x=float(field.spacing[0]),
        step_y=float(field.spacing[1]),
        step_z=float(field.spacing[2]),
        periodic=field.beyond == "periodic",
        detailed=field.interpolated and scene.ground == "detailed",
        trail=field.trail,
        east=east,
        north=north,
        up=up,
        sun=Vec3(0.0, 0.0, 1.0),
        pixel_angle=float(camera.pixel_angle),
        mean_visibility=1.0,
        extinction=cells,
        clear=clear_distances(field),
        edges=patch_edges(*field.sides),
        depth=cells,
        base_depth=cells[0],
        source=np.zeros((1, 1, 1, 1, 2 * SOLVED), np.float32),
        down=dark[None],
        solved_extinction=dark[:1] + np.float32(1.0),
        spectrum=pack(np.zeros((SOLVED, nl))),
        scaled=whole,
        whole=whole,
        single=pack(np.zeros((1, nl))),
        phase=pack(np.zeros((2, 1, nl))),
        norms=harmonic_norms(0),
        beam=pack(np.zeros((2, 2, nl))),
        beam_low=-1.0,
        beam_high=1.0,
        air_light=pack(np.ones((2, nl))),
        window=SkyViewWindow.whole(0, 0),
        air=pack(np.zeros((1, 2, 5, nl))),
    )
