"""Regions of the weighted power mapping: fraction of a table for each range of views."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.geometry.mappings import power, weighted_power
from airlight.geometry.shell import horizon_cosine
from airlight.planets.planet import Planet
from airlight.studies.plots.figure import new_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FloatArray = NDArray[np.float64]

#: Texels of the view direction whose lines are drawn.
TEXELS: Final = 33
#: The source's colours; letters on the wedges make them readable without colour.
_COLORS: Final = {"U": "#6FA8DC", "L": "#E06666", "S": "#93C47D"}
_WORDS: Final = {"U": "upper air", "L": "lower air", "S": "surface"}


@dataclass(frozen=True, kw_only=True)
class Regions:
    """Mapping of the view direction at one altitude.

    Attributes
    ----------
    altitude : float
        Altitude of the observer. [m]
    horizon : float
        Cosine of the horizon's zenith angle. [1]
    upper, lower, surface : float
        Fractions w_U, w_L, w_S of the axis. [1]
    texel_zeniths : array, shape (TEXELS,)
        Zenith angles of texels, from straight down to straight up. [deg]
    """

    altitude: float
    horizon: float
    upper: float
    lower: float
    surface: float
    texel_zeniths: FloatArray


def regions(planet: Planet, altitude: float) -> Regions:
    """Weighted power mapping with the powers and weights of the notes, at an altitude.

    Parameters
    ----------
    altitude : float
        Altitude of the observer, 0 to the top of the shell. [m]

    Examples
    --------
    >>> from airlight.planets import load_planet
    >>> top = regions(load_planet("earth-atmosphere-plus"), 100e3)
    >>> f"{top.horizon:.6f}", top.upper, top.lower, top.surface
    ('-0.175272', 0.125, 0.625, 0.25)
    """
    if not 0.0 <= altitude <= planet.thickness:
        raise ParameterError("altitude", altitude, f"0 to {planet.thickness:g} m")
    exponent = weighted_power.DEFAULT_POWER
    u = power.altitude_coordinate(altitude, planet.thickness, exponent)
    lower = weighted_power.lower_weight(u, weighted_power.DEFAULT_LOWER_WEIGHT)
    surface = weighted_power.surface_weight(
        u, weighted_power.DEFAULT_SURFACE_SLOPE, weighted_power.DEFAULT_SURFACE_OFFSET
    )
    horizon = horizon_cosine(planet.bottom_radius + altitude, planet.bottom_radius)
    cosines = [
        weighted_power.view_from_coordinate(
            v, horizon, exponent, exponent, exponent, lower, surface
        )[0]
        for v in np.linspace(0.0, 1.0, TEXELS)
    ]
    return Regions(
        altitude=altitude,
        horizon=float(horizon),
        upper=1.0 - lower - surface,
        lower=float(lower),
        surface=float(surface),
        texel_zeniths=np.degrees(np.arccos(np.clip(cosines, -1.0, 1.0))),
    )


def mapping_regions(planet: Planet, altitude: float | None = None) -> Figure:
    """Regions U, L and S of the weighted power mapping on the ground and aloft.

    Parameters
    ----------
    altitude : float, optional
        Altitude of the second panel; default: the top of the shell. [m]

    Returns
    -------
    Figure
        Two half discs, zenith up, with a line for each of 33 texels, and bars with the fraction of
        each region.

    References
    ----------
    Atmosphere Plus notes 2, sections 3.1.4 and 3.1.5; powers and weights of section 3.1.6.
    """
    figure = new_figure(
        f"{planet.name}: regions of the weighted power mapping",
        f"Powers 2, 2, 2; weights 20/32, 4/32, 4/32. Lines: {TEXELS} texels of the view direction.",
        size=(8.0, 6.2),
    )
    boxes = figure.add_gridspec(4, 2, height_ratios=[0.5, 6.0, 0.1, 1.0])
    heights = (0.0, planet.thickness if altitude is None else altitude)
    for column, height in enumerate(heights):
        found = regions(planet, height)
        head = figure.add_subplot(boxes[0, column])
        head.set_axis_off()
        head.text(
            0.5,
            0.5,
            f"h = {height * 1e-3:.5g} km, horizon at {_degrees(found.horizon):.4g}°, "
            rf"$\cos\varphi_H$ = {found.horizon + 0.0:.6f}"
            "\nview zenith angle [°]",
            ha="center",
            va="center",
        )
        wedges: Any = figure.add_subplot(boxes[1, column], projection="polar")
        _draw_wedges(wedges, found)
        bar = figure.add_subplot(boxes[3, column])
        left = 0.0
        for letter, share in (("S", found.surface), ("L", found.lower), ("U", found.upper)):
            bar.barh(0.0, share, left=left, color=_COLORS[letter], edgecolor="black", label=letter)
            if share > 0.03:
                words = f"{letter}\n{share:.4g}"
                bar.text(left + 0.5 * share, 0.0, words, ha="center", va="center", fontsize=9)
            left += share
        bar.set(xlim=(0.0, 1.0), yticks=[], xlabel="view coordinate v [1]")
        bar.spines[["top", "left", "right"]].set_visible(False)
    return figure


def _degrees(cosine: float) -> float:
    return float(np.degrees(np.arccos(cosine)))


def _draw_wedges(axes: Any, found: Regions) -> None:
    horizon = _degrees(found.horizon)
    spans = {"U": (0.0, 90.0), "L": (90.0, horizon), "S": (horizon, 180.0)}
    axes.set_theta_zero_location("N")
    axes.set_theta_direction(-1)
    axes.set_thetalim(0.0, np.pi)
    axes.set_ylim(0.0, 1.0)
    for letter, (first, last) in spans.items():
        axes.bar(
            np.radians(first),
            1.0,
            width=np.radians(last - first),
            align="edge",
            color=_COLORS[letter],
            label=f"{letter} {_WORDS[letter]}",
        )
        if last - first > 4.0:
            axes.text(
                np.radians(0.5 * (first + last)), 0.62, f"{letter}\n{_WORDS[letter]}",
                ha="center", va="center", fontsize=10,
                bbox={"boxstyle": "round,pad=0.15", "fc": "white", "ec": "none", "alpha": 0.85},
                zorder=5,
            )  # fmt: skip
    for zenith in found.texel_zeniths:
        axes.plot(np.radians([zenith, zenith]), [0.0, 1.0], color="black", linewidth=0.5)
    axes.plot(np.radians([horizon, horizon]), [0.0, 1.0], color="black", linewidth=2.0)
    axes.set_yticks([])
    axes.set_thetagrids(range(0, 181, 30))
    axes.grid(False)
