"""Suite ``energy``: conservation of energy, and reciprocity."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from math import pi
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.quadrature import gauss_legendre
from airlight.solver import Solution
from airlight.studies.plots.figure import PALETTE, grid, new_figure
from airlight.validation.order_convergence import ORDER_SOLVERS, order_convergence
from airlight.validation.planets import VAST, flat_earth, furnace, round_earth
from airlight.validation.reference_earth import WAVELENGTHS
from airlight.validation.suite import (
    Mark,
    Part,
    ReportPicture,
    ReportTable,
    Suite,
    SuiteRun,
    Threshold,
    cells,
)

FloatArray = NDArray[np.float64]

#: Allowed imbalance of the fluxes of a furnace, relative to the incoming light. [1]
FURNACE_THRESHOLD: Final = 0.005
#: Allowed imbalance for an absorbing atmosphere, and for reversed paths; equal to the furnace's,
#: for lack of another authority.
BALANCE_THRESHOLD: Final = 0.005
RECIPROCITY_THRESHOLD: Final = 0.005
#: Edges of the quadrature in the cosine of the star's zenith angle, dense around the terminator.
_SUN_EDGES: Final = (-1.0, -0.4, -0.2, -0.1, -0.03, 0.0, 0.03, 0.1, 0.3, 1.0)
#: Edges of the quadrature in altitude, with three points per interval. [m]
_HEIGHT_EDGES: Final = (0.0, 1.5e3, 4e3, 10e3, 25e3, 40e3, 100e3)
#: Sun zenith angles over the flat Earth, and zenith angles of suns and views for reversed paths.
#: [deg]
SUNS: Final = (0.0, 30.0, 60.0, 75.0, 85.0)
REVERSED: Final = (0.0, 20.0, 40.0, 60.0, 75.0, 85.0)
#: Quadrature points per piece, in view and in azimuth.
_VIEWS, _AZIMUTHS = 8, 6
#: Levels of the furnace. [m]
LEVELS: Final = (0.0, 2e3, 20e3, 100e3)


def energy(run: SuiteRun, order_solvers: Sequence[tuple[str, Any]] = ORDER_SOLVERS) -> Suite:
    """Energy balances of furnaces and Earths, and convergence of the orders.

    Parameters
    ----------
    run : SuiteRun
    order_solvers : sequence of (str, object)
        Solvers that keep their orders apart, with their qualities.
    """
    thresholds: list[Threshold] = []
    parts: list[Part] = []
    steps = (
        ("white furnace", white_furnace),
        ("grey furnaces", grey_furnaces),
        ("round Earth", round_balance),
        ("flat Earth", flat_balance),
    )
    for done, (name, step) in enumerate(steps):
        run.step(done, len(steps) + 1, name)
        more, shown = step(run)
        thresholds += more
        parts += shown
    parts += order_convergence(run, order_solvers)
    return Suite(
        summary=(
            "Light is neither made nor lost. In the white furnace nothing absorbs and the ground "
            "returns everything: through every sphere as much leaves as enters. On an Earth that "
            "absorbs, what enters at the top is what leaves there, what the ground keeps and what "
            "the air absorbs, each from its own quadrature of radiances. Where the ground is flat, "
            "sun and observer can change places. The orders of scattering fall by a nearly "
            "constant factor."
        ),
        thresholds=thresholds,
        parts=parts,
        settings=[f"moments, {run.quality} quality, 680, 550, 440 nm, point star"],
    )


class Fluxes(NamedTuple):
    """Diffuse fluxes at a level per irradiance of the star, shape (suns, wavelengths). [1]

    ``down`` and ``up`` are horizontal irradiances, ``scalar`` is the radiance integrated over the
    sphere.
    """

    down: FloatArray
    up: FloatArray
    scalar: FloatArray


def pieces(edges: Sequence[float], count: int) -> tuple[FloatArray, FloatArray]:
    """Composite Gauss-Legendre points and weights between edges.

    Parameters
    ----------
    edges : sequence of float
        Edges, ascending.
    count : int
        Points per piece.

    Examples
    --------
    >>> x, w = pieces([0.0, 1.0, 3.0], 2)
    >>> f"{w @ x**3:.10f}"  # 81/4
    '20.2500000000'
    """
    rule = gauss_legendre(count)
    points = [a + (b - a) * rule.nodes for a, b in pairwise(edges)]
    weights = [(b - a) * rule.weights for a, b in pairwise(edges)]
    return np.concatenate(points), np.concatenate(weights)


def level_fluxes(solution: Solution, altitude: float, mu_s: FloatArray) -> Fluxes:
    """Diffuse fluxes at a level.

    Gauss-Legendre quadrature in pieces: split at the horizon and at the horizontal, and finer in
    azimuth near the star.

    Parameters
    ----------
    solution : Solution
        Solution.
    altitude : float
        [m]
    mu_s : array, shape (n,)
        Cosines of the star's zenith angle at that altitude. [1]
    """
    bottom, top = solution.medium.bottom_radius, solution.medium.top_radius
    r = min(bottom + altitude, top)
    horizon = -float(np.sqrt(max((r - bottom) * (r + bottom), 0.0))) / r
    mu, w_mu = pieces(sorted({-1.0, horizon, 0.0, 0.05, 0.2, 1.0}), _VIEWS)
    phi, w_phi = pieces([0.0, 0.15 * pi, 0.5 * pi, pi], _AZIMUTHS)
    sun, view, around = np.meshgrid(mu_s, mu, phi, indexing="ij")
    radiance = solution.radiance(
        altitude=altitude,
        sun_zenith=np.degrees(np.arccos(sun)),
        view_zenith=np.degrees(np.arccos(view)),
        azimuth=np.degrees(around),
    ).values
    relative = radiance / solution.medium.solar_irradiance
    over_phi = 2.0 * np.einsum("smpw,p->smw", relative, w_phi)
    return Fluxes(
        down=np.einsum("smw,m->sw", over_phi, w_mu * np.maximum(mu, 0.0)),
        up=np.einsum("smw,m->sw", over_phi, w_mu * np.maximum(-mu, 0.0)),
        scalar=np.einsum("smw,m->sw", over_phi, w_mu),
    )


def star_through(solution: Solution, altitude: float, mu_s: FloatArray) -> FloatArray:
    """Transmittance to the star, 0 behind the planet, shape (suns, wavelengths). [1]"""
    zenith = np.degrees(np.arccos(mu_s))
    return np.asarray(solution.transmittance(altitude=altitude, view_zenith=zenith).values)


def absorbed_by_air(
    solution: Solution, altitudes: FloatArray, mu_s: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Absorbed power at some levels, per volume and irradiance of the star.

    Parameters
    ----------
    altitudes : array, shape (n,)
        [m]
    mu_s : array, shape (m,)
        Cosines of the star's zenith angle. [1]

    Returns
    -------
    absorbed, coefficient : array, shapes (n, m, nl), (n, nl)
        Absorbed power, and absorption coefficient. [m⁻¹]
    """
    medium = solution.medium
    coefficient = medium.density.at(altitudes).T @ medium.absorption
    light = np.stack(
        [
            level_fluxes(solution, float(h), mu_s).scalar + star_through(solution, float(h), mu_s)
            for h in altitudes
        ]
    )
    return coefficient[:, None, :] * light, coefficient


