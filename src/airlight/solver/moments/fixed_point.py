"""Fixed-point iteration of the source function, by one loop on CPU and GPU.

A ``Backend`` has the operations on fields, in arrays or in textures; ``Iteration`` has the scalar
decisions: stopping, error estimate, Anderson weights, divergence.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from airlight.errors import Cancelled
from airlight.kernel.threads import Cancel
from airlight.solver.moments.stopping import Iteration

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]


class Backend(ABC):
    """Operations on the fields of an iteration, which hold the current guess."""

    @abstractmethod
    def sweep(self) -> None:
        """Compute the next iterate from the guess."""

    @abstractmethod
    def reduce(self) -> tuple[Float32Array, Float32Array]:
        """Quantities (r, n, w) of the guess and of its iterate whose change is tested. [1]"""

    @abstractmethod
    def combine(self, weights: FloatArray, *, best: bool) -> None:
        """Compute the next guess: an Anderson step over the last iterates.

        Parameters
        ----------
        weights : array, shape (iterates, w)
            Anderson weights, the latest last. [1]
        best : bool
            Whether the last iterate is the one from which ``fall_back`` would restart.
        """

    def fall_back(self) -> bool | None:
        """Restart with the next scheme: whether it is accelerated; None if there is none."""
        return None


def iterate(
    backend: Backend,
    iteration: Iteration,
    *,
    report: Callable[[Iteration], None],
    cancel: Cancel | None = None,
) -> None:
    """Sweep until the remaining error is within the tolerance.

    Parameters
    ----------
    backend : Backend
        Fields, which hold the initial guess, and receive the solution.
    iteration : Iteration
        Decisions, from the first sweep on.
    report : callable
        Called after each sweep.
    cancel : callable, optional
        Asked before each sweep whether to stop.

    Raises
    ------
    ConvergenceError
        If ``iteration`` stalls, or reaches its largest number of sweeps.
    Cancelled
        If ``cancel`` says so.
    """
    while iteration.unfinished():
        if iteration.diverging:
            accelerated = backend.fall_back()
            if accelerated is not None:
                iteration.restart(accelerated=accelerated)
        if cancel is not None and cancel():
            raise Cancelled("cancelled")
        backend.sweep()
        iteration.update(*backend.reduce())
        report(iteration)
        backend.combine(iteration.weights(), best=iteration.improved)
