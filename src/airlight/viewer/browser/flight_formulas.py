"""The flight's formulas in JavaScript: emitted from ``scene``, and kept nowhere."""

from __future__ import annotations

from functools import cache
from typing import Final

from airlight.gpu.emit.emitter import Emitter
from airlight.gpu.emit.javascript import JAVASCRIPT
from airlight.gpu.emit.shader_types import F32
from airlight.scene import flight, great_circle, sun_time

#: Functions of numbers that ``web/ui/flight.js`` calls.
FORMULAS: Final = (
    great_circle.compass,
    flight.climbed,
    flight.course_of,
    flight.angle_flown,
    flight.turned,
    flight.looked,
    flight.risen,
    flight.sun_dragged,
    sun_time.sun_at,
    sun_time.time_of,
)


@cache
def flight_text() -> str:
    """The module ``generated/flight.js``: the formulas and what they call, by their own names."""
    emitter = Emitter(JAVASCRIPT)
    for formula in FORMULAS:
        emitter.add(formula, *(F32 for _ in range(formula.__code__.co_argcount)))
    return emitter.functions_text()
