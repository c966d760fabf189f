"""A finite cloud over a plane: Monte Carlo and the solver of boxes beside Mitsuba's radiances."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_layer import CloudLayer
from airlight.clouds.cloud_optics import CloudOptics
from airlight.planets import Medium
from airlight.planets.matter.phases.formulas import HenyeyGreenstein
from airlight.solver.boxes.light import BoxLight
from airlight.solver.boxes.solution import BoxSolution
from airlight.solver.boxes.solve import solve_box
from airlight.solver.montecarlo.cloudy_air import Areas, CloudyAir
from airlight.solver.montecarlo.estimate import Estimate
from airlight.solver.montecarlo.settings import MonteCarloSettings
from airlight.solver.montecarlo.solution import MonteCarloSolution
from airlight.validation.boxes import differences
from airlight.validation.finite_cloud import (
    ALBEDO,
    ASYMMETRY,
    GROUND_ALBEDO,
    HALF_WIDTH,
    PIXELS,
    SUN,
    VIEWS,
    CloudView,
    finite_cloud,
    reference,
)
from airlight.validation.i3rc_monte_carlo import flat_planet_without_gases
from airlight.validation.suite import Cell, Part, ReportTable, SuiteRun, Threshold

FloatArray = NDArray[np.float64]

#: Largest differences of the mean of a view: Monte Carlo, beside three errors, and boxes. [%]
HISTORIES_LIMIT: Final = 1.0
BOXES_LIMIT: Final = 5.0
#: Monte Carlo standard error of a pixel over its value. [1]
PIXEL_ERROR: Final = 0.04
#: Wavelength, to which nothing is sensitive. [nm]
_WAVELENGTH: Final = 550.0
#: Clear cells on each side of the cloud of the box, over its width: slanted lines of sight meet
#: the ground inside. [1]
_MARGIN: Final = 2
#: Lines of sight across a pixel of the box.
_ACROSS: Final = 4


def particles() -> CloudOptics:
    """Optical properties of the particles."""
    return CloudOptics(
        wavelengths=np.array([_WAVELENGTH]),
        extinction=np.ones(1),
        albedo=np.array([ALBEDO]),
        phase=HenyeyGreenstein(asymmetry=ASYMMETRY),
    )


def pixel_areas(view: CloudView) -> tuple[Areas, float]:
    """Pixels of a view as areas of the horizontal plane from which it looks, and its altitude. [m]

    Above the cloud, or on the ground; views look vertically or in the plane of east and up.
    """
    field, along = finite_cloud(), np.array(view.along)
    altitude = field.top if along[2] < 0.0 else 0.0
    middle = view.points(1)[:, :, 0]
    middle = middle + ((altitude - middle[..., 2]) / along[2])[..., None] * along
    side = 2.0 * HALF_WIDTH / PIXELS
    return Areas.at(middle[..., 0], middle[..., 1], side / abs(along[2]), side), altitude


def traced(cloud: CloudyAir, view: CloudView, areas: Areas | None = None) -> Estimate:
    """Monte Carlo radiances of the pixels of a view, row by row. [sr⁻¹]

    Parameters
    ----------
    cloud : CloudyAir
        Result of ``cloud_over_plane``.
    areas : Areas, optional
        Other areas of the plane of ``pixel_areas``.
    """
    pixels, altitude = pixel_areas(view)
    return cloud.radiance_over(
        pixels if areas is None else areas,
        altitude=altitude,
        view_zenith=_zenith(view.along),
        azimuth=_azimuth(view.along),
        sun_zenith=_zenith(SUN),
        sun_azimuth=_azimuth(SUN),
    )


def _zenith(vector: Sequence[float]) -> float:
    """Zenith angle of a unit vector. [deg]"""
    return float(np.degrees(np.arccos(np.clip(vector[2], -1.0, 1.0))))


def _azimuth(vector: Sequence[float]) -> float:
    """Azimuth of a vector, clockwise from north. [deg]"""
    return float(np.degrees(np.arctan2(vector[0], vector[1])))


def cloud_over_plane(relative_error: float, run: SuiteRun | None = None) -> CloudyAir:
    """The cloud over a planet a thousand times as large as Earth, without gases.

    Parameters
    ----------
    relative_error : float
        Standard error of each pixel over its value. [1]
    """
    settings = MonteCarloSettings(
        relative_error=relative_error, polarisation=False, exact_first_order=False
    )
    medium = Medium.from_planet(flat_planet_without_gases(GROUND_ALBEDO), [_WAVELENGTH])
    solution = MonteCarloSolution(medium, settings, cancel=None if run is None else run.cancel)
    return CloudyAir(solution, [CloudLayer(finite_cloud(), particles())])


def boxed(quality: str = "default", run: SuiteRun | None = None) -> BoxSolution:
    """Solution of the box: the cloud in the middle of clear cells, above the ground."""
    return solve_box(
        _padded(finite_cloud()),
        particles(),
        BoxLight(towards=(SUN[0], SUN[1], SUN[2]), albedo=np.array([GROUND_ALBEDO]), ground=0.0),
        quality=quality,
        cache=False,
        cancel=None if run is None else run.cancel,
    )


def _padded(field: CloudField) -> CloudField:
    """The field with clear cells around it."""
    nx, ny, _ = field.extinction.shape
    around = ((_MARGIN * nx, _MARGIN * nx), (_MARGIN * ny, _MARGIN * ny), (0, 0))
    return replace(field, extinction=np.pad(field.extinction, around))


def box_pixels(solution: BoxSolution, view: CloudView) -> FloatArray:
    """Radiance of the pixels by the box, (PIXELS, PIXELS). [sr⁻¹]"""
    along = np.array(view.along)
    points = view.points(_ACROSS)
    altitude = solution.field.top if along[2] < 0.0 else 0.0
    origins = points + ((altitude - points[..., 2]) / along[2])[..., None] * along
    radiance = solution.radiance(origins.reshape(-1, 3), along[None])[:, 0]
    return np.asarray(radiance.reshape(points.shape[:3]).mean(axis=2))


def finite_cloud_light(run: SuiteRun) -> tuple[list[Threshold], list[Part]]:
    """Thresholds and table of both solvers on the four views."""
    known, known_error = reference()
    cloud, box = cloud_over_plane(PIXEL_ERROR, run), boxed(run=run)
    thresholds: list[Threshold] = []
    rows: list[list[Cell]] = []
    for number, view in enumerate(VIEWS):
        run.step(number, len(VIEWS), f"finite cloud, {view.name}")
        expected = known[number]
        found = traced(cloud, view)
        histories, error = (
            one[:, 0].reshape(expected.shape) for one in (found.total, found.total_error)
        )
        rms, off = differences(histories, expected)
        both = np.sqrt(np.sum(error**2 + known_error[number] ** 2)) / expected.sum()
        box_rms, box_off = differences(box_pixels(box, view), expected)
        start, source = f"finite cloud, {view.name}", "Mitsuba 3"
        limit = HISTORIES_LIMIT + 300.0 * float(both)
        thresholds += [
            Threshold(f"{start}: Monte Carlo, mean", abs(off), limit, "%", source),
            Threshold(f"{start}: boxes, mean", abs(box_off), BOXES_LIMIT, "%", source),
        ]
        rows.append(
            [
                view.name,
                f"{expected.mean():.4f}",
                f"{off:+.2f} ± {100.0 * both:.2f}",
                f"{rms:.1f}",
                f"{box_off:+.2f}",
                f"{box_rms:.1f}",
            ]
        )
    table = ReportTable(
        title="A finite cloud over a Lambertian plane",
        columns=[
            "view",
            "mean of Mitsuba [1/sr]",
            "Monte Carlo: mean from it [%]",
            "pixels, root mean square [%]",
            "boxes: mean from it [%]",
            "pixels, root mean square [%]",
        ],
        rows=rows,
        note=f"Radiance per irradiance of the sun at 50°, {PIXELS} × {PIXELS} pixels; root mean "
        "square differences are over the mean and contain the noise of both Monte Carlo codes, "
        f"{100.0 * PIXEL_ERROR:g} and about 1 % of a pixel.",
    )
    return thresholds, [table]
