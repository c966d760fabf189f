"""Time for which the wind has moved the clouds of a side."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from airlight.scene.sun_time import time_of
from airlight.viewer.parameters.sun_clock import CLOCK


class CloudClock:
    """Sum of the changes of the time of day, each by at most half a day.

    Examples
    --------
    >>> from airlight.viewer.parameters.view_parameters import DEFAULTS
    >>> clock, view = CloudClock(), {**DEFAULTS, "view.clock": True}
    >>> [clock.seconds({**view, "view.hour": hour}) for hour in (23.0, 24.0, 0.5)]
    [0.0, 3600.0, 5400.0]
    """

    def __init__(self) -> None:
        self._hour: float | None = None
        self._elapsed = 0.0

    def seconds(self, view: Mapping[str, Any]) -> float:
        """Time since the first view. [s]

        Parameters
        ----------
        view : mapping
            Values of the parameters ``view.…`` by path.
        """
        hour = _hour(view)
        if self._hour is not None:
            self._elapsed += math.remainder(hour - self._hour, 24.0)
        self._hour = hour
        return 3600.0 * self._elapsed


def _hour(view: Mapping[str, Any]) -> float:
    """Time of day at longitude 0, by the date or by the sun. [h]"""
    if view[CLOCK]:
        return float(view["view.hour"])
    names = ("latitude", "sun_zenith", "sun_azimuth", "longitude")
    latitude, zenith, azimuth, longitude = (float(view[f"view.{name}"]) for name in names)
    return time_of(latitude, zenith, azimuth)[1] - longitude / 15.0
