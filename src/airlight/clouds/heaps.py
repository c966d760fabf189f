"""Cumuli: heaps of overlapping thermals on a flat base.

A cloud is a union of ellipsoids with a rough surface: plumes side by side, each of thermals above
each other, with smaller thermals on their sides and tops. The level set f [m] is the union's,
positive within; the cover determines the level at which the surface lies.

Widths follow n(D) ∝ D^-1.7 up to the largest (Neggers, Jonker & Siebesma 2003, JAS 60, 1060); what
overlaps is one cloud from above, and their equal-area diameters fall as D^-2.1, those of trade
cumuli as D^-2.19 (Zhao & Di Girolamo 2007, JGR 112, D24205).
Extinction grows with height above the base as that of a constant number of droplets in adiabatic
ascent, h^(2/3) (Brenguier et al. 2000, JAS 57, 803), and falls to zero within 20 m
and seven tenths of a cell of the surface, as in the shells of Heus & Jonker (2008), JAS 65, 1003.
"""

from __future__ import annotations

from math import ceil, cos, floor, log, pi, sin, sqrt
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt

from airlight.clouds.cloud_grid import CloudGrid
from airlight.clouds.organisation import centred, gathered_places, number_density, overlapping
from airlight.geometry.gradient_noise import gradient_noise
from airlight.kernel import compiled_loop, kernel

FloatArray = NDArray[np.float64]

#: Exponent of the distribution of widths.
WIDTHS: Final = 1.7
#: Upward velocity of thermals, over which shear displaces them. [m s⁻¹]
ASCENT: Final = 5.0
#: Level set where there is no thermal. [m]
NOWHERE: Final = -1e9
#: Projected area of a cloud over that of a circle of its width.
_FILLED: Final = 0.75
#: Cover above which there are large clouds only.
_CROWDED: Final = 0.8
#: Largest number of clouds.
_MOST: Final = 4000
#: Roughness of a thermal's surface over its radius, in the coarsest octave.
_ROUGH: Final = 0.55
#: Largest numbers of plumes of a cloud, and of thermals of a plume.
_MOST_PLUMES: Final = 15
_MOST_THERMALS: Final = 64
#: Number of thermals for which there is room at first.
_ROOM: Final = 1 << 14
#: Generations of smaller thermals, and their least radius in cells.
_GENERATIONS: Final = 2
_LEAST: Final = 0.9
#: Distance over which extinction falls at the edge, beside that of ``HeapShape``. [m]
_EDGE: Final = 20.0


class HeapShape(NamedTuple):
    """Shape of a cloud.

    Attributes
    ----------
    core : (float, float)
        Limits of the radius of the middle plume over the width of the cloud. [1]
    narrowing : float
        Narrowing of a plume from base to top. [1]
    wandering : float
        Sideways steps of its thermals over its radius. [1]
    slender : float
        Greatest height of a plume at the side of others over its radius. [1]
    sloping : float
        Decrease of the tops of plumes from the middle of the cloud to its edge. [1]
    bulges : int
        Number of smaller thermals on each. [1]
    outside : float
        Distance of their middles from that of the larger one over its radius. [1]
    edge : float
        Distance over which extinction falls at the edge. [cells]
    """

    core: tuple[float, float]
    narrowing: float
    wandering: float
    slender: float
    sloping: float
    bulges: int
    outside: float
    edge: float


HUMILIS: Final = HeapShape(
    core=(0.18, 0.24),
    narrowing=0.5,
    wandering=0.12,
    slender=3.5,
    sloping=0.75,
    bulges=6,
    outside=0.85,
    edge=0.7,
)
CONGESTUS: Final = HeapShape(
    core=(0.22, 0.28),
    narrowing=0.3,
    wandering=0.07,
    slender=2.4,
    sloping=0.4,
    bulges=10,
    outside=0.95,
    edge=0.3,
)


