"""Spherical Rayleigh atmosphere against SASKTRAN, values by ``builders/polarised_sky.py``."""

from __future__ import annotations

from functools import cache
from itertools import product
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.planets import Planet
from airlight.planets.matter.phases import Rayleigh
from airlight.planets.matter.profiles import Layer, Layered
from airlight.solver import solve as solve_planet
from airlight.solver.montecarlo.settings import MonteCarloSettings
from airlight.validation.cases import CaseLines
from airlight.validation.metrics import summarise
from airlight.validation.planets import one_constituent
from airlight.validation.reference_files import packaged_table
from airlight.validation.suite import Part, ReportTable, SuiteRun, Threshold, cells

FloatArray = NDArray[np.float64]

FILE: Final = "data/polarised-sky.csv"
#: Altitudes between which the density is linear [m], and its scale height there [m].
LEVELS: Final = np.concatenate(
    [np.arange(0.0, 16e3, 1e3), np.arange(16e3, 40e3, 3e3), np.arange(40e3, 101e3, 12e3)]
)
SCALE_HEIGHT: Final = 8e3
#: Radius of the ground [m], its albedo, optical depths of the atmosphere.
BOTTOM, ALBEDO = 6360e3, 0.3
DEPTHS: Final = (0.1, 0.5)
#: Zenith angles of the star; zenith angle and azimuth of each line of sight. [deg]
SUNS: Final = (30.0, 60.0, 80.0)
LINES: Final = (
    *product((30.0,), (0.0, 120.0)),
    *product((55.0,), (60.0, 180.0)),
    *product((75.0,), (30.0, 90.0, 150.0)),
    *product((85.0,), (60.0, 180.0)),
)
#: Allowed differences of I, median and 95 % [%], and of the degree of polarisation [1]. Lines near
#: the zenith are excluded: the reference is off by 0.27 in the degree of polarisation one degree
#: from it.
MEDIAN_THRESHOLD, HIGH_THRESHOLD, DEGREE_THRESHOLD = 0.3, 1.0, 0.005
#: Number of histories of the solution that checks both for the same lines.
HISTORIES: Final = MonteCarloSettings(relative_error=0.002, most_histories=100_000)


class Sky(NamedTuple):
    """Values of SASKTRAN, per irradiance of the star.

    Attributes
    ----------
    depth, sun, zenith, azimuth : array, shape (n,)
        Optical depth; zenith angle of the star, and of the line, and azimuth between them. [deg]
    stokes, error : array, shape (n, 3)
        I, Q and U, and their change with coarser settings. [sr⁻¹]
    """

    depth: FloatArray
    sun: FloatArray
    zenith: FloatArray
    azimuth: FloatArray
    stokes: FloatArray
    error: FloatArray


@cache
def reference_sky() -> Sky:
    """Values of the file."""
    table = packaged_table(FILE)
    depth, sun, zenith, azimuth = table[:, :4].T
    return Sky(depth, sun, zenith, azimuth, table[:, 4:7], table[:, 7:10])


def densities() -> FloatArray:
    """Relative density at ``LEVELS``. [1]"""
    return np.asarray(np.exp(-LEVELS / SCALE_HEIGHT))


def round_rayleigh(depth: float) -> Planet:
    """Spherical Rayleigh atmosphere under a point star of irradiance 1.

    Parameters
    ----------
    depth : float
        Vertical optical depth. [1]
    """
    density = densities()
    slopes = np.diff(density) / np.diff(LEVELS)
    layers = [
        Layer(width=width, linear_term=slope, constant_term=first - slope * low)
        for width, slope, first, low in zip(
            np.diff(LEVELS), slopes, density[:-1], LEVELS[:-1], strict=True
        )
    ]
    layers[-1] = Layer(linear_term=layers[-1].linear_term, constant_term=layers[-1].constant_term)
    return one_constituent(
        "round Rayleigh air",
        BOTTOM,
        float(LEVELS[-1]),
        ALBEDO,
        profile=Layered(layers=tuple(layers)),
        scattering=depth / float(np.trapezoid(density, LEVELS)),
        phase_function=Rayleigh(),
    )


