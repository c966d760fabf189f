"""Uniforms of scene, maps, display and orders of scattering, by name."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Final

import numpy as np
import numpy.typing as npt
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.geometry.refraction import apparent_sun
from airlight.image.display_settings import DisplaySettings
from airlight.image.spectral import sun_color
from airlight.image.texels import CHANNELS
from airlight.image.white_balance import White
from airlight.image.xyz import luminance
from airlight.kernel.shader_fields import scalars_of
from airlight.physics.constants import LUMINOUS_EFFICACY
from airlight.physics.spectra.blackbody import planck_radiance
from airlight.planets.light_source import Occulter
from airlight.render.pixels.airglow import basis_colors
from airlight.render.pixels.deck import deck_uniforms
from airlight.render.pixels.disc_shading import OCCULTER, shading_uniforms
from airlight.render.pixels.night_tables import NightTables
from airlight.render.pixels.occulted_light import disc_factor
from airlight.render.pixels.pixel import ViewUniforms
from airlight.render.pixels.polarising_filter import CAMERA, NONE
from airlight.render.pixels.ring_shine import RingShine
from airlight.render.pixels.sky_view_cpu import SkyViewLayers
from airlight.render.pixels.sky_view_lut import Observer
from airlight.scene import Camera, Scene
from airlight.scene.ground_detail import LEAST_HEIGHT, NOMINAL_ROWS, finest_cell, lattice_origin
from airlight.scene.ground_overlay import LAMP_TEMPERATURE, TOWN_LUMINANCE
from airlight.scene.map_grain import EVEN
from airlight.scene.projections import PROJECTIONS
from airlight.scene.surface_map import SurfaceMap, surface_map

if TYPE_CHECKING:
    from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Values of ``orders``, with their uniforms in the shaders.
ORDERS: Final = {"all": 2, "single": 1, "multiple": 0}
#: Scattering coefficient below which air has no wind that fills craters. [m⁻¹]
WINDLESS: Final = 1e-9
#: Largest number of samples per side of a pixel.
MAX_SAMPLES: Final = 16


def view_uniforms(scene: Scene, solution: MomentsSolution) -> dict[str, float]:
    """Uniforms of observer, camera and the first light of the solution.

    Parameters
    ----------
    scene : Scene
        Observer, star and camera.
    """
    camera, medium = scene.camera, solution.geometry.medium
    if scene.altitude < 0.0:
        allowed = "0 m or more above the ground of the solution: see airlight.lowered_ground"
        raise ParameterError("scene.altitude", scene.altitude, allowed)
    detailed = scene.ground == "detailed"
    altitude = max(scene.altitude, LEAST_HEIGHT) if detailed else scene.altitude
    true_r = solution.medium.bottom_radius + altitude
    r = float(solution.geometry.optical_radius(np.array(true_r)))
    outside = scene.altitude >= solution.medium.thickness
    bottom = medium.bottom_radius
    sun = scene.sun_direction
    seen, geometry = sun[2], solution.geometry
    if geometry.shell is not None and not outside:
        seen = float(
            apparent_sun(
                r, sun[2], geometry.shell.bottom, geometry.shell.top, geometry.refraction_table
            )[0]
        )
    assert camera.field_of_view is not None
    star_radius = solution.lights[0].angular_radius
    horizon_mu, horizon_sine, sun_level, seen_level, disc = observer_uniforms(
        r, bottom, float(sun[0]), float(sun[1]), seen, star_radius
    )
    uniforms = {
        "r": r,
        "optical_altitude": r - bottom,
        "outside": float(outside),
        "horizon_mu": horizon_mu,
        "horizon_sine": horizon_sine,
        "sun_x": sun_level,
        "sun_z": float(sun[2]),
        "seen_x": seen_level,
        "seen_z": seen,
        "field_of_view": np.radians(camera.field_of_view),
        "projection": list(PROJECTIONS).index(camera.projection),
        "pixel_angle": camera.pixel_angle,
        "disc": 0.0 if camera.parallel else disc,
        "samples": 1.0,
        "edges": 1.0,
    }
    source = solution.lights[0]
    uniforms["filter"] = NONE if camera.polariser is None else CAMERA
    uniforms |= _vector("filter_axis", camera.filter_axis)
    uniforms["dehaze"] = camera.dehaze
    uniforms |= _occulter_uniforms(source.occulter)
    if source.occulter is not None:
        uniforms["disc"] *= disc_factor(source.occulter.left)
    uniforms |= shading_uniforms(source.phase, source.limb, sun_level, float(sun[2]))
    uniforms["faced"] = float(source.face is not None)
    uniforms["flattening"] = solution.medium.flattening if outside else 0.0
    uniforms |= _vector("centre", np.array([0.0, 0.0, -r]))
    for name, axis in zip(("right", "up", "forward"), camera.axes, strict=True):
        uniforms |= _vector(name, axis)
    ground = solution.medium.surface.map
    rows = NOMINAL_ROWS if ground is None else surface_map(ground).rows
    cell = finest_cell(bottom, rows)
    uniforms |= {"detailed": float(detailed), "detail_cell": cell}
    for name, row in zip("xyz", scene.ground_frame, strict=True):
        uniforms |= _vector(f"ground_{name}", row)
        whole, part = lattice_origin(float(row[2]), bottom, cell)
        uniforms |= {f"whole_{name}": whole, f"part_{name}": part}
    return uniforms


def is_always_marched(scene: Scene, solution: MomentsSolution) -> bool:
    """Whether every pixel is marched: among rings, and of an oblate planet from outside the air."""
    medium = solution.medium
    oblate = medium.flattening > 0.0 and scene.altitude >= medium.thickness
    return bool(medium.rings) or oblate


def observer_uniforms(
    r: float, bottom: float, sun_x: float, sun_y: float, seen: float, star_radius: float
) -> tuple[float, float, float, float, float]:
    """Uniforms derived from the positions of observer and star; also emitted as JavaScript.

    Parameters
    ----------
    r, bottom : float
        Optical radii of observer and ground. [m]
    sun_x, sun_y : float
        Horizontal components of the direction towards the star. [1]
    seen : float
        Cosine of the apparent zenith angle of the star. [1]
    star_radius : float
        Angular radius of the star. [rad]

    Returns
    -------
    horizon_mu, horizon_sine : float
        Cosine and sine of the horizon's zenith angle. [1]
    sun_level, seen_x : float
        Horizontal component of the true and of the apparent direction of the star. [1]
    disc : float
        Radiance of the star's disc per irradiance; 0 for a point. [sr⁻¹]

    Examples
    --------
    >>> observer_uniforms(2.0, 1.0, 0.6, 0.0, 0.8, 0.0)[1:]
    (0.5, 0.6, 0.6, 0.0)
    """
    half = math.sin(0.5 * star_radius)
    return (
        -math.sqrt(max((r - bottom) * (r + bottom), 0.0)) / r,
        bottom / r,
        math.hypot(sun_x, sun_y),
        math.sqrt(max((1.0 - seen) * (1.0 + seen), 0.0)),
        1.0 / (4.0 * math.pi * half * half) if star_radius > 0.0 else 0.0,
    )


def _vector(name: str, values: FloatArray) -> dict[str, float]:
    """Uniforms of a ``Vec3``."""
    return {f"{name}_{c}": float(value) for c, value in zip("xyz", values, strict=True)}


def _occulter_uniforms(occulter: Occulter | None) -> dict[str, float]:
    """Uniforms of an occulting moon; radius 0 without one."""
    values = (0.0, 0.0, 0.0, 0.0) if occulter is None else occulter[:4]
    return dict(zip(OCCULTER, values, strict=True))


def observer_from(uniforms: Mapping[str, float]) -> Observer:
    """``Observer`` from the uniforms of a scene and of the orders of scattering."""
    return Observer(**scalars_of(Observer, uniforms))


def cpu_view_uniforms(
    uniforms: dict[str, float],
    camera: Camera,
    ground: SurfaceMap | None,
    overlay: SurfaceMap | None,
    layers: SkyViewLayers,
    night: NightTables,
    shine: RingShine,
) -> ViewUniforms:
    """``ViewUniforms`` of the CPU: camera, ground maps and sky-view LUT.

    Parameters
    ----------
    uniforms : dict
        Numbers of the scene, and whether the star's disc is rendered.
    camera : Camera
        Camera of the scene.
    ground : SurfaceMap
        Ground map; None without a map.
    overlay : SurfaceMap
        City lights and clouds; None without both.
    layers : SkyViewLayers
        Layers of a window of the sky-view LUT.
    night : NightTables
        Light of the night.
    shine : RingShine
        Light of the rings on the planet.
    """
    uniforms = uniforms | size_uniforms(ground, overlay, uniforms["decked"])
    uniforms |= {"width": camera.width, "height": camera.height, "sky_columns": 0, "sky_rows": 0}
    uniforms["separated_phases"] = len(layers.first) > 1
    uniforms["shines"] = int(len(shine.irradiance) > 1)
    return ViewUniforms(
        **scalars_of(ViewUniforms, uniforms),
        texels=np.zeros(CHANNELS, np.uint8) if ground is None else ground.flat,
        over_texels=np.zeros(CHANNELS, np.uint8) if overlay is None else overlay.flat,
        sky_air=layers.air,
        sky_ground=layers.ground,
        sky_first=layers.first,
        sky_second=layers.second,
        sky_q=layers.stokes_q,
        sky_u=layers.stokes_u,
        sky_mirrored=layers.mirrored,
        **night._asdict(),
        shine=shine.irradiance,
        shine_directions=shine.directions,
    )


def size_uniforms(
    ground: SurfaceMap | None, overlay: SurfaceMap | None, decked: float
) -> dict[str, float]:
    """Uniforms of the sizes of maps.

    Parameters
    ----------
    ground, overlay : SurfaceMap
        Map of the ground or of the deck; city lights and clouds; None without these.
    decked : float
        Whether the first is that of the deck.
    """
    has_map = float(ground is not None)
    uniforms = {"mapped": has_map * (1.0 - decked), "decked": has_map * decked}
    uniforms["overlaid"] = float(overlay is not None)
    for name, image in (("map", ground), ("over", overlay)):
        size = (1, 1, 1) if image is None else (image.rows, image.columns, len(image.levels))
        sides = (f"{name}_rows", f"{name}_columns", f"{name}_levels")
        uniforms |= dict(zip(sides, size, strict=True))
    return uniforms


def overlay_uniforms(
    solution: MomentsSolution, weights: npt.ArrayLike | None = None
) -> dict[str, float]:
    """Uniforms of the night's light, of the cloud layer, and of the detail of the ground.

    Parameters
    ----------
    solution : MomentsSolution
        Solution, lit by one of the lights.
    weights : array, shape (nl, 3), optional
        Argument of ``LightSource.colors``.
    """
    medium, altitude = solution.medium, solution.medium.surface.cloud_altitude
    radius = solution.geometry.optical_radius(np.array(medium.bottom_radius + altitude))
    return (
        night_uniforms(solution, weights)
        | land_uniforms(medium.surface.map)
        | deck_uniforms(medium)
        | {
            "decked": float(medium.surface.deck is not None),
            "clouded": float(medium.surface.overlay[1] is not None),
            "clouds_from_space": float(medium.surface.clouds is None),
            "relieved": float(medium.surface.relief is not None),
            "rocks": medium.surface.rocks,
            "craters": medium.surface.craters,
            "weathered": float(np.any(medium.scattering > WINDLESS)),
            "cloud_altitude": altitude,
            "cloud_radius": float(radius),
        }
    )


def land_uniforms(name: str | None) -> dict[str, float]:
    """Uniforms of the detail of the ground: colour of the map's water, contrast of its land. [1]

    Parameters
    ----------
    name : str or None
        Map of the ground.
    """
    found = None if name is None else surface_map(name)
    grain = EVEN if found is None else found.grain
    water = np.zeros(3) if found is None else found.water_rgb
    uniforms = _vector("water", water) | _vector("grain", np.asarray(grain.contrast))
    return uniforms | {"grain_fall": grain.fall}


def night_uniforms(
    solution: MomentsSolution, weights: npt.ArrayLike | None = None
) -> dict[str, float]:
    """Uniforms of the light of the night, 0 for a secondary star.

    The colour of city lights is radiance per irradiance of the star [sr⁻¹], for a map value of 1,
    and does not depend on the star's; airglow and skyglow are factors of their tables [1].

    Parameters
    ----------
    solution, weights :
        Arguments of ``overlay_uniforms``.
    """
    names = ("lamp_red", "lamp_green", "lamp_blue")
    factors = ("airglow", "skyglow")
    if solution.secondary:
        return dict.fromkeys((*names, *factors), 0.0)
    eye = np.arange(360.0, 831.0)
    color = np.maximum(sun_color(planck_radiance(eye, LAMP_TEMPERATURE)), 0.0)
    color *= TOWN_LUMINANCE / LUMINOUS_EFFICACY / luminance(color)
    shown = basis_colors(solution, color, weights).tolist()
    surface = solution.medium.surface
    drawn = float(surface.airglow != "none"), float(surface.lights is not None)
    return dict(zip((*names, *factors), (*shown, *drawn), strict=True))


def display_uniforms(
    exposure: float,
    settings: DisplaySettings,
    star: White | None = None,
    scene: White | None = None,
) -> dict[str, float]:
    """Uniforms of a display.

    Parameters
    ----------
    settings : DisplaySettings
        Display settings.
    exposure, star, scene :
        Arguments of ``DisplaySettings.display``.
    """
    numbers = settings.display(exposure, star, scene)._asdict() | {"glare": settings.glare}
    return {name: float(value) for name, value in numbers.items()}


def order_number(orders: str) -> float:
    """Value of ``orders`` in kernels.

    Parameters
    ----------
    orders : str
        Name from ``ORDERS``.
    """
    if orders not in ORDERS:
        raise ParameterError("orders", orders, ", ".join(ORDERS))
    return float(ORDERS[orders])


def checked_samples(samples: int) -> int:
    """Validated number of samples per side of a pixel.

    Raises
    ------
    ParameterError
        If it is not 1 to 16.
    """
    whole = isinstance(samples, (int, np.integer)) and not isinstance(samples, bool)
    if not whole or not 1 <= samples <= MAX_SAMPLES:
        raise ParameterError("samples", samples, f"1 to {MAX_SAMPLES}")
    return int(samples)
