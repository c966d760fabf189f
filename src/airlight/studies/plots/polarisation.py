"""Polarisation of the sky: along the principal plane, and over the dome."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, Literal

import numpy as np
from numpy.typing import NDArray

from airlight.solver.solution import GREEN, Solution
from airlight.solver.stokes_frame import angle_of_polarisation, degree_of_polarisation
from airlight.studies.observables.neutral_points import neutral_points, principal_plane
from airlight.studies.plots.figure import grid, new_figure, wavelength_curves
from airlight.studies.plots.polarised_picture import COLOR_BARS, angle_colors, color_map

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

FloatArray = NDArray[np.float64]

#: Largest number of wavelengths drawn.
_MOST: Final = 6
#: Numbers of zenith angles and azimuths of half a dome that are solved, and that are drawn.
_SOLVED, _DRAWN = (31, 61), (180, 360)
#: Range of zenith angles of the dome, without the zenith, where azimuth is undefined, and the
#: horizon. [deg]
_HIGHEST, _LOWEST = 0.02, 89.9
#: Zenith angles of the bars, and length of a bar for full polarisation. [deg]
_BARS, _LENGTH = (15.0, 30.0, 45.0, 60.0, 75.0), 16.0


def polarisation_plane(
    solution: Solution, *, sun_zenith: float = 60.0, altitude: float = 0.0
) -> Figure:
    """Degree of polarisation in the plane through sun and zenith, with the neutral points.

    Parameters
    ----------
    solution : Solution
        Solution of polarised light.
    sun_zenith : float
        Zenith angle of the sun, 0 to 180. [deg]
    altitude : float
        Altitude of the observer. [m]

    Returns
    -------
    Figure
        A curve per wavelength, at most six, positive for polarisation normal to the plane, with the
        neutral points and their distances from the sun or the antisolar point.
    """
    view, degree = principal_plane(solution, sun_zenith=sun_zenith, altitude=altitude)
    points = neutral_points(solution, sun_zenith=sun_zenith, altitude=altitude)
    name = solution.planet.name if solution.planet is not None else "planet"
    figure = new_figure(
        f"{name}: polarisation in the plane of sun and zenith",
        f"Sun zenith angle {sun_zenith:.4g}° (dotted), observer at {altitude * 1e-3:.4g} km. "
        "Positive: across the plane; negative: along it.",
    )
    axes: Any = figure.subplots()
    grid(axes)
    curves = wavelength_curves(solution.wavelengths, _MOST)
    for k, style in curves.items():
        axes.plot(view, 100.0 * degree[:, k], **style)
        zeros, ink = [places[k] for places in points.values()], style["color"]
        axes.plot(zeros, np.zeros(len(zeros)), "o", color=ink, markersize=5, zorder=3)
    axes.axhline(0.0, color="black", linewidth=0.8)
    if sun_zenith <= 90.0:
        axes.axvline(sun_zenith, color="black", linewidth=0.8, linestyle=":")
    low, high = axes.get_ylim()
    axes.set(
        xlim=(-90.0, 90.0),
        ylim=(low - 0.22 * (high - low), high),
        xticks=range(-90, 91, 30),
        xlabel="view zenith angle [°], positive towards the sun",
        ylabel="degree of linear polarisation, -Q/I [%]",
    )
    for point, places in points.items():
        places = places[list(curves)]
        if np.isfinite(places).any():
            _name(axes, point, places[np.isfinite(places)], sun_zenith)
    axes.legend(loc="upper right", fontsize=9, framealpha=1.0)
    return figure


def _name(axes: Axes, point: str, places: FloatArray, sun_zenith: float) -> None:
    """Label of a neutral point with the range of its distances."""
    origin = sun_zenith if point in ("Babinet", "Brewster") else sun_zenith - 180.0
    away = np.sort(np.abs(places - origin))
    span = "–".join(dict.fromkeys((f"{away[0]:.0f}", f"{away[-1]:.0f}")))
    low, high = axes.get_ylim()
    at = float(np.mean(places))
    # Brewster's label is below that of the nearby Babinet point
    down = low + (0.13 if point in ("Babinet", "Arago") else 0.03) * (high - low)
    arrow, place = {"arrowstyle": "-", "color": "#777777", "linewidth": 0.7}, (at, 0.0)
    below = (min(max(at, -76.0), 76.0), down)
    axes.annotate(f"{point} {span}°", place, below, ha="center", fontsize=9, arrowprops=arrow)


def polarisation_dome(
    solution: Solution, *, sun_zenith: float = 60.0, altitude: float = 0.0
) -> Figure:
    """Degree and angle of polarisation over the sky, with bars along the plane of polarisation.

    Returns
    -------
    Figure
        Two fisheye domes with the sun's side at the bottom, at the wavelength nearest to 550 nm:
        degree with bars of proportional length, and angle from the meridian plane.
    """
    k = int(np.argmin(np.abs(solution.wavelengths - GREEN)))
    dome = _Dome(solution, k, sun_zenith, altitude)
    zenith = np.linspace(0.0, _LOWEST, _DRAWN[0] + 1)
    azimuth = np.linspace(0.0, 360.0, _DRAWN[1] + 1)
    middle = 0.5 * (zenith[:-1] + zenith[1:])[:, None], 0.5 * (azimuth[:-1] + azimuth[1:])
    stokes = dome.stokes(*np.broadcast_arrays(*middle))
    degree, angle = degree_of_polarisation(stokes), angle_of_polarisation(stokes)
    name = solution.planet.name if solution.planet is not None else "planet"
    figure = new_figure(
        f"{name}: polarised sky at {solution.wavelengths[k]:.4g} nm",
        f"Sun zenith angle {sun_zenith:.4g}°, below in the dome; observer at "
        f"{altitude * 1e-3:.4g} km.",
        size=(8.0, 4.9),
    )
    x, y = _position(zenith[:, None], azimuth)
    panels = figure.subplots(1, 2)
    names: tuple[Literal["dolp", "aolp"], ...] = ("dolp", "aolp")
    for axes, show, values in zip(panels, names, (100.0 * degree, angle), strict=True):
        shown = COLOR_BARS[show]
        mesh = axes.pcolormesh(
            x, y, values, cmap=color_map(show), vmin=shown.low, vmax=shown.high, rasterized=True
        )
        if show == "aolp":
            mesh.set_facecolor(angle_colors(angle).reshape(-1, 3))
        bar = figure.colorbar(mesh, ax=axes, orientation="horizontal", shrink=0.9, pad=0.02)
        bar.set_ticks(list(shown.ticks))
        bar.set_label(_LABELS[show], fontsize=9)
        _dome_lines(axes, sun_zenith)
    _bars(panels[0], dome)
    return figure


#: Labels of the colour bars.
_LABELS: Final = {
    "dolp": "degree of linear polarisation [%]",
    "aolp": "angle from the vertical plane [°]",
}


class _Dome:
    """Polarisation over the sky, interpolated in half a dome and mirrored."""

    def __init__(self, solution: Solution, k: int, sun_zenith: float, altitude: float) -> None:
        from scipy.interpolate import RectBivariateSpline

        zenith = np.linspace(_HIGHEST, _LOWEST, _SOLVED[0])
        azimuth = np.linspace(0.0, 180.0, _SOLVED[1])
        views, turns = np.meshgrid(zenith, azimuth, indexing="ij")
        where: dict[str, Any] = {"view_zenith": views.ravel(), "azimuth": turns.ravel()}
        light = solution.radiance(altitude=altitude, sun_zenith=sun_zenith, stokes=True, **where)
        light = light.isel(wavelength=k)
        whole, *across = (np.asarray(light.sel(stokes=s), np.float64) for s in "IQU")
        lit = np.where(whole > 0.0, whole, np.inf)
        self._shares = [
            RectBivariateSpline(zenith, azimuth, (part / lit).reshape(views.shape), kx=3, ky=3)
            for part in across
        ]

    def stokes(self, zenith: FloatArray, azimuth: FloatArray) -> FloatArray:
        """I, Q and U over I, shape (3, ...)."""
        mirrored = azimuth > 180.0
        turn = np.where(mirrored, 360.0 - azimuth, azimuth)
        q, u = (share.ev(zenith, turn) for share in self._shares)
        return np.stack([np.ones_like(q), q, np.where(mirrored, -u, u)])


def _position(zenith: FloatArray, azimuth: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Position in a dome seen from below: the sun's side at the bottom, azimuth 90 on the right."""
    turn = np.radians(azimuth)
    return zenith * np.sin(turn), -zenith * np.cos(turn)


