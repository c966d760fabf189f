"""Plane-parallel Rayleigh atmosphere against the corrected Coulson tables."""

from __future__ import annotations

from functools import cache
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.planets import Planet
from airlight.planets.matter.phases import Rayleigh
from airlight.planets.matter.profiles import Exponential
from airlight.solver import Solution
from airlight.validation.planets import one_constituent
from airlight.validation.reference_files import packaged_table
from airlight.validation.suite import Part, ReportTable, SuiteRun, Threshold, cells

FloatArray = NDArray[np.float64]

FILE: Final = "data/coulson-corrected.csv"
#: Allowed difference of the radiance at fine quality [%], and of Q/I and U/I [1].
RADIANCE_THRESHOLD, DEGREE_THRESHOLD = 0.1, 0.001
#: Cosine of the star's zenith angle, and optical depth, of all values. [1]
SUN, DEPTH = 0.2, 0.5
_HEIGHT, _SCALE_HEIGHT = 100e3, 8e3
#: Radius of the Earth's ground [m], and radii of nearly plane-parallel air relative to it. [1]
_EARTH: Final = 6.36e6
RADII: Final = (1_000, 10_000)
_WAVELENGTH: Final = 550.0
#: Smallest angle from the vertical of a line with an azimuth; its radiance is that of the vertical.
#: [deg]
_TILT: Final = 0.01


class Values(NamedTuple):
    """Rows of one albedo.

    Attributes
    ----------
    mu : array, shape (n,)
        Cosine of the zenith angle of the propagation direction. [1]
    azimuth : array, shape (n,)
        Azimuth between line of sight and star. [deg]
    stokes : array, shape (n, 3)
        I, Q and U in the frame of ``solver.stokes_frame``, per irradiance of the star. [sr⁻¹]
    """

    mu: FloatArray
    azimuth: FloatArray
    stokes: FloatArray


@cache
def coulson_values() -> dict[float, Values]:
    """Values of the tables by albedo, with the conventions of this package."""
    table = packaged_table(FILE)
    signs = np.array([1.0, -1.0, -1.0]) / np.pi
    return {
        float(albedo): Values(rows[:, 1], rows[:, 2], rows[:, 3:] * signs)
        for albedo in np.unique(table[:, 0])
        for rows in (table[table[:, 0] == albedo],)
    }


def flat_rayleigh(albedo: float, times: int = RADII[-1]) -> Planet:
    """Atmosphere of the tables, a point star of irradiance 1, radius in radii of the Earth."""
    column = _SCALE_HEIGHT * -np.expm1(-_HEIGHT / _SCALE_HEIGHT)
    return one_constituent(
        "flat Rayleigh air",
        times * _EARTH,
        _HEIGHT,
        albedo,
        profile=Exponential(scale_height=_SCALE_HEIGHT),
        scattering=DEPTH / column,
        phase_function=Rayleigh(),
    )


def differences(solution: Solution, values: Values) -> tuple[FloatArray, FloatArray]:
    """Differences from the tables, of I [%], shape (n,), and of Q/I and U/I [1], shape (n, 2)."""
    zenith = 180.0 - np.degrees(np.arccos(values.mu))
    got = solution.radiance(
        altitude=solution.medium.thickness,
        sun_zenith=np.degrees(np.arccos(SUN)),
        view_zenith=np.minimum(zenith, 180.0 - _TILT),
        azimuth=values.azimuth,
        stokes=True,
    ).values[..., 0]
    known = values.stokes
    of_degree = got[:, 1:] / got[:, :1] - known[:, 1:] / known[:, :1]
    return 100.0 * (got[:, 0] / known[:, 0] - 1.0), of_degree


def flat_air(run: SuiteRun) -> tuple[list[Threshold], list[Part]]:
    """Thresholds and table of the comparison."""
    thresholds, rows = [], []
    for quality, times in (("default", RADII[-1]), *(("fine", one) for one in RADII)):
        light, degree = [], []
        for albedo, values in coulson_values().items():
            solution = run.solve(flat_rayleigh(albedo, times), (_WAVELENGTH,), quality)
            of_i, of_degree = differences(solution, values)
            light.append(np.abs(of_i).max())
            degree.append(np.abs(of_degree).max())
            rows += [
                cells(
                    f"{quality} | {times} | {albedo:g} | {mu:g} | {azimuth:g} | {i:+.3f} | "
                    f"{q:+.5f} | {u:+.5f}"
                )
                for mu, azimuth, i, (q, u) in zip(
                    values.mu, values.azimuth, of_i, of_degree, strict=True
                )
            ]
        if quality == "fine":
            name, source = (
                f"Rayleigh air on {times} radii, fine",
                "target; corrected Coulson tables",
            )
            largest = float(max(degree))
            thresholds += [
                Threshold(f"{name}: I", float(max(light)), RADIANCE_THRESHOLD, "%", source),
                Threshold(f"{name}: Q/I and U/I", largest, DEGREE_THRESHOLD, source=source),
            ]
    return thresholds, [
        ReportTable(
            title="Flat Rayleigh air of depth 0.5 against the corrected Coulson tables",
            columns=cells("quality | radii | albedo | μ | azimuth [°] | I [%] | Q/I | U/I"),
            rows=rows,
            note="Airlight less the reference; light that leaves the top, star 78.5° from "
            "the zenith, on a ground of so many radii of the Earth. A line that leaves the top at "
            "a cosine of 0.02 meets most of the air 4000 km on: on 1000 radii its cosine is 0.0206 "
            "there and its light 0.16 % too bright, which is no error of the solver: that case is "
            "not flat. Natraj, Li & Yung (2009), Astrophysical Journal 691, 1909.",
        )
    ]
