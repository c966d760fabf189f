"""Data of the browser viewer: shaders, pass plan, tables.

The plan and the shaders are the same for every planet; tables and uniforms belong to a solution.
The names are those of ``gpu.picture.uniforms`` and ``gpu.picture.shaders``; the data are read by
``web/drawing/picture.js``.
"""

from __future__ import annotations

import base64
import io
from functools import lru_cache
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.image.display_settings import DisplaySettings
from airlight.image.gamut import PRIMARIES
from airlight.image.sky_magnitude import DARK
from airlight.image.texels import DECODED
from airlight.image.white_balance import WHITE_BALANCES, star_white
from airlight.image.xyz import rgb_to_xyz
from airlight.physics.constants import LUMINOUS_EFFICACY
from airlight.render.gpu.device.flat import FORMATS
from airlight.render.gpu.emit.shader_types import FLAT_WIDTH
from airlight.render.gpu.emit.wgsl import WGSL
from airlight.render.gpu.picture.display_shaders import (
    added_shader,
    coarser_shader,
    display_shader,
    spread_shader,
)
from airlight.render.gpu.picture.gpu_renderer import (
    MEDIUM_SKY_VIEW_SIZE,
    QUICK_SKY_VIEW_SIZE,
    SKY_VIEW_SIZE,
)
from airlight.render.gpu.picture.shaders import (
    Shader,
    picture_shader,
    sky_air_shader,
    sky_mirrored_shader,
    sky_peaks_shader,
    sky_polarised_shader,
)
from airlight.render.gpu.picture.solution_textures import SolutionTables
from airlight.render.gpu.picture.uniforms import FRAME, LAYERS, weight_uniforms
from airlight.render.pixels.render_tables import WAVELENGTHS
from airlight.render.pixels.view_uniforms import ORDERS, display_uniforms, overlay_uniforms
from airlight.scene.ground_overlay import ground_overlay
from airlight.scene.map_levels import reduced
from airlight.scene.metering import FILTER, METERED
from airlight.scene.moon_light import MoonLight
from airlight.scene.projections import PROJECTIONS
from airlight.scene.star_light import StarLight
from airlight.scene.surface_map import SurfaceMap, surface_map
from airlight.solver.moments.solution import MomentsSolution
from airlight.viewer.browser.web_shaders import CORNERS, scene_shaders, web_shaders
from airlight.viewer.navigation.viewpoints import as_json as viewpoints
from airlight.viewer.parameters.view_parameters import VIEW_VALUES

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

_FORMAT: Final = FORMATS[4]
#: Number of levels of glare's pyramid: those of the largest canvas, 8192 pixels.
LEVELS: Final = 12
#: Widest map that is embedded; a wider one is reduced to this width. [pixel]
_WIDEST: Final = 2048
#: Largest width of a water fraction: coasts of 2048 texels are off by 10 km. [pixel]
_WIDEST_WATER: Final = 4096
#: Quality of the JPEG of a ground map, and of that of clouds, which have noise of their own.
_QUALITY: Final = 90
_CLOUD_QUALITY: Final = 75
#: Temperatures, even in their reciprocal, in which the logarithm of a black body's light is almost
#: straight; they span those of the view's control. [K]
TEMPERATURES: Final = tuple((1.0 / np.linspace(1.0 / 1500.0, 1.0 / 40000.0, 25)).tolist())
#: Digits that are kept.
_DIGITS: Final = 6
#: Number of altitudes at which the optical radius is tabulated.
_RADII: Final = 1024


