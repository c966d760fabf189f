"""Layout ``takram``: folder for ``PrecomputedTexturesLoader`` of npm @takram/three-atmosphere.

Files ``.bin`` are RGBA half floats, row 0 at texture coordinate 0; ``.exr`` files are flipped
vertically, as three.js flips them on loading. Values include the solar irradiance: radiance is in W
m⁻² sr⁻¹ nm⁻¹. Parameters are in ``atmosphere.json``, applied by ``planet.js``.

Source: @takram/three-atmosphere 0.19.1, PrecomputedTexturesLoader.ts, AtmosphereParameters.ts,
shaders/bruneton/runtime.glsl.
"""

from __future__ import annotations

import json
import shutil
from importlib import resources
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.engines.targets.bruneton_tables import (
    WAVELENGTHS,
    Filled,
    SkyTables,
    check_halves,
    check_lowest_sun,
    coefficients,
    fill_tables,
    opaque,
    sliced,
    unsliced,
)
from airlight.engines.targets.fits.sky_colour import SkyColour, fit_sky_colour
from airlight.engines.targets.sky_errors import half_losses, level_errors, sky_errors
from airlight.engines.targets.target import ExportReport, Target
from airlight.errors import FileError, ParameterError
from airlight.files.input_files import LARGEST_MAP, read_bytes, read_text
from airlight.image.exr import write_exr_channels
from airlight.kernel.threads import Progress
from airlight.physics.constants import LUMINOUS_EFFICACY
from airlight.solver.solution import Solution
from airlight.solver.tables.bruneton import BrunetonLayout

#: Red of S below which the shader drops the particles of the combined texture.
_DARKEST: Final = 1e-5
_ATMOSPHERE: Final = "atmosphere.json"
_SCRIPT: Final = "planet.js"


def fill(
    solution: Solution,
    folder: Path,
    *,
    progress: Progress | None = None,
    mie: str = "separate",
    lowest_sun: float | None = None,
) -> ExportReport:
    """Write the files.

    Parameters
    ----------
    solution : Solution
        Solution at 680, 550 and 440 nm.
    mie : str
        ``separate``: single Mie scattering in a separate file, for ``combinedScattering: false``;
        ``combined``: only in alpha, the loader's default.
    lowest_sun : float, optional
        Largest solar zenith angle of the tables; default: the end of twilight. [deg]
    """
    if mie not in ("separate", "combined"):
        raise ParameterError("mie", mie, "separate, combined")
    check_lowest_sun(lowest_sun)
    filled = fill_tables(
        solution,
        combined=mie == "combined",
        lowest_sun=lowest_sun,
        darkest=_DARKEST,
        progress=progress,
    )
    textures = _textures(filled)
    for name, values in textures.items():
        _write(folder, name, values)
    colour = fit_sky_colour(solution)
    about = _parameters(solution, filled.tables, colour)
    text = json.dumps(about, indent=2, allow_nan=False) + "\n"
    (folder / _ATMOSPHERE).write_text(text, encoding="utf-8")
    script = resources.files("airlight.engines.targets").joinpath("takram.js")
    with resources.as_file(script) as source:
        shutil.copyfile(source, folder / _SCRIPT)
    tables = read_tables(folder)
    errors = sky_errors(solution, tables.radiance)
    errors += level_errors(solution, tables.irradiance_at, tables.transmittance_at)
    return ExportReport(
        fitted=(*filled.lobe.fitted, *colour.fitted),
        errors=tuple(errors),
        notes=(*half_losses(textures), *_notes(mie)),
        about={"mie": mie, "atmosphere": about},
    )


def _notes(mie: str) -> tuple[str, ...]:
    loaded = "false" if mie == "separate" else "true"
    script = (
        f"load with combinedScattering: {loaded}; {_SCRIPT} does, and sets what SkyMaterial does "
        "not take: the planet, its luminance factors and the sun's size"
    )
    return (
        script,
        "density profiles are left at the Earth's: only the program's own generator reads them",
    )


