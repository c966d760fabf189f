"""Convergence of the orders of scattering: one rule for sweeps, passes and pages.

After each order the mean radiances at the nodes are compared with the previous ones
(``convergence.counted_changes``); the sum of all further orders is estimated from how
the changes shrink (``estimated_tail``); where that is below the tolerance the iteration ends.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from math import inf, isfinite, log
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ConvergenceError
from airlight.solvers.moments.acceleration import mixing_weights
from airlight.solvers.moments.convergence import (
    BACK,
    counted_changes,
    estimated_tail,
)
from airlight.solvers.moments.settings import Settings

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Number of iterates that Anderson acceleration combines: of the CPU's sweeps, and of GPU passes,
#: where each is a texture that the shader reads.
SWEEP_ITERATES: Final = 7
PASS_ITERATES: Final = 5
#: An iteration diverges when so many orders in succession have not brought the largest change
#: below this fraction of its smallest so far.
PATIENCE: Final = 4
BETTER: Final = 0.8
#: Number of orders over which the ratio of successive ones is measured before it is given up.
PROSPECT: Final = 10
#: Largest ratio of successive orders that is taken for one that shrinks. [1]
SLOWEST: Final = 0.999
#: Number of orders after which passes give up: such air is left to the CPU.
MOST_PASSES: Final = 60


@dataclass(frozen=True, kw_only=True)
class Stopping:
    """Parameters of the stopping rule, with their values for sweeps and for passes.

    Attributes
    ----------
    tolerance : float
        Largest remaining change, relative to the light. [1]
    most_sweeps : int
        Number of sweeps after which the iteration gives up.
    iterates : int
        Number of iterates that are combined into the next guess.
    stricter : float
        Fraction by which the tolerance is smaller in thick air. With synthetic acceleration the
        last change is nearly the whole error: 0. GPU passes are not accelerated; there many small
        orders follow. [1]
    night : float
        Fraction of the thickness by which a change in the night counts less when the rule decides
        to stop. The error that acceleration leaves in the night of thick air is not visible: 1. In
        GPU passes only more orders bring light there: less. [1]
    """

    tolerance: float
    most_sweeps: int
    iterates: int
    stricter: float
    night: float

    @classmethod
    def of_sweeps(cls, settings: Settings) -> Stopping:
        """Rule of the CPU, whose sweeps have synthetic acceleration."""
        return cls(
            tolerance=settings.tolerance,
            most_sweeps=settings.max_sweeps,
            iterates=SWEEP_ITERATES,
            stricter=0.0,
            night=1.0,
        )

    @classmethod
    def of_passes(cls, settings: Settings) -> Stopping:
        """Rule of a GPU, in Python and in a page: orders alone, in float32."""
        return cls(
            tolerance=settings.tolerance,
            most_sweeps=min(settings.max_sweeps, MOST_PASSES),
            iterates=PASS_ITERATES,
            stricter=0.9,
            night=0.25,
        )

    def tolerance_in(self, thick: FloatArray) -> float:
        """Tolerance in air as thick as its thickest lane. [1]"""
        return self.tolerance * (1.0 - self.stricter * float(thick.max()))


class Iteration:
    """State of the iteration: remaining error and weights of the next guess.

    Parameters
    ----------
    stopping : Stopping
        Stopping rule.
    thick : array, shape (w,)
        Exponent of ``count_at``, from ``WavelengthBatch``: 1 where the tolerance is absolute. [1]
    used : int
        Number of lanes that have their own wavelength; the others follow and do not count.
    least : int
        Least number of orders: one where the light of near wavelengths was the first guess.

    Attributes
    ----------
    sweeps : int
        Number of sweeps so far.
    remaining_error : array, shape (used,)
        Estimated largest relative change by all further sweeps. [1]
    accelerated : bool
        Whether iterates are combined; otherwise the latest is the next guess.
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
        """Set a predicted remaining error; if it is within the tolerance, no sweep is needed.

        Parameters
        ----------
        change : array, shape (used,)
            Predicted largest relative change by all sweeps. [1]
        """
        if change.max() <= self.tolerance:
            self.remaining_error, self._fewest = change, 0

    def unfinished(self) -> bool:
        """Whether another order is needed.

        Raises
        ------
        ConvergenceError
            If another is needed after the rule's largest number, or if the orders shrink so slowly
            that more than that number would be.
        """
        if self.sweeps >= self._fewest and self.remaining_error.max() <= self.tolerance:
            return False
        self._look_ahead()
        if self.sweeps >= self.stopping.most_sweeps:
            raise ConvergenceError(
                f"after {self.sweeps} sweeps the last still changed the light by "
                f"{self.remaining_error.max():.1e}, more than the tolerance {self.tolerance:g}"
            )
        return True

    def update(self, before: Float32Array, after: Float32Array) -> None:
        """Update the remaining error by one more sweep.

        Parameters
        ----------
        before, after : array, shape (r, n, w)
            Values at each radius, of the guess and of its iterate, whose changes count relative to
            the iterate: mean radiances, at least. [1]
        """
        lanes = self.thick.size
        changes, largest = np.empty((after.size // lanes, lanes)), np.empty(lanes)
        brightest = after.max(axis=(0, 1)).astype(float)
        counted_changes(before, after, self.thick, self.stopping.night, brightest, changes, largest)
        self._residuals.append(changes)
        self.remaining_error = (largest * estimated_tail(self._residuals))[: self.used]
        self.sweeps += 1
        size = float(largest[: self.used].max())
        if not isfinite(size) or not np.isfinite(after[..., : self.used]).all():
            raise ConvergenceError(
                f"the light of order {self.sweeps} is not a finite number: the air's numbers are "
                "beyond single precision"
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
        """Whether the last sweep changed the light by less than all before."""
        return self._since == 0

    @property
    def diverging(self) -> bool:
        """Whether the changes have ceased to shrink."""
        return self._since >= PATIENCE

    def restart(self, *, accelerated: bool) -> None:
        """Discard the iterates: the iteration restarts from another guess, or by another scheme."""
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
        """Raise if plain successive orders stall or need more than the largest number of sweeps.

        Where the changes shrink but the remaining error does not, their ratio approaches 1: the
        number of sweeps predicted from the ratio so far would be too small.
        """
        if self.accelerated or len(self._changes) <= PROSPECT:
            return
        last, ratio = self._ahead[-1], self._ratio_over(PROSPECT)
        needed = log(self.tolerance / last) / log(ratio) if ratio > 0.0 else 0.0
        measured = len(self._changes) > BACK + PROSPECT  # before, no ratio was known
        stalls = measured and last > self._ahead[-1 - PROSPECT]
        if stalls or needed > self.stopping.most_sweeps - self.sweeps:
            raise ConvergenceError(
                f"after {self.sweeps} sweeps each order of scattering still has {ratio:.3f} of the "
                f"one before, and the remaining error {last:.1e} exceeds the tolerance "
                f"{self.tolerance:g}"
            )

    def weights(self) -> FloatArray:
        """Anderson weights of the last iterates, the latest last, shape (iterates, w). [1]"""
        residuals = np.stack(self._residuals)
        weights = np.zeros((residuals.shape[0], self.thick.size))
        weights[-1] = 1.0
        if not self.accelerated:
            return weights
        for lane in range(self.used):
            weights[:, lane] = mixing_weights(residuals[:, :, lane])
        return weights

    @property
    def share(self) -> float:
        """Logarithmic progress: 0 at a remaining error of 1, 1 at the tolerance."""
        largest = float(self.remaining_error.max())
        if largest <= self.tolerance:
            return 1.0
        return log(min(largest, 1.0)) / log(self.tolerance)
