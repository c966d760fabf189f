"""Description of a map: JSON sidecar with axes, scale and lights, and OpenEXR attributes."""

from __future__ import annotations

import json
import math
import re
from datetime import UTC
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import ArrayLike

from airlight.files.provenance import version
from airlight.geometry.ephemeris.instant import universal_time
from airlight.physics.constants import LUMINOUS_EFFICACY

if TYPE_CHECKING:
    from airlight.engines.environment.disc import Disc
    from airlight.engines.environment.environment_map import EnvironmentMap

#: Format of the file.
FORMAT: Final = "airlight sky 1"
#: Significant digits of its numbers.
_DIGITS: Final = 9


def described(made: EnvironmentMap, name: str, scale: float) -> dict[str, Any]:
    """Contents of the sidecar.

    Parameters
    ----------
    scale : float
        Ratio of the file's numbers to radiances. [1]

    Returns
    -------
    dict
        Numbers, texts and lists. Irradiances and radiances are linear sRGB, weighted by the
        colour-matching functions: 683 times their luminance is in lx and cd m⁻².
    """
    scene, consumer = made.scene, made.consumer
    camera = scene.camera
    observer: dict[str, Any] = {"altitude_m": scene.altitude}
    if made.placed:
        observer |= {"latitude_deg": scene.latitude, "longitude_deg": scene.longitude}
    if scene.time is not None:
        observer["time"] = universal_time(scene.time)
    middle = "bearing_of_the_bottom_deg" if consumer.tilt is not None else "bearing_of_middle_deg"
    if consumer.projection == "octahedral":
        middle = "bearing_of_the_bottom_deg"
    return {
        "format": FORMAT,
        "airlight": version(),
        "planet": made.planet,
        "map": name,
        "for": consumer.name,
        "reader": consumer.title,
        "projection": consumer.projection,
        "width": camera.width,
        "height": camera.height,
        middle: consumer.centre % 360.0,
        **({} if consumer.tilt is None else {"tilt_deg": consumer.tilt}),
        "frame": {
            "east": _numbers(consumer.direction(np.array([1.0, 0.0, 0.0]))),
            "north": _numbers(consumer.direction(np.array([0.0, 1.0, 0.0]))),
            "up": _numbers(consumer.direction(np.array([0.0, 0.0, 1.0]))),
            "handedness": consumer.handedness,
        },
        "unit": "W m-2 sr-1, linear sRGB weighted by CIE 1931, times scale",
        "scale": scale,
        "white_luminance_cd_m2": _rounded(LUMINOUS_EFFICACY / scale),
        "observer": observer,
        "sun": made.sun,
        "sun_bearing_deg": _rounded(scene.sun_azimuth % 360.0),
        "sun_true_zenith_deg": _rounded(scene.sun_zenith),
        "ground": made.ground,
        "horizontal_irradiance_of_map_W_m2": _numbers(made.irradiance(np.array([0.0, 0.0, 1.0]))),
        "gamut": {
            "share_of_texels_changed": _rounded(made.gamut.share),
            "largest_change_over_luminance": _rounded(made.gamut.largest),
        },
        "lights": [_light(one, made) for one in made.discs],
    }


def as_json(contents: dict[str, Any]) -> str:
    """JSON text with one vector per line.

    Examples
    --------
    >>> print(as_json({"up": [0.0, 0.0, 1.0]}))
    {
     "up": [0.0, 0.0, 1.0]
    }
    """
    text = json.dumps(contents, indent=1)
    # a line break follows the bracket of a list, and never one in a text
    return re.sub(r"\[\n\s*([^][{}\"]*?)\s*\]", lambda m: "[" + " ".join(m[1].split()) + "]", text)


def _light(disc: Disc, made: EnvironmentMap) -> dict[str, Any]:
    east, north, up = (float(value) for value in disc.direction)
    irradiance = disc.irradiance
    peak = float(irradiance.max())
    return {
        "name": disc.name,
        "in_map": made.sun == "include",
        "direction": _numbers(made.consumer.direction(disc.direction)),
        "bearing_deg": _rounded(math.degrees(math.atan2(east, north)) % 360.0),
        "elevation_deg": _rounded(math.degrees(math.asin(up))),
        "angular_diameter_deg": _rounded(disc.angular_diameter),
        "irradiance_W_m2": _numbers(irradiance),
        "illuminance_lx": _rounded(disc.illuminance),
        "color": _numbers(irradiance / peak),
        "limb_darkening": [_numbers(row) for row in disc.darkening],
        "gamut_change_W_m2": _numbers(disc.moved),
    }


def _rounded(value: float) -> float:
    return float(f"{value:.{_DIGITS}g}") + 0.0


def _numbers(values: ArrayLike) -> list[float]:
    """Numbers with rounding noise, relative to the largest, set to 0."""
    array = np.asarray(values, np.float64)
    array = np.where(np.abs(array) < 10.0**-_DIGITS * np.abs(array).max(), 0.0, array)
    return [_rounded(float(value)) for value in array]


def standard_attributes(made: EnvironmentMap, scale: float) -> dict[str, Any]:
    """Standard attributes: projection, place, time and unit.

    Location and time are written if known: ``latitude`` and ``longitude`` north and east
    positive [deg], ``altitude`` [m], ``capDate`` in universal time with ``utcOffset`` 0 [s].

    Parameters
    ----------
    scale : float
        Ratio of the file's numbers to radiances; ``whiteLuminance``, the luminance of (1, 1, 1), is
        proportional to its reciprocal. [1]

    References
    ----------
    OpenEXR, "Standard Attributes"; "Technical Introduction to OpenEXR", environment maps.
    """
    import OpenEXR

    scene = made.scene
    known: dict[str, Any] = {
        "whiteLuminance": LUMINOUS_EFFICACY / scale,
        "altitude": scene.altitude,
    }
    if made.consumer.projection == "equirectangular":
        known["envmap"] = OpenEXR.ENVMAP_LATLONG
    if made.placed:
        known |= {"latitude": scene.latitude, "longitude": scene.longitude}
    if scene.time is not None:
        moment = scene.time.astimezone(UTC)
        known |= {"capDate": f"{moment:%Y:%m:%d %H:%M:%S}", "utcOffset": 0.0}
    return known