def _largest(name: str, errors: FloatArray, threshold: float, source: str) -> Threshold:
    return Threshold(name, 100.0 * float(np.abs(errors).max()), 100.0 * threshold, "%", source)


def _percent(errors: FloatArray) -> list[str]:
    return [f"{100.0 * error:+.3f}" for error in errors]


def _marks(errors: FloatArray, threshold: float) -> list[Mark]:
    return ["pass" if bool((np.abs(row) <= threshold).all()) else "fail" for row in errors]


def net_gain(solution: Solution, altitude: float) -> FloatArray:
    """Net outward flux of a sphere over the starlight on its cross-section, shape (nl,). [1]"""
    mu_s, weight = pieces(_SUN_EDGES, 6)
    flux = level_fluxes(solution, altitude, mu_s)
    direct = mu_s[:, None] * star_through(solution, altitude, mu_s)
    # Averaged over the sphere (half of ∫ dmu_s), times its surface 4πr², over its disc πr².
    return np.asarray(2.0 * weight @ (flux.up - flux.down - direct))


def white_furnace(run: SuiteRun) -> tuple[list[Threshold], list[Part]]:
    """White furnace test: conservative atmosphere over ground of albedo 1."""
    solution = run.solve(furnace(1.0), WAVELENGTHS)
    gain = np.stack([net_gain(solution, level) for level in LEVELS])
    table = ReportTable(
        title="White furnace: light gained by spheres about the centre",
        columns=["altitude [km]", *(f"optical depth of {nm:g} nm [%]" for nm in WAVELENGTHS)],
        rows=[
            (f"{level / 1e3:g}", *_percent(row)) for level, row in zip(LEVELS, gain, strict=True)
        ],
        marks=_marks(gain, FURNACE_THRESHOLD),
        note="(leaving - entering) over the starlight on the sphere's disc; 0 is right. Gas and "
        "haze of albedo 1 over a ground of albedo 1, by quadrature of the radiance at every level.",
    )
    name, source = (
        "white furnace: largest gain or loss of a sphere",
        "accuracy that counts as done, energy",
    )
    return [_largest(name, gain, FURNACE_THRESHOLD, source)], [table]


