"""Layout ``unreal``: an editor script that sets the properties of an Unreal SkyAtmosphere.

Lengths are in km, coefficients in km⁻¹, each a colour of up to 1 times a scale. Particles have a
Henyey-Greenstein lobe, absorbing gases a tent profile.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np

from airlight.engines.targets.fits.fit_errors import findings
from airlight.engines.targets.fits.formula_planet import (
    ABSORBER,
    MOLECULES,
    PARTICLES,
    FormulaPlanet,
    Formulas,
    formula_planet,
    name_of,
    per_wavelength,
)
from airlight.engines.targets.fits.lobe import HENYEY_GREENSTEIN
from airlight.engines.targets.kilometres import per_km, per_metre, rounded, scale_height_km
from airlight.engines.targets.target import ExportReport, Target
from airlight.errors import ParameterError
from airlight.image.encoding import srgb_decode, srgb_encode
from airlight.image.spectral import sun_color
from airlight.image.xyz import luminance
from airlight.kernel.threads import Progress
from airlight.planets.constituent import Constituent
from airlight.planets.ground import Ground
from airlight.planets.matter.phases import HenyeyGreenstein, Rayleigh
from airlight.planets.matter.profiles import Exponential, Profile, Tent
from airlight.planets.planet import RED_GREEN_BLUE, Planet
from airlight.planets.spectral import PerWavelength
from airlight.planets.star import Star
from airlight.solver.solution import Solution

FILE: Final = "sky_atmosphere.py"


class LinearColor(NamedTuple):
    """Colour of linear channels.

    Attributes
    ----------
    r, g, b : float
        Channels. [1]
    """

    r: float
    g: float
    b: float


class Color(NamedTuple):
    """Colour of eight bits per channel, sRGB encoded.

    Attributes
    ----------
    r, g, b : int
        Channels, 0 to 255.
    """

    r: int
    g: int
    b: int


class TentDistribution(NamedTuple):
    """Tent profile of density.

    Attributes
    ----------
    tip_altitude, width : float
        Altitude of the tip, and distance from it to density 0. [km]
    tip_value : float
        Density at the tip. [1]
    """

    tip_altitude: float
    tip_value: float
    width: float


Property = float | LinearColor | Color | TentDistribution


def properties_of(fit: FormulaPlanet) -> dict[str, Property]:
    """Properties of ``unreal.SkyAtmosphereComponent``, from a formula planet.

    Parameters
    ----------
    fit : FormulaPlanet
        Fit at 680, 550 and 440 nm by exponentials, a tent and a Henyey-Greenstein lobe.
    """
    planet = fit.planet
    parts = {one.name: one for one in planet.constituents}
    molecules, particles = parts.get(MOLECULES), parts.get(PARTICLES)
    albedo = np.rint(255.0 * srgb_encode(planet.ground.albedos(RED_GREEN_BLUE)))
    absorber = parts.get(ABSORBER)
    tent = TentDistribution(0.0, 0.0, 1.0)
    if absorber is not None:
        assert isinstance(absorber.profile, Tent)
        tent = TentDistribution(
            rounded(absorber.profile.center / 1e3), 1.0, rounded(absorber.profile.half_width / 1e3)
        )
    return {
        "bottom_radius": rounded(planet.bottom_radius / 1e3),
        "atmosphere_height": rounded(planet.thickness / 1e3),
        "ground_albedo": Color(*(int(one) for one in albedo)),
        "multi_scattering_factor": 1.0,
        **_coefficient("rayleigh_scattering", molecules, "scattering"),
        "rayleigh_exponential_distribution": scale_height_km(molecules),
        **_coefficient("mie_scattering", particles, "scattering"),
        **_coefficient("mie_absorption", particles, "absorption"),
        "mie_anisotropy": rounded(fit.g),
        "mie_exponential_distribution": scale_height_km(particles),
        **_coefficient("other_absorption", absorber, "absorption"),
        "other_tent_distribution": tent,
    }


def planet_from_unreal(properties: Mapping[str, Any], star: Star, name: str) -> Planet:
    """Planet from the properties of a SkyAtmosphere.

    Parameters
    ----------
    properties : mapping
        Values by name; colours have ``r``, ``g``, ``b``, the tent ``tip_altitude``, ``tip_value``
        and ``width``.
    star : Star
        Light source; in Unreal another component.
    """
    try:
        radius = 1e3 * float(properties["bottom_radius"])
        height = 1e3 * float(properties["atmosphere_height"])
        ground, tent = properties["ground_albedo"], properties["other_tent_distribution"]
        gas = _values(properties, "rayleigh_scattering")
        scattered, taken = (
            _values(properties, f"mie_{one}") for one in ("scattering", "absorption")
        )
        other = _values(properties, "other_absorption")
        heights = [
            1e3 * float(properties[f"{one}_exponential_distribution"])
            for one in ("rayleigh", "mie")
        ]
        anisotropy = float(properties["mie_anisotropy"])
    except KeyError as error:
        raise ParameterError(str(error.args[0]), "missing", "a property") from None
    made: list[tuple[str, Profile, PerWavelength | float, PerWavelength | float, Any]] = []
    if any(gas.values):
        made.append((MOLECULES, Exponential(scale_height=heights[0]), gas, 0.0, Rayleigh()))
    if any(scattered.values) or any(taken.values):
        lobe = HenyeyGreenstein(asymmetry=anisotropy)
        made.append((PARTICLES, Exponential(scale_height=heights[1]), scattered, taken, lobe))
    if any(other.values) and tent.tip_value > 0.0:
        density = Tent(center=1e3 * tent.tip_altitude, half_width=1e3 * tent.width)
        peak = PerWavelength(
            wavelengths=RED_GREEN_BLUE,
            values=tuple(float(tent.tip_value) * one for one in other.values),
        )
        made.append((ABSORBER, density, 0.0, peak, None))
    encoded = np.array([ground.r, ground.g, ground.b]) / 255.0
    return Planet(
        name=name,
        bottom_radius=radius,
        top_radius=radius + height,
        ground=Ground(albedo=per_wavelength(np.array(RED_GREEN_BLUE), srgb_decode(encoded))),
        star=star,
        constituents=tuple(
            Constituent(
                name=label, profile=profile, scattering=scatters, absorption=absorbs,
                phase_function=phase,
            )
            for label, profile, scatters, absorbs, phase in made
        ),
        default_wavelengths=RED_GREEN_BLUE,
    )  # fmt: skip


def script_of(properties: Mapping[str, Property], name: str) -> str:
    """Text of the editor script."""
    lines = "\n".join(f'    "{key}": {_python(value)},' for key, value in properties.items())
    return f'''"""Sky of {name} for Unreal's SkyAtmosphere, written by airlight.

