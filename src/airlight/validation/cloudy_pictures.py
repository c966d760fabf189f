"""Pixels of pictures past cumuli beside radiances of Monte Carlo."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.render.clouds.cloud_deck import CloudDeck
from airlight.render.clouds.clouds_around import CloudsAround
from airlight.render.clouds.layer_geometry import seen_place
from airlight.render.render import render
from airlight.scene import Camera, Scene
from airlight.studies.plots.figure import GREY, PALETTE, grid, new_figure
from airlight.validation.cloudy_lines import (
    LATITUDE,
    LONGITUDE,
    SUN_AZIMUTH,
    SUNS,
    VIEWS,
    WAVELENGTH,
    cumuli_over_sea,
    field_at,
    reference,
)
from airlight.validation.suite import Part, ReportPicture, ReportTable, SuiteRun, Threshold

FloatArray = NDArray[np.float64]

#: Largest median and 95 % of the differences, in which the noise of Monte Carlo is contained. [%]
MEDIAN, MOST = 3.0, 12.0
#: Wavelengths, so close that their colour is the radiance of one. [nm]
_WAVELENGTHS: Final = WAVELENGTH + np.array([-1.0, 0.0, 1.0])
#: Width of a pixel. [deg]
_PIXEL: Final = 0.002


def pixels(run: SuiteRun, quality: str = "preview") -> FloatArray:
    """Radiance of the lines of sight per irradiance of the sun, shape (suns, views). [sr⁻¹]

    Parameters
    ----------
    quality : str
        Quality of planet and boxes.
    """
    solution = run.solve(
        cumuli_over_sea().without_clouds, _WAVELENGTHS, quality, polarisation=False
    )
    field, _ = field_at(_WAVELENGTHS)
    radius = solution.medium.bottom_radius
    green = solution.lights[0].colors()[:, 1].sum()
    found = np.zeros((len(SUNS), len(VIEWS)))
    for i, sun in enumerate(SUNS):
        around: dict[tuple[float, float], CloudsAround] = {}
        for k, (altitude, zenith, azimuth) in enumerate(VIEWS):
            run.step(len(VIEWS) * i + k, found.size, "pixels past cumuli")
            scene = Scene(
                altitude=altitude,
                sun_zenith=sun,
                sun_azimuth=SUN_AZIMUTH,
                latitude=LATITUDE,
                longitude=LONGITUDE,
                camera=Camera(
                    width=1,
                    height=1,
                    field_of_view=_PIXEL,
                    look_zenith=zenith,
                    look_azimuth=azimuth,
                ),
            )
            place = seen_place(field, scene, radius)
            if place not in around:  # views of one place share their light
                deck = CloudDeck(field, lambda nm: field_at(nm)[1], place=place)
                around[place] = CloudsAround((deck,), quality=quality, cache=False)
            frame = render(solution, scene, exact=True, disc=False, clouds=around[place])
            found[i, k] = frame.rgb[0, 0, 1] / green
    return found


def cloudy_pictures(run: SuiteRun) -> tuple[list[Threshold], list[Part]]:
    """Thresholds, and table and picture by view."""
    known, error = reference()
    off = 100.0 * (pixels(run) / known - 1.0)
    noise = 100.0 * error / known
    typical, most = np.quantile(np.abs(off), [0.5, 0.95])
    name, source = "cumuli in air", "Monte Carlo"
    thresholds = [
        Threshold(f"{name}: median error", float(typical), MEDIAN, "%", source),
        Threshold(f"{name}: 95 % of errors", float(most), MOST, "%", source),
    ]
    rows = [
        [
            f"{altitude / 1e3:g} km, {zenith:g}°, {azimuth:g}°",
            *(f"{off[i, k]:+.1f} ± {noise[i, k]:.1f}" for i in range(len(SUNS))),
        ]
        for k, (altitude, zenith, azimuth) in enumerate(VIEWS)
    ]
    table = ReportTable(
        title="Pixels past cumuli in spherical air",
        columns=["observer, view zenith, azimuth from the sun", *(f"sun {sun:g}°" for sun in SUNS)],
        rows=rows,
        note="Preview, 550 nm, ground of albedo 0.06: difference from Monte Carlo and its standard "
        "error. [%]",
    )
    return thresholds, [table, _picture(off, noise)]


def _picture(off: FloatArray, noise: FloatArray) -> ReportPicture:
    title = "Pixels past cumuli: difference from Monte Carlo"
    figure = new_figure(title, size=(8.0, 4.2))
    axes = figure.subplots()
    altitudes = np.array([altitude for altitude, _, _ in VIEWS])
    for number, altitude in enumerate(np.unique(altitudes)):
        views = np.flatnonzero(altitudes == altitude)
        for k in views:
            axes.errorbar(
                np.array(SUNS) + 0.4 * (k - 0.5 * (len(VIEWS) - 1)),
                off[:, k],
                noise[:, k],
                fmt=".",
                color=PALETTE[number],
                elinewidth=0.8,
                label=f"{altitude / 1e3:g} km" if k == views[0] else None,
            )
    for sign in (-1.0, 1.0):
        axes.axhline(sign * MOST, color=GREY, linewidth=0.8, linestyle="--")
    axes.set_xlabel("sun zenith angle [°]; views side by side")
    axes.set_ylabel("difference [%]")
    axes.legend(title="observer", fontsize=8)
    grid(axes)
    caption = "Bars: standard error of Monte Carlo. Dashed: target for 95 % of the differences."
    return ReportPicture.from_figure(figure, title=title, caption=caption)
