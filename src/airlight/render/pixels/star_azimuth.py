"""Direction towards the star along the ground, for slopes and for places that shade others."""

from __future__ import annotations

from math import cos, sin, sqrt
from typing import Final, NamedTuple

from airlight.geometry.vectors import Vec3, components
from airlight.kernel import inlined

#: Cosine of the latitude beyond which meridians count as at it. [1]
POLAR: Final = 0.05


class StarAzimuth(NamedTuple):
    """Direction of the star at a place.

    Attributes
    ----------
    mu_s, sine : float
        Cosine and sine of its zenith angle. [1]
    way : Vec3
        Horizontal direction towards it, in the planet's frame; 0 at the zenith. [1]
    north, east : float
        Change of latitude and longitude along it, per angle seen from the planet's centre. [1]
    """

    mu_s: float
    sine: float
    way: Vec3
    north: float
    east: float


@inlined
def star_azimuth(end, latitude, longitude, bottom, observer):
    """``StarAzimuth`` of a place on the ground.

    Parameters
    ----------
    end : Vec3
        Place, from the centre, in the observer's frame. [m]
    latitude, longitude : float
        Its coordinates. [rad]
    bottom : float
        Radius of the ground. [m]
    observer : Observer
        Observer.
    """
    up = Vec3(end.x / bottom, end.y / bottom, end.z / bottom)
    mu_s = up.x * observer.sun_x + up.z * observer.sun_z
    sine = sqrt(max((1.0 - mu_s) * (1.0 + mu_s), 0.0))
    level_x, level_z = observer.sun_x - mu_s * up.x, observer.sun_z - mu_s * up.z
    length = max(sine, 1e-3)
    ahead = Vec3(level_x / length, -mu_s * up.y / length, level_z / length)
    # coordinates change along the ground in proportion to the distance, but for the poles
    way = components(ahead, observer.ground_x, observer.ground_y, observer.ground_z)
    parallel = max(cos(latitude), POLAR)
    east = (cos(longitude) * way.y - sin(longitude) * way.x) / parallel
    return StarAzimuth(mu_s, sine, way, way.z / parallel, east)
