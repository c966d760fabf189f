"""Layout ``celestia``: the atmosphere of a body for Celestia, as an ``.ssc`` file.

Lengths are in km, coefficients in km⁻¹. Particles are grey, with Schlick's approximation of the
Henyey-Greenstein function; absorbers have their scale height. ``MieAsymmetry`` is negative for
forward scattering, as versions before August 2026 use the opposite angle; ``MieHGAnisotropy`` of
later versions is positive.
"""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any, Final

import numpy as np
from scipy.optimize import brentq

from airlight.engines.targets.fits.fit_errors import findings
from airlight.engines.targets.fits.formula_planet import (
    MOLECULES,
    PARTICLES,
    FormulaPlanet,
    Formulas,
    formula_planet,
    name_of,
)
from airlight.engines.targets.fits.lobe import LobeForm
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
from airlight.kernel import kernel, vectorized
from airlight.kernel.threads import Progress
from airlight.physics.optics.phase_functions import INV_4PI
from airlight.planets.matter.phases import Rayleigh, TabulatedPhase
from airlight.planets.planet import RED_GREEN_BLUE, Planet
from airlight.planets.spectral import PerWavelength
from airlight.planets.star import Star
from airlight.solver.solution import Solution

FILE: Final = "atmosphere.ssc"
#: Name and parent of a body in Celestia's catalogue by ``Planet.body``.
_BODIES: Final = {
    "earth": ("Earth", "Sol"),
    "mars": ("Mars", "Sol"),
    "titan": ("Titan", "Sol/Saturn"),
}
#: Number of angles of the table of Schlick's function.
_ANGLES: Final = 721
#: Largest asymmetry: beyond 0.937 k is above 1. [1]
_LARGEST_G: Final = 0.93

Value = float | list[float]


@kernel
def schlick(nu: float, g: float) -> float:
    r"""Schlick's approximation of the Henyey-Greenstein function, as Celestia uses it. [sr⁻¹]

    .. math:: p = \frac{1}{4\pi}\,\frac{1-k^2}{(1-k\nu)^2}, \qquad k = 1.55 g - 0.55 g^3

    Its mean cosine is larger than g: 0.76 at g = 0.7.

    Parameters
    ----------
    nu : float
        Cosine of the scattering angle. [1]
    g : float
        Asymmetry of the catalogue. [1]

    References
    ----------
    Blasi, Le Saec & Schlick (1993), A Rendering Algorithm for Discrete Volume Density Objects,
    Computer Graphics Forum 12, 201.

    Examples
    --------
    >>> schlick(0.3, 0.0) == INV_4PI
    True
    """
    k = g * (1.55 - 0.55 * g * g)
    base = 1.0 - k * nu
    return INV_4PI * (1.0 - k * k) / (base * base)


def g_of_schlick(mean_cosine: float) -> float:
    r"""Asymmetry g of Schlick's function with a mean cosine. [1]

    .. math:: \frac{1}{k} + \frac{1-k^2}{2k^2} \ln\frac{1-k}{1+k}, \qquad k = 1.55 g - 0.55 g^3

    Parameters
    ----------
    mean_cosine : float
        Mean cosine, -0.993 to 0.993. [1]

    Examples
    --------
    >>> f"{g_of_schlick(0.76):.2f}"
    '0.70'
    """

    def mean(g: float) -> float:
        k = g * (1.55 - 0.55 * g * g)
        if abs(k) < 1e-3:
            return 2.0 * k / 3.0  # first term of the series
        return 1.0 / k + 0.5 * (1.0 - k * k) / (k * k) * math.log((1.0 - k) / (1.0 + k))

    most = mean(_LARGEST_G)
    if not abs(mean_cosine) <= most:
        raise ParameterError("mean cosine", mean_cosine, f"-{most:.3g} to {most:.3g}")
    return float(brentq(lambda g: mean(g) - mean_cosine, -_LARGEST_G, _LARGEST_G))


def schlick_table(g: float) -> TabulatedPhase:
    """Tabulated phase function by Schlick's function with asymmetry g."""
    angles = np.linspace(0.0, 180.0, _ANGLES)
    values = vectorized(schlick)(np.cos(np.radians(angles)), g)
    return TabulatedPhase(angles=tuple(angles.tolist()), rows=(tuple(values.tolist()),))


SCHLICK: Final = LobeForm("Schlick", schlick, g_of_schlick, schlick_table)


def atmosphere_of(fit: FormulaPlanet) -> dict[str, Value]:
    """Keys of ``Atmosphere`` from a formula planet.

    Parameters
    ----------
    fit : FormulaPlanet
        Fit at 680, 550 and 440 nm by exponentials and Schlick's lobe, with grey particles.
    """
    planet = fit.planet
    molecules, particles, absorber = fit.parts
    g = rounded(fit.g)
    takes = particles if absorber is None else absorber
    return {
        "Height": rounded(planet.thickness / 1e3),
        "Rayleigh": per_km(molecules, "scattering"),
        "RayleighScaleHeight": scale_height_km(molecules),
        "Mie": per_km(particles, "scattering")[1],
        "MieScaleHeight": scale_height_km(takes),
        "MieAsymmetry": -g,
        "MieHGAnisotropy": g,
        "Absorption": per_km(takes, "absorption"),
    }