def _entered_and_kept(solution: Solution) -> tuple[FloatArray, FloatArray]:
    """Net flux into the top, and the part absorbed by the ground. [1]"""
    medium = solution.medium
    mu_s, weight = pieces(_SUN_EDGES, 6)
    entered = -net_gain(solution, medium.thickness)
    ground = solution.irradiance(altitude=0.0, sun_zenith=np.degrees(np.arccos(mu_s)))
    received = (ground["direct"] + ground["diffuse"]).values / medium.solar_irradiance
    share = (medium.bottom_radius / medium.top_radius) ** 2
    return entered, (1.0 - medium.ground_albedo) * 2.0 * (weight @ received) * share


def grey_furnaces(run: SuiteRun) -> tuple[list[Threshold], list[Part]]:
    """Grey furnace test: conservative atmosphere over absorbing ground."""
    albedos = (0.0, 0.3, 0.8)
    rows, errors = [], []
    for albedo in albedos:
        entered, kept = _entered_and_kept(run.solve(furnace(albedo), WAVELENGTHS))
        errors.append(entered - kept)
        words = [f"{100 * a:.3f} - {100 * b:.3f}" for a, b in zip(entered, kept, strict=True)]
        rows.append((f"{albedo:g}", *words, *_percent(entered - kept)))
    gain = np.stack(errors)
    table = ReportTable(
        title="Furnaces with a grey ground: what enters is what the ground keeps",
        columns=[
            "ground albedo",
            *(
                f"{what}, {nm:g} nm [%]"
                for what in ("entered - kept", "difference")
                for nm in WAVELENGTHS
            ),
        ],
        rows=rows,
        marks=_marks(gain, BALANCE_THRESHOLD),
        note="Over the starlight on the shell's disc. What enters comes from radiances at the top, "
        "what the ground keeps from the irradiance.",
    )
    name = "grey furnaces: largest difference of entering and kept"
    return [_largest(name, gain, BALANCE_THRESHOLD, "conservation of energy")], [table]


def round_balance(run: SuiteRun) -> tuple[list[Threshold], list[Part]]:
    """Global energy balance of an Earth with absorbing atmosphere."""
    solution = run.solve(round_earth(), WAVELENGTHS)
    medium = solution.medium
    entered, kept = _entered_and_kept(solution)
    heights, height_weight = pieces(_HEIGHT_EDGES, 3)
    mu_s, weight = pieces(_SUN_EDGES, 6)
    per_volume, _ = absorbed_by_air(solution, heights, mu_s)
    shells = height_weight * np.square((medium.bottom_radius + heights) / medium.top_radius)
    air = 2.0 * np.einsum("h,s,hsw->w", shells, weight, per_volume)
    error = entered - kept - air
    table = ReportTable(
        title="Round Earth: what enters is what ground and air absorb",
        columns=["", *(f"{nm:g} nm [%]" for nm in WAVELENGTHS)],
        rows=[
            ("enters and does not leave", *(f"{100 * x:.3f}" for x in entered)),
            ("kept by the ground", *(f"{100 * x:.3f}" for x in kept)),
            ("absorbed by the air", *(f"{100 * x:.3f}" for x in air)),
            ("difference", *_percent(error)),
        ],
        marks=["", "", "", *_marks(error[None], BALANCE_THRESHOLD)],
        note="Over the starlight on the shell's disc.",
    )
    name = "round Earth: difference of entering and absorbed"
    return [_largest(name, error, BALANCE_THRESHOLD, "conservation of energy")], [table]


