"""Preset viewpoints, from the ground to the whole planet, scaled to the shell's thickness."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

from airlight.scene.observer import horizon_zenith

#: Altitude from which the camera sees a whole planet, in radii. [1]
_FAR: Final = 2.4


@dataclass(frozen=True, kw_only=True)
class Viewpoint:
    """Observer and camera direction of a preset.

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
    aside : float
        Azimuth of the line of sight from the sun. [deg]
    sun_zenith : float
        Zenith angle of the sun. [deg]
    """

    name: str
    sentence: str
    altitude: float
    below_horizon: float
    aside: float
    sun_zenith: float


#: Presets; in an atmosphere of 100 km their altitudes are 2 m, 35 km, 400 km.
VIEWPOINTS: Final = (
    Viewpoint(name="ground", sentence="the sky from the ground", altitude=2e-5,
                  below_horizon=-8.0, aside=60.0, sun_zenith=60.0),
    Viewpoint(name="aloft", sentence="the limb from within the air, as from a balloon at 35 km",
              altitude=0.35, below_horizon=2.0, aside=60.0, sun_zenith=70.0),
    Viewpoint(name="orbit", sentence="the limb from above the air, as from 400 km",
              altitude=4.0, below_horizon=4.0, aside=60.0, sun_zenith=75.0),
    Viewpoint(name="planet", sentence="the whole planet", altitude=-_FAR,
              below_horizon=math.inf, aside=0.0, sun_zenith=50.0),
    Viewpoint(name="sunset", sentence="the setting sun from the ground", altitude=2e-5,
              below_horizon=-6.0, aside=0.0, sun_zenith=89.0),
)  # fmt: skip


def view_of(
    viewpoint: Viewpoint, *, bottom_radius: float, top_radius: float, bearing: float
) -> Mapping[str, float]:
    """Camera and sun of a viewpoint, as arguments of ``Session.move``.

    Parameters
    ----------
    viewpoint : Viewpoint
    bottom_radius, top_radius : float
        Radii of the planet's shell. [m]
    bearing : float
        Compass bearing of the sun, which is kept. [deg]

    Returns
    -------
    mapping
        Values by path.

    Examples
    --------
    >>> view = view_of(VIEWPOINTS[2], bottom_radius=6360e3, top_radius=6460e3, bearing=180.0)
    >>> view["view.altitude"], view["view.heading"]
    (400000.0, 240.0)
    """
    altitude = viewpoint.altitude * (top_radius - bottom_radius)
    if viewpoint.altitude < 0.0:
        altitude = -viewpoint.altitude * bottom_radius
    zenith = horizon_zenith(altitude, bottom_radius) + viewpoint.below_horizon
    return {
        "view.altitude": float(f"{altitude:.6g}"),
        "view.look_zenith": min(max(zenith, 0.0), 180.0),
        "view.heading": (bearing + viewpoint.aside) % 360.0,
        "view.roll": 0.0,
        "view.field_of_view": 60.0,
        "view.sun_zenith": viewpoint.sun_zenith,
    }


def as_json(bottom_radius: float, top_radius: float) -> list[dict[str, Any]]:
    """Viewpoints of a planet for a page, with headings relative to the sun's bearing.

    Parameters
    ----------
    bottom_radius, top_radius : float
        Radii of the planet's shell. [m]

    Returns
    -------
    list of dict
        ``name``, ``sentence`` and ``view`` of each.
    """
    ends = {"bottom_radius": bottom_radius, "top_radius": top_radius}
    return [
        {
            "name": one.name,
            "sentence": one.sentence,
            "view": dict(view_of(one, **ends, bearing=0.0)),
        }
        for one in VIEWPOINTS
    ]
