"""Suite ``kider``: measured days, with fitted aerosol load and leave-one-out scores."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import FileError
from airlight.planets.planet import Planet
from airlight.studies.fit.covariance import FEWEST_SCANS
from airlight.studies.fit.pictures import dome_pictures, residual_curves
from airlight.studies.fit.residuals import Residuals
from airlight.studies.fit.scans import BAND_WIDTH, Scans, read_scan_file
from airlight.validation.kider.fits import AerosolFit, AerosolModel
from airlight.validation.kider.planets import (
    PUBLISHED_INPUTS,
    AngstromLaw,
    Inputs,
    best_inputs,
    planet,
)
from airlight.validation.kider.scans import MILLI, NEAR, UNIT, symmetric_part, total_rmse
from airlight.validation.suite import Part, ReportTable, Suite, SuiteRun, Threshold, cells

FloatArray = NDArray[np.float64]

#: Files of measured days, each with its date in the name.
FILES: Final = "kider*.npz"
#: Largest allowed score of the judged row. [mW m⁻² sr⁻¹ nm⁻¹]
BEST_THRESHOLD: Final = 8.0
#: Zenith angles of the ring near the horizon. [deg]
LOW: Final = (70.0, 80.0)
#: Lobes of the phase function at the start: asymmetries, and weight of the first. [1]
LOBES_START: Final = (0.9, 0.6, 0.15)


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


def measured_days(run: SuiteRun) -> Suite:
    """Comparison with all measured days in a folder.

    Parameters
    ----------
    run : SuiteRun
        With the folder that holds days as ``kider*.npz``.

    Raises
    ------
    FileError
        If there is none, or one cannot be read.
    """
    files = sorted(run.folder.glob(FILES))
    if not files:
        raise FileError(run.folder, f"contains no {FILES}")
    return suite_of([compute_day(run, file) for file in files])


def compute_day(run: SuiteRun, file: Path) -> Day:
    """Compute the rows of a day.

    Parameters
    ----------
    run : SuiteRun
    file : Path
        Scans of the day; a phase function of that day is looked for beside it.

    Raises
    ------
    FileError
        If a file cannot be read.
    """
    scans, data = read_scan_file(file), file.parent
    best = best_inputs(data, scans.date)
    silent, done = replace(run, progress=None), 0

    def step(message: str) -> None:
        nonlocal done
        run.step(done, 5 + len(scans.time), f"{scans.date}, {message}")
        done += 1

    def known(name: str, inputs: Inputs) -> DayRow:
        step(name)
        solution = silent.solve(planet(inputs, scans, data), scans.wavelengths)
        return DayRow(name, inputs, scans.seen(solution))

    def planet_of(inputs: Inputs) -> Planet:
        return planet(inputs, scans, data)

    rows = [
        known("inputs of all published models", PUBLISHED_INPUTS),
        known("best known inputs, nothing fitted", best),
    ]
    step("load fitted")
    model = AerosolModel(run, planet_of, scans, best)
    whole = model.fitted()
    left_out = model.left_out(whole, lambda k: step(f"load fitted, without {scans.time[k]}"))
    step("load and instrument's scale fitted")
    scaled = AerosolModel(run, planet_of, scans, best, with_scale=True).fitted()
    rows += [
        DayRow("load fitted to all scans", best, whole.predicted, whole),
        DayRow("load fitted, the scored scan left out", best, left_out, whole, True),
        DayRow("load and instrument's scale fitted to all scans", best, scaled.predicted, scaled),
    ]
    if len(scans.time) < FEWEST_SCANS:
        return Day(file=file, scans=scans, rows=rows, counted=3)
    step("load and phase function fitted")
    start = replace(best, lobes=LOBES_START)
    shaped = AerosolModel(run, planet_of, scans, start).fitted()
    assert shaped.fitted.left_out is not None
    others = shaped.fitted.left_out.reshape(scans.radiance.shape)
    rows += [
        DayRow("load and phase function fitted to all scans", best, shaped.predicted, shaped),
        DayRow("both fitted, the scored scan left out", best, others, shaped, True),
    ]
    return Day(file=file, scans=scans, rows=rows, counted=6)


def suite_of(days: list[Day]) -> Suite:
    """Build the section of the report."""
    return Suite(
        summary=" ".join(_summary(day) for day in days),
        thresholds=[
            Threshold(
                f"{day.scans.date}: aerosol fitted, each scan by the fit to the others",
                _score(day, day.row),
                BEST_THRESHOLD,
                UNIT,
                "target for the best physics",
            )
            for day in days
        ],
        parts=[part for day in days for part in _parts(day)],
        settings=[
            f"{day.file.name}: {len(day.scans.time)} scans, {day.scans.view_zenith.shape[1]} "
            f"directions, {day.scans.wavelengths.size} wavelengths"
            for day in days
        ],
    )


def _score(day: Day, row: DayRow) -> float:
    return total_rmse(row.predicted, day.scans.radiance)


def _parts(day: Day) -> list[Part]:
    residuals = _residuals(day)
    dome = dome_pictures(residuals, f"{day.scans.date}: residuals over the sky")
    curves = residual_curves(residuals, f"{day.scans.date}: residuals of the highlighted row")
    return [_inputs(day), _scores(day), curves, *([] if dome is None else [dome]), _places(day)]


def _load_text(load: AngstromLaw) -> tuple[str, str]:
    return f"{float(load.optical_depth(550.0)):.4f}", f"{load.alpha:.3f}"


def _inputs(day: Day) -> ReportTable:
    rows = []
    for row in day.rows:
        inputs, found = row.inputs, row.fit
        depth, exponent = _load_text(inputs.load if found is None else found.load)
        scale = "1"
        if found is not None:
            errors = found.fitted.errors
            bars = errors.standard if errors.by_scans is None else errors.by_scans
            depth, exponent = f"{depth} ± {bars[0]:.4f}", f"{exponent} ± {bars[1]:.3f}"
            scale = f"{found.scale:.3f} ± {bars[-1]:.3f}" if found.scale != 1.0 else "1"
        phase = "AERONET's of the day" if inputs.aeronet_phase else "Cornette-Shanks, g 0.7"
        if found is not None and found.inputs.lobes is not None:
            first, second, weight = found.inputs.lobes
            phase = f"lobes of g {first:.3f} (weight {weight:.3f}) and {second:.3f}"
        sun = f"{BAND_WIDTH:g} nm, distance of the day" if inputs.measured_sun else "11.75 nm, 1 au"
        air = "Peck & Reeder, Bates" if inputs.measured_air else "Penndorf"
        rows.append(
            cells(
                f"{row.name} | {depth} | {exponent} | {inputs.single_scattering_albedo:g} | "
                f"{phase} | {sun} | {air} | {inputs.pressure / 100:.0f} | {inputs.ozone:g} | "
                f"{scale}"
            )
        )
    return ReportTable(
        title=f"{day.scans.date}: parameters of each row, known before its score",
        columns=cells(
            "row | τ(550 nm) | Ångström exponent | single-scattering albedo | phase function | "
            "sun | air | pressure [hPa] | ozone [DU] | scale"
        ),
        rows=rows,
        note="Fitted values with their error bars from scan to scan, from the fit to all scans; "
        "where a scan is left out, it is predicted by a fit that has not seen it. The ground's "
        "albedo is that of all published models.",
    )


def _scores(day: Day) -> ReportTable:
    far = day.scans.angle_from_sun >= NEAR
    rows = []
    for row in day.rows:
        rest = np.square(row.predicted - day.scans.radiance)
        rows.append(
            (row.name, f"{_score(day, row):.2f}", f"{MILLI * np.sqrt(rest[far].mean()):.2f}")
        )
    floor = total_rmse(symmetric_part(day.scans), day.scans.radiance)
    return ReportTable(
        title=f"{day.scans.date}: scores",
        columns=["row", f"RMSE [{UNIT}]", f"farther than {NEAR:g}° from the sun"],
        rows=[*rows, ("the measured sky made symmetric", f"{floor:.2f}", "")],
        marks=["ours" if k == day.counted else "" for k in range(len(rows))] + [""],
        note="The highlighted row has the aerosol of the day, fitted to all scans except the "
        "scored scan; load and phase function by the linear model about the fit to all. The "
        "aerosol's albedo, which was not measured, and the instrument's scale are degenerate.",
    )


def _residuals(day: Day) -> Residuals:
    """Residuals of the scored row."""
    values = day.scans.measurements(day.file.name)
    predicted, known = day.row.predicted.ravel(), day.rows[1].predicted.ravel()
    spread = float(np.sqrt(np.square(predicted - values.radiance).mean()))
    return Residuals.of_measurements(values, predicted, known, np.full(predicted.size, spread))


def _places(day: Day) -> ReportTable:
    """Fractions of the squared error: the aureole, the lowest ring, the worst wavelength."""
    scans, predicted = day.scans, day.row.predicted
    squares = np.square(predicted - scans.radiance)
    near = scans.angle_from_sun < NEAR
    low = (scans.view_zenith >= LOW[0]) & (scans.view_zenith <= LOW[1]) & ~near
    by_colour = squares.sum(axis=(0, 1))
    worst = int(by_colour.argmax())
    rows = []

    def add(name: str, share: float, chosen: Any, squared: float) -> None:
        ratio = 100.0 * (predicted[chosen].sum() / scans.radiance[chosen].sum() - 1.0)
        rows.append(cells(f"{name} | {100.0 * share:.0f} | {ratio:+.1f} | {squared:.0f}"))

    for name, chosen in (
        (f"within {NEAR:g}° of the sun", near),
        (f"view zenith angle {LOW[0]:g}° to {LOW[1]:g}°, not near the sun", low),
        ("the rest of the sky", ~near & ~low),
    ):
        if chosen.any():
            add(name, chosen.mean(), chosen, 100.0 * squares[chosen].sum() / squares.sum())
    name = f"the worst wavelength, {scans.wavelengths[worst]:g} nm"
    squared = 100.0 * by_colour[worst] / by_colour.sum()
    add(name, 1.0 / by_colour.size, np.s_[..., worst], squared)
    return ReportTable(
        title=f"{day.scans.date}: where the squared error of the row that counts sits",
        columns=["where", "share of the values [%]", "bias [%]", "share of the squares [%]"],
        rows=rows,
    )


def _summary(day: Day) -> str:
    everybody, known = day.rows[0], day.rows[1]
    found = day.row.fit
    assert found is not None
    assert everybody.inputs == PUBLISHED_INPUTS
    depth, exponent = _load_text(found.load)
    first, second, counted = (_score(day, row) for row in (everybody, known, day.row))
    return (
        f"On {day.scans.date}, with the inputs of all published models: {first:.2f} {UNIT}; with "
        f"the best known inputs, nothing fitted, {second:.2f}; with the aerosol's load fitted to "
        f"the other scans, {_score(day, day.rows[3]):.2f}; the row that counts, "
        f"{day.row.name}, {counted:.2f} (optical depth "
        f"{depth} at 550 nm, exponent {exponent})."
    )
