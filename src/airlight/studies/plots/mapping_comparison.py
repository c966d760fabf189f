"""Scattering table on two mappings, in its memory layout."""

from __future__ import annotations

from dataclasses import fields
from typing import TYPE_CHECKING, Final, Literal

import numpy as np
from numpy.typing import NDArray

from airlight.errors import Cancelled
from airlight.geometry.mappings import linear, power, weighted_power
from airlight.geometry.mappings.texels import index_coordinate
from airlight.geometry.shell import distance_to_bottom, distance_to_top, horizon_cosine
from airlight.image.display import to_display
from airlight.image.spectral import rgb_weights
from airlight.image.tone_maps import tone_map_named
from airlight.image.xyz import luminance
from airlight.kernel import vectorized
from airlight.kernel.threads import Cancel, Progress
from airlight.solver.lines_of_sight import LinesOfSight
from airlight.solver.solution import Solution
from airlight.studies.plots.figure import new_figure, wavelength_words

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FloatArray = NDArray[np.float64]

#: Number of heights, view directions and sun directions.
SHAPE: Final = (32, 64, 32)
#: Tiles per row of the atlas.
COLUMNS: Final = 8
#: Texels per call of the solution.
_BLOCK: Final = 8192
_TONE_MAP: Final = "hable"
#: Linear value of light grey, relative to the display's white. [1]
_LIGHT_GREY: Final = 0.4


def table_lines(
    solution: Solution,
    mapping: Literal["linear", "weighted-power"],
    shape: tuple[int, int, int] = SHAPE,
    azimuth: float = 0.0,
) -> LinesOfSight:
    """Lines of sight at the texels of a 3-D table over (h, cos φ, cos δ), without the ground.

    Parameters
    ----------
    solution : Solution
        Solution of the planet whose shell is used.
    mapping : "linear" or "weighted-power"
        Name of the mapping; the latter with power 2 throughout and the notes' weights.
    shape : (int, int, int)
        Number of heights, view directions and sun directions.
    azimuth : float
        Azimuth between view and sun. [deg]

    Returns
    -------
    LinesOfSight
        Flat arrays, the sun direction slowest and the height fastest; no line ends on the ground,
        for path radiance only.
    """
    width, height, depth = shape
    bottom, top = solution.medium.bottom_radius, solution.medium.top_radius
    exponent = weighted_power.DEFAULT_POWER
    r = np.empty(width)
    mu = np.empty((height, width))
    to_ground = np.empty((height, width), dtype=bool)
    for x in range(width):
        u = index_coordinate(x, width)
        if mapping == "linear":
            r[x] = bottom + linear.altitude_from_coordinate(u, top - bottom)
        else:
            r[x] = bottom + power.altitude_from_coordinate(u, top - bottom, exponent)
        r[x] = min(r[x], top)
        horizon = horizon_cosine(r[x], bottom)
        lower = weighted_power.lower_weight(u, weighted_power.DEFAULT_LOWER_WEIGHT)
        surface = weighted_power.surface_weight(
            u, weighted_power.DEFAULT_SURFACE_SLOPE, weighted_power.DEFAULT_SURFACE_OFFSET
        )
        for y in range(height):
            v = index_coordinate(y, height)
            if mapping == "linear":
                mu[y, x] = linear.cosine_from_coordinate(v)
                to_ground[y, x] = mu[y, x] < horizon
            else:
                mu[y, x], to_ground[y, x] = weighted_power.view_from_coordinate(
                    v, horizon, exponent, exponent, exponent, lower, surface
                )
    w = np.array([index_coordinate(z, depth) for z in range(depth)])
    mu_s = (
        vectorized(linear.cosine_from_coordinate)(w)
        if mapping == "linear"
        else vectorized(power.cosine_from_coordinate)(w, exponent)
    )
    length = np.where(
        to_ground,
        vectorized(distance_to_bottom)(r[None, :] + 0.0 * mu, mu, bottom),
        vectorized(distance_to_top)(r[None, :] + 0.0 * mu, mu, top),
    )
    full = (depth, height, width)
    sine = np.sqrt((1.0 - mu) * (1.0 + mu)) * np.sqrt(1.0 - mu_s**2)[:, None, None]
    nu = mu * mu_s[:, None, None] + sine * np.cos(np.radians(azimuth))

    def flat(values: FloatArray) -> FloatArray:
        return np.ascontiguousarray(np.broadcast_to(values, full)).ravel()

    return LinesOfSight(
        r=flat(r[None, None, :]),
        mu=flat(mu[None]),
        mu_s=flat(mu_s[:, None, None]),
        nu=flat(np.clip(nu, -1.0, 1.0)),
        length=flat(length[None]),
        to_ground=np.zeros(width * height * depth, dtype=bool),
    )


