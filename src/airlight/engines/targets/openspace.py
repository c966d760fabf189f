"""Layout ``openspace``: the asset of an atmosphere for OpenSpace.

Units and keys are those of ``RenderableAtmosphere``: km, km⁻¹, a Cornette-Shanks lobe. OpenSpace
computes the extinction of particles from their scattering and the single-scattering albedo at red,
whatever ``Extinction`` says of green and blue. With an ozone layer it adds a second density,
exp(-h/H_O), to single scattering by molecules, which brightens the sky several times; ozone is
therefore written without ``H_O``, which disables the layer.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

from airlight.engines.targets.fits.fit_errors import findings
from airlight.engines.targets.fits.formula_planet import (
    ABSORBER,
    MOLECULES,
    PARTICLES,
    FormulaPlanet,
    Formulas,
    formula_planet,
    name_of,
)
from airlight.engines.targets.fits.lobe import CORNETTE_SHANKS
from airlight.engines.targets.kilometres import (
    exponential_layer,
    per_km,
    per_metre,
    planet_of,
    rounded,
    scale_height_km,
)
from airlight.engines.targets.target import ExportReport, Target
from airlight.errors import ParameterError
from airlight.kernel.threads import Progress
from airlight.planets.matter.phases import CornetteShanks, Rayleigh
from airlight.planets.planet import RED_GREEN_BLUE, Planet
from airlight.planets.spectral import PerWavelength
from airlight.planets.star import Star
from airlight.solver.solution import Solution

FILE: Final = "atmosphere.asset"
#: Factor of the shader by which ozone's ``Extinction`` becomes km⁻¹.
OZONE_UNIT: Final = 6e-7
#: Brightness of the sun on the screen: that of OpenSpace's Earth and Titan. [1]
SUN_INTENSITY: Final = 6.9
#: Factor of the ground's colour: that of OpenSpace's Earth. [1]
GROUND_RADIANCE: Final = 0.6
#: Radii of the light source and of the occulting bodies, by ``Planet.body``: nodes of OpenSpace's
#: Earth. IAU 2015 Resolution B3; IAU WGCCRE 2015. [m]
_SHADOWS: Final = {"earth": (("Sun", 695_700_000.0), ("Moon", 1_737_400.0))}
#: Assets that define these nodes, besides that of the body.
_SHADOW_NODES: Final = {
    "earth": ("scene/solarsystem/sun/sun", "scene/solarsystem/planets/earth/moon/moon"),
}
#: Largest difference of albedos that are written as one number. [1]
_EVEN: Final = 0.01
#: Asset that defines the body, and identifier of its node, by ``Planet.body``.
_BODIES: Final = {
    "earth": ("scene/solarsystem/planets/earth/earth", "Earth"),
    "mars": ("scene/solarsystem/planets/mars/mars", "Mars"),
    "titan": ("scene/solarsystem/planets/saturn/titan/globe", "Titan"),
}


def renderable_of(fit: FormulaPlanet) -> dict[str, Any]:
    """Table ``Renderable`` of the asset, from a formula planet.

    Parameters
    ----------
    fit : FormulaPlanet
        Fit at 680, 550 and 440 nm by exponentials and a Cornette-Shanks lobe.
    """
    planet = fit.planet
    molecules, particles, absorber = fit.parts
    scattering, absorption = (per_km(particles, one) for one in ("scattering", "absorption"))
    extinction = [rounded(s + a) for s, a in zip(scattering, absorption, strict=True)]
    table: dict[str, Any] = {
        "Type": "RenderableAtmosphere",
        "AtmosphereHeight": rounded(planet.thickness / 1e3),
        "PlanetRadius": rounded(planet.bottom_radius / 1e3),
        "PlanetAverageGroundReflectance": rounded(
            float(planet.ground.albedos(RED_GREEN_BLUE).mean())
        ),
        "GroundRadianceEmission": GROUND_RADIANCE,
        "SunIntensity": SUN_INTENSITY,
        "Rayleigh": {
            "Coefficients": {
                "Wavelengths": list(RED_GREEN_BLUE),
                "Scattering": per_km(molecules, "scattering"),
            },
            "H_R": scale_height_km(molecules),
        },
        "Mie": {
            "Coefficients": {"Scattering": scattering, "Extinction": extinction},
            "H_M": scale_height_km(particles),
            "G": rounded(fit.g),
        },
    }
    if absorber is not None:
        ozone = [rounded(one / OZONE_UNIT) for one in per_km(absorber, "absorption")]
        table["Ozone"] = {"Coefficients": {"Extinction": ozone}}
    return table


def planet_from_openspace(renderable: Mapping[str, Any], star: Star, name: str) -> Planet:
    """Planet from a table ``Renderable``, as interpreted by OpenSpace.

    Parameters
    ----------
    renderable : mapping
        Table of an asset, lists as sequences. An enabled ozone layer, with ``H_O``, only absorbs
        here.
    star : Star
        Light source; an asset has only its display brightness.
    """
    try:
        radius = 1e3 * float(renderable["PlanetRadius"])
        height = 1e3 * float(renderable["AtmosphereHeight"])
        rayleigh, mie = renderable["Rayleigh"], renderable["Mie"]
        gas = per_metre(rayleigh["Coefficients"]["Scattering"])
        scattering = per_metre(mie["Coefficients"]["Scattering"])
        extinction = per_metre(mie["Coefficients"]["Extinction"])
        albedo = float(renderable["PlanetAverageGroundReflectance"])
        heights = 1e3 * float(rayleigh["H_R"]), 1e3 * float(mie["H_M"])
        g = float(mie["G"])
    except KeyError as error:
        raise ParameterError(str(error.args[0]), "missing", "a value in Renderable") from None
    constituents = [exponential_layer(MOLECULES, heights[0], gas, phase=Rayleigh())]
    if any(scattering.values):
        share = float(renderable.get("MieScatteringExtinctionPropCoefficient", 1.0))
        if share == 1.0:
            if not extinction.values[0] >= scattering.values[0] > 0.0:
                red = (scattering.values[0], extinction.values[0])
                raise ParameterError("Mie, red", red, "scattering above 0, at most the extinction")
            share = scattering.values[0] / extinction.values[0]
        values = tuple(value * (1.0 / share - 1.0) for value in scattering.values)
        absorbed = PerWavelength(wavelengths=RED_GREEN_BLUE, values=values)
        lobe = CornetteShanks(asymmetry=g)
        constituents.append(exponential_layer(PARTICLES, heights[1], scattering, absorbed, lobe))
    ozone = renderable.get("Ozone", {})
    if "H_O" in ozone:
        taken = [OZONE_UNIT * float(one) for one in ozone["Coefficients"]["Extinction"]]
        thickness = 1e3 * float(ozone["H_O"])
        constituents.append(exponential_layer(ABSORBER, thickness, 0.0, per_metre(taken)))
    return planet_of(name, star, (radius, radius + height), albedo, constituents)


def asset_of(renderable: Mapping[str, Any], planet: Planet | None) -> str:
    """Text of the asset in Lua.

    Parameters
    ----------
    planet : Planet, optional
        Planet whose name and body it has.
    """
    own = name_of(planet)
    source, parent = _BODIES.get((planet.body or "") if planet else "", ("", own))
    where = (planet.body or "") if planet else ""
    nodes = (*((source,) if source else ()), *_SHADOW_NODES.get(where, ()))
    require = "".join(f'asset.require("{node}")\n' for node in nodes)
    shadows = {}
    if where in _SHADOWS:
        (shining, sun), (casting, moon) = _SHADOWS[where]
        shadows["ShadowGroup"] = {
            "Sources": [{"Name": shining, "Radius": sun}],
            "Casters": [{"Name": casting, "Radius": moon}],
        }
    label = planet.name if planet else own
    body = _lua(
        {
            "Identifier": f"{own}AtmosphereAirlight",
            "Parent": parent,
            "Renderable": {**renderable, **shadows},
            "GUI": {
                "Name": f"{label} Atmosphere (airlight)",
                "Path": "/Solar System/Atmospheres",
                "Focusable": False,
            },
        }
    )
    meta = _lua(
        {
            "Name": f"{label} Atmosphere",
            "Description": "Written by airlight; lengths in km, coefficients in 1/km.",
            "Author": "airlight",
            "URL": "",
            "License": "CC0",
        }
    )
    return (
        f"-- Atmosphere of {label} for OpenSpace, written by airlight.\n"
        "-- Lengths in km, coefficients in 1/km; Ozone.Extinction in 6e-7/km, off without H_O.\n"
        f"{require}\n"
        f"local Atmosphere = {body}\n\n"
        "asset.onInitialize(function()\n  openspace.addSceneGraphNode(Atmosphere)\nend)\n\n"
        "asset.onDeinitialize(function()\n  openspace.removeSceneGraphNode(Atmosphere)\nend)\n\n"
        f"asset.export(Atmosphere)\n\nasset.meta = {meta}\n"
    )


def fill(solution: Solution, folder: Path, *, progress: Progress | None = None) -> ExportReport:
    """Write the asset; see ``Target``."""
    own = name_of(solution.planet)
    fit = formula_planet(
        solution.medium,
        own,
        Formulas(lobe=CORNETTE_SHANKS, absorber="exponential", one_albedo=True),
    )
    renderable = renderable_of(fit)
    (folder / FILE).write_text(asset_of(renderable, solution.planet), encoding="utf-8")
    notes = ["light is scattered four times at most, and SunIntensity is the Earth's 6.9"]
    albedo = fit.planet.ground.albedos(RED_GREEN_BLUE)
    if albedo.max() - albedo.min() > _EVEN:
        low, high = albedo.min(), albedo.max()
        notes.append(f"the ground's albedo is one number: {low:.2g} to {high:.2g} in the planet")
    if "Ozone" in renderable:
        whole = solution.medium.vertical_optical_depth.sum(axis=0)
        share = float((_depth(fit.planet, ABSORBER) / whole).max())
        notes.append(
            "absorption by gases, up to "
            f"{share:.0%} of the optical depth, is written but off: OpenSpace's ozone layer adds "
            "light scattered by molecules"
        )
    held = planet_from_openspace(renderable, fit.planet.star, own)
    return findings(solution, fit, held, notes=tuple(notes), progress=progress)


def _depth(planet: Planet, name: str) -> Any:
    part = next(one for one in planet.constituents if one.name == name)
    column = part.profile.column(planet.thickness)
    return part.absorption_coefficients(RED_GREEN_BLUE, planet.thickness) * column


def _lua(value: Any, indent: str = "") -> str:
    """Value in Lua: tables, lists, texts, numbers and booleans."""
    inner = indent + "  "
    if isinstance(value, dict):
        lines = [f"{inner}{name} = {_lua(one, inner)}" for name, one in value.items()]
        return "{\n" + ",\n".join(lines) + f"\n{indent}}}"
    if isinstance(value, list):
        return "{ " + ", ".join(_lua(one) for one in value) + " }"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n") + '"'
    return repr(float(value))


TARGET: Final = Target(
    name="openspace",
    program="OpenSpace",
    version="of 2026 (37e7e4f9)",
    fill=fill,
    files=(FILE,),
    wavelengths=RED_GREEN_BLUE,
)
