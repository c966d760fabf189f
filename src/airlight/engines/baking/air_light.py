"""Path radiance from any solution, for tables of scattered light.

The moments solver computes path radiance directly; from the radiance of other solvers the
attenuated radiance of the ground is subtracted.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.path import ray_length
from airlight.geometry.quadrature import gauss_legendre
from airlight.geometry.shell import distance_to_bottom, distance_to_top
from airlight.kernel import vectorized
from airlight.physics.optics.reflection import (
    cos_reflected,
    diffuse_reflectances,
    direct_reflectances,
)
from airlight.solver.lines_of_sight import LinesOfSight
from airlight.solver.moments.march_sun_angles import scattering_by_constituent
from airlight.solver.moments.solution import MomentsSolution
from airlight.solver.solution import Solution
from airlight.solver.tables.columns import columns
from airlight.solver.tables.layout import Positions

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]

#: Number of directions per axis of the quadrature of one order's irradiance of the ground.
_SKY = 12
#: Sun angles at which that irradiance is computed, for interpolation.
_SUNS = 129


def lines_of_sight(positions: Positions, medium: Medium) -> LinesOfSight:
    """Lines of sight from points, each ending on its side of the horizon."""
    down = vectorized(distance_to_bottom)(positions.r, positions.mu, medium.bottom_radius)
    up = vectorized(distance_to_top)(positions.r, positions.mu, medium.top_radius)
    return LinesOfSight(
        positions.r,
        positions.mu,
        positions.mu_s,
        positions.nu,
        np.where(positions.to_ground, down, up),
        positions.to_ground,
    )


class AirLight:
    """Path radiance of some orders, along any line of sight.

    Parameters
    ----------
    solution : Solution
        Solution of any solver.
    order : int or None
        Order of scattering; None for all.
    cumulative : bool
        Whether all orders up to ``order`` are included.
    peaks_once : bool
        Whether multiple scattering within forward peaks is included in separate single scattering.
    """

    def __init__(
        self,
        solution: Solution,
        order: int | None = None,
        *,
        cumulative: bool = False,
        peaks_once: bool = False,
    ) -> None:
        solution.check_order(order)
        self.solution = solution
        self.peaks_once = peaks_once
        self.orders: tuple[int | None, ...] = (order,)
        if order is not None and cumulative:
            self.orders = tuple(range(1, order + 1))
        #: Whether the solver gives path radiance for a line marked as ending within the atmosphere.
        self.separates_ground = isinstance(solution, MomentsSolution)
        self._skies: dict[int, tuple[FloatArray, FloatArray]] = {}

    @property
    def has_first(self) -> bool:
        """Whether single scattering is included."""
        return None in self.orders or 1 in self.orders

    def with_first(self, lines: LinesOfSight) -> tuple[FloatArray, FloatArray]:
        """Path radiance of all included orders, and of single scattering, shape (n, nl). [sr⁻¹]"""
        transmittance = self._ground_transmittance(lines)
        first = self._of_order(lines, 1, transmittance)
        rest = [
            first if order == 1 else self._of_order(lines, order, transmittance)
            for order in self.orders
        ]
        return np.asarray(sum(rest)), first

    def single_and_multiple(self, lines: LinesOfSight) -> tuple[FloatArray, FloatArray]:
        """Path radiance split into single scattering and the rest, for a moments solution.

        With all orders, single scattering is unscaled; the first order alone is that of the
        solution, with delta-M scaling.

        Returns
        -------
        once : array, shape (n, nc, nl)
            Single scattering by each constituent, to be multiplied by its phase function. [1]
        rest : array, shape (n, nl)
            Radiance of all other included orders. [sr⁻¹]
        """
        solution = self.solution
        assert isinstance(solution, MomentsSolution)
        whole = None in self.orders
        if whole and not self.peaks_once:
            light, once = scattering_by_constituent(solution, lines, 2, delta_scaled=False)
            own = solution.medium.phase_function(solution.geometry.apparent_nu(lines))
            return once, np.maximum(light - (once * own).sum(axis=1), 0.0)
        light, once = scattering_by_constituent(
            solution, lines, 0 if whole else 1, delta_scaled=True
        )
        return once, light if whole else np.zeros_like(light)

    def __call__(self, lines: LinesOfSight) -> FloatArray:
        """Path radiance of all included orders, shape (n, nl). [sr⁻¹]"""
        transmittance = self._ground_transmittance(lines)
        return np.asarray(sum(self._of_order(lines, order, transmittance) for order in self.orders))

    def at_sun_angles(self, lines: LinesOfSight) -> FloatArray:
        """Same as a call; faster where neighbouring lines differ only in the sun angle. [sr⁻¹]"""
        if not self.separates_ground:
            return self(lines)
        assert isinstance(self.solution, MomentsSolution)
        orders = 2 if None in self.orders else 1
        return scattering_by_constituent(self.solution, lines, orders, delta_scaled=True)[0]

    def path_and_total_radiance(self, lines: LinesOfSight) -> tuple[FloatArray, FloatArray]:
        """Path radiance and total radiance (ground included) of the same orders, (n, nl). [sr⁻¹]"""
        if self.separates_ground:
            assert isinstance(self.solution, MomentsSolution)
            own, whole = self.solution.path_and_total_radiance(
                lines, 2 if None in self.orders else 1
            )
            return own, np.maximum(whole, own)
        own, rows = self(lines), lines.to_ground
        whole = own.copy()
        if rows.any():
            down = LinesOfSight(*(values[rows] for values in vars(lines).values()))
            light = sum(self.solution.relative_radiance(down, order=k) for k in self.orders)
            whole[rows] = np.maximum(np.asarray(light), own[rows])
        return own, whole

    def _ground_transmittance(self, lines: LinesOfSight) -> FloatArray:
        """Transmittance of the lines that end on the ground, shape (rows, nl). [1]"""
        medium = self.solution.medium
        rows = lines.to_ground
        if self.separates_ground:
            return np.empty((0, medium.wavelengths.size))
        ends = lines.r[rows], lines.mu[rows], lines.length[rows]
        depth = columns(*ends, medium.bottom_radius, medium.density, nodes=16, panels=3)
        return np.exp(-(depth @ medium.extinction))

    def _of_order(
        self, lines: LinesOfSight, order: int | None, transmittance: FloatArray
    ) -> FloatArray:
        rows = lines.to_ground
        if self.separates_ground:
            lines = replace(lines, to_ground=np.zeros_like(rows))
        light = self.solution.relative_radiance(lines, order=order)
        if rows.any() and not self.separates_ground:
            light = np.array(light)
            light[rows] -= transmittance * self._ground(lines, order)
        return np.maximum(light, 0.0)

    def _ground(self, lines: LinesOfSight, order: int | None) -> FloatArray:
        """Radiance of the ground of one order, at the ends of lines of sight, (rows, nl). [sr⁻¹]"""
        medium, rows = self.solution.medium, lines.to_ground
        bottom, nu = medium.bottom_radius, lines.nu[rows]
        mu_s = (lines.r[rows] * lines.mu_s[rows] + lines.length[rows] * nu) / bottom
        mu_s = np.clip(mu_s, -1.0, 1.0)
        mu_r = vectorized(cos_reflected)(lines.r[rows], lines.mu[rows], bottom)
        total = np.zeros((mu_s.size, medium.wavelengths.size))
        factor = np.empty_like(total)
        if order in (None, 1):
            direct_reflectances(medium.ground, mu_s, mu_r, nu, factor)
            r = np.full(mu_s.size, bottom)
            total += factor * self.solution.relative_direct_irradiance(r, mu_s)
        if order != 1:
            diffuse_reflectances(medium.ground, mu_r, factor)
            total += factor * self._sky_at(mu_s, 0 if order is None else order - 1)
        return total / np.pi

    def _sky_at(self, mu_s: FloatArray, order: int) -> FloatArray:
        """Diffuse irradiance of the ground of one order, or of all (0), shape (n, nl). [1]"""
        suns, values = self._sky(order)
        # In twilight, sky radiance falls by a factor of e in a degree or two: its logarithm is
        # interpolated.
        logs = np.log(np.maximum(values.T, 1e-300))
        sky = np.exp(np.stack([np.interp(mu_s, suns, column) for column in logs], axis=-1))
        return np.asarray(sky)

    def _sky(self, order: int) -> tuple[FloatArray, FloatArray]:
        """Table over the sun's cosine of the diffuse irradiance of one order, or of all (0)."""
        if order not in self._skies:
            t = np.linspace(-1.0, 1.0, _SUNS)
            suns = np.sin(0.5 * np.pi * (0.3 * t + 0.7 * t**3))  # steps of 0.4° near the horizontal
            if order == 0:
                ground = np.full(suns.size, self.solution.medium.bottom_radius)
                self._skies[0] = suns, self.solution.relative_sky_irradiance(ground, suns)
                return self._skies[0]
            rule = gauss_legendre(_SKY)
            # x² concentrates the directions at the horizon, where the gradient of the sky is
            # largest.
            mu, weight = rule.nodes**2, 2.0 * rule.nodes * rule.weights
            around = np.cos(np.pi * (np.arange(_SKY) + 0.5) / _SKY)
            mu_s, view, side = (x.ravel() for x in np.meshgrid(suns, mu, around, indexing="ij"))
            nu = view * mu_s + np.sqrt((1.0 - view**2) * (1.0 - mu_s**2)) * side
            medium = self.solution.medium
            r = np.full(view.size, medium.bottom_radius)
            length = vectorized(ray_length)(r, view, medium.bottom_radius, medium.top_radius)
            sky = self.solution.relative_radiance(
                LinesOfSight(r, view, mu_s, nu, length, np.zeros(r.size, bool)), order=order
            ).reshape(suns.size, _SKY, _SKY, -1)
            values = 2.0 * np.pi * np.einsum("smal,m->sl", sky, weight * mu) / _SKY
            self._skies[order] = suns, values
        return self._skies[order]


def described_orders(order: int | None, cumulative: bool) -> str:
    """Description of the orders of scattering."""
    if order is None:
        return "all"
    if cumulative and order > 1:
        return f"1 to {order}"
    return str(order)


def groups(medium: Medium) -> tuple[list[int], list[int]]:
    """Indices of molecular and of all other scattering constituents.

    Molecules have phase functions whose only moment is the second.
    """
    moments = medium.phase_moments(4)
    gas: list[int] = []
    particles: list[int] = []
    for index in range(len(medium.names)):
        if not (medium.scattering[index] > 0.0).any():
            continue
        other: Any = np.abs(moments[index][:, [1, 3, 4]]).max()
        (gas if other < 1e-6 else particles).append(index)
    return gas, particles