def table_rgb(
    solution: Solution,
    lines: LinesOfSight,
    shape: tuple[int, int, int],
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> FloatArray:
    """Linear sRGB of path radiance, shape (depth, height, width, 3). [W m⁻² sr⁻¹]"""
    light = solution.lights[0]
    irradiance = light.irradiance
    weights = rgb_weights(solution.wavelengths, light.spectrum)
    rgb = np.empty((lines.r.size, 3))
    for first in range(0, lines.r.size, _BLOCK):
        if cancel is not None and cancel():
            raise Cancelled("mapping comparison")
        rows = slice(first, first + _BLOCK)
        block = LinesOfSight(*(getattr(lines, one.name)[rows] for one in fields(lines)))
        rgb[rows] = (solution.relative_radiance(block) * irradiance) @ weights
        if progress is not None:
            progress(min(first + _BLOCK, lines.r.size), lines.r.size, "radiance of the table")
    return rgb.reshape(*shape[::-1], 3)


def atlas(tiles: NDArray, columns: int = COLUMNS) -> NDArray:
    """Atlas of tiles in rows, the first at the upper left.

    Parameters
    ----------
    tiles : array, shape (count, height, width, 3)
        Tiles, the first row of each being the lowest.
    columns : int
        Tiles per row.

    Returns
    -------
    array, shape (rows·height, columns·width, 3)
        Picture with the first row on top; 0 for missing tiles.
    """
    count, height, width, channels = tiles.shape
    rows = -(-count // columns)
    picture = np.zeros((rows, height, columns, width, channels), dtype=tiles.dtype)
    for index, tile in enumerate(tiles):
        picture[index // columns, :, index % columns] = tile[::-1]
    return picture.reshape(rows * height, columns * width, channels)


def _exposure(rgb: FloatArray) -> float:
    """Exposure at which 90 % of the texels are darker than light grey. [EV]"""
    bright = float(np.percentile(luminance(rgb), 90.0))
    if not bright > 0.0:
        return 0.0
    target = float(luminance(tone_map_named(_TONE_MAP).inverse(np.full(3, _LIGHT_GREY))))
    return float(np.clip(np.log2(target / bright), -100.0, 100.0))


def mapping_comparison(
    solution: Solution,
    *,
    shape: tuple[int, int, int] = SHAPE,
    azimuth: float = 0.0,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Figure:
    """Scattering table on the linear and on the weighted power mapping.

    Parameters
    ----------
    solution : Solution
        Solution of the planet.

    Returns
    -------
    Figure
        Two atlases with one exposure. A tile is one sun direction, from the nadir to the zenith;
        within it, the height increases to the right and the view turns upwards.

    References
    ----------
    Atmosphere Plus notes 2, section 3.1.6.
    """
    name = solution.planet.name if solution.planet is not None else "planet"
    colors = {
        mapping: table_rgb(
            solution, table_lines(solution, mapping, shape, azimuth), shape, progress, cancel
        )
        for mapping in ("linear", "weighted-power")
    }
    exposure = _exposure(np.concatenate([one.reshape(-1, 3) for one in colors.values()]))
    figure = new_figure(
        f"{name}: scattered light on two mappings",
        f"{shape[0]} × {shape[1]} × {shape[2]} texels, azimuth {azimuth:g}°, "
        f"{wavelength_words(solution.wavelengths)}, exposure {exposure:+.2f} EV, {_TONE_MAP}.\n"
        "A tile is one sun direction δ; in it altitude grows to the right, the view turns upwards.",
        size=(8.0, 5.6),
    )
    width, height, depth = shape
    for axes, (mapping, rgb) in zip(figure.subplots(1, 2), colors.items(), strict=True):
        shown = to_display(rgb.reshape(depth * height, width, 3), exposure, _TONE_MAP)
        picture = atlas(shown.reshape(depth, height, width, 3))
        rows, columns = picture.shape[0] // height, picture.shape[1] // width
        axes.imshow(
            picture, extent=(0.0, columns, rows, 0.0), aspect="auto", interpolation="nearest"
        )
        for edge in range(1, columns):
            axes.axvline(edge, color="white", linewidth=0.5)
        for edge in range(1, rows):
            axes.axhline(edge, color="white", linewidth=0.5)
        lines = table_lines(solution, mapping, (1, 2, depth), azimuth)  # type: ignore[arg-type]
        zeniths = np.degrees(np.arccos(np.clip(lines.mu_s.reshape(depth, -1)[:, 0], -1.0, 1.0)))
        for index, zenith in enumerate(zeniths):
            axes.text(
                index % columns + 0.96, index // columns + 0.97, f"{zenith:.0f}°",
                color="white", fontsize=7, ha="right", va="bottom",
                bbox={"boxstyle": "square,pad=0.1", "fc": "black", "ec": "none", "alpha": 0.5},
            )  # fmt: skip
        axes.set_title(mapping.replace("-", " "), fontsize=10)
        axes.set(
            xticks=[],
            yticks=[],
            xlabel="in each tile: altitude coordinate u [1], 0 to 1",
            ylabel="in each tile: view coordinate v [1], 0 to 1",
        )
    return figure
