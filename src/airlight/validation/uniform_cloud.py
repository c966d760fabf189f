"""A uniform cloud by the solver of boxes against discrete ordinates in one dimension."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np

from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_optics import CloudOptics
from airlight.planets.matter.phases.formulas import HenyeyGreenstein
from airlight.solver.boxes.light import BoxLight
from airlight.solver.boxes.solve import solve_box
from airlight.validation.reference_files import packaged_table
from airlight.validation.suite import Part, ReportTable, SuiteRun, Threshold, cells

#: File of this package with irradiances of PythonicDISORT, made by ``builders/uniform_clouds.py``.
FILE: Final = "data/uniform-clouds.csv"
#: Asymmetry of the Henyey-Greenstein phase function. [1]
ASYMMETRY: Final = 0.85
#: Levels, those of generated clouds, and depth of the field [m].
LEVELS, DEPTH = 32, 1000.0
#: Largest difference over the incident irradiance. [%]
TARGET: Final = 1.0
QUALITIES: Final = ("default", "preview")


class UniformCloud(NamedTuple):
    """Uniform layer over Lambertian ground.

    Attributes
    ----------
    optical_depth, zenith, albedo, ground : float
        Optical depth [1], zenith angle of the sun [deg], single-scattering albedo and albedo of the
        ground [1].
    """

    optical_depth: float
    zenith: float
    albedo: float
    ground: float


CASES: Final = (
    UniformCloud(0.5, 30.0, 1.0, 0.2),
    UniformCloud(8.0, 60.0, 1.0, 0.2),
    UniformCloud(30.0, 75.0, 0.99, 0.2),
    UniformCloud(64.0, 60.0, 1.0, 0.0),
    UniformCloud(300.0, 60.0, 1.0, 0.0),
    UniformCloud(1000.0, 60.0, 1.0, 0.0),
)


def irradiances(case: UniformCloud, quality: str, run: SuiteRun) -> tuple[float, float]:
    """Irradiance upwards at the top and downwards at the base over the incident one. [1]"""
    angle = np.radians(case.zenith)
    extinction = np.full((1, 1, LEVELS), case.optical_depth / DEPTH, np.float32)
    field = CloudField(
        extinction=extinction,
        spacing=(100.0, 100.0, DEPTH / LEVELS),
        base=0.0,
        beyond="periodic",
    )
    optics = CloudOptics(
        wavelengths=np.array([550.0]),
        extinction=np.ones(1),
        albedo=np.array([case.albedo]),
        phase=HenyeyGreenstein(asymmetry=ASYMMETRY),
    )
    light = BoxLight(
        towards=(float(np.sin(angle)), 0.0, float(np.cos(angle))), albedo=np.array([case.ground])
    )
    found = solve_box(field, optics, light, quality=quality, cache=False, cancel=run.cancel)
    down = float((found.down + found.direct).mean())
    return float(found.up.mean()) / light.cosine, down / light.cosine


def uniform_cloud(run: SuiteRun) -> tuple[list[Threshold], list[Part]]:
    """Thresholds and table of all cases."""
    known = packaged_table(FILE)
    thresholds, rows = [], []
    for quality in QUALITIES:
        worst = 0.0
        for case, expected in zip(CASES, known, strict=True):
            found = irradiances(case, quality, run)
            off = [100.0 * (a - b) for a, b in zip(found, expected[4:], strict=True)]
            worst = max(worst, *(abs(one) for one in off))
            rows.append(
                cells(
                    f"{case.optical_depth:g} | {case.zenith:g}° | {case.albedo:g} | "
                    f"{case.ground:g} | {quality} | {expected[4]:.4f} | {off[0]:+.2f} | "
                    f"{expected[5]:.4f} | {off[1]:+.2f}"
                )
            )
        name = f"uniform field, {quality} quality: largest difference of an irradiance"
        thresholds.append(Threshold(name, worst, TARGET, "%", "PythonicDISORT"))
    table = ReportTable(
        title="A uniform field and discrete ordinates in one dimension",
        columns=cells(
            "optical depth | sun | single-scattering albedo | ground | quality | reflectance | "
            "difference [%] | transmittance | difference [%]"
        ),
        rows=rows,
        note=f"{LEVELS} levels; differences are over the incident irradiance. With 16 levels the "
        "third reflectance is 1.2 % too high.",
    )
    return thresholds, [table]
