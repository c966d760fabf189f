"""``compose``: path radiance, transmittance and sky for another renderer's image, in bands of rows.

The radiance at the camera is that of the surface times the transmittance, plus the path radiance.
Both are marched along the segment, never the difference of two look-ups.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.engines.composition.depth import distances, filled, kind_of
from airlight.engines.composition.froxels import CELL
from airlight.engines.composition.light_renderer import LightRenderer
from airlight.engines.composition.pinhole import Pinhole
from airlight.engines.composition.placement import Placement, pinhole_view
from airlight.engines.composition.relight import SurfaceLight
from airlight.errors import Cancelled, ConflictError, ParameterError, warn
from airlight.image.white_balance import White, star_white
from airlight.kernel.threads import Cancel, Progress
from airlight.physics.units import without_unit
from airlight.planets.left_out import warn_of_shape
from airlight.planets.picture_wavelengths import picture_wavelengths
from airlight.planets.reading.reader import PlanetLike, load_planet
from airlight.render.clouds.cloud_time import clouds_at
from airlight.render.pixels.scenes_by_light import scenes_by_light
from airlight.scene import Scene
from airlight.scene.frame import Frame
from airlight.solver import Solution
from airlight.solver.moments.solution import moments_solution
from airlight.solver.solve import solution_of

if TYPE_CHECKING:
    from airlight.render.clouds.clouds_around import CloudsAround

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Pixels of a band, in whole rows of cells, which bounds the memory.
_BAND: Final = 1 << 16
#: Most rows of cells of a band.
_CELLS: Final = 8
#: Search distance for the nearest surface where a pass has none. [pixel]
_REACH: Final = 8
#: Largest cover, albedo and visible fraction: 1 and the rounding of half floats. [1]
_MOST: Final = 1.001


@dataclass(frozen=True, eq=False)
class Composed:
    """Result of ``compose``.

    Attributes
    ----------
    rgb : array, shape (h, w, 3), float32
        Linear sRGB, on the scale of the input.
    scale : array, shape (3,)
        Radiance of the unit of each channel. [W m⁻² sr⁻¹]
    scene : Scene
        Scene with the observer, light and field of view of the image.
    star_radius : float
        Angular radius of the star. [rad]
    star_white : (float, float)
        Chromaticity of the star's light outside the air. [1]
    marched : float
        Fraction of surface pixels that were marched instead of interpolated in froxels.
    error : float
        Largest froxel error, sampled at one pixel per cell, over the radiance of a grey surface
        with aerial perspective; 0 without froxels.
    """

    rgb: Float32Array
    scale: FloatArray
    scene: Scene
    star_radius: float
    star_white: White
    marched: float
    error: float

    @property
    def frame(self) -> Frame:
        """Frame of radiance, as from ``render``. [W m⁻² sr⁻¹]"""
        return Frame(
            rgb=(self.rgb * self.scale).astype(np.float32),
            pixel_angle=self.scene.camera.glare_angle,
            star_white=self.star_white,
            metadata={"unit": "W m-2 sr-1, linear sRGB weighted by CIE 1931"},
        )


def compose(
    rgb: ArrayLike,
    depth: ArrayLike,
    camera: Pinhole,
    solution: Solution | PlanetLike,
    place: Placement,
    *,
    alpha: ArrayLike | None = None,
    albedo: ArrayLike | None = None,
    normals: ArrayLike | None = None,
    shadow: ArrayLike | None = None,
    depth_kind: str = "auto",
    white: float | None = 1.0,
    exact: bool = False,
    disc: bool = True,
    clouds: CloudsAround | None = None,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Composed:
    """Composite an image with the atmosphere in front and the sky behind.

    Parameters
    ----------
    rgb : array, shape (h, w, 3)
        Image without atmosphere, linear sRGB; premultiplied by ``alpha``.
    depth : array, shape (h, w) or (h, w, 3)
        Depth of the surfaces, see ``depth_kind``. No surface: 0 or less, NaN, 1e9 or more, or the
        position 0, 0, 0. [scene units]
    camera : Pinhole
        Camera.
    solution : MomentsSolution, Planet, str or Path
        Solution of the planet at three or more wavelengths; a planet, the name of a preset or a
        path is solved at sixteen.
    place : Placement
        Place of the scene's origin on the planet, and direction of the sun.
    alpha : array, shape (h, w), optional
        Coverage by surfaces, with sky behind; by default 1 where there is depth. Partly covered
        pixels without depth take that of the nearest surface.
    albedo, normals : array, shape (h, w, 3), optional
        Lambert albedo in linear sRGB, premultiplied [1], and normals in scene coordinates. With
        both, surfaces are relit by star, sky and ground, and ``rgb`` is ignored.
    shadow : array, shape (h, w), optional
        Visible fraction of the star for relighting; 1 by default. [1]
    depth_kind : str
        ``planar`` along the optical axis, ``distance`` along the ray, ``position`` in the scene,
        ``inverse`` for 1 over planar; ``auto`` is ``position`` for three channels, otherwise
        ``planar``.
    white : float, optional
        Value of ``rgb`` of a white Lambert surface facing the star without atmosphere, in each
        channel: the image is white-balanced to the star. None: ``rgb`` is radiance in linear sRGB,
        as from ``render``. [W m⁻² sr⁻¹]
    exact : bool
        Whether every pixel is marched; otherwise froxels are used where their error is below
        0.2 %.
    disc : bool
        Whether the star's disc is rendered in the sky.
    clouds : CloudsAround, optional
        Three-dimensional clouds; by default those of a planet, and none of a solution.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``.

    Returns
    -------
    Composed
        Composite on the scale of ``rgb``.

    Raises
    ------
    ParameterError
        If arrays and camera have different sizes, a value is out of range, or the camera is below
        the ground.
    Cancelled
        If ``cancel`` requested it.

    Examples
    --------
    >>> import airlight
    >>> solution = airlight.solve("mars-rayleigh", quality="preview")
    >>> camera = airlight.Pinhole(width=4, height=2, focal_x=2.0, focal_y=2.0, to_world=np.eye(4))
    >>> black, far = np.zeros((2, 4, 3)), np.full((2, 4), 20e3)
    >>> place = airlight.Placement(altitude=100.0)
    >>> bool((compose(black, far, camera, solution, place).rgb > 0.0).all())  # air before it
    True
    """
    colors, cover, passes, kind = _checked(rgb, alpha, depth, depth_kind, camera)
    relit = _relit(colors.shape, albedo, normals, shadow)
    if white is not None and not 0.0 < white < np.inf:
        raise ParameterError("white", white, "above 0")
    if not isinstance(solution, Solution):
        solution = load_planet(solution)
        at = Scene(latitude=place.latitude, longitude=place.longitude)
        clouds, solution = clouds or clouds_at(solution, at), solution.without_clouds
    solution = solution_of(solution, picture_wavelengths, progress=progress, cancel=cancel)
    solution = moments_solution(solution, "compose")
    warn_of_shape(solution.medium, "compose")
    view = pinhole_view(camera, place, solution.medium.bottom_radius)
    pictures = [
        LightRenderer(seen, lit, view, exact, disc, clouds)
        for seen, lit, _, _ in scenes_by_light(view.scene, solution)
    ]
    surface = SurfaceLight(solution, white)
    out = np.empty((camera.height, camera.width, 3), np.float32)
    step = CELL * min(max(_BAND // (CELL * camera.width), 1), _CELLS)
    bands = -(-camera.height // step)
    counts, error = np.zeros(2), 0.0
    for band in range(bands):
        if cancel is not None and cancel():
            raise Cancelled("the composition")
        first, last = band * step, min((band + 1) * step, camera.height)
        # silhouettes at the band's edges see the surfaces of the next rows
        low, high = max(first - _REACH, 0), min(last + _REACH, camera.height)
        rows, near = slice(first, last), slice(low, high)
        away = distances(passes[near], kind, camera, near, place.metres_per_unit)
        covers = np.isfinite(away).astype(np.float64) if cover is None else cover[near]
        away = filled(away, (covers > 0.0) & (covers < 1.0), _REACH)[first - low : last - low]
        covers = covers[first - low : last - low].copy()
        covers[(covers >= 1.0) & np.isinf(away)] = 0.0  # a background, not a surface
        light = np.where((covers > 0.0)[..., None], colors[rows], 0.0) * surface.scale
        total = np.zeros_like(light)
        solid = covers > 0.0
        for number, picture in enumerate(pictures):
            air, through, statistics = picture.air(camera, rows, away, solid)
            if relit is not None:
                parts = [one[rows][solid] for one in relit]
                total[solid] += picture.relit(camera, rows, away, solid, parts, through)
            elif number == 0:
                total[solid] = surface.through(light[solid], through)
            if number == 0:
                counts += statistics[:2]
            error = max(error, statistics[2])
            total[solid] += covers[solid][:, None] * (air @ picture.colors)
            open_ = covers < 1.0
            total[open_] += (1.0 - covers[open_])[:, None] * picture.sky(rows, open_)
        out[rows] = total / surface.scale
        if progress is not None:
            progress(band + 1, bands, "composing")
    return Composed(
        rgb=out,
        scale=surface.scale,
        scene=view.scene,
        star_radius=solution.lights[0].angular_radius,
        star_white=star_white(solution.lights[0].spectrum),
        marched=float(counts[1] / max(counts[0], 1.0)),
        error=error,
    )


def _checked(
    rgb: ArrayLike, alpha: ArrayLike | None, depth: ArrayLike, kind: str, camera: Pinhole
) -> tuple[NDArray[Any], NDArray[Any] | None, NDArray[Any], str]:
    """Validated colours, alpha and depth of the camera's size, and the kind of depth."""
    for name, one in (("rgb", rgb), ("depth", depth), ("alpha", alpha)):
        without_unit(one, name)
    colors, passes = np.asarray(rgb), np.asarray(depth)
    cover = None if alpha is None else np.asarray(alpha)
    shape = (camera.height, camera.width)
    if colors.shape != (*shape, 3):
        raise ParameterError("rgb", colors.shape, f"shape {(*shape, 3)}, as the camera's picture")
    kind = kind_of(passes, kind)
    if passes.shape[:2] != shape or (passes.ndim == 3 and passes.shape[2] != 3):
        raise ParameterError("depth", passes.shape, f"the picture's rows and columns, {shape}")
    if cover is not None:
        if cover.shape != shape:
            raise ParameterError("alpha", cover.shape, f"the picture's rows and columns, {shape}")
        _check_range("alpha", cover, 0.0, _MOST)
    _check_range("rgb", colors, -np.inf, np.inf)
    missing = int(
        np.count_nonzero(np.isnan(passes).any(axis=-1) if passes.ndim > 2 else np.isnan(passes))
    )
    if missing:
        warn(f"depth is NaN in {missing} pixels: they show the sky")
    return colors, cover, passes, kind


