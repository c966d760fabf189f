"""Data of the browser viewer: shaders, pass plan, tables.

The plan and the shaders are the same for every planet; tables and uniforms belong to a solution.
The names are those of ``gpu.picture.uniforms`` and ``gpu.picture.shaders``; the data are read by
``web/drawing/picture.js``.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.image.display import DEFAULT_TONE_MAP
from airlight.image.gamut import PRIMARIES
from airlight.image.xyz import rgb_to_xyz
from airlight.physics.constants import LUMINOUS_EFFICACY
from airlight.render.gpu.device.flat import FORMATS
from airlight.render.gpu.emit.shader_types import FLAT_WIDTH
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
    sky_peaks_shader,
    sky_polarised_shader,
)
from airlight.render.gpu.picture.solution_textures import SolutionTables
from airlight.render.gpu.picture.uniforms import FRAME, LAYERS
from airlight.render.pixels.render_tables import WAVELENGTHS
from airlight.render.pixels.view_uniforms import ORDERS, display_uniforms, overlay_uniforms
from airlight.scene.ground_overlay import ground_overlay
from airlight.scene.metering import METERED
from airlight.scene.projections import PROJECTIONS
from airlight.scene.surface_map import surface_map
from airlight.solver.moments.solution import MomentsSolution
from airlight.viewer.browser.ground_map import ground_map
from airlight.viewer.browser.second_light_data import second_light_data
from airlight.viewer.browser.web_shaders import CORNERS, web_shaders
from airlight.viewer.navigation.viewpoints import as_json as viewpoints
from airlight.viewer.parameters.view_parameters import VIEW_VALUES

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

_FORMAT: Final = FORMATS[4]
#: Number of levels of glare's pyramid: those of the largest canvas, 8192 pixels.
LEVELS: Final = 12
#: Number of altitudes at which the optical radius is tabulated.
_RADII: Final = 1024


def plan() -> dict[str, Any]:
    """Rendering and display passes, and offset of each uniform; see ``web/drawing/program.js``."""
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
        name: str, shader: Shader, entry: str, targets: list[dict[str, Any]], **reads: str
    ) -> dict[str, Any]:
        return {
            "name": name,
            "shader": shader.name,
            "vertex": CORNERS,
            "entry": entry,
            "uniforms": "0/0",
            "reads": {
                f"0/{i + 1}": reads.get(texture, texture)
                for i, texture in enumerate(shader.textures)
            },
            "targets": targets,
        }

    picture = picture_shader(False)
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
                [{**sky, "name": n} for n in LAYERS[4:]],
            ),
            one("sky_air_2", sky_air_shader(), "sky_air", [*map(second_layer, LAYERS[:2])]),
            one("sky_peaks_2", sky_peaks_shader(), "sky_peaks", [*map(second_layer, LAYERS[2:4])]),
            one(
                "sky_polarised_2",
                sky_polarised_shader(),
                "sky_polarised",
                [*map(second_layer, LAYERS[4:])],
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
        ],
    }


def program() -> dict[str, Any]:
    """Planet-independent data, as JSON values."""
    return {
        "plan": plan(),
        "shaders": web_shaders(),
        "sky": {
            "full": list(SKY_VIEW_SIZE),
            "medium": list(MEDIUM_SKY_VIEW_SIZE),
            "quick": list(QUICK_SKY_VIEW_SIZE),
        },
        "layers": list(LAYERS),
        "metering": METERED,
        "projections": {
            name: list(form.field_of_view_limits) for name, form in PROJECTIONS.items()
        },
        "display": display_uniforms(0.0, DEFAULT_TONE_MAP, "srgb"),
        "primaries": list(PRIMARIES),
        "orders": ORDERS,
        "view_uniforms": {
            one.uniform: {"path": one.path, "options": list(one.options)}
            for one in VIEW_VALUES
            if one.uniform
        },
        "xyz": [[float(x) for x in row] for row in rgb_to_xyz(np.eye(3))],
        "efficacy": LUMINOUS_EFFICACY,
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
        [m], ``star`` (angular radius [rad]), ``geometry`` of refracted rays, the ``ground`` map,
        the ``body`` of the planet, data of a ``second`` light, and ``viewpoints``.
    tables : dict
        Format and values of each texture.
    """
    made = SolutionTables.of(solution)
    medium = solution.medium
    uniforms: dict[str, Any] = dict(made.uniforms)
    for name, place in made.places.items():
        uniforms[f"table_{name}"] = [*place, 0, 0, 0][:4]
    uniforms |= overlay_uniforms(solution)
    star, mapped = solution.lights[0], medium.surface.map
    shown = np.zeros((WAVELENGTHS, 3))
    shown[: solution.wavelengths.size] = star.colors(weights)
    for channel, column in zip(("red", "green", "blue"), shown.T, strict=True):
        uniforms |= {f"{channel}_{i}": float(value) for i, value in enumerate(column)}
    numbers = {
        "uniforms": uniforms,
        "radius": float(medium.bottom_radius),
        "thickness": float(medium.thickness),
        "star": float(star.angular_radius),
        "geometry": refracted_geometry(solution),
        "ground": ground_map(None if mapped is None else surface_map(mapped)),
        "body": None if solution.planet is None else solution.planet.body,
        "second": second_light_data(solution),
        "overlay": ground_map(
            ground_overlay(medium.surface.lights, medium.surface.clouds), lossless=True
        ),
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
            "values": [float(f"{x:.7g}") for x in geometry.refraction_table[:, :, 0].ravel()],
            "shape": [*geometry.refraction_table.shape[:2], 1],
        },
    }
