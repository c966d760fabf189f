"""Preset viewpoints, from the ground to the whole planet, scaled to the shell's thickness.

Each is an hour of one day at ``PLACE``, the initial location, with a solar declination between -9°
and 0°. Views of the whole planet have north up.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from airlight.scene.observer import horizon_zenith

if TYPE_CHECKING:
    from airlight.viewer.session.editing import Editing

#: Initial latitude and longitude, positive north and east: the eastern coast of the Red Sea, with
#: the sea towards the setting sun. [deg]
PLACE: Final = (27.5, 35.5)
#: Altitude from which the camera sees a whole planet, in radii. [1]
_FAR: Final = 2.4


class Viewpoint(NamedTuple):
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
    Viewpoint("ground", "the sky from the ground", 2e-5, -8.0, 300.0, 60.0, 240.0),
    Viewpoint(
        "flight",
        "haze over the ground, as from an airliner at 12 km",
        0.12,
        6.0,
        325.0,
        75.0,
        255.0,
    ),
    Viewpoint(
        "aloft",
        "the limb from within the air, as from a balloon at 35 km",
        0.35,
        2.0,
        315.0,
        70.0,
        250.0,
    ),
    Viewpoint("orbit", "the limb from above the air, as from 400 km", 4.0, 4.0, 325.0, 72.0, 255.0),
    Viewpoint("crescent", "the whole planet, lit from behind", -_FAR, math.inf, 0.0, 120.0, 285.0),
    Viewpoint("planet", "the whole planet, north at the top", -_FAR, math.inf, 0.0, 50.0, 240.0),
    Viewpoint("sunset", "the setting sun from the ground", 2e-5, -6.0, 265.0, 89.0, 265.0),
)

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


def view_in(session: Editing, viewpoint: Viewpoint = FIRST) -> Mapping[str, float]:
    """Values of a viewpoint, by default the first, for the planet of a session.

    Parameters
    ----------
    session : Session
        Session; its planet and location are unchanged.
    viewpoint : Viewpoint
    """
    bottom, top = (1e3 * float(session.value(f"shell.{end}_radius")) for end in ("bottom", "top"))
    return view_of(viewpoint, bottom_radius=bottom, top_radius=top)


def home_view(session: Editing) -> Mapping[str, float]:
    """View of the whole planet, over the same place and under the same sun."""
    planet = next(one for one in VIEWPOINTS if one.name == "planet")
    view = view_in(session, planet)
    return {path: value for path, value in view.items() if not path.startswith("view.sun_")}


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