def _relit(
    shape: tuple[int, ...],
    albedo: ArrayLike | None,
    normals: ArrayLike | None,
    shadow: ArrayLike | None,
) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any]] | None:
    """Validated albedo, normals and shadow for relighting; None without relighting."""
    if albedo is None or normals is None:
        for name, one in (("albedo", albedo), ("normals", normals), ("shadow", shadow)):
            if one is not None:
                raise ConflictError(name, "requires albedo and normals")
        return None
    lit = np.ones(shape[:2]) if shadow is None else np.asarray(shadow)
    given = {"albedo": np.asarray(albedo), "normals": np.asarray(normals), "shadow": lit}
    for name, one in given.items():
        wanted = shape[:2] if name == "shadow" else shape
        if one.shape != wanted:
            raise ParameterError(name, one.shape, f"shape {wanted}, as the picture")
        low, high = (-np.inf, np.inf) if name == "normals" else (0.0, _MOST)
        _check_range(name, one, low, high)
    return given["albedo"], given["normals"], lit


def _check_range(name: str, values: NDArray[Any], low: float, high: float) -> None:
    """Raise for values that are not finite or out of range, with their count."""
    wrong = ~(np.isfinite(values) & (values >= low) & (values <= high))
    if wrong.any():
        allowed = "finite numbers" if high == np.inf else "0 to 1"
        count = np.count_nonzero(wrong)
        others = f"; {count} values are not" if count > 1 else ""
        raise ParameterError(name, float(values[wrong][0]), allowed + others)