def flat_balance(run: SuiteRun) -> tuple[list[Threshold], list[Part]]:
    """Energy balance of a plane-parallel Earth at each sun elevation, and reciprocity."""
    solution = run.solve(flat_earth(), WAVELENGTHS)
    medium = solution.medium
    mu_s = np.cos(np.radians(SUNS))
    heights, height_weight = pieces(_HEIGHT_EDGES, 3)
    per_volume, _ = absorbed_by_air(solution, heights, mu_s)
    air = np.einsum("h,hsw->sw", height_weight, per_volume)
    out = level_fluxes(solution, medium.thickness, mu_s).up
    ground = solution.irradiance(altitude=0.0, sun_zenith=list(SUNS))
    received = (ground["direct"] + ground["diffuse"]).values / medium.solar_irradiance
    kept = (1.0 - medium.ground_albedo) * received
    error = (out + air + kept) / mu_s[:, None] - 1.0
    rows = [
        (
            f"{sun:g}",
            *(_triple(part[k] / mu_s[k]) for part in (out, air, kept)),
            " ".join(_percent(error[k])),
        )
        for k, sun in enumerate(SUNS)
    ]
    table = ReportTable(
        title="Flat Earth: outgoing + absorbed against incoming, by sun height",
        columns=cells(
            "sun zenith [°] | out, 680 550 440 nm [%] | absorbed by the air [%] | "
            "kept by the ground [%] | sum less incoming [%]"
        ),
        rows=rows,
        marks=_marks(error, BALANCE_THRESHOLD),
        note=f"The Earth above with {VAST:g} times its radius, so that no light moves sideways.",
    )
    off, reversed_paths = _reversed(solution)
    conservation = "conservation of energy"
    thresholds = [
        _largest("flat Earth: largest difference", error, BALANCE_THRESHOLD, conservation),
        _largest("reversed paths: largest difference", off, RECIPROCITY_THRESHOLD, "reciprocity"),
    ]
    return thresholds, [table, _shares(mu_s, out, air, kept), reversed_paths]


def _triple(values: FloatArray) -> str:
    return " ".join(f"{100 * value:.3f}" for value in values)


def _shares(mu_s: FloatArray, out: FloatArray, air: FloatArray, kept: FloatArray) -> ReportPicture:
    title = "Where the light goes over a flat clear Earth"
    figure = new_figure(title, size=(9.0, 3.6))
    for k, axes in enumerate(figure.subplots(1, 3, sharey=True)):
        at, below = np.arange(mu_s.size), np.zeros(mu_s.size)
        for part, name, colour in (
            (kept, "kept by the ground", PALETTE[2]),
            (air, "absorbed by the air", PALETTE[1]),
            (out, "out to space", PALETTE[5]),
        ):
            share = 100.0 * part[:, k] / mu_s
            axes.bar(at, share, bottom=below, color=colour, width=0.7, label=name)
            below = below + share
        axes.axhline(100.0, color="black", linewidth=0.8)
        axes.set_xticks(at, [f"{sun:g}°" for sun in SUNS])
        axes.set_title(f"{WAVELENGTHS[k]:g} nm", fontsize=10)
        axes.set_xlabel("sun zenith angle")
        grid(axes)
        if k == 0:
            axes.set_ylabel("share of the incoming light [%]")
            axes.legend(loc="lower left", fontsize=8)
    caption = "The three shares are computed apart from each other; the line is 100 %."
    return ReportPicture.from_figure(figure, title=title, caption=caption)


def _reversed(solution: Solution) -> tuple[FloatArray, ReportTable]:
    """Reflected radiance over mu_s with sun and observer exchanged: Helmholtz reciprocity."""
    angles = np.array(REVERSED)
    view, sun = np.meshgrid(angles, angles, indexing="ij")
    found = []
    for azimuth in (0.0, 90.0, 180.0):
        radiance = solution.radiance(
            altitude=solution.medium.thickness,
            sun_zenith=sun,
            view_zenith=180.0 - view,
            azimuth=azimuth,
        ).values
        reflectance = radiance / np.cos(np.radians(sun))[..., None]
        found.append(reflectance / np.swapaxes(reflectance, 0, 1) - 1.0)
    off = np.stack(found)
    rows = []
    for i, first in enumerate(angles):
        for j, second in enumerate(angles[:i]):
            rows.append(
                (f"{first:g}", f"{second:g}", *(" ".join(_percent(off[a, i, j])) for a in range(3)))
            )
    table = ReportTable(
        title="Reversed paths: light reflected to space, sun and observer exchanged",
        columns=cells(
            "zenith angle [°] | the other [°] | azimuth 0°: 680 550 440 nm [%] | azimuth 90° [%] | "
            "azimuth 180° [%]"
        ),
        rows=rows,
        note="R(view, sun)/R(sun, view) - 1 of the flat Earth, R the radiance over the cosine of "
        "the sun's zenith angle; 0 is right.",
        folded=True,
    )
    return off, table
