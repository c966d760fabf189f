"""Polarising filter in front of a camera, and what it lets through of I, Q and U.

The filter is ideal: it lets half of unpolarised light through, and all of the light that swings
along its axis. A line of sight meets the axis as a lens of circular symmetry turns it: with the
line, about the camera's own axis. So a filter and one at right angles to it let all light
through together, wherever the camera looks.
"""

from __future__ import annotations

from math import sqrt
from typing import Final

from airlight.kernel import inlined

#: Values of ``ViewUniforms.filter``: none, one in front of the camera, and Q or U instead of I.
NONE: Final = 0
CAMERA: Final = 1
ALONG: Final = 2
ASLANT: Final = 3


@inlined
def filter_shares(x, y, z, view):
    """Shares of I, Q and U in the light that is rendered.

    Parameters
    ----------
    x, y, z : float
        Viewing direction, a unit vector in the observer's frame. [1]
    view : ViewUniforms
        Camera; its filter's axis is a unit vector in the same frame.

    Returns
    -------
    whole, stokes_q, stokes_u : float
        Of I, Q and U, where U is that of the azimuth of 0 to 180 degrees. [1]
    """
    sine = sqrt(x * x + y * y)
    cos_azimuth, sin_azimuth = 1.0, 0.0
    if sine > 0.0:
        cos_azimuth, sin_azimuth = x / sine, y / sine
    ahead = x * view.forward_x + y * view.forward_y + z * view.forward_z
    part = x * view.filter_x + y * view.filter_y + z * view.filter_z
    part = part / max(1.0 + ahead, 1e-6)
    axis_x = view.filter_x - part * (view.forward_x + x)
    axis_y = view.filter_y - part * (view.forward_y + y)
    axis_z = view.filter_z - part * (view.forward_z + z)
    down = z * (cos_azimuth * axis_x + sin_azimuth * axis_y) - sine * axis_z
    side = cos_azimuth * axis_y - sin_azimuth * axis_x
    square = max(down * down + side * side, 1e-12)
    whole = 0.5
    stokes_q, stokes_u = 0.5 * (down * down - side * side) / square, down * side / square
    if view.filter == ALONG:
        whole, stokes_q, stokes_u = 0.0, 1.0, 0.0
    if view.filter == ASLANT:
        whole, stokes_q, stokes_u = 0.0, 0.0, -1.0  # azimuths are negative where y is positive
    if y < 0.0:
        stokes_u = 0.0 - stokes_u
    return whole, stokes_q, stokes_u
