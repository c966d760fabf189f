"""Transmittance to the top of the shell over altitude and direction: surface and map."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.geometry.path import ray_length
from airlight.geometry.shell import horizon_cosine
from airlight.kernel import vectorized
from airlight.physics.units import values_in
from airlight.planets.medium import Medium
from airlight.planets.planet import Planet
from airlight.solver.refracted_geometry import RefractedGeometry
from airlight.solver.tables.columns import columns
from airlight.studies.plots.figure import grid, new_figure, wavelength_words

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FloatArray = NDArray[np.float64]

#: Number of altitudes, and of directions on each side of the horizon.
_SHAPE: Final = (81, 90)
#: Smallest angle of a ray from the horizon, against rounding. [deg]
_BESIDE: Final = 1e-9
#: Contour lines of the map. [1]
_LEVELS: Final = tuple(round(0.1 * k, 1) for k in range(1, 10))
_COLORS: Final[dict[str, Any]] = {"cmap": "cividis", "vmin": 0.0, "vmax": 1.0, "rasterized": True}
_CAPTION: Final = (
    "Mean over {nm}; rays below the horizon (black line) end on the ground, all others in space."
)


def mean_transmittance(medium: Medium, altitude: ArrayLike, view_zenith: ArrayLike) -> FloatArray:
    """Transmittance along rays to space or to the ground, mean over the wavelengths.

    Parameters
    ----------
    altitude, view_zenith : array, shapes that broadcast to (...)
        Altitude within the shell [m]; zenith angle, 0 to 180 [deg].

    Returns
    -------
    array, shape (...)
        [1]

    Examples
    --------
    >>> from airlight.planets import load_planet
    >>> medium = Medium.from_planet(load_planet("earth-atmosphere-plus"), [680, 550, 440])
    >>> f"{float(mean_transmittance(medium, 0.0, 0.0)):.5f}"  # of .940359, .867616, .762310
    '0.85676'
    """
    geometry = RefractedGeometry.of(medium)
    drawn = geometry.medium
    r = np.minimum(medium.bottom_radius + values_in(altitude, "m", "altitude"), medium.top_radius)
    mu = np.cos(np.radians(values_in(view_zenith, "deg", "view_zenith")))
    r, mu = (np.array(one) for one in np.broadcast_arrays(geometry.optical_radius(r), mu))
    length = vectorized(ray_length)(r, mu, drawn.bottom_radius, drawn.top_radius)
    depth = columns(r, mu, length, drawn.bottom_radius, drawn.density) @ drawn.extinction
    return np.asarray(np.exp(-depth).mean(axis=-1))


def horizon_zenith(medium: Medium, altitude: ArrayLike) -> FloatArray:
    """Zenith angle of the visible horizon, at least 90. [deg]

    Parameters
    ----------
    altitude : array, shape (...)
        Altitude of the observer. [m]
    """
    geometry = RefractedGeometry.of(medium)
    r = geometry.optical_radius(medium.bottom_radius + values_in(altitude, "m", "altitude"))
    cosine = vectorized(horizon_cosine)(r, geometry.medium.bottom_radius)
    return np.asarray(np.degrees(np.arccos(cosine)))


def _sheets(medium: Medium) -> tuple[FloatArray, tuple[FloatArray, FloatArray]]:
    """Altitudes (n, 1) [m]; zenith angles above and below the horizon, each (n, k) [deg]."""
    altitude = medium.thickness * np.linspace(0.0, 1.0, _SHAPE[0])[:, None] ** 2
    horizon = horizon_zenith(medium, altitude)
    # Dense towards the horizon, where transmittance has its minimum.
    step = np.linspace(0.0, 1.0, _SHAPE[1]) ** 2
    above = (horizon - _BESIDE) * (1.0 - step[::-1])
    below = horizon + _BESIDE + (180.0 - horizon - _BESIDE) * step
    return altitude, (above, below)


def transmittance_map(planet: Planet, wavelengths: tuple[float, ...] | None = None) -> Figure:
    """Mean transmittance over view zenith angle and altitude, as a map.

    Parameters
    ----------
    wavelengths : tuple of float, optional
        Wavelengths of the mean; default: the planet's. [nm]

    Returns
    -------
    Figure
        One panel with contour lines; two meshes, above and below the horizon, and the horizon.

    References
    ----------
    Atmosphere Plus notes 2, section 1.8.2: the valley follows the horizon.
    """
    medium = _medium(planet, wavelengths)
    altitude, angles = _sheets(medium)
    figure = new_figure(
        f"{planet.name}: mean transmittance",
        _CAPTION.format(nm=wavelength_words(medium.wavelengths)),
    )
    axes = figure.add_subplot()
    grid(axes)
    height = altitude * 1e-3
    mesh: Any = None
    for angle in angles:
        values = mean_transmittance(medium, altitude, angle)
        heights = np.broadcast_to(height, angle.shape)
        mesh = axes.pcolormesh(angle, heights, values, shading="gouraud", **_COLORS)
        lines = axes.contour(angle, heights, values, levels=_LEVELS, colors="white", linewidths=0.6)
        axes.clabel(lines, levels=_LEVELS[::2], fontsize=8, fmt="%.1f")
    axes.plot(horizon_zenith(medium, altitude)[:, 0], height[:, 0], color="black", linewidth=2.0)
    axes.set(
        xlim=(0.0, 180.0),
        ylim=(0.0, medium.thickness * 1e-3),
        xticks=range(0, 181, 30),
        xlabel="view zenith angle [°]",
        ylabel="altitude [km]",
    )
    figure.colorbar(mesh, ax=axes, label="mean transmittance [1]")
    return figure


def transmittance_surface(planet: Planet, wavelengths: tuple[float, ...] | None = None) -> Figure:
    """Mean transmittance over view zenith angle and altitude, as a surface in three dimensions.

    Returns
    -------
    Figure
        One panel; two surfaces, above and below the horizon, and the horizon as a line at the
        transmittance of the rays that just miss the ground.

    References
    ----------
    Atmosphere Plus notes 2, section 1.8.2: the valley follows the horizon.
    """
    medium = _medium(planet, wavelengths)
    altitude, angles = _sheets(medium)
    figure = new_figure(
        f"{planet.name}: mean transmittance",
        _CAPTION.format(nm=wavelength_words(medium.wavelengths)),
        size=(8.0, 6.5),
    )
    axes: Any = figure.add_subplot(projection="3d")
    height = altitude * 1e-3
    for angle in angles:
        values = mean_transmittance(medium, altitude, angle)
        heights, fine = np.broadcast_to(height, angle.shape), {"rcount": 60, "ccount": 60}
        axes.plot_surface(
            angle, heights, values, linewidth=0.0, antialiased=False, **fine, **_COLORS
        )
    above = angles[0]
    axes.plot(
        above[:, -1],
        height[:, 0],
        mean_transmittance(medium, altitude[:, 0], above[:, -1]) + 0.005,
        color="black",
        linewidth=2.0,
        zorder=10,
    )
    axes.set(
        xlim=(0.0, 180.0),
        ylim=(0.0, medium.thickness * 1e-3),
        zlim=(0.0, 1.0),
        xticks=range(0, 181, 30),
        xlabel="view zenith angle [°]",
        ylabel="altitude [km]",
        zlabel="mean transmittance [1]",
    )
    axes.view_init(elev=48.0, azim=-78.0)
    axes.set_box_aspect((1.5, 1.2, 0.8), zoom=1.0)
    return figure


def _medium(planet: Planet, wavelengths: tuple[float, ...] | None) -> Medium:
    return Medium.from_planet(planet, planet.wavelengths if wavelengths is None else wavelengths)