class Heaps(NamedTuple):
    """Thermals of all clouds, each array of shape (n,). [m]"""

    east: FloatArray
    north: FloatArray
    height: FloatArray
    width: FloatArray
    depth: FloatArray
    offset: FloatArray


@kernel
def roughness(x, y, z):
    """Rounded bumps between sharp creases, three octaves of folded noise, mean about 0. [1]"""
    total, share, scale = 0.0, 1.0, 1.0
    for _octave in range(3):
        total += share * (abs(gradient_noise(x * scale, y * scale, z * scale)) - 0.11)
        share *= 0.55
        scale *= 2.07
    return total


@compiled_loop
def raise_thermals(field, heaps, east_step, up_step, rough):
    """Level set of the union of thermals, largest of each, in place. [m]

    Parameters
    ----------
    field : array, shape (nx, ny, nz)
        Level set, ``NOWHERE`` at first. [m]
    heaps : Heaps
        Thermals, from the corner of the periodic box.
    east_step, up_step : float
        Widths of a cell. [m]
    rough : float
        Displacement of the surface over the radius. [1]
    """
    nx, ny, nz = field.shape
    for n in range(heaps.east.size):
        a, b = heaps.width[n], heaps.depth[n]
        reach = 1.45
        small = min(a, b)
        for i in range(
            floor((heaps.east[n] - reach * a) / east_step),
            ceil((heaps.east[n] + reach * a) / east_step),
        ):
            x = (i + 0.5) * east_step
            dx = (x - heaps.east[n]) / a
            for j in range(
                floor((heaps.north[n] - reach * a) / east_step),
                ceil((heaps.north[n] + reach * a) / east_step),
            ):
                y = (j + 0.5) * east_step
                dy = (y - heaps.north[n]) / a
                flat = dx * dx + dy * dy
                if flat >= reach * reach:
                    continue
                low = max(floor((heaps.height[n] - reach * b) / up_step), 0)
                high = min(ceil((heaps.height[n] + reach * b) / up_step), nz)
                row = field[i % nx, j % ny]
                for k in range(low, high):
                    z = (k + 0.5) * up_step
                    dz = (z - heaps.height[n]) / b
                    inner = small * (1.0 - sqrt(flat + dz * dz))
                    if inner + 0.3 * rough * small <= row[k]:
                        continue
                    size = 0.8 * a
                    inner += (
                        rough
                        * small
                        * roughness(
                            x / size + heaps.offset[n],
                            y / size - heaps.offset[n],
                            z / size,
                        )
                    )
                    row[k] = max(row[k], inner)


def heap_extinction(
    grid: CloudGrid,
    random: np.random.Generator,
    *,
    cell: float,
    cover: float,
    shear: float,
    organisation: float = 0.0,
    shape: HeapShape = HUMILIS,
) -> FloatArray:
    """Relative extinction of cumuli of a cover, shape of the grid. [1]

    Parameters
    ----------
    grid : CloudGrid
        Box, as high as the deepest clouds.
    random : numpy.random.Generator
        Source of places and sizes.
    cell : float
        Width of the largest clouds. [m]
    cover : float
        Share of cloudy columns. [1]
    shear : float
        Increase of the eastward wind with height. [s⁻¹]
    organisation : float
        Standard deviation of the logarithm of their number density. [1]
    shape : HeapShape
        Shape of each.
    """
    density = None
    if organisation > 0.0:
        density = number_density(grid, random, cell, shear, organisation)
    widths = cloud_widths(grid, random, cell, cover, density)
    places = _places(grid, random, widths, density)
    clouds = np.column_stack([places, widths])
    thermals = _thermals(random, clouds, shape, shear, grid.depth, grid.level, grid.spacing)
    heaps = Heaps(*np.ascontiguousarray(thermals.T))
    field = np.full(grid.shape, NOWHERE)
    raise_thermals(field, heaps, grid.spacing, grid.level, _ROUGH)
    highest = field.max(axis=2)
    if np.mean(highest > NOWHERE) < cover or cover == 1.0:  # more than thermals reach
        far = highest <= NOWHERE
        gap = distance_transform_edt(np.tile(far, (3, 3)))[
            tuple(slice(n, 2 * n) for n in far.shape)
        ]
        low = float(highest[~far].min())
        field[far] = low - grid.spacing * gap[far][:, None] - grid.heights
        highest = field.max(axis=2)
    surface = (
        float(np.quantile(highest, 1.0 - cover)) if cover < 1.0 else float(highest.min()) - 1.0
    )
    inside = np.clip((field - surface) / (_EDGE + shape.edge * grid.spacing), 0.0, 1.0)
    return np.asarray(inside * grid.heights ** (2.0 / 3.0))


