"""Spectrum of a planet's star at the planet."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from airlight.physics.spectra.sun import SPECTRA
from airlight.planets.planet import Planet
from airlight.studies.plots.figure import (
    GREY,
    VISIBLE,
    grid,
    new_figure,
    wavelength_ink,
    wavelength_strip,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Range of wavelengths shown of a spectrum with more data. [nm]
_SHOWN: Final = (280.0, 1000.0)


def solar_spectrum(planet: Planet, wavelengths: tuple[float, ...] | None = None) -> Figure:
    """Spectral irradiance of the planet's star, with the visible band in its colours.

    Parameters
    ----------
    planet : Planet
        Planet whose star is shown, at the planet's distance.
    wavelengths : tuple of float, optional
        Wavelengths marked on the curve; default: the planet's. [nm]

    Returns
    -------
    Figure
        One panel; the curve has a point per nanometre.

    References
    ----------
    Atmosphere Plus notes 2, section 1.1.2.
    """
    marks = planet.wavelengths if wavelengths is None else wavelengths
    low = max(_SHOWN[0], planet.star.limits[0])
    high = min(_SHOWN[1], planet.star.limits[1])
    nm = np.unique([*np.arange(np.ceil(low), np.floor(high) + 1.0), low, high])
    figure = new_figure(
        f"{planet.name}: spectrum of its star",
        f"Outside the atmosphere, on a plane that faces the star; {_words(planet)}.",
    )
    axes = figure.add_subplot()
    grid(axes)
    irradiance = planet.star.irradiances(nm)
    peak = float(irradiance.max())
    top = 1.25 * peak
    seen = nm[(nm >= VISIBLE[0]) & (nm <= VISIBLE[1])]
    if seen.size > 1:
        band = axes.fill_between(seen, planet.star.irradiances(seen), color="none")
        picture = axes.imshow(
            wavelength_strip(seen)[None, :, :],
            extent=(float(seen[0]), float(seen[-1]), 0.0, top),
            aspect="auto",
            interpolation="bilinear",
            zorder=1.0,
        )
        picture.set_clip_path(band.get_paths()[0], transform=axes.transData)
    axes.plot(nm, irradiance, color="black", linewidth=0.8, label="spectrum")
    values = planet.star.irradiances(marks)
    for at, value, ink in zip(marks, values, wavelength_ink(marks), strict=True):
        axes.plot([at, at], [0.0, value], color="white", linewidth=3.0)
        axes.plot([at, at], [0.0, value], color=ink, linewidth=1.4)
    axes.scatter(marks, values, c="white", edgecolors="black", s=30.0, zorder=4, label="marks")
    if len(marks) <= 6:
        for at, value in zip(marks, values, strict=True):
            axes.annotate(
                f"{at:.4g} nm\n{value:.4g}",
                (at, value),
                xytext=(at, 1.08 * peak),
                horizontalalignment="center",
                fontsize=9,
                arrowprops={"arrowstyle": "-", "color": GREY, "linewidth": 0.7},
                zorder=5,
            )
    axes.set(
        xlim=(nm[0], nm[-1]),
        ylim=(0.0, top),
        xlabel="wavelength [nm]",
        ylabel="spectral irradiance [W m⁻² nm⁻¹]",
    )
    return figure


def _words(planet: Planet) -> str:
    star = planet.star
    size = f"angular radius {star.angular_radius_degrees:.4g}°"
    if star.spectrum is not None:
        return f"sun by {SPECTRA[star.spectrum]}, {size}"
    if star.temperature is not None:
        return f"black body of {star.temperature:g} K, {size}"
    return f"irradiance as given, {size}"
