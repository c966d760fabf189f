"""Layout ``bruneton-demo``: folder for the WebGL demo of Bruneton's 2017 implementation.

``demo.js`` loads three ``.dat`` files, RGBA floats, row 0 at texture coordinate 0, and three
shaders, which contain the planet's constants and the functions and uniforms of the demo. Alpha
holds the red channel of single Mie scattering.

Source: E. Bruneton, *Precomputed Atmospheric Scattering: a New Implementation* (2017), files
atmosphere/demo/webgl/demo.js and precompute.cc, atmosphere/constants.h, commit d995492.
"""

from __future__ import annotations

import json
from dataclasses import replace
from importlib import resources
from math import log
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.engines.targets.bruneton_tables import (
    WAVELENGTHS,
    SkyTables,
    check_halves,
    check_lowest_sun,
    fill_tables,
    tables_of,
    textures_of,
)
from airlight.engines.targets.fits.sky_colour import SkyColour, fit_sky_colour
from airlight.engines.targets.sky_errors import table_errors
from airlight.engines.targets.target import ExportReport, Target
from airlight.errors import FileError
from airlight.files.input_files import LARGEST_MAP, read_bytes, read_text
from airlight.kernel.threads import Progress
from airlight.solver.solution import Solution
from airlight.solver.tables.bruneton import BrunetonLayout

#: Green irradiance of the Earth's sun for which the demo's exposure is chosen. [W m⁻² nm⁻¹]
_EARTH: Final = 1.85
#: Factor of the demo's keys ``+`` and ``-``.
_KEY: Final = 1.1
_PLANET: Final = "planet.json"
_SHADERS: Final = ("atmosphere", "vertex", "fragment")


def fill(
    solution: Solution,
    folder: Path,
    *,
    progress: Progress | None = None,
    lowest_sun: float | None = None,
) -> ExportReport:
    """Write the files.

    Parameters
    ----------
    solution : Solution
        Solution at 680, 550 and 440 nm.
    lowest_sun : float, optional
        Largest solar zenith angle of the tables; default: the end of twilight. [deg]
    """
    check_lowest_sun(lowest_sun)
    filled = fill_tables(solution, combined=True, lowest_sun=lowest_sun, progress=progress)
    tables = filled.tables
    textures = textures_of(tables)
    check_halves(textures)
    for name, values in textures.items():
        (folder / f"{name}.dat").write_bytes(np.ascontiguousarray(values, "<f4").tobytes())
    colour = fit_sky_colour(solution)
    constants = _constants(solution, tables, colour)
    for name, text in shaders(constants).items():
        (folder / name).write_text(text, encoding="utf-8")
    text = json.dumps(constants, indent=2, allow_nan=False) + "\n"
    (folder / _PLANET).write_text(text, encoding="utf-8")
    errors = table_errors(solution, read_tables(folder))
    presses = round(log(_EARTH / solution.medium.lights[0].irradiance[1]) / log(_KEY))
    notes = ["ground without relief, of one albedo; the demo's sphere is not drawn"]
    if presses > 0:
        notes.append(
            f"the demo's exposures are the Earth's: {presses} times + makes up for a dimmer star"
        )
    return ExportReport(
        fitted=(*filled.lobe.fitted, *colour.fitted),
        errors=errors,
        notes=tuple(notes),
        about={"planet_constants": constants},
    )


def _constants(solution: Solution, tables: SkyTables, colour: SkyColour) -> dict[str, Any]:
    """Constants of the atmosphere's shader; lengths in km."""
    medium = solution.medium
    green = colour.sun[1]
    return {
        "BOTTOM_RADIUS": 1e-3 * medium.bottom_radius,
        "TOP_RADIUS": 1e-3 * medium.top_radius,
        "SOLAR_IRRADIANCE": medium.lights[0].irradiance.tolist(),
        "SUN_ANGULAR_RADIUS": medium.lights[0].angular_radius,
        "MU_S_MIN": tables.layout.grid.lowest,
        "MIE_PHASE_FUNCTION_G": tables.g,
        "MIE_COLOURS": tables.mie_colours.tolist(),
        "GROUND_ALBEDO": np.clip(medium.ground_albedo, 0.0, 1.0).tolist(),
        "SKY_SPECTRAL_RADIANCE_TO_LUMINANCE": (colour.sky / green).tolist(),
        "SUN_SPECTRAL_RADIANCE_TO_LUMINANCE": (colour.sun / green).tolist(),
    }


