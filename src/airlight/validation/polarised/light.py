"""Suite ``polarisation``: Stokes parameters against tables, another program and histories."""

from __future__ import annotations

from typing import Final

from airlight.planets import load_planet
from airlight.solver import Solution
from airlight.studies.observables.neutral_points import NEUTRAL_POINTS
from airlight.studies.observables.neutral_points import neutral_points as zeros
from airlight.validation.polarised.flat_air import flat_air
from airlight.validation.polarised.histories import histories
from airlight.validation.polarised.round_air import round_air
from airlight.validation.suite import Part, ReportTable, Suite, SuiteRun, Threshold, cells

#: Distances at which the points are found, from the star or from the point opposite. [deg]
LOWEST, HIGHEST = 10.0, 25.0
#: Preset whose gas is the sky, wavelength [nm] and zenith angles of the sun with the points looked
#: for there.
_PLANET, _WAVELENGTH = "earth-atmosphere-plus", 550.0
_SUNS: Final = ((88.0, ("Arago", "Babinet")), (50.0, ("Babinet", "Brewster")))
_SOURCE: Final = (
    "AMS, Glossary of Meteorology: about 20°; Coulson (1988), Polarization and Intensity of Light "
    "in the Atmosphere: 15° to 25°, nearer to a high sun"
)


def neutral_distances(solution: Solution, sun_zenith: float) -> dict[str, float]:
    """Distances of neutral points from the star or the antisolar point. [deg]

    Parameters
    ----------
    solution : Solution
        Polarised solution; the first wavelength is used.
    sun_zenith : float
        Zenith angle of the star. [deg]

    Returns
    -------
    dict
        ``"Babinet"`` (above the star), ``"Brewster"`` (below it), ``"Arago"`` (above the antisolar
        point); NaN if below the horizon.
    """
    found = zeros(solution, sun_zenith=sun_zenith)
    babinet, brewster, arago = (float(found[name][0]) for name in NEUTRAL_POINTS[:3])
    return {
        "Babinet": sun_zenith - babinet,
        "Brewster": brewster - sun_zenith,
        "Arago": arago - (sun_zenith - 180.0),
    }


def neutral_points(run: SuiteRun) -> tuple[list[Threshold], list[Part]]:
    """Neutral points of a clear sky: where light is not polarised, above and below the star."""
    solution = run.solve(load_planet(_PLANET), (_WAVELENGTH,))
    middle, half = 0.5 * (LOWEST + HIGHEST), 0.5 * (HIGHEST - LOWEST)
    thresholds, rows = [], []
    for sun, names in _SUNS:
        found = neutral_distances(solution, sun)
        for name in names:
            what = f"{name}'s point, sun {sun:g}°: distance from {middle:g}°"
            thresholds.append(Threshold(what, abs(found[name] - middle), half, "°", _SOURCE))
            rows.append(cells(f"{name} | {sun:g} | {found[name]:.1f} | {LOWEST:g} to {HIGHEST:g}"))
    return thresholds, [
        ReportTable(
            title="Neutral points of a clear sky",
            columns=cells("point | sun zenith [°] | distance [°] | published [°]"),
            rows=rows,
            note=f"{_PLANET} at {_WAVELENGTH:g} nm: where Q changes sign in the sun's meridian. "
            "Babinet above the sun, Brewster below it, Arago above the point opposite.",
        )
    ]


def polarisation(run: SuiteRun) -> Suite:
    """Compare polarised light with published values and with vector Monte Carlo.

    Parameters
    ----------
    run : SuiteRun
    """
    thresholds: list[Threshold] = []
    parts: list[Part] = []
    sections = (flat_air, round_air, neutral_points, histories)
    for done, section in enumerate(sections):
        run.step(done, len(sections), section.__name__.replace("_", " "))
        more, shown = section(run)
        thresholds += more
        parts += shown
    return Suite(
        summary=(
            "Radiance I and the Stokes parameters Q and U of skies: flat Rayleigh air against the "
            "corrected Coulson tables, round Rayleigh air against SASKTRAN, air with particles "
            "against vector Monte Carlo, and the neutral points of a clear sky. Energy is "
            "conserved by polarised light in the suite `energy`."
        ),
        thresholds=thresholds,
        parts=parts,
        settings=["point stars; frame and signs: docs/notation.md"],
    )
