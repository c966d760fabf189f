"""``CloudsBefore``: clouds between an observer and surfaces of another picture."""

from __future__ import annotations

from collections.abc import Sequence
from math import sqrt

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.vectors import Vec3, dot, plus
from airlight.kernel import compiled_loop
from airlight.kernel.lanes import LANES, exponential, lane_view, load, store
from airlight.kernel.threads import run_blocks
from airlight.kernel.tuple_item import tuple_item
from airlight.kernel.without_refcount import without_refcount
from airlight.render.clouds.cloud_light import CloudLight
from airlight.render.clouds.cloud_march import add_clouds
from airlight.render.clouds.cloud_place import beam_depth_at
from airlight.render.clouds.cloud_tables import (
    HIGHER,
    LOST,
    WHOLE,
    CloudTables,
    new_cloud_work,
)
from airlight.render.clouds.line_of_air import line_of_air
from airlight.render.clouds.sight_extent import (
    SightExtent,
    node_distance,
    node_of_distance,
    sight_extents,
)
from airlight.render.pixels.sky_lookup import classify_ray, sky_view_place
from airlight.render.pixels.sky_view_lut import Observer, half_sine_between
from airlight.solver.moments.march_tables import MarchTables

FloatArray = NDArray[np.float64]

#: Lines of sight in one block of work.
_BLOCK = 1 << 10


