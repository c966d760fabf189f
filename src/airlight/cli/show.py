"""``airlight show``: composition of a planet, and colour of its sky."""

from __future__ import annotations

import dataclasses
import math
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer
from numpy.typing import NDArray

from airlight.cli.comparison import print_comparison
from airlight.cli.console import console, examples, shown_progress
from airlight.cli.option_groups import given_options
from airlight.cli.planet_options import LocalGroundOptions, load
from airlight.cli.scene_file import load_scene
from airlight.cli.solve_options import NoCache
from airlight.errors import ConflictError, ParameterError

if TYPE_CHECKING:
    from rich.console import RenderableType
    from rich.table import Table

    from airlight.planets import Medium, Planet
    from airlight.planets.clouds import Clouds
    from airlight.planets.constituent import Constituent
    from airlight.scene.system import System
    from airlight.scene.system.body import Body
    from airlight.scene.system.light import Light

EPILOG = examples(
    "airlight show earth",
    "airlight show my-planet.toml",
    "airlight show earth --latitude 72 --longitude -40",
    "airlight show earth-openspace --compare earth",
    "airlight show solar-eclipse-2017",
    "airlight show earth --set 'ozone.absorption.ozone=200 DU' --compare earth",
)

#: Range in which omitted absorption bands are listed. [nm]
_SHORTEST, _LONGEST = 780.0, 20_000.0


def show(
    planet: LocalGroundOptions,
    compare: Annotated[
        str | None,
        typer.Option(
            metavar="OTHER",
            help="Planet to compare with: show the differences instead.",
        ),
    ] = None,
    no_cache: NoCache = False,
) -> None:
    """Show a planet: parameters, optical depths, phase functions, sky colour; or a scene.

    Optical depths are vertical, at 680, 550 and 440 nm if in the range of the planet.
    """
    from airlight.planets import Medium
    from airlight.planets.parameter_values import composition_of
    from airlight.scene.system import is_scene_file

    if is_scene_file(planet.planet):
        given = {} if compare is None else {"--compare": compare}
        for option in given | given_options(planet, "latitude", "longitude", "ground_albedo"):
            raise ConflictError(option, "is not available for scene files")
        print_scene(load_scene(planet))
        return
    world = planet.local(planet.load())
    if compare is not None:
        print_comparison(world, load(compare), cache=not no_cache)
        return
    # clouds are listed; numbers are those of the air without them
    medium = Medium.from_planet(world.without_clouds, world.wavelengths)
    out = console()
    out.print(_overview(world, medium, given=planet.ground_albedo is not None), end="\n\n")
    out.print(_constituents(world), end="\n\n")
    if any(composition_of(one) for one in world.constituents):
        out.print(_composition(world), end="\n\n")
    out.print(_optics(world, medium), end="\n\n")
    out.print(_swatch(world.without_clouds, cache=not no_cache))


def _table(*columns: str) -> Table:
    from rich.table import Table

    table = Table(box=None, pad_edge=False)
    for index, column in enumerate(columns):
        table.add_column(column, style="bold" if index == 0 else "")
    return table


def _spectral(values: Any) -> str:
    return "  ".join(f"{float(value):.4g}" for value in values)