def cloud_widths(
    grid: CloudGrid,
    random: np.random.Generator,
    cell: float,
    cover: float,
    density: FloatArray | None = None,
) -> FloatArray:
    """Widths of clouds of the cover and a relative number density, the largest first. [m]"""
    widest = min(max(cell, 4.0 * grid.spacing), 0.5 * grid.size)
    least = min(max(2.5 * grid.spacing, 0.1 * widest), 0.7 * widest)
    if cover > _CROWDED:
        least = 0.7 * widest
    power = 1.0 - WIDTHS
    share = random.random(_MOST)
    widths = (least**power + share * (widest**power - least**power)) ** (1.0 / power)
    area = -log(max(1.0 - cover, 0.02))
    if density is not None:
        area = overlapping(min(cover, 0.98), centred(density, widest / least))
    wanted = area * grid.size**2 / (_FILLED * 0.25 * np.pi)
    count = int(np.searchsorted(np.cumsum(widths**2), wanted)) + 1
    found = np.sort(widths[:count])[::-1]
    found[0] = widest
    return found


def _places(
    grid: CloudGrid, random: np.random.Generator, widths: FloatArray, density: FloatArray | None
) -> FloatArray:
    """Places of clouds, gathered or the farthest of a few random ones, shape (n, 2). [m]"""
    if density is not None:
        return gathered_places(grid, random, widths, density)
    places = np.zeros((widths.size, 2))
    for n, width in enumerate(widths):
        tries = grid.size * random.random((3, 2))
        if n:
            apart = np.abs(tries[:, None] - places[None, :n])
            apart = np.minimum(apart, grid.size - apart)
            gaps = np.sqrt((apart**2).sum(axis=2)) - 0.5 * (width + widths[:n])
            places[n] = tries[np.argmax(np.minimum(gaps.min(axis=1), 0.1 * width))]
        else:
            places[n] = tries[0]
    return places


@compiled_loop
def _thermals(random, clouds, shape, shear, depth, level, spacing):
    """Thermals of clouds of a place and width, largest first: rows of ``Heaps``.

    Parameters
    ----------
    random : numpy.random.Generator
        Source of sizes and places, in whose order a seed has its shapes.
    clouds : array, shape (n, 3)
        Places and widths. [m]
    shape : HeapShape
        Shape of each.
    shear : float
        Increase of the eastward wind with height. [s⁻¹]
    depth, level, spacing : float
        Height of the box, and height and width of a cell. [m]
    """
    found, last = np.empty((_ROOM, 6)), 0
    for n in range(clouds.shape[0]):
        east, north, width = clouds[n]
        top = depth * (width / clouds[0, 2]) ** 0.8 * random.uniform(0.75, 1.0)
        if n == 0:
            top = depth
        one = _cloud(random, shape, width, max(top, 2.0 * level), _LEAST * spacing)
        offset, count = random.uniform(0.0, 200.0), one.shape[0]
        while last + count > found.shape[0]:
            found = np.concatenate((found, np.empty_like(found)))
        for k in range(count):
            row = found[last + k]
            row[:] = one[k]
            row[0] += east + shear * row[2] ** 2 / (2.0 * ASCENT)
            row[1] += north
            row[5] = offset
        last += count
    return found[:last]


