"""Cases: lines of sight on which the three solvers are compared, from ground to space.

A list of 60 lines of sight, ordered by observer, sun and view. Observers: on the ground, at 1, 10
and 30 km, at the top of the shell, and at 400 and 500 km. Sun: 0° to 96° from the zenith. Views:
zenith, slant, horizon, limb, ground and nadir, with the sun ahead, to the side and behind.

The solar zenith angle is that **at the target point**: the lowest point of a limb view, the ground
for a view to the ground, otherwise the observer.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import acos, asin, atan2, cos, degrees, hypot, radians, sin, sqrt
from typing import Final, Literal, TypedDict

import numpy as np
from numpy.typing import NDArray

from airlight.planets import Planet

FloatArray = NDArray[np.float64]


class CaseLines(TypedDict):
    """Keyword arguments of ``Solution.radiance``, each of shape (n,). [m], [deg]"""

    altitude: FloatArray
    sun_zenith: FloatArray
    view_zenith: FloatArray
    azimuth: FloatArray


#: Wavelengths of the comparison. [nm]
WAVELENGTHS: Final = (680.0, 550.0, 440.0)


@dataclass(frozen=True)
class Case:
    """Line of sight, independent of the planet.

    Attributes
    ----------
    observer : float or "top"
        Altitude; ``"top"`` is the top of the shell. [m]
    sun : float
        Zenith angle of the sun at the target point. [deg]
    view : float
        Zenith angle of the view at the observer, for ``kind`` "angle"; the lowest altitude of the
        line of sight, for "limb". [deg] or [m]
    azimuth : float
        Azimuth between the horizontal parts of view and sun, at the target point. [deg]
    kind : "angle" or "limb"
        Meaning of ``view``.
    """

    observer: float | Literal["top"]
    sun: float
    view: float
    azimuth: float = 0.0
    kind: Literal["angle", "limb"] = "angle"

    def __str__(self) -> str:
        """Description, such as ``"400 km, limb 20 km, sun 92°, azimuth 0°"``."""
        where = "top" if self.observer == "top" else f"{self.observer / 1e3:g} km"
        view = f"limb {self.view / 1e3:g} km" if self.kind == "limb" else f"view {self.view:g}°"
        return f"{where}, {view}, sun {self.sun:g}°, azimuth {self.azimuth:g}°"


def _limb(observer: float | Literal["top"], sun: float, lowest: float, azimuth: float) -> Case:
    return Case(observer, sun, lowest, azimuth, "limb")


#: The grid, in its order.
CASES: Final[tuple[Case, ...]] = (
    # On the ground: up, slanting, along the horizon; from noon to the end of civil twilight.
    Case(0.0, 0.0, 0.0),
    Case(0.0, 0.0, 75.0, 90.0),
    Case(0.0, 30.0, 0.0),
    Case(0.0, 30.0, 60.0, 0.0),
    Case(0.0, 60.0, 0.0),
    Case(0.0, 60.0, 30.0, 180.0),
    Case(0.0, 60.0, 85.0, 90.0),
    Case(0.0, 60.0, 89.0, 0.0),
    Case(0.0, 80.0, 0.0),
    Case(0.0, 80.0, 70.0, 0.0),
    Case(0.0, 80.0, 85.0, 180.0),
    Case(0.0, 85.0, 45.0, 90.0),
    Case(0.0, 85.0, 80.0, 0.0),
    Case(0.0, 88.0, 0.0),
    Case(0.0, 88.0, 85.0, 0.0),
    Case(0.0, 88.0, 75.0, 180.0),
    Case(0.0, 90.0, 0.0),
    Case(0.0, 90.0, 80.0, 0.0),
    Case(0.0, 90.0, 89.0, 180.0),
    Case(0.0, 92.0, 0.0),
    Case(0.0, 92.0, 85.0, 0.0),
    Case(0.0, 92.0, 80.0, 90.0),
    Case(0.0, 94.0, 0.0),
    Case(0.0, 94.0, 85.0, 0.0),
    Case(0.0, 96.0, 0.0),
    Case(0.0, 96.0, 88.0, 0.0),
    # 1 km: within the aerosol; horizontal, down to the ground, nadir.
    Case(1e3, 30.0, 90.0, 90.0),
    Case(1e3, 60.0, 120.0, 180.0),
    Case(1e3, 85.0, 60.0, 0.0),
    Case(1e3, 88.0, 180.0),
    Case(1e3, 92.0, 90.0, 0.0),
    # 10 km: an airliner.
    Case(10e3, 0.0, 150.0, 90.0),
    Case(10e3, 60.0, 0.0),
    Case(10e3, 80.0, 90.0, 0.0),
    Case(10e3, 88.0, 110.0, 180.0),
    Case(10e3, 92.0, 70.0, 0.0),
    Case(10e3, 94.0, 90.0, 180.0),
    # 30 km: a balloon; the limb from within the atmosphere.
    Case(30e3, 30.0, 90.0, 90.0),
    Case(30e3, 60.0, 180.0),
    _limb(30e3, 85.0, 10e3, 0.0),
    Case(30e3, 90.0, 60.0, 180.0),
    _limb(30e3, 92.0, 20e3, 0.0),
    _limb(30e3, 96.0, 20e3, 0.0),
    # The top of the shell.
    Case("top", 0.0, 180.0),
    Case("top", 60.0, 130.0, 0.0),
    _limb("top", 30.0, 10e3, 90.0),
    _limb("top", 88.0, 30e3, 180.0),
    Case("top", 90.0, 180.0),
    # Space: the disc, and the limb by day, at the terminator and beyond it.
    Case(400e3, 30.0, 180.0),
    Case(400e3, 80.0, 150.0, 180.0),
    Case(400e3, 92.0, 180.0),
    _limb(400e3, 0.0, 5e3, 0.0),
    _limb(400e3, 60.0, 20e3, 90.0),
    _limb(400e3, 85.0, 10e3, 0.0),
    _limb(400e3, 90.0, 30e3, 180.0),
    _limb(400e3, 92.0, 20e3, 0.0),
    _limb(500e3, 30.0, 60e3, 0.0),
    _limb(500e3, 80.0, 50e3, 180.0),
    _limb(500e3, 94.0, 30e3, 0.0),
    _limb(500e3, 96.0, 40e3, 90.0),
)


def at_observer(case: Case, bottom_radius: float, top_radius: float) -> tuple[float, ...]:
    """Arguments of ``Solution.radiance`` for a case.

    Parameters
    ----------
    bottom_radius, top_radius : float
        Radii of the planet. [m]

    Returns
    -------
    altitude, sun_zenith, view_zenith, azimuth : float
        Values at the observer. [m], [deg]

    Examples
    --------
    >>> noon = at_observer(Case(0.0, 30.0, 60.0, 90.0), 6360e3, 6460e3)
    >>> [round(x, 9) for x in noon]
    [0.0, 30.0, 60.0, 90.0]
    >>> limb = at_observer(Case(400e3, 90.0, 20e3, 0.0, "limb"), 6360e3, 6460e3)
    >>> [round(x, 3) for x in limb]  # the sun ahead and level there, so as low as the view here
    [400000.0, 109.302, 109.302, 0.0]
    """
    altitude = top_radius - bottom_radius if case.observer == "top" else case.observer
    r = bottom_radius + altitude
    if case.kind == "limb":
        lowest = bottom_radius + case.view
        view = np.pi - asin(lowest / r)
        turned = view - 0.5 * np.pi  # angle at the planet's centre to the target point
    else:
        view = radians(case.view)
        turned = 0.0
        discriminant = bottom_radius**2 - (r * sin(view)) ** 2
        if cos(view) < 0.0 and discriminant >= 0.0 and altitude > 0.0:
            way = -r * cos(view) - sqrt(discriminant)
            turned = atan2(way * sin(view), r + way * cos(view))
    # The sun in the frame of the target point: x away from the observer, z up.
    sun, around = radians(case.sun), radians(case.azimuth)
    x, y, z = sin(sun) * cos(around), sin(sun) * sin(around), cos(sun)
    # That frame is the observer's, rotated by the angle between them at the planet's centre.
    x, z = x * cos(turned) + z * sin(turned), z * cos(turned) - x * sin(turned)
    sun_zenith = acos(min(max(z, -1.0), 1.0))
    azimuth = atan2(abs(y), x) if hypot(x, y) > 1e-12 else around
    return float(altitude), degrees(sun_zenith), degrees(view), degrees(azimuth)


def geometry(planet: Planet, cases: Sequence[Case] = CASES, level: float = 0.0) -> CaseLines:
    """Keyword arguments of ``Solution.radiance`` for cases of a planet.

    Parameters
    ----------
    level : float
        Altitude that replaces the ground in the cases, such as a cloud top. [m]

    Returns
    -------
    CaseLines
        Arrays of shape (n,).
    """
    bottom, top = planet.bottom_radius + level, planet.top_radius
    rows = np.array([at_observer(one, bottom, top) for one in cases])
    altitude, sun_zenith, view_zenith, azimuth = np.ascontiguousarray(rows.T)
    return CaseLines(
        altitude=altitude + level, sun_zenith=sun_zenith, view_zenith=view_zenith, azimuth=azimuth
    )