def plan(marched: bool = False, layers: tuple[str, ...] = ()) -> dict[str, Any]:
    """Rendering and display passes, and offset of each uniform; see ``web/drawing/program.js``.

    Parameters
    ----------
    marched, layers :
        Arguments of ``web_shaders``.
    """
    columns, rows = SKY_VIEW_SIZE
    where = FRAME.layout()
    places = {name: [start, 1] for name, start in where["numbers"].items()}
    places |= {f"table_{name}": [start, 4] for name, start in where["tables"].items()}
    height = 3 * columns * rows // FLAT_WIDTH
    sky = {"format": _FORMAT, "width": FLAT_WIDTH, "height": height}
    metering = {"name": "metering", "format": _FORMAT, "width": METERED, "height": METERED}

    def resized(name: str) -> list[dict[str, Any]]:
        return [{"name": name, "format": _FORMAT, "width": 1, "height": 1}]

    def second_layer(name: str) -> dict[str, Any]:
        return resized(f"{name}_2")[0]

    def one(
        name: str,
        shader: Shader,
        entry: str,
        targets: list[dict[str, Any]],
        of: str = "",
        **reads: str,
    ) -> dict[str, Any]:
        return {
            "name": name,
            "shader": of or shader.name,
            "vertex": CORNERS,
            "entry": entry,
            "uniforms": "0/0",
            "reads": {
                f"0/{i + 1}": reads.get(texture, texture)
                for i, texture in enumerate(shader.textures)
            },
            "targets": targets,
        }

    picture = picture_shader(marched, (), marched)
    own = {"disc": "disc_2", **{name: f"{name}_2" for name in LAYERS}}

    def summed(name: str) -> list[dict[str, Any]]:
        """Passes of two lights and their sum."""
        parts = [f"{name}_1", f"{name}_2"]
        return [
            one(parts[0], picture, "linear_picture", resized(parts[0])),
            one(parts[1], picture, "linear_picture", resized(parts[1]), **own),
            one(
                f"{name}_sum",
                added_shader(),
                "added",
                resized(name),
                picture=parts[0],
                level=parts[1],
            ),
        ]

    def layered() -> list[dict[str, Any]]:
        """Passes of layers, whose textures are given when they run."""
        shaders = scene_shaders(WGSL)
        return [
            one(
                name,
                shaders[name],
                next(iter(shaders[name].entries)),
                resized(f"layer_{name}"),
                name,
            )
            for name in layers
        ]

    return {
        "layout": places,
        "size": where["floats"],
        "passes": [
            one("sky_air", sky_air_shader(), "sky_air", [{**sky, "name": n} for n in LAYERS[:2]]),
            one(
                "sky_peaks",
                sky_peaks_shader(),
                "sky_peaks",
                [{**sky, "name": n} for n in LAYERS[2:4]],
            ),
            one(
                "sky_polarised",
                sky_polarised_shader(),
                "sky_polarised",
                [{**sky, "name": n} for n in LAYERS[4:6]],
            ),
            one(
                "sky_mirrored",
                sky_mirrored_shader(),
                "sky_mirrored",
                [{**sky, "name": n} for n in LAYERS[6:]],
            ),
            one("sky_air_2", sky_air_shader(), "sky_air", [*map(second_layer, LAYERS[:2])]),
            one("sky_peaks_2", sky_peaks_shader(), "sky_peaks", [*map(second_layer, LAYERS[2:4])]),
            one(
                "sky_polarised_2",
                sky_polarised_shader(),
                "sky_polarised",
                [*map(second_layer, LAYERS[4:6])],
            ),
            one(
                "sky_mirrored_2",
                sky_mirrored_shader(),
                "sky_mirrored",
                [*map(second_layer, LAYERS[6:])],
                air="air_2",
            ),
            one("metering", picture, "linear_picture", [metering]),
            one("picture", picture, "linear_picture", resized("picture")),
            *summed("metering"),
            *summed("picture"),
            *(
                one(
                    f"coarser_{k}",
                    coarser_shader(),
                    "coarser",
                    resized(f"level_{k}"),
                    level=f"level_{k - 1}" if k > 1 else "picture",
                )
                for k in range(1, LEVELS + 1)
            ),
            *(
                one(
                    f"spread_{k}",
                    spread_shader(),
                    "spread",
                    resized(f"spread_{k}"),
                    level=f"level_{k}",
                    coarser=f"spread_{k + 1}" if k < LEVELS else f"level_{k}",
                )
                for k in range(1, LEVELS + 1)
            ),
            one("display", display_shader(), "shown_picture", [], coarser="spread_1"),
            *layered(),
        ],
    }


