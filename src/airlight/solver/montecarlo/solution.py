"""Solution of the Monte Carlo solver: each query traces new histories."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.geometry.quadrature import gauss_legendre
from airlight.geometry.shell import distance_to_top
from airlight.geometry.vectors import Vec3
from airlight.kernel import vectorized
from airlight.kernel.threads import Cancel, Progress
from airlight.planets.rings import warn_of_rings
from airlight.solver.lines_of_sight import LinesOfSight
from airlight.solver.montecarlo.estimate import Estimate, Query, estimate
from airlight.solver.montecarlo.history_optics import HistoryOptics, history_optics
from airlight.solver.montecarlo.refracted_paths import refracted_direct_irradiance
from airlight.solver.montecarlo.settings import MonteCarloSettings
from airlight.solver.report import Report
from airlight.solver.single_scattering import reflected_once, single_scattering
from airlight.solver.solution import Solution
from airlight.solver.star_light import direct_irradiance
from airlight.solver.stokes_frame import STOKES, star_planes, to_meridian
from airlight.solver.tables.ring_shadow import RingShadow, ring_tables

if TYPE_CHECKING:
    import xarray

    from airlight.physics.units import Measures
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class MonteCarloReport(Report):
    """Provenance of the last result.

    Attributes
    ----------
    solver, settings, sweeps, residual, seconds, ground :
        Fields of ``Report``; ``sweeps`` is the number of separate orders, ``residual`` the largest
        standard error over radiance per wavelength, of the last result.
    histories : int
        Number of histories of the last result.
    unreached : int
        Number of its lines of sight that did not reach the requested error at some wavelength, by
        the limit of histories or without any contribution.
    lines : int
        Number of its lines of sight.
    """

    histories: int = 0
    unreached: int = 0
    lines: int = 0

    def _described(self, took: str) -> str:
        ground = f"; {self.ground}" if self.ground else ""
        if not self.lines:
            return f"{self.solver}: no result yet ({self.settings}){ground}"
        missed = ""
        if self.unreached:
            missed = (
                f", {self.unreached} of {self.lines} lines of sight NOT within the requested error"
            )
        return (
            f"{self.solver}: {self.histories:.3g} histories, largest error "
            f"{max(self.residual):.1e}{missed}{took} ({self.settings}){ground}"
        )


class MonteCarloSolution(Solution):
    """Monte Carlo solution: every result is traced.

    Results are reproducible to the last bit for a seed, independent of other queries. Errors of
    different lines of sight and of different wavelengths are independent; those of the orders of a
    line are not. Order 1 is exact by quadrature, except with refraction, for irradiances, or by
    settings. Nothing is cached on disk.

    Parameters
    ----------
    medium : Medium
        Medium to solve.
    settings : MonteCarloSettings
        Stopping rule.
    """

    def __init__(
        self,
        medium: Medium,
        settings: MonteCarloSettings,
        *,
        progress: Progress | None = None,
        cancel: Cancel | None = None,
    ) -> None:
        self.medium = medium
        self.settings = settings
        self.progress = progress
        self.cancel = cancel
        self.highest_order = settings.kept_orders
        self.airs = [
            history_optics(self.geometry, k, polarised=settings.polarisation)
            for k in range(medium.wavelengths.size)
        ]
        self.report: MonteCarloReport = MonteCarloReport(
            solver="montecarlo",
            settings=settings.as_text(),
            sweeps=settings.kept_orders,
            residual=(0.0,) * medium.wavelengths.size,
            seconds=0.0,
        )

    def trace(self, lines: LinesOfSight, *, order: int | None = None) -> Estimate:
        """All estimates for lines of sight.

        Parameters
        ----------
        order : int, optional
            Order whose standard error determines the number of histories; default: sum of all
            orders.
        """
        started = perf_counter()
        shadows = self._shadows(lines)
        integrates = self._integrates_first_order and shadows is None
        known = self.first_order(lines) if integrates else None
        lines = self.geometry.optical_lines(lines)
        lengths = lines.length
        if order == 1 and known is not None:
            lengths = np.zeros_like(lengths)
        starts = np.stack([lines.r, lines.mu, lines.mu_s, lines.nu], axis=1)
        return self.answer(Query(starts, lengths, 0, known, order, rings=shadows), started)

    def _shadows(self, lines: LinesOfSight) -> list[RingShadow] | None:
        """Rings in front of the star for each line; None without."""
        if not lines.pole.any():
            return None
        rings = ring_tables(self.medium.rings, self.wavelengths)
        return [RingShadow(Vec3(*one), rings) for one in lines.pole.tolist()]

    @property
    def shaded_by_rings(self) -> bool:
        """See ``Solution``."""
        return True

    def answer(
        self, query: Query, started: float, airs: Sequence[HistoryOptics] | None = None
    ) -> Estimate:
        """Estimate of a query that began at ``started``, by ``perf_counter`` [s], in other air."""
        got = estimate(
            query,
            self.airs if airs is None else airs,
            self.medium.wavelengths,
            self.settings,
            progress=self.progress,
            cancel=self.cancel,
        )
        part = np.divide(
            got.total_error, got.total, out=np.zeros_like(got.total), where=got.total > 0.0
        )
        lines = got.total.shape[0]
        self.report = replace(
            self.report,
            residual=tuple(float(x) for x in part.max(axis=0)) if lines else self.report.residual,
            seconds=perf_counter() - started,
            histories=int(got.histories.sum()),
            unreached=int((~got.reached).any(axis=1).sum()),
            lines=lines,
        )
        return got

    def first_order(self, lines: LinesOfSight) -> FloatArray:
        """First order of I, Q and U by quadrature, per irradiance of the star, (n, 3, nl). [sr⁻¹]

        Direct irradiance and phase function are averaged over the star's disc separately: within
        the aureole of a sun on the horizon the mean of their product differs by some parts in 1000.
        """
        once = single_scattering(self.medium, lines, progress=self.progress, cancel=self.cancel)
        found = np.zeros((lines.r.size, 3, self.wavelengths.size))
        phases = disc_mean(self.medium, self.medium.phase_function, lines.nu)
        found[:, 0] = (once * phases).sum(axis=1) + reflected_once(self.medium, lines)
        if self.settings.polarisation:
            across = disc_mean(self.medium, self.medium.phase_f12, lines.nu)
            cosine, sine = star_planes(lines.mu, lines.mu_s, lines.nu)
            polarised = (once * across).sum(axis=1)
            found[:, 1] = polarised * cosine[:, None]
            found[:, 2] = polarised * sine[:, None]
        return found

    def relative_radiance(self, lines: LinesOfSight, *, order: int | None = None) -> FloatArray:
        """See ``Solution``; orders up to ``highest_order``."""
        got = self.trace(lines, order=order)
        return got.total if order is None else got.parts[:, order - 1]

    @property
    def polarised(self) -> bool:
        """See ``Solution``."""
        return self.settings.polarisation

    def relative_stokes(self, lines: LinesOfSight, *, order: int | None = None) -> FloatArray:
        """See ``Solution``; all orders, or the first if computed by quadrature."""
        if order is None:
            got = self.trace(lines)
            return np.concatenate([got.total[:, None], got.polarised], axis=1)
        if order != 1 or not self._integrates_first_order:
            allowed = "1, or all orders together" if self._integrates_first_order else "all orders"
            raise ParameterError("order", order, f"{allowed} for polarised light")
        return self.first_order(lines)

    @property
    def _integrates_first_order(self) -> bool:
        return self.settings.exact_first_order and self.geometry.shell is None

    def radiance(
        self,
        *,
        altitude: Measures,
        sun_zenith: Measures,
        view_zenith: Measures,
        azimuth: Measures = 0.0,
        order: int | None = None,
        stokes: bool = False,
        latitude: Measures | None = None,
        sun_azimuth: Measures | None = None,
    ) -> xarray.DataArray:
        """See ``Solution``; with a coordinate ``standard_error`` of the same shape and unit.

        ``estimate`` also returns the contributions of the orders.
        """
        if stokes and order is not None:  # the first, by quadrature
            return super().radiance(
                altitude=altitude,
                sun_zenith=sun_zenith,
                view_zenith=view_zenith,
                azimuth=azimuth,
                order=order,
                stokes=stokes,
                latitude=latitude,
                sun_azimuth=sun_azimuth,
            )
        if stokes:
            self.check_polarised()
        self.check_order(order)
        rays = altitude, sun_zenith, view_zenith, azimuth, latitude, sun_azimuth
        arrays, lines, axes = self._rays_from_arguments(*rays)
        warn_of_rings(self.medium.rings, "radiance", placed=latitude is not None)
        got = self.trace(lines, order=order)
        values, errors = got.total, got.total_error
        if order is not None:
            values, errors = got.parts[:, order - 1], got.part_errors[:, order - 1]
        if stokes:
            values = turned_stokes(got.total, got.polarised, *arrays[2:4])
            errors, axes = turned_errors(got, *arrays[2:4]), axes.with_axis("stokes", STOKES)
        sun, unit = self.lights[0].irradiance, "W m-2 sr-1 nm-1"
        found = self._labelled(values * sun, axes, "radiance", unit)
        spread = self._labelled(errors * sun, axes, "standard error", unit)
        return found.assign_coords(standard_error=spread)

    def _diffuse(self, r: FloatArray, mu_s: FloatArray) -> dict[str, tuple[str, FloatArray]]:
        got = self._sky(r, mu_s)
        return {
            "diffuse": ("diffuse irradiance", got.total),
            "diffuse_standard_error": ("standard error of the diffuse irradiance", got.total_error),
        }

    def relative_sky_irradiance(self, r: FloatArray, mu_s: FloatArray) -> FloatArray:
        """See ``Solution``; all orders and directions are sampled."""
        return self._sky(r, mu_s).total

    def _sky(self, r: FloatArray, mu_s: FloatArray) -> Estimate:
        up = np.ones_like(r)
        r = self.geometry.optical_radius(r)
        lengths = vectorized(distance_to_top)(r, up, self.geometry.medium.top_radius)
        query = Query(np.stack([r, up, mu_s, mu_s], axis=1), lengths, 1, None, None)
        return self.answer(query, perf_counter())

    def relative_direct_irradiance(self, r: FloatArray, mu_s: FloatArray) -> FloatArray:
        """See ``Solution``; by quadrature."""
        if self.geometry.shell is None:
            return direct_irradiance(self.medium, r, mu_s)
        star = self.medium.lights[0].angular_radius
        return refracted_direct_irradiance(
            self.geometry, star, self.geometry.optical_radius(r), mu_s
        )

    def estimate(
        self,
        *,
        altitude: Measures,
        sun_zenith: Measures,
        view_zenith: Measures,
        azimuth: Measures = 0.0,
        stokes: bool = False,
    ) -> xarray.Dataset:
        """Radiance with standard error, and contribution of each order of scattering.

        The target error applies to radiance; errors of Q and U are about as large, in the same
        unit.

        Parameters
        ----------
        altitude, sun_zenith, view_zenith, azimuth : array
            Arguments of ``radiance``. [m], [deg]
        stokes : bool
            Whether to return also I, Q and U, as ``radiance`` does.

        Returns
        -------
        xarray.Dataset
            ``radiance`` and ``standard_error`` [W m⁻² sr⁻¹ nm⁻¹], ``histories`` and ``reached``
            (whether the target error was reached), each of shape (..., wavelength);
            ``order_radiance`` and ``order_standard_error`` of shape (..., order, wavelength);
            ``higher_radiance`` and ``higher_standard_error`` of all further orders; with
            ``stokes``, ``stokes_radiance`` and ``stokes_standard_error`` of shape
            (..., stokes, wavelength); for a vertical line, errors of Q and U are assumed
            independent.
        """
        if stokes:
            self.check_polarised()
        arrays, lines, axes = self._rays_from_arguments(altitude, sun_zenith, view_zenith, azimuth)
        got = self.trace(lines)
        sun = self.lights[0].irradiance
        unit = "W m-2 sr-1 nm-1"
        kept = self.settings.kept_orders

        def labelled(values: NDArray[Any], name: str, unit: str) -> xarray.DataArray:
            return self._labelled(values, axes, name, unit)

        import xarray

        data = xarray.Dataset(
            {
                "radiance": labelled(got.total * sun, "radiance", unit),
                "standard_error": labelled(got.total_error * sun, "standard error", unit),
                "histories": labelled(got.histories, "histories", "1").astype(np.int64),
                "reached": labelled(got.reached, "reached", "1").astype(bool),
                "higher_radiance": labelled(got.parts[:, kept] * sun, "higher radiance", unit),
                "higher_standard_error": labelled(
                    got.part_errors[:, kept] * sun, "higher standard error", unit
                ),
            }
        )
        for name, values in (
            ("order_radiance", got.parts),
            ("order_standard_error", got.part_errors),
        ):
            orders = [
                labelled(values[:, k] * sun, name.replace("_", " "), unit) for k in range(kept)
            ]
            joined = xarray.concat(orders, dim="order").assign_coords(order=np.arange(1, kept + 1))
            data[name] = joined.transpose(..., "order", "wavelength")
        if stokes:
            beside = axes.with_axis("stokes", STOKES)
            for name, stokes_values in (
                ("stokes_radiance", turned_stokes(got.total, got.polarised, *arrays[2:])),
                ("stokes_standard_error", turned_errors(got, *arrays[2:])),
            ):
                data[name] = self._labelled(
                    stokes_values * sun, beside, name.replace("_", " "), unit
                )
        data.attrs.update(self.provenance)
        return data


def turned_stokes(
    whole: FloatArray, polarised: FloatArray, view_zenith: FloatArray, azimuth: FloatArray
) -> FloatArray:
    """I, Q and U in the meridian frame of the observer's azimuths, (n, 3, nl)."""
    return to_meridian(np.concatenate([whole[:, None], polarised], axis=1), view_zenith, azimuth)


