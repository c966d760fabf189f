"""Convergence of the orders of scattering: one rule for sweeps, passes and pages.

After each order the mean radiances at the nodes are compared with the previous ones
(``convergence.counted_changes``); the sum of all further orders is estimated from how
the changes shrink (``remaining_change``); where that is below the tolerance the iteration ends.
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
    remaining_change,
)
from airlight.solvers.moments.settings import Settings

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Images of the light that the acceleration combines: of the CPU's sweeps, and of passes, where
#: each is a texture that the shader reads.
SWEEP_IMAGES: Final = 7
PASS_IMAGES: Final = 5
#: An iteration strays when so many orders in succession have not brought the largest change below
#: this part of its smallest so far.
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
        Largest change that may still be to come, relative to the sum. [1]
    most_sweeps : int
        Number of orders after which the iteration gives up.
    images : int
        Number of the last images that are combined into the next guess.
    stricter : float
        Fraction by which the tolerance is smaller in thick air. Sweeps are completed by the inverse
        along the vertical, so that the last change is nearly all that was missing: 0. Passes have
        no inverse; there many small orders follow, and the last says less about them. [1]
    night : float
        Fraction of the thickness by which a change in the night counts less when the rule decides
        to stop. The error that the inverse leaves in the night of thick air cannot be seen: 1. In
        passes only more orders bring light there: less. [1]
    """

    tolerance: float
    most_sweeps: int
    images: int
    stricter: float
    night: float

    @classmethod
    def of_sweeps(cls, settings: Settings) -> Stopping:
        """Rule of the CPU, whose sweeps are completed along the vertical."""
        return cls(
            tolerance=settings.tolerance,
            most_sweeps=settings.max_sweeps,
            images=SWEEP_IMAGES,
            stricter=0.0,
            night=1.0,
        )

    @classmethod
    def of_passes(cls, settings: Settings) -> Stopping:
        """Rule of a GPU, in Python and in a page: orders alone, in float32."""
        return cls(
            tolerance=settings.tolerance,
            most_sweeps=min(settings.max_sweeps, MOST_PASSES),
            images=PASS_IMAGES,
            stricter=0.9,
            night=0.25,
        )

    def tolerance_in(self, thick: FloatArray) -> float:
        """Tolerance in air as thick as its thickest lane. [1]"""
        return self.tolerance * (1.0 - self.stricter * float(thick.max()))


class Iteration:
    """State of the successive orders: what is still to come, and how to go on.

    Parameters
    ----------
    stopping : Stopping
        Stopping rule.
    thick : array, shape (w,)
        Thickness from ``Block``: where the tolerance becomes absolute. [1]
    used : int
        Number of lanes that have their own wavelength; the others follow and do not count.
    least : int
        Least number of orders: one where the light of near wavelengths was the first guess.

    Attributes
    ----------
    sweeps : int
        Number of orders that were judged.
    to_come : array, shape (used,)
        Largest relative change by all further orders. [1]
    accelerated : bool
        Whether the last images are combined; otherwise the latest is the next guess.
    """

    def __init__(self, stopping: Stopping, thick: FloatArray, used: int, *, least: int = 2) -> None:
        self._fewest = least
        self.stopping, self.thick, self.used = stopping, thick, used
        self.tolerance = stopping.tolerance_in(thick)
        self.sweeps = 0
        self.to_come = np.full(used, np.inf)
        self.accelerated = True
        self._residuals: deque[FloatArray] = deque(maxlen=stopping.images)
        self._changes: list[float] = []
        self._ahead: list[float] = []
        self._least, self._since = inf, 0

    def foresee(self, change: FloatArray) -> None:
        """Take up what sweeps would change before there was one: within the tolerance, none is.

        Parameters
        ----------
        change : array, shape (used,)
            Largest relative change by all of them. [1]
        """
        if change.max() <= self.tolerance:
            self.to_come, self._fewest = change, 0

    def goes_on(self) -> bool:
        """Whether another order is needed.

        Raises
        ------
        ConvergenceError
            If another is needed after the rule's largest number, or if the orders shrink so slowly
            that more than that number would be.
        """
        if self.sweeps >= self._fewest and self.to_come.max() <= self.tolerance:
            return False
        self._look_ahead()
        if self.sweeps >= self.stopping.most_sweeps:
            raise ConvergenceError(
                f"after {self.sweeps} sweeps the last still changed the light by "
                f"{self.to_come.max():.1e}, more than the tolerance {self.tolerance:g}"
            )
        return True

    def judge(self, before: Float32Array, after: Float32Array) -> None:
        """Take up one more order.

        Parameters
        ----------
        before, after : array, shape (r, n, w)
            Values at each radius, of the guess and of its image, whose changes count relative to
            the image: mean radiances, at least. [1]
        """
        lanes = self.thick.size
        steering, largest = np.empty((after.size // lanes, lanes)), np.empty(lanes)
        brightest = after.max(axis=(0, 1)).astype(float)
        counted_changes(
            before, after, self.thick, self.stopping.night, brightest, steering, largest
        )
        self._residuals.append(steering)
        self.to_come = (largest * remaining_change(self._residuals))[: self.used]
        self.sweeps += 1
        size = float(largest[: self.used].max())
        if not isfinite(size) or not np.isfinite(after[..., : self.used]).all():
            raise ConvergenceError(
                f"the light of order {self.sweeps} is not a finite number: the air's numbers are "
                "beyond single precision"
            )
        self._changes.append(size)
        if not self.accelerated:
            # Nothing hastens these orders: however slowly they shrink, all of them follow.
            ratio = self._ratio_over(BACK) if len(self._changes) > BACK else SLOWEST
            self.to_come = largest[: self.used] * max(ratio / (1.0 - ratio), 1.0)
        self._ahead.append(float(self.to_come.max()))
        self._since += 1
        if size < BETTER * self._least:
            self._least, self._since = size, 0

    @property
    def best(self) -> bool:
        """Whether the last order changed the light by less than all before."""
        return self._since == 0

    @property
    def strays(self) -> bool:
        """Whether the changes have ceased to shrink."""
        return self._since >= PATIENCE

    def restart(self, *, accelerated: bool) -> None:
        """Forget the images so far: the light goes on from another guess, or in another way."""
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
        """Give up orders that no further way makes shrink, or that shrink too slowly.

        Orders that shrink while as much is still to come as before approach a ratio of 1: any
        number that is counted from their ratio so far would be too small.
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
                f"one before, and {last:.1e} of the light is still to come, more than the "
                f"tolerance {self.tolerance:g}"
            )

    def weights(self) -> FloatArray:
        """Weights of the last images in the next guess, shape (images so far, w), latest last."""
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
        """Progress by logarithm: 0 at a change of 1, 1 at the tolerance."""
        largest = float(self.to_come.max())
        if largest <= self.tolerance:
            return 1.0
        return log(min(largest, 1.0)) / log(self.tolerance)
