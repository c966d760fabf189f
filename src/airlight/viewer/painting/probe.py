"""Probe of one direction: spectrum, luminance, chromaticity, optical depths, contributions.

Computed on the CPU from the moments of the displayed solution, each contribution separately, in a
few milliseconds per direction.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.image.texels import CHANNELS
from airlight.image.xyz import chromaticity, luminance, rgb_to_xyz
from airlight.physics.constants import LUMINOUS_EFFICACY
from airlight.render.pixels.disc_shading import (
    SHADING,
    MoonPhase,
    disc_powers,
    shading_uniforms,
)
from airlight.render.pixels.occulted_light import DARKEST
from airlight.render.pixels.scenes_by_light import scenes_by_light
from airlight.render.through_air import leaving_direction, sun_solid_angle
from airlight.scene import Scene
from airlight.scene.camera import Camera
from airlight.scene.directions import zenith_azimuth
from airlight.scene.ground_place import map_color
from airlight.scene.light_position import LightPosition
from airlight.scene.surface_map import surface_map
from airlight.solver.lines_of_sight import LinesOfSight
from airlight.solver.moments.radiance_parts import radiance_parts
from airlight.solver.moments.solution import MomentsSolution, moments_solution
from airlight.solver.stokes_frame import to_meridian
from airlight.solver.tables.columns import columns
from airlight.viewer.painting.ground_radiance import ground_radiance, probed_clouds

FloatArray = NDArray[np.float64]

#: Names of the parts that belong to no constituent.
MORE: Final = "multiple scattering"
GROUND_STAR: Final = "ground, direct irradiance"
GROUND_SKY: Final = "ground, diffuse irradiance"
STAR: Final = "solar disc"


@dataclass(frozen=True, kw_only=True)
class Contribution:
    """Contribution to the radiance in one direction.

    Attributes
    ----------
    name : str
        ``single scattering by …`` for each constituent, or a constant of this module.
    radiance : tuple of float, length nl
        Spectral radiance. [W m⁻² sr⁻¹ nm⁻¹]
    luminance : float
        Luminance; below 0 if the colour is outside the gamut of the wavelengths. [cd m⁻²]
    """

    name: str
    radiance: tuple[float, ...]
    luminance: float


@dataclass(frozen=True, kw_only=True)
class Probe:
    """Radiometric and photometric values of one direction.

    Attributes
    ----------
    view_zenith, azimuth : float
        Angles of the direction; the azimuth is measured from the sun. [deg]
    wavelengths : tuple of float, length nl
        Wavelengths of the solution. [nm]
    radiance : tuple of float, length nl
        Spectral radiance, the sum of the parts. [W m⁻² sr⁻¹ nm⁻¹]
    luminance : float
        Luminance. [cd m⁻²]
    chromaticity : tuple of float
        CIE 1931 x and y; 0 without light. [1]
    rgb : tuple of float
        Linear sRGB, as in a frame without a filter. [W m⁻² sr⁻¹]
    polarised : tuple of float, or None
        Degree of linear polarisation of the luminance [1], and angle from the vertical plane,
        counterclockwise [deg]; None in scalar transfer.
    names : tuple of str, length nc
        Names of the constituents.
    optical_depth : tuple, shape (nc, nl)
        Optical depth of each constituent from the observer to the ground or to space. [1]
    transmittance : tuple of float, length nl
        Transmittance of all constituents along the same path. [1]
    distance : float
        Straight distance to the ground; infinite if the line of sight misses it. [m]
    latitude, longitude : float or None
        Coordinates of the visible ground; None without ground. [deg]
    parts : tuple of Contribution
        Parts that sum to ``radiance``.
    """

    view_zenith: float
    azimuth: float
    wavelengths: tuple[float, ...]
    radiance: tuple[float, ...]
    luminance: float
    chromaticity: tuple[float, float]
    rgb: tuple[float, float, float]
    polarised: tuple[float, float] | None
    names: tuple[str, ...]
    optical_depth: tuple[tuple[float, ...], ...]
    transmittance: tuple[float, ...]
    distance: float
    latitude: float | None
    longitude: float | None
    parts: tuple[Contribution, ...]


def probe_pixel(solution: Any, scene: Scene, x: float, y: float) -> Probe | None:
    """Probe of a pixel; None outside the image circle of a fisheye.

    Parameters
    ----------
    x, y : float
        Position from the left and top edges; the first pixel's centre is at 0.5. [pixel]
    """
    direction = pixel_direction(scene.camera, x, y)
    return None if direction is None else probe(solution, scene, direction)


def pixel_direction(camera: Camera, x: float, y: float) -> FloatArray | None:
    """Direction of a position in the frame; None outside the image circle of a fisheye.

    Parameters
    ----------
    x, y : float
        Position as for ``probe_pixel``. [pixel]

    Returns
    -------
    array, shape (3,), or None
        Unit vector in the observer's local frame. [1]
    """
    for field, value, most in (("x", x, camera.width), ("y", y, camera.height)):
        if not 0.0 <= value <= most:
            raise ParameterError(field, value, f"0 to {most} pixels")
    column, row = min(int(x), camera.width - 1), min(int(y), camera.height - 1)
    offset = (x - (column + 0.5), y - (row + 0.5))
    found = camera.directions(slice(row, row + 1), offset=offset)[0, column]
    return found if found.any() else None


def probe(solution: Any, scene: Scene, direction: FloatArray) -> Probe:
    """Probe of the radiance from a direction.

    Parameters
    ----------
    solution : MomentsSolution
        Displayed solution, without the constituents that are switched off.
    scene : Scene
        Observer and star; its camera only sets the level of detail of the ground map.
    direction : array, shape (3,)
        Unit vector in the observer's local frame.

    Notes
    -----
    The position of the ground point neglects refraction, up to half a degree on Earth.
    """
    solution = moments_solution(solution, "a probe")
    medium = solution.medium
    zenith, azimuth = zenith_azimuth(direction)
    pictures = scenes_by_light(scene, solution)
    by_light = [
        one.solution.lines_of_sight(
            altitude=scene.altitude,
            sun_zenith=one.light.zenith,
            view_zenith=zenith,
            azimuth=math.remainder(azimuth - one.light.azimuth, 360.0),
        )[0]
        for one in pictures
    ]
    drawn = solution.geometry.optical_lines(by_light[0])
    depth = _depths(solution, drawn)
    transmittance = np.exp(-depth.sum(axis=0))
    seen = _ground(solution, scene, direction, drawn)
    spectra: list[tuple[str, FloatArray]] = []
    stokes = np.zeros(2)
    rgb, luminances = np.zeros(3), list[FloatArray]()
    for lines, (_, lit, air, light) in zip(by_light, pictures, strict=True):
        source = lit.lights[0]
        weights = source.colors() / source.irradiance[:, None]
        star = _star(lit, scene.altitude, light, direction, transmittance, bool(drawn.to_ground[0]))
        clouds = probed_clouds(solution, scene, direction, seen[0], light)
        parts = _spectra(lit, lines, seen[3], clouds) if air else []
        if parts and solution.polarised:
            bearing = np.array([azimuth - light.azimuth])
            found = to_meridian(lit.relative_stokes(lines), np.array([zenith]), bearing)[0, 1:]
            stokes += [luminance(one * source.irradiance @ weights) for one in found]
        parts += [(STAR, star)] if star.any() else []
        if not parts:
            continue
        first = not spectra
        spectra += [(name if first else f"{source.name}: {name}", values) for name, values in parts]
        luminances += [luminance(values @ weights) for _, values in parts]
        rgb += np.sum([values for _, values in parts], axis=0) @ weights
    total = np.sum([values for _, values in spectra], axis=0)
    xyz = rgb_to_xyz(rgb)
    x, y = chromaticity(xyz) if xyz.sum() > 0.0 else (0.0, 0.0)
    return Probe(
        view_zenith=zenith,
        azimuth=azimuth,
        wavelengths=tuple(medium.wavelengths.tolist()),
        radiance=tuple(total.tolist()),
        luminance=LUMINOUS_EFFICACY * float(xyz[1]),
        chromaticity=(float(x), float(y)),
        rgb=(float(rgb[0]), float(rgb[1]), float(rgb[2])),
        polarised=_polarised(stokes, float(xyz[1])) if solution.polarised else None,
        names=medium.names,
        optical_depth=tuple(tuple(row) for row in depth.tolist()),
        transmittance=tuple(transmittance.tolist()),
        distance=seen[0],
        latitude=seen[1],
        longitude=seen[2],
        parts=tuple(
            Contribution(
                name=name,
                radiance=tuple(values.tolist()),
                luminance=LUMINOUS_EFFICACY * float(bright),
            )
            for (name, values), bright in zip(spectra, luminances, strict=True)
        ),
    )


def _polarised(stokes: FloatArray, whole: float) -> tuple[float, float]:
    """Degree [1] and angle [deg] of linear polarisation from luminances I, Q and U."""
    q, u = (float(one) for one in stokes)
    degree = min(math.hypot(q, u) / whole, 1.0) if whole > 0.0 else 0.0
    return degree, 0.5 * math.degrees(math.atan2(u, q))


def _spectra(
    solution: MomentsSolution,
    lines: LinesOfSight,
    color: FloatArray | None,
    clouds: tuple[float, float] | None,
) -> list[tuple[str, FloatArray]]:
    """Name and spectral radiance of each contribution except the star. [W m⁻² sr⁻¹ nm⁻¹]"""
    parts = radiance_parts(solution, lines)
    sun = solution.lights[0].irradiance
    once = [
        (f"single scattering by {name}", parts.scattered_once[0, c] * sun)
        for c, name in enumerate(solution.medium.names)
        if parts.scattered_once[0, c].any()
    ]
    more = (MORE, parts.scattered_more[0] * sun)
    if not lines.to_ground[0]:
        return [*once, more]
    star, sky = ground_radiance(solution, lines, parts, color, clouds)
    return [*once, more, (GROUND_STAR, star * sun), (GROUND_SKY, sky * sun)]


def _depths(solution: MomentsSolution, drawn: LinesOfSight) -> FloatArray:
    """Optical depth of each constituent along a line of sight, shape (nc, nl). [1]"""
    medium, air = solution.medium, solution.geometry.medium
    column = columns(drawn.r, drawn.mu, drawn.length, air.bottom_radius, air.density)[0]
    return np.asarray(column[: len(medium.names), None] * medium.extinction)


def _star(
    solution: MomentsSolution,
    altitude: float,
    position: LightPosition,
    direction: FloatArray,
    transmittance: FloatArray,
    to_ground: bool,
) -> FloatArray:
    """Radiance of a light's disc, 0 outside, shape (nl,). [W m⁻² sr⁻¹ nm⁻¹]"""
    star = solution.lights[0]
    alpha = star.angular_radius
    nothing = np.zeros_like(transmittance)
    if alpha <= 0.0 or to_ground:
        return nothing
    outside = leaving_direction(direction[np.newaxis], solution, altitude)[0]
    towards = position.direction
    apart = 2.0 * math.asin(min(0.5 * float(np.linalg.norm(outside - towards)), 1.0))
    if apart > alpha:
        return nothing
    azimuth, left = math.atan2(towards[1], towards[0]), 1.0
    if star.occulter is not None:
        x, y, z, radius, left = star.occulter
        moon = np.array(
            [
                math.cos(azimuth) * x - math.sin(azimuth) * y,
                math.sin(azimuth) * x + math.cos(azimuth) * y,
                z,
            ]
        )
        if left <= DARKEST or np.linalg.norm(outside - moon) < 2.0 * math.sin(0.5 * radius):
            return nothing
    numbers = shading_uniforms(star.phase, star.limb, math.hypot(*towards[:2]), float(towards[2]))
    across = math.cos(azimuth) * numbers["limb_x"] - math.sin(azimuth) * numbers["limb_y"]
    aside = math.sin(azimuth) * numbers["limb_x"] + math.cos(azimuth) * numbers["limb_y"]
    along = float((outside - towards) @ [across, aside, numbers["limb_z"]]) / max(apart, 1e-12)
    powers = disc_powers(
        1.0 / (left * sun_solid_angle(alpha)),
        apart,
        alpha,
        0.0,
        along,
        star.phase is not None,
        MoonPhase(*(numbers[name] for name in SHADING[:4])),
    )
    return np.asarray(transmittance * star.irradiance * (star.darkenings @ powers))