def _overview(planet: Planet, medium: Medium, *, given: bool) -> Table:
    from airlight.planets.gas_bands import omitted_bands
    from airlight.planets.omitted_absorption_bands import omitted_absorption_bands

    table = _table(planet.name, "")
    if planet.description:
        table.add_row("description", planet.description)
    table.add_row("ground radius", f"{planet.bottom_radius / 1e3:.8g} km")
    height = (planet.top_radius - planet.bottom_radius) / 1e3
    table.add_row("top of the atmosphere", f"{planet.top_radius / 1e3:.8g} km ({height:.6g} km up)")
    low, high = planet.wavelength_limits
    table.add_row("wavelength range", f"{low:.5g} to {high:.5g} nm")
    for line in omitted_absorption_bands(
        planet, np.arange(max(low, _SHORTEST), min(high, _LONGEST), 10.0)
    ):
        table.add_row("warning", line)
    table.add_row("wavelengths", f"{_spectral(medium.wavelengths)} nm")
    table.add_row("ground albedo", _spectral(medium.ground_albedo))
    if medium.surface.map is not None:
        table.add_row("ground map", medium.surface.map)
    if medium.surface.deck is not None:
        table.add_row("map of the deck", f"{medium.surface.deck}; not in the numbers")
    if medium.surface.map is not None or medium.surface.clouds is not None:
        table.add_row(
            "surface albedo used by the solver", "as given" if given else _ground_below(planet)
        )
    if medium.surface.clouds is not None:
        table.add_row("clouds", f"{medium.surface.clouds}, mean cover {medium.ground.cover:.4g}")
    if planet.rings:
        edges = [radius for one in planet.rings for radius in (one.inner_radius, one.outer_radius)]
        span = f"{min(edges) / 1e3:.6g} to {max(edges) / 1e3:.6g} km"
        table.add_row("rings", f"{len(planet.rings)}, {span}; not in the numbers")
    for one in planet.clouds:
        table.add_row("3-D clouds", f"{_clouds(one)}; not in the numbers")
    for omitted in omitted_bands(planet, medium.wavelengths):
        table.add_row("omitted absorption", str(omitted))
    table.add_row("star", _parameters(planet.star))
    table.add_row("starlight", f"{_spectral(medium.solar_irradiance)} W m⁻² nm⁻¹")
    degrees = planet.star.angular_radius_degrees
    table.add_row("star's angular radius", f"{degrees:.5g} deg")
    return table


def _clouds(clouds: Clouds) -> str:
    """Kind, altitudes, cover and optical depth of clouds."""
    from airlight.planets.clouds import CloudType

    if not isinstance(clouds, CloudType):
        return _parameters(clouds)
    base, top = clouds.base / 1e3, (clouds.base + clouds.depth) / 1e3
    return (
        f"{clouds.title}, {base:.4g} to {top:.4g} km, cover {clouds.cover:.4g}, optical depth "
        f"{clouds.optical_depth:.4g}"
    )