def turned_errors(got: Estimate, view_zenith: FloatArray, azimuth: FloatArray) -> FloatArray:
    """Standard errors of I, Q and U in that frame, shape (n, 3, nl), without covariances."""
    alone = np.eye(2)[:, None, :, None] * got.polarised_error
    q, u = (turned_stokes(got.total_error, one, view_zenith, azimuth) for one in alone)
    return np.concatenate([q[:, :1], np.hypot(q[:, 1:], u[:, 1:])], axis=1)


def disc_mean(
    medium: Medium, element: Callable[[FloatArray], FloatArray], nu: FloatArray
) -> FloatArray:
    """Element of the phase matrices, averaged over the star's disc.

    Parameters
    ----------
    element : callable
        Function of cosines of scattering angles: ``medium.phase_function`` or ``.phase_f12``.
    nu : array, shape (n,)
        Cosine between the view and the centre of the disc. [1]

    Returns
    -------
    array, shape (n, nc, nl)
        Mean element. [sr⁻¹]
    """
    radius = medium.lights[0].angular_radius
    if radius <= 0.0:
        return element(nu)
    rule = gauss_legendre(4)
    around = np.cos(np.pi * (np.arange(6) + 0.5) / 6)
    total = np.zeros((nu.size, *medium.scattering.shape))
    sine = np.sqrt(np.maximum((1.0 - nu) * (1.0 + nu), 0.0))
    for share, weight in zip(rule.nodes, rule.weights, strict=True):
        away = radius * np.sqrt(share)  # equal areas: uniform in the square of the radius
        for side in around:
            turned = np.clip(nu * np.cos(away) + sine * np.sin(away) * side, -1.0, 1.0)
            total += (weight / around.size) * element(turned)
    return total


def solve(
    medium: Medium,
    settings: MonteCarloSettings,
    *,
    cache: bool = True,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> MonteCarloSolution:
    """Monte Carlo solution of a medium.

    Parameters
    ----------
    medium : Medium
        Medium to solve.
    settings : MonteCarloSettings
        Stopping rule.
    cache : bool
        Ignored: nothing is cached on disk.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``; for every result.
    """
    return MonteCarloSolution(medium, settings, progress=progress, cancel=cancel)
