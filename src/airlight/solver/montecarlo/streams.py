"""Streams of random numbers, one per line of sight, wavelength and block of histories.

A stream depends on the seed and its indices only, so that results do not depend on the number of
threads. All streams are parts of one cycle of 2⁶⁴ states with random starting points: two of n
streams of m numbers overlap with a probability of about n² m / 2⁶⁴, 1e-5 for 10⁴ streams of 10⁶
numbers.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import inlined

_WEYL: Final = 0x9E3779B97F4A7C15
_FIRST: Final = 0xBF58476D1CE4E5B9
_SECOND: Final = 0x94D049BB133111EB
_ALL: Final = (1 << 64) - 1

_STEP: Final = np.uint64(_WEYL)
_MIX_1: Final = np.uint64(_FIRST)
_MIX_2: Final = np.uint64(_SECOND)
_SHIFTS: Final = (np.uint64(30), np.uint64(27), np.uint64(31), np.uint64(11))


def _mixed(number: int) -> int:
    number = ((number ^ (number >> 30)) * _FIRST) & _ALL
    number = ((number ^ (number >> 27)) * _SECOND) & _ALL
    return number ^ (number >> 31)


def stream(seed: int, *indices: int) -> NDArray[np.uint64]:
    """Initial state of a stream.

    Parameters
    ----------
    seed : int
        Seed of the run.
    *indices : int
        Indices that identify the stream.

    Returns
    -------
    array, shape (1,)
        State for ``uniform``, which updates it.

    Examples
    --------
    >>> bool(stream(1, 2, 3)[0] == stream(1, 2, 3)[0]), bool(stream(1, 2)[0] == stream(2, 1)[0])
    (True, False)
    """
    state = _mixed(seed & _ALL)
    for index in indices:
        state = _mixed((state + _WEYL + (int(index) & _ALL)) & _ALL)
    return np.array([state], np.uint64)


@inlined
def uniform(state):
    """Next number of a stream, uniform in (0, 1).

    Parameters
    ----------
    state : array, shape (1,)
        State from ``stream``.

    References
    ----------
    Steele, Lea & Flood (2014), Fast splittable pseudorandom number generators, OOPSLA '14,
    fig. 17 (SplitMix64). doi:10.1145/2660193.2660195
    """
    z = state[0] + _STEP
    state[0] = z
    z = (z ^ (z >> _SHIFTS[0])) * _MIX_1
    z = (z ^ (z >> _SHIFTS[1])) * _MIX_2
    z = z ^ (z >> _SHIFTS[2])
    return (np.int64(z >> _SHIFTS[3]) + 0.5) * 1.1102230246251565e-16
