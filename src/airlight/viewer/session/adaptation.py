"""Automatic exposure of a session, with temporal adaptation and lock."""

from __future__ import annotations

import threading
from collections.abc import Callable
from time import monotonic
from typing import Final

from airlight.image.exposure import eased

#: Time constant of the adaptation: after 0.4 s, 5 % of a change remain. [s]
TIME_CONSTANT: Final = 0.13
#: Most by which a picture is brighter than metered while the exposure adapts. [EV]
BRIGHTEST: Final = 1.0
#: Distance at which the measured exposure counts as reached. [EV]
_REACHED: Final = 0.02
#: Largest interval between two pictures in the adaptation: it does not proceed during a pause. [s]
_LONGEST: Final = 0.1


class Adaptation:
    """Adapting exposure shared by the renderer threads of a session.

    Parameters
    ----------
    clock : callable
        Monotonic clock. [s]

    Examples
    --------
    >>> adaptation = Adaptation(iter([0.0, 0.1, 0.2]).__next__)
    >>> adaptation.towards(-2.0, held=False)  # the first picture is exposed at once
    -2.0
    >>> adaptation.towards(1.0, held=True)
    -2.0
    >>> f"{adaptation.towards(1.0, held=False):.2f}"
    '-0.39'
    """

    def __init__(self, clock: Callable[[], float] = monotonic) -> None:
        self._clock = clock
        self._lock = threading.Lock()
        self._before = 0.0
        self._exposure: float | None = None

    @property
    def exposure(self) -> float | None:
        """Current exposure; None before the first frame. [EV]"""
        return self._exposure

    def towards(self, measured: float, *, held: bool, at_once: bool = False) -> float:
        """Exposure of the next frame. [EV]

        Parameters
        ----------
        measured : float
            Metered exposure of that frame. [EV]
        held : bool
            Whether the exposure is unchanged, as if locked.
        at_once : bool
            Whether it does not ease, as in the first picture of an edited planet.
        """
        with self._lock:
            now = self._clock()
            since, self._before = min(now - self._before, _LONGEST), now
            if self._exposure is None or (at_once and not held):
                self._exposure = measured
            elif not held:
                before = min(self._exposure, measured + BRIGHTEST)
                near = eased(before, measured, since, TIME_CONSTANT)
                self._exposure = measured if abs(near - measured) < _REACHED else near
            return self._exposure

    def reached(self, measured: float) -> bool:
        """Whether the exposure has reached the metered exposure."""
        return self._exposure == measured