In the editor: Tools, Execute Python Script. Lengths in km, coefficients in 1/km: each is its colour
times its scale, at 680, 550 and 440 nm.
"""

import unreal

PROPERTIES = {{
{lines}
}}


def sky_atmosphere():
    """The level's SkyAtmosphere, or a new one."""
    actors = unreal.get_editor_subsystem(unreal.EditorActorSubsystem)
    for actor in actors.get_all_level_actors():
        if isinstance(actor, unreal.SkyAtmosphere):
            return actor
    return actors.spawn_actor_from_class(unreal.SkyAtmosphere, unreal.Vector(0.0, 0.0, 0.0))


with unreal.ScopedEditorTransaction("Sky of {name}"):
    component = sky_atmosphere().get_component_by_class(unreal.SkyAtmosphereComponent)
    for name, value in PROPERTIES.items():
        component.set_editor_property(name, value)
'''


def fill(solution: Solution, folder: Path, *, progress: Progress | None = None) -> ExportReport:
    """Write the script; see ``Target``."""
    own = name_of(solution.planet)
    fit = formula_planet(solution.medium, own, Formulas(lobe=HENYEY_GREENSTEIN, absorber="tent"))
    properties = properties_of(fit)
    (folder / FILE).write_text(script_of(properties, own), encoding="utf-8")
    star = solution.lights[0]
    lux = 683.0 * float(luminance(sun_color(star.spectrum)))
    degrees = 2.0 * math.degrees(star.angular_radius)
    notes = (
        f"the sun is a DirectionalLight: {lux:.4g} lux, source angle {degrees:.3g} deg",
        "Unreal sums light scattered often from two orders, and ground_albedo has 8 bits",
    )
    held = planet_from_unreal(properties, fit.planet.star, own)
    return findings(solution, fit, held, notes=notes, progress=progress)


def _coefficient(name: str, part: Constituent | None, field: str) -> dict[str, Property]:
    """Colour of at most 1 and scale [km⁻¹] of one coefficient."""
    values = np.zeros(3) if part is None else np.array(per_km(getattr(part, field)))
    largest = float(values.max())
    color = LinearColor(*(rounded(one) for one in values / (largest or 1.0)))
    return {name: color, f"{name}_scale": rounded(largest)}


def _values(properties: Mapping[str, Any], name: str) -> PerWavelength:
    """Coefficient from its colour and its scale. [m⁻¹]"""
    color, scale = properties[name], float(properties[f"{name}_scale"])
    return per_metre([scale * float(one) for one in (color.r, color.g, color.b)])


def _python(value: Property) -> str:
    """Value as an expression of the editor's Python."""
    if isinstance(value, LinearColor):
        return f"unreal.LinearColor({value.r!r}, {value.g!r}, {value.b!r}, 1.0)"
    if isinstance(value, Color):
        return f"unreal.Color(r={value.r}, g={value.g}, b={value.b}, a=255)"
    if isinstance(value, TentDistribution):
        parts = ", ".join(f"{name}={one!r}" for name, one in value._asdict().items())
        return f"unreal.TentDistribution({parts})"
    return repr(float(value))


TARGET: Final = Target(
    name="unreal",
    program="Unreal Engine",
    version="5",
    fill=fill,
    files=(FILE,),
    wavelengths=RED_GREEN_BLUE,
)
