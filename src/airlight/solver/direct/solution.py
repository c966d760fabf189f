"""Solution of the direct solver: ray marches through the tables of gathered radiance."""

from __future__ import annotations

import hashlib
from dataclasses import replace
from functools import partial
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.path import shadow_edges
from airlight.kernel import compiled_loop, disk
from airlight.kernel.fingerprints import fingerprint
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.physics.optics.density_profile import DensitySegments
from airlight.physics.optics.reflection import cos_reflected
from airlight.solver.direct.layout import layout_for
from airlight.solver.direct.line import (
    GatheredTable,
    LineOptics,
    add_gathered,
    add_once,
    axes_shape,
    line_optics,
    new_line,
    place_rows,
    prepare,
)
from airlight.solver.direct.orders import Orders, solve_orders
from airlight.solver.direct.passes import add_ground, direct_light, reflected
from airlight.solver.direct.settings import DirectSettings
from airlight.solver.direct.trapezoid import sphere
from airlight.solver.lines_of_sight import LinesOfSight
from airlight.solver.refracted_geometry import without_refraction
from airlight.solver.report import Report
from airlight.solver.solution import Solution

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]

#: Lines of sight per block of work.
_BLOCK = 64
#: Steps in zenith angle and azimuth for diffuse irradiance.
_SKY_STEPS = (12, 28)
#: Note of a report on neglected polarisation.
SCALAR = "scalar transfer: without polarisation, which changes radiances by some percent"


class DirectSolution(Solution):
    """Solution by the direct solver.

    Parameters
    ----------
    medium : Medium
        Medium that was solved.
    parts : list of (Medium, Orders)
        Medium and its orders; for the literal notes 1 one pair per scattering constituent.
    seconds : float
        Wall time. [s]
    note : str
        Neglected properties of the planet; see ``Report``.
    """

    def __init__(
        self,
        medium: Medium,
        settings: DirectSettings,
        parts: list[tuple[Medium, Orders]],
        seconds: float,
        note: str = "",
    ) -> None:
        self.medium = medium
        self.settings = settings
        self.parts = parts
        self._airs = [line_optics(one, settings, settings.steps) for one, _ in parts]
        kept = max(len(orders.each) for _, orders in parts) + 1 if settings.keep_orders else 1
        self.highest_order = kept
        self.report = Report(
            solver="direct",
            settings=settings.as_text(),
            sweeps=max(orders.count for _, orders in parts),
            residual=tuple(
                float(x) for x in np.max([orders.residual for _, orders in parts], axis=0)
            ),
            seconds=seconds,
            note=note,
        )

    def relative_radiance(self, lines: LinesOfSight, *, order: int | None = None) -> FloatArray:
        """See ``Solution``; orders up to ``highest_order``, or all."""
        out = np.zeros((lines.r.size, self.wavelengths.size))
        for (medium, orders), air in zip(self.parts, self._airs, strict=True):
            out += _radiance(medium, orders, air, self.settings, lines, order)
        return out

    def relative_direct_irradiance(self, r: FloatArray, mu_s: FloatArray) -> FloatArray:
        """See ``Solution``."""
        air = line_optics(self.medium, self.settings, self.settings.steps)
        out, line = np.empty((r.size, self.wavelengths.size)), new_line(air)
        for k in range(r.size):
            direct_light(r[k], mu_s[k], True, air, line, out[k])
        return out

    def relative_sky_irradiance(self, r: FloatArray, mu_s: FloatArray) -> FloatArray:
        """See ``Solution``; by the trapezoid over the upper hemisphere, split at the sun."""
        out = np.empty((r.size, self.wavelengths.size))
        for k in range(r.size):
            sun = float(np.arccos(np.clip(mu_s[k], -1.0, 1.0)))
            cuts = (0.0, sun, np.pi / 2) if 0.02 < sun < np.pi / 2 - 0.02 else (0.0, np.pi / 2)
            zenith, azimuth, weights = sphere(*_SKY_STEPS, cuts, grade=True)
            mu = np.repeat(np.cos(zenith), azimuth.size)
            around = np.tile(np.cos(azimuth), zenith.size)
            sine = np.sqrt((1.0 - mu) * (1.0 + mu) * (1.0 - mu_s[k]) * (1.0 + mu_s[k]))
            same = np.full_like(mu, 1.0)
            length = -r[k] * mu + np.sqrt(
                (self.medium.top_radius - r[k]) * (self.medium.top_radius + r[k]) + (r[k] * mu) ** 2
            )
            nu = np.clip(mu * mu_s[k] + sine * around, -1.0, 1.0)
            lines = LinesOfSight(
                same * r[k], mu, same * mu_s[k], nu, length, np.zeros(mu.size, dtype=bool)
            )
            out[k] = (weights.ravel() * mu) @ self.relative_radiance(lines)
        return out


