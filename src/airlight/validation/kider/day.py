"""Measured day: models with given or fitted aerosol, cross-validated by scan."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import Cancelled, FileError
from airlight.kernel.threads import Cancel, Progress
from airlight.planets.planet import Planet
from airlight.solver.solve import solve
from airlight.studies.fit.scans import Scans, read_scan_file
from airlight.validation.kider.fits import AerosolFit, AerosolModel
from airlight.validation.kider.planets import (
    PUBLISHED_INPUTS,
    AngstromLaw,
    Inputs,
    best_inputs,
    planet,
)

FloatArray = NDArray[np.float64]

#: Files of measured days, each with its date in the name.
FILES: Final = "kider*.npz"


@dataclass(frozen=True, eq=False)
class DayRow:
    """Model of a day.

    Attributes
    ----------
    name : str
        Description.
    inputs : Inputs
        Inputs of the planet, with the fitted aerosol if fitted.
    predicted : array, shape (ns, nd, nl)
        [W m⁻² sr⁻¹ nm⁻¹]
    fit : AerosolFit or None
        Fit to all scans; None without a fit.
    left_out : bool
        Whether each scan was predicted by the fit to the others.
    """

    name: str
    inputs: Inputs
    predicted: FloatArray
    fit: AerosolFit | None = None
    left_out: bool = False


@dataclass(frozen=True, eq=False)
class Day:
    """Rows of one day.

    Attributes
    ----------
    file : Path
    scans : Scans
    rows : list of DayRow
    counted : int
        Index of the scored row: fitted aerosol, leave-one-out.
    """

    file: Path
    scans: Scans
    rows: list[DayRow]
    counted: int

    @property
    def row(self) -> DayRow:
        """Scored row."""
        return self.rows[self.counted]


def day_files(folder: Path) -> list[Path]:
    """Files of all days in a folder, by name."""
    found = sorted(folder.glob(FILES))
    if not found:
        raise FileError(folder, f"contains no {FILES}")
    return found


def compute_day(
    file: Path, *, quality: str = "default", progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Day:  # fmt: skip
    """Rows of a day.

    Parameters
    ----------
    file : Path
        Scans of the day; a phase function of that day is read from the same folder.
    quality : str
        Quality of the solver.
    """
    scans, data = read_scan_file(file), file.parent
    best = best_inputs(data, scans.date)
    done, count = 0, 4 + len(scans.time)

    def step(message: str) -> None:
        nonlocal done
        if cancel is not None and cancel():
            raise Cancelled("cancelled")
        if progress is not None:
            progress(done, count, f"{scans.date}, {message}")
        done += 1

    def known(name: str, inputs: Inputs) -> DayRow:
        step(name)
        air = planet(inputs, scans, data)
        solution = solve(air, scans.wavelengths, quality, cache=False, cancel=cancel)
        return DayRow(name, inputs, scans.seen(solution))

    def planet_of(load: AngstromLaw) -> Planet:
        return planet(replace(best, load=load), scans, data)

    def model_of(*, with_scale: bool) -> AerosolModel:
        return AerosolModel(
            planet_of, scans, best.load, with_scale=with_scale, quality=quality, cancel=cancel
        )

    rows = [
        known("inputs of all published models", PUBLISHED_INPUTS),
        known("best known inputs, nothing fitted", best),
    ]
    step("load fitted")
    model = model_of(with_scale=False)
    whole = model.fitted()
    left_out = model.left_out(whole, lambda k: step(f"load fitted, without {scans.time[k]}"))
    step("load and instrument's scale fitted")
    scaled = model_of(with_scale=True).fitted()
    rows += [
        DayRow("load fitted to all scans", best, whole.predicted, whole),
        DayRow("load fitted, the scored scan left out", best, left_out, whole, True),
        DayRow("load and instrument's scale fitted to all scans", best, scaled.predicted, scaled),
    ]
    return Day(file=file, scans=scans, rows=rows, counted=3)
