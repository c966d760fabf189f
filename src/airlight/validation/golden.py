"""Suite ``golden``: published numbers against those of airlight."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from math import acos, degrees, sqrt
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.mappings import power, weighted_power
from airlight.image.spectral import sky_factors, sun_color
from airlight.image.tone_maps import hable
from airlight.image.xyz import luminance, rgb_to_xyz
from airlight.kernel import vectorized
from airlight.physics.constants import LUMINOUS_EFFICACY
from airlight.physics.optics import phase_functions, rayleigh, refractive_index
from airlight.physics.optics.gas_absorption import column_from_dobson
from airlight.physics.optics.king_factor import king_factor_air_bates1984
from airlight.physics.spectra.ozone import ozone_cross_section
from airlight.planets import Medium, load_planet
from airlight.solver import Solution, solve
from airlight.solver.single_scattering import single_scattering
from airlight.solver.tables.columns import columns
from airlight.validation.cases import CaseLines
from airlight.validation.cie import relative_luminance
from airlight.validation.golden_numbers import (
    GoldenComparison,
    GoldenRow,
    Group,
    compare,
    golden_groups,
)
from airlight.validation.kider.planets import air_refractivity_edlen1953
from airlight.validation.reference_earth import (
    CORRECTED_ABSORPTION,
    WAVELENGTHS,
    reference_earth,
)
from airlight.validation.suite import Mark, ReportTable, Suite, SuiteRun, Threshold, cells

FloatArray = NDArray[np.float64]

#: Number density in OpenSpace's standard set: at 0 °C and at 15 °C, as in its table. [m⁻³]
_LOSCHMIDT, _AT_15_DEGREES = 2.68731e25, 2.54743e25


def golden(run: SuiteRun, groups: Sequence[Group] | None = None) -> Suite:
    """Compute every golden number and compare: one table and one threshold per group.

    Parameters
    ----------
    run : SuiteRun
    groups : sequence of Group, optional
        Groups to compute instead of those that ship with the package.
    """
    groups = golden_groups() if groups is None else groups
    thresholds, parts = [], []
    for done, group in enumerate(groups):
        run.step(done, len(groups), f"golden numbers: {group.title}")
        got = [np.atleast_1d(np.asarray(x, float)) for x in QUANTITIES[group.name](group.rows)]
        compared = compare(group, got, single=group.name == "sun-color-float32")
        missed = sum(not one.passed for one in compared)
        name = f"{group.title}: numbers missed, of {len(compared)}"
        thresholds.append(Threshold(name, missed, 0, source=group.source))
        parts.append(_table(group, compared))
    count = sum(len(part.rows) for part in parts)
    missed = int(sum(threshold.result for threshold in thresholds))
    return Suite(
        summary=(
            f"{count} numbers that are printed by an authority, or converged by a second method, "
            f"against what airlight computes: {missed} missed. Each table names its source and "
            "says how far off a number may be, and why."
        ),
        thresholds=thresholds,
        parts=parts,
    )


def _table(group: Group, compared: Sequence[GoldenComparison]) -> ReportTable:
    marks: list[Mark] = ["pass" if one.passed else "fail" for one in compared]
    return ReportTable(
        title=group.title,
        columns=cells(f" |  | expected [{group.unit}] | result | difference | tolerance | "),
        rows=[
            cells(
                f"{one.label} | {one.column} | {one.printed} | {one.got:.10g} | "
                f"{one.difference:+.2e} | {one.allowed:.2e} | {'met' if one.passed else 'missed'}"
            )
            for one in compared
        ],
        marks=marks,
        note=f"Source: {group.source}. Allowed: {group.reason}.",
        folded=True,
    )


def _rayleigh_set(at: Any) -> FloatArray:
    """Scattering coefficients from the inputs stated by a source. [m⁻¹]"""
    nm = np.array(at["nm"])
    if at["set"] == "reference":
        density = rayleigh.number_density(288.15, 101_325.0)
        refractivity = refractive_index.air_refractivity_peck1972(nm)
        king = king_factor_air_bates1984(nm)
        return density * rayleigh.cross_section(nm, refractivity, density, king)
    if at["set"] == "openspace":
        # Edlén (1953), JOSA 43, 339, as used by Penndorf (1957), converted from 15 °C to 0 °C.
        refractivity = air_refractivity_edlen1953(nm) * _LOSCHMIDT / _AT_15_DEGREES
        king = rayleigh.king_factor_from_depolarisation(0.035)
        full = rayleigh.cross_section(nm, refractivity, _LOSCHMIDT, king)
        # OS Eq 11 is the limit n → 1 of the Lorentz-Lorenz formula.
        return np.asarray(_LOSCHMIDT * full * np.square((np.square(1.0 + refractivity) + 2.0) / 3))
    if at["set"] == "first-notes":
        return np.asarray(2.545e25 * rayleigh.cross_section(nm, 3e-4, 2.545e25))
    if at["set"] == "later-notes":
        return np.asarray(
            Medium.from_planet(load_planet("earth-atmosphere-plus"), nm).scattering[0]
        )
    measured = rayleigh.number_density(273.15, 101_325.0)
    refractivity = refractive_index.co2_refractivity_bideau_mehu1973(nm)
    king = rayleigh.king_factor_from_depolarisation(0.09)
    return np.asarray(at["density"] * rayleigh.cross_section(nm, refractivity, measured, king))


def _ozone(at: Any) -> FloatArray:
    section = ozone_cross_section(WAVELENGTHS)
    return 1e26 * section if at["kind"] == "cross-section" else section * column_from_dobson(345.0)


def _phase_function(at: Any) -> Any:
    if at["kind"] != "mean-cosine":
        return vectorized(phase_functions.rayleigh)(at["nu"], 0.035)
    nodes, weights = np.polynomial.legendre.leggauss(200)
    lobe = vectorized(phase_functions.cornette_shanks)(nodes, 0.8)
    return 2.0 * np.pi * weights @ (nodes * lobe)


def _corrected_medium() -> Medium:
    planet = reference_earth(albedo=0.0, aerosol_absorption=CORRECTED_ABSORPTION)
    return Medium.from_planet(planet, WAVELENGTHS)


def _cosine(at: Any, medium: Medium) -> float:
    """Cosine of a ray's zenith angle, from the angle or from its lowest altitude. [1]"""
    if "tangent" in at:
        lowest = medium.bottom_radius + at["tangent"]
        return -sqrt(1.0 - (lowest / (medium.bottom_radius + at["altitude"])) ** 2)
    return float(np.cos(np.radians(at["zenith"]))) if at["zenith"] != 90.0 else 0.0