def _textures(filled: Filled) -> dict[str, NDArray[Any]]:
    """Values of each file, shape (rows, width, 4), with concatenated slices."""
    tables = filled.tables
    out = {
        "transmittance": opaque(tables.transmittance),
        "irradiance": opaque(tables.irradiance),
        "scattering": sliced(tables.scattering),
    }
    if tables.single_mie is not None:
        out["single_mie_scattering"] = sliced(opaque(tables.single_mie))
    higher = np.zeros((*filled.higher.shape[:-1], 4))
    higher[..., :3] = filled.higher
    out["higher_order_scattering"] = sliced(higher)
    check_halves(out)
    return out


def _write(folder: Path, name: str, values: NDArray[Any]) -> None:
    halves = np.ascontiguousarray(values.astype("<f2"))
    (folder / f"{name}.bin").write_bytes(halves.tobytes())
    flipped = halves[::-1].astype(np.float16)
    channels = {letter: flipped[..., k] for k, letter in enumerate("RGBA")}
    write_exr_channels(folder / f"{name}.exr", channels)


def _parameters(solution: Solution, tables: SkyTables, colour: SkyColour) -> dict[str, Any]:
    """Arguments of ``AtmosphereParameters``, and loading instructions."""
    medium = solution.medium
    molecules, particles, extinction = (1e3 * one for one in coefficients(medium))
    return {
        "solarIrradiance": medium.lights[0].irradiance.tolist(),
        "sunAngularRadius": medium.lights[0].angular_radius,
        "bottomRadius": medium.bottom_radius,
        "topRadius": medium.top_radius,
        "rayleighScattering": molecules.tolist(),
        # Its ratio to the molecules' restores the colours of the combined texture.
        "mieScattering": (tables.mie_colours * molecules * particles[0] / molecules[0]).tolist(),
        "mieExtinction": extinction.tolist(),
        "miePhaseFunctionG": tables.g,
        "groundAlbedo": np.clip(medium.ground_albedo, 0.0, 1.0).tolist(),
        "muSMin": tables.layout.grid.lowest,
        "skyRadianceToLuminance": (LUMINOUS_EFFICACY * colour.sky).tolist(),
        "sunRadianceToLuminance": (LUMINOUS_EFFICACY * colour.sun).tolist(),
        "combinedScattering": tables.single_mie is None,
    }


def read_tables(folder: str | Path) -> SkyTables:
    """Tables of a folder, as read by the program.

    Parameters
    ----------
    folder : str or Path
        Folder written for layout ``takram``.
    """
    path = Path(folder)
    try:
        about = json.loads(read_text(path / _ATMOSPHERE))
        layout = BrunetonLayout(
            bottom_radius=about["bottomRadius"],
            top_radius=about["topRadius"],
            mu_s_min=about["muSMin"],
        )
        combined = about["combinedScattering"]
        ratio = np.array(about["mieScattering"]) / np.array(about["rayleighScattering"])
        single = None
        if not combined:
            single = unsliced(_read(path, "single_mie_scattering"), layout)[..., :3].copy()
        return SkyTables(
            layout=layout,
            scattering=unsliced(_read(path, "scattering"), layout),
            single_mie=single,
            transmittance=_read(path, "transmittance").reshape(64, 256, 4)[..., :3].copy(),
            irradiance=_read(path, "irradiance").reshape(16, 64, 4)[..., :3].copy(),
            g=about["miePhaseFunctionG"],
            mie_colours=ratio / ratio[0],
            darkest=_DARKEST,
        )
    except (FileError, ValueError, KeyError, TypeError, RecursionError) as error:
        raise FileError(path, f"is not a folder of layout takram: {error}") from error


def _read(folder: Path, name: str) -> NDArray[Any]:
    return np.frombuffer(read_bytes(folder / f"{name}.bin", LARGEST_MAP), "<f2").astype(np.float32)


TARGET: Final = Target(
    name="takram",
    program="@takram/three-atmosphere",
    version="0.19.1",
    fill=fill,
    files=("*.bin", "*.exr", _ATMOSPHERE, _SCRIPT),
    wavelengths=WAVELENGTHS,
    options=("mie", "lowest_sun"),
)