def round_air(run: SuiteRun) -> tuple[list[Threshold], list[Part]]:
    """Thresholds and table of the comparison."""
    sky = reference_sky()
    got, judged = np.empty_like(sky.stokes), np.empty_like(sky.stokes)
    scalar = np.empty(sky.depth.size)
    for depth in np.unique(sky.depth):
        rows = sky.depth == depth
        suns, views, azimuth = sky.sun[rows], sky.zenith[rows], sky.azimuth[rows]
        where = CaseLines(
            altitude=np.zeros(suns.size), sun_zenith=suns, view_zenith=views, azimuth=azimuth
        )
        planet = round_rayleigh(float(depth))
        vector = run.solve(planet, (550.0,))
        got[rows] = vector.radiance(**where, stokes=True).values[..., 0]
        histories = solve_planet(planet, (550.0,), HISTORIES, solver="montecarlo")
        judged[rows] = histories.radiance(**where, stokes=True).values[..., 0]
        without = run.solve(planet, (550.0,), polarisation=False)
        scalar[rows] = without.radiance(**where).values[:, 0]
    light = got[:, 0] / sky.stokes[:, 0] - 1.0
    of_light = summarise(light)
    of_degree = summarise(_degree(got) - _degree(sky.stokes))
    ours_judged = summarise(_degree(got) - _degree(judged))
    theirs_judged = summarise(_degree(sky.stokes) - _degree(judged))
    light_judged = [summarise(one[:, 0] / judged[:, 0] - 1.0) for one in (got, sky.stokes)]
    of_scalar = summarise(scalar / sky.stokes[:, 0] - 1.0)
    noise = summarise(sky.error[:, 0] / sky.stokes[:, 0])
    source = "target; SASKTRAN 2 with three Stokes parameters"
    air, degree, allowed = "round Rayleigh air", "degree of polarisation", DEGREE_THRESHOLD
    others = f"{air}, histories instead: {degree}, 95 %"
    thresholds = [
        Threshold(f"{air}: I, median", 100.0 * of_light.median, MEDIAN_THRESHOLD, "%", source),
        Threshold(f"{air}: I, 95 %", 100.0 * of_light.high, HIGH_THRESHOLD, "%", source),
        Threshold(f"{air}: {degree}, median", of_degree.median, allowed, source=source),
        Threshold(f"{air}: {degree}, 95 %", of_degree.high, allowed, source=source),
        Threshold(others, ours_judged.high, allowed, source="target; vector Monte Carlo"),
    ]
    off = got[:, 1:] / got[:, :1] - sky.stokes[:, 1:] / sky.stokes[:, :1]
    error = 100 * sky.error[:, 0] / sky.stokes[:, 0]
    rows = [
        cells(
            f"{sky.depth[k]:g} | {sky.sun[k]:g} | {sky.zenith[k]:g} | {sky.azimuth[k]:g} | "
            f"{100 * light[k]:+.2f} | {error[k]:.2f} | {off[k, 0]:+.4f} | {off[k, 1]:+.4f}"
        )
        for k in range(sky.depth.size)
    ]
    note = (
        f"Airlight less SASKTRAN, {run.quality} quality. SASKTRAN changes with coarser "
        f"settings by a median of {100 * noise.median:.2f} % of I. I differs by "
        f"{100 * of_light.median:.2f} % (median) and {100 * of_light.high:.2f} % (95 %), the "
        f"degree of polarisation by {of_degree.median:.4f} and {of_degree.high:.4f}. Vector Monte "
        f"Carlo of the same lines, known to 0.2 % of I: airlight differs from it by "
        f"{100 * light_judged[0].median:.2f} % and {100 * light_judged[0].high:.2f} %, "
        f"{ours_judged.median:.4f} and {ours_judged.high:.4f}, SASKTRAN by "
        f"{100 * light_judged[1].median:.2f} % and {100 * light_judged[1].high:.2f} %, "
        f"{theirs_judged.median:.4f} and {theirs_judged.high:.4f}. Without polarisation I differs "
        f"by {100 * of_scalar.median:.2f} % (median) and {100 * of_scalar.high:.2f} % (95 %)."
    )
    return thresholds, [
        ReportTable(
            title="Round Rayleigh air against SASKTRAN",
            columns=cells(
                "depth | sun [°] | zenith angle [°] | azimuth [°] | I [%] | their error [%] | "
                "Q/I | U/I"
            ),
            rows=rows,
            note=note,
            folded=True,
        )
    ]


def _degree(stokes: FloatArray) -> FloatArray:
    """Degree of linear polarisation, shape (n, 3) to (n,). [1]"""
    return np.asarray(np.hypot(stokes[:, 1], stokes[:, 2]) / stokes[:, 0])
