"""Monte Carlo radiances and irradiances of a planet with three-dimensional clouds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import exp
from time import perf_counter
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_layer import CloudLayer
from airlight.errors import ConflictError, ParameterError
from airlight.geometry.place_axes import place_axes
from airlight.geometry.shell import horizon_cosine
from airlight.kernel import compiled_loop, vectorized
from airlight.kernel.threads import run_blocks
from airlight.solver.lines_of_sight import enter_shell, start_frame
from airlight.solver.montecarlo.cloud_cells import CloudCells, CloudyStarts, cloud_cells
from airlight.solver.montecarlo.cloud_rays import FAR, cloud_depth
from airlight.solver.montecarlo.estimate import Estimate, Query
from airlight.solver.montecarlo.history_optics import with_cloud_phases
from airlight.solver.montecarlo.solution import MonteCarloSolution, turned_errors, turned_stokes
from airlight.solver.star_light import direct_irradiance
from airlight.solver.stokes_frame import VERTICAL

FloatArray = NDArray[np.float64]

#: Points along each side of an area for direct light.
_DIRECT_POINTS: Final = 32
#: Sine of the zenith angle up to which the star is moved to the zenith. [1]
_OVERHEAD: Final = 1e-5


@dataclass(frozen=True)
class Areas:
    """Areas, or points, of a box, at which light is observed.

    Attributes
    ----------
    east, north : array, shape (n,)
        Gnomonic coordinates of the centres about the place of the box. [m]
    width, length : array, shape (n,)
        Sides to the east and to the north; 0 for a point. [m]
    """

    east: FloatArray
    north: FloatArray
    width: FloatArray
    length: FloatArray

    @classmethod
    def at(
        cls, east: ArrayLike, north: ArrayLike, width: ArrayLike = 0.0, length: ArrayLike = 0.0
    ) -> Areas:
        """Areas from arrays of any common shape, raveled. [m]"""
        sides = np.broadcast_arrays(*(np.asarray(x, float) for x in (east, north, width, length)))
        return cls(*(np.ascontiguousarray(side).ravel() for side in sides))

    @classmethod
    def columns(cls, field: CloudField) -> Areas:
        """Columns of a field, those to the north first."""
        (nx, ny, _), (dx, dy, _) = field.extinction.shape, field.spacing
        east = field.west + dx * (np.arange(nx) + 0.5)
        north = field.south + dy * (np.arange(ny) + 0.5)
        return cls.at(east[:, None], north, dx, dy)

    @classmethod
    def box(cls, field: CloudField) -> Areas:
        """The whole of a field."""
        sides = (n * step for n, step in zip(field.extinction.shape, field.spacing, strict=True))
        return cls.at(*field.drift, *list(sides)[:2])


class CloudyAir:
    """Planet with clouds, lit by its star: every result is traced (see ``histories``).

    The star's direction is given at the place of the first cloud. Estimates are per irradiance of
    the star and scalar if the solution's settings are; all orders are sampled. Q and U refer to the
    meridian plane of each line, see ``stokes_frame``, or that of the azimuth of a vertical line.
    Estimates are reproducible, and errors of different lines independent, as those of
    ``MonteCarloSolution``.

    Parameters
    ----------
    solution : MonteCarloSolution
        Clear planet.
    clouds : sequence of CloudLayer
        Clouds; where they overlap, extinctions add.

    Raises
    ------
    ConflictError
        With refraction: rays through clouds are straight.
    ParameterError
        If a cloud reaches beyond the atmosphere, or its optical properties are at other
        wavelengths.
    """

    def __init__(self, solution: MonteCarloSolution, clouds: Sequence[CloudLayer]) -> None:
        medium = solution.medium
        if solution.geometry.shell is not None:
            raise ConflictError("refraction", "must be off with three-dimensional clouds")
        for cloud in clouds:
            if cloud.field.top > medium.thickness:
                limit = f"at most {medium.thickness:g} m, the top of the atmosphere"
                raise ParameterError("top of a cloud", cloud.field.top, limit)
        self.solution = solution
        self.fields = tuple(cloud.field for cloud in clouds)
        self.axes = place_axes(
            [field.latitude for field in self.fields], [field.longitude for field in self.fields]
        )
        optics = [cloud.optics_at(medium.wavelengths) for cloud in clouds]
        cells = cloud_cells(self.fields, self.axes, medium.bottom_radius)
        self._cells: list[CloudCells] = []
        self._airs = []
        for k in range(medium.wavelengths.size):
            extinction = np.array([one.extinction[k] for one in optics])
            albedo = np.array([one.albedo[k] for one in optics])
            self._cells.append(cells.with_optics(extinction, albedo))
            phases = [one.phase for one in optics]
            self._airs.append(with_cloud_phases(solution.airs[k], medium, k, phases))

    def radiance(
        self, *, latitude: ArrayLike, longitude: ArrayLike, altitude: ArrayLike,
        view_zenith: ArrayLike, azimuth: ArrayLike, sun_zenith: ArrayLike, sun_azimuth: ArrayLike,
    ) -> Estimate:  # fmt: skip
        """Radiances of n lines of sight from any place.

        Parameters
        ----------
        latitude, longitude, altitude : array, shape (n,)
            Observers, inside or outside the atmosphere. [deg], [deg], [m]
        view_zenith, azimuth : array, shape (n,)
            Direction of view there, azimuth clockwise from north. [deg]
        sun_zenith, sun_azimuth : array, shape (n,)
            Direction of the star at the place of the first cloud, likewise. [deg]

        Returns
        -------
        Estimate
            Radiance per irradiance of the star. [sr⁻¹]
        """
        given = (latitude, longitude, altitude, view_zenith, azimuth, sun_zenith, sun_azimuth)
        sides = np.broadcast_arrays(*(np.atleast_1d(np.asarray(x, float)) for x in given))
        axes = place_axes(sides[0], sides[1])
        points = (self.solution.medium.bottom_radius + sides[2])[:, None] * axes[:, 2]
        views = _direction(axes, sides[3], sides[4])
        sun = _direction(self.axes[0], sides[5], sides[6])
        found = self._estimate(points, views, sun, np.zeros((points.shape[0], 2, 3)), 0)
        return _in_meridian(found, axes, sun, sides[3], sides[4])

    def radiance_over(
        self, areas: Areas, *, altitude: float, view_zenith: float, azimuth: float,
        sun_zenith: float, sun_azimuth: float,
    ) -> Estimate:  # fmt: skip
        """Mean radiances of parallel lines of sight through areas of the first cloud's box.

        Parameters
        ----------
        areas : Areas
            Areas at the altitude. [m]
        altitude : float
            Altitude of the observers. [m]
        view_zenith, azimuth, sun_zenith, sun_azimuth : float
            Directions at the place of the box, azimuths clockwise from north. [deg]

        Returns
        -------
        Estimate
            Radiance per irradiance of the star. [sr⁻¹]
        """
        points, sides = self._area_vectors(areas, altitude)
        view = _direction(self.axes[0], view_zenith, azimuth)
        sun = _direction(self.axes[0], sun_zenith, sun_azimuth)
        found = self._estimate(points, view + 0.0 * points, sun, sides, 0)
        angles = (np.full(len(points), one) for one in (view_zenith, azimuth))
        return _in_meridian(found, self.axes[0], sun, *angles)

    def irradiance_over(
        self, areas: Areas, *, altitude: float, upward: bool, sun_zenith: float, sun_azimuth: float
    ) -> Estimate:
        """Mean horizontal irradiances of areas of the first cloud's box, without direct light.

        Parameters
        ----------
        areas, altitude, sun_zenith, sun_azimuth :
            Arguments of ``radiance_over``.
        upward : bool
            Whether from below rather than from above.

        Returns
        -------
        Estimate
            Diffuse irradiance per irradiance of the star. [1]
        """
        points, sides = self._area_vectors(areas, altitude)
        sun = _direction(self.axes[0], sun_zenith, sun_azimuth)
        return self._estimate(points, None, sun, sides, -1 if upward else 1)

    def direct_over(
        self, areas: Areas, *, altitude: float, sun_zenith: float, sun_azimuth: float
    ) -> FloatArray:
        """Mean direct horizontal irradiances of areas of the first cloud's box.

        Transmittance of clouds is that to the star's centre, at 32 points along each side; that
        of the air, at the centre of the area.

        Parameters
        ----------
        areas, altitude, sun_zenith, sun_azimuth :
            Arguments of ``radiance_over``.

        Returns
        -------
        array, shape (n, nl)
            Direct irradiance per irradiance of the star. [1]
        """
        points, sides = self._area_vectors(areas, altitude)
        sun = _direction(self.axes[0], sun_zenith, sun_azimuth)
        r = np.linalg.norm(points, axis=1)
        mu_s = points @ sun / r
        bottom = self.solution.medium.bottom_radius
        found = direct_irradiance(self.solution.medium, r, mu_s)
        blocked = mu_s < vectorized(horizon_cosine)(r, bottom)

        def line(k: int) -> None:
            if blocked[k]:
                return
            for at, cells in enumerate(self._cells):
                found[k, at] *= _mean_transmittance(points[k], sides[k], sun, _DIRECT_POINTS, cells)

        run_blocks(line, len(points), cancel=self.solution.cancel)
        return found

    def _area_vectors(self, areas: Areas, altitude: float) -> tuple[FloatArray, FloatArray]:
        """Centres (n, 3) and sides (n, 2, 3) of areas in the planet's frame. [m]"""
        radius = self.solution.medium.bottom_radius

        def place(east: FloatArray, north: FloatArray) -> FloatArray:
            along = np.stack([east, north, np.full_like(east, radius)], axis=1)
            along *= (radius + altitude) / np.linalg.norm(along, axis=1)[:, None]
            return np.asarray(along @ self.axes[0])

        half = 0.5 * areas.width, 0.5 * areas.length
        east = place(areas.east + half[0], areas.north) - place(areas.east - half[0], areas.north)
        north = place(areas.east, areas.north + half[1]) - place(areas.east, areas.north - half[1])
        return place(areas.east, areas.north), np.stack([east, north], axis=1)

    def _estimate(
        self,
        points: FloatArray,
        views: FloatArray | None,
        sun: FloatArray,
        sides: FloatArray,
        hemisphere: int,
    ) -> Estimate:
        """Estimates for points [m], views and the sun's direction [1] in the planet's frame."""
        started = perf_counter()
        medium = self.solution.medium
        bottom, top = medium.bottom_radius, medium.top_radius
        suns = sun + 0.0 * points
        r = np.linalg.norm(points, axis=1)
        up = points / r[:, None]
        along = hemisphere * up if views is None else views
        sine = np.linalg.norm(np.cross(up, along), axis=1)
        cosines = [_cosine(*pair) for pair in ((up, along), (up, suns), (along, suns))]
        lines = enter_shell(r, cosines[0], sine, cosines[1], cosines[2], bottom, top)
        inside = points + _way_in(r, cosines[0], sine, lines.r)[:, None] * along
        up = inside / np.linalg.norm(inside, axis=1)[:, None]
        # A star overhead has no azimuth: it is moved to the zenith.
        overhead = (np.linalg.norm(np.cross(up, suns), axis=1) < _OVERHEAD) & (lines.mu_s > 0.0)
        suns = np.where(overhead[:, None], up, suns)
        vertical = sine * sine < VERTICAL
        mu, mu_s = (
            np.where(vertical, np.sign(lines.mu), lines.mu),
            np.where(overhead, 1.0, lines.mu_s),
        )
        nu = np.where(overhead | vertical, mu * mu_s, lines.nu)
        frames = np.stack([start_frame(*each) for each in zip(up, along, suns, strict=True)])
        starts = np.stack([lines.r, mu, mu_s, nu], axis=1)
        clouds = CloudyStarts(
            self._cells, frames, np.ascontiguousarray(sides @ frames.transpose(0, 2, 1))
        )
        # A view of the ground from the ground has no length, but light.
        lengths = np.maximum(lines.length, np.where(lines.to_ground, 1e-3, 0.0))
        query = Query(starts, lengths, hemisphere, None, None, clouds=clouds)
        return self.solution.answer(query, started, self._airs)


