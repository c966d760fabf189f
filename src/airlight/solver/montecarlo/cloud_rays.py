r"""Straight rays through the cells of cloud fields: optical depth and collisions.

Coordinates of a box are gnomonic about its place: X = R e/u, Y = R n/u from the components e, n and
u of a point in its axes. On a ray of distance s all of these components are linear in s, so that it
meets the plane X = c at

.. math:: s = \frac{c u_0 - R e_0}{R e' - c u'}

and a sphere at the roots of a quadratic equation. A ray passes from block to block of cells (see
``CloudCells``); empty blocks are skipped.

* Collisions: null-collision tracking (Woodcock et al. 1965, Proc. Conf. Applications of Computing
  Methods to Reactor Problems, ANL-7050, 557) with the largest extinction of each block.
* Optical depth: exact, cell by cell. In interpolated fields cells are those between the centres,
  and extinction is a cubic polynomial in s but for the curvature of the sphere within a cell, so
  that two Gaussian points are exact.

The radius is monotone on each of the two legs of a ray, before and after its lowest point.
"""

from __future__ import annotations

from math import floor, log, sqrt
from typing import Final, NamedTuple

from airlight.kernel import compiled_loop, inlined
from airlight.kernel.without_refcount import without_refcount
from airlight.solver.montecarlo.streams import uniform

#: Optical depth from which nothing is transmitted. [1]
OPAQUE: Final = 45.0
#: Least cosine of the angular distance from its place within which a field is periodic. [1]
PERIODIC_COSINE: Final = 0.1
#: Distance of what is not on a ray. [m]
FAR: Final = 1e300
#: First of the two Gaussian points on [0, 1].
_GAUSS: Final = 0.21132486540518713


class BoxRay(NamedTuple):
    """Leg of a ray in the axes of a box.

    Attributes
    ----------
    east, north, up : float
        Start of the ray. [m]
    to_east, to_north, to_up : float
        Direction. [1]
    r, approach : float
        Radius of the start, and distance of the lowest point, negative behind it. [m]
    radius : float
        Radius of the ground. [m]
    rising : int
        1 on the ascending leg, -1 on the descending one.
    """

    east: float
    north: float
    up: float
    to_east: float
    to_north: float
    to_up: float
    r: float
    approach: float
    radius: float
    rising: int


class Lattice(NamedTuple):
    """Faces of cells or blocks.

    Attributes
    ----------
    west, south, floor : float
        Coordinates of the faces of index 0, the last a radius. [m]
    width, length, height : float
        Distances of faces to the east, to the north and upwards. [m]
    """

    west: float
    south: float
    floor: float
    width: float
    length: float
    height: float


class Cell(NamedTuple):
    """Cell on a ray: indices, and distances at which the ray leaves it by each pair of faces."""

    i: int
    j: int
    k: int
    east: float
    north: float
    up: float


@inlined
def _box_ray(point, direction, rising, f, clouds):
    """Leg of a ray in the axes of field f."""
    a = clouds.axes[f]
    x, y, z = point
    u, v, w = direction
    east = a[0, 0] * x + a[0, 1] * y + a[0, 2] * z
    north = a[1, 0] * x + a[1, 1] * y + a[1, 2] * z
    up = a[2, 0] * x + a[2, 1] * y + a[2, 2] * z
    to_east = a[0, 0] * u + a[0, 1] * v + a[0, 2] * w
    to_north = a[1, 0] * u + a[1, 1] * v + a[1, 2] * w
    to_up = a[2, 0] * u + a[2, 1] * v + a[2, 2] * w
    r = sqrt(x * x + y * y + z * z)
    approach = -(x * u + y * v + z * w)
    return BoxRay(east, north, up, to_east, to_north, to_up, r, approach, clouds.radius, rising)


@inlined
def _at_radius(ray, radius):
    """Distance at which a leg is at a radius; its lowest point, if it is not. [m]"""
    excess = (radius - ray.r) * (radius + ray.r)
    root = sqrt(max(ray.approach * ray.approach + excess, 0.0))
    if root == 0.0:
        return ray.approach
    if ray.rising > 0:
        return excess / (root - ray.approach) if ray.approach < 0.0 else ray.approach + root
    return -excess / (ray.approach + root) if ray.approach > 0.0 else ray.approach - root


@inlined
def _limited(start, end, value, slope):
    """Part of start to end on which value + slope s is positive."""
    if slope > 0.0:
        return max(start, -value / slope), end
    if slope < 0.0:
        return start, min(end, -value / slope)
    return start, end if value > 0.0 else start


