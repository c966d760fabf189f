"""Neutral points of the clear sky, where polarisation vanishes."""

from __future__ import annotations

from typing import Final

from airlight.planets import load_planet
from airlight.solver import Solution
from airlight.studies.observables.neutral_points import NEUTRAL_POINTS
from airlight.studies.observables.neutral_points import neutral_points as zeros
from airlight.validation.published.row import Solve
from airlight.validation.suite import Part, ReportTable, Threshold

#: Distances of the points from the star or from the antisolar point. [deg]
LOWEST, HIGHEST = 10.0, 25.0
#: Preset whose gas scatters the sky's light, wavelength [nm], and zenith angles of the sun with the
#: points sought there.
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


def neutral_points(solve: Solve) -> tuple[list[Threshold], list[Part]]:
    """Thresholds and table of the neutral points.

    Parameters
    ----------
    solve : callable
        See ``published.row.Solve``.
    """
    solution = solve(load_planet(_PLANET), (_WAVELENGTH,), "default")
    thresholds, rows = [], []
    for sun, names in _SUNS:
        found = neutral_distances(solution, sun)
        for name in names:
            distance = found[name]
            middle, half = 0.5 * (LOWEST + HIGHEST), 0.5 * (HIGHEST - LOWEST)
            thresholds.append(
                Threshold(
                    name=f"{name}'s point, sun {sun:g}°: distance from {middle:g}°",
                    got=abs(distance - middle), allowed=half, unit="°", source=_SOURCE,
                )
            )  # fmt: skip
            rows.append((name, f"{sun:g}", f"{distance:.1f}", f"{LOWEST:g} to {HIGHEST:g}"))
    return thresholds, [
        ReportTable(
            title="Neutral points of a clear sky",
            columns=["point", "sun zenith [°]", "distance [°]", "published [°]"],
            rows=rows,
            note=f"{_PLANET} at {_WAVELENGTH:g} nm: where Q changes sign in the sun's meridian. "
            "Babinet above the sun, Brewster below it, Arago above the point opposite.",
        )
    ]
