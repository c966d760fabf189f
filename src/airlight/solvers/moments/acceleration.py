"""Anderson's acceleration of a fixed-point iteration, one wavelength at a time.

For X ← G(X) the next guess is the combination of the last few G(X_i) whose residuals G(X_i) - X_i
combine to the smallest one. Clear air needs no help (the change falls to a third each order);
in thick air, where it falls by a few per cent, this is what makes the iteration end.
Source: D. G. Anderson (1965), J. ACM 12, 547; type II of Walker & Ni (2011), SIAM J. Numer. Anal.
49, 1715.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


class Anderson:
    """Remembers the last steps of one iteration.

    Parameters
    ----------
    depth : int
        How many differences are kept.
    """

    def __init__(self, depth: int = 6) -> None:
        self._depth = depth
        self._guesses: list[FloatArray] = []
        self._residuals: list[FloatArray] = []

    def step(self, guess: FloatArray, image: FloatArray, weight: FloatArray) -> FloatArray:
        """The next guess.

        Parameters
        ----------
        guess, image : array, shape (n,)
            X and G(X).
        weight : array, shape (n,)
            Residuals are measured after multiplication by this.

        Returns
        -------
        array, shape (n,)
        """
        self._guesses.append(guess)
        self._residuals.append(image - guess)
        del self._guesses[: -self._depth - 1]
        del self._residuals[: -self._depth - 1]
        if len(self._residuals) < 2:
            return image
        residuals = np.stack(self._residuals)
        steps = np.diff(np.stack(self._guesses), axis=0)
        changes = np.diff(residuals, axis=0)
        weighted = changes * weight
        # Normal equations with a whisper of ridge: the changes become parallel near the end.
        normal = weighted @ weighted.T
        normal[np.diag_indices_from(normal)] *= 1.0 + 1e-10
        try:
            mix = np.linalg.solve(normal, weighted @ (residuals[-1] * weight))
        except np.linalg.LinAlgError:
            return image
        if not np.isfinite(mix).all():
            return image
        return np.asarray(image - mix @ (steps + changes))
