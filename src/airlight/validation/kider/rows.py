"""Rows for the measured skies: each input, the fits, and the lower limit of the error."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from airlight.errors import Cancelled
from airlight.kernel.threads import Cancel, Progress
from airlight.solver.moments.solution import MomentsSolution
from airlight.solver.solve import solve
from airlight.studies.fit.scans import Scans
from airlight.validation.kider.fits import AerosolModel, fit_pointing
from airlight.validation.kider.planets import (
    AERONET_AEROSOL,
    BEST,
    CLEAN_ALBEDO,
    AngstromLaw,
    Inputs,
    planet,
    steps,
)
from airlight.validation.kider.scans import (
    MILLI,
    read_scans,
    symmetric_part,
    total_rmse,
)

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Rows:
    """Results for the measured skies.

    Attributes
    ----------
    scans : Scans
    floor : float
        Score of the symmetric part of the measurements, a lower limit of any model's. [mW m⁻² sr⁻¹
        nm⁻¹]
    ladder : list of (str, array)
        Radiance after each change of inputs, from published to best. [W m⁻² sr⁻¹ nm⁻¹]
    fitted : array, shape (ns, nd, nl)
        Radiance by the best inputs with fitted aerosol.
    load : AngstromLaw
        Fitted Ångström law.
    clean : array
        Radiance by the best inputs with the single-scattering albedo of clean continental aerosol.
    turns : array, shape (ns, 3)
        Best rotation of each scan. [deg]
    turned : array
        Radiance by the best inputs in the rotated directions.
    solution : MomentsSolution
        Solution with the best inputs.
    """

    scans: Scans
    floor: float
    ladder: list[tuple[str, FloatArray]]
    fitted: FloatArray
    load: AngstromLaw
    clean: FloatArray
    turns: FloatArray
    turned: FloatArray
    solution: MomentsSolution

    @property
    def same(self) -> FloatArray:
        """Radiance by the published inputs."""
        return self.ladder[0][1]

    @property
    def known(self) -> FloatArray:
        """Radiance by the best inputs, without a fit."""
        return self.ladder[-1][1]

    def score(self, got: FloatArray, only: NDArray[np.bool_] | None = None) -> float:
        """RMSE of a model, optionally over some directions (ns, nd) only. [mW m⁻² sr⁻¹ nm⁻¹]"""
        if only is None:
            return total_rmse(got, self.scans.radiance)
        squares = np.square(got[only] - self.scans.radiance[only])
        return float(MILLI * np.sqrt(squares.mean()))


def compute(
    data: Path, *, quality: str = "default", progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Rows:  # fmt: skip
    """Rows of all inputs and fits.

    Parameters
    ----------
    data : Path
        Folder of the scans and of the aerosol's phase function.
    quality : str
        Quality of the moments solver.
    """
    scans = read_scans(data)
    named_steps = steps()
    # One solution per step, the fit, one for the other albedo; then the pointing.
    tasks, done = len(named_steps) + 3, 0

    def report(message: str) -> None:
        nonlocal done
        if cancel is not None and cancel():
            raise Cancelled("cancelled")
        if progress is not None:
            progress(done, tasks, message)
        done += 1

    def solution(inputs: Inputs, message: str) -> MomentsSolution:
        report(message)
        air = planet(inputs, scans, data)
        return solve(air, scans.wavelengths, quality, cache=False, cancel=cancel)

    def radiance(inputs: Inputs, message: str) -> FloatArray:
        return scans.seen(solution(inputs, message))

    ladder = [(name, radiance(inputs, name)) for name, inputs in named_steps[:-1]]
    known = solution(BEST, named_steps[-1][0])
    ladder.append((named_steps[-1][0], scans.seen(known)))
    report("fit of the aerosol's load")
    found = AerosolModel(
        lambda load: planet(replace(BEST, load=load), scans, data), scans, AERONET_AEROSOL,
        quality=quality, cancel=cancel,
    ).fitted()  # fmt: skip
    clean = radiance(replace(BEST, single_scattering_albedo=CLEAN_ALBEDO), "a brighter aerosol")
    report("pointing of the scans")
    turns, turned = fit_pointing(lambda z, a: scans.seen(known, z, a), scans)
    return Rows(
        scans=scans,
        floor=total_rmse(symmetric_part(scans), scans.radiance),
        ladder=ladder,
        fitted=found.predicted,
        load=found.load,
        clean=clean,
        turns=turns,
        turned=turned,
        solution=known,
    )
