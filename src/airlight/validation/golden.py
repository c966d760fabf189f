"""Suite ``golden``: published numbers against those of airlight."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from math import acos, degrees, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from airlight.errors import Cancelled
from airlight.kernel import vectorized
from airlight.planets import Medium, load_planet
from airlight.solver import Solution, solve
from airlight.validation.cases import CaseLines
from airlight.validation.cie_clear_sky import relative_luminance
from airlight.validation.golden_numbers import (
    GoldenComparison,
    GoldenRow,
    Group,
    compare,
    golden_groups,
)
from airlight.validation.reference_earth import (
    CORRECTED_ABSORPTION,
    WAVELENGTHS,
    reference_earth,
)
from airlight.validation.suite import Cancel, Mark, Progress, ReportTable, Suite, Threshold

FloatArray = NDArray[np.float64]

#: Number density in OpenSpace's standard set: at 0 °C and at 15 °C, as in its table. [m⁻³]
_LOSCHMIDT, _AT_15_DEGREES = 2.68731e25, 2.54743e25


def golden(
    *,
    groups: Sequence[Group] | None = None,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Suite:
    """Comparison of all golden numbers.

    Parameters
    ----------
    groups : sequence of Group, optional
        Groups instead of those of the package.

    Returns
    -------
    Suite
        One table and one threshold per group.
    """
    groups = golden_groups() if groups is None else groups
    thresholds, parts = [], []
    for done, group in enumerate(groups):
        if cancel is not None and cancel():
            raise Cancelled("cancelled")
        if progress is not None:
            progress(done, len(groups), f"golden numbers: {group.title}")
        got = [np.atleast_1d(np.asarray(x, float)) for x in QUANTITIES[group.name](group.rows)]
        compared = compare(group, got, single=group.name == "sun-color-float32")
        missed = sum(not one.passed for one in compared)
        thresholds.append(
            Threshold(
                name=f"{group.title}: numbers missed, of {len(compared)}",
                got=missed,
                allowed=0,
                source=group.source,
            )
        )
        parts.append(_table(group, compared))
    count = sum(len(part.rows) for part in parts)
    missed = int(sum(threshold.got for threshold in thresholds))
    return Suite(
        name="golden",
        title="Golden numbers",
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
        columns=["", "", f"expected [{group.unit}]", "got", "difference", "allowed", ""],
        rows=[
            (
                one.label,
                one.column,
                one.printed,
                f"{one.got:.10g}",
                f"{one.difference:+.2e}",
                f"{one.allowed:.2e}",
                "met" if one.passed else "missed",
            )
            for one in compared
        ],
        marks=marks,
        note=f"Source: {group.source}. Allowed: {group.reason}.",
        folded=True,
    )


def _sun_color(rows: Sequence[GoldenRow]) -> list[FloatArray]:
    from airlight.image.spectral import sun_color

    return [sun_color() for _ in rows]


def _sun_xyz(rows: Sequence[GoldenRow]) -> list[FloatArray]:
    from airlight.image.spectral import sun_color
    from airlight.image.xyz import rgb_to_xyz

    return [rgb_to_xyz(sun_color()) for _ in rows]


def _sun_lux(rows: Sequence[GoldenRow]) -> list[Any]:
    from airlight.image.spectral import sun_color
    from airlight.image.xyz import luminance
    from airlight.physics.constants import LUMINOUS_EFFICACY

    return [LUMINOUS_EFFICACY * luminance(sun_color()) for _ in rows]


def _sky_factors(rows: Sequence[GoldenRow]) -> list[FloatArray]:
    from airlight.image.spectral import sky_factors

    return [sky_factors(WAVELENGTHS) for _ in rows]


def _hable(rows: Sequence[GoldenRow]) -> list[Any]:
    from airlight.image.tone_maps import hable

    return [hable(np.ones(3))[0] for _ in rows]


def _air_refractivity(rows: Sequence[GoldenRow]) -> list[FloatArray]:
    from airlight.physics.optics.refractive_index import air_refractivity_peck1972

    return [1e8 * air_refractivity_peck1972(row.at["nm"]) for row in rows]


def _co2_refractivity(rows: Sequence[GoldenRow]) -> list[FloatArray]:
    from airlight.physics.optics.refractive_index import co2_refractivity_bideau_mehu1973

    return [1e8 * co2_refractivity_bideau_mehu1973(row.at["nm"]) for row in rows]


def _king_factor(rows: Sequence[GoldenRow]) -> list[FloatArray]:
    from airlight.physics.optics.king_factor import king_factor_air_bates1984

    return [king_factor_air_bates1984(row.at["nm"]) for row in rows]


def _rayleigh(rows: Sequence[GoldenRow]) -> list[FloatArray]:
    return [1e6 * _rayleigh_set(row.at) for row in rows]


def _rayleigh_set(at: Any) -> FloatArray:
    """Scattering coefficients from the inputs stated by a source. [m⁻¹]"""
    from airlight.physics.optics import rayleigh, refractive_index
    from airlight.physics.optics.king_factor import king_factor_air_bates1984

    nm = np.array(at["nm"])
    if at["set"] == "reference":
        density = rayleigh.number_density(288.15, 101_325.0)
        refractivity = refractive_index.air_refractivity_peck1972(nm)
        king = king_factor_air_bates1984(nm)
        return density * rayleigh.cross_section(nm, refractivity, density, king)
    if at["set"] == "openspace":
        # Edlén (1953), JOSA 43, 339, as used by Penndorf (1957), converted from 15 °C to 0 °C.
        s2 = np.square(1e3 / nm)
        edlen = 1e-8 * (6432.8 + 2_949_810.0 / (146.0 - s2) + 25_540.0 / (41.0 - s2))
        refractivity = edlen * _LOSCHMIDT / _AT_15_DEGREES
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


def _scale_height(rows: Sequence[GoldenRow]) -> list[Any]:
    from airlight.physics.optics.rayleigh import scale_height

    return [scale_height(**row.at) for row in rows]


def _ozone(rows: Sequence[GoldenRow]) -> list[FloatArray]:
    from airlight.physics.optics.gas_absorption import column_from_dobson
    from airlight.physics.spectra.ozone import ozone_cross_section

    section = ozone_cross_section(WAVELENGTHS)
    both = {"cross-section": 1e26 * section, "depth": section * column_from_dobson(345.0)}
    return [both[row.at["kind"]] for row in rows]


def _phase_functions(rows: Sequence[GoldenRow]) -> list[Any]:
    from airlight.physics.optics.phase_functions import cornette_shanks
    from airlight.physics.optics.phase_functions import rayleigh as gas

    def mean_cosine() -> float:
        nodes, weights = np.polynomial.legendre.leggauss(200)
        return float(2.0 * np.pi * weights @ (nodes * vectorized(cornette_shanks)(nodes, 0.8)))

    return [
        mean_cosine() if row.at["kind"] == "mean-cosine" else vectorized(gas)(row.at["nu"], 0.035)
        for row in rows
    ]


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
    from airlight.solver.tables.columns import columns

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
    medium = Medium.from_planet(planet, WAVELENGTHS)
    solution = solve(planet, quality="preview", polarisation=False, cache=False)
    return [
        solution.transmittance(
            altitude=row.at["altitude"], view_zenith=degrees(acos(_cosine(row.at, medium)))
        ).values
        for row in rows
    ]


def _geometry(rows: Sequence[GoldenRow]) -> CaseLines:
    def column(name: str) -> FloatArray:
        return np.array([row.at[name] for row in rows])

    return CaseLines(
        altitude=column("altitude"),
        sun_zenith=column("sun"),
        view_zenith=column("view"),
        azimuth=column("azimuth"),
    )


@cache
def _printed_solution() -> Solution:
    return solve(reference_earth(albedo=0.0), polarisation=False, cache=False)


def _scattered_once(rows: Sequence[GoldenRow], constituent: int) -> list[FloatArray]:
    from airlight.solver.single_scattering import single_scattering

    solution = _printed_solution()
    lines, _ = solution.lines_of_sight(**_geometry(rows))
    without_phase = single_scattering(solution.medium, lines)[:, constituent]
    phase = solution.medium.phase_function(lines.nu)[:, constituent]
    return list(without_phase * phase)


def _first_order(rows: Sequence[GoldenRow]) -> list[FloatArray]:
    return list(_printed_solution().radiance(**_geometry(rows), order=1).values)


def _regions(altitude: float) -> tuple[float, float, float]:
    """Weights w_L and w_S and the horizon's cosine at an altitude of AP2's Earth. [1]"""
    from airlight.geometry.mappings import power, weighted_power

    medium = _corrected_medium()
    u = power.altitude_coordinate(altitude, medium.thickness, 2.0)
    lower = weighted_power.lower_weight(u, weighted_power.DEFAULT_LOWER_WEIGHT)
    surface = weighted_power.surface_weight(
        u, weighted_power.DEFAULT_SURFACE_SLOPE, weighted_power.DEFAULT_SURFACE_OFFSET
    )
    r = medium.bottom_radius + altitude
    return lower, surface, -sqrt(altitude * (medium.bottom_radius + r)) / r


def _weighted_power(rows: Sequence[GoldenRow]) -> list[FloatArray]:
    return [np.array(_regions(row.at["altitude"])) for row in rows]


def _weighted_power_ends(rows: Sequence[GoldenRow]) -> list[FloatArray]:
    from airlight.geometry.mappings.weighted_power import view_coordinate, view_from_coordinate

    out = []
    for row in rows:
        lower, surface, horizon = _regions(row.at["altitude"])
        below_level = np.nextafter(0.0, -1.0) if horizon < 0.0 else 0.0
        ends = [
            (-1.0, True), (horizon - 1e-9, True), (horizon, False),
            (below_level, False), (0.0, False), (1.0, False),
        ]  # fmt: skip
        there_and_back = []
        for mu, to_ground in ends:
            v = view_coordinate(mu, to_ground, horizon, 2.0, 2.0, 2.0, lower, surface)
            back, ground = view_from_coordinate(v, horizon, 2.0, 2.0, 2.0, lower, surface)
            # A look-up on the wrong side of the horizon counts as the largest possible error.
            there_and_back.append(back - mu if ground == to_ground else np.inf)
        out.append(np.array(there_and_back))
    return out


def _cie_clear_sky(rows: Sequence[GoldenRow]) -> list[FloatArray]:
    view = np.array([-85.0, -60.0, -30.0, 0.0, 30.0, 60.0, 75.0, 85.0])
    azimuth = np.where(view < 0.0, 180.0, 0.0)
    return [relative_luminance(row.at["sun"], np.abs(view), azimuth) for row in rows]


#: Function that computes each group, by its name in the file.
QUANTITIES: dict[str, Callable[[Sequence[GoldenRow]], Sequence[Any]]] = {
    "sun-color-float32": _sun_color,
    "sun-color": _sun_color,
    "sun-xyz": _sun_xyz,
    "sun-lux": _sun_lux,
    "sky-factors": _sky_factors,
    "hable": _hable,
    "air-refractivity": _air_refractivity,
    "co2-refractivity": _co2_refractivity,
    "king-factor": _king_factor,
    "rayleigh": _rayleigh,
    "scale-height": _scale_height,
    "ozone": _ozone,
    "phase-functions": _phase_functions,
    "columns": _columns,
    "transmittances": _transmittances,
    "single-scattering-gas": lambda rows: _scattered_once(rows, 0),
    "single-scattering-aerosol": lambda rows: _scattered_once(rows, 1),
    "first-order": _first_order,
    "weighted-power": _weighted_power,
    "weighted-power-ends": _weighted_power_ends,
    "cie-clear-sky": _cie_clear_sky,
}