def _columns(rows: Sequence[GoldenRow]) -> list[FloatArray]:
    medium = _corrected_medium()
    bottom = medium.bottom_radius
    return [
        columns(
            bottom + row.at["altitude"],
            _cosine(row.at, medium),
            1e3 * row.at["length_km"],
            bottom,
            medium.density,
        )
        for row in rows
    ]


def _transmittances(rows: Sequence[GoldenRow]) -> list[FloatArray]:
    planet = reference_earth(albedo=0.0, aerosol_absorption=CORRECTED_ABSORPTION)
    solution = solve(planet, quality="preview", polarisation=False, cache=False)
    medium = _corrected_medium()
    return [
        solution.transmittance(
            altitude=row.at["altitude"], view_zenith=degrees(acos(_cosine(row.at, medium)))
        ).values
        for row in rows
    ]


def _geometry(rows: Sequence[GoldenRow]) -> CaseLines:
    altitude, sun, view, azimuth = (
        np.array([row.at[name] for row in rows]) for name in ("altitude", "sun", "view", "azimuth")
    )
    return CaseLines(altitude=altitude, sun_zenith=sun, view_zenith=view, azimuth=azimuth)


@cache
def _printed_solution() -> Solution:
    return solve(reference_earth(albedo=0.0), polarisation=False, cache=False)


def _scattered_once(rows: Sequence[GoldenRow], constituent: int) -> list[FloatArray]:
    solution = _printed_solution()
    lines, _ = solution.lines_of_sight(**_geometry(rows))
    without_phase = single_scattering(solution.medium, lines)[:, constituent]
    phase = solution.medium.phase_function(lines.nu)[:, constituent]
    return list(without_phase * phase)


