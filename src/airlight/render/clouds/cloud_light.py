"""``CloudLight``: light of a cloud field in a planet's air, and the tables of its pixels."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_optics import CloudOptics
from airlight.geometry.vectors import Vec3
from airlight.kernel.threads import Cancel, Progress
from airlight.render.clouds.beam_depth import beam_depths
from airlight.render.clouds.clear_distance import clear_distances
from airlight.render.clouds.cloud_tables import SOLVED
from airlight.scene import Scene
from airlight.solver.boxes.directions import directions
from airlight.solver.boxes.light import BoxAir, BoxLight
from airlight.solver.boxes.solution import BoxSolution
from airlight.solver.boxes.solve import solve_box
from airlight.solver.lines_of_sight import enter_shell
from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Optical properties of a cloud's particles at wavelengths. [nm]
OpticsAt = Callable[[FloatArray], CloudOptics]
#: Cosine of the zenith angle below which a flat box has no beam. [1]
LOWEST_BEAM: Final = 0.01
#: Largest number of cells of the boxes that are solved; larger fields are coarsened.
MOST_SOLVED: Final = 640_000
#: Zenith angles and azimuths of the light of the ground; largest factor of light in the air. [1]
_AROUND: Final = (4, 8)
MOST_LIGHT: Final = 10.0
#: Levels of air in a box, and highest degree of their phase functions.
_LEVELS: Final = 6
_DEGREE: Final = 8
#: Distance of the first and the last solved wavelength from the ends, over the number of all. [1]
_INSET: Final = 0.08
#: Singular value over the largest below which spectra of beam and sky count as alike. [1]
_ALIKE: Final = 1e-6


@dataclass(frozen=True, eq=False, kw_only=True)
class CloudLight:
    """Light of a cloud field under one light of a planet.

    Attributes
    ----------
    field : CloudField
    optics : CloudOptics
        At the wavelengths of the solution.
    box : BoxSolution
        Multiple scattering at some of these wavelengths.
    towards : tuple of three float
        Unit vector to the light at the place of the field: east, north, up. [1]
    unit : array, shape (solved,)
        Irradiance of the box's unit over that of the star. [1]
    spectrum : array, shape (SOLVED, nl)
        Weights of the solved wavelengths. [1]
    air_light : array, shape (2, nl)
        See ``CloudTables``. [1]
    depth, base_depth : array
        Results of ``beam_depths``.
    clear : array
        Result of ``clear_distances``.
    """

    field: CloudField
    optics: CloudOptics
    box: BoxSolution
    towards: tuple[float, float, float]
    unit: FloatArray
    spectrum: FloatArray
    air_light: FloatArray
    depth: Float32Array
    base_depth: Float32Array
    clear: Float32Array


def field_axes(field: CloudField, scene: Scene) -> tuple[Vec3, Vec3, Vec3]:
    """Axes of a field's place in the observer's frame: east, north, up. [1]"""
    lat, lon = math.radians(field.latitude), math.radians(field.longitude)
    up = np.array([math.cos(lat) * math.cos(lon), math.cos(lat) * math.sin(lon), math.sin(lat)])
    east = np.array([-math.sin(lon), math.cos(lon), 0.0])
    rows = np.array([east, np.cross(up, east), up]) @ scene.ground_frame
    return tuple(Vec3(*row) for row in rows.tolist())  # type: ignore[return-value]


def sun_in_frame(scene: Scene) -> Vec3:
    """Direction to the light in the observer's frame, whose first axis is below it. [1]"""
    sun = scene.sun_direction
    return Vec3(float(np.hypot(sun[0], sun[1])), 0.0, float(sun[2]))


def solved_wavelengths(count: int) -> NDArray[np.int64]:
    """Indices of at most ``SOLVED`` of so many wavelengths at which boxes are solved."""
    if count <= SOLVED:
        return np.arange(count)
    return np.round(np.linspace(_INSET, 1.0 - _INSET, SOLVED) * (count - 1)).astype(np.int64)