class CloudsBefore:
    """Clouds, and their shadows in the air, before surfaces and on them.

    Parameters
    ----------
    clouds, tables, observer : CloudTables, MarchTables, Observer
        Those of a frame of the observer.
    diffuse : array, shape (2, 2, nl)
        Result of ``diffuse_of``. [1]
    """

    def __init__(
        self, clouds: CloudTables, tables: MarchTables, observer: Observer, diffuse: FloatArray
    ) -> None:
        self._clouds, self._tables, self._observer = clouds, tables, observer
        self._diffuse, self._count = diffuse, diffuse.shape[-1]
        clear = clouds.air.copy()
        clear[:, :, HIGHER] += clear[:, :, LOST]
        bright = (
            layer._replace(
                depth=np.zeros_like(layer.depth),
                base_depth=np.zeros_like(layer.base_depth),
                mean_visibility=1.0,
            )
            for layer in clouds.layers
        )
        self._without_shadows = clouds._replace(layers=tuple(bright), air=clear)

    def over(
        self,
        directions: FloatArray,
        distances: FloatArray,
        radiance: FloatArray,
        transmittance: FloatArray,
    ) -> tuple[FloatArray, FloatArray]:
        """Path radiance and transmittance with clouds, of those without.

        Parameters
        ----------
        directions : array, shape (n, 3)
            Unit vectors in the observer's frame, with the light at azimuth 0. [1]
        distances : array, shape (n,)
            Distances of the surfaces; may be infinite. [m]
        radiance, transmittance : array, shape (n, nl)
            Results of ``PathRadiance.before``. [sr⁻¹], [1]
        """
        out = np.zeros((len(directions), 3, self._tables.lanes), np.float32)
        out[:, 1] = 1.0
        rays = np.ascontiguousarray(directions)

        def run(k: int) -> None:
            part = slice(k * _BLOCK, (k + 1) * _BLOCK)
            works = new_cloud_work(self._clouds), new_cloud_work(self._clouds)
            _before(
                rays[part],
                distances[part],
                self._observer,
                self._clouds,
                self._without_shadows,
                self._tables,
                works[0],
                works[1],
                out[part],
            )

        run_blocks(run, -(-len(rays) // _BLOCK))
        light, through, lost = (out[:, k, : self._count].astype(float) for k in range(3))
        return light + through * np.maximum(radiance - lost, 0.0), transmittance * through

    def on(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Factors of the light that falls on points.

        Parameters
        ----------
        points : array, shape (n, 3)
            In the observer's frame, from the observer. [m]

        Returns
        -------
        beam : array, shape (n, nl)
            Transmittance of the clouds for the light's beam. [1]
        diffuse : array, shape (2, n, nl)
            Mean diffuse light from above and from below over that of clear sky; between base and
            top of the clouds interpolated. [1]
        """
        beam = np.ones((len(points), self._tables.lanes), np.float32)
        up = np.empty(len(points))
        _at_points(np.ascontiguousarray(points), self._clouds, self._tables, beam, up)
        below, above = self._diffuse
        share = up[:, None]
        diffuse = below[:, None] + (above - below)[:, None] * share
        return beam[:, : self._count].astype(float), diffuse


def diffuse_of(lights: Sequence[CloudLight]) -> FloatArray:
    """Diffuse light below and above clouds, see ``CloudLight.diffuse``, shape (2, 2, nl). [1]

    Parameters
    ----------
    lights : sequence of CloudLight
        Light of each of the clouds, by ascending tops.
    """
    highest = max(lights, key=lambda light: light.field.top)
    return np.stack([lights[0].diffuse[0], highest.diffuse[1]])


@compiled_loop
def _before(rays, distances, observer, clouds, bright, tables, work, other, out):
    observer, clouds, bright, tables, work, other, out = without_refcount(
        (observer, clouds, bright, tables, work, other, out)
    )
    nodes = clouds.air.shape[1]
    for k in range(rays.shape[0]):
        ray = Vec3(rays[k, 0], rays[k, 1], rays[k, 2])
        found = classify_ray(ray, observer, tables)
        extent = sight_extents(ray, found.sine, found.to_ground, clouds, other)
        limit = min(distances[k], extent.last)
        if not found.through_air or limit <= extent.first:
            continue
        half_sine = half_sine_between(ray, observer.seen_x, observer.seen_z)
        place = sky_view_place(ray, found, clouds.window)
        line_of_air(ray, half_sine, place, extent, False, bright, tables, other)
        line_of_air(ray, half_sine, place, extent, False, clouds, tables, work)
        short = SightExtent(extent.first, limit, extent.leaves, extent.enters)
        at_node = node_of_distance(limit, nodes, extent)
        node = min(int(at_node), nodes - 2)
        e = np.float32(at_node - node)
        h = np.float32(1.0) - e
        for at in range(0, tables.lanes, LANES):
            whole, left = lane_view(other.before, at), lane_view(work.before, at)
            lost = h * (whole[node, WHOLE] - left[node, WHOLE])
            lost = lost + e * (whole[node + 1, WHOLE] - left[node + 1, WHOLE])
            store(out[k, 2], at, lost)
        # the nodes of the line that ends at the surface
        for other_node in range(nodes):
            distance = node_distance(other_node, nodes, short)
            at_node = node_of_distance(distance, nodes, extent)
            node = min(int(at_node), nodes - 2)
            e = np.float32(at_node - node)
            h = np.float32(1.0) - e
            for at in range(0, tables.lanes, LANES):
                before, through = lane_view(work.before, at), lane_view(work.through, at)
                lane_view(other.before, at)[other_node, WHOLE] = (
                    h * before[node, WHOLE] + e * before[node + 1, WHOLE]
                )
                lane_view(other.through, at)[other_node] = h * through[node] + e * through[node + 1]
        add_clouds(ray, half_sine, short, False, clouds, tables, other)
        for at in range(0, tables.lanes, LANES):
            store(out[k, 0], at, lane_view(other.light, at)[WHOLE])
            store(out[k, 1], at, lane_view(other.clear, at)[0])


@compiled_loop
def _at_points(points, clouds, tables, beam, up):
    clouds, tables, beam, up = without_refcount((clouds, tables, beam, up))
    for k in range(points.shape[0]):
        offset = Vec3(points[k, 0], points[k, 1], points[k, 2])
        point = plus(Vec3(0.0, 0.0, clouds.eye), offset)
        height = (sqrt(dot(point, point)) - clouds.base) / (clouds.top - clouds.base)
        up[k] = min(max(height, 0.0), 1.0)
        for n in range(len(clouds.layers)):
            layer = tuple_item(clouds.layers, n)
            depth = np.float32(beam_depth_at(point, 0, layer))
            for at in range(0, tables.lanes, LANES):
                kept = exponential(load(layer.scaled[0], at) * -depth)
                store(beam[k], at, load(beam[k], at) * kept)
