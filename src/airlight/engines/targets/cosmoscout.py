"""Layout ``cosmoscout``: textures for CosmoScout VR's Bruneton model, preprocessor inputs.

Phase functions are tables, without fits. Spectral radiance is converted to luminances of red, green
and blue, exact at the texels. Refraction is a table of refraction angles.
"""

from __future__ import annotations

import json
import math
from dataclasses import replace as changed
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.engines.baking.air_light import AirLight, lines_of_sight
from airlight.engines.baking.bake import Baked, bake
from airlight.engines.baking.table_errors import random_positions
from airlight.engines.baking.table_files import texture_size
from airlight.engines.targets.cosmoscout_inputs import SETTINGS, wavelengths_for, write_inputs
from airlight.engines.targets.cosmoscout_tables import (
    DEVIATION,
    ILLUMINANCE,
    METADATA,
    MULTIPLE,
    PHASE,
    SCENE,
    SINGLE,
    TRANSMITTANCE,
    CosmoScoutTables,
    require_tifffile,
    texel_angles,
    write_texture,
)
from airlight.engines.targets.fits.formula_planet import name_of
from airlight.engines.targets.target import ErrorRow, ExportReport, Target
from airlight.errors import ParameterError
from airlight.image.color_difference import color_difference
from airlight.image.spectral import rgb_weights, sun_color
from airlight.image.xyz import luminance
from airlight.kernel.threads import Progress
from airlight.planets import replace
from airlight.planets.medium import Medium
from airlight.solver import solve
from airlight.solver.moments.solution import MomentsSolution
from airlight.solver.solution import Solution
from airlight.solver.tables.columns import columns
from airlight.solver.tables.table import Table
from airlight.solver.tables.transmittance import TransmittanceLayout

if TYPE_CHECKING:
    from airlight.planets.planet import Planet

FloatArray = NDArray[np.float64]

#: Luminous efficacy of the maximum. [lm/W]
EFFICACY: Final = 683.0
#: Angles of the phase functions.
_ANGLES: Final = 4096
#: Smallest transmittance in a file: a quotient of two remains a single-precision number. [1]
_LEAST: Final = 1e-37
#: Number of points at which radiances are compared, and seed.
_POINTS: Final = 4096
_SEED: Final = 20250601
#: Luminance relative to the star's illuminance below which radiances are not compared. [sr⁻¹]
_DARK: Final = 1e-6
#: Number of points for the errors of the bake, which are not reported.
_FEW: Final = 16


def fill(
    solution: Solution,
    folder: Path,
    *,
    progress: Progress | None = None,
    size: tuple[int, ...] | None = None,
    lowest_sun: float | None = None,
) -> ExportReport:
    """Write textures, metadata, settings and inputs; see ``Target``.

    Parameters
    ----------
    size : tuple of int, optional
        Texels of r, mu, mu_s, nu; default: (32, 128, 32, 8).
    lowest_sun : float, optional
        Largest solar zenith angle of the tables; default: the end of twilight. [deg]
    """
    require_tifffile()
    planet = solution.planet
    if planet is None:
        raise ParameterError("planet", "missing", "a solution with its planet")
    straight = _straight(solution, planet, progress)
    baked = bake(
        straight,
        "bruneton",
        size=size,
        mu_s_min=None if lowest_sun is None else math.cos(math.radians(lowest_sun)),
        points=_FEW,
        progress=progress,
    )
    star = solution.lights[0]
    weights = EFFICACY * rgb_weights(solution.wavelengths, star.spectrum)
    weights = weights * star.irradiance[:, None]  # of radiance per irradiance of the star
    for name, values in _scattered(baked, weights).items():
        write_texture(folder / name, values)
    table = baked.light.tables["irradiance"]
    write_texture(folder / ILLUMINANCE, (_values(table) @ weights)[0])
    _write_paths(solution, weights, folder)
    bends = bool(solution.medium.refractivity.any())
    scattering = baked.light.tables["scattering"]
    lowest = float(scattering.layout.axes[2].parameters["lowest_mu_s"])
    metadata = {
        "sunAngularRadius": star.angular_radius,
        "sunIlluminance": (EFFICACY * sun_color(star.spectrum)).tolist(),
        "scatteringTextureNuSize": scattering.layout.shape[-1],
        "maxSunZenithAngle": math.acos(lowest),
        "refraction": bends,
    }
    _write_json(folder / METADATA, metadata)
    _write_json(folder / SCENE, _scene(planet))
    write_inputs(folder, Medium.from_planet(planet, wavelengths_for(planet)))
    notes = [
        f"the body's radius in the scene has to be {planet.bottom_radius:.10g} m",
        "the transmittance of sunlight is one number for each of red, green and blue",
    ]
    if bends:
        notes.append(
            "refraction moves what is seen through the air; the sky's own light is straight"
        )
    return ExportReport(errors=_errors(straight, CosmoScoutTables.read(folder)), notes=tuple(notes))