def program(marched: bool = False, layers: tuple[str, ...] = ()) -> dict[str, Any]:
    """Data for all solutions, as JSON values.

    Parameters
    ----------
    marched, layers :
        Arguments of ``web_shaders``; if not ``marched``, rings have no shadow, and planets are
        spheres.
    """
    return {
        "plan": plan(marched, layers),
        "shaders": web_shaders(marched, layers),
        "marched": marched,
        "sky": {
            "full": list(SKY_VIEW_SIZE),
            "medium": list(MEDIUM_SKY_VIEW_SIZE),
            "quick": list(QUICK_SKY_VIEW_SIZE),
        },
        "layers": list(LAYERS),
        "metering": METERED,
        "filter_exposure": FILTER,
        "projections": {
            name: list(form.field_of_view_limits) for name, form in PROJECTIONS.items()
        },
        "display": display_uniforms(0.0, DisplaySettings()),
        "primaries": list(PRIMARIES),
        "white_balances": list(WHITE_BALANCES),
        "orders": ORDERS,
        "view_uniforms": {
            one.uniform: {"path": one.path, "options": list(one.options)}
            for one in VIEW_VALUES
            if one.uniform
        },
        "xyz": [[float(x) for x in row] for row in rgb_to_xyz(np.eye(3))],
        "efficacy": LUMINOUS_EFFICACY,
        "dark": DARK,
    }


def solution_package(
    solution: MomentsSolution, weights: FloatArray | None = None
) -> tuple[dict[str, Any], dict[str, tuple[str, Float32Array]]]:
    """Data of a solution for the browser.

    Parameters
    ----------
    solution : MomentsSolution
        Solution at three or four wavelengths.
    weights : array, shape (nl, 3), optional
        Linear sRGB per radiance; by default ``picture_weights``.

    Returns
    -------
    numbers : dict
        JSON values: ``uniforms`` by name, ``radius`` of the ground and ``thickness`` of the shell
        [m], ``flattening``, ``star`` (angular radius [rad]), ``star_white`` (its chromaticity),
        ``geometry`` of refracted rays, the ``ground`` map, the ``body`` of the planet, data of a
        ``second`` light, and ``viewpoints``.
    tables : dict
        Format and values of each texture.
    """
    made = SolutionTables.of(solution, weights=weights)
    medium = solution.medium
    uniforms: dict[str, Any] = dict(made.uniforms)
    for name, place in made.places.items():
        uniforms[f"table_{name}"] = [*place, 0, 0, 0][:4]
    star, picture = solution.lights[0], medium.surface.picture
    uniforms |= overlay_uniforms(solution, weights) | weight_uniforms(star.colors(weights))
    numbers = {
        "uniforms": uniforms,
        "radius": float(medium.bottom_radius),
        "thickness": float(medium.thickness),
        "flattening": float(medium.flattening),
        "star": float(star.angular_radius),
        "star_white": star_white(star.spectrum),
        "geometry": refracted_geometry(solution),
        "ground": ground_map(None if picture is None else surface_map(picture)),
        "body": None if solution.planet is None else solution.planet.body,
        "second": second_light_data(solution),
        "overlay": ground_map(ground_overlay(*medium.surface.overlay), overlay=True),
        "viewpoints": viewpoints(medium.bottom_radius, medium.top_radius),
    }
    tables = {name: (FORMATS[values.shape[1]], values) for name, values in made.textures.items()}
    return numbers, tables


def refracted_geometry(solution: MomentsSolution) -> dict[str, Any] | None:
    """Optical radii [m] and refraction table of an atmosphere; None without refraction."""
    geometry, medium = solution.geometry, solution.medium
    if geometry.shell is None:
        return None
    altitudes = np.linspace(0.0, medium.thickness, _RADII)
    true = medium.bottom_radius + altitudes
    return {
        "excess": [float(f"{x:.9g}") for x in geometry.optical_radius(true) - true],
        "bottom": float(geometry.shell.bottom),
        "top": float(geometry.shell.top),
        "refraction_table": {
            "values": [float(f"{x:.7f}") for x in geometry.refraction_table[:, :, 0].ravel()],
            "shape": [*geometry.refraction_table.shape[:2], 1],
        },
    }