@inlined
def _within_box(ray, f, clouds, end):
    """Start and end of the part of a leg within a box, up to a distance. [m]"""
    corner, spacing, count = clouds.corner[f], clouds.spacing[f], clouds.number[f]
    low = _at_radius(ray, corner[2])
    high = _at_radius(ray, corner[2] + spacing[2] * count[2])
    if ray.rising > 0:
        start, end = max(low, ray.approach, 0.0), min(high, end)
    else:
        start, end = max(high, 0.0), min(low, ray.approach, end)
    if clouds.kind[f, 0] == 1:
        up = ray.up - PERIODIC_COSINE * ray.radius
        return _limited(start, end, up, ray.to_up)
    radius = ray.radius
    west, south = corner[0], corner[1]
    east, north = west + spacing[0] * count[0], south + spacing[1] * count[1]
    for side in range(4):
        sign = 1.0 if side % 2 == 0 else -1.0
        if side < 2:
            face = west if side == 0 else east
            value, slope = (
                radius * ray.east - face * ray.up,
                radius * ray.to_east - face * ray.to_up,
            )
        else:
            face = south if side == 2 else north
            value = radius * ray.north - face * ray.up
            slope = radius * ray.to_north - face * ray.to_up
        start, end = _limited(start, end, sign * value, sign * slope)
    return start, end


@inlined
def _coordinates(ray, s):
    """Coordinates to the east and north, and radius, at a distance. [m]"""
    scale = ray.radius / (ray.up + s * ray.to_up)
    radius = sqrt(ray.r * ray.r + s * (s - 2.0 * ray.approach))
    return scale * (ray.east + s * ray.to_east), scale * (ray.north + s * ray.to_north), radius


@inlined
def _cell_at(ray, lattice, s):
    """Cell at a distance."""
    x, y, radius = _coordinates(ray, s)
    i = floor((x - lattice.west) / lattice.width)
    j = floor((y - lattice.south) / lattice.length)
    k = floor((radius - lattice.floor) / lattice.height)
    return Cell(
        i,
        j,
        k,
        _east_exit(ray, lattice, i),
        _north_exit(ray, lattice, j),
        _up_exit(ray, lattice, k),
    )


@inlined
def _side_exit(start, to_start, ray, near, far):
    """Distance of the plane of constant coordinate by which a ray leaves a column or row. [m]

    Parameters
    ----------
    start, to_start : float
        Component of the start [m] and of the direction [1] along the axis.
    near, far : float
        Coordinates of the two planes. [m]
    """
    turn = to_start * ray.up - start * ray.to_up
    coordinate = far if turn > 0.0 else near
    slope = ray.radius * to_start - coordinate * ray.to_up
    # Otherwise the coordinate has a limit before the plane.
    if slope * turn <= 0.0:
        return FAR
    return (coordinate * ray.up - ray.radius * start) / slope


@inlined
def _east_exit(ray, lattice, i):
    """Distance of the face by which the ray leaves column i. [m]"""
    near = lattice.west + lattice.width * i
    return _side_exit(ray.east, ray.to_east, ray, near, near + lattice.width)


@inlined
def _north_exit(ray, lattice, j):
    """Distance of the face by which the ray leaves row j. [m]"""
    near = lattice.south + lattice.length * j
    return _side_exit(ray.north, ray.to_north, ray, near, near + lattice.length)


@inlined
def _up_exit(ray, lattice, k):
    """Distance of the face by which the ray leaves layer k. [m]"""
    above = 1.0 if ray.rising > 0 else 0.0
    return _at_radius(ray, lattice.floor + lattice.height * (k + above))


@inlined
def _next_cell(ray, lattice, cell):
    """Cell beyond the nearest exit."""
    i, j, k, east, north, up = cell
    if up <= east and up <= north:
        k += ray.rising
        up = _up_exit(ray, lattice, k)
    elif east <= north:
        i += 1 if ray.to_east * ray.up - ray.east * ray.to_up > 0.0 else -1
        east = _east_exit(ray, lattice, i)
    else:
        j += 1 if ray.to_north * ray.up - ray.north * ray.to_up > 0.0 else -1
        north = _north_exit(ray, lattice, j)
    return Cell(i, j, k, east, north, up)


@inlined
def _blocks(f, clouds):
    """Faces of the blocks of a field."""
    corner, spacing, block = clouds.corner[f], clouds.spacing[f], clouds.block[f]
    return Lattice(
        corner[0],
        corner[1],
        corner[2],
        spacing[0] * block[0],
        spacing[1] * block[1],
        spacing[2] * block[2],
    )


@inlined
def _inside(index, count, periodic):
    """Index within 0 to count - 1: periodic, or the nearest one."""
    if periodic:
        return index % count
    return min(max(index, 0), count - 1)