def planet_from_celestia(
    atmosphere: dict[str, Value], star: Star, radius: float, albedo: Any, name: str
) -> Planet:
    """Planet from the keys of ``Atmosphere``.

    Parameters
    ----------
    star : Star
        Light source.
    radius : float
        Radius of the body, from its definition. [m]
    albedo : float or PerWavelength
        Albedo of the ground, unknown to Celestia. [1]
    """
    try:
        height = 1e3 * _number(atmosphere, "Height")
        rayleigh, absorbed = (_triple(atmosphere, key) for key in ("Rayleigh", "Absorption"))
        mie, mie_height = (_number(atmosphere, key) for key in ("Mie", "MieScaleHeight"))
        gas_height = _number(atmosphere, "RayleighScaleHeight")
        # The sign of MieAsymmetry follows older versions.
        g = _number(atmosphere, "MieHGAnisotropy")
    except KeyError as error:
        raise ParameterError(str(error.args[0]), "missing", "a key of Atmosphere") from None
    constituents = []
    if any(rayleigh.values):
        constituents.append(
            exponential_layer(MOLECULES, 1e3 * gas_height, rayleigh, phase=Rayleigh())
        )
    if mie > 0.0 or any(absorbed.values):
        lobe = schlick_table(g)
        constituents.append(
            exponential_layer(PARTICLES, 1e3 * mie_height, 1e-3 * mie, absorbed, lobe)
        )
    return planet_of(name, star, (radius, radius + height), albedo, constituents)


def ssc_of(atmosphere: dict[str, Value], planet: Planet | None) -> str:
    """Text of the catalogue file, which modifies a body's atmosphere.

    Parameters
    ----------
    planet : Planet, optional
        Planet whose name and body it has.
    """
    own = name_of(planet)
    body, parent = _BODIES.get((planet.body or "") if planet else "", (own, "Sol"))
    lines = "\n".join(f"\t\t{key} {_ssc(value)}" for key, value in atmosphere.items())
    return (
        f"# Atmosphere of {planet.name if planet else own} for Celestia, written by airlight.\n"
        "# Lengths in km, coefficients in 1/km at 680, 550 and 440 nm.\n"
        "# MieAsymmetry, negative forward, is for older versions, MieHGAnisotropy for later ones.\n"
        "# Versions before August 2026 know MieScaleHeight alone, for molecules too.\n"
        f'Modify "{body}" "{parent}"\n{{\n\tAtmosphere\n\t{{\n{lines}\n\t}}\n}}\n'
    )


def read_atmosphere(text: str) -> dict[str, Value]:
    """Keys of the first ``Atmosphere`` in a catalogue file.

    Returns
    -------
    dict of str to float or list of float
        Numbers and triples; texts are omitted.

    Examples
    --------
    >>> read_atmosphere('"A" "Sol" { Atmosphere { Height 60 Rayleigh [ 1 2 3 ] CloudMap "a.*" } }')
    {'Height': 60.0, 'Rayleigh': [1.0, 2.0, 3.0]}
    """
    plain = re.sub(r"#[^\n]*", "", text)
    found = re.search(r"\bAtmosphere\s*\{([^}]*)\}", plain)
    if found is None:
        raise ParameterError("Atmosphere", "missing", "a block of that name")
    values: dict[str, Value] = {}
    number = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
    pattern = rf"([A-Za-z]\w*)\s+(?:\[([^\]]*)\]|({number}))"
    for key, triple, single in re.findall(pattern, found[1]):
        values[key] = float(single) if single else [float(one) for one in triple.split()]
    return values


def fill(solution: Solution, folder: Path, *, progress: Progress | None = None) -> ExportReport:
    """Write the catalogue file; see ``Target``."""
    own = name_of(solution.planet)
    fit = formula_planet(
        solution.medium,
        own,
        Formulas(lobe=SCHLICK, absorber="with particles", grey=True),
    )
    atmosphere = atmosphere_of(fit)
    text = ssc_of(atmosphere, solution.planet)
    (folder / FILE).write_text(text, encoding="utf-8")
    planet = fit.planet
    held = planet_from_celestia(
        read_atmosphere(text), planet.star, planet.bottom_radius, planet.ground.albedo, own
    )
    notes = (
        "Celestia renders single scattering, and none from the ground",
        *_of_older(atmosphere),
    )
    return findings(solution, fit, held, notes=notes, progress=progress)


def _of_older(atmosphere: dict[str, Value]) -> tuple[str, ...]:
    """Note about older versions with a single scale height, for a planet with two."""
    gas, mie = (_number(atmosphere, key) for key in ("RayleighScaleHeight", "MieScaleHeight"))
    if gas == mie or not any(_triple(atmosphere, "Rayleigh").values):
        return ()
    line = (
        f"versions before August 2026 read MieScaleHeight, {mie:.3g} km, for molecules too, whose "
        f"optical depth there is {mie / gas:.0%} of the planet's; all errors are of later versions"
    )
    return (line,)


def _number(atmosphere: dict[str, Value], key: str) -> float:
    value = atmosphere[key]
    if isinstance(value, list):
        raise ParameterError(key, value, "a number")
    return value


def _triple(atmosphere: dict[str, Value], key: str) -> PerWavelength:
    """Coefficients from km⁻¹. [m⁻¹]"""
    value = atmosphere[key]
    if not isinstance(value, list) or len(value) != len(RED_GREEN_BLUE):
        raise ParameterError(key, value, "three numbers")
    return per_metre(value)


def _ssc(value: Value) -> str:
    if isinstance(value, list):
        return "[ " + " ".join(f"{one:.8g}" for one in value) + " ]"
    return f"{value:.8g}"


TARGET: Final = Target(
    name="celestia",
    program="Celestia",
    version="of August 2026",
    fill=fill,
    files=(FILE,),
    wavelengths=RED_GREEN_BLUE,
)
