"""Trigonometric functions in single precision, where built-in ones are too inaccurate.

Accurate to 1e-7, inverse functions to 3e-7; WGSL allows errors of 5e-4 in sine and 4096 ulp in
atan, and a driver in use has 4e-4 in asin. The polynomials of sine, cosine and arc tangent are
those of Moshier's Cephes library. The functions are emitted like kernels.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, Final

import numpy as np

from airlight.kernel.cube_root import cube_root


def squared(x):
    """Square of x."""
    return x * x


def cubed(x):
    """Cube of x."""
    return x * x * x


def sine_of_quarter(x):
    """Sine of an angle of at most π/4."""
    y = x * x
    return x + x * y * (-1.6666654611e-1 + y * (8.3321608736e-3 - 1.9515295891e-4 * y))


def cosine_of_quarter(x):
    """Cosine of an angle of at most π/4."""
    y = x * x
    tail = y * y * (4.166664568298827e-2 + y * (-1.388731625493765e-3 + 2.443315711809948e-5 * y))
    return 1.0 - 0.5 * y + tail


def reduced_angle(x, turns):
    """Cody-Waite range reduction: x - ``turns`` π/2, with π/2 split into three parts. [rad]"""
    return ((x - turns * 1.5703125) - turns * 4.837512969970703e-4) - turns * 7.549789948768648e-8


def sine(x):
    """Sine."""
    turns = math.floor(x * 0.63661977236758 + 0.5)
    rest = reduced_angle(x, float(turns))
    quarter = turns % 4
    value = cosine_of_quarter(rest) if quarter % 2 == 1 else sine_of_quarter(rest)
    return -value if quarter >= 2 else value


def cosine(x):
    """Cosine."""
    turns = math.floor(x * 0.63661977236758 + 0.5)
    rest = reduced_angle(x, float(turns))
    quarter = turns % 4
    value = sine_of_quarter(rest) if quarter % 2 == 1 else cosine_of_quarter(rest)
    return -value if quarter == 1 or quarter == 2 else value


def angle_of(y, x):
    """Two-argument arc tangent, atan2(y, x). [rad]"""
    a = abs(x)
    b = abs(y)
    slope = min(a, b) / max(max(a, b), 1e-37)
    steep = slope > 0.41421356
    t = (slope - 1.0) / (slope + 1.0) if steep else slope
    z = t * t
    tail = -3.33329491539e-1 + z * (
        1.99777106478e-1 + z * (-1.38776856032e-1 + z * 8.05374449538e-2)
    )
    part = (0.785398163397448 if steep else 0.0) + (t + t * z * tail)
    quarter = 1.570796326794897 - part if b > a else part
    half = 3.141592653589793 - quarter if x < 0.0 else quarter
    return -half if y < 0.0 else half


def arc_tangent(x):
    """Arc tangent. [rad]"""
    return angle_of(x, 1.0)


def arc_cosine(x):
    """Arc cosine. [rad]"""
    return angle_of(math.sqrt(max((1.0 - x) * (1.0 + x), 0.0)), x)


def arc_sine(x):
    """Arc sine. [rad]"""
    return angle_of(x, math.sqrt(max((1.0 - x) * (1.0 + x), 0.0)))


def third_power_root(x):
    """Cube root; 0 for negative numbers."""
    return x ** (1.0 / 3.0) if x > 0.0 else 0.0


#: Python's mathematics in single precision: names in shaders, and functions of this file.
MATHEMATICS: Final[dict[Any, str | Callable[..., Any]]] = {
    math.sqrt: "sqrt", math.exp: "exp", math.log: "log", math.log2: "log2", math.tan: "tan",
    math.floor: "floor", np.floor: "floor", abs: "abs", min: "min", max: "max", pow: "pow",
    math.sin: sine, math.cos: cosine, math.acos: arc_cosine, math.asin: arc_sine,
    math.atan: arc_tangent, math.atan2: angle_of, cube_root: third_power_root,
}  # fmt: skip