def solve_clouds(
    solution: MomentsSolution,
    scene: Scene,
    field: CloudField,
    optics_at: OpticsAt,
    *,
    quality: str = "default",
    cache: bool = True,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> CloudLight:
    """Solve the light of a field in the air of a planet.

    Parameters
    ----------
    solution : MomentsSolution
        Solution of the planet, under the light.
    scene : Scene
        Scene of this light.
    field : CloudField
        Clouds.
    optics_at : callable
        Optical properties of the particles at wavelengths.
    quality, cache : str, bool
        As for ``solve_box``.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``.
    """
    medium = solution.medium
    east, north, up = (np.array(axis) for axis in field_axes(field, scene))
    sun = np.array(sun_in_frame(scene))
    towards = float(sun @ east), float(sun @ north), float(sun @ up)
    nm = medium.wavelengths
    chosen = solved_wavelengths(nm.size)
    top = np.array([medium.bottom_radius + field.top])
    mu_s = np.array([towards[2]])
    beam = solution.relative_normal_irradiance(top, mu_s)[0]
    sky = solution.relative_sky_irradiance(top, mu_s)[0]
    albedo = np.broadcast_to(medium.ground_albedo, nm.shape)
    shines = towards[2] > LOWEST_BEAM and float(beam.min()) > 0.0
    unit = np.maximum(beam, 1e-6 * beam.max()) if shines else np.ones_like(beam)

    def light_at(along: FloatArray) -> FloatArray:
        looking = -np.asarray(along, float)
        count = looking.shape[0]
        r, mu, sine = np.full(count, top[0]), looking[:, 2], np.hypot(looking[:, 0], looking[:, 1])
        sun, nu = np.full(count, towards[2]), np.clip(looking @ np.array(towards), -1.0, 1.0)
        lines = enter_shell(r, mu, sine, sun, nu, medium.bottom_radius, medium.top_radius)
        return np.asarray(np.maximum(solution.relative_radiance(lines), 0.0))

    def sky_at(along: FloatArray) -> FloatArray:
        return np.asarray(light_at(along)[:, chosen] / unit[chosen])

    light = BoxLight(
        towards=towards if shines else (1.0, 0.0, 0.0),
        albedo=albedo[chosen],
        ground=0.0,
        sky=sky_at,
        air=_box_air(solution, field.top, chosen),
    )
    box = solve_box(
        coarse_field(field),
        optics_at(nm[chosen]),
        light,
        quality=quality,
        cache=cache,
        progress=progress,
        cancel=cancel,
    )
    depth, base_depth = beam_depths(
        field, towards, medium.bottom_radius, progress=progress, cancel=cancel
    )
    spectrum = box_spectrum(nm, chosen, beam, sky)
    return CloudLight(
        field=field,
        optics=optics_at(nm),
        box=box,
        towards=towards,
        unit=unit[chosen],
        spectrum=spectrum,
        air_light=_air_light(solution, box, unit[chosen], spectrum, towards, light_at),
        depth=depth,
        base_depth=base_depth,
        clear=clear_distances(field),
    )


def coarse_field(field: CloudField) -> CloudField:
    """Field of at most ``MOST_SOLVED`` cells, by means over columns side by side."""
    found = field
    while found.extinction.size > MOST_SOLVED:
        shape = found.extinction.shape
        parts = tuple(2 if axis < 2 and count % 2 == 0 else 1 for axis, count in enumerate(shape))
        if parts == (1, 1, 1):
            return found
        x, y, _ = parts
        cells = found.extinction.reshape(shape[0] // x, x, shape[1] // y, y, shape[2])
        found = replace(
            found,
            extinction=cells.mean(axis=(1, 3), dtype=np.float32),
            spacing=(found.spacing[0] * x, found.spacing[1] * y, found.spacing[2]),
        )
    return found


def box_spectrum(
    wavelengths: FloatArray, chosen: NDArray[np.int64], beam: FloatArray, sky: FloatArray
) -> FloatArray:
    r"""Weights that give the light at all wavelengths from that at the solved ones.

    Clouds scatter all colours alike, so that their light is a mixture of that of the beam and of
    the sky, each with a factor linear in wavelength:

    .. math:: L = (a + b\lambda) E_\odot + (c + d\lambda) E_s

    Parameters
    ----------
    wavelengths : array, shape (nl,)
        Wavelengths. [nm]
    chosen : array of int, shape (solved,)
        Indices of the solved wavelengths.
    beam, sky : array, shape (nl,)
        Spectra of the light that falls on the clouds. [1]

    Returns
    -------
    array, shape (SOLVED, nl)
        Weights; 0 for wavelengths that are not there. [1]

    Examples
    --------
    >>> nm, beam = np.linspace(400.0, 700.0, 7), np.linspace(1.0, 2.0, 7)
    >>> sky, chosen = (500.0 / nm) ** 4, np.array([0, 2, 4, 6])
    >>> mixed = 0.3 * beam + (0.2 + 1e-3 * nm) * sky
    >>> bool(np.allclose(mixed[chosen] @ box_spectrum(nm, chosen, beam, sky), mixed))
    True
    """
    slope = (wavelengths - wavelengths.mean()) / max(np.ptp(wavelengths), 1.0)
    spectra = [one / max(one.max(), 1e-30) for one in (beam, sky)]
    basis = np.stack([one * factor for one in spectra for factor in (1.0, slope)], axis=1)
    weights = np.zeros((SOLVED, wavelengths.size))
    weights[: chosen.size] = (basis @ np.linalg.pinv(basis[chosen], rcond=_ALIKE)).T
    return weights


def _air_light(
    solution: MomentsSolution,
    box: BoxSolution,
    unit: FloatArray,
    spectrum: FloatArray,
    towards: tuple[float, float, float],
    light_at: Callable[[FloatArray], FloatArray],
) -> FloatArray:
    """Diffuse light below and above the clouds over that of clear sky, shape (2, nl). [1]

    The sum of the irradiances from above and from below, as in light that is equal from each.
    """
    medium = solution.medium
    ground, mu_s = np.array([medium.bottom_radius]), np.array([towards[2]])
    albedo = np.broadcast_to(medium.ground_albedo, medium.wavelengths.shape)
    sky = solution.relative_sky_irradiance(ground, mu_s)[0]
    sun = solution.relative_direct_irradiance(ground, mu_s)[0]
    below, direct, up = (
        (one.mean((0, 1), dtype=np.float64) * unit) @ spectrum[: unit.size]
        for one in (box.down, box.direct, box.up)
    )
    rays = directions(*_AROUND)
    rising = np.einsum(
        "n,nw->w",
        (rays.weights[1] * rays.vectors[1, :, :, 2]).ravel(),
        light_at(rays.vectors[1].reshape(-1, 3)),
    )
    top = np.array([medium.bottom_radius + box.field.top])
    falling = solution.relative_sky_irradiance(top, mu_s)[0]
    clear = sky + albedo * (sky + sun)
    factors = [
        (below + albedo * (below + direct)) / np.maximum(clear, 1e-30),
        (falling + up) / np.maximum(falling + rising, 1e-30),
    ]
    return np.asarray(np.clip(factors, 0.0, MOST_LIGHT))


def _box_air(solution: MomentsSolution, top: float, chosen: NDArray[np.int64]) -> BoxAir:
    """Air of a planet below an altitude [m], in layers."""
    medium = solution.medium
    edges = np.linspace(0.0, top, _LEVELS + 1)
    density = medium.density.at(0.5 * (edges[1:] + edges[:-1]))  # (nc, levels)
    extinction = density.T @ medium.extinction[:, chosen]
    scattering = density.T @ medium.scattering[:, chosen]
    moments = medium.phase_moments(_DEGREE)[:, chosen]
    moments = moments / np.maximum(moments[..., :1], 1e-30)
    mixed = np.einsum("ck,cw,cwl->kwl", density, medium.scattering[:, chosen], moments)
    mixed = mixed / np.maximum(scattering, 1e-30)[..., None]
    mixed[..., 0] = 1.0
    albedo = np.minimum(scattering / np.maximum(extinction, 1e-30), 1.0)
    return BoxAir(edges=edges, extinction=extinction, albedo=albedo, moments=mixed)
