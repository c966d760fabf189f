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
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.physics.units import values_in
from airlight.planets.light_source import LightSource
from airlight.planets.picture_wavelengths import picture_wavelengths
from airlight.render.corona import OUTERMOST, corona
from airlight.render.cpu_renderer import CpuRenderer
from airlight.render.local_frame import camera_angles, level_axes, metered_scene
from airlight.render.planet_renderer import planet_renderer
from airlight.render.scene_lights import SceneLights
from airlight.render.solve_planet import solve_planet
from airlight.render.star_points import add_points, raised_points
from airlight.render.through_air import through_air
from airlight.scene import Camera, Scene
from airlight.scene.frame import Frame
from airlight.scene.local_ground import local_ground
from airlight.scene.pixel_position import pixel_positions
from airlight.scene.projections.projected import projected_rays
from airlight.scene.surface_map import surface_map
from airlight.scene.system import System
from airlight.scene.system.body import Body
from airlight.scene.system.light import Light
from airlight.scene.system.stars import stars
from airlight.scene.system.surface_light import surface_factor

if TYPE_CHECKING:
    from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Default samples per side of a pixel that an edge may cross.
_SAMPLES: Final = 4
#: Iterations for the apparent direction of a star behind refracting air.
_BENDS: Final = 4
#: Pixels in one block of rows.
_BLOCK_PIXELS: Final = 1 << 14
#: Rays traced together.
_LINES: Final = 1 << 15
#: Fraction of the strongest irradiance below which a light is ignored. [1]
_FAINTEST: Final = 1e-12


