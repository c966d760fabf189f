"""Errors of a fitted planet against the solution of the original.

Both are solved by the same solver, so that only the fit causes differences.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from airlight.engines.targets.fits.formula_planet import FormulaPlanet
from airlight.engines.targets.target import ErrorRow, ExportReport
from airlight.image.color_difference import color_difference
from airlight.image.spectral import rgb_weights
from airlight.image.xyz import luminance
from airlight.kernel.threads import Progress
from airlight.solver import solve
from airlight.solver.moments.solution import MomentsSolution
from airlight.solver.solution import Solution

if TYPE_CHECKING:
    from airlight.planets.medium import Medium
    from airlight.planets.planet import Planet

FloatArray = NDArray[np.float64]

#: Zenith angles of the transmittances that are compared. [deg]
ZENITH_ANGLES: Final = (0.0, 75.0, 88.0)
#: Zenith angles of the sun, and zenith angles and azimuths of the views. [deg]
SUNS: Final = (30.0, 75.0, 88.0)
VIEWS: Final = (
    (0.0, 0.0), (45.0, 0.0), (45.0, 90.0), (45.0, 180.0),
    (80.0, 0.0), (80.0, 45.0), (80.0, 90.0), (80.0, 180.0),
)  # fmt: skip
#: Altitude of the observer. [m]
ALTITUDE: Final = 10.0


def fit_errors(
    solution: Solution, fitted: Planet, *, progress: Progress | None = None
) -> tuple[ErrorRow, ...]:
    """Errors of optical depth, of transmittance and of the sky's colour.

    Parameters
    ----------
    solution : Solution
        Solution of the original planet.
    fitted : Planet
        Fitted planet, solved at the same wavelengths with the same settings.
    """
    settings = solution.settings if isinstance(solution, MomentsSolution) else "default"
    fit = solve(fitted, solution.wavelengths, settings, progress=progress)
    return (
        _optical_depth(solution.medium, fit.medium),
        *_transmittances(solution, fit),
        *_colors(solution, fit),
    )


def findings(
    solution: Solution,
    fit: FormulaPlanet,
    held: Planet,
    *,
    notes: tuple[str, ...] = (),
    progress: Progress | None = None,
) -> ExportReport:
    """Export report of a fitted planet.

    Parameters
    ----------
    held : Planet
        Planet as read back from the written file.
    """
    return ExportReport(
        fitted=fit.fitted,
        errors=fit_errors(solution, held, progress=progress),
        notes=(*fit.notes, *notes),
        about={"solar_irradiance_W_m-2_nm-1": solution.medium.solar_irradiance.tolist()},
    )


def _optical_depth(true: Medium, fit: Medium) -> ErrorRow:
    whole, made = (one.vertical_optical_depth.sum(axis=0) for one in (true, fit))
    where = "at " + ", ".join(f"{nm:g}" for nm in true.wavelengths) + " nm"
    return ErrorRow.of("vertical optical depth", made / whole - 1.0, where=where)


def _transmittances(solution: Solution, fit: Solution) -> list[ErrorRow]:
    rows = []
    for angle in ZENITH_ANGLES:
        true, made = (
            one.transmittance(altitude=0.0, view_zenith=angle).values for one in (solution, fit)
        )
        rows.append(
            ErrorRow.of(
                f"transmittance at {angle:g} deg",
                made - true,
                where="from the ground to space",
                measure="absolute",
            )
        )
    return rows


def _colors(solution: Solution, fit: Solution) -> list[ErrorRow]:
    source = solution.lights[0].spectrum
    weights = rgb_weights(solution.wavelengths, source)
    view, azimuth = np.array(VIEWS).T
    rows = []
    for sun in SUNS:
        true, made = (
            one.radiance(altitude=ALTITUDE, sun_zenith=sun, view_zenith=view, azimuth=azimuth)
            for one in (solution, fit)
        )
        sky, shown = true.values @ weights, made.values @ weights
        lit = np.asarray(luminance(sky)) > 0.0
        if lit.any():
            rows.append(
                ErrorRow.of(
                    f"colour of the sky, sun at {sun:g} deg",
                    color_difference(shown[lit], sky[lit]),
                    where=f"{len(VIEWS)} views from the ground, zenith to 10 deg up",
                    measure="delta E 2000",
                )
            )
    return rows