def second_light_data(solution: MomentsSolution) -> dict[str, Any]:
    """Data of a second light for ``web/drawing/lights.js``, per squared sine of its radius.

    Parameters
    ----------
    solution : MomentsSolution
        Solution at three or four wavelengths.

    Returns
    -------
    dict
        ``irradiance`` of the planet's own star [W m⁻² nm⁻¹], shape (nl,); ``moon``: albedo,
        shape (nl,), and weights to linear sRGB, shape (3·nl,); ``stars``, by temperature:
        ``temperature`` [K], logarithm of the irradiance, weights, and darkening, shape (6·4,).
    """
    own = solution.lights
    full = MoonLight(zenith=0.0, angular_radius=30.0).source(own)
    stars = []
    for temperature in TEMPERATURES:
        light = StarLight(zenith=0.0, star=StarLight.black_body(temperature, 30.0)).source(own)
        law = np.zeros((light.darkenings.shape[1], WAVELENGTHS))
        law[:, : light.wavelengths.size] = light.darkenings.T
        stars.append(
            {
                "temperature": temperature,
                "irradiance": _short(np.log(4.0 * light.irradiance)),
                "weights": _short(light.colors() / light.irradiance[:, None]),
                "darkening": _short(law),
            }
        )
    return {
        "irradiance": _short(own[0].irradiance),
        "moon": {
            "albedo": _short(4.0 * full.irradiance / own[0].irradiance),
            "weights": _short(full.colors() / full.irradiance[:, None]),
        },
        "stars": stars,
    }


def _short(values: FloatArray) -> list[float]:
    return [float(f"{x:.{_DIGITS}g}") for x in values.ravel()]


@lru_cache(maxsize=4)
def ground_map(found: SurfaceMap | None, *, overlay: bool = False) -> dict[str, Any] | None:
    """Ground map, or overlay, for ``web/drawing/ground.js``.

    Parameters
    ----------
    overlay : bool
        Whether it is an overlay, whose colours are compressed without loss: artefacts of city
        lights would brighten a dark sea. Clouds have no such edges.

    Returns
    -------
    dict or None
        ``image``, a data URL; ``water``, a data URL of the water fraction or cloud cover, or None;
        ``rows`` and ``columns`` of the finer of both, to which the other is magnified;
        ``decoded``, linear values of the 256 encoded values [1]. None without a map.
    """
    if found is None:
        return None
    colors = _within(found.levels[0], _WIDEST)[..., :3]
    shares = _within(found.levels[0], _WIDEST if overlay else _WIDEST_WATER)[..., 3]
    wet = bool(shares.any())
    rows, columns = shares.shape if wet else colors.shape[:2]
    if overlay and not colors[..., 1:].any():  # no shader reads the empty channels
        colors = colors[..., 0]
    return {
        "image": lossless(colors) if overlay else as_jpeg(colors, _QUALITY),
        "water": (as_jpeg(shares, _CLOUD_QUALITY) if overlay else lossless(shares))
        if wet
        else None,
        "rows": rows,
        "columns": columns,
        "decoded": [float(x) for x in DECODED[0]],
    }


def _within(texels: NDArray[np.uint8], widest: int) -> NDArray[np.uint8]:
    """Texels with at most some columns."""
    return texels if texels.shape[1] <= widest else reduced(texels, widest // 2, widest)


def lossless(pixels: NDArray[np.uint8]) -> str:
    """Data URL of a lossless WebP."""
    from PIL import Image

    room = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(pixels)).save(room, "WEBP", lossless=True, quality=60)
    return _as_address("webp", room.getvalue())


def as_jpeg(pixels: NDArray[np.uint8], quality: int) -> str:
    """Data URL of a JPEG without subsampling of colours: coasts would lose their water's."""
    from PIL import Image

    room = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(pixels)).save(
        room, "JPEG", quality=quality, subsampling=0, optimize=True
    )
    return _as_address("jpeg", room.getvalue())


def _as_address(kind: str, content: bytes) -> str:
    return f"data:image/{kind};base64,{base64.b64encode(content).decode('ascii')}"
