"""Phase functions of a planet's constituents."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.planets.constituent import Constituent
from airlight.planets.planet import Planet
from airlight.studies.plots.figure import (
    PALETTE,
    chosen,
    grid,
    look,
    new_figure,
    wavelength_words,
    words,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FloatArray = NDArray[np.float64]

#: Curves of two wavelengths whose relative difference is below this are drawn as one.
_SAME: Final = 0.01
#: Largest number of wavelengths drawn.
_MOST: Final = 4


def phase_functions(planet: Planet, wavelengths: tuple[float, ...] | None = None) -> Figure:
    """Phase functions of all constituents that scatter, polar and Cartesian.

    Parameters
    ----------
    wavelengths : tuple of float, optional
        Wavelengths, at most four; default: the planet's. Phase functions that do not depend on
        wavelength have a single curve. [nm]

    Returns
    -------
    Figure
        Two logarithmic panels: polar, with the light arriving from the left, and over the
        scattering angle. Legends give the mean cosine g.

    References
    ----------
    Atmosphere Plus notes 2, section 1.6.
    """
    nm = planet.wavelengths if wavelengths is None else wavelengths
    planet.check_wavelengths(nm)
    nm = tuple(nm[k] for k in chosen(nm, _MOST))
    scattering = [constituent for constituent in planet.constituents if constituent.scatters]
    if not scattering:
        raise ParameterError("constituents", planet.name, "a planet with a scattering constituent")
    figure = new_figure(
        f"{planet.name}: phase functions",
        f"Integral over all directions 1; at {wavelength_words(nm)} where they differ; "
        "g is the mean cosine.",
        size=(8.0, 5.4),
    )
    polar: Any = figure.add_subplot(1, 2, 1, projection="polar")
    cartesian = figure.add_subplot(1, 2, 2)
    degrees = _angles()
    lowest, highest = np.inf, 0.0
    for index, constituent in enumerate(scattering):
        values = constituent.phase_values(np.cos(np.radians(degrees)), nm)
        means = _mean_cosine(constituent, nm)
        for which, name in _different(constituent.name, values, nm):
            curve = values[:, which]
            label = words(f"{name}, g = {means[which] + 0.0:.3f}")
            style = look(which, PALETTE[index % len(PALETTE)], label)
            both = np.radians(np.concatenate([-degrees[::-1], degrees]))
            polar.plot(both, np.concatenate([curve[::-1], curve]), **style)
            cartesian.plot(degrees, curve, **style)
            lowest = min(lowest, float(curve[curve > 0.0].min()))
            highest = max(highest, float(curve.max()))
    limits = (10.0 ** np.floor(np.log10(lowest)), 10.0 ** np.ceil(np.log10(highest)))
    polar.set_rscale("log")
    polar.set_rlim(0.3 * limits[0], limits[1])
    polar.set_rlabel_position(112.5)
    for label in polar.get_yticklabels():
        label.set_bbox({"boxstyle": "square,pad=0.1", "fc": "white", "ec": "none", "alpha": 0.8})
    polar.set_thetagrids(range(0, 360, 45), [f"{min(a, 360 - a)}°" for a in range(0, 360, 45)])
    polar.tick_params(labelsize=8)
    polar.set_title("phase function [sr⁻¹] over\nscattering angle [°]", fontsize=10)
    grid(cartesian)
    cartesian.set(
        yscale="log",
        ylim=limits,
        xlim=(0.0, 180.0),
        xticks=range(0, 181, 30),
        xlabel="scattering angle [°]",
        ylabel="phase function [sr⁻¹]",
    )
    cartesian.legend(loc="upper right", fontsize=8.5, framealpha=1.0)
    return figure


def _angles() -> FloatArray:
    """Scattering angles, dense around the forward peak. [deg]"""
    return np.concatenate(
        [np.linspace(0.0, 1.0, 41)[:-1] ** 2 * 10.0, np.linspace(10.0, 180.0, 341)]
    )


def _mean_cosine(constituent: Constituent, nm: tuple[float, ...]) -> FloatArray:
    """∫ p·nu over the sphere, by Gauss-Legendre in sin(θ/2), which resolves sharp peaks. [1]"""
    x, weight = np.polynomial.legendre.leggauss(400)
    u, weight = 0.5 * (x + 1.0), 0.5 * weight
    nu = 1.0 - 2.0 * u * u
    return np.asarray(2.0 * np.pi * (weight * 4.0 * u * nu) @ constituent.phase_values(nu, nm))


def _different(name: str, values: FloatArray, nm: tuple[float, ...]) -> list[tuple[int, str]]:
    """Indices of the wavelengths with separate curves, and labels."""
    spread = np.ptp(values, axis=1) / values.mean(axis=1)
    if float(spread.max()) < _SAME:
        return [(0, name)]
    return [(k, f"{name} {at:.4g} nm") for k, at in enumerate(nm)]
