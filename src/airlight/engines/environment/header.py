"""Standard OpenEXR attributes of an environment map."""

from __future__ import annotations

from datetime import UTC
from typing import TYPE_CHECKING, Any

from airlight.physics.constants import LUMINOUS_EFFICACY

if TYPE_CHECKING:
    from airlight.engines.environment.environment_map import EnvironmentMap


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
        "whiteLuminance": LUMINOUS_EFFICACY / scale, "altitude": scene.altitude,
    }  # fmt: skip
    if made.consumer.projection == "equirectangular":
        known["envmap"] = OpenEXR.ENVMAP_LATLONG
    if made.placed:
        known |= {"latitude": scene.latitude, "longitude": scene.longitude}
    if scene.time is not None:
        moment = scene.time.astimezone(UTC)
        known |= {"capDate": f"{moment:%Y:%m:%d %H:%M:%S}", "utcOffset": 0.0}
    return known
