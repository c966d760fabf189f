"""``render_system``: frame of several bodies, with and without atmospheres.

Rays are traced from the observer through the atmospheres that they cross, which attenuate and
refract them and add path radiance, until they meet a surface, a star's disc, or leave the scene.
Bodies do not overlap, so all rays meet them in the order of the power of the observer's point,
d² - R².

``CpuRenderer`` renders the atmosphere and ground of each planet once for each light; whatever lies
behind is sampled ray by ray.
"""

from __future__ import annotations

import math
from collections.abc import Container, Mapping, Sequence
from dataclasses import replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.image.texels import CHANNELS
from airlight.image.white_balance import star_white
from airlight.kernel import vectorized
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.planets.light_source import LightSource
from airlight.planets.parameters import replace as replaced
from airlight.planets.picture_wavelengths import picture_wavelengths
from airlight.render.bare_bodies import body_map, crater_density, map_mean
from airlight.render.clouds.cloud_time import CloudTime
from airlight.render.corona import OUTERMOST, corona
from airlight.render.pixels.bare_ground import crater_lights, map_colors
from airlight.render.planet_renderer import AtmosphereLayer, atmosphere_layer
from airlight.render.render_scene import CPU, color_wavelengths
from airlight.render.scene_lights import SceneLights
from airlight.render.seen_past import SeenPast
from airlight.render.solve_planet import solve_planets
from airlight.render.star_points import add_sky
from airlight.scene import Camera, Scene
from airlight.scene.craters import REGIONAL
from airlight.scene.directions import camera_angles, level_axes, zenith_azimuth
from airlight.scene.frame import Frame
from airlight.scene.ground_detail import NOMINAL_ROWS
from airlight.scene.ground_place import map_level
from airlight.scene.light_position import LightPosition
from airlight.scene.metering import METERED, white_luminance
from airlight.scene.projections.projected import projected_rays
from airlight.scene.system import System
from airlight.scene.system.body import Body
from airlight.scene.system.light import Light

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Default samples per side of a pixel that an edge may cross.
SAMPLES: Final = 4
#: Pixels in one block of rows.
_BLOCK_PIXELS: Final = 1 << 14
#: Rays traced together.
_LINES: Final = 1 << 15


