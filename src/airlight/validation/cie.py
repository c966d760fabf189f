r"""The suite ``cie``: luminance of a clear Earth's sky against the CIE standard clear sky, type 12.

.. math:: \frac{L(Z, \chi)}{L_z} = \frac{f(\chi)\, \varphi(Z)}{f(Z_s)\, \varphi(0)}, \quad
          \varphi(Z) = 1 + a\, e^{b/\cos Z}, \quad
          f(\chi) = 1 + c\,(e^{d\chi} - e^{d\pi/2}) + e \cos^2\chi

with a = -1, b = -0.32, c = 10, d = -3, e = 0.45. A statistical fit to many skies of many days, not
a solution of any equation: no clear sky need follow it.

Source: CIE S 011/ISO 15469:2004, Spatial distribution of daylight: CIE standard general sky;
Darula & Kittler (2002), CIE general sky standard defining luminance distributions, eSim.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.geometry.quadrature import gauss_legendre
from airlight.image.spectral import default_wavelengths, rgb_weights
from airlight.image.xyz import luminance
from airlight.planets import Constituent, Planet, load_planet, replace
from airlight.solver import Solution
from airlight.studies.plots.figure import GREY, PALETTE, grid, new_figure
from airlight.validation.metrics import log_ratio_rms
from airlight.validation.suite import ReportPicture, ReportTable, Suite, SuiteRun, cells

FloatArray = NDArray[np.float64]

#: Coefficients of type 12, "CIE standard clear sky, low luminance turbidity". [1], d per radian
A: Final = -1.0
B: Final = -0.32
C: Final = 10.0
D: Final = -3.0
E: Final = 0.45
#: Zenith angles of the sun. [deg]
SUNS: Final = (10.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 85.0)
#: Zenith angles of views in the principal plane; negative is away from the sun. [deg]
PLANE: Final = np.linspace(-89.0, 89.0, 179)
#: Angle from the sun within which the fit is not compared. [deg]
NEAR_SUN: Final = 10.0
#: Factors by which the planet's aerosol is multiplied.
AEROSOL: Final = (0.5, 1.0, 2.0, 4.0)
#: Quadrature points over the dome: zenith cosines, azimuths over half a turn.
_DOME: Final = (40, 36)

_FIT: Final = (
    "The CIE sky is a statistical fit: the mean of many measured clear skies, in five numbers that "
    "depend on no sun height and no aerosol. It describes no individual sky. A difference is "
    "therefore reported without a threshold; the other suites test the solvers."
)


def gradation(cosine: ArrayLike) -> FloatArray:
    """Gradation φ from zenith to horizon; 1 at the horizon. [1]

    Parameters
    ----------
    cosine : array, shape (...)
        Cosine of the view's zenith angle, 0 to 1. [1]
    """
    mu = np.asarray(cosine, dtype=float)
    return np.asarray(1.0 + A * np.exp(B / np.maximum(mu, 1e-300)))


def indicatrix(angle: ArrayLike) -> FloatArray:
    """Indicatrix f, which brightens towards the sun; 1 at a right angle. [1]

    Parameters
    ----------
    angle : array, shape (...)
        Angle χ between view and sun. [rad]
    """
    chi = np.asarray(angle, dtype=float)
    bright = C * (np.exp(D * chi) - np.exp(0.5 * D * np.pi))
    return np.asarray(1.0 + bright + E * np.square(np.cos(chi)))


def angle_to_sun(sun_zenith: ArrayLike, view_zenith: ArrayLike, azimuth: ArrayLike) -> FloatArray:
    """Angle χ between view and sun.

    Parameters
    ----------
    sun_zenith, view_zenith, azimuth : array, shapes that broadcast to (...)
        [deg]

    Returns
    -------
    array, shape (...)
        [rad]

    Examples
    --------
    >>> float(np.degrees(angle_to_sun(60.0, 30.0, 180.0)).round(9))
    90.0
    """
    sun, view, around = (np.radians(x) for x in (sun_zenith, view_zenith, azimuth))
    cosine = np.cos(sun) * np.cos(view) + np.sin(sun) * np.sin(view) * np.cos(around)
    return np.asarray(np.arccos(np.clip(cosine, -1.0, 1.0)))


def relative_luminance(
    sun_zenith: ArrayLike, view_zenith: ArrayLike, azimuth: ArrayLike
) -> FloatArray:
    """Luminance of the sky over that of its zenith.

    Parameters
    ----------
    sun_zenith, view_zenith : array, shapes that broadcast to (...)
        0 to 90. [deg]
    azimuth : array
        Azimuth between view and sun. [deg]

    Returns
    -------
    array, shape (...)
        [1]

    Examples
    --------
    >>> relative_luminance(60.0, [60.0, 0.0, 60.0], [180.0, 0.0, 0.0]).round(3).tolist()
    [1.236, 1.0, 13.479]
    """
    chi = angle_to_sun(sun_zenith, view_zenith, azimuth)
    here = indicatrix(chi) * gradation(np.cos(np.radians(view_zenith)))
    zenith = indicatrix(np.radians(sun_zenith)) * gradation(1.0)
    return np.asarray(here / zenith)


def cie(run: SuiteRun, planet: str = "earth") -> Suite:
    """Comparison of the Earth's clear sky with the CIE standard.

    Parameters
    ----------
    run : SuiteRun
    planet : str
        Name of a preset, or path of a file.
    """
    earth = load_planet(planet)
    nm = default_wavelengths(16, *earth.wavelength_limits)
    solution = run.solve(earth, nm)
    weights = rgb_weights(nm)
    rows, plane = [], []
    for done, sun in enumerate(SUNS):
        run.step(done, len(SUNS), f"sun {sun:g}°")
        ours = plane_luminance(solution, weights, sun)
        fit = relative_luminance(sun, np.abs(PLANE), np.where(PLANE < 0.0, 180.0, 0.0))
        counted = np.abs(PLANE - sun) >= NEAR_SUN
        in_plane = log_ratio_rms(ours[counted], fit[counted])
        over_dome, bias, worst = dome_difference(solution, weights, sun)
        plane.append((sun, ours, fit))
        rows.append(
            cells(
                f"{sun:g} | {in_plane:.3f} | {100 * np.expm1(in_plane):.0f} | {over_dome:.3f} | "
                f"{100 * np.expm1(over_dome):.0f} | {100 * np.expm1(bias):+.0f} | {worst}"
            )
        )
    table = ReportTable(
        title="Logarithm of airlight over the fit, root mean square",
        columns=cells(
            "sun zenith [°] | principal plane [ln] | as a factor [%] | whole dome [ln] | "
            "as a factor [%] | mean over the dome [%] | where the dome differs most"
        ),
        rows=rows,
        note=f"Luminance over that of the zenith; within {NEAR_SUN:g}° of the sun left out. The "
        "principal plane has one view a degree, the dome is weighted by solid angle.",
    )
    return Suite(
        summary=(
            "Luminance of the sky over that of the zenith, of the solved Earth and of the CIE "
            "standard clear sky with low turbidity. " + _FIT
        ),
        parts=[table, _curves(earth, plane), _by_aerosol(run, earth, nm)],
        settings=[
            f"planet {earth.name}, ground observer",
            f"{nm.size} wavelengths, {nm[0]:g} to {nm[-1]:g} nm, CIE 1931 luminosity",
            f"moments, {run.quality} quality",
        ],
    )


def with_aerosol(planet: Planet, factor: float) -> Planet:
    """Planet with scaled coefficients of the constituent "aerosol"."""

    def thicker(constituent: Constituent) -> Constituent:
        if constituent.name != "aerosol":
            return constituent
        return replace(constituent, amount=factor * constituent.amount)

    return replace(planet, constituents=tuple(thicker(one) for one in planet.constituents))


def _by_aerosol(run: SuiteRun, earth: Planet, nm: FloatArray) -> ReportTable:
    """Comparison under more and less aerosol, the main cause of differences."""
    weights = rgb_weights(nm)
    rows = []
    for done, factor in enumerate(AEROSOL):
        run.step(done, len(AEROSOL), f"{factor:g} times the aerosol")
        solution = run.solve(with_aerosol(earth, factor), nm)
        found = [dome_difference(solution, weights, sun) for sun in (30.0, 60.0, 80.0)]
        means = [f"{100 * np.expm1(bias):+.0f}" for _, bias, _ in found]
        rows.append([f"{factor:g}", *(f"{rms:.3f}" for rms, _, _ in found), *means])
    return ReportTable(
        title="How much hangs on the aerosol",
        columns=cells(
            "times the aerosol | dome, sun 30° [ln] | sun 60° | sun 80° | mean, sun 30° [%] | "
            "sun 60° | sun 80°"
        ),
        rows=rows,
        note="Root mean square over the dome, and the mean, with all of the aerosol's coefficients "
        "multiplied. The fit knows no aerosol: how clear its sky is meant to be shows here.",
    )


def sky_luminance(
    solution: Solution, weights: FloatArray, sun: float, view: FloatArray, azimuth: FloatArray
) -> FloatArray:
    """Luminance of the sky from the ground, per 683 lm/W.

    Parameters
    ----------
    weights : array, shape (nl, 3)
        Weights from ``rgb_weights``. [nm]
    sun : float
        [deg]
    view, azimuth : array, shape (n,)
        [deg]

    Returns
    -------
    array, shape (n,)
        [W m⁻² sr⁻¹]
    """
    radiance = solution.radiance(altitude=0.0, sun_zenith=sun, view_zenith=view, azimuth=azimuth)
    return np.asarray(luminance(radiance.values @ weights), dtype=float)


def plane_luminance(solution: Solution, weights: FloatArray, sun: float) -> FloatArray:
    """Luminance along ``PLANE`` over that of the zenith, shape (179,). [1]"""
    azimuth = np.where(PLANE < 0.0, 180.0, 0.0)
    values = sky_luminance(solution, weights, sun, np.abs(PLANE), azimuth)
    return np.asarray(values / values[np.argmin(np.abs(PLANE))])


def dome_difference(
    solution: Solution, weights: FloatArray, sun: float
) -> tuple[float, float, str]:
    """RMS and mean of the log ratio over the dome, and a description of its largest value."""
    mu_rule, phi_rule = gauss_legendre(_DOME[0]), gauss_legendre(_DOME[1])
    mu, phi = np.meshgrid(mu_rule.nodes, 180.0 * phi_rule.nodes, indexing="ij")
    solid_angle = np.outer(mu_rule.weights, phi_rule.weights).ravel()
    view, azimuth = np.degrees(np.arccos(mu)).ravel(), phi.ravel()
    zenith = sky_luminance(solution, weights, sun, np.zeros(1), np.zeros(1))
    ours = sky_luminance(solution, weights, sun, view, azimuth) / zenith
    fit = relative_luminance(sun, view, azimuth)
    counted = angle_to_sun(sun, view, azimuth) >= np.radians(NEAR_SUN)
    ratio = np.where(counted, np.log(ours / fit), 0.0)
    rms = log_ratio_rms(ours[counted], fit[counted], solid_angle[counted])
    mean = float((solid_angle * ratio)[counted].sum() / solid_angle[counted].sum())
    at = int(np.argmax(np.abs(ratio)))
    where = f"view {view[at]:.0f}°, azimuth {azimuth[at]:.0f}°: {100 * np.expm1(ratio[at]):+.0f} %"
    return rms, mean, where


def _curves(earth: Planet, plane: list[tuple[float, FloatArray, FloatArray]]) -> ReportPicture:
    title = f"Sky luminance in the principal plane: {earth.name} and CIE type 12"
    figure = new_figure(title, size=(9.5, 5.6))
    panels = figure.subplots(2, 4, sharex=True, sharey=True).ravel()
    for axes, (sun, ours, fit) in zip(panels, plane, strict=True):
        axes.axvspan(sun - NEAR_SUN, sun + NEAR_SUN, color="#eeeeee")
        axes.plot(PLANE, fit, "--", color=PALETTE[1], linewidth=1.4, label="CIE type 12")
        axes.plot(PLANE, ours, color=PALETTE[0], linewidth=1.4, label="airlight")
        axes.set_yscale("log")
        axes.set_ylim(0.2, 100.0)
        axes.set_yticks([0.3, 1.0, 3.0, 10.0, 30.0, 100.0], ["0.3", "1", "3", "10", "30", "100"])
        axes.set_xticks([-90.0, -45.0, 0.0, 45.0, 90.0])
        axes.text(0.03, 0.93, f"sun {sun:g}°", transform=axes.transAxes, color=GREY, va="top")
        grid(axes)
    figure.supylabel("luminance over the zenith's", fontsize=10)
    figure.supxlabel("zenith angle of the view, negative away from the sun [°]", fontsize=10)
    panels[0].legend(loc="upper right", fontsize=8)
    caption = f"Grey: within {NEAR_SUN:g}° of the sun, which is left out of the numbers."
    return ReportPicture.from_figure(figure, title=title, caption=caption)