def _in_meridian(
    found: Estimate, axes: FloatArray, sun: FloatArray, view_zenith: FloatArray, azimuth: FloatArray
) -> Estimate:
    """Estimate with Q and U for views on both sides of the star, see ``to_meridian``.

    Parameters
    ----------
    found : Estimate
        Estimate in frames in which the line of sight is on the positive side of the star.
    axes, sun : array
        Axes of the observers' places, and directions of the star. [1]
    view_zenith, azimuth : array, shape (n,)
        Directions of view there, azimuth clockwise from north. [deg]
    """
    east, north = (np.einsum("...j,...j->...", axes[..., k, :], sun) for k in (0, 1))
    away = azimuth - np.degrees(np.arctan2(east, north))
    return replace(
        found,
        polarised=turned_stokes(found.total, found.polarised, view_zenith, away)[:, 1:],
        polarised_error=turned_errors(found, view_zenith, away)[:, 1:],
    )


def _cosine(a: FloatArray, b: FloatArray) -> FloatArray:
    """Cosine between unit vectors, shape (n,)."""
    return np.asarray(np.clip(np.einsum("nk,nk->n", a, b), -1.0, 1.0))


def _way_in(r: FloatArray, mu: FloatArray, sine: FloatArray, inside: FloatArray) -> FloatArray:
    """Distance from observers outside the shell to where their lines enter it; otherwise 0. [m]"""
    half = np.sqrt(np.maximum(inside * inside - np.square(r * sine), 0.0))
    return np.asarray(np.where((r > inside) & (mu < 0.0), -r * mu - half, 0.0))


def _direction(axes: FloatArray, zenith: ArrayLike, azimuth: ArrayLike) -> FloatArray:
    """Unit vectors from zenith angles and azimuths clockwise from north in axes of places. [1]"""
    theta, phi = np.radians(zenith), np.radians(azimuth)
    parts = (np.sin(theta) * np.sin(phi), np.sin(theta) * np.cos(phi), np.cos(theta))
    return np.asarray(np.einsum("...k,...kj->...j", np.stack(parts, axis=-1), axes))


@compiled_loop
def _mean_transmittance(point, sides, sun, count, clouds):
    """Mean transmittance of clouds towards the sun from points of an area. [1]"""
    total = 0.0
    direction = (sun[0], sun[1], sun[2])
    for i in range(count):
        for j in range(count):
            a, b = (i + 0.5) / count - 0.5, (j + 0.5) / count - 0.5
            x = point[0] + a * sides[0, 0] + b * sides[1, 0]
            y = point[1] + a * sides[0, 1] + b * sides[1, 1]
            z = point[2] + a * sides[0, 2] + b * sides[1, 2]
            total += exp(-cloud_depth((x, y, z), direction, FAR, clouds))
    return total / (count * count)
