"""Ideal linear polariser in front of a camera: weights of Stokes I, Q and U.

It transmits half of unpolarised light. Off the optical axis, its axis is rotated with the line of
sight in their common plane, as by a rotationally symmetric lens, so that the transmittances of two
crossed polarisers add up to 1 in every direction.
"""

from __future__ import annotations

from math import sqrt
from typing import Final

from airlight.kernel import inlined

#: Values of ``ViewUniforms.filter``: no filter, polariser, and Q or U instead of I.
NONE: Final = 0
CAMERA: Final = 1
ALONG: Final = 2
ASLANT: Final = 3


@inlined
def filter_shares(x, y, z, view):
    """Weights of Stokes I, Q and U.

    Parameters
    ----------
    x, y, z : float
        Viewing direction, a unit vector in the observer's frame. [1]
    view : ViewUniforms
        Camera and axis of its filter in the same frame.

    Returns
    -------
    whole, stokes_q, stokes_u : float
        Weights of I, Q and U, with U for azimuths from 0 to 180°. [1]
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
