"""Successive orders of the scattering correction around a moon's shadow.

Every node of the grid integrates radiance over the sphere, with dense directions at the horizon,
where light comes from while the sky above is dark. The source of the correction is single
scattering with the local visible fraction of the star, less the same with the fraction at the node.
Each sweep yields the next order; the orders after the last are summed as a geometric series.
Outside the shadow the source vanishes, independent of the grid.
"""

from __future__ import annotations

import hashlib
from math import cos, pi, sin, sqrt
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ConvergenceError
from airlight.geometry.occulted_star import OccultedStar
from airlight.geometry.quadrature import gauss_legendre
from airlight.geometry.shell import distance_to_bottom, distance_to_top, horizon_cosine
from airlight.kernel import compiled_loop, disk
from airlight.kernel.fingerprints import fingerprint
from airlight.kernel.lanes import LANES, lane_view, store
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.kernel.without_refcount import without_refcount
from airlight.solver.eclipsed.eclipsed_march import (
    LOCAL_SHADOW,
    SCATTERING_CORRECTION,
    EclipsedLine,
    line_eclipsed,
    new_eclipse,
    visible_star_fraction,
)
from airlight.solver.eclipsed.shadow_tables import (
    ShadowTables,
    direction_functions,
    grid_spacing,
    new_shadow_workspace,
    node_point,
    shadow_axes,
)
from airlight.solver.moments.harmonics import harmonics
from airlight.solver.moments.irradiance import ground_light
from airlight.solver.moments.march import field_place
from airlight.solver.moments.march_tables import MarchTables, quadratures
from airlight.solver.moments.source import between, field_node, read_phase

if TYPE_CHECKING:
    from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]


class ShadowGrid(NamedTuple):
    """Resolution of the field around a shadow.

    Attributes
    ----------
    radii, distances, turns : int
        Numbers of altitudes, of distances from the axis, and of position angles of a turn, even.
    degree : int
        Highest degree of the harmonics.
    up, down, azimuths : int
        Directions above and below a node's horizon, and azimuths of a turn.
    points : tuple of int
        Points of a panel in a sweep, as in ``quadratures``.
    tolerance : float
        Largest relative contribution of the last sweep at a node. [1]
    """

    radii: int
    distances: int
    turns: int
    degree: int
    up: int
    down: int
    azimuths: int
    points: tuple[int, int, int]
    tolerance: float


#: Resolutions by the number of radii of the solution: preview, default, fine.
GRIDS: Final = {
    14: ShadowGrid(8, 13, 8, 4, 6, 4, 8, (8, 8, 10), 5e-2),
    24: ShadowGrid(13, 21, 12, 7, 9, 5, 12, (8, 10, 14), 2e-2),
    40: ShadowGrid(19, 29, 16, 10, 14, 8, 16, (12, 16, 20), 1e-2),
}
#: Extent of the grid beyond the umbra, in horizon distances of the scale height.
_REACH: Final = 3.0
#: Fraction of the grid's coordinate beyond which the field is tapered to 0.
_FADE: Final = 0.8
#: Largest ratio of successive orders in the geometric series, and largest number of sweeps.
_LARGEST_RATIO: Final = 0.8
_MOST_SWEEPS: Final = 60
#: Nodes of the stored field between those of the iteration, in distance and in angle.
_FINER: Final = 3
_FINER_ANGLES: Final = 2


