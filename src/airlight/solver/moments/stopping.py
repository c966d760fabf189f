"""Stopping rule of the iteration, shared by CPU, GPU and browser.

After each order the mean radiances at the nodes are compared with the previous ones
(``convergence.counted_changes``), and the sum of all further orders is estimated from the
convergence rate (``estimated_tail``); the iteration ends where that is below the tolerance.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from math import inf, isfinite, log
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ConvergenceError
from airlight.solver.moments.acceleration import mixing_weights
from airlight.solver.moments.convergence import (
    BACK,
    counted_changes,
    estimated_tail,
)
from airlight.solver.moments.settings import MomentsSettings

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Number of iterates in Anderson acceleration: on the CPU, and on the GPU, where each is a texture.
SWEEP_ITERATES: Final = 7
PASS_ITERATES: Final = 5
#: An iteration diverges if the largest change has not fallen below this fraction of its minimum for
#: so many orders.
PATIENCE: Final = 4
BETTER: Final = 0.8
#: Number of orders over which the convergence rate is measured before the iteration is abandoned.
PROSPECT: Final = 10
#: Largest ratio of successive orders that counts as converging. [1]
SLOWEST: Final = 0.999
#: Largest number of orders on the GPU; thicker media are left to the CPU.
MOST_PASSES: Final = 60


@dataclass(frozen=True, kw_only=True)
class Stopping:
    """Parameters of the stopping rule.

    Attributes
    ----------
    tolerance : float
        Largest remaining relative change. [1]
    most_sweeps : int
        Largest number of sweeps.
    iterates : int
        Number of iterates in Anderson acceleration.
    stricter : float
        Relative reduction of the tolerance in optically thick media: 0 with synthetic acceleration,
        where the last change is nearly the whole error; larger without, where many small orders
        follow. [1]
    night : float
        Factor of the exponent of ``count_at`` in the stopping decision: 1 with synthetic
        acceleration, whose error on the night side of thick media is not visible; less without,
        where only further orders illuminate it. [1]
    """

    tolerance: float
    most_sweeps: int
    iterates: int
    stricter: float
    night: float

    @classmethod
    def of_sweeps(cls, settings: MomentsSettings) -> Stopping:
        """Rule for the CPU, with synthetic acceleration."""
        return cls(
            tolerance=settings.tolerance,
            most_sweeps=settings.max_sweeps,
            iterates=SWEEP_ITERATES,
            stricter=0.0,
            night=1.0,
        )

    @classmethod
    def of_passes(cls, settings: MomentsSettings) -> Stopping:
        """Rule for the GPU, in Python and in the browser: plain successive orders in float32."""
        return cls(
            tolerance=settings.tolerance,
            most_sweeps=min(settings.max_sweeps, MOST_PASSES),
            iterates=PASS_ITERATES,
            stricter=0.9,
            night=0.25,
        )

    def tolerance_in(self, thick: FloatArray) -> float:
        """Tolerance for the thickest lane. [1]"""
        return stricter_tolerance(self.tolerance, self.stricter, float(thick.max()))


def stricter_tolerance(tolerance: float, stricter: float, thick: float) -> float:
    """Tolerance in a medium whose weight of ``Stopping.stricter`` is ``thick``. [1]"""
    return tolerance * (1.0 - stricter * thick)


def is_converged(sweeps: int, fewest: int, error: float, tolerance: float) -> bool:
    """Whether the remaining error is within the tolerance, after the fewest sweeps at least."""
    return sweeps >= fewest and error <= tolerance


def logarithmic_progress(error: float, tolerance: float) -> float:
    """Progress: 0 at a remaining error of 1, 1 at the tolerance. [1]"""
    if error <= tolerance:
        return 1.0
    return log(min(error, 1.0)) / log(tolerance)


class Iteration:
    """State of the iteration: remaining error and Anderson weights.

    Parameters
    ----------
    stopping : Stopping
        Stopping rule.
    thick : array, shape (w,)
        Exponent of ``count_at``, from ``WavelengthBatch``: 1 where the tolerance is absolute. [1]
    used : int
        Number of wavelengths; further lanes are padding.
    least : int
        Smallest number of orders.

    Attributes
    ----------
    sweeps : int
        Number of sweeps so far.
    remaining_error : array, shape (used,)
        Estimated largest relative change by all further sweeps. [1]
    accelerated : bool
        Whether Anderson acceleration is used.
    """

    def __init__(self, stopping: Stopping, thick: FloatArray, used: int, *, least: int = 2) -> None:
        self._fewest = least
        self.stopping, self.thick, self.used = stopping, thick, used
        self.tolerance = stopping.tolerance_in(thick)
        self.sweeps = 0
        self.remaining_error = np.full(used, np.inf)
        self.accelerated = True
        self._residuals: deque[FloatArray] = deque(maxlen=stopping.iterates)
        self._changes: list[float] = []
        self._ahead: list[float] = []
        self._least, self._since = inf, 0

    def set_prediction(self, change: FloatArray) -> None:
        """Set a predicted remaining error; within the tolerance, no sweep is needed.

        Parameters
        ----------
        change : array, shape (used,)
            Predicted largest relative change by all sweeps. [1]
        """
        if change.max() <= self.tolerance:
            self.remaining_error, self._fewest = change, 0

    def unfinished(self) -> bool:
        """Whether another order is needed."""
        error = float(self.remaining_error.max())
        if is_converged(self.sweeps, self._fewest, error, self.tolerance):
            return False
        self._look_ahead()
        if self.sweeps >= self.stopping.most_sweeps:
            raise ConvergenceError(
                f"after {self.sweeps} sweeps the last one still changed the radiance by "
                f"{self.remaining_error.max():.1e}, more than the tolerance {self.tolerance:g}"
            )
        return True

    def update(self, before: Float32Array, after: Float32Array) -> None:
        """Update the remaining error after a sweep.

        Parameters
        ----------
        before, after : array, shape (r, n, w)
            Quantities of the guess and of its iterate, from ``convergence_quantities``. [1]
        """
        lanes = self.thick.size
        changes, largest = np.empty((after.size // lanes, lanes)), np.zeros(lanes)
        brightest = after.max(axis=(0, 1)).astype(float)
        counted_changes(before, after, self.thick, self.stopping.night, brightest, changes, largest)
        self._residuals.append(changes)
        self.remaining_error = (largest * estimated_tail(self._residuals))[: self.used]
        self.sweeps += 1
        size = float(largest[: self.used].max())
        if not isfinite(size) or not np.isfinite(after[..., : self.used]).all():
            raise ConvergenceError(
                f"radiance of order {self.sweeps} is not a finite number: the optical properties "
                "exceed the range of single precision"
            )
        self._changes.append(size)
        if not self.accelerated:
            # Plain successive orders: the geometric tail has no upper limit.
            ratio = self._ratio_over(BACK) if len(self._changes) > BACK else SLOWEST
            self.remaining_error = largest[: self.used] * max(ratio / (1.0 - ratio), 1.0)
        self._ahead.append(float(self.remaining_error.max()))
        self._since += 1
        if size < BETTER * self._least:
            self._least, self._since = size, 0

    @property
    def improved(self) -> bool:
        """Whether the last change is the smallest so far."""
        return self._since == 0

    @property
    def diverging(self) -> bool:
        """Whether the changes no longer decrease."""
        return self._since >= PATIENCE

    def restart(self, *, accelerated: bool) -> None:
        """Discard the iterates, for another guess or scheme."""
        self._residuals.clear()
        self._changes.clear()
        self._ahead.clear()
        self._least, self._since = inf, 0
        self.accelerated = accelerated

    def _ratio_over(self, steps: int) -> float:
        """Ratio of successive changes over the last steps, below 1. [1]"""
        first, last = self._changes[-1 - steps], self._changes[-1]
        ratio: float = (last / max(first, 1e-30)) ** (1.0 / steps)
        return min(ratio, SLOWEST)

    def _look_ahead(self) -> None:
        """Raise an error if successive orders stall or need more than the largest number of sweeps.

        If the changes decrease but the remaining error does not, their ratio approaches 1, and the
        number of sweeps predicted from it would be too small.
        """
        if self.accelerated or len(self._changes) <= PROSPECT:
            return
        last, ratio = self._ahead[-1], self._ratio_over(PROSPECT)
        needed = log(self.tolerance / last) / log(ratio) if ratio > 0.0 else 0.0
        measured = len(self._changes) > BACK + PROSPECT  # before, no ratio was known
        stalls = measured and last > self._ahead[-1 - PROSPECT]
        if stalls or needed > self.stopping.most_sweeps - self.sweeps:
            raise ConvergenceError(
                f"after {self.sweeps} sweeps each order of scattering is still {ratio:.3f} of the "
                f"previous one, and the remaining error {last:.1e} exceeds the tolerance "
                f"{self.tolerance:g}"
            )

    def weights(self) -> FloatArray:
        """Anderson weights of the iterates, the latest last, shape (iterates, w). [1]"""
        residuals = np.stack(self._residuals)
        weights = np.zeros((residuals.shape[0], self.thick.size))
        weights[-1] = 1.0
        if not self.accelerated:
            return weights
        for lane in range(self.used):
            weights[:, lane] = mixing_weights(residuals[:, :, lane])
        return weights

    @property
    def progress(self) -> float:
        """Progress from ``logarithmic_progress``. [1]"""
        return logarithmic_progress(float(self.remaining_error.max()), self.tolerance)