def _dome_lines(axes: Axes, sun_zenith: float) -> None:
    """Circles of zenith angles, the horizon and the sun."""
    turn = np.linspace(0.0, 2.0 * np.pi, 181)
    for zenith in (30.0, 60.0, 90.0):
        width = 1.0 if zenith == 90.0 else 0.4
        axes.plot(zenith * np.cos(turn), zenith * np.sin(turn), color="black", linewidth=width)
    if sun_zenith <= 90.0:
        axes.plot(0.0, -sun_zenith, "o", color="white", markeredgecolor="black", markersize=7)
    axes.set_aspect("equal")
    axes.set_axis_off()


def _bars(axes: Axes, dome: _Dome) -> None:
    """Bars along the plane of polarisation, of length proportional to the degree."""
    from matplotlib.collections import LineCollection

    places = [(z, a) for z in _BARS for a in np.linspace(0.0, 360.0, round(0.4 * z), False)]
    zenith, azimuth = np.array(places).T
    stokes = dome.stokes(zenith, azimuth)
    half = 0.5 * _LENGTH * degree_of_polarisation(stokes)
    # towards the zenith in the vertical plane; counterclockwise as in the dome
    turn = np.radians(azimuth + angle_of_polarisation(stokes))
    along = np.stack([-np.sin(turn), np.cos(turn)], axis=-1) * half[:, None]
    at = np.stack(_position(zenith, azimuth), axis=-1)
    axes.add_collection(
        LineCollection(
            list(np.stack([at - along, at + along], axis=1)), colors="white", linewidths=1.6
        )
    )
