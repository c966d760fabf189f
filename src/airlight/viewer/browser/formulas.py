"""The formulas that a page works out by itself, in JavaScript: emitted, and kept nowhere."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from typing import Any, Final

from airlight.color.exposure import exposure_of
from airlight.color.xyz import luminance_of
from airlight.geometry.bending import raised_star
from airlight.gpu.emit.emitter import Emitter
from airlight.gpu.emit.javascript import JAVASCRIPT
from airlight.gpu.emit.shader_types import F32, I32, Room, Table, Value
from airlight.pixels.observer_numbers import observer_numbers
from airlight.scene import flight, great_circle, sun_time
from airlight.scene.directions import camera_frame, direction_of
from airlight.scene.observer import ground_axes
from airlight.scene.projections import PROJECTIONS
from airlight.solvers.moments.acceleration import combine
from airlight.solvers.moments.convergence import change_at, count_at, rest_after
from airlight.solvers.moments.packing import thick_share
from airlight.solvers.moments.reduced_optics import cut_part, cut_weight, is_peaked

#: Formulas by the module that a page imports them from, each with what its arguments are; without
#: that, numbers. An array that a formula writes to may have any length.
FORMULAS: Final[Mapping[str, Mapping[Callable[..., Any], tuple[Value, ...]]]] = {
    "view": {
        direction_of: (),
        camera_frame: (),
        ground_axes: (),
        observer_numbers: (),
        raised_star: (F32, F32, F32, F32, Table("lift", 3)),
        luminance_of: (),
        exposure_of: (Table("bright"), F32),
    },
    "flight": {
        great_circle.compass: (),
        flight.climbed: (),
        flight.course_of: (),
        flight.angle_flown: (),
        flight.turned: (),
        flight.looked: (),
        flight.risen: (),
        flight.sun_dragged: (),
        sun_time.sun_at: (),
        sun_time.time_of: (),
    },
    "light": {
        change_at: (),
        count_at: (),
        rest_after: (F32, F32, I32),
        combine: (Room(1), I32, Room(1)),
        is_peaked: (),
        cut_weight: (),
        cut_part: (),
        thick_share: (),
    },
}


@cache
def emitted(module: str) -> Emitter:
    """The formulas of a module in JavaScript, with what they call.

    Parameters
    ----------
    module : str
        One of ``FORMULAS``.
    """
    emitter = Emitter(JAVASCRIPT)
    for function, given in FORMULAS[module].items():
        plain = getattr(function, "py_func", function)
        emitter.add(function, *(given or (F32,) * plain.__code__.co_argcount))
    if module == "view":
        for name, form in PROJECTIONS.items():
            emitter.add(form.pixel_angle, F32, F32, F32, name=f"pixel_angle_{name}")
    return emitter


@cache
def module_text(module: str) -> str:
    """The text of a module: a function each; ``view`` has pixel angles by projection too.

    Parameters
    ----------
    module : str
        One of ``FORMULAS``.
    """
    text = emitted(module).functions_text()
    if module != "view":
        return text
    angles = ", ".join(f"{name}: pixel_angle_{name}" for name in PROJECTIONS)
    return f"{text}\nexport const PIXEL_ANGLES = {{ {angles} }};\n"
