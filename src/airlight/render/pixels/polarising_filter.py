"""Ideal linear polariser in front of a camera: weights of Stokes I, Q and U.

It transmits half of unpolarised light. Off the optical axis, its axis is rotated with the line of
sight in their common plane, as by a rotationally symmetric lens, so that the transmittances of two
crossed polarisers add up to 1 in every direction.
"""

from __future__ import annotations

from math import sqrt
from typing import Final

from airlight.geometry.vectors import dot, minus, plus, scaled
from airlight.kernel import inlined

#: Values of ``ViewUniforms.filter``: no filter, polariser, and Q or U instead of I.
NONE: Final = 0
CAMERA: Final = 1
ALONG: Final = 2
ASLANT: Final = 3


@inlined
def filter_shares(ray, observer, view):
    """Weights of Stokes I, Q and U.

    Parameters
    ----------
    ray : Vec3
        Viewing direction, a unit vector in the observer's frame. [1]
    observer, view : Observer, ViewUniforms
        Directions of the camera and of its filter in that frame, and the filter.

    Returns
    -------
    whole, stokes_q, stokes_u : float
        Weights of I, Q and U, with U for azimuths from 0 to 180°. [1]
    """
    sine = sqrt(ray.x * ray.x + ray.y * ray.y)
    cos_azimuth, sin_azimuth = 1.0, 0.0
    if sine > 0.0:
        cos_azimuth, sin_azimuth = ray.x / sine, ray.y / sine
    part = dot(ray, observer.filter_axis) / max(1.0 + dot(ray, observer.forward), 1e-6)
    axis = minus(observer.filter_axis, scaled(plus(observer.forward, ray), part))
    down = ray.z * (cos_azimuth * axis.x + sin_azimuth * axis.y) - sine * axis.z
    side = cos_azimuth * axis.y - sin_azimuth * axis.x
    square = max(down * down + side * side, 1e-12)
    whole = 0.5
    stokes_q, stokes_u = 0.5 * (down * down - side * side) / square, down * side / square
    if view.filter == ALONG:
        whole, stokes_q, stokes_u = 0.0, 1.0, 0.0
    if view.filter == ASLANT:
        whole, stokes_q, stokes_u = 0.0, 0.0, -1.0  # azimuths are negative where y is positive
    if ray.y < 0.0:
        stokes_u = 0.0 - stokes_u
    return whole, stokes_q, stokes_u