def eclipsed_field(
    solution: MomentsSolution,
    star: OccultedStar,
    *,
    cache: bool = True,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> ShadowTables:
    """Field of the scattering correction around a moon's shadow.

    Parameters
    ----------
    solution : MomentsSolution
        Unshadowed solution, lit by the same star.
    star : OccultedStar
        Star and moon, in the shadow's frame (``shadow_axes``), with optical radii.
    cache : bool
        Whether to read the field from the cache on disk, and to write it there.
    """
    coarse = _empty(solution, star)
    end = float(coarse.middle * np.sinh(coarse.width))
    if coarse.axis > solution.medium.top_radius + end:
        return coarse  # penumbra only, where there is no deviation
    stored = disk.cached(
        _key(solution, star),
        lambda: _iterate(solution, coarse, progress, cancel),
        dict,
        lambda found: found if found["field"].size == coarse.field.size else None,
        use=cache,
    )
    return _refined(coarse, stored["field"], stored["sky"])


def _key(solution: MomentsSolution, star: OccultedStar) -> str:
    digest = hashlib.sha256(f"eclipsed {fingerprint(Path(__file__))}".encode())
    digest.update(solution.settings.as_text().encode())
    digest.update(solution.medium.fingerprint().encode())
    moon, light = (star.x, star.y, star.z, star.radius), (star.star_x, star.star_y, star.star_z)
    digest.update(np.array([*moon, *light, star.nearness, star.scale]).tobytes())
    digest.update(star.roots.tobytes())
    return digest.hexdigest()[:40]


def _empty(solution: MomentsSolution, star: OccultedStar) -> ShadowTables:
    """Shadow tables of the final shape with zero correction."""
    tables, grid = solution.tables, _grid(solution)
    degree = min(grid.degree, solution.moments.degree)
    terms = harmonics(degree)
    separation = np.array([star.x, star.y, star.z])
    distance = float(np.linalg.norm(separation))
    umbra = abs(star.radius - distance * np.sin(star.star_radius))
    reach = umbra + _REACH * sqrt(2.0 * tables.bottom * _scale_height(solution))
    middle, width = grid_spacing(umbra, reach)
    nodes = grid.radii * grid.distances * (grid.turns + 1)
    return ShadowTables(
        star=star,
        axis=_axis_offset(star),
        umbra=umbra,
        middle=middle,
        width=width,
        degree=degree,
        start=terms.start,
        ahead=terms.ahead,
        back=terms.back,
        radii=grid.radii,
        distances=grid.distances,
        angles=grid.turns + 1,
        field=np.zeros((nodes, (degree + 1) ** 2, star.lanes), np.float32),
        sky=np.zeros((nodes // grid.radii, star.lanes), np.float32),
    )


def _grid(solution: MomentsSolution) -> ShadowGrid:
    return GRIDS[min(GRIDS, key=lambda radii: abs(radii - solution.settings.radii))]


def _axis_offset(star: OccultedStar) -> float:
    """Distance of the shadow's axis from the planet's centre, at the planet. [m]"""
    moon = np.array([star.x, star.y, star.z])
    across = moon @ shadow_axes(star)[0]
    return float(across)


def _scale_height(solution: MomentsSolution) -> float:
    """Mean altitude of scattering, weighted by vertical scattering optical depth. [m]"""
    medium = solution.geometry.medium
    altitude = np.linspace(0.0, medium.thickness, 2000)
    weight = medium.scattering.max(axis=1) @ medium.density.at(altitude)
    return float(np.trapezoid(weight * altitude, altitude) / np.trapezoid(weight, altitude))


def _iterate(
    solution: MomentsSolution, empty: ShadowTables, progress: Progress | None, cancel: Cancel | None
) -> dict[str, NDArray[Any]]:
    """Sum of the orders until convergence: arrays by node, wavelengths last."""
    grid = _grid(solution)
    tables = solution.tables._replace(rules=quadratures(grid.points), panels=1)
    half, lanes = grid.turns // 2 + 1, empty.star.lanes
    terms = (empty.degree + 1) ** 2
    signs = _mirror_signs(empty.degree)
    directions, fade = _directions(grid), _fade(grid.distances)

    def sweep(shadow: ShadowTables, kind: int, order: int) -> tuple[Float32Array, Float32Array]:
        field = np.zeros((grid.radii, grid.distances, half, terms, lanes), np.float32)
        sky = np.zeros((grid.distances, half, lanes), np.float32)

        def run(index: int) -> None:
            row, column = divmod(index, grid.distances)
            if column == grid.distances - 1:
                return
            _gather(
                row,
                column,
                1 if column == 0 else half,
                kind,
                new_eclipse(tables, shadow),
                directions,
                field[row, column],
                sky[column],
            )

        run_blocks(
            run,
            grid.radii * grid.distances,
            cancel=cancel,
            progress=progress,
            message=f"light in the shadow, order {order}",
        )
        field[:, 0, 1:], sky[0, 1:] = field[:, 0, :1], sky[0, :1]
        field = np.concatenate(
            [field, field[:, :, -2::-1] * signs[:, None]], axis=2, dtype=np.float32
        )
        sky = np.concatenate([sky, sky[:, -2::-1]], axis=1, dtype=np.float32)
        field *= fade[:, None, None, None]
        sky *= fade[:, None, None]
        return field, sky

    source, sky_source = sweep(empty, LOCAL_SHADOW, 1)
    used = solution.wavelengths.size
    field, sky, last, last_sky = source, sky_source, source, sky_source
    part = _visible_fractions(empty, tables)
    mean = 1.0 / sqrt(4.0 * pi)
    for order in range(2, _MOST_SWEEPS + 2):
        shadow = empty._replace(
            field=last.reshape(empty.field.shape), sky=last_sky.reshape(empty.sky.shape)
        )
        more, more_sky = sweep(shadow, SCATTERING_CORRECTION, order)
        field, sky = field + more, sky + more_sky
        whole = np.maximum(part + field[..., 0, :] * mean, 1e-9)
        change = np.abs(more[..., 0, :]) * mean / whole
        if float(change[..., :used].max()) < grid.tolerance:
            tail, sky_tail = _tail(more[..., 0, :], last[..., 0, :]), _tail(more_sky, last_sky)
            return {"field": field + more * tail[..., None, :], "sky": sky + more_sky * sky_tail}
        last, last_sky = more, more_sky
    raise ConvergenceError(f"light in the shadow has not converged after {_MOST_SWEEPS} sweeps")


def _tail(last: Float32Array, before: Float32Array) -> Float32Array:
    """Sum of all further orders over the last one, as a geometric series. [1]"""
    ratio = np.divide(last, before, out=np.zeros_like(last), where=np.abs(before) > 1e-12)
    ratio = np.clip(ratio, 0.0, _LARGEST_RATIO)
    return np.asarray(ratio / (1.0 - ratio), np.float32)


def _fade(distances: int) -> Float32Array:
    x = np.clip((np.linspace(0.0, 1.0, distances) - _FADE) / (1.0 - _FADE), 0.0, 1.0)
    return np.asarray(1.0 - x * x * (3.0 - 2.0 * x), np.float32)


def _mirror_signs(degree: int) -> Float32Array:
    """Parity of the harmonics under reflection at the plane of axis and centre."""
    return np.array(
        [-1.0 if m < 0 else 1.0 for l in range(degree + 1) for m in range(-l, l + 1)], np.float32
    )


def _directions(grid: ShadowGrid) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, int]:
    """Quadrature over [0, 1] on either side of the horizon, and number of azimuths."""
    up, down = gauss_legendre(grid.up), gauss_legendre(grid.down)
    return up.nodes, up.weights, down.nodes, down.weights, grid.azimuths


def _visible_fractions(shadow: ShadowTables, tables: MarchTables) -> Float32Array:
    """Visible fraction of the star at every node, shape (radii, distances, angles, w). [1]"""
    out = np.empty((shadow.radii, shadow.distances, shadow.angles, shadow.star.lanes), np.float32)
    _fill_local(tables.bottom, tables.top, shadow, new_shadow_workspace(shadow), out)
    return out


@compiled_loop
def _fill_local(bottom, top, shadow, scratch, out):
    for row in range(out.shape[0]):
        for column in range(out.shape[1]):
            for angle in range(out.shape[2]):
                x, y, z = node_point(row, column, angle, bottom, top, shadow)
                visible_star_fraction(x, y, z, shadow, scratch)
                out[row, column, angle] = scratch.seen


@compiled_loop
def _gather(row, column, count, kind, eclipse, directions, field, sky):
    """Moments and diffuse irradiance of the next order at the nodes of a distance.

    Parameters
    ----------
    row, column, count : int
        Indices of altitude and distance, and number of position angles.
    kind : int
        ``LOCAL_SHADOW`` or ``SCATTERING_CORRECTION``.
    eclipse : Eclipse
    directions : tuple of arrays
        Result of ``_directions``.
    field : array, shape (angles, K, w)
        Receives the correction d.
    sky : array, shape (angles, w)
        Receives the correction of diffuse irradiance, at the lowest nodes.
    """
    eclipse = without_refcount(eclipse)
    tables, work, shadow, scratch = eclipse
    lanes, star = tables.lanes, shadow.star
    up_nodes, up_weights, down_nodes, down_weights, azimuths = directions
    result = np.empty((2, lanes), np.float32)
    scale = np.empty(lanes, np.float32)
    terms = (shadow.degree + 1) * (shadow.degree + 1)
    for angle in range(count):
        x, y, z = node_point(row, column, angle, tables.bottom, tables.top, shadow)
        q = min(max(sqrt(x * x + y * y + z * z), tables.bottom), tables.top)
        for at in range(lanes):
            scratch.offset[at] = 0.0
        visible_star_fraction(x, y, z, shadow, scratch)
        for at in range(lanes):
            scratch.offset[at] = scratch.seen[at]
        a, b, c = x / q, y / q, z / q
        mu_s = min(max(a * star.star_x + b * star.star_y + c * star.star_z, -1.0), 1.0)
        # Horizontal directions: any, if the quadrature is even in azimuth.
        flat = sqrt(a * a + c * c)
        d, e, f = (c / flat, 0.0, -a / flat) if flat > 1e-3 else (1.0, 0.0, 0.0)
        g, h, i = b * f - c * e, c * d - a * f, a * e - b * d
        level, sun, first, second = field_place(q, 1.0, mu_s, mu_s, tables, work)
        node = field_node(level, sun, np.float32(first), np.float32(second))
        for at in range(0, lanes, LANES):
            before = lane_view(tables.field, at)
            low, mean = between(before, node, 0), between(before, node, 1)
            store(scale, at, mean / low * work.functions[0])
        horizon = horizon_cosine(q, tables.bottom)
        for side in range(2):
            nodes, weights = (up_nodes, up_weights) if side == 0 else (down_nodes, down_weights)
            for k in range(nodes.size):
                t = nodes[k]
                span = 1.0 - horizon if side == 0 else -1.0 - horizon
                mu = horizon + span * t * t
                solid = abs(span) * 2.0 * t * weights[k] * 2.0 * pi / azimuths
                sine = sqrt(max((1.0 - mu) * (1.0 + mu), 0.0))
                length = distance_to_top(q, mu, tables.top)
                if side == 1:
                    length = distance_to_bottom(q, mu, tables.bottom)
                if length <= 0.0 and side == 0:
                    continue
                for turn in range(azimuths):
                    phi = 2.0 * pi * (turn + 0.5 * ((k + 1) % 2)) / azimuths
                    r, o = sine * cos(phi), sine * sin(phi)
                    u, v, w = mu * a + r * d + o * g, mu * b + r * e + o * h, mu * c + r * f + o * i
                    nu = u * star.star_x + v * star.star_y + w * star.star_z
                    half = sqrt(max(0.5 * (1.0 - nu), 0.0))
                    read_phase(half, tables.phase, work.phase)
                    line = EclipsedLine(x, y, z, u, v, w, length, half)
                    line_eclipsed(line, side == 1, kind, work.phase, eclipse, result)
                    direction_functions(u, v, w, shadow, scratch)
                    for at in range(0, lanes, LANES):
                        moments, flux = lane_view(field, at), lane_view(sky, at)
                        value = lane_view(result, at)[0] * np.float32(solid)
                        for index in range(terms):
                            moments[angle, index] += value * scratch.functions[index]
                        if row == 0 and side == 0:
                            flux[angle] += value * np.float32(mu)
        for at in range(lanes):
            for index in range(terms):
                over = scale[at]
                field[angle, index, at] = field[angle, index, at] / over if over > 0.0 else 0.0
        if row == 0:
            ground_light(mu_s, 2, tables, work)
            for at in range(lanes):
                over = work.irradiance[1, at]
                sky[angle, at] = sky[angle, at] / over if over > 0.0 else 0.0


def _refined(shadow: ShadowTables, field: Float32Array, sky: Float32Array) -> ShadowTables:
    """Tables with nodes interpolated between those of the iteration."""
    distances = (shadow.distances - 1) * _FINER + 1
    angles = (shadow.angles - 1) * _FINER_ANGLES + 1
    shape = (shadow.distances, shadow.angles, -1)
    finer = _finer(field.reshape(shadow.radii, *shape), distances, angles)
    finer_sky = _finer(sky.reshape(1, *shape), distances, angles)
    return shadow._replace(
        distances=distances,
        angles=angles,
        field=finer.reshape(-1, *shadow.field.shape[1:]),
        sky=finer_sky.reshape(-1, shadow.sky.shape[-1]),
    )


def _finer(values: Float32Array, distances: int, angles: int) -> Float32Array:
    """Values on a finer grid, shape (rows, distances, angles, n).

    In distance by cubic splines across the axis, with the position angle shifted by half a turn on
    the other side; in angle by trigonometric interpolation.
    """
    from scipy.interpolate import CubicSpline

    rows, columns, turns, n = values.shape
    half = (turns - 1) // 2
    there = values[:, :, : half + 1]
    opposite = values[:, 1:, half:][:, ::-1]
    at = np.arange(1 - columns, columns) / (columns - 1.0)
    through = np.concatenate([opposite, there], axis=1)
    fine = CubicSpline(at, through, axis=1)(np.arange(1 - distances, distances) / (distances - 1.0))
    around = np.concatenate(
        [fine[:, distances - 1 :], fine[:, distances - 1 :: -1][:, :, 1:]], axis=2
    )
    spectrum = np.fft.rfft(around[:, :, : turns - 1], axis=2)
    padded = np.zeros((rows, distances, (angles - 1) // 2 + 1, n), complex)
    padded[:, :, : spectrum.shape[2]] = spectrum
    if spectrum.shape[2] < padded.shape[2]:
        padded[:, :, spectrum.shape[2] - 1] *= 0.5
    out = np.fft.irfft(padded, n=angles - 1, axis=2) * ((angles - 1) / (turns - 1))
    return np.asarray(np.concatenate([out, out[:, :, :1]], axis=2), np.float32)
