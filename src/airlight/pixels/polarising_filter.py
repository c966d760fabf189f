"""Polarising filter in front of a camera, and what it lets through of I, Q and U.

The filter is ideal: it lets half of unpolarised light through, and all of the light that swings
along its axis. A line of sight sees the axis projected across itself.
"""

from __future__ import annotations

from math import sqrt
from typing import Final

from airlight.kernel import inlined

#: Values of ``Screen.filter``: none, one in front of the camera, and Q or U instead of I.
NONE: Final = 0
CAMERA: Final = 1
ALONG: Final = 2
ASLANT: Final = 3


@inlined
def filter_shares(x, y, z, screen):
    """Shares of I, Q and U in the light that is drawn.

    Parameters
    ----------
    x, y, z : float
        Viewing direction, a unit vector in the observer's frame. [1]
    screen : Screen
        Camera; its filter's axis is a unit vector in the same frame.

    Returns
    -------
    whole, along, aslant : float
        Of I, Q and U, where U is that of the azimuth of 0 to 180 degrees. [1]
    """
    sine = sqrt(x * x + y * y)
    cos_azimuth, sin_azimuth = 1.0, 0.0
    if sine > 0.0:
        cos_azimuth, sin_azimuth = x / sine, y / sine
    down = z * (cos_azimuth * screen.filter_x + sin_azimuth * screen.filter_y)
    down = down - sine * screen.filter_z
    side = cos_azimuth * screen.filter_y - sin_azimuth * screen.filter_x
    square = max(down * down + side * side, 1e-12)
    whole = 0.5
    along, aslant = 0.5 * (down * down - side * side) / square, down * side / square
    if screen.filter == ALONG:
        whole, along, aslant = 0.0, 1.0, 0.0
    if screen.filter == ASLANT:
        whole, along, aslant = 0.0, 0.0, 1.0
    if y < 0.0:
        aslant = 0.0 - aslant
    return whole, along, aslant
