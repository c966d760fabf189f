"""Part of a line of sight below the tops of clouds, and its part between base and top."""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

from airlight.kernel import inlined


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