def render_system(
    system: System,
    *,
    width: int = 1280,
    height: int = 720,
    wavelengths: Sequence[float] | None = None,
    quality: str = "default",
    samples: int | None = None,
    crop: tuple[int, int, int, int] | None = None,
    clouds: Mapping[str, CloudTime] | None = None,
    cache: bool = True,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Frame:
    """Render a scene of several bodies and lights.

    Parameters
    ----------
    system : System
        Bodies, lights, observer and camera, see ``load_system``.
    width, height : int
        Size of the frame. [pixel]
    wavelengths : sequence of float, optional
        Wavelengths, at least three; by default sixteen over the visible. [nm]
    quality : str
        Quality as for ``airlight.solve``.
    samples : int, optional
        Samples per side of a pixel on the edge of a body or star, 1 to 16; 4 by default.
    crop : (int, int, int, int), optional
        Window to render, as for ``Camera``. [pixel]
    clouds : mapping, optional
        Times of three-dimensional clouds by the names of planets, as in films.
    cache : bool
        Whether solutions are read from and stored on disk.

    Returns
    -------
    Frame
        Linear sRGB radiance. [W m⁻² sr⁻¹]
    """
    samples = SAMPLES if samples is None else samples
    if not isinstance(samples, int) or not 1 <= samples <= 16:
        raise ParameterError("samples", samples, "1 to 16")
    system.check_distances()
    if wavelengths is not None:
        nm = color_wavelengths(wavelengths)
    else:
        first = next(iter(system.planets.values()), None)
        found = np.linspace(400.0, 700.0, 16) if first is None else picture_wavelengths(first)
        nm = tuple(found.tolist())
    report: dict[str, Any] = {"cache": cache, "progress": progress, "cancel": cancel}
    solutions = solve_planets(system, nm, quality, **report)
    lights = SceneLights(system, np.array(nm), solutions)
    size = width, height, crop
    return render_solved_system(lights, size, samples, clouds, quality=quality, **report)


def render_solved_system(
    lights: SceneLights,
    size: tuple[int, int, tuple[int, int, int, int] | None],
    samples: int = SAMPLES,
    clouds: Mapping[str, CloudTime] | None = None,
    **options: Any,
) -> Frame:
    """Render a scene of several bodies whose planets are solved.

    Parameters
    ----------
    lights : SceneLights
        Lights of the scene, with the solutions of its planets.
    size : (int, int, tuple or None)
        Width, height and window of ``render_system``. [pixel]
    samples, clouds :
        See ``render_system``.
    **options
        ``quality``, ``cache``, ``progress`` and ``cancel`` of ``render_system``.
    """
    system, (width, height, crop) = lights.system, size
    unfiltered = None
    if system.view.polariser is not None:
        plain = replace(system, view=replaced(system.view, polariser=None))
        small = min(1.0, METERED / width)
        unfiltered = render_solved_system(
            replace(lights, system=plain),
            (max(1, round(width * small)), max(1, round(height * small)), None),
            clouds=clouds,
            **{**options, "progress": None},
        )
    camera = system.view.camera(width, height, crop)
    items = [
        atmosphere_layer(lights, camera, body, clouds=(clouds or {}).get(body.name), **options)
        if body.name in lights.solutions
        else body
        for body in sorted(system.bodies, key=system.power)
    ]
    frame = _BodyTracer(lights, camera, items, samples).render(
        options.get("progress"), options.get("cancel")
    )
    return replace(frame, unfiltered=unfiltered)


def system_frame(
    lights: SceneLights,
    camera: Camera,
    rgb: Float32Array,
    weights: FloatArray | None = None,
    **seen: Any,
) -> Frame:
    """Frame of a scene of several bodies.

    Parameters
    ----------
    rgb : array, shape (rows, columns, 3)
        Linear sRGB radiance. [W m⁻² sr⁻¹]
    weights : array, shape (nl, 3), optional
        Linear sRGB per radiance; by default ``picture_weights``.
    **seen
        Further arguments of ``Frame.seen_by``.
    """
    system = lights.system
    sources = tuple(lights.source(one, system.eye) for one in lights.stars)
    return Frame.seen_by(
        camera,
        rgb,
        lights.wavelengths,
        {"scene": system.name, "bodies": ", ".join(body.name for body in system.bodies)},
        white=white_luminance(
            (LightPosition(zenith=0.0, index=k) for k in range(len(sources))), sources, weights
        ),
        star_white=star_white(sources[0].spectrum),
        **seen,
    )


def metered_scene(lights: SceneLights, camera: Camera, names: Container[str]) -> Scene | None:
    """Scene with the visible stars alone, for metering; None if no star is visible.

    Parameters
    ----------
    names : container of str
        Names of the visible stars.
    """
    system = lights.system
    stars = [one.towards(system.eye) for one in lights.stars if one.name in names]
    if not stars:
        return None
    local = level_axes(np.array([0.0, 0.0, 1.0]), stars[0])
    zenith, azimuth, roll = camera_angles(system.camera_axes @ local.T)
    first, *others = (zenith_azimuth(local @ one) for one in stars)
    return Scene(
        camera=replace(camera, look_zenith=zenith, look_azimuth=azimuth, roll=roll),
        sun_zenith=first[0],
        secondary_lights=tuple(LightPosition(zenith=z, azimuth=a) for z, a in others),
    )


class _BodyTracer:
    """Lines of sight past bodies and layers of air, in the order in which they meet them."""

    def __init__(
        self,
        lights: SceneLights,
        camera: Camera,
        items: Sequence[AtmosphereLayer | Body],
        samples: int,
    ) -> None:
        self.lights, self.camera, self.items, self.samples = lights, camera, items, samples
        self.system, self.wavelengths = lights.system, lights.wavelengths
        self.past = SeenPast(self.system, items, self.wavelengths, camera.pixel_angle)
        self.eye, self.axes = self.system.eye, self.system.camera_axes
        #: Transmittance of the camera's filter for unpolarised light, of surfaces and stars. [1]
        self.received = 1.0 if camera.polariser is None else 0.5
        #: Stars whose discs are visible, by name.
        self._seen: dict[str, LightSource] = {}
        self._star = lights.source(lights.stars[0], self.eye)
        self.colors = self._star.colors()

    def render(self, progress: Progress | None, cancel: Cancel | None) -> Frame:
        height, width = self.camera.rows, self.camera.columns
        rgb = np.zeros((height, width, 3))
        step = max(1, _BLOCK_PIXELS // width)
        run_blocks(
            lambda k: self._draw(k * step, min((k + 1) * step, height), rgb),
            -(-height // step),
            cancel=cancel,
            progress=progress,
            message="rendering bodies",
        )
        if self.system.stars:
            add_sky(rgb, self.camera, self.axes, self.past, self._star)
        return system_frame(
            self.lights,
            self.camera,
            rgb.astype(np.float32),
            device=CPU,
            scene=metered_scene(self.lights, self.camera, self._seen),
            star_radius=max((one.angular_radius for one in self._seen.values()), default=0.0),
        )

    def _rays(self, first: int, last: int, across: float, down: float) -> FloatArray:
        """Unit vectors in the frame of the scene, shape (rows, width, 3). [1]"""
        camera = self.camera
        assert camera.field_of_view is not None
        x = np.arange(camera.columns, dtype=np.float64) + (camera.left + across)
        y = np.arange(first, last, dtype=np.float64) + (camera.top + down)
        rays = projected_rays(
            camera.projection, x, y, camera.width, camera.height, math.radians(camera.field_of_view)
        )
        return np.asarray(rays @ self.axes)

    def _draw(self, first: int, last: int, rgb: FloatArray) -> None:
        centre = self._rays(first, last, 0.5, 0.5)
        shape = centre.shape[:2]
        inside, edge = self._regions(centre.reshape(-1, 3))
        layers = [
            item.layer[first:last].reshape(-1, 3) if isinstance(item, AtmosphereLayer) else None
            for item in self.items
        ]
        out = np.zeros((shape[0] * shape[1], 3))
        plain = ~inside & ~edge
        for layer in layers:
            if layer is not None:
                # Pixels without a surface or star behind: layers of air add up.
                out[plain] += layer[plain]
        count = self.samples
        for chosen, n in ((np.flatnonzero(inside & ~edge), 1), (np.flatnonzero(edge), count)):
            for k in range(n * n):
                down, across = divmod(k, n)
                rays = self._rays(first, last, (across + 0.5) / n, (down + 0.5) / n)
                lines = rays.reshape(-1, 3)
                for at in range(0, chosen.size, _LINES):
                    some = chosen[at : at + _LINES]
                    found = self._traced(
                        lines[some], [None if layer is None else layer[some] for layer in layers]
                    )
                    out[some] += found / (n * n)
        rgb[first:last] = out.reshape(*shape, 3)

    def _regions(self, rays: FloatArray) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Masks of pixels with a surface, star or air behind air, and of pixels on an edge."""
        inside, edge = np.zeros(len(rays), bool), np.zeros(len(rays), bool)
        margin = 2.0 * self.camera.pixel_angle
        bend = max(
            (
                item.solution.geometry.max_refraction
                for item in self.items
                if isinstance(item, AtmosphereLayer)
            ),
            default=0.0,
        )
        shown = np.any(rays != 0.0, axis=-1)
        for k, item in enumerate(self.items):
            body = item.body if isinstance(item, AtmosphereLayer) else item
            offset = body.centre - self.eye
            distance = float(np.linalg.norm(offset))
            for radius in {self.system.radius(body), self.system.outer_radius(body)}:
                if radius >= distance:
                    continue
                angle = _angle_between(rays, offset / distance) - math.asin(radius / distance)
                if isinstance(item, Body):
                    raised = self.past.raised_limb(item)
                    inside |= shown & (angle < margin + bend + raised)
                    if raised == 0.0:  # relief knows how much of a pixel it covers
                        edge |= shown & (np.abs(angle) < margin + bend * (k > 0))
                elif k > 0:
                    inside |= shown & (angle < margin + bend)
        for light in self.lights.stars:
            source = self.lights.source(light, self.eye)
            angle = _angle_between(rays, light.towards(self.eye))
            edge |= shown & (angle < source.angular_radius + margin + bend)
            if light.corona:
                inside |= shown & (angle < OUTERMOST * source.angular_radius + margin + bend)
        return inside, edge

    def _traced(self, rays: FloatArray, layers: list[Float32Array | None]) -> FloatArray:
        """Radiance along rays, linear sRGB, shape (n, 3). [W m⁻² sr⁻¹]"""
        out, behind = np.zeros((2, len(rays), 3))
        through = np.ones((len(rays), self.wavelengths.size))
        white = self.colors.sum(axis=0)
        shown = np.any(rays != 0.0, axis=-1)
        through[~shown] = 0.0
        for item, layer in zip(self.items, layers, strict=True):
            if isinstance(item, AtmosphereLayer):
                assert layer is not None
                out += layer * ((through @ self.colors) / white)
                dimmed, rays = item.behind(rays)
                through *= dimmed
            else:
                self._hit(item, rays, through, behind)
        for light in self.lights.stars:
            self._disc(light, rays, through, behind)
        return np.asarray(out + self.received * behind)

    def _hit(self, body: Body, rays: FloatArray, through: FloatArray, out: FloatArray) -> None:
        """Add the reflected radiance of an airless body; rays end there."""
        met, length, cover, leaving = self.past.meets(body, rays)
        open_ = through[met].max(axis=1) > 0.0
        met, length, cover, leaving = met[open_], length[open_], cover[open_], leaving[open_]
        if met.size == 0:
            return
        radius = self.system.radius(body)
        normal = (self.eye + length[:, None] * rays[met] - body.centre) / radius
        normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
        points = body.centre + radius * normal
        texture, green, rows = self._texture(body, normal, length, leaving)
        density, axes = crater_density(body), self.system.axes(body).T
        width = self.camera.pixel_angle * length / radius
        albedo = body.albedos(self.wavelengths)
        for light in self.lights.on(body):
            source = self.lights.seen_from(light, body)
            towards = self.lights.towards(light, points)
            size = np.full(met.size, source.angular_radius)
            factor = body.surface_factor(normal, towards, -rays[met], size, leaving)
            if density > 0.0:
                own = (np.ascontiguousarray(one @ axes) for one in (normal, rays[met], towards))
                crater_lights(*own, leaving, width, green, density, radius, float(rows), factor)
            lit = np.flatnonzero(factor > 0.0)
            if lit.size == 0:
                continue
            light_here = through[met[lit]] * albedo * (cover * factor)[lit, None]
            if light.star is not None:
                light_here = light_here * self.lights.unshadowed(light, points[lit], body)
            out[met[lit]] += (light_here @ source.colors()) * texture[lit]
        through[met] *= 1.0 - cover[:, None]

    def _texture(
        self, body: Body, normal: FloatArray, length: FloatArray, leaving: FloatArray
    ) -> tuple[FloatArray, FloatArray, int]:
        """Reflectance of a body's map over its mean, shape (n, 3); its green, and its rows. [1]"""
        picture = body_map(self.system, body)
        if picture is None:
            return np.ones((len(normal), 3)), np.ones(len(normal)), NOMINAL_ROWS
        level = vectorized(map_level)(
            self.camera.pixel_angle, length, leaving, self.system.radius(body), picture.rows
        )
        colors = np.empty((len(normal), CHANNELS))
        places = np.ascontiguousarray(normal @ self.system.axes(body).T)
        size = picture.rows, picture.columns, len(picture.levels)
        map_colors(picture.flat, *size, places, level, colors)
        coarse = np.empty_like(colors)
        map_colors(picture.flat, *size, places, np.maximum(level, REGIONAL), coarse)
        mean = map_mean(picture, body, self.wavelengths)
        return np.asarray(colors[:, :3] / mean), coarse[:, 1].copy(), picture.rows

    def _disc(self, light: Light, rays: FloatArray, through: FloatArray, out: FloatArray) -> None:
        """Add the limb-darkened disc and the corona of a star."""
        source = self.lights.source(light, self.eye)
        alpha = source.angular_radius
        if alpha <= 0.0:
            return
        angle = _angle_between(rays, light.towards(self.eye))
        open_ = through.max(axis=1) > 0.0
        coefficients = source.darkenings
        if light.corona:
            around = np.flatnonzero((angle < OUTERMOST * alpha) & open_)
            radiance = corona(angle[around], alpha, coefficients)
            out[around] += (through[around] * radiance) @ source.colors()
        met = np.flatnonzero((angle < alpha) & open_)
        if met.size == 0:
            return
        self._seen[light.name] = source
        mu = np.sqrt(np.maximum(1.0 - (np.sin(angle[met]) / math.sin(alpha)) ** 2, 0.0))
        shape = (mu[:, None] ** np.arange(coefficients.shape[1])) @ coefficients.T
        radiance = shape / (math.pi * math.sin(alpha) ** 2)
        out[met] += (through[met] * radiance) @ source.colors()


def _angle_between(rays: FloatArray, towards: FloatArray) -> FloatArray:
    """Angles between unit vectors, accurate for small angles, shape (n,). [rad]"""
    return np.asarray(np.arctan2(np.linalg.norm(np.cross(rays, towards), axis=-1), rays @ towards))