def _ground(
    solution: MomentsSolution, scene: Scene, direction: FloatArray, drawn: LinesOfSight
) -> tuple[float, float | None, float | None, FloatArray | None]:
    """Distance [m], latitude and longitude [deg], colour and water fraction [1] of the ground."""
    medium, color = solution.medium, None
    if not drawn.to_ground[0]:
        return math.inf, None, None, color
    bottom = medium.bottom_radius
    r, mu = bottom + scene.altitude, float(direction[2])
    sine = math.hypot(float(direction[0]), float(direction[1]))
    # h (2R + h) keeps its precision near the ground, where r² - R² loses it to cancellation.
    power = scene.altitude * (2.0 * bottom + scene.altitude)
    half = math.sqrt(max((bottom - r * sine) * (bottom + r * sine), 0.0))
    distance = power / (half - r * mu) if half - r * mu > 0.0 else 0.0
    place = distance * direction + np.array([0.0, 0.0, r])
    spot = scene.ground_frame @ place
    latitude = math.degrees(math.atan2(spot[2], math.hypot(spot[0], spot[1])))
    longitude = math.degrees(math.atan2(spot[1], spot[0]))
    if medium.surface.map is not None:
        image = surface_map(medium.surface.map)
        slant = max(-float(direction @ place) / bottom, 0.05)
        footprint = scene.camera.pixel_angle * distance / (bottom * math.sqrt(slant))
        level = math.log2(max(footprint * image.rows / math.pi, 1.0))
        color = np.empty(CHANNELS)
        size = image.rows, image.columns, len(image.levels)
        here = math.radians(latitude), math.radians(longitude)
        map_color(image.flat, *size, *here, level, color, 0)
    return distance, latitude, longitude, color
