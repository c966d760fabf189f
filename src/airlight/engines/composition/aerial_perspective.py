"""Aerial perspective tables of path radiance, transmittance and sky around one observer.

Unlike froxels, they cover all directions: the camera may turn, and translate while the atmosphere
is nearly the same, without new tables. The sky behind has separate tables.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.engines.composition.aerial_reading import (
    AerialTables,
    air_radiance,
    air_transmittance,
    sky_radiance,
)
from airlight.engines.composition.path_radiance import PathRadiance
from airlight.errors import Cancelled, ConflictError, ParameterError
from airlight.geometry.mappings.sky_view import direction_from_row
from airlight.kernel import compiled_loop
from airlight.kernel.lanes import LANES, lane_view
from airlight.kernel.threads import Cancel, Progress
from airlight.physics.units import Measure, quantity, values_in
from airlight.planets.left_out import warn_of_shape
from airlight.render.pixels.view_uniforms import view_uniforms
from airlight.solver.lines_of_sight import enter_shell
from airlight.solver.moments.solution import MomentsSolution, moments_solution

if TYPE_CHECKING:
    from airlight.scene import Scene

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Numbers of azimuths, rows of each half and steps per factor of ten of the tables of the path.
SIZE: Final = (48, 48, 8)
#: Numbers of azimuths, and of rows of each half, of the tables.
SKY_SIZE: Final = (128, 128)
#: Limits of the tables' sizes.
_LEAST, _MOST = 4, 512
#: Smallest coordinate of a row, so that lines of the two halves lie on either side of the horizon.
_ASIDE: Final = 3e-4
#: Smallest transmittance of a channel: deep red light has a negative blue component in sRGB. [1]
_DARKEST: Final = 1e-6
#: Largest value stored: half precision ends at 65504.
_LARGEST: Final = 3e4
#: Texels marched together.
_BLOCK: Final = 1 << 15
#: Number and seed of the points at which errors are measured.
ERROR_POINTS: Final = 4096
SEED: Final = 20260621


@dataclass(frozen=True)
class AerialErrors:
    """Interpolation errors of the tables at random directions and distances.

    Attributes
    ----------
    air_median, air_95, air_largest : float
        Errors of the radiance of a grey surface with aerial perspective. [1]
    sky_median, sky_95, sky_largest : float
        Errors of the radiance of sky and ground, without the star's disc. [1]
    """

    air_median: float
    air_95: float
    air_largest: float
    sky_median: float
    sky_95: float
    sky_largest: float


@dataclass(frozen=True, eq=False)
class AerialPerspective:
    """Path radiance and transmittance to any point around an observer, and the sky behind.

    Directions are unit vectors in the observer's frame: x level towards the star, z up. Radiance
    is relative to that of a white Lambert surface outside the atmosphere that faces the star, in
    each channel of linear sRGB.

    Attributes
    ----------
    tables : AerialTables
        Tables and numbers of the look-ups.
    scene : Scene
        Observer and star.
    scale : array, shape (3,)
        Radiance of the unit of each channel. [W m⁻² sr⁻¹]
    errors : AerialErrors
        Errors, measured when the tables were filled.
    """

    tables: AerialTables
    scene: Scene
    scale: FloatArray
    errors: AerialErrors

    @classmethod
    def fill(
        cls,
        solution: MomentsSolution,
        scene: Scene,
        *,
        nearest: Measure = 10.0,
        farthest: Measure = 200e3,
        size: tuple[int, int, int] = SIZE,
        sky_size: tuple[int, int] = SKY_SIZE,
        progress: Progress | None = None,
        cancel: Cancel | None = None,
    ) -> AerialPerspective:
        """Fill the tables by marching, and measure their interpolation errors.

        Parameters
        ----------
        solution : MomentsSolution
            Solution of the planet at three or more wavelengths.
        scene : Scene
            Observer inside the atmosphere, and one light; the camera is ignored.
        nearest, farthest : float
            Range of tabulated distances: path radiance is proportional to distance below it, and
            constant above it. [m]
        size : (int, int, int)
            Number of azimuths, of rows per hemisphere, and of distances per decade.
        sky_size : (int, int)
            Number of azimuths and of rows per hemisphere of the sky tables.
        """
        solution = moments_solution(solution, "aerial perspective")
        warn_of_shape(solution.medium, "aerial perspective")
        nearest = quantity(nearest, "m", "nearest", bare=True)
        farthest = quantity(farthest, "m", "farthest", bare=True)
        check_request(
            solution.medium.thickness, scene, nearest, farthest, size=size, sky_size=sky_size
        )
        march = _March(solution, scene)
        steps = int(np.ceil(size[2] * np.log10(farthest / nearest))) + 1
        # one node before the nearest and one beyond the farthest, which the cubic needs
        distance = nearest * (farthest / nearest) ** (np.arange(-1, steps + 1) / (steps - 1))
        directions = march.nodes(*size[:2])
        count = directions.shape[0] * distance.size + 2 * sky_size[0] * sky_size[1]
        light = np.zeros((directions.shape[0], distance.size, LANES), np.float32)
        extinction = np.zeros_like(light)
        done, block = 0, max(_BLOCK // distance.size, 1)
        for first in range(0, directions.shape[0], block):
            if cancel is not None and cancel():
                raise Cancelled("the tables of the air")
            part = directions[first : first + block]
            away = np.tile(distance, part.shape[0])
            shape = (part.shape[0], distance.size, 3)
            every = np.repeat(part, distance.size, axis=0)
            radiance, through, _ = march.air(every, away, below=True)
            amount = -np.log(np.maximum(through, _DARKEST))
            light[first : first + block, :, :3] = (radiance / away[:, None]).reshape(shape)
            extinction[first : first + block, :, :3] = (amount / away[:, None]).reshape(shape)
            done += away.size
            if progress is not None:
                progress(done, count, "air")
        sky, star = march.sky(march.nodes(*sky_size))
        if progress is not None:
            progress(count, count, "sky")
        scales = [max(float(one.max()), 1e-30) / _LARGEST for one in (light, extinction)]
        numbers = march.numbers
        tables = AerialTables(
            horizon_mu=numbers["horizon_mu"], horizon_sine=numbers["horizon_sine"],
            star_x=numbers["seen_x"], star_z=numbers["seen_z"],
            star_radius=solution.lights[0].angular_radius,
            nearest=nearest, farthest=farthest,
            octave=(steps - 1) / np.log2(farthest / nearest),
            columns=size[0], rows=size[1], steps=distance.size,
            sky_columns=sky_size[0], sky_rows=sky_size[1],
            light_scale=scales[0], extinction_scale=scales[1],
            air_light=_stored(light / scales[0]), air_extinction=_stored(extinction / scales[1]),
            air_sky=_stored(sky**0.25), air_star=_stored(star**0.25),
        )  # fmt: skip
        return cls(tables, scene, march.scale, _errors(tables, march))

    def air(self, directions: ArrayLike, distances: ArrayLike) -> tuple[Float32Array, Float32Array]:
        """Path radiance and transmittance to points, as in the shader.

        Parameters
        ----------
        directions : array, shape (n, 3)
            Unit vectors in the observer's frame. [1]
        distances : array, shape (n,)
            Distances. [m]

        Returns
        -------
        radiance, transmittance : array, shape (n, 3)
            Linear sRGB, and the transmittance of white. [1]
        """
        return _air_of(self.tables, directions, values_in(distances, "m", "distances"))

    def sky(self, directions: ArrayLike, pixel: Measure = 1e-3) -> Float32Array:
        """Radiance of sky or ground with the star's disc, as in the shader.

        Parameters
        ----------
        pixel : float
            Angle that a pixel spans. [rad]

        Returns
        -------
        array, shape (n, 3)
            Linear sRGB. [1]
        """
        angle = quantity(pixel, "rad", "pixel", bare=True)
        return _sky_of(self.tables, directions, angle)


class _March:
    """Marched radiance along lines of sight, in the colours of the tables."""

    def __init__(self, solution: MomentsSolution, scene: Scene) -> None:
        self.solution = solution
        self.numbers = view_uniforms(scene, solution)
        self._air = PathRadiance(solution, scene)
        self._r = solution.medium.bottom_radius + scene.altitude
        self._sun = scene.sun_direction
        colors = solution.lights[0].colors()
        self.scale = colors.sum(axis=0) / np.pi
        self._radiance = colors / self.scale
        self._white = colors / colors.sum(axis=0)
        radius = solution.lights[0].angular_radius
        self._disc = 0.0 if radius == 0.0 else self.numbers["disc"]
        self.grey = self._air.grey @ self._radiance

    def nodes(self, columns: int, rows: int) -> FloatArray:
        """Directions of the texels, row by row, from above the horizon down, (n, 3). [1]"""
        azimuth = np.pi * (np.arange(columns) / (columns - 1)) ** 2
        at = np.maximum(np.arange(rows) / (rows - 1), _ASIDE)
        horizon = (self.numbers["horizon_mu"], self.numbers["horizon_sine"])
        halves = []
        for sky in (True, False):
            mu, sine = np.array([direction_from_row(row, sky, *horizon) for row in at]).T
            x, y = sine[:, None] * np.cos(azimuth), sine[:, None] * np.sin(azimuth)
            halves.append(np.stack([x, y, np.broadcast_to(mu[:, None], x.shape)], axis=-1))
        return np.concatenate(halves).reshape(-1, 3)

    def air(
        self, directions: FloatArray, distances: FloatArray, *, below: bool = False
    ) -> tuple[FloatArray, FloatArray, NDArray[np.bool_]]:
        """Path radiance and transmittance, each (n, 3), and whether the ray ends inside. [1]"""
        light, through, whole = self._air.before(directions, distances, below=below)
        return light @ self._radiance, through @ self._white, whole

    def sky(self, directions: FloatArray) -> tuple[Float32Array, Float32Array]:
        """Radiance of sky or ground, and of the attenuated stellar disc, each (n, LANES). [1]"""
        medium = self.solution.medium
        mu, sine = directions[:, 2], np.hypot(directions[:, 0], directions[:, 1])
        nu = np.clip(directions @ self._sun, -1.0, 1.0)
        r, mu_s = np.full_like(mu, self._r), np.full_like(mu, self._sun[2])
        lines = enter_shell(r, mu, sine, mu_s, nu, medium.bottom_radius, medium.top_radius)
        sky, star = (np.zeros((mu.size, LANES), np.float32) for _ in range(2))
        sky[:, :3] = np.maximum(self.solution.relative_radiance(lines) @ self._radiance, 0.0)
        free = ~self.solution.geometry.optical_lines(lines).to_ground
        _, through, _ = self._air.before(directions[free], np.full(int(free.sum()), np.inf))
        star[free, :3] = np.maximum(self._disc * through @ self._radiance, 0.0)
        return sky, star


def check_request(
    thickness: float,
    scene: Scene,
    nearest: float,
    farthest: float,
    *,
    size: tuple[int, int, int] = SIZE,
    sky_size: tuple[int, int] = SKY_SIZE,
) -> None:
    """Validate a request before filling tables.

    Parameters
    ----------
    thickness : float
        Thickness of the atmosphere. [m]
    scene, nearest, farthest, size, sky_size :
        Arguments of ``AerialPerspective.fill``.
    """
    if scene.altitude >= thickness:
        allowed = f"below the top of the atmosphere, {thickness:g} m"
        raise ParameterError("scene.altitude", scene.altitude, allowed)
    if len(scene.lights) != 1:
        raise ParameterError("scene.lights", len(scene.lights), "1")
    if scene.camera.polariser is not None:
        raise ConflictError("camera.polariser", "does not apply to aerial perspective")
    if not 0.0 < nearest < np.inf:
        raise ParameterError("nearest", nearest, "above 0 m")
    if not 2.0 * nearest <= farthest <= 1e9:
        raise ParameterError("farthest", farthest, "twice the nearest distance to 1e9 m")
    for one in (*size, *sky_size):
        if not _LEAST <= one <= _MOST:
            raise ParameterError("size", one, f"{_LEAST} to {_MOST}")


def _stored(values: FloatArray | Float32Array) -> Float32Array:
    """Texels rounded to half precision, as in files."""
    return np.ascontiguousarray(values, np.float16).astype(np.float32).reshape(-1, LANES)


def _errors(tables: AerialTables, march: _March) -> AerialErrors:
    """Errors at random directions, and random distances, uniform in the logarithm.

    A third of the directions is uniform over the sphere, a third within 10° of the star, a third
    within 3° of the horizon.
    """
    rng = np.random.default_rng(SEED)
    unit = rng.normal(size=(ERROR_POINTS, 3))
    third = ERROR_POINTS // 3
    unit /= np.linalg.norm(unit, axis=1, keepdims=True)
    star = np.array([tables.star_x, 0.0, tables.star_z])
    unit[:third] = star + 0.17 * rng.random((third, 1)) * unit[:third]
    dip = np.arccos(tables.horizon_mu) + np.radians(rng.uniform(-3.0, 3.0, third))
    flat = unit[-third:, :2] / np.linalg.norm(unit[-third:, :2], axis=1, keepdims=True)
    unit[-third:] = np.column_stack([flat * np.sin(dip)[:, None], np.cos(dip)])
    unit /= np.linalg.norm(unit, axis=1, keepdims=True)
    away = tables.nearest * (tables.farthest / tables.nearest) ** rng.random(ERROR_POINTS)
    light, through, whole = march.air(unit, away)
    air = light + march.grey * through
    radiance, transmittance = _air_of(tables, unit, away)
    wrong = np.abs(radiance + march.grey * transmittance - air) / np.maximum(air, 1e-30)
    free = ~whole
    behind = march.sky(unit)[0][:, :3]
    discless = tables._replace(air_star=np.zeros_like(tables.air_star))
    off = np.abs(_sky_of(discless, unit, 1e-3) - behind) / np.maximum(behind, 1e-30)
    bright = behind > 1e-6 * behind.max()
    return AerialErrors(*_statistics(wrong[free]), *_statistics(off[bright]))


def _air_of(
    tables: AerialTables, directions: ArrayLike, distances: ArrayLike
) -> tuple[Float32Array, Float32Array]:
    unit = np.ascontiguousarray(directions, np.float64)
    out = np.zeros((unit.shape[0], 2, LANES), np.float32)
    _read_air(unit, np.asarray(distances, np.float64), tables, out)
    return out[:, 0, :3], out[:, 1, :3]


def _sky_of(tables: AerialTables, directions: ArrayLike, pixel: float) -> Float32Array:
    unit = np.ascontiguousarray(directions, np.float64)
    out = np.zeros((unit.shape[0], LANES), np.float32)
    _read_sky(unit, pixel, tables, out)
    return out[:, :3]


def _statistics(values: FloatArray) -> tuple[float, float, float]:
    if not values.size:
        return 0.0, 0.0, 0.0
    return float(np.median(values)), float(np.percentile(values, 95.0)), float(values.max())


@compiled_loop
def _read_air(unit, distances, tables, out):
    found = lane_view(out)
    for k in range(distances.size):
        x, y, z = unit[k, 0], unit[k, 1], unit[k, 2]
        found[k, 0] = air_radiance(x, y, z, distances[k], tables)
        found[k, 1] = air_transmittance(x, y, z, distances[k], tables)


@compiled_loop
def _read_sky(unit, pixel, tables, out):
    found = lane_view(out)
    for k in range(unit.shape[0]):
        found[k] = sky_radiance(unit[k, 0], unit[k, 1], unit[k, 2], pixel, tables)
