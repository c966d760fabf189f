"""Order in which many wavelengths are solved, and a guess of the light between those that are.

The inverse along the vertical turns the first order of scattering into a guess of all orders. What
the sweeps then add to it, over its mean radiance, is a smooth function of wavelength, so that
wavelengths between two that are solved begin with it and need one sweep where the others need three
or four, or none. Wavelengths run in panels: a panel's blocks of eight are combs, each with its
wavelengths all over the panel. The first and the last comb of a panel are solved before those
between them. What a sweep changes there tells how far the correction is from a straight line; where
it can change less than the tolerance, there is none.
"""

from __future__ import annotations

import itertools
from bisect import bisect
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel.lanes import LANES
from airlight.solvers.moments.convergence import DARK, Light

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Most blocks in a panel: as many are solved between two that are.
_PANEL: Final = 8
#: Fewest blocks that are worth a panel.
_FEWEST: Final = 2
#: Longest step between wavelengths of one block over the wavelength. [1]
_WIDE: Final = 0.1


def panels(wavelengths: FloatArray, *, clear: bool = True) -> list[list[slice]]:
    """Blocks of at most eight wavelengths in the order in which they are solved, by panel.

    Parameters
    ----------
    wavelengths : array, shape (nl,)
        Wavelengths in any order. [nm]
    clear : bool
        Whether the air is clear: in thick air it is the dusk that converges last, where what is
        left of a tolerance's size is no smooth function of wavelength.

    Returns
    -------
    list of list of slice
        Indices of the wavelengths of each block. Blocks of a panel help each other; where
        wavelengths are few, far apart or not ascending or descending, or the air is thick, each
        panel is one block.

    Examples
    --------
    >>> panels(np.linspace(500.0, 540.0, 40))
    [[slice(0, 40, 5), slice(4, 40, 5), slice(2, 40, 5), slice(1, 40, 5), slice(3, 40, 5)]]
    >>> panels(np.array([680.0, 550.0, 440.0]))
    [[slice(0, 3, 1)]]
    """
    count = wavelengths.size
    steps = np.diff(wavelengths)
    whole = -(-count // LANES)
    apart = -(-whole // _PANEL)
    blocks = -(-whole // apart)
    helped = clear and blocks >= _FEWEST and bool(np.all(steps > 0.0) or np.all(steps < 0.0))
    if helped:
        comb = np.abs(wavelengths[blocks:] - wavelengths[:-blocks]) / wavelengths[blocks:]
        helped = bool(np.median(comb) < _WIDE)
    if not helped:
        return [
            [slice(first, min(first + LANES, count), 1)] for first in range(0, count, LANES)
        ]  # fmt: skip
    edges = [min(LANES * (whole * k // apart), count) for k in range(apart + 1)]
    found = []
    for first, last in itertools.pairwise(edges):
        combs = -(-(last - first) // LANES)
        found.append([slice(first + k, last, combs) for k in _from_the_ends(combs)])
    return found


def _from_the_ends(count: int) -> list[int]:
    """Numbers from 0 to ``count`` - 1: the ends, then the middle of each gap, wide ones first."""
    order, gaps = [0, count - 1][:count], [(0, count - 1)]
    while gaps:
        low, high = gaps.pop(0)
        middle = (low + high) // 2
        if low < middle:
            order.append(middle)
            gaps += [(low, middle), (middle, high)]
    return order


class Corrections:
    """What sweeps added to the guess from the inverse, at the wavelengths of one panel so far."""

    def __init__(self) -> None:
        self._places: list[float] = []
        self._light: list[Light] = []
        self._logs: list[Float32Array] = []
        self._checks: list[tuple[float, float]] = []

    def add(self, wavelengths: FloatArray, guess: Light, light: Light) -> None:
        """Take up solved wavelengths.

        Parameters
        ----------
        wavelengths : array, shape (w,)
            Their wavelengths. [nm]
        guess, light : Light
            Guess from the inverse, and the light, both with at least w lanes.
        """
        for lane, place in enumerate(wavelengths.tolist()):
            parts = tuple(
                (after[..., lane] - before[..., lane]) / _mean(before[..., lane])
                for before, after in zip(guess, light, strict=True)
            )
            at = bisect(self._places, place)
            self._places.insert(at, place)
            self._light.insert(at, (parts[0], parts[1]))
            self._logs.insert(at, np.log(_mean(guess[0][..., lane])[:, :, 0]))

    def check(self, wavelengths: FloatArray, change: FloatArray) -> None:
        """Take up by how much a sweep changed a guess, if it was corrected; call before ``add``.

        Parameters
        ----------
        wavelengths : array, shape (w,)
            Its wavelengths. [nm]
        change : array, shape (w,)
            Largest relative change of the mean radiance that the sweep and all further ones make.
        """
        if len(self._places) < 2:
            return
        for place, size in zip(wavelengths.tolist(), change.tolist(), strict=True):
            low, part = self._between(place)
            if 0.0 < part < 1.0:
                self._checks.append((place, size / self._bow(low, part)))

    def expected(self, wavelengths: FloatArray, guess: Light) -> FloatArray:
        """Largest relative change that sweeps would make to the corrected guess, shape (w,).

        Between solved wavelengths a and b a straight line errs by (x - a)(b - x) times half the
        curvature, which is taken from the two nearest wavelengths at which a change was seen. Where
        the air has a line or a band of its own, the correction may have one too: that part of it by
        which the guess differs from its neighbours', between their logarithms. Infinite beyond the
        solved wavelengths, and where no change was seen.

        Parameters
        ----------
        wavelengths, guess : array, Light
            Arguments of ``corrected``.
        """
        found = np.full(wavelengths.size, np.inf)
        for lane, place in enumerate(wavelengths.tolist()):
            low, part = self._between(place)
            seen = sorted((abs(at - place), bend) for at, bend in self._checks)[:2]
            if not seen or not 0.0 <= part <= 1.0:
                continue
            logs = np.log(_mean(guess[0][..., lane])[:, :, 0])
            lit = logs > logs.max() + np.log(DARK)
            line = self._logs[low] + np.float32(part) * (self._logs[low + 1] - self._logs[low])
            parts = [np.abs(self._light[at][0][:, :, 0]) for at in (low, low + 1)]
            own = float((np.abs(logs - line) * np.maximum(*parts))[lit].max())
            found[lane] = self._bow(low, part) * max(bend for _, bend in seen) + own
        return found

    def _between(self, place: float) -> tuple[int, float]:
        """Index of the solved wavelength below one [nm], and its place up to the next one. [1]"""
        high = min(max(bisect(self._places, place), 1), len(self._places) - 1)
        start, end = self._places[high - 1], self._places[high]
        return high - 1, (place - start) / (end - start)

    def _bow(self, low: int, part: float) -> float:
        """Product of the distances to the solved wavelengths to both sides. [nm²]"""
        width = self._places[low + 1] - self._places[low]
        return part * (1.0 - part) * width * width

    def corrected(self, wavelengths: FloatArray, guess: Light) -> Light | None:
        """Guess with the corrections between those at the two nearest wavelengths.

        Parameters
        ----------
        wavelengths : array, shape (w,)
            Wavelengths that are to be solved. [nm]
        guess : Light
            Their guess from the inverse.

        Returns
        -------
        Light or None
            None as long as fewer than two wavelengths are known.
        """
        if len(self._places) < 2:
            return None
        field, sky = guess[0].copy(), guess[1].copy()
        lanes = field.shape[-1]
        for lane in range(lanes):
            place = float(wavelengths[min(lane, wavelengths.size - 1)])
            low, part = self._between(place)
            for out, given, one, other in zip(
                (field, sky), guess, self._light[low], self._light[low + 1], strict=True
            ):
                step = np.float32(part) * (other - one)
                out[..., lane] += _mean(given[..., lane]) * (one + step)
        return field, sky


def _mean(light: Float32Array) -> Float32Array:
    """Mean radiance of moments (r, s, k), or irradiance (r, s), positive, in the shape of both."""
    whole = light[:, :, :1] if light.ndim == 3 else light
    return np.asarray(np.maximum(whole, np.float32(1e-30)))
