"""Colour-matching functions, and the chromaticities of a planet's sky."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.image.encoding import srgb_encode
from airlight.image.spectral import rgb_weights
from airlight.image.xyz import RGB_TO_XYZ, chromaticity, rgb_to_xyz, xyz_to_rgb
from airlight.physics.spectra.color_matching import cie_1931
from airlight.physics.units import values_in
from airlight.solver.solution import Solution
from airlight.studies.plots.figure import GREY, PALETTE, grid, new_figure, wavelength_words

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FloatArray = NDArray[np.float64]

#: Zenith angles of the sun. [deg]
SUN_ZENITHS: Final = (30.0, 60.0, 80.0, 88.0)
#: Directions in the sky: marker, view zenith angle as a function of the sun's, azimuth. [deg]
_NEAR: Final = 10.0
DIRECTIONS: Final = (("zenith", "o"), ("horizon", "s"), ("near the sun", "^"))
#: View zenith angle of the horizon's colour, at right angles to the sun's azimuth. [deg]
_HORIZON: Final = 88.0
#: Width and height of the picture of all colours. [pixel]
_PICTURE: Final = 320


def sky_chromaticities(solution: Solution, sun_zeniths: Sequence[float]) -> FloatArray:
    """Chromaticities of the sky as seen from the ground.

    Parameters
    ----------
    sun_zeniths : sequence of float, length n
        Zenith angles of the sun, 10 to 180. [deg]

    Returns
    -------
    array, shape (n, 3, 2)
        x, y at the zenith, at the horizon at right angles to the sun's azimuth, and 10° above the
        sun. [1]
    """
    return np.asarray(chromaticity(rgb_to_xyz(_sky_rgb(solution, sun_zeniths))))


def _sky_rgb(solution: Solution, sun_zeniths: Sequence[float]) -> FloatArray:
    sun = values_in(sun_zeniths, "deg", "sun_zeniths")[:, None]
    view = np.concatenate(
        [0.0 * sun, 0.0 * sun + _HORIZON, np.clip(sun - _NEAR, 0.0, _HORIZON)], axis=1
    )
    radiance = solution.radiance(
        altitude=0.0, sun_zenith=sun, view_zenith=view, azimuth=np.array([0.0, 90.0, 0.0])
    )
    weights = rgb_weights(solution.wavelengths, solution.lights[0].spectrum)
    return np.asarray(np.asarray(radiance) @ weights)


def cie(solution: Solution, sun_zeniths: Sequence[float] = SUN_ZENITHS) -> Figure:
    """CIE 1931 matching functions, and the chromaticity diagram with the planet's sky.

    Parameters
    ----------
    solution : Solution
        Solution at three or, more accurately, sixteen wavelengths.
    sun_zeniths : sequence of float
        Zenith angles of the sun, each giving the zenith, the horizon and a point near the sun.
        [deg]

    Returns
    -------
    Figure
        Matching functions; below, the chromaticity diagram with the sRGB triangle, and an enlarged
        part with the colours of the sky.
    """
    name = solution.planet.name if solution.planet is not None else "planet"
    figure = new_figure(
        f"{name}: the sky among all colours",
        f"CIE 1931 2° observer; sky from the ground, {wavelength_words(solution.wavelengths)};\n"
        f"sun zenith angles {', '.join(f'{sun:.3g}' for sun in sun_zeniths)}° along each line, "
        f"the horizon across the sun, {_NEAR:g}° above the sun.",
        size=(8.0, 8.0),
    )
    boxes = figure.add_gridspec(2, 2, height_ratios=[1.0, 1.55])
    _matching_functions(figure.add_subplot(boxes[0, :]))
    whole, part = figure.add_subplot(boxes[1, 0]), figure.add_subplot(boxes[1, 1])
    rgb = _sky_rgb(solution, sun_zeniths)
    points = np.asarray(chromaticity(rgb_to_xyz(rgb)))
    for axes in (whole, part):
        _diagram(axes)
    whole.set(xlim=(-0.05, 0.8), ylim=(0.0, 0.9))
    whole.set_title("all colours", fontsize=10)
    part.set_title("sky, enlarged", fontsize=10)
    center = 0.5 * (points.min(axis=(0, 1)) + points.max(axis=(0, 1)))
    half = max(0.04, 0.65 * float(np.ptp(points, axis=(0, 1)).max()))
    part.set(
        xlim=(center[0] - half, center[0] + half),
        ylim=(center[1] - half, center[1] + half),
    )
    for axes in (whole, part):
        _sky(axes, points, rgb, sun_zeniths, labelled=axes is part)
    (x0, y0), size = center - half, 2.0 * half
    whole.plot(
        [x0, x0 + size, x0 + size, x0, x0], [y0, y0, y0 + size, y0 + size, y0], color=GREY, lw=0.8
    )
    part.legend(loc="upper left", fontsize=8.5, framealpha=0.9)
    for axes in (whole, part):
        axes.set(xlabel="chromaticity x [1]", ylabel="chromaticity y [1]", aspect="equal")
    return figure


def _matching_functions(axes: Any) -> None:
    table = cie_1931()
    grid(axes)
    looks = ((PALETTE[1], "-", "x̄"), (PALETTE[2], "--", "ȳ"), (PALETTE[0], "-.", "z̄"))
    for column, (color, style, label) in zip(table.values.T, looks, strict=True):
        axes.plot(
            table.wavelengths, column, color=color, linestyle=style, linewidth=2.0, label=label
        )
    axes.set(
        xlim=(360.0, 830.0),
        ylim=(0.0, None),
        xlabel="wavelength [nm]",
        ylabel="matching function [1]",
    )
    axes.set_title("matching functions", fontsize=10)
    axes.legend(loc="upper right", framealpha=1.0)


def _diagram(axes: Any) -> None:
    table = cie_1931()
    locus = chromaticity(table.values[(table.wavelengths >= 380.0) & (table.wavelengths <= 700.0)])
    x, y = np.meshgrid(np.linspace(0.0, 0.8, _PICTURE), np.linspace(0.005, 0.9, _PICTURE))
    rgb = np.clip(xyz_to_rgb(np.stack([x, y, 1.0 - x - y], axis=-1)), 0.0, None)
    rgb = rgb / np.maximum(rgb.max(axis=-1, keepdims=True), 1e-9)
    picture = axes.imshow(
        0.35 + 0.65 * srgb_encode(rgb), extent=(0.0, 0.8, 0.005, 0.9), origin="lower",
        aspect="equal", interpolation="bilinear",
    )  # fmt: skip
    (outline,) = axes.fill(*locus.T, facecolor="none", edgecolor="black", linewidth=1.2)
    picture.set_clip_path(outline)
    for nm in (460, 480, 490, 500, 510, 520, 540, 560, 580, 600, 620, 700):
        at = chromaticity(table.at(float(nm)))
        outwards = at - np.array([1.0 / 3.0, 1.0 / 3.0])
        outwards = outwards / np.hypot(*outwards)
        axes.plot(*at, marker=".", color="black", markersize=4)
        axes.annotate(
            f"{nm}", at, xytext=9.0 * outwards, textcoords="offset points", fontsize=7,
            ha="center", va="center", annotation_clip=True,
        )  # fmt: skip
    corners = chromaticity(RGB_TO_XYZ.T)
    axes.plot(*corners[[0, 1, 2, 0]].T, color="black", linewidth=1.2, linestyle="--", label="sRGB")
    white = chromaticity(RGB_TO_XYZ.sum(axis=1))
    axes.plot(*white, marker="+", color="black", markersize=10, linestyle="none", label="D65 white")


def _sky(
    axes: Any, points: FloatArray, rgb: FloatArray, suns: Sequence[float], *, labelled: bool
) -> None:
    """Draw a line per direction, from high to low sun, with markers in the colours of the sky."""
    for k, (position, marker) in enumerate(DIRECTIONS):
        axes.plot(*points[:, k].T, color=GREY, linewidth=1.0)
        peak = np.maximum(rgb[:, k].max(axis=-1, keepdims=True), 1e-300)
        axes.scatter(
            *points[:, k].T,
            c=srgb_encode(np.clip(rgb[:, k] / peak, 0.0, 1.0)),
            marker=marker,
            s=55.0 if labelled else 18.0,
            edgecolors="black",
            linewidths=0.9,
            label=position,
            zorder=4,
        )
    if not labelled:
        return
    apart = 0.06 * max(np.ptp(axes.get_xlim()), np.ptp(axes.get_ylim()))
    taken: list[FloatArray] = []
    for k in range(len(DIRECTIONS)):
        for at, sun in zip(points[:, k], suns, strict=True):
            if all(np.hypot(*(at - other)) > apart for other in taken):
                taken.append(at)
                axes.annotate(
                    f"{sun:.3g}°", at, xytext=(5, -11), textcoords="offset points", fontsize=8
                )