def _first_order(rows: Sequence[GoldenRow]) -> list[FloatArray]:
    return list(_printed_solution().radiance(**_geometry(rows), order=1).values)


def _regions(altitude: float) -> tuple[float, float, float]:
    """Weights w_L and w_S and the horizon's cosine at an altitude of AP2's Earth. [1]"""
    medium = _corrected_medium()
    u = power.altitude_coordinate(altitude, medium.thickness, 2.0)
    lower = weighted_power.lower_weight(u, weighted_power.DEFAULT_LOWER_WEIGHT)
    surface = weighted_power.surface_weight(
        u, weighted_power.DEFAULT_SURFACE_SLOPE, weighted_power.DEFAULT_SURFACE_OFFSET
    )
    r = medium.bottom_radius + altitude
    return lower, surface, -sqrt(altitude * (medium.bottom_radius + r)) / r


def _weighted_power_ends(at: Any) -> FloatArray:
    """Error of the mapping there and back at both ends of its regions; infinite on a wrong side."""
    lower, surface, horizon = _regions(at["altitude"])
    powers = (2.0, 2.0, 2.0, lower, surface)
    below_level = np.nextafter(0.0, -1.0) if horizon < 0.0 else 0.0
    errors = []
    for mu in (-1.0, horizon - 1e-9, horizon, below_level, 0.0, 1.0):
        to_ground = mu < horizon
        v = weighted_power.view_coordinate(mu, to_ground, horizon, *powers)
        back, ground = weighted_power.view_from_coordinate(v, horizon, *powers)
        errors.append(back - mu if ground == to_ground else np.inf)
    return np.array(errors)


def _cie_clear_sky(at: Any) -> FloatArray:
    view = np.array([-85.0, -60.0, -30.0, 0.0, 30.0, 60.0, 75.0, 85.0])
    azimuth = np.where(view < 0.0, 180.0, 0.0)
    return relative_luminance(at["sun"], np.abs(view), azimuth)


#: Quantities of one row each, by the name of their group in the file.
_BY_ROW: Final[dict[str, Callable[[Any], Any]]] = {
    "sun-color-float32": lambda _: sun_color(),
    "sun-color": lambda _: sun_color(),
    "sun-xyz": lambda _: rgb_to_xyz(sun_color()),
    "sun-lux": lambda _: LUMINOUS_EFFICACY * luminance(sun_color()),
    "sky-factors": lambda _: sky_factors(WAVELENGTHS),
    "hable": lambda _: hable(np.ones(3))[0],
    "air-refractivity": lambda at: 1e8 * refractive_index.air_refractivity_peck1972(at["nm"]),
    "co2-refractivity": (
        lambda at: 1e8 * refractive_index.co2_refractivity_bideau_mehu1973(at["nm"])
    ),
    "king-factor": lambda at: king_factor_air_bates1984(at["nm"]),
    "rayleigh": lambda at: 1e6 * _rayleigh_set(at),
    "scale-height": lambda at: rayleigh.scale_height(**at),
    "ozone": _ozone,
    "phase-functions": _phase_function,
    "weighted-power": lambda at: np.array(_regions(at["altitude"])),
    "weighted-power-ends": _weighted_power_ends,
    "cie-clear-sky": _cie_clear_sky,
}


def _each(quantity: Callable[[Any], Any]) -> Callable[[Sequence[GoldenRow]], Sequence[Any]]:
    return lambda rows: [quantity(row.at) for row in rows]


#: Function that computes the rows of each group, by its name in the file.
QUANTITIES: Final[dict[str, Callable[[Sequence[GoldenRow]], Sequence[Any]]]] = {
    **{name: _each(quantity) for name, quantity in _BY_ROW.items()},
    "columns": _columns,
    "transmittances": _transmittances,
    "single-scattering-gas": lambda rows: _scattered_once(rows, 0),
    "single-scattering-aerosol": lambda rows: _scattered_once(rows, 1),
    "first-order": _first_order,
}
