"""Preset viewpoints, from the ground to the whole planet, scaled to the shell's thickness.

Each is an hour of one day at ``PLACE``, the initial location, with a solar declination between -9°
and 0°. Views of the whole planet have north up.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Final

from airlight.scene.observer import horizon_zenith

#: Initial latitude and longitude, positive north and east: the eastern coast of the Red Sea, with
#: the sea towards the setting sun. [deg]
PLACE: Final = (27.5, 35.5)
#: Altitude from which the camera sees a whole planet, in radii. [1]
_FAR: Final = 2.4


@dataclass(frozen=True, kw_only=True)
class Viewpoint:
    """Observer, camera and sun of a preset.

    Attributes
    ----------
    name : str
        Label of the button.
    sentence : str
        Description of the picture.
    altitude : float
        Altitude as a fraction of the shell's thickness; negative: in ground radii. [1]
    below_horizon : float
        Angle of the line of sight below the horizon. [deg]
    heading : float
        Compass bearing of the line of sight. [deg]
    sun_zenith, sun_bearing : float
        Zenith angle and compass bearing of the sun. [deg]
    """

    name: str
    sentence: str
    altitude: float
    below_horizon: float
    heading: float
    sun_zenith: float
    sun_bearing: float


#: Presets; in an atmosphere of 100 km their altitudes are 2 m, 12 km, 35 km, 400 km.
VIEWPOINTS: Final = (
    Viewpoint(name="ground", sentence="the sky from the ground", altitude=2e-5,
              below_horizon=-8.0, heading=300.0, sun_zenith=60.0, sun_bearing=240.0),
    Viewpoint(name="flight", sentence="haze over the ground, as from an airliner at 12 km",
              altitude=0.12, below_horizon=6.0, heading=325.0, sun_zenith=75.0,
              sun_bearing=255.0),
    Viewpoint(name="aloft", sentence="the limb from within the air, as from a balloon at 35 km",
              altitude=0.35, below_horizon=2.0, heading=315.0, sun_zenith=70.0,
              sun_bearing=250.0),
    Viewpoint(name="orbit", sentence="the limb from above the air, as from 400 km",
              altitude=4.0, below_horizon=4.0, heading=325.0, sun_zenith=72.0,
              sun_bearing=255.0),
    Viewpoint(name="crescent", sentence="the whole planet, lit from behind", altitude=-_FAR,
              below_horizon=math.inf, heading=0.0, sun_zenith=120.0, sun_bearing=285.0),
    Viewpoint(name="planet", sentence="the whole planet, north at the top", altitude=-_FAR,
              below_horizon=math.inf, heading=0.0, sun_zenith=50.0, sun_bearing=240.0),
    Viewpoint(name="sunset", sentence="the setting sun from the ground", altitude=2e-5,
              below_horizon=-6.0, heading=265.0, sun_zenith=89.0, sun_bearing=265.0),
)  # fmt: skip

#: Initial viewpoint of window and page, by name.
FIRST: Final = next(one for one in VIEWPOINTS if one.name == "orbit")


def view_of(viewpoint: Viewpoint, *, bottom_radius: float, top_radius: float) -> dict[str, float]:
    """Camera and sun of a viewpoint, as arguments of ``Session.move``; the location is unchanged.

    Parameters
    ----------
    bottom_radius, top_radius : float
        Radii of the planet's shell. [m]

    Examples
    --------
    >>> view = view_of(VIEWPOINTS[3], bottom_radius=6360e3, top_radius=6460e3)
    >>> view["view.altitude"], view["view.heading"]
    (400000.0, 325.0)
    """
    altitude = viewpoint.altitude * (top_radius - bottom_radius)
    if viewpoint.altitude < 0.0:
        altitude = -viewpoint.altitude * bottom_radius
    zenith = horizon_zenith(altitude, bottom_radius) + viewpoint.below_horizon
    return {
        "view.altitude": float(f"{altitude:.6g}"),
        "view.look_zenith": min(max(zenith, 0.0), 180.0),
        "view.heading": viewpoint.heading,
        "view.roll": 0.0,
        "view.field_of_view": 60.0,
        "view.sun_zenith": viewpoint.sun_zenith,
        "view.sun_azimuth": viewpoint.sun_bearing,
    }


def as_json(bottom_radius: float, top_radius: float) -> list[dict[str, Any]]:
    """Viewpoints of a planet for a page.

    Returns
    -------
    list of dict
        ``name``, ``sentence`` and ``view`` of each.
    """
    ends = {"bottom_radius": bottom_radius, "top_radius": top_radius}
    return [
        {"name": one.name, "sentence": one.sentence, "view": view_of(one, **ends)}
        for one in VIEWPOINTS
    ]
