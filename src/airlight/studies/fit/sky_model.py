"""Model of a measured sky: radiance of a parametrised planet in the measured directions."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any, Final, Literal

import numpy as np
from numpy.typing import NDArray

from airlight.errors import Cancelled
from airlight.kernel import disk
from airlight.kernel.cache import Cache
from airlight.kernel.fingerprints import fingerprint
from airlight.kernel.threads import Cancel, Progress
from airlight.planets.medium import Medium
from airlight.planets.planet import Planet
from airlight.solver.moments.delta_m import Optics
from airlight.solver.moments.settings import MomentsSettings, settings_for
from airlight.solver.solution import Solution
from airlight.solver.solve import solve
from airlight.studies.fit.least_squares import difference
from airlight.studies.fit.measurements import IntArray, turned
from airlight.studies.fit.parameter import FitParameter

FloatArray = NDArray[np.float64]

#: Largest numbers of cached predictions and solutions.
_MOST_PREDICTIONS: Final = 256
_MOST_SOLUTIONS: Final = 2
#: Tolerance of solutions: all orders, so that their number makes no jump between two neighbours.
_TOLERANCE: Final = 1e-4


@dataclass(frozen=True, eq=False)
class ObservedDirections:
    """Observed directions of a sky, nd of them.

    Attributes
    ----------
    altitude : array, shape (nd,)
        [m]
    sun_zenith, view_zenith, azimuth : array, shape (nd,)
        [deg]
    scan : array of int, shape (nd,)
        Scan of each direction, from 0.
    """

    altitude: FloatArray
    sun_zenith: FloatArray
    view_zenith: FloatArray
    azimuth: FloatArray
    scan: IntArray

    def fingerprint(self) -> bytes:
        """Bytes of all numbers."""
        parts = (self.altitude, self.sun_zenith, self.view_zenith, self.azimuth, self.scan)
        return b"".join(np.ascontiguousarray(one).tobytes() for one in parts)


@dataclass(frozen=True, kw_only=True, eq=False)
class Nuisance:
    """Parameter of the instrument.

    Attributes
    ----------
    parameter : FitParameter
    kind : str
        ``factor`` of predicted values, or an offset of the ``zenith`` or ``azimuth``. [1] or [deg]
    values : array of bool, shape (n,)
        Affected predicted values.
    scans : array of bool, shape (number of scans,)
        Affected scans.
    """

    parameter: FitParameter
    kind: Literal["factor", "zenith", "azimuth"]
    values: NDArray[np.bool_]
    scans: NDArray[np.bool_]


@dataclass(kw_only=True, eq=False)
class SkyModel:
    """Model of predicted values for parameters of the planet, then of the instrument.

    Attributes
    ----------
    planet_of : callable
        Function from parameters, shape (p,), to a planet.
    parameters : sequence of FitParameter
        Parameters of the planet.
    nuisances : sequence of Nuisance
        Parameters of the instrument.
    directions : ObservedDirections
    wavelengths : array, shape (nl,)
        Wavelengths of the solution. [nm]
    combine : callable
        ``combine(radiance, solution)``: predicted values, shape (n,), from radiances (nd, nl).
    bandwidth : array, shape (nl,), or None
        Full widths of bands around the wavelengths; see ``solve``. [nm]
    quality : str or MomentsSettings
        Quality of the solver.
    identity : bytes
        Fingerprint of further inputs, for the cache of predictions on disk; empty for no cache.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``.
    expected : int
        Expected number of solutions, for progress.
    solves : int
        Number of solutions so far, without cached predictions.
    """

    planet_of: Callable[[FloatArray], Planet]
    parameters: Sequence[FitParameter]
    nuisances: Sequence[Nuisance]
    directions: ObservedDirections
    wavelengths: FloatArray
    combine: Callable[[FloatArray, Solution], FloatArray]
    bandwidth: FloatArray | None = None
    quality: Any = "default"
    identity: bytes = b""
    progress: Progress | None = None
    cancel: Cancel | None = None
    expected: int = 1
    solves: int = field(default=0, init=False)
    _predictions: Cache[bytes, FloatArray] = field(
        default_factory=lambda: Cache(_MOST_PREDICTIONS), init=False
    )
    _solutions: Cache[bytes, Solution] = field(
        default_factory=lambda: Cache(_MOST_SOLUTIONS), init=False
    )
    _turned: Cache[bytes, FloatArray] = field(default_factory=lambda: Cache(1), init=False)

    @property
    def all_parameters(self) -> tuple[FitParameter, ...]:
        """Parameters of the planet, then of the instrument."""
        return (*self.parameters, *(one.parameter for one in self.nuisances))

    def __call__(self, values: FloatArray) -> FloatArray:
        """Predicted values, shape (n,)."""
        count = len(self.parameters)
        zenith, azimuth = self._offsets(values)
        predicted = self._seen(values[:count], zenith, azimuth).copy()
        for one, value in zip(self.nuisances, values[count:], strict=True):
            if one.kind == "factor":
                predicted[one.values] *= value
        return predicted

    def derivative(self, values: FloatArray, index: int, *, central: bool) -> FloatArray:
        """Derivative of the predicted values by a parameter, shape (n,)."""
        count = len(self.parameters)
        if index < count:
            return difference(self, self.all_parameters[index], values, index, central=central)
        one = self.nuisances[index - count]
        if one.kind == "factor":  # linear, so exact
            return np.where(one.values, self(values) / values[index], 0.0)
        return np.where(one.values, self._turning(values, one.kind), 0.0)

    def _turning(self, values: FloatArray, kind: str) -> FloatArray:
        """Derivative by an offset of pointing, computed for all scans at once."""

        def made() -> FloatArray:
            count = len(self.parameters)
            sides = []
            for sign in (1.0, -1.0):
                moved = values.copy()
                for k, one in enumerate(self.nuisances):
                    if one.kind == kind:
                        moved[count + k] += sign * one.parameter.least_step
                sides.append(self(moved))
            step = next(o.parameter.least_step for o in self.nuisances if o.kind == kind)
            return (sides[0] - sides[1]) / (2.0 * step)

        return self._turned.of(kind.encode() + values.tobytes(), made)

    def _offsets(self, values: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Offsets of zenith angle and azimuth of each scan. [deg]"""
        scans = int(self.directions.scan.max()) + 1
        found = {"zenith": np.zeros(scans), "azimuth": np.zeros(scans)}
        for one, value in zip(self.nuisances, values[len(self.parameters) :], strict=True):
            if one.kind != "factor":
                found[one.kind][one.scans] += value
        return found["zenith"], found["azimuth"]

    def _seen(self, physical: FloatArray, zenith: FloatArray, azimuth: FloatArray) -> FloatArray:
        key = physical.tobytes() + zenith.tobytes() + azimuth.tobytes()
        computed = partial(self._computed, physical, zenith, azimuth)
        return self._predictions.of(key, lambda: self._from_disk(key, computed))

    def _from_disk(self, key: bytes, compute: Callable[[], FloatArray]) -> FloatArray:
        if not self.identity:
            return compute()
        sources = fingerprint(Path(__file__)).encode()
        widths = b"" if self.bandwidth is None else self.bandwidth.tobytes()
        seen = self.directions.fingerprint(), self.wavelengths.tobytes(), widths
        parts = (b"fit", sources, self.identity, *seen, str(self.quality).encode(), key)
        name = hashlib.sha256(b"\0".join(parts)).hexdigest()[:40]
        return disk.cached(
            name, compute, lambda found: {"predicted": found}, lambda kept: kept.get("predicted")
        )

    def _computed(
        self, physical: FloatArray, zenith: FloatArray, azimuth: FloatArray
    ) -> FloatArray:
        solution = self._solution(physical)
        seen = self.directions
        view, around = turned(seen.view_zenith, seen.azimuth, zenith[seen.scan], azimuth[seen.scan])
        radiance = solution.radiance(
            altitude=seen.altitude, sun_zenith=seen.sun_zenith, view_zenith=view, azimuth=around
        )
        return self.combine(np.asarray(radiance.values, dtype=np.float64), solution)

    def _solution(self, physical: FloatArray) -> Solution:
        def made() -> Solution:
            if self.cancel is not None and self.cancel():
                raise Cancelled("cancelled")
            self._report(physical)
            planet = self.planet_of(physical)
            solution = solve(
                planet,
                self.wavelengths,
                self.quality,
                bandwidth=self.bandwidth,
                cache=False,
                cancel=self.cancel,
            )
            self.solves += 1
            return solution

        return self._solutions.of(physical.tobytes(), made)

    def _report(self, physical: FloatArray) -> None:
        if self.progress is None:
            return
        self.expected = max(self.expected, self.solves + 1)
        shown = ", ".join(
            f"{one.name} {value:.4g}"
            for one, value in zip(self.parameters[:3], physical, strict=False)
        )
        self.progress(self.solves, self.expected, f"fit: {shown}")


def smooth(quality: str) -> MomentsSettings:
    """Solver settings without jumps in predictions: tolerance, and one degree for all media."""
    settings = settings_for(quality)
    return replace(settings, degree=settings.thick_degree, tolerance=_TOLERANCE)


def smooth_near(quality: str, planet: Planet, wavelengths: FloatArray) -> MomentsSettings:
    """Settings of ``smooth`` with the degree of the harmonics of a planet at this quality.

    Optically thin media have a lower degree, whose effect on the radiance of haze exceeds the
    differences of a fit. ``preview`` keeps the higher degree, as in the first rounds of a fit.

    Parameters
    ----------
    planet : Planet
        Planet near the solution of the fit.
    wavelengths : array, shape (nl,)
        Wavelengths of the solution. [nm]
    """
    if quality == "preview":
        return smooth(quality)
    medium = Medium.from_planet(planet, wavelengths)
    degree = Optics.chosen(medium, settings_for(quality)).degree
    return replace(smooth(quality), degree=degree, thick_degree=degree)
