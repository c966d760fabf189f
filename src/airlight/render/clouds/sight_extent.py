"""Parts of a line of sight below the tops of clouds, and between bases and tops."""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

from airlight.kernel import inlined
from airlight.kernel.tuple_item import tuple_item


class SightExtent(NamedTuple):
    """Distances along a straight line of sight. [m]

    Attributes
    ----------
    first, last : float
        Start and end of the part below the tops.
    leaves, enters : float
        Distances between which it is below the bases.
    """

    first: float
    last: float
    leaves: float
    enters: float


@inlined
def sight_extent(cosine, sine, to_ground, eye, ground, base, top):
    """``SightExtent`` of a line of sight; an end on the ground is the nearest point to it. [m]

    Parameters
    ----------
    cosine, sine : float
        Cosine and sine of its zenith angle. [1]
    to_ground : bool
        Whether it ends on the ground.
    eye, ground, base, top : float
        Radii of the observer, of the ground, and of bases and tops. [m]
    """
    nearest, impact = -eye * cosine, eye * sine
    half = sqrt(max((top - impact) * (top + impact), 0.0))
    first, last = 0.0, nearest + half
    if eye > top:
        first = max(nearest - half, 0.0)
        last = max(last, 0.0)
        if nearest <= 0.0 or impact >= top:
            first, last = max(nearest, 0.0), max(nearest, 0.0)
    if to_ground:
        last = nearest - sqrt(max((ground - impact) * (ground + impact), 0.0))
    within = sqrt(max((base - impact) * (base + impact), 0.0))
    return SightExtent(first, max(last, first), nearest - within, nearest + within)


@inlined
def sight_extents(ray, sine, to_ground, clouds, work):
    """``SightExtent`` of all clouds; those of the layers are stored in ``work.extents``.

    Parameters
    ----------
    ray : Vec3
        Direction in the observer's frame. [1]
    sine, to_ground : float, bool
        Arguments of ``sight_extent``.
    clouds, work : CloudTables, CloudWork
        Clouds and workspace.
    """
    for n in range(len(clouds.layers)):
        layer = tuple_item(clouds.layers, n)
        one = sight_extent(ray.z, sine, to_ground, clouds.eye, clouds.radius, layer.base, layer.top)
        work.extents[n, 0], work.extents[n, 1] = one.first, one.last
        work.extents[n, 2], work.extents[n, 3] = one.leaves, one.enters
    return sight_extent(ray.z, sine, to_ground, clouds.eye, clouds.radius, clouds.base, clouds.top)


@inlined
def way_to_layer(s, number, work):
    """Distance from a point of a line of sight to the next part inside a layer; 0 inside. [m]

    Parameters
    ----------
    s : float
        Distance of the point. [m]
    number : int
        Number of the layer.
    work : CloudWork
        Workspace, after ``sight_extents``.
    """
    if s < work.extents[number, 0]:
        return work.extents[number, 0] - s + 1e-3
    if s >= work.extents[number, 1]:
        return 1e9
    if work.extents[number, 2] < s < work.extents[number, 3]:
        return work.extents[number, 3] - s + 1e-3
    return 0.0


@inlined
def way_out_of_layer(s, number, work):
    """Distance from a point inside a layer to its base, or to the end; as ``way_to_layer``. [m]"""
    leaves = work.extents[number, 2]
    return (leaves if s <= leaves else work.extents[number, 1]) - s + 1e-3


@inlined
def node_distance(node, count, extent):
    """Distance of a node of the table of air: even steps, quadratic from an observer below. [m]

    Parameters
    ----------
    node, count : int
        Index and number of nodes.
    extent : SightExtent
        Result of ``sight_extent``.
    """
    part = node / (count - 1)
    if extent.first == 0.0:
        part *= part
    return extent.first + part * (extent.last - extent.first)


@inlined
def node_of_distance(distance, count, extent):
    """Node coordinate of a distance, the inverse of ``node_distance``. [1]"""
    part = (distance - extent.first) / max(extent.last - extent.first, 1e-3)
    part = min(max(part, 0.0), 1.0)
    if extent.first == 0.0:
        part = sqrt(part)
    return part * (count - 1)