def _radiance(
    medium: Medium,
    orders: Orders,
    air: LineOptics,
    settings: DirectSettings,
    lines: LinesOfSight,
    order: int | None,
) -> FloatArray:
    n, wavelengths = lines.r.size, medium.wavelengths.size
    out = np.zeros((n, wavelengths))
    once = order is None or order == 1
    table, ground = orders.total, orders.ground
    if order is not None and order > 1:
        if order - 2 >= len(orders.each):
            return out
        table, ground = orders.each[order - 2], orders.each_ground[order - 2]
    gathered = order is None or order > 1
    scatterers = air.scatterers
    sights = lines.r, lines.mu, lines.mu_s, lines.nu, lines.length

    def block(index: int) -> None:
        rows = slice(index * _BLOCK, min((index + 1) * _BLOCK, n))
        phase = medium.phase_function(lines.nu[rows])[:, scatterers]
        _lines(
            tuple(one[rows] for one in sights),
            lines.to_ground[rows],
            np.ascontiguousarray(phase.reshape(phase.shape[0], -1)),
            (once, gathered),
            GatheredTable(orders.axes, table, settings.logarithmic),
            ground,
            air,
            new_line(air),
            out[rows],
        )

    run_blocks(block, -(-n // _BLOCK))
    return out


@compiled_loop
def _lines(sights, to_ground, phase, orders, table, ground, air, line, out):
    r, mu, mu_s, nu, length = sights
    once, gathered = orders
    axes, _, logarithmic = table
    received = np.empty(out.shape[1])
    for k in range(r.size):
        line.transmittance[:] = 1.0
        if length[k] > 0.0:
            dark, dawn = shadow_edges(r[k], mu[k], mu_s[k], nu[k], air.bottom)
            count = prepare(r[k], mu[k], length[k], dark, dawn, air, line)
            if gathered:
                place_rows(r[k], mu[k], count, axes, line)
                add_gathered(r[k], mu_s[k], nu[k], count, table, line, out[k])
            if once:
                add_once(r[k], mu_s[k], nu[k], count, phase[k], True, air, line, out[k])
        if to_ground[k]:
            if gathered:
                ray = r[k], mu[k], mu_s[k], nu[k], length[k]
                add_ground(
                    ray, axes, ground, False, logarithmic, air.ground, line.transmittance, out[k]
                )
            if once:
                mu_s_ground = (r[k] * mu_s[k] + length[k] * nu[k]) / air.bottom
                mu_s_ground = min(max(mu_s_ground, -1.0), 1.0)
                direct_light(air.bottom, mu_s_ground, True, air, line, received)
                mu_r = cos_reflected(r[k], mu[k], air.bottom)
                for l in range(received.size):
                    factor = reflected(air.ground, l, True, mu_s_ground, mu_r, nu[k])
                    out[k, l] += line.transmittance[l] * factor * received[l]


def solve(
    medium: Medium,
    settings: DirectSettings,
    *,
    cache: bool = True,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> DirectSolution:
    """Solution of a medium by the equations of the notes, computed or from the cache.

    Parameters
    ----------
    medium : Medium
        Medium to solve.
    settings : DirectSettings
        Settings of the solver.
    cache : bool
        Whether to read the solution from the cache on disk, and to write it there.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``.

    Raises
    ------
    ConvergenceError
        If the orders do not decrease.
    """
    medium, note = without_refraction(medium)
    if medium.phase_f12(np.zeros(())).any():  # perpendicular to the direction of the star
        note = f"{note}; {SCALAR}" if note else SCALAR
    started = perf_counter()
    media = [medium]
    if settings.literal == "atmosphere-plus-1":
        scatterers = np.flatnonzero(medium.scattering.max(axis=1) > 0.0)
        media = [alone(medium, int(i)) for i in scatterers]
    parts = []
    computed: list[Medium] = []
    for one in media:

        def solved(one: Medium = one) -> Orders:
            computed.append(one)
            return solve_orders(one, settings, progress=progress, cancel=cancel)

        restored = partial(_from_arrays, one, settings)
        orders = disk.cached(_key(one, settings), solved, _to_arrays, restored, use=cache)
        parts.append((one, orders))
    seconds = perf_counter() - started if computed else 0.0
    return DirectSolution(medium, settings, parts, seconds, note)


def _key(medium: Medium, settings: DirectSettings) -> str:
    text = f"direct {fingerprint(Path(__file__))} {settings.as_text()} {medium.fingerprint()}"
    return hashlib.sha256(text.encode()).hexdigest()[:40]


def _to_arrays(orders: Orders) -> dict[str, NDArray[Any]]:
    return {
        "total": orders.total,
        "ground": orders.ground,
        "each": np.array(orders.each),
        "each_ground": np.array(orders.each_ground),
        "count": np.array(orders.count),
        "residual": orders.residual,
    }


def _from_arrays(
    medium: Medium, settings: DirectSettings, arrays: dict[str, NDArray[Any]]
) -> Orders | None:
    """Orders from the arrays of a cache file; None if they do not fit."""
    axes = layout_for(medium, settings)
    scatterers = int((medium.scattering.max(axis=1) > 0.0).sum())
    shape = axes_shape(axes, scatterers * medium.wavelengths.size)
    try:
        orders = Orders(
            axes=axes,
            total=arrays["total"],
            ground=arrays["ground"],
            each=list(arrays["each"]),
            each_ground=list(arrays["each_ground"]),
            count=int(arrays["count"]),
            residual=arrays["residual"],
        )
    except (KeyError, TypeError, ValueError):
        return None
    lit = (axes.sun_angles, medium.wavelengths.size)
    sound = (
        orders.total.shape == shape
        and orders.ground.shape == lit
        and all(one.shape == shape for one in orders.each)
        and all(one.shape == lit for one in orders.each_ground)
        and orders.residual.shape == lit[1:]
        and bool(np.isfinite(orders.total).all())
    )
    return orders if sound else None


def alone(medium: Medium, index: int) -> Medium:
    """Medium with only one constituent over black ground, as in Atmosphere Plus notes 1."""
    only = slice(index, index + 1)
    return replace(
        medium,
        names=medium.names[only],
        scattering=medium.scattering[only],
        absorption=medium.absorption[only],
        density=DensitySegments(medium.density.edges[only], medium.density.coefficients[only]),
        phase_table=medium.phase_table[only],
        ground_albedo=np.zeros_like(medium.ground_albedo),
        constituents=medium.constituents[only],
    )
