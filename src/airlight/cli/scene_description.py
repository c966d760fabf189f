"""Description of a scene of several bodies and lights, for ``airlight show``."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from airlight.cli.console import console

if TYPE_CHECKING:
    from rich.table import Table

    from airlight.scene.system import System
    from airlight.scene.system.body import Body
    from airlight.scene.system.light import Light


def print_scene(system: System) -> None:
    """Print a scene: its observer and camera, its bodies and its lights."""
    out = console()
    out.print(_overview(system), end="\n\n")
    table = _table("bodies", "is", "radius", "distance", "diameter", "stands at")
    for body in system.bodies:
        apart = body.centre - system.eye
        distance = float(np.linalg.norm(apart))
        radius = system.radius(body)
        half = math.degrees(math.asin(min(radius / distance, 1.0)))
        table.add_row(body.name, _kind(body), _length(radius), _length(distance),
                      f"{2.0 * half:.4g}°", _place(system, apart / distance))  # fmt: skip
    out.print(table, end="\n\n")
    table = _table("lights", "is", "diameter", "stands at")
    for light in system.lights:
        table.add_row(*_light(system, light))
    out.print(table)


def _table(*columns: str) -> Table:
    from rich.table import Table

    table = Table(box=None, pad_edge=False)
    for index, column in enumerate(columns):
        table.add_column(column, style="bold" if index == 0 else "")
    return table


def _overview(system: System) -> Table:
    table = _table(system.name, "")
    if system.description:
        table.add_row("description", system.description)
    if system.time is not None:
        table.add_row("time", system.time.isoformat())
    observer, view = system.observer, system.view
    if observer.body is None:
        x, y, z = (_length(one) for one in system.eye)
        table.add_row("observer", f"at {x}, {y}, {z}")
    else:
        table.add_row("observer", f"{_length(observer.altitude)} above {observer.body}, latitude "
                      f"{observer.latitude:.6g}°, longitude {observer.longitude:.6g}°")  # fmt: skip
    target = f"at {view.look_at}"
    if view.direction is not None:
        target = f"along {', '.join(f'{one:g}' for one in view.direction)}"
    elif view.look_zenith is not None:
        target = f"to zenith angle {view.look_zenith:g}°, bearing {view.look_bearing:g}°"
    wide = "" if view.field_of_view is None else f", {view.field_of_view:g}° wide"
    table.add_row("camera", f"{view.projection}, looks {target}{wide}")
    table.add_row("stars", "those of the catalogue" if system.stars else "none")
    return table


def _kind(body: Body) -> str:
    if body.planet is not None:
        return f"planet {body.planet}"
    return f"without air, {body.reflection}"


def _light(system: System, light: Light) -> tuple[str, str, str, str]:
    if light.star is None:
        body = system.body(light.body or "")
        apart = body.centre - system.eye
        return body.name, "reflects the stars", "", _place(system, apart / np.linalg.norm(apart))
    star = light.star_at(system.eye)
    kind = "star" if star.temperature is None else f"star of {star.temperature:g} K"
    kind = kind if star.spectrum is None else f"star, {star.spectrum}"
    corona = "" if light.corona is None else f", corona {light.corona}"
    diameter = f"{2.0 * star.angular_radius_degrees:.4g}°"
    return light.name, kind + corona, diameter, _place(system, light.towards(system.eye))


def _place(system: System, towards: NDArray[np.float64]) -> str:
    """True altitude and bearing of a direction, for an observer above a body."""
    if system.observer.body is None:
        return ""
    body = system.body(system.observer.body)
    up = (system.eye - body.centre) / np.linalg.norm(system.eye - body.centre)
    north = system.axes(body)[2]
    east = np.cross(north, up)
    altitude = math.degrees(math.asin(float(np.clip(towards @ up, -1.0, 1.0))))
    if abs(altitude) > 89.999:
        return "above" if altitude > 0.0 else "below"
    bearing = math.degrees(math.atan2(towards @ east, towards @ np.cross(up, east))) % 360.0
    return f"altitude {altitude:+.2f}°, bearing {bearing:.1f}°"


def _length(value: float) -> str:
    return f"{value / 1e3:.6g} km" if abs(value) >= 1e3 else f"{value:.5g} m"
