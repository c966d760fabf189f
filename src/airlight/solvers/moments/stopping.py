"""Convergence of the orders of scattering: one rule for sweeps, passes and pages.

After each order the mean radiances at the nodes are compared with the previous ones
(``convergence.relative_change``, ``counts``); the sum of all further orders is estimated from how
the changes shrink (``remaining_change``); where that is below the tolerance the iteration ends.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from math import log
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ConvergenceError
from airlight.solvers.moments.acceleration import mixing_weights
from airlight.solvers.moments.convergence import counts, relative_change, remaining_change
from airlight.solvers.moments.settings import Settings

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Images of the light that the acceleration combines: of the CPU's sweeps, and of passes, where
#: each is a texture that the shader reads.
SWEEP_IMAGES: Final = 7
PASS_IMAGES: Final = 5
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

    Attributes
    ----------
    sweeps : int
        Number of orders that were judged.
    to_come : array, shape (used,)
        Largest relative change by all further orders. [1]
    """

    def __init__(self, stopping: Stopping, thick: FloatArray, used: int) -> None:
        self.stopping, self.thick, self.used = stopping, thick, used
        self.tolerance = stopping.tolerance_in(thick)
        self.sweeps = 0
        self.to_come = np.full(used, np.inf)
        self._residuals: deque[FloatArray] = deque(maxlen=stopping.images)

    def goes_on(self) -> bool:
        """Whether another order is needed.

        Raises
        ------
        ConvergenceError
            If another is needed after the rule's largest number.
        """
        if self.sweeps > 1 and self.to_come.max() <= self.tolerance:
            return False
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
        change = relative_change(before, after)
        steering = change * counts(after, self.thick)
        self._residuals.append(steering.reshape(-1, self.thick.size))
        deciding = change * counts(after, self.stopping.night * self.thick)
        largest = np.abs(deciding).max(axis=(0, 1)) * remaining_change(self._residuals)
        self.to_come = largest[: self.used]
        self.sweeps += 1

    def weights(self) -> FloatArray:
        """Weights of the last images in the next guess, shape (images so far, w), latest last."""
        residuals = np.stack(self._residuals)
        weights = np.zeros((residuals.shape[0], self.thick.size))
        weights[-1] = 1.0
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
