"""Discs of the giant planets and Titan against those that telescopes see.

Karkoschka (1998), Icarus 133, 134: albedo of the full disc in July 1995, ``full-disc-albedos.csv``;
calibrated to 4 %. The presets' hazes absorb so that the discs agree at the nine to twelve
wavelengths of their lists; the bands of methane and what lies between are not adjusted one by one.
Titan's haze is as Huygens measured it, without any adjustment.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.planets import load_planet
from airlight.solver import Solution
from airlight.studies.observables.disc import disc_reflectance
from airlight.validation.published.row import PublishedRow, PublishedSection
from airlight.validation.reference_files import packaged_table
from airlight.validation.suite import SuiteRun, Threshold

FloatArray = NDArray[np.float64]

#: Phase angle of the spectra: Karkoschka (1998), Table II (second-hand: notes that quote it). [deg]
PHASES: Final = {"jupiter": 6.8, "saturn": 5.7, "uranus": 0.7, "neptune": 0.3, "titan": 5.7}
#: Wavelengths of the rows: bands of methane, and others that no preset is adjusted at. [nm]
ROWS: Final = (410.0, 490.0, 540.0, 620.0, 660.0, 700.0, 730.0)
#: Wavelengths over which errors are summed up. [nm]
VISIBLE: Final = (400.0, 700.0)
#: Targets of the median and of the worst error. [%]
MEDIAN, WORST = 10.0, 20.0


def seen_albedos(name: str) -> tuple[FloatArray, FloatArray]:
    """Wavelengths [nm] and published albedos of the full disc [1], means over 10 nm."""
    table = packaged_table("data/full-disc-albedos.csv")
    return table[:, 0], table[:, 1 + list(PHASES).index(name)]


def disc_albedos(run: SuiteRun, name: str, wavelengths: FloatArray) -> FloatArray:
    """Albedo of a preset's full disc at the phase of the published spectrum, shape (nl,). [1]"""
    return disc_albedo(run.solve(load_planet(name), tuple(wavelengths.tolist())), name)


def disc_albedo(solution: Solution, name: str) -> FloatArray:
    """Albedo of the full disc of a solution at the phase of the published spectrum, (nl,). [1]

    Published albedos are over the flattened disc, these over that of a sphere's ground.
    """
    phase = np.array([PHASES[name]])
    values, _ = disc_reflectance(solution, phase, solution.medium.bottom_radius)
    return np.asarray(values[0])


def giant_planets(run: SuiteRun) -> PublishedSection:
    """Albedos of the full discs, and their median and worst errors."""
    rows, aims = [], []
    for name in PHASES:
        nm, seen = seen_albedos(name)
        ours = disc_albedos(run, name, nm)
        for at in ROWS:
            k = int(np.flatnonzero(nm == at)[0])
            what = f"{name}'s full disc, {at:g} nm, albedo"
            rows.append(PublishedRow(what, float(seen[k]), float(ours[k]), "Karkoschka (1998)"))
        inside = (nm >= VISIBLE[0]) & (nm <= VISIBLE[1])
        error = 100.0 * np.abs(ours / seen - 1.0)[inside]
        for word, value, most in (
            ("median", np.median(error), MEDIAN),
            ("worst", error.max(), WORST),
        ):
            aims.append(
                Threshold(f"{name}: {word} error, 400 to 700 nm", float(value), most, "%", "target")
            )
    return PublishedSection(
        title="Discs of the giant planets and Titan",
        rows=rows,
        aims=aims,
        note="At none of these wavelengths is a preset adjusted. The tables of methane and of the "
        "discs are means over 10 nm, in which strong bands take more than their mean.",
    )