@kernel
def _cloud(random, shape, width, top, least):
    """Thermals of one cloud about its place, of at least some radius [m]: rows of ``Heaps``."""
    plumes = np.empty((_MOST_PLUMES, 4))  # east, north, radius, height
    plumes[0, 0], plumes[0, 1] = 0.0, 0.0
    plumes[0, 2] = random.uniform(shape.core[0], shape.core[1]) * width
    plumes[0, 3] = 0.92 * top
    turn, narrow = random.uniform(0.0, 2.0 * pi), random.uniform(0.5, 1.0)
    count = 1 + random.integers(7, _MOST_PLUMES)
    for n in range(1, count):
        beside = plumes[random.integers(0, n)]
        angle = random.uniform(0.0, 2.0 * pi)
        apart = random.uniform(0.7, 1.3) * beside[2]
        x, y = beside[0] + apart * cos(angle), beside[1] + apart * narrow * sin(angle)
        outwards = min(sqrt(x * x + y * y) / (0.5 * width), 1.0)
        peak = top * random.uniform(0.35, 1.0) * (1.0 - shape.sloping * outwards**1.5)
        radius = random.uniform(0.1, 0.2) * width
        plumes[n, 0], plumes[n, 1], plumes[n, 2] = x, y, radius
        plumes[n, 3] = min(peak, shape.slender * radius)
    rows, last = np.zeros((count * _MOST_THERMALS, 6)), 0
    for n in range(count):
        x, y, radius, peak = plumes[n]
        x, y = x * cos(turn) - y * sin(turn), x * sin(turn) + y * cos(turn)
        last = _plume(random, x, y, radius, peak, shape, rows, last)
    first, thermals = 0, rows[:last]
    for _ in range(_GENERATIONS):
        more = _bulges(random, shape, thermals[first:], top, least)
        first = thermals.shape[0]
        thermals = np.concatenate((thermals, more))
    return thermals


@kernel
def _plume(random, x, y, radius, peak, shape, rows, last):
    """Add thermals above each other up to a height; the number of rows with them."""
    low = max(min(radius, peak), 0.1 * peak)  # flattened in flat clouds, stretched in slender ones
    h = 0.0
    for _ in range(_MOST_THERMALS):
        size = 1.0 - shape.narrowing * h / peak
        up = min(low * size, peak)
        h = min(h, peak - up)
        rows[last, 0], rows[last, 1], rows[last, 2] = x, y, h
        rows[last, 3], rows[last, 4] = radius * (size * random.uniform(0.85, 1.15)), up
        last += 1
        if h >= peak - up - 1e-6 * peak:
            break
        h += 0.6 * up
        x += shape.wandering * radius * random.normal(0.0, 1.0)
        y += shape.wandering * radius * random.normal(0.0, 1.0)
    return last


@kernel
def _bulges(random, shape, thermals, top, least):
    """Smaller thermals on the sides and tops of others: rows of ``Heaps``."""
    found, last = np.zeros((thermals.shape[0] * shape.bulges, 6)), 0
    for n in range(thermals.shape[0]):
        x, y, h, a, b = thermals[n, :5]
        for _ in range(shape.bulges):
            turn = 2.0 * pi * random.random()
            up = 1.1 * random.random() - 0.1
            small = (0.3 + 0.25 * random.random()) * min(a, b)
            out, height = shape.outside * a * sqrt(1.0 - up * up), h + shape.outside * b * up
            if small >= least and 0.0 < height < top - 0.7 * small:
                found[last, 0], found[last, 1] = x + out * cos(turn), y + out * sin(turn)
                found[last, 2], found[last, 3], found[last, 4] = height, small, small
                last += 1
    return found[:last]
