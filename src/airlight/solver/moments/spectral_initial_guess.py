"""Batches of wavelengths, and initial guesses interpolated between wavelengths.

Synthetic acceleration of the first order is the initial guess. Its correction by the sweeps,
relative to the mean radiance, is a smooth function of wavelength: interpolated between two solved
wavelengths, it reduces three or four sweeps to one or none. Where it exceeds the guess, as in the
dusk of thin air, of which the guess may even be negative, the light itself is interpolated. A group
consists of batches of eight wavelengths; each batch is a comb over the whole group. The first and
the last comb are solved before those between. The change by the first sweep after an interpolated
guess measures the curvature of the correction over wavelength; where the predicted change is below
the tolerance, no sweep is needed.
"""

from __future__ import annotations

import itertools
from bisect import bisect
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel.lanes import LANES
from airlight.solver.moments.convergence import DARK, Light

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Largest number of batches in a group.
_LARGEST: Final = 8
#: Smallest number of batches for which guesses are interpolated.
_FEWEST: Final = 2
#: Largest correction of a guess, relative to it, that is interpolated. [1]
_CORRECTION: Final = 30.0
#: Largest step between wavelengths of one batch, relative to the wavelength. [1]
_WIDE: Final = 0.1


def wavelength_batches(wavelengths: FloatArray, *, clear: bool = True) -> list[list[slice]]:
    """Batches of at most eight wavelengths, by group, in order of solution.

    Parameters
    ----------
    wavelengths : array, shape (nl,)
        Wavelengths in any order. [nm]
    clear : bool
        Whether the medium is optically thin: in thick media dusk converges last, and errors within
        the tolerance are not a smooth function of wavelength there.

    Returns
    -------
    list of list of slice
        Indices of the wavelengths of each batch. Guesses are interpolated between batches of a
        group; if wavelengths are few, far apart or not monotonic, or the medium is optically thick,
        each group is one batch.

    Examples
    --------
    >>> wavelength_batches(np.linspace(500.0, 540.0, 40))
    [[slice(0, 40, 5), slice(4, 40, 5), slice(2, 40, 5), slice(1, 40, 5), slice(3, 40, 5)]]
    >>> wavelength_batches(np.array([680.0, 550.0, 440.0]))
    [[slice(0, 3, 1)]]
    """
    count = wavelengths.size
    steps = np.diff(wavelengths)
    whole = -(-count // LANES)
    groups = -(-whole // _LARGEST)
    batches = -(-whole // groups)
    helped = clear and batches >= _FEWEST and bool(np.all(steps > 0.0) or np.all(steps < 0.0))
    if helped:
        comb = np.abs(wavelengths[batches:] - wavelengths[:-batches]) / wavelengths[batches:]
        helped = bool(np.median(comb) < _WIDE)
    if not helped:
        return [[slice(first, min(first + LANES, count), 1)] for first in range(0, count, LANES)]
    edges = [min(LANES * (whole * k // groups), count) for k in range(groups + 1)]
    found = []
    for first, last in itertools.pairwise(edges):
        combs = -(-(last - first) // LANES)
        found.append([slice(first + k, last, combs) for k in _from_the_ends(combs)])
    return found


def _from_the_ends(count: int) -> list[int]:
    """Indices 0 to ``count`` - 1 by bisection: both ends, then the middle of each gap."""
    order, gaps = [0, count - 1][:count], [(0, count - 1)]
    while gaps:
        low, high = gaps.pop(0)
        middle = (low + high) // 2
        if low < middle:
            order.append(middle)
            gaps += [(low, middle), (middle, high)]
    return order


class SpectralGuess:
    """Initial guesses with corrections interpolated between the solved wavelengths of a group."""

    def __init__(self) -> None:
        self._wavelengths: list[float] = []
        self._corrections: list[Light] = []
        self._light: list[Light] = []
        self._logs: list[Float32Array] = []
        self._checks: list[tuple[float, float]] = []

    def add(self, wavelengths: FloatArray, guess: Light, light: Light) -> None:
        """Add the corrections of solved wavelengths.

        Parameters
        ----------
        wavelengths : array, shape (w,)
            Wavelengths. [nm]
        guess, light : Light
            Guess by synthetic acceleration, and the solution, both with at least w lanes.
        """
        for lane, nm in enumerate(wavelengths.tolist()):
            parts = tuple(
                (after[..., lane] - before[..., lane]) / _mean(before[..., lane])
                for before, after in zip(guess, light, strict=True)
            )
            at = bisect(self._wavelengths, nm)
            self._wavelengths.insert(at, nm)
            self._corrections.insert(at, (parts[0], parts[1]))
            self._light.insert(at, (light[0][..., lane].copy(), light[1][..., lane].copy()))
            self._logs.insert(at, np.log(_mean(guess[0][..., lane])[:, :, 0]))

    def check(self, wavelengths: FloatArray, change: FloatArray) -> None:
        """Add the change of an interpolated guess by sweeps; call before ``add``.

        Parameters
        ----------
        change : array, shape (w,)
            Largest relative change of the mean radiance by all sweeps. [1]
        """
        if len(self._wavelengths) < 2:
            return
        for nm, size in zip(wavelengths.tolist(), change.tolist(), strict=True):
            low, part = self._between(nm)
            if 0.0 < part < 1.0:
                self._checks.append((nm, size / self._bow(low, part)))

    def expected(self, wavelengths: FloatArray, guess: Light) -> FloatArray:
        """Predicted largest relative change of the corrected guess by sweeps, shape (w,). [1]

        Between solved wavelengths a and b the interpolation error is (x - a)(b - x) times half the
        curvature, from the two nearest wavelengths of ``check``; plus, for absorption lines, the
        correction times the deviation of the guess's logarithm from its interpolation. Infinite
        outside the solved wavelengths, and before any ``check``.

        Parameters
        ----------
        wavelengths, guess : array, Light
            Arguments of ``corrected``.
        """
        found = np.full(wavelengths.size, np.inf)
        for lane, nm in enumerate(wavelengths.tolist()):
            low, part = self._between(nm)
            seen = sorted((abs(at - nm), bend) for at, bend in self._checks)[:2]
            if not seen or not 0.0 <= part <= 1.0:
                continue
            logs = np.log(_mean(guess[0][..., lane])[:, :, 0])
            lit = logs > logs.max() + np.log(DARK)
            line = self._logs[low] + np.float32(part) * (self._logs[low + 1] - self._logs[low])
            parts = [np.abs(self._corrections[at][0][:, :, 0]) for at in (low, low + 1)]
            own = float((np.abs(logs - line) * np.maximum(*parts))[lit].max())
            found[lane] = self._bow(low, part) * max(bend for _, bend in seen) + own
        return found

    def _between(self, nm: float) -> tuple[int, float]:
        """Index of the solved wavelength below ``nm``, and fraction of the step to the next. [1]"""
        high = min(max(bisect(self._wavelengths, nm), 1), len(self._wavelengths) - 1)
        start, end = self._wavelengths[high - 1], self._wavelengths[high]
        return high - 1, (nm - start) / (end - start)

    def _bow(self, low: int, part: float) -> float:
        """Product of the distances to the solved wavelengths on both sides. [nm²]"""
        width = self._wavelengths[low + 1] - self._wavelengths[low]
        return part * (1.0 - part) * width * width

    def corrected(self, wavelengths: FloatArray, guess: Light) -> Light | None:
        """Guess with the correction interpolated between the two nearest solved wavelengths.

        Parameters
        ----------
        wavelengths : array, shape (w,)
            Wavelengths to be solved. [nm]
        guess : Light
            Initial guess by synthetic acceleration.

        Returns
        -------
        Light or None
            None with fewer than two solved wavelengths.
        """
        if len(self._wavelengths) < 2:
            return None
        field, sky = guess[0].copy(), guess[1].copy()
        for lane in range(field.shape[-1]):
            nm = float(wavelengths[min(lane, wavelengths.size - 1)])
            low, part = self._between(nm)
            near = slice(low, low + 2)
            solved = *self._corrections[near], *self._light[near]
            for out, given, *ends in zip((field, sky), guess, *solved, strict=True):
                one, other, before, after = ends
                small = np.maximum(np.abs(_first(one)), np.abs(_first(other))) <= _CORRECTION
                out[..., lane] = np.where(
                    small,
                    given[..., lane] + _mean(given[..., lane]) * _mixed(one, other, part),
                    _mixed(before, after, part),
                )
        return field, sky


def _first(light: Float32Array) -> Float32Array:
    """Mean radiance of moments (r, s, k), or irradiance (r, s)."""
    return light[:, :, :1] if light.ndim == 3 else light


def _mean(light: Float32Array) -> Float32Array:
    """Positive mean radiance of moments (r, s, k), or positive irradiance (r, s)."""
    return np.asarray(np.maximum(_first(light), np.float32(1e-30)))


def _mixed(one: Float32Array, other: Float32Array, part: float) -> Float32Array:
    """Linear interpolation, ``part`` of the way from one to the other."""
    return one + np.float32(part) * (other - one)