@inlined
def _majorant(f, cell, clouds):
    """Largest extinction at 550 nm in a block. [m⁻¹]"""
    count, block = clouds.number[f], clouds.block[f]
    periodic = clouds.kind[f, 0] == 1
    rows, layers = -(-count[1] // block[1]), -(-count[2] // block[2])
    i = _inside(cell.i, -(-count[0] // block[0]), periodic)
    j = _inside(cell.j, rows, periodic)
    k = _inside(cell.k, layers, False)
    return clouds.majorants[clouds.first[f, 1] + (i * rows + j) * layers + k]


@inlined
def _cell_value(f, i, j, k, clouds):
    """Extinction at 550 nm of a cell. [m⁻¹]"""
    count = clouds.number[f]
    periodic = clouds.kind[f, 0] == 1
    i, j = _inside(i, count[0], periodic), _inside(j, count[1], periodic)
    k = _inside(k, count[2], False)
    return clouds.cells[clouds.first[f, 0] + (i * count[1] + j) * count[2] + k]


@inlined
def _extinction_at(ray, f, s, clouds):
    """Extinction at 550 nm at a distance within the box. [m⁻¹]"""
    x, y, radius = _coordinates(ray, s)
    corner, spacing = clouds.corner[f], clouds.spacing[f]
    shift = 0.5 * clouds.kind[f, 1]
    p = (x - corner[0]) / spacing[0] - shift
    q = (y - corner[1]) / spacing[1] - shift
    t = (radius - corner[2]) / spacing[2] - shift
    i, j, k = floor(p), floor(q), floor(t)
    if shift == 0.0:
        return _cell_value(f, i, j, k, clouds)
    total = 0.0
    for corner_index in range(8):
        a, b, c = corner_index & 1, (corner_index >> 1) & 1, corner_index >> 2
        weight = p - i if a == 1 else 1.0 - (p - i)
        weight *= q - j if b == 1 else 1.0 - (q - j)
        weight *= t - k if c == 1 else 1.0 - (t - k)
        total += weight * _cell_value(f, i + a, j + b, k + c, clouds)
    return total


@inlined
def _depth_in_cells(ray, f, start, end, clouds):
    """Optical depth at 550 nm between two distances within the box. [1]"""
    corner, spacing = clouds.corner[f], clouds.spacing[f]
    shift = 0.5 * clouds.kind[f, 1]
    lattice = Lattice(
        corner[0] + shift * spacing[0],
        corner[1] + shift * spacing[1],
        corner[2] + shift * spacing[2],
        spacing[0],
        spacing[1],
        spacing[2],
    )
    cell = _cell_at(ray, lattice, start)
    depth, s = 0.0, start
    while s < end:
        leaves = max(min(cell.east, cell.north, cell.up, end), s)
        if shift == 0.0:
            depth += (leaves - s) * _cell_value(f, cell.i, cell.j, cell.k, clouds)
        elif leaves > s:
            step = leaves - s
            first = _extinction_at(ray, f, s + _GAUSS * step, clouds)
            second = _extinction_at(ray, f, leaves - _GAUSS * step, clouds)
            depth += 0.5 * step * (first + second)
        s = leaves
        cell = _next_cell(ray, lattice, cell)
    return depth


@compiled_loop
def cloud_depth(point, direction, end, clouds):
    """Optical depth of all fields along a ray.

    Parameters
    ----------
    point, direction : tuple of three float
        Start and direction, in the frame of ``clouds.axes``. [m], [1]
    end : float
        Length of the ray. [m]
    clouds : CloudCells
        The fields.

    Returns
    -------
    float
        Optical depth, or at least ``OPAQUE``. [1]
    """
    clouds = without_refcount(clouds)
    depth = 0.0
    for f in range(clouds.extinction.size):
        blocks = _blocks(f, clouds)
        for leg in range(2):
            ray = _box_ray(point, direction, 2 * leg - 1, f, clouds)
            s, last = _within_box(ray, f, clouds, end)
            if not s < last:
                continue
            block = _cell_at(ray, blocks, s)
            while s < last and depth < OPAQUE:
                leaves = max(min(block.east, block.north, block.up, last), s)
                if leaves > s and _majorant(f, block, clouds) > 0.0:
                    inside = _depth_in_cells(ray, f, s, leaves, clouds)
                    depth += inside * clouds.extinction[f]
                s = leaves
                block = _next_cell(ray, blocks, block)
    return depth


@compiled_loop
def cloud_collision(point, direction, end, clouds, state):
    """First collision with a particle of the fields on a ray.

    Parameters
    ----------
    point, direction, end, clouds :
        Arguments of ``cloud_depth``.
    state : array, shape (1,)
        Stream of random numbers.

    Returns
    -------
    field : int
        Index of its field; -1 without collision.
    distance : float
        Its distance; ``end`` without one. [m]
    """
    clouds = without_refcount(clouds)
    found = -1
    for f in range(clouds.extinction.size):
        blocks = _blocks(f, clouds)
        for leg in range(2):
            ray = _box_ray(point, direction, 2 * leg - 1, f, clouds)
            s, last = _within_box(ray, f, clouds, end)
            if not s < last:
                continue
            block = _cell_at(ray, blocks, s)
            while s < last:
                leaves = max(min(block.east, block.north, block.up, last), s)
                most = clouds.extinction[f] * _majorant(f, block, clouds)
                while most > 0.0:
                    s -= log(uniform(state)) / most
                    if s >= leaves:
                        break
                    got = clouds.extinction[f] * _extinction_at(ray, f, s, clouds)
                    if uniform(state) * most < got:
                        found, end, last, leaves = f, s, s, s
                        break
                s = leaves
                block = _next_cell(ray, blocks, block)
    return found, end
