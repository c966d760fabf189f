"""Suite ``disort``: optically thick plane-parallel atmospheres against discrete ordinates.

Reference: irradiances by PythonicDISORT (Ho & Pincus 2024, Journal of Open Source Software 9,
6442), discrete ordinates after Stamnes, Tsay, Wiscombe & Jayaweera (1988), Applied Optics 27, 2502,
with many equal layers; ``builders/disort.py`` writes ``data/plane-parallel.toml``. Planets here
have a thousand times their radius, which makes them plane-parallel.
"""

from __future__ import annotations

import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.planets import Medium, Planet, load_planet
from airlight.planets.matter.phases import HenyeyGreenstein, PhaseFunction, Rayleigh
from airlight.planets.matter.profiles import Exponential, Tent
from airlight.solver import Solution
from airlight.validation.planets import flattened, one_constituent, with_point_star
from airlight.validation.suite import ReportTable, Suite, SuiteRun, Threshold, cells

FloatArray = NDArray[np.float64]

FILE: Final = "data/plane-parallel.toml"
#: Zenith angles of the sun. [deg]
SUNS: Final = (0.0, 30.0, 60.0, 75.0)
#: Target of the difference of the irradiance of the ground. [%]
TARGET: Final = 1.0
#: Relative difference of an optical depth from which the reference counts as a different planet.
SAME: Final = 1e-6
_BOTTOM, _THICKNESS, _ALBEDO = 6000e3, 100e3, 0.05


@dataclass(frozen=True)
class FlatCase:
    """Plane-parallel case at one wavelength.

    Attributes
    ----------
    name : str
        Name, as in the file.
    planet : Planet
        Planet in the plane-parallel limit under a point star.
    wavelength : float
        Wavelength. [nm]
    """

    name: str
    planet: Planet
    wavelength: float

    @property
    def medium(self) -> Medium:
        """Medium at that wavelength."""
        return Medium.from_planet(self.planet, (self.wavelength,))


class Reference(NamedTuple):
    """Result of PythonicDISORT.

    Attributes
    ----------
    depth, absorption : float
        Vertical optical depth of extinction and of absorption. [1]
    ground : array, shape (ns,)
        Horizontal irradiance of the ground over that outside the atmosphere, by sun. [1]
    """

    depth: float
    absorption: float
    ground: FloatArray


def flat_cases() -> tuple[FlatCase, ...]:
    """Cases in the order of the report: simple gas and clouds, then Venus."""
    molecules, droplets = Rayleigh(), HenyeyGreenstein(asymmetry=0.75)
    gas, cloud = Exponential(scale_height=8e3), Tent(center=6e3, half_width=2e3)
    planets = {
        f"gas of depth {depth:g}, absorbs nothing": _air(gas, depth / 8e3, 0.0, molecules)
        for depth in (2.0, 8.0, 37.65)
    }
    for depth in (10.0, 30.0):
        thick = _air(cloud, 0.999 * depth / 2e3, 0.001 * depth / 2e3, droplets)
        planets[f"cloud of depth {depth:g}, single-scattering albedo 0.999"] = thick
    venus = flattened(with_point_star(load_planet("venus")))
    return (
        *(FlatCase(name, planet, 550.0) for name, planet in planets.items()),
        *(FlatCase(f"venus, {nm:g} nm", venus, nm) for nm in (450.0, 700.0)),
    )


def _air(
    profile: Exponential | Tent, scattering: float, absorption: float, phase: PhaseFunction
) -> Planet:
    """Plane-parallel planet of one constituent, from its coefficients [m⁻¹]."""
    matter = {"scattering": scattering, "absorption": absorption, "phase_function": phase}
    planet = one_constituent("flat air", _BOTTOM, _THICKNESS, _ALBEDO, profile=profile, **matter)
    return flattened(planet)


@cache
def references() -> dict[str, Reference]:
    """References of ``data/plane-parallel.toml`` by case."""
    text = files("airlight.validation").joinpath(FILE).read_text(encoding="utf-8")
    return {
        one["name"]: Reference(one["depth"], one["absorption"], np.array(one["ground"]))
        for one in tomllib.loads(text)["case"]
    }


def depths(medium: Medium) -> tuple[float, float]:
    """Vertical optical depths of extinction and of absorption at the first wavelength. [1]"""
    columns = np.asarray(medium.columns)
    return (
        float(medium.extinction[:, 0] @ columns),
        float(medium.absorption[:, 0] @ columns),
    )


def ground_share(solution: Solution, suns: Sequence[float] = SUNS) -> FloatArray:
    """Horizontal irradiance of the ground over that outside the atmosphere, shape (ns,). [1]

    Parameters
    ----------
    solution : Solution
        Solution at one wavelength.
    suns : sequence of float
        Zenith angles of the sun. [deg]
    """
    light = solution.irradiance(altitude=0.0, sun_zenith=list(suns))
    total = np.asarray(light["direct"] + light["diffuse"])[:, 0]
    out: FloatArray = total / (solution.lights[0].irradiance[0] * np.cos(np.radians(suns)))
    return out


def disort(run: SuiteRun, cases: Sequence[FlatCase] | None = None) -> Suite:
    """Comparison of the ground's irradiance with discrete ordinates.

    Parameters
    ----------
    run : SuiteRun
    cases : sequence of FlatCase, optional
        Cases to compare instead of all.
    """
    thresholds, rows = [], []
    for case in flat_cases() if cases is None else cases:
        known = references()[case.name]
        solution = run.solve(case.planet, (case.wavelength,), polarisation=False)
        off = 100.0 * (ground_share(solution) / known.ground - 1.0)
        remade = np.allclose(depths(solution.medium), (known.depth, known.absorption), rtol=SAME)
        worst = float(np.abs(off).max()) if remade else float("nan")
        name = f"{case.name}: irradiance of the ground, worst of {len(SUNS)} suns"
        thresholds.append(Threshold(name, worst, TARGET, "%", "target"))
        shares = [f"{share:.5f} ({d:+.2f} %)" for share, d in zip(known.ground, off, strict=True)]
        rows.append([*cells(f"{case.name} | {known.depth:.4g} | {known.absorption:.3g}"), *shares])
    met = sum(threshold.passed for threshold in thresholds)
    return Suite(
        summary=(
            "The light that reaches the ground through deep flat air, by the moments solver and by "
            f"PythonicDISORT: {met} of {len(thresholds)} are within {TARGET:g} %. Deep in "
            "conservative air, irradiance is a small difference of large terms."
        ),
        thresholds=thresholds,
        parts=[
            ReportTable(
                title="Light on the ground over that outside the air, and difference of airlight",
                columns=["air", "depth", "absorption", *(f"sun {sun:g}°" for sun in SUNS)],
                rows=rows,
                note="The sun's angle is from the zenith; NaN as a result: the planet has "
                "changed since the reference was made (python builders/disort.py).",
            )
        ],
        settings=[
            f"moments solver, {run.quality} quality, scalar transfer as the reference's",
            f"grounds of albedo {_ALBEDO:g}",
        ],
    )