def shaders(constants: dict[str, Any]) -> dict[str, str]:
    """Texts of the three shaders by file name.

    Parameters
    ----------
    constants : dict
        Numbers and lists of three by name.
    """
    lines = [
        f"const {'vec3' if isinstance(value, list) else 'float'} {name} = {_glsl(value)};"
        for name, value in constants.items()
    ]
    words = {
        "atmosphere": {"\nPLANET\n": "\n" + "\n".join(lines) + "\n"},
        "vertex": {},
        "fragment": {
            "= CENTER;": f"= {_glsl([0.0, 0.0, -constants['BOTTOM_RADIUS']])};",
            "= RADIUS;": f"= {_glsl(constants['BOTTOM_RADIUS'])};",
            "= SUN;": f"= {_glsl(constants['SUN_ANGULAR_RADIUS'])};",
            "= ALBEDO;": f"= {_glsl(constants['GROUND_ALBEDO'])};",
        },
    }
    made = {}
    for name in _SHADERS:
        file = resources.files("airlight.engines.targets").joinpath(f"bruneton_demo_{name}.glsl")
        text = file.read_text(encoding="utf-8")
        for word, number in words[name].items():
            text = text.replace(word, number)
        made[f"{name}_shader.txt"] = text
    return made


def _glsl(value: ArrayLike) -> str:
    if np.ndim(value):
        return f"vec3({', '.join(_glsl(one) for one in np.asarray(value).tolist())})"
    text = f"{float(np.asarray(value)):.9g}"
    return text if any(letter in text for letter in ".e") else f"{text}.0"


def read_constants(folder: str | Path) -> dict[str, Any]:
    """Constants of the shaders, as lists and numbers."""
    path = Path(folder) / _PLANET
    try:
        content: dict[str, Any] = json.loads(read_text(path))
        return content
    except (ValueError, RecursionError) as error:
        raise FileError(path, f"cannot be read: {error}") from error


def read_tables(folder: str | Path) -> SkyTables:
    """Tables of a folder, converted to half floats as in the demo.

    Parameters
    ----------
    folder : str or Path
        Folder written for layout ``bruneton-demo``.
    """
    path = Path(folder)
    said = read_constants(path)
    try:
        layout = BrunetonLayout(
            bottom_radius=1e3 * said["BOTTOM_RADIUS"],
            top_radius=1e3 * said["TOP_RADIUS"],
            mu_s_min=said["MU_S_MIN"],
        )
        tables = tables_of(
            lambda name: _read(path, name),
            layout,
            combined=True,
            g=said["MIE_PHASE_FUNCTION_G"],
            mie_colours=np.array(said["MIE_COLOURS"]),
        )
        scattering, irradiance = (_half(one) for one in (tables.scattering, tables.irradiance))
        return replace(tables, scattering=scattering, irradiance=irradiance)
    except (FileError, ValueError, KeyError, TypeError) as error:
        raise FileError(path, f"is not a folder of layout bruneton-demo: {error}") from error


def _read(folder: Path, name: str) -> NDArray[Any]:
    return np.frombuffer(read_bytes(folder / f"{name}.dat", LARGEST_MAP), "<f4").astype(np.float32)


def _half(values: NDArray[Any]) -> NDArray[Any]:
    return np.ascontiguousarray(values.astype(np.float16).astype(np.float32))


TARGET: Final = Target(
    name="bruneton-demo",
    program="the WebGL demo of precomputed_atmospheric_scattering",
    version="d995492",
    fill=fill,
    files=("*.dat", "*.txt", _PLANET),
    wavelengths=WAVELENGTHS,
    options=("lowest_sun",),
)