def render_system(
    system: System,
    *,
    width: int = 1280,
    height: int = 720,
    wavelengths: Sequence[float] | None = None,
    quality: str = "default",
    samples: int | None = None,
    crop: tuple[int, int, int, int] | None = None,
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
    cache : bool
        Whether solutions are read from and stored on disk.

    Returns
    -------
    Frame
        Linear sRGB radiance. [W m⁻² sr⁻¹]
    """
    samples = _SAMPLES if samples is None else samples
    if not isinstance(samples, int) or not 1 <= samples <= 16:
        raise ParameterError("samples", samples, "1 to 16")
    if wavelengths is not None and len(wavelengths) < 3:
        raise ParameterError("wavelengths", list(wavelengths), "3 or more, or none given")
    system.check_distances()
    renderer = _SystemRenderer(system, width, height, wavelengths, quality, samples, crop=crop,
                       cache=cache, progress=progress, cancel=cancel)  # fmt: skip
    return renderer.render(progress, cancel)


@dataclass(frozen=True, eq=False)
class _AtmosphereLayer:
    """Rendered atmosphere and ground of a planet, and its solution."""

    body: Body
    solution: MomentsSolution
    altitude: float
    axes: FloatArray
    layer: Float32Array

    def raised(self, true: FloatArray) -> FloatArray:
        """Apparent directions of points at infinity within the atmosphere, shape (n, 3). [1]"""
        local = raised_points(self.solution, self.altitude, true @ self.axes.T)
        return np.asarray(local @ self.axes)


class _SystemRenderer:
    def __init__(
        self,
        system: System,
        width: int,
        height: int,
        wavelengths: Sequence[float] | None,
        quality: str,
        samples: int,
        *,
        crop: tuple[int, int, int, int] | None,
        cache: bool,
        progress: Progress | None,
        cancel: Cancel | None,
    ) -> None:
        self.system, self.samples, self.cache = system, samples, cache
        view = system.view
        self.camera = Camera(
            projection=view.projection, width=width, height=height,
            field_of_view=view.field_of_view, polariser=view.polariser, crop=crop,
        )  # fmt: skip
        #: Transmittance of the camera's filter for unpolarised light, of surfaces and stars. [1]
        self.received = 1.0 if view.polariser is None else 0.5
        self.eye, self.axes = system.eye, system.camera_axes
        if wavelengths is None:
            first = next(iter(system.planets.values()), None)
            wavelengths = (
                tuple(np.linspace(400.0, 700.0, 16)) if first is None
                else tuple(picture_wavelengths(first).tolist())
            )  # fmt: skip
        self.wavelengths = values_in(wavelengths, "nm", "wavelengths")
        solutions = {}
        for body in system.bodies:
            if body.planet is not None:
                solutions[body.name] = self._solved(body, quality, cache, progress, cancel)
        self.lights = SceneLights(system, self.wavelengths, solutions)
        #: Stars whose discs are visible, by name.
        self._seen: dict[str, LightSource] = {}
        self.colors = self.lights.source(self.lights.stars[0], self.eye).colors()
        bodies = sorted(system.bodies, key=self._power)
        self.items: list[_AtmosphereLayer | Body] = [
            self._air(body, solutions[body.name], progress, cancel)
            if body.name in solutions else body
            for body in bodies
        ]  # fmt: skip

    def _power(self, body: Body) -> float:
        distance = float(np.linalg.norm(body.centre - self.eye))
        outer = self.system.outer_radius(body)
        return (distance - outer) * (distance + outer)

    # --- planets with air ---------------------------------------------------------------------

    def _place(self, body: Body) -> tuple[float, float, float]:
        """Latitude, longitude and altitude of the observer above a body. [deg], [m]"""
        offset = self.eye - body.centre
        distance = float(np.linalg.norm(offset))
        x, y, z = self.system.axes(body) @ (offset / distance)
        altitude = max(distance - self.system.radius(body), 0.0)
        if self.system.observer.body == body.name:
            altitude = self.system.observer.altitude
        return math.degrees(math.asin(min(max(z, -1.0), 1.0))), math.degrees(math.atan2(y, x)), (
            altitude
        )  # fmt: skip

    def _solved(
        self, body: Body, quality: str, cache: bool, progress: Progress | None,
        cancel: Cancel | None,
    ) -> MomentsSolution:  # fmt: skip
        latitude, longitude, altitude = self._place(body)
        planet = local_ground(self.system.planets[body.name], latitude=latitude,
                              longitude=longitude, altitude=altitude)  # fmt: skip
        return solve_planet(planet, self.wavelengths.tolist(), quality, cache=cache,
                            progress=progress, cancel=cancel)  # fmt: skip

    def _air(
        self, body: Body, solution: MomentsSolution, progress: Progress | None,
        cancel: Cancel | None,
    ) -> _AtmosphereLayer:  # fmt: skip
        latitude, longitude, altitude = self._place(body)
        up = (self.eye - body.centre) / np.linalg.norm(self.eye - body.centre)
        layer = np.zeros((self.camera.rows, self.camera.columns, 3), np.float32)
        brightest = 0.0
        for number, light in enumerate(self.lights.on(body)):
            source = self.lights.seen_from(light, body)
            brightest = max(brightest, float(source.irradiance.max()))
            if source.irradiance.max() <= _FAINTEST * brightest:
                continue
            lit = solution.with_light(source, secondary=number > 0)
            local = level_axes(up, self.lights.towards(light, body.centre[None])[0])
            scene = self._scene(body, light, up, local, latitude, longitude, altitude)
            renderer = planet_renderer(
                self.lights, light, body, lit, scene, local, cache=self.cache, progress=progress,
                cancel=cancel,
            )  # fmt: skip
            layer += self._rendered_by(renderer, progress, cancel)
        return _AtmosphereLayer(body, solution, altitude, level_axes(up), layer)

    def _scene(
        self, body: Body, light: Light, up: FloatArray, local: FloatArray, latitude: float,
        longitude: float, altitude: float,
    ) -> Scene:  # fmt: skip
        """Single-planet scene of one light, in the local frame of that light."""
        towards = self.lights.towards(light, body.centre[None])[0]
        north = self.system.axes(body)[2]
        east = np.cross(north, up)
        flat = np.linalg.norm(east)
        bearing = 0.0
        if flat > 1e-12:
            east = east / flat
            bearing = math.degrees(math.atan2(local[0] @ east, local[0] @ np.cross(up, east)))
        zenith, azimuth, roll = camera_angles(self.axes @ local.T)
        return Scene(
            camera=replace(self.camera, look_zenith=zenith, look_azimuth=azimuth, roll=roll),
            altitude=altitude,
            sun_zenith=math.degrees(math.atan2(abs(towards @ local[0]), towards @ up)),
            latitude=latitude,
            longitude=longitude,
            sun_azimuth=bearing,
            ground="detailed",
        )

    def _rendered_by(
        self, renderer: CpuRenderer, progress: Progress | None, cancel: Cancel | None
    ) -> Float32Array:
        height, width = self.camera.rows, self.camera.columns
        rgb = np.zeros((height, width, 3), np.float32)
        renderer.fill_sky_view(cancel=cancel, progress=progress)
        step = max(1, _BLOCK_PIXELS // width)
        run_blocks(
            lambda k: renderer.render_rows(k * step, min((k + 1) * step, height), rgb),
            -(-height // step), cancel=cancel, progress=progress, message="rendering air",
        )  # fmt: skip
        return rgb

    # --- lines of sight -----------------------------------------------------------------------

    def render(self, progress: Progress | None, cancel: Cancel | None) -> Frame:
        height, width = self.camera.rows, self.camera.columns
        rgb = np.zeros((height, width, 3))
        step = max(1, _BLOCK_PIXELS // width)
        run_blocks(
            lambda k: self._draw(k * step, min((k + 1) * step, height), rgb),
            -(-height // step), cancel=cancel, progress=progress, message="rendering bodies",
        )  # fmt: skip
        if self.system.stars:
            self._add_stars(rgb)
        names = ", ".join(body.name for body in self.system.bodies)
        nm = ", ".join(f"{w:g}" for w in self.wavelengths)
        return Frame(
            rgb=rgb.astype(np.float32),
            metadata={
                "scene": self.system.name,
                "bodies": names,
                "wavelengths": f"{nm} nm",
                "unit": "W m-2 sr-1, linear sRGB weighted by CIE 1931",
                "device": "CPU",
            },
            pixel_angle=self.camera.glare_angle,
            circle=self.camera.circle,
            scene=self._metered(),
            star_radius=max((one.angular_radius for one in self._seen.values()), default=0.0),
            origin=(self.camera.left, self.camera.top),
        )

    def _metered(self) -> Scene | None:
        """Scene with the visible stars alone, for metering; None if no star is visible."""
        seen = [one.towards(self.eye) for one in self.lights.stars if one.name in self._seen]
        return metered_scene(self.camera, self.axes, seen) if seen else None

    def _rays(self, first: int, last: int, across: float, down: float) -> FloatArray:
        """Unit vectors in the frame of the scene, shape (rows, width, 3). [1]"""
        camera = self.camera
        assert camera.field_of_view is not None
        x = np.arange(camera.columns, dtype=np.float64) + (camera.left + across)
        y = np.arange(first, last, dtype=np.float64) + (camera.top + down)
        rays = projected_rays(
            camera.projection, x, y, camera.width, camera.height,
            math.radians(camera.field_of_view),
        )  # fmt: skip
        return np.asarray(rays @ self.axes)

    def _draw(self, first: int, last: int, rgb: FloatArray) -> None:
        centre = self._rays(first, last, 0.5, 0.5)
        shape = centre.shape[:2]
        inside, edge = self._regions(centre.reshape(-1, 3))
        layers = [
            item.layer[first:last].reshape(-1, 3) if isinstance(item, _AtmosphereLayer) else None
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
                    found = self._traced(lines[some], [
                        None if layer is None else layer[some] for layer in layers
                    ])  # fmt: skip
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
                if isinstance(item, _AtmosphereLayer)
            ),
            default=0.0,
        )
        shown = np.any(rays != 0.0, axis=-1)
        for k, item in enumerate(self.items):
            body = item.body if isinstance(item, _AtmosphereLayer) else item
            offset = body.centre - self.eye
            distance = float(np.linalg.norm(offset))
            for radius in {self.system.radius(body), self.system.outer_radius(body)}:
                if radius >= distance:
                    continue
                angle = _angle_between(rays, offset / distance) - math.asin(radius / distance)
                if isinstance(item, Body):
                    inside |= shown & (angle < margin + bend)
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
            if isinstance(item, _AtmosphereLayer):
                assert layer is not None
                out += layer * ((through @ self.colors) / white)
                dimmed, local = through_air(item.solution, item.altitude, rays @ item.axes.T)
                through *= dimmed
                rays = local @ item.axes
            else:
                self._hit(item, rays, through, behind)
        for light in self.lights.stars:
            self._star(light, rays, through, behind)
        return np.asarray(out + self.received * behind)

    def _add_stars(self, rgb: FloatArray) -> None:
        """Add the star catalogue: points, attenuated and refracted by air or occulted."""
        catalogue = stars()
        x, _, _ = pixel_positions(self.camera, catalogue.directions @ self.axes.T)
        shown = np.flatnonzero(np.isfinite(x))
        if shown.size == 0:
            return
        true = catalogue.directions[shown]
        rays, through = self._apparent(true)
        x, y, solid = pixel_positions(self.camera, rays @ self.axes.T)
        source = self.lights.source(self.lights.stars[0], self.eye)
        weights = source.colors() / source.irradiance[:, None]
        light = (through * catalogue.irradiances(self.wavelengths)[shown]) @ weights
        light *= self.received
        seen = np.isfinite(x) & (through.max(axis=1) > 0.0)
        place = x[seen] - self.camera.left, y[seen] - self.camera.top
        add_points(rgb, *place, light[seen] / solid[seen, None])

    def _apparent(self, true: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Apparent directions of points at infinity, and the transmittance towards them.

        Fixed-point iteration on the error of the refracted direction, from the direction that the
        refraction table of the observer's planet gives.
        """
        rays = true
        for item in self.items:
            if (
                isinstance(item, _AtmosphereLayer)
                and item.altitude < item.solution.medium.thickness
            ):
                rays = item.raised(true)
        for _ in range(_BENDS):
            through, behind = self._behind(rays)
            open_ = through.max(axis=1) > 0.0
            moved = np.where(open_[:, None], rays + true - behind, rays)
            rays = moved / np.linalg.norm(moved, axis=-1, keepdims=True)
        return rays, self._behind(rays)[0]

    def _behind(self, rays: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Transmittance of rays past all bodies, and their refracted directions."""
        through = np.ones((len(rays), self.wavelengths.size))
        for item in self.items:
            if isinstance(item, _AtmosphereLayer):
                dimmed, local = through_air(item.solution, item.altitude, rays @ item.axes.T)
                through *= dimmed
                rays = local @ item.axes
            else:
                through[self._meets(item, rays)[0]] = 0.0
        return through, rays

    def _meets(self, body: Body, rays: FloatArray) -> tuple[NDArray[np.intp], FloatArray]:
        """Indices of rays that hit an airless body, and distances. [m]"""
        offset = body.centre - self.eye
        radius = self.system.radius(body)
        along = rays @ offset
        # R² - d² sin² by the cross product, which avoids cancellation at large distances.
        miss = np.linalg.norm(np.cross(rays, offset), axis=-1)
        met = np.flatnonzero((along > 0.0) & (miss < radius))
        length = along[met] - np.sqrt((radius - miss[met]) * (radius + miss[met]))
        return met, np.maximum(length, 0.0)

    def _hit(self, body: Body, rays: FloatArray, through: FloatArray, out: FloatArray) -> None:
        """Add the reflected radiance of an airless body; rays end there."""
        met, length = self._meets(body, rays)
        open_ = through[met].max(axis=1) > 0.0
        met, length = met[open_], length[open_]
        if met.size == 0:
            return
        radius = self.system.radius(body)
        normal = (self.eye + length[:, None] * rays[met] - body.centre) / radius
        normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
        points = body.centre + radius * normal
        texture = self._texture(body, normal, length)
        albedo = body.albedos(self.wavelengths)
        for light in self.lights.on(body):
            source = self.lights.seen_from(light, body)
            towards = self.lights.towards(light, points)
            size = np.full(met.size, source.angular_radius)
            factor = surface_factor(body, normal, towards, -rays[met], size)
            lit = np.flatnonzero(factor > 0.0)
            if lit.size == 0:
                continue
            light_here = through[met[lit]] * albedo * factor[lit, None]
            if light.star is not None:
                light_here = light_here * self.lights.unshadowed(light, points[lit], body)
            out[met[lit]] += (light_here @ source.colors()) * texture[lit]
        through[met] = 0.0

    def _texture(self, body: Body, normal: FloatArray, length: FloatArray) -> FloatArray:
        """Colour of a body's map over its mean luminance, shape (n, 3). [1]"""
        if body.map is None:
            return np.ones((len(normal), 3))
        folder = self.system.folder
        own_file = None if folder is None else folder / body.map
        path = str(own_file) if own_file is not None and own_file.is_file() else body.map
        picture = surface_map(path)
        x, y, z = (normal @ self.system.axes(body).T).T
        footprint = length * self.camera.pixel_angle / self.system.radius(body)
        colors = picture.sample(
            np.degrees(np.arcsin(np.clip(z, -1.0, 1.0))), np.degrees(np.arctan2(y, x)),
            picture.level(footprint),
        )[..., :3]  # fmt: skip
        mean = float(picture.mean_rgb @ np.array([0.2126, 0.7152, 0.0722]))
        return np.asarray(colors / max(mean, 1e-6), dtype=np.float64)

    def _star(self, light: Light, rays: FloatArray, through: FloatArray, out: FloatArray) -> None:
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