def _straight(solution: Solution, planet: Planet, progress: Progress | None) -> Solution:
    """Solution without refraction."""
    if not solution.medium.refractivity.any():
        return solution
    settings = solution.settings if isinstance(solution, MomentsSolution) else "default"
    return solve(
        replace(planet, refraction="none"), solution.wavelengths, settings, progress=progress
    )


def _scattered(baked: Baked, weights: FloatArray) -> dict[str, FloatArray]:
    """Textures of scattering and of phase functions.

    Luminance at the texels is exact. The phase function of a channel is the mean over wavelengths,
    weighted by their positive contributions to it.
    """
    light = baked.light
    smooth, *kinds = light.phases.names
    share = np.maximum(weights, 0.0)
    nu = np.cos(np.radians(texel_angles(_ANGLES)))
    members_of = {
        MULTIPLE: [(light.tables["scattering"], smooth)],
        SINGLE: [(light.tables[kind], kind) for kind in kinds],
    }
    shape = light.tables["scattering"].layout.shape
    axis = np.linspace(-1.0, 1.0, shape[-1])
    textures, rows = {}, []
    for name, members in members_of.items():
        total, mean = np.zeros((*shape, 3)), np.zeros((_ANGLES, 3))
        weight = np.zeros(3)
        for table, phase in members:
            values = table.values.astype(np.float64) * table.scale
            total += (values * light.phases.at(phase, axis)) @ weights
            parts = values.reshape(-1, values.shape[-1]).mean(axis=0)[:, None] * share
            mean += light.phases.at(phase, nu) @ parts
            weight += parts.sum(axis=0)
        row = mean / weight if weight.all() else np.full((_ANGLES, 3), 0.25 / np.pi)
        rows.append(row)
        on_axis = np.stack(
            [np.interp(np.degrees(np.arccos(axis)), texel_angles(_ANGLES), one) for one in row.T],
            axis=-1,
        )
        textures[name] = _texture(light.tables["scattering"], total / on_axis)
    textures[PHASE] = np.stack(rows)
    return textures


def _texture(table: Table, values: FloatArray) -> FloatArray:
    """Values over a table's axes as a texture, shape (depth, height, width, channels)."""
    width, height, depth = texture_size(table)
    names = [axis.name for axis in table.layout.axes]
    order = [names.index(name) for axis in reversed(table.layout.texture_axes) for name in axis]
    turned = np.transpose(values, [*order, len(names)])
    return np.asarray(turned.reshape(depth, height, width, -1))


def _values(table: Table) -> FloatArray:
    return _texture(table, np.asarray(table.values, np.float64) * table.scale)


def _write_paths(solution: Solution, weights: FloatArray, folder: Path) -> None:
    """Write transmittance to space and, with refraction, refraction angles and lowest altitudes.

    The transmittance of a channel is the mean over wavelengths, weighted by their positive
    contributions to the star's colour, and thus between 0 and 1.
    """
    medium, geometry = solution.medium, solution.geometry
    layout = TransmittanceLayout(bottom_radius=medium.bottom_radius, top_radius=medium.top_radius)
    at = layout.positions()
    lines = lines_of_sight(at, medium)
    x, mu, length = at.r, at.mu, lines.length
    drawn = geometry.medium
    if geometry.shell is not None:
        # A ray that would meet the ground is replaced by the grazing ray: CosmoScout ends it at its
        # lowest point.
        x = geometry.optical_radius(at.r)
        sine = x * np.sqrt((1.0 - mu) * (1.0 + mu))
        hits = (mu < 0.0) & (sine < geometry.shell.bottom)
        grazing = -np.sqrt(np.maximum(1.0 - (geometry.shell.bottom * (1.0 + 1e-9) / x) ** 2, 0.0))
        seen = np.where(hits, np.maximum(mu, grazing), mu)
        length = lines_of_sight(
            changed(at, r=x, mu=seen, to_ground=np.zeros_like(hits)), drawn
        ).length
        angle = geometry.refraction_angle(x, seen)
        optical = np.where(mu < 0.0, sine, x)
        altitude = np.interp(optical, geometry.shell.optical, geometry.shell.altitude)
        altitude = np.where(
            optical < geometry.shell.bottom, optical - geometry.shell.bottom, altitude
        )
        mu = seen
        texels = np.stack([angle, altitude, np.zeros_like(angle)], axis=-1)
        write_texture(folder / DEVIATION, texels.reshape(*layout.shape, 3))
    depth = columns(x, mu, length, drawn.bottom_radius, drawn.density)
    share = np.maximum(weights, 0.0)
    transmittance = np.exp(-(depth @ drawn.extinction)) @ (share / share.sum(axis=0))
    write_texture(
        folder / TRANSMITTANCE, np.maximum(transmittance, _LEAST).reshape(*layout.shape, 3)
    )


