"""Declared parameters of the view: camera, sun and moon, display and light.

Angles on the planet are compass bearings. The scene's azimuth, measured from the sun, is the
heading minus the sun's bearing: see ``scene_of``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

from airlight.image.display_settings import DisplaySettings
from airlight.planets.schema.field import Field
from airlight.scene.camera import Camera
from airlight.scene.display_fields import DISPLAY_FIELDS, EXPOSURE
from airlight.scene.moon_light import MEAN_RADIUS
from airlight.scene.picture_size import fitting
from airlight.scene.projections import PROJECTIONS
from airlight.scene.scene import Scene
from airlight.scene.scene_fields import (
    ALTITUDE,
    DEHAZE,
    FIELD_OF_VIEW,
    GROUND,
    LATITUDE,
    LONGITUDE,
    LOOK_BEARING,
    LOOK_ZENITH,
    NEAR_PROJECTION,
    POLARISER,
    ROLL,
    SUN_AZIMUTH,
    SUN_ZENITH,
)
from airlight.viewer.parameters.parameter import Parameter, Value
from airlight.viewer.parameters.second_light import KINDS, second_lights

#: Groups of the view's parameters.
VIEW_GROUPS: Final = ("camera", "sun", "moon", "display", "light")
#: Quality levels of the solution that follows the preview, from fast to exact.
QUALITIES: Final = ("preview", "default", "fine")
#: Options for the displayed orders of scattering.
ORDERS: Final = ("all", "single", "multiple")
#: Names of the numbers of wavelengths that are solved.
WAVELENGTHS: Final = ("three", "four", "eight", "sixteen")


@dataclass(frozen=True, kw_only=True)
class ViewValue(Parameter):
    """Declaration of a view value, used by window, notebook, page, URL and shaders.

    Attributes
    ----------
    default : float, str or bool
        Initial value. [unit]
    part : str
        Part that a change invalidates: ``planet`` (the solution), ``view`` (the picture's
        radiance) or ``display`` (its displayed colours).
    uniform : str
        Name of the uniform of a page's shaders with this value, if any: a number itself, a choice
        as the index of its option, a switch as 0 or 1.
    """

    default: Value
    part: str = "view"
    uniform: str = ""


def _of(
    path: str, group: str, declared: Field, default: Value, label: str = "", **more: Any
) -> ViewValue:
    """View value of a declared parameter of scenes."""
    (low, high), (least, most) = declared.ends, declared.limits
    if declared.kind != "number":
        more |= {"options": declared.choices()}
    elif more.get("wraps"):
        more |= {"low": low, "high": high, "least": low, "most": high}
    else:
        more = {"low": low, "high": high, "least": least, "most": most} | more
    return ViewValue(
        path=path,
        label=label or declared.label,
        group=group,
        help=f"{declared.help} {declared.note}".strip(),
        kind=declared.kind,
        unit=declared.shown_unit,
        scale=declared.scale,
        synonyms=declared.synonyms,
        default=default,
        **more,
    )


#: Steps of the arrow keys of the display's numbers.
_DISPLAY_STEPS: Final = {"glare": 0.1, "white_temperature": 1.05}


def _displayed(name: str, declared: Field) -> ViewValue:
    """View value of a display setting; the shaders have it, but for the colour of white."""
    uniform = "" if name.startswith("white") else name
    step: dict[str, Any] = {"step": _DISPLAY_STEPS[name]} if name in _DISPLAY_STEPS else {}
    return _of(
        f"display.{name}",
        "display",
        declared,
        declared.initial,
        part="display",
        uniform=uniform,
        **step,
    )


def _choice(
    path: str, label: str, group: str, options: tuple[str, ...], text: str, **more: Any
) -> ViewValue:
    return ViewValue(
        path=path, label=label, group=group, help=text, kind="choice", options=options, **more
    )


#: Values of the view, in display order. A new slider takes one entry here, one of the display
#: one in ``DISPLAY_FIELDS``; if it has a uniform, its value reaches the shaders under that name.
VIEW_VALUES: Final = (
    _of("view.altitude", "camera", ALTITUDE, 2.0, least=0.0, step=1.1),
    _of("view.latitude", "camera", LATITUDE, 27.5, step=1.0),
    _of("view.longitude", "camera", LONGITUDE, 35.5, step=1.0, wraps=True),
    _of("view.look_zenith", "camera", LOOK_ZENITH, 88.0, "look zenith", step=1.0),
    _of("view.heading", "camera", LOOK_BEARING, 180.0, step=1.0, wraps=True),
    _of("view.roll", "camera", ROLL, 0.0, step=1.0, wraps=True),
    ViewValue(path="view.filter", label="polarising filter", group="camera", kind="switch",
              default=False,
              help="Ideal polarising filter in front of the camera; it halves unpolarised light.",
              synonyms=("polariser", "polarizer", "polarisation", "polarization", "degree",
                        "sunglasses")),
    _of("view.polariser", "camera", POLARISER, 0.0, "filter angle", step=1.0, wraps=True),
    _of("view.dehaze", "camera", DEHAZE, DEHAZE.initial, step=0.1),
    _of("view.field_of_view", "camera", FIELD_OF_VIEW, 60.0, least=1e-3, step=1.0),
    _of("view.projection", "camera", NEAR_PROJECTION, "perspective"),
    _of("view.ground", "camera", GROUND, "detailed"),
    _of("view.sun_zenith", "sun", SUN_ZENITH, 60.0, step=0.5),
    _of("view.sun_azimuth", "sun", SUN_AZIMUTH, 180.0, step=1.0, wraps=True),
    ViewValue(path="view.clock", label="sun by date and time", group="sun", kind="switch",
              default=False,
              help="Sun by place and time, on Earth, Mars and Titan.",
              synonyms=("clock", "calendar", "almanac", "ephemeris", "season", "today")),
    ViewValue(path="view.year", label="year", group="sun", low=1950.0, high=2050.0, least=1950.0,
              most=2050.0, step=1.0, default=2026.0, help="Year of the date.",
              synonyms=("date", "calendar")),
    ViewValue(path="view.day", label="day of the year", group="sun", low=1.0, high=366.0,
              least=1.0, most=366.0, step=1.0, default=172.0,
              help="Day of the year: 1 is 1 January, 172 is 21 June.",
              synonyms=("date", "month", "season", "calendar", "summer", "winter")),
    ViewValue(path="view.hour", label="time, UTC", group="sun", unit="h", low=0.0, high=24.0,
              least=0.0, most=24.0, step=0.25, default=12.0,
              help="Coordinated universal time of the day.",
              synonyms=("clock", "hour", "time of day", "utc", "gmt")),
    _choice("view.second_light", "second light", "moon", KINDS,
            "A light beside the sun: the Moon with its phase, or a second sun.", default="none",
            synonyms=("moonlight", "moonshine", "second sun", "two suns", "binary", "double star",
                      "night", "companion")),
    ViewValue(path="view.moon_by_date", label="moon by date and time", group="moon",
              kind="switch", default=True,
              help="On Earth the Moon follows date and time with the sun.",
              synonyms=("clock", "calendar", "moonrise", "moonset", "full moon", "almanac")),
    ViewValue(path="view.second_zenith", label="moon zenith", group="moon", unit="deg", low=0.0,
              high=180.0, least=0.0, most=180.0, step=0.5, default=60.0,
              help="Zenith angle of the Moon or second sun; beyond 90 it has set.",
              synonyms=("moonlight", "moon height", "moon elevation", "moonrise", "moonset",
                        "second sun", "binary")),
    ViewValue(path="view.second_azimuth", label="moon bearing", group="moon", unit="deg", low=0.0,
              high=360.0, least=0.0, most=360.0, step=1.0, wraps=True, default=120.0,
              help="Compass bearing of the Moon or second sun: 180 south.",
              synonyms=("moonlight", "moon direction", "moon azimuth", "second sun", "binary")),
    ViewValue(path="view.moon_phase", label="moon phase", group="moon", unit="deg", low=0.0,
              high=180.0, least=0.0, most=180.0, step=1.0, default=0.0,
              help="Phase angle of the Moon: 0 full, 90 half, 180 new.",
              synonyms=("full moon", "half moon", "crescent", "new moon", "moonlight")),
    ViewValue(path="view.second_radius", label="moon radius", group="moon", unit="deg", low=0.1,
              high=5.0, least=0.01, most=30.0, scale="log", step=1.1, default=MEAN_RADIUS,
              help="Angular radius of the Moon or second sun, which determines the irradiance of "
              "a sun.",
              synonyms=("size", "moon size", "second sun", "binary", "supermoon")),
    ViewValue(path="view.second_temperature", label="second sun's temperature", group="moon",
              unit="K", low=1500.0, high=40000.0, least=1500.0, most=40000.0, scale="log",
              step=1.05, default=3500.0, help="Temperature of a second sun, a black body.",
              synonyms=("colour", "color", "red dwarf", "binary", "star")),
    ViewValue(path="display.automatic", label="automatic exposure", group="display",
              kind="switch", help="Automatic exposure, like an adapted eye.", default=True,
              part="display", synonyms=("auto", "brightness", "metering")),
    ViewValue(path="display.locked", label="lock exposure", group="display", kind="switch",
              help="Lock of the automatic exposure.", default=False, part="display",
              synonyms=("hold", "fix", "brightness", "ae lock")),
    _of("display.exposure", "display", EXPOSURE, 0.0, step=0.25, part="display"),
    *(_displayed(name, declared) for name, declared in DISPLAY_FIELDS.items()),
    _choice("light.orders", "orders of scattering", "light", ORDERS,
            "All light, that scattered or reflected once, or that scattered more often.",
            default="all", synonyms=("single scattering", "multiple scattering", "bounces")),
    _choice("light.quality", "quality", "light", QUALITIES,
            "Of the solution that follows the preview.", default="default", part="planet",
            synonyms=("accuracy", "speed", "fast", "fine", "resolution")),
    _choice("light.wavelengths", "wavelengths", "light", WAVELENGTHS,
            "How many are solved: more give truer colours; a GPU takes up to four.",
            default="four", part="planet",
            synonyms=("colour", "color", "spectrum", "spectral", "accuracy")),
)  # fmt: skip

#: View values by path.
VIEW_VALUE: Final[Mapping[str, ViewValue]] = {one.path: one for one in VIEW_VALUES}
#: Initial values of a view, by path.
DEFAULTS: Final[Mapping[str, Value]] = {one.path: one.default for one in VIEW_VALUES}
#: Paths of view values that need a new solution, besides the constituents' switches.
SOLVED: Final = tuple(one.path for one in VIEW_VALUES if one.part == "planet")


def view_parameters(constituents: tuple[str, ...] = ()) -> tuple[Parameter, ...]:
    """Parameters of the view, with one switch per constituent.

    Parameters
    ----------
    constituents : tuple of str
        Groups of the constituents, in the planet's order.

    Examples
    --------
    >>> [one.path for one in view_parameters(("air",)) if one.kind == "switch"]
    ['view.filter', 'view.clock', 'view.moon_by_date', 'display.automatic', 'display.locked',
     'display.eye', 'light.constituents[0]']
    """
    switches = tuple(
        Parameter(
            path=switch_path(index),
            label=name,
            group="light",
            kind="switch",
            help=f"Whether {name} scatters and absorbs.",
        )
        for index, name in enumerate(constituents)
    )
    return (*VIEW_VALUES, *switches)


def switch_path(index: int) -> str:
    """Path of a constituent's switch.

    Examples
    --------
    >>> switch_path(2)
    'light.constituents[2]'
    """
    return f"light.constituents[{index}]"


def settings_of(view: Mapping[str, Value]) -> DisplaySettings:
    """Display settings of a view: each field ``NAME`` from its view value ``display.NAME``.

    Parameters
    ----------
    view : mapping
        View values by path.

    Examples
    --------
    >>> settings_of({**DEFAULTS, "display.tone_map": "agx"}).tone_map
    'agx'
    """
    values = {name: view[f"display.{name}"] for name in DISPLAY_FIELDS}
    return DisplaySettings(**values)  # type: ignore[arg-type]


def scene_of(view: Mapping[str, Any], width: int, height: int) -> Scene:
    """Scene of a view.

    Parameters
    ----------
    view : mapping
        Values of the parameters ``view.…`` by path.
    width, height : int
        Size of the window; a panorama or a cube strip takes the largest size of its aspect ratio
        that fits into it. [pixel]

    Examples
    --------
    >>> scene = scene_of(dict(DEFAULTS), 320, 180)
    >>> scene.camera.look_azimuth, scene.sun_zenith
    (0.0, 60.0)
    """
    projection = str(view["view.projection"])
    width, height = fitting(projection, width, height)
    low, high = PROJECTIONS[projection].field_of_view_limits
    bearing = float(view["view.sun_azimuth"])
    turn = (float(view["view.heading"]) - bearing) % 360.0
    return Scene(
        camera=Camera(
            projection=projection,
            width=width,
            height=height,
            field_of_view=min(max(float(view["view.field_of_view"]), low), high),
            look_zenith=float(view["view.look_zenith"]),
            look_azimuth=turn,
            roll=float(view["view.roll"]),
            polariser=float(view["view.polariser"]) if view["view.filter"] else None,
            dehaze=float(view["view.dehaze"]),
        ),
        altitude=float(view["view.altitude"]),
        sun_zenith=float(view["view.sun_zenith"]),
        latitude=float(view["view.latitude"]),
        longitude=float(view["view.longitude"]),
        sun_azimuth=bearing,
        ground=str(view["view.ground"]),
        secondary_lights=second_lights(view),
    )
