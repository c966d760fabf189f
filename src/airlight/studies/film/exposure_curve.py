"""Exposure curve of a film: metered at some frames, smoothed and interpolated."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property
from typing import Any, Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.studies.film.plan import FilmPlan

FloatArray: TypeAlias = NDArray[np.float64]

#: Smallest number of metered frames.
_FEWEST: Final = 7


def smoothed(values: FloatArray) -> FloatArray:
    """Binomial smoothing with weights 1, 4, 6, 4, 1.

    Linear sequences are unchanged, also at the ends, by linear extrapolation.

    Examples
    --------
    >>> smoothed(np.array([0.0, 0.0, 0.0, 16.0, 16.0, 16.0]))
    array([ 0.,  1.,  5., 11., 15., 16.])
    """
    if values.size < 3:
        return values
    out = values
    for _ in range(2):
        padded = np.concatenate([[2 * out[0] - out[1]], out, [2 * out[-1] - out[-2]]])
        out = 0.25 * padded[:-2] + 0.5 * padded[1:-1] + 0.25 * padded[2:]
    return out


class ExposureCurve:
    """Exposure of every frame, with a continuous first derivative.

    Parameters
    ----------
    numbers : sequence of int
        Numbers of the metered frames, ascending and about evenly spaced.
    metered : sequence of float
        Metered exposures. [EV]

    Examples
    --------
    >>> curve = ExposureCurve([0, 10, 20], [0.0, 1.0, 2.0])
    >>> float(curve.at(5))
    0.5
    """

    def __init__(self, numbers: Sequence[int], metered: Sequence[float]) -> None:
        found = np.asarray(metered, float)
        if not np.isfinite(found).all():
            raise ParameterError(
                "exposure", "auto", "a fixed exposure for a film with black frames"
            )
        self._numbers, self._values = np.asarray(numbers, float), smoothed(found)

    @cached_property
    def _curve(self) -> Any:
        from scipy.interpolate import PchipInterpolator

        return PchipInterpolator(self._numbers, self._values)

    def at(self, number: int) -> float:
        """Exposure of a frame. [EV]"""
        value = float(self._values[0] if self._numbers.size == 1 else self._curve(number))
        # Rounding errors of a curve are not part of a frame's definition.
        return float(f"{value:.6f}")


def metered_numbers(plan: FilmPlan) -> list[int]:
    """Indices of metered frames: about three per second, with the first and the last.

    At least seven, or all frames, as a short film may contain a whole sunset.
    """
    step = max(1, round(plan.rate / 3.0))
    count = min(plan.count, max(_FEWEST, 1 + math.ceil((plan.count - 1) / step)))
    if plan.count == 1:
        return [0]
    return sorted({round(k * (plan.count - 1) / (count - 1)) for k in range(count)})