def _scene(planet: Planet) -> dict[str, Any]:
    """Settings to merge into a scene, and the assumed radius."""
    body = planet.body.capitalize() if planet.body else name_of(planet)
    atmosphere = {
        "topAltitude": planet.thickness,
        "bottomAltitude": 0.0,
        "model": "Bruneton",
        "modelSettings": {
            "dataDirectory": f"../share/resources/atmosphere-data/airlight-{body.lower()}"
        },
    }
    return {
        "plugins": {"csp-atmospheres": {"atmospheres": {body: atmosphere}}},
        "airlight": {"radius": planet.bottom_radius},
    }


def _write_json(path: Path, content: Any) -> None:
    path.write_text(json.dumps(content, indent=2) + "\n", encoding="utf-8")


def _errors(solution: Solution, tables: CosmoScoutTables) -> tuple[ErrorRow, ...]:
    """Errors of the folder by CosmoScout's look-up, in luminance and colour."""
    medium, star = solution.medium, solution.lights[0]
    weights = EFFICACY * rgb_weights(solution.wavelengths, star.spectrum) * star.irradiance[:, None]
    whole = EFFICACY * float(luminance(sun_color(star.spectrum)))
    at = random_positions(medium, _POINTS, _SEED)
    sky = at[~at.to_ground]
    true = AirLight(solution)(lines_of_sight(sky, medium)) @ weights
    made = tables.sky_luminance(sky.r, sky.mu, sky.mu_s, sky.nu)
    bright, shown = luminance(true), luminance(made)
    high = (bright > _DARK * whole) & (sky.mu_s > math.cos(math.radians(92.0)))
    low = (bright > _DARK * whole) & ~high
    rows = []
    for name, chosen in (("sun above -2 deg", high), ("sun from -2 to -6 deg", low)):
        if chosen.any():
            error = shown[chosen] / bright[chosen] - 1.0
            where = "random points and views of the sky, from the ground to space"
            rows.append(ErrorRow.of(f"luminance of the sky, {name}", error, where=where))
            rows.append(
                ErrorRow.of(
                    f"colour of the sky, {name}",
                    color_difference(made[chosen], true[chosen]),
                    where=where,
                    measure="delta E 2000",
                )
            )
    return (*rows, *_sunlight(solution, tables))


def _sunlight(solution: Solution, tables: CosmoScoutTables) -> list[ErrorRow]:
    """Colour of transmitted sunlight at CosmoScout's three wavelengths, where it is not dark."""
    star, medium = solution.lights[0], solution.medium
    angles = np.array([0.0, 45.0, 75.0, 85.0, 88.0])
    true = solution.transmittance(altitude=0.0, view_zenith=angles).values * star.irradiance
    true = true @ rgb_weights(solution.wavelengths, star.spectrum)
    ground = np.full(angles.size, medium.bottom_radius)
    whole = sun_color(star.spectrum)
    made = tables.through(ground, np.cos(np.radians(angles))) * whole
    seen = luminance(true) > _DARK * luminance(whole)
    if not seen.any():
        return []
    return [
        ErrorRow.of(
            "colour of sunlight on the ground",
            color_difference(made[seen], true[seen]),
            where=f"sun at 0 to {angles[seen].max():.0f} deg from the zenith",
            measure="delta E 2000",
        )
    ]


TARGET: Final = Target(
    name="cosmoscout",
    program="CosmoScout VR",
    version="csp-atmospheres e59005a3",
    fill=fill,
    files=("*.tif", "*.csv", METADATA, SCENE, SETTINGS),
    default_wavelengths="16",
    options=("size", "lowest_sun"),
    bends_light=True,
)
