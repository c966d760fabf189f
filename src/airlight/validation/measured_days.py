"""Suite ``kider``: measured days, with fitted aerosol load and leave-one-out scores."""

from __future__ import annotations

from pathlib import Path
from typing import Final

import numpy as np

from airlight.studies.fit.pictures import dome_pictures, residual_curves
from airlight.studies.fit.residuals import Residuals
from airlight.validation.kider.day import Day, DayRow, compute_day, day_files
from airlight.validation.kider.planets import PUBLISHED_INPUTS, AngstromLaw
from airlight.validation.kider.scans import MILLI, symmetric_part, total_rmse
from airlight.validation.suite import Cancel, Part, Progress, ReportTable, Suite, Threshold

#: Largest allowed score of the judged row. [mW m⁻² sr⁻¹ nm⁻¹]
BEST_THRESHOLD: Final = 8.0
#: Angle from the sun below which directions are scored separately. [deg]
NEAR: Final = 8.0
#: Zenith angles of the ring near the horizon. [deg]
LOW: Final = (70.0, 80.0)
_UNIT: Final = "mW m⁻² sr⁻¹ nm⁻¹"


def measured_days(
    data: Path, *, quality: str = "default", progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Suite:  # fmt: skip
    """Comparison with all measured days in a folder.

    Parameters
    ----------
    data : Path
        Folder of the files ``kider*.npz``.
    quality : str
        Quality of the solver.
    """
    return suite_of(
        [
            compute_day(file, quality=quality, progress=progress, cancel=cancel)
            for file in day_files(data)
        ]
    )


def suite_of(days: list[Day]) -> Suite:
    """Build the section of the report."""
    return Suite(
        name="kider",
        title="Measured days, load fitted",
        summary=" ".join(_summary(day) for day in days),
        thresholds=[
            Threshold(
                name=f"{day.scans.date}: load fitted, each scan by the fit to the others",
                got=_score(day, day.row), allowed=BEST_THRESHOLD, unit=_UNIT,
                source="the aim for the best physics",
            )
            for day in days
        ],
        parts=[part for day in days for part in _parts(day)],
        settings=[
            f"{day.file.name}: {len(day.scans.time)} scans, {day.scans.view_zenith.shape[1]} "
            f"directions, {day.scans.wavelengths.size} wavelengths"
            for day in days
        ],
    )  # fmt: skip


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
            scale = f"{found.scale:.3f} ± {bars[2]:.3f}" if bars.size > 2 else "1"
        rows.append(
            (
                row.name, depth, exponent, f"{inputs.single_scattering_albedo:g}",
                "AERONET's of the day" if inputs.aeronet_phase else "Cornette-Shanks, g 0.7",
                "3 nm, distance of the day" if inputs.measured_sun else "11.75 nm, 1 au",
                "Peck & Reeder, Bates" if inputs.measured_air else "Penndorf",
                f"{inputs.pressure / 100:.0f}", f"{inputs.ozone:g}", scale,
            )
        )  # fmt: skip
    return ReportTable(
        title=f"{day.scans.date}: parameters of each row, known before its score",
        columns=["row", "τ(550 nm)", "Ångström exponent", "single-scattering albedo",
                 "phase function", "sun", "air", "pressure [hPa]", "ozone [DU]", "scale"],
        rows=rows,
        note="Fitted values with their error bars from scan to scan, from the fit to all scans; "
        "where a scan is left out, it is predicted by a fit that has not seen it. The ground's "
        "albedo is that of all published models.",
    )  # fmt: skip


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
        columns=["row", f"RMSE [{_UNIT}]", f"farther than {NEAR:g}° from the sun"],
        rows=[*rows, ("the measured sky made symmetric", f"{floor:.2f}", "")],
        marks=["ours" if k == day.counted else "" for k in range(len(rows))] + [""],
        note="The highlighted row has the load of the day, fitted to all scans except the "
        "scored scan. The aerosol's albedo, which was not measured, and the instrument's scale "
        "are degenerate.",
    )


def _residuals(day: Day) -> Residuals:
    """Residuals of the scored row."""
    values = day.scans.measurements(day.file.name)
    predicted, known = day.row.predicted.ravel(), day.rows[1].predicted.ravel()
    spread = float(np.sqrt(np.square(predicted - values.radiance).mean()))
    return Residuals(
        measured=values.radiance, predicted=predicted, first=known,
        sigma=np.full(predicted.size, spread), wavelength=values.wavelength,
        view_zenith=values.view_zenith, azimuth=values.azimuth, from_sun=values.angle_from_sun,
        sun_zenith=values.sun_zenith, scan=values.scan, scans=values.scans,
        unit="W m⁻² sr⁻¹ nm⁻¹",
    )  # fmt: skip


def _places(day: Day) -> ReportTable:
    """Fractions of the squared error: the aureole, the lowest ring, the worst wavelength."""
    scans, predicted = day.scans, day.row.predicted
    squares = np.square(predicted - scans.radiance)
    near = scans.angle_from_sun < NEAR
    low = (scans.view_zenith >= LOW[0]) & (scans.view_zenith <= LOW[1]) & ~near
    by_colour = squares.sum(axis=(0, 1))
    worst = int(by_colour.argmax())
    rows = []
    for name, chosen in (
        (f"within {NEAR:g}° of the sun", near),
        (f"view zenith angle {LOW[0]:g}° to {LOW[1]:g}°, not near the sun", low),
        ("the rest of the sky", ~near & ~low),
    ):
        if not chosen.any():
            continue
        ratio = predicted[chosen].sum() / scans.radiance[chosen].sum() - 1.0
        rows.append(
            (
                name, f"{100.0 * chosen.mean():.0f}", f"{100.0 * ratio:+.1f}",
                f"{100.0 * squares[chosen].sum() / squares.sum():.0f}",
            )
        )  # fmt: skip
    ratio = predicted[..., worst].sum() / scans.radiance[..., worst].sum() - 1.0
    rows.append(
        (
            f"the worst wavelength, {scans.wavelengths[worst]:g} nm",
            f"{100.0 / by_colour.size:.0f}", f"{100.0 * ratio:+.1f}",
            f"{100.0 * by_colour[worst] / by_colour.sum():.0f}",
        )
    )  # fmt: skip
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
        f"On {day.scans.date}, with the inputs of all published models: {first:.2f} {_UNIT}; with "
        f"the best known inputs, nothing fitted, {second:.2f}; with the aerosol's load fitted to "
        f"the other scans, the row that counts, {counted:.2f} (optical depth "
        f"{depth} at 550 nm, exponent {exponent})."
    )
