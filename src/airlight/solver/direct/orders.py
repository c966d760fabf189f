"""Successive orders of scattering by alternating passes, until convergence."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ConvergenceError
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.solver.direct.gather import (
    GatherDirections,
    directions_for,
    gather,
    node_suns,
    phase_nodes,
)
from airlight.solver.direct.layout import Layout, layout_for
from airlight.solver.direct.line import (
    GatheredTable,
    LineOptics,
    axes_shape,
    line_optics,
    new_line,
)
from airlight.solver.direct.passes import direct_light, first_pass, next_pass, sky_light
from airlight.solver.direct.settings import DirectSettings

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]

#: Texels below this fraction of the brightest are ignored by the stopping rule. [1]
_FAINT = 1e-7
#: Largest ratio of the last two orders for which a geometric tail is accepted. [1]
_TRUSTED_RATIO = 0.95
#: Upper limit of that ratio in single texels. [1]
_LARGEST_RATIO = 0.98
#: Smallest order for which the ratio is evaluated; below, it is taken as 0. [1]
_DARK = 1e-250


@dataclass(frozen=True, kw_only=True)
class Orders:
    """Results of the passes.

    Attributes
    ----------
    axes : Layout
        Axes of the tables.
    total : array, shape (radii·views, sun_angles, angles, ns·nl)
        Gathered radiance of all orders, or its logarithm, by the settings. [sr⁻¹]
    ground : array, shape (sun_angles, nl)
        Diffuse irradiance of the ground, of all orders. [1]
    each : list of array
        G⁽¹⁾, G⁽²⁾ … as ``total``, if requested by the settings.
    each_ground : list of array
        Irradiances with the reflections A⁽²⁾, A⁽³⁾ …, as ``ground``.
    count : int
        Number of orders of radiance: one more than gathered orders.
    residual : array, shape (nl,)
        Largest fraction of the last order in the sum, before the tail is added. [1]
    """

    axes: Layout
    total: FloatArray
    ground: FloatArray
    each: list[FloatArray]
    each_ground: list[FloatArray]
    count: int
    residual: FloatArray


def solve_orders(
    medium: Medium,
    settings: DirectSettings,
    *,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Orders:
    """Successive orders: radiance, irradiance of the ground, gather, repeated."""
    work = _Passes(medium, settings, progress, cancel)
    incoming = work.first()
    total: FloatArray | None = None
    before: FloatArray | None = None
    ground = np.zeros_like(work.lit_by_star)
    ground_before = ground
    each: list[FloatArray] = []
    each_ground: list[FloatArray] = []
    residual = np.ones(medium.wavelengths.size)
    count = 1
    while True:
        gathered = work.gather(incoming, count)
        linear = np.exp(gathered) if settings.logarithmic else gathered
        if settings.keep_orders:
            each.append(gathered)
        total = linear if total is None else total + linear
        count += 1
        from_sky = work.from_sky  # A⁽ᵏ⁾, by irradiance of the previous order
        ground = ground + from_sky
        each_ground.append(from_sky)
        residual = _order_ratio(linear, total, medium.wavelengths.size)
        if residual.max() <= settings.tolerance or count > settings.orders:
            break
        before, ground_before = linear, from_sky
        incoming = work.next(gathered, count)
    if settings.tail and before is not None:
        ratio = float((linear.sum() + from_sky.sum()) / (before.sum() + ground_before.sum()))
        if not ratio <= _TRUSTED_RATIO:
            raise ConvergenceError(
                f"the orders of scattering do not decrease: order {count} is {ratio:.3g} of the "
                "previous one; allow more orders, or set tail=False"
            )
        total = total + _rest(linear, before)
        ground = ground + _rest(from_sky, ground_before)
    if settings.logarithmic:
        total = np.log(np.maximum(total, 1e-280))
    return Orders(
        axes=work.axes,
        total=total,
        ground=ground,
        each=each,
        each_ground=each_ground,
        count=count,
        residual=residual,
    )


class _Passes:
    """Passes of the iteration with their arrays; each returns a new array."""

    def __init__(
        self,
        medium: Medium,
        settings: DirectSettings,
        progress: Progress | None,
        cancel: Cancel | None,
    ) -> None:
        self.settings = settings
        self.axes: Layout = layout_for(medium, settings)
        self.air: LineOptics = line_optics(medium, settings, settings.pass_steps)
        self.directions: GatherDirections = directions_for(self.axes, settings)
        self.phases = phase_nodes(medium, self.air.scatterers)
        self.progress, self.cancel = progress, cancel
        sun_angles = node_suns(self.axes)
        line, lit = new_line(self.air), np.empty((sun_angles.size, medium.wavelengths.size))
        for k, mu_s in enumerate(sun_angles):
            direct_light(self.axes.bottom, mu_s, True, self.air, line, lit[k])
        self.lit_by_star = lit
        nz, na = self.directions.zenith.shape[1], self.directions.azimuth.size
        self.incoming = np.empty(
            (self.axes.radii, sun_angles.size, medium.wavelengths.size, nz, na)
        )
        self.from_sky = np.zeros_like(lit)

    def _all_radii(self, message: str, one: Callable[[int], None]) -> None:
        run_blocks(
            one,
            self.axes.radii,
            cancel=self.cancel,
            progress=self.progress,
            message=message,
        )

    def _sky(self, air_light: FloatArray) -> None:
        """Ambient pass: diffuse irradiance of the ground."""
        self.from_sky = sky_light(
            self.directions.zenith[0], self.directions.weights[0], air_light[0]
        )

    def first(self) -> FloatArray:
        """S⁽¹⁾ + D·T."""
        late = self.settings.literal == "atmosphere-plus-2"
        lit = np.zeros_like(self.lit_by_star) if late else self.lit_by_star

        def one(i: int) -> None:
            line = new_line(self.air)
            first_pass(
                i, self.axes, self.directions, self.phases, self.air, line, lit, self.incoming[i]
            )

        self._all_radii("order 1", one)
        self._sky(self.incoming)
        return self.incoming

    def gather(self, incoming: FloatArray, order: int) -> FloatArray:
        """G⁽ᵏ⁾ from H⁽ᵏ⁾."""
        axes, settings = self.axes, self.settings
        shape = axes_shape(axes, self.phases[1].size)
        out = np.empty(shape)
        rows = out.reshape(axes.radii, axes.views, *shape[1:])
        azimuth = np.radians(settings.azimuth)
        psi = float(np.cos(azimuth)), float(np.sin(azimuth))

        def one(i: int) -> None:
            gather(
                i,
                axes,
                self.directions,
                self.phases,
                incoming[i],
                psi,
                settings.graded,
                settings.logarithmic,
                rows[i],
            )

        self._all_radii(f"gather {order}", one)
        return out

    def next(self, gathered: FloatArray, order: int) -> FloatArray:
        """S⁽ᵏ⁾ + A⁽ᵏ⁾·T from G⁽ᵏ⁻¹⁾; in the literal second notes D replaces A⁽²⁾."""
        late = self.settings.literal == "atmosphere-plus-2" and order == 2
        lit = self.lit_by_star if late else self.from_sky
        table = GatheredTable(self.axes, gathered, self.settings.logarithmic)

        def one(i: int) -> None:
            line = new_line(self.air)
            next_pass(i, self.directions, table, self.air, line, lit, late, self.incoming[i])

        self._all_radii(f"order {order}", one)
        self._sky(self.incoming)
        return self.incoming


def _order_ratio(part: FloatArray, total: FloatArray, wavelengths: int) -> FloatArray:
    """Largest ratio of an order to the sum of orders, per wavelength, outside dark texels. [1]"""
    part, total = part.reshape(-1, wavelengths), total.reshape(-1, wavelengths)
    bright = total > _FAINT * total.max(axis=0)
    ratios = np.divide(part, total, out=np.zeros_like(part), where=bright)
    return np.asarray(ratios.max(axis=0))


def _rest(last: FloatArray, before: FloatArray) -> FloatArray:
    """Geometric tail after the last order."""
    ratio = np.divide(last, before, out=np.zeros_like(last), where=before > _DARK)
    ratio = np.minimum(ratio, _LARGEST_RATIO)
    return np.asarray(last * ratio / (1.0 - ratio))