def _ground_below(planet: Planet) -> str:
    """Region of the surface albedo used by the solver."""
    known = planet.ground.local_line(planet.wavelengths[len(planet.wavelengths) // 2])
    return known or "mean of the planet; pictures use the surroundings of the observer"


def _constituents(planet: Planet) -> Table:
    from rich.table import Table

    table = Table("constituent", "profile", "column height", "phase function", box=None)
    table.columns[0].style = "bold"
    for one in planet.constituents:
        phase: Any = one.phase_function
        if phase is None:
            words = _own_phase(one)
        else:
            words = _parameters(phase)
        column = one.profile.column(planet.thickness)
        table.add_row(one.name, _parameters(one.profile), _metres(column), words)
    return table


def _own_phase(constituent: Constituent) -> str:
    """Phase function of a constituent without an explicit one."""
    if not constituent.scatters:
        return "none, absorbs only"
    matter = constituent.matter
    return "Mie" if matter is not None and matter.keyword == "particles" else "Rayleigh"


def _composition(planet: Planet) -> Table:
    """Composition by gases and particles, and the quantities derived from it."""
    from rich.table import Table

    from airlight.planets.parameter_values import composition_of

    table = Table(box=None, title="composition", title_justify="left")
    table.title_style = "italic"
    table.add_column("constituent", style="bold", no_wrap=True)
    table.add_column("quantity", no_wrap=True)
    table.add_column("value")
    for one in planet.constituents:
        heading = one.name
        for (quantity, unit), values in composition_of(one, planet.wavelengths).items():
            shown = "  ".join(v if isinstance(v, str) else f"{v:.6g}" for v in values)
            table.add_row(heading, quantity, f"{shown} {unit}".rstrip())
            heading = ""
    return table


def _optics(planet: Planet, medium: Medium) -> Table:
    from rich.table import Table

    table = Table(box=None, title="vertical optical depth and single-scattering albedo")
    table.title_justify = "left"
    table.title_style = "italic"
    table.add_column("constituent", style="bold")
    for wavelength in medium.wavelengths:
        table.add_column(f"τ {wavelength:.4g} nm", justify="right")
    for wavelength in medium.wavelengths:
        table.add_column(f"ϖ {wavelength:.4g} nm", justify="right")
    depth = medium.vertical_optical_depth
    extinction = medium.scattering + medium.absorption
    share = medium.scattering / np.where(extinction > 0.0, extinction, 1.0)
    for name, tau, albedo in zip(medium.names, depth, share, strict=True):
        table.add_row(name, *(f"{t:.4g}" for t in tau), *(f"{a:.4f}" for a in albedo))
    total = depth.sum(axis=0)
    scattered = (share * depth).sum(axis=0) / np.where(total > 0.0, total, 1.0)
    table.add_row("all", *(f"{t:.4g}" for t in total), *(f"{a:.4f}" for a in scattered))
    return table


def _metres(value: float) -> str:
    return f"{value / 1e3:.5g} km" if value >= 1e3 else f"{value:.5g} m"


def _parameters(thing: Any) -> str:
    """Description of a parameter object: its kind, as in planet files, and its values."""
    from airlight.planets.schema.toml_model import fields_of

    words = [thing.keyword or type(thing).__name__.lower()]
    declared = fields_of(type(thing))
    for field in dataclasses.fields(thing):
        name, key = field.name.replace("_", " "), declared.get(field.name)
        value = getattr(thing, field.name)
        if value is None or value == (field.default if key is None else key.left_out):
            continue
        unit = "" if key is None or key.unit == "1" else f" {key.unit_words}"
        if isinstance(value, (tuple, list)):
            words.append(f"{len(value)} {name}")
        elif isinstance(value, float):
            shown = _metres(value) if unit == " m" else f"{value:.6g}{unit}"
            words.append(f"{name} {shown}")
        elif dataclasses.is_dataclass(value):
            words.append(f"{name} {_spectral(getattr(value, 'values', ()))}{unit}")
        else:
            words.append(f"{name} {value}")
    return ", ".join(words)


def _swatch(planet: Planet, *, cache: bool) -> RenderableType:
    """Sky colours for a solar zenith angle of 45 deg, as colour blocks with codes."""
    from rich.text import Text

    from airlight.render.sky_color import SUN_ZENITH, sky_colors

    text = Text(f"sky from the ground, sun zenith angle {SUN_ZENITH:.0f} deg, azimuth 90 deg\n")
    try:
        with shown_progress() as report:
            colors = sky_colors(planet, cache=cache, progress=report)
    except ParameterError as error:  # no data in the visible
        return text.append(f"no colour: {error}")
    for color in colors:
        text.append("        ", style=f"on {color.code}")
        text.append(f"  {color.look} {color.code}\n")
    return text


# --- scenes of several bodies ---------------------------------------------------------------------


def print_scene(system: System) -> None:
    """Print a scene: its observer and camera, its bodies and its lights."""
    out = console()
    out.print(_scene_overview(system), end="\n\n")
    table = _table("bodies", "is", "radius", "distance", "diameter", "stands at")
    for body in system.bodies:
        apart = body.centre - system.eye
        distance = float(np.linalg.norm(apart))
        radius = system.radius(body)
        half = math.degrees(math.asin(min(radius / distance, 1.0)))
        seen = f"{2.0 * half:.4g}°", _place(system, apart / distance)
        table.add_row(body.name, _kind(body), _length(radius), _length(distance), *seen)
    out.print(table, end="\n\n")
    table = _table("lights", "is", "diameter", "stands at")
    for light in system.lights:
        table.add_row(*_light(system, light))
    out.print(table)


def _scene_overview(system: System) -> Table:
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
        at = f"latitude {observer.latitude:.6g}°, longitude {observer.longitude:.6g}°"
        table.add_row("observer", f"{_length(observer.altitude)} above {observer.body}, {at}")
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
