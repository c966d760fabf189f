"""``GpuSystemRenderer``: frames of scenes of several bodies on the GPU.

Layers are drawn from the farthest to the nearest; each covers what is behind it, or lets through
what its air transmits. Lines of sight, order and lights are those of ``render_system``. A body is
refracted by the nearest air before it alone, a star's disc by the farthest. Points of the star
catalogue and the Milky Way are the CPU's.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import Cancelled, ConflictError, ParameterError
from airlight.image.display_settings import DisplaySettings
from airlight.image.white_balance import White, star_white
from airlight.kernel.memory import check_drawn
from airlight.kernel.threads import Cancel, Progress
from airlight.planets.parameters import replace as replaced
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.device.flat import read_texture
from airlight.render.gpu.picture.bands import Window, area_of
from airlight.render.gpu.picture.display_passes import LINEAR, DisplayPasses, PictureLayer
from airlight.render.gpu.picture.gpu_renderer import SKY_VIEW_SIZE, GpuRenderer
from airlight.render.pixels.scenes_by_light import SceneForLight
from airlight.render.pixels.view_uniforms import checked_samples, display_uniforms
from airlight.render.planet_renderer import body_lights, occulting_moon, zenith_above
from airlight.render.render_system import SAMPLES, metered_scene, system_frame
from airlight.render.scene_lights import SceneLights
from airlight.render.seen_past import SeenPast
from airlight.render.star_points import add_sky
from airlight.render.system_layers import BackgroundLayers
from airlight.render.through_air import AirAround
from airlight.scene.directions import level_axes
from airlight.scene.frame import Frame
from airlight.scene.light_position import LightPosition
from airlight.scene.metering import METERED
from airlight.scene.projections.projected import projected_rays
from airlight.scene.system import System
from airlight.scene.system.body import Body
from airlight.scene.system.light import Light

if TYPE_CHECKING:
    from airlight.scene import Camera
    from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]

#: Pixels of a strip, whose layers take 320 MB.
_STRIP: Final = 1 << 22
#: Lines of sight that look for a star's disc.
_TRACED: Final = 1 << 14


def check_drawn_by_gpu(system: System) -> None:
    """Raise if only ``render_system`` draws a scene.

    Raises
    ------
    ConflictError
        In one line, with the body or light.
    """
    if not system.planets:
        raise _undrawn("scene", "has no planet with air")
    if any(light.corona for light in system.lights):
        raise _undrawn("scene", "has a corona")
    lights = SceneLights(system, np.array([550.0]), {})
    for number, body in enumerate(system.bodies):
        if body.planet is None:
            continue
        if system.planets[body.name].clouds:
            raise _undrawn(f"bodies[{number}]", "has three-dimensional clouds")
        for star in lights.stars:
            if occulting_moon(lights, star, body, lights.seen_from(star, body)) is not None:
                raise _undrawn(f"bodies[{number}]", "has air in a moon's shadow")


class GpuSystemRenderer:
    """Renderer of scenes of several bodies, for any observer and camera among them.

    Parameters
    ----------
    device : Device
        Device from ``open_device``.
    sky_view_size : (int, int)
        See ``GpuRenderer``.
    """

    def __init__(self, device: Device, sky_view_size: tuple[int, int] = SKY_VIEW_SIZE) -> None:
        self.device, self.sky_view_size = device, sky_view_size
        self._solutions: Mapping[str, MomentsSolution] = {}
        self._weights: FloatArray | None = None
        self._renderers: dict[str, GpuRenderer] = {}
        self._display = DisplayPasses(device)
        self._background = BackgroundLayers(device)
        self._lit: SceneLights | None = None
        self._sky: tuple[Hashable, Any] = (None, None)

    def set_solutions(
        self, solutions: Mapping[str, MomentsSolution], weights: FloatArray | None = None
    ) -> None:
        """Set the solutions of the planets.

        Parameters
        ----------
        solutions : mapping
            Solutions of the same wavelengths by the names of bodies, from ``solve_planets``.
        weights : array, shape (nl, 3), optional
            See ``GpuRenderer.set_solution``.
        """
        known = self._solutions
        same = solutions.keys() == known.keys() and weights is self._weights
        if same and all(solutions[name] is one for name, one in known.items()):
            return
        self._display.rendered, self._lit, self._sky = None, None, (None, None)
        before, given = self._solutions, self._weights
        self._solutions, self._weights = dict(solutions), weights
        for name in self._renderers.keys() - solutions.keys():
            del self._renderers[name]
        for name, solution in solutions.items():
            if name not in self._renderers:
                self._renderers[name] = GpuRenderer(self.device, self.sky_view_size)
            elif before.get(name) is solution and weights is given:
                continue
            self._renderers[name].set_solution(solution, weights)

    def render(
        self,
        system: System,
        *,
        width: int = 1280,
        height: int = 720,
        samples: int | None = None,
        crop: Window | None = None,
        orders: str = "all",
        progress: Progress | None = None,
        cancel: Cancel | None = None,
    ) -> Frame:
        """Render a frame of linear radiance.

        Parameters
        ----------
        system, width, height, samples, crop, progress, cancel :
            See ``render_system``.
        orders : str
            Orders of scattering by air, see ``GpuRenderer.render``.

        Raises
        ------
        ConflictError
            If the scene has what only ``render_system`` draws.
        """
        count = SAMPLES if samples is None else checked_samples(samples)
        lights, camera = self._lights(system), system.view.camera(width, height, crop)
        check_drawn(camera.columns, camera.rows)
        rgb = np.zeros((camera.rows, camera.columns, 3), np.float32)
        for window in _strips(camera):
            if cancel is not None and cancel():
                raise Cancelled
            rows = slice(window[1] - camera.top, window[1] - camera.top + window[3])
            rgb[rows] = self._strip(lights, camera, window, count, orders)
            if progress is not None:
                progress(rows.stop, camera.rows, "rendering")
        past = self._past(lights, camera)
        if system.stars:
            star = lights.source(lights.stars[0], system.eye)
            add_sky(rgb, camera, system.camera_axes, past, star, self._weights)
        seen = {
            star.name: lights.source(star, system.eye).angular_radius
            for star in lights.stars
            if _is_seen(lights, camera, past, star)
        }
        unfiltered = None
        if camera.polariser is not None:
            small = min(1.0, METERED / width)
            unfiltered = self.render(
                replace(system, view=replaced(system.view, polariser=None)),
                width=max(1, round(width * small)),
                height=max(1, round(height * small)),
            )
        return system_frame(
            lights,
            camera,
            rgb,
            self._weights,
            device=self.device.name,
            scene=metered_scene(lights, camera, seen),
            star_radius=max(seen.values(), default=0.0),
            unfiltered=unfiltered,
        )

    def display(
        self,
        system: System,
        view: Any,
        target_format: str,
        size: tuple[int, int],
        *,
        exposure: float,
        settings: DisplaySettings | None = None,
        scene_white: White | None = None,
        orders: str = "all",
        sky: bool = True,
    ) -> None:
        """Render and display into a texture.

        Parameters
        ----------
        system : System
            Bodies, lights, observer and camera.
        view, target_format, size, exposure, settings, scene_white, orders :
            See ``GpuRenderer.display``.
        sky : bool
            Whether the star catalogue is drawn, if the scene has it.
        """
        lights, camera = self._lights(system), system.view.camera(*size, None)
        layers = self._layers(lights, camera, (0, 0, *size), SAMPLES, orders)
        if system.stars and sky:
            layers.append(self._sky_layer(lights, camera))
        self._display.render(layers, size)
        white = star_white(lights.source(lights.stars[0], system.eye).spectrum)
        values = {
            **display_uniforms(exposure, settings or DisplaySettings(), white, scene_white),
            "circle": camera.circle is not None,
        }
        self._display.display(values, camera.glare_angle, view, target_format)

    def _lights(self, system: System) -> SceneLights:
        """Lights of a scene; raises an error for what the GPU cannot render."""
        before = self._lit
        if before is not None and _lit_alike(system, before.system):
            self._lit = replace(before, system=system)
            return self._lit
        check_drawn_by_gpu(system)
        system.check_distances()
        for name in system.planets:
            if name not in self._solutions:
                raise ParameterError("bodies", name, "bodies with a solution")
        nm = next(iter(self._solutions.values())).wavelengths
        self._lit = SceneLights(system, nm, self._solutions)
        return self._lit

    def _strip(
        self, lights: SceneLights, camera: Camera, window: Window, samples: int, orders: str
    ) -> NDArray[np.float32]:
        """Linear sRGB of a window of the frame."""
        import wgpu

        size = window[2:]
        use = wgpu.TextureUsage.RENDER_ATTACHMENT | wgpu.TextureUsage.COPY_SRC
        target = self.device.device.create_texture(size=(*size, 1), format=LINEAR, usage=use)
        layers = self._layers(lights, camera, window, samples, orders)
        self._display.add_layers(layers, target.create_view(), size, LINEAR)
        rgb = read_texture(self.device, target)[..., :3]
        target.destroy()
        return rgb

    def _layers(
        self, lights: SceneLights, camera: Camera, window: Window, samples: int, orders: str
    ) -> list[PictureLayer]:
        """Layers from the farthest to the nearest."""
        system = lights.system
        ordered = sorted(system.bodies, key=system.power)
        airy = [body for body in ordered if body.planet is not None]
        stars = {star.name: self._air_before(lights, star, airy) for star in lights.stars}
        layers = []
        for number, body in reversed(list(enumerate(ordered))):
            if body.planet is None:
                refracting = [
                    one
                    for one in airy
                    if ordered.index(one) < number
                    and self._solutions[one.name].geometry.shell is not None
                ]
                air = refracting[0] if refracting else airy[0]
                layer = self._background.body(
                    lights,
                    camera,
                    body,
                    air,
                    self._renderers[air.name],
                    window,
                    samples=samples,
                    behind=bool(refracting),
                    weights=self._weights,
                )
                layers += [] if layer is None else [layer]
                continue
            layers.append(self._layer(lights, camera, body, window, orders))
            for star in (one for one in lights.stars if stars[one.name] is body):
                layer = self._background.star(
                    lights,
                    camera,
                    star,
                    body,
                    self._renderers[body.name],
                    window,
                    samples=samples,
                    hidden_by=_bare_before(lights, star, ordered[number + 1 :]),
                )
                layers += [] if layer is None else [layer]
        return layers

    def _air_before(self, lights: SceneLights, star: Light, planets: Sequence[Body]) -> Body:
        """Farthest planet with air before a star; the farthest of all if there is none."""
        before = [body for body in planets if _overlaps(lights, star, body, self._solutions)]
        return before[-1] if before else planets[-1]

    def _layer(
        self, lights: SceneLights, camera: Camera, body: Body, window: Window, orders: str
    ) -> PictureLayer:
        scenes = [
            SceneForLight(one.scene, one.solution, True, LightPosition(zenith=one.scene.sun_zenith))
            for one in body_lights(lights, camera, body)
        ]
        size = camera.width, camera.height
        whole = window == (0, 0, *size)
        part = None if whole else window
        return self._renderers[body.name].layer(
            scenes, size, orders=orders, disc=False, window=part
        )

    def _past(self, lights: SceneLights, camera: Camera) -> SeenPast:
        system = lights.system
        items = [
            AirAround(
                solution=self._solutions[body.name],
                altitude=system.place_above(body)[2],
                axes=level_axes(zenith_above(system, body)),
                pole=system.axes(body)[2],
            )
            if body.planet is not None
            else body
            for body in sorted(system.bodies, key=system.power)
        ]
        return SeenPast(system, items, lights.wavelengths, camera.pixel_angle)

    def _sky_layer(self, lights: SceneLights, camera: Camera) -> PictureLayer:
        """Catalogue and Milky Way, which the CPU renders anew when the view changes."""
        system = lights.system
        key = (camera, system.eye.tobytes(), system.camera_axes.tobytes(), system.bodies)
        if self._sky[0] != key:
            rgb = np.zeros((camera.rows, camera.columns, 3), np.float32)
            star = lights.source(lights.stars[0], system.eye)
            past = self._past(lights, camera)
            add_sky(rgb, camera, system.camera_axes, past, star, self._weights)
            self._sky = key, self._background.uploaded(rgb)
        texture = self._sky[1]
        return PictureLayer(
            [partial(self._display.copy, texture)],
            self._background.clear,
            ("sky", key),
            covers=True,
        )


def _lit_alike(system: System, other: System) -> bool:
    """Whether two scenes differ in observer and camera alone."""
    names = ("bodies", "lights", "changes", "given")
    return all(getattr(system, name) == getattr(other, name) for name in names)


def _overlaps(
    lights: SceneLights, star: Light, body: Body, solutions: Mapping[str, MomentsSolution]
) -> bool:
    """Whether a body may stand before a star, as refracted by its own air."""
    system = lights.system
    offset, towards = body.centre - system.eye, star.towards(system.eye)
    distance = float(np.linalg.norm(offset))
    apart = math.atan2(float(np.linalg.norm(np.cross(offset, towards))), float(offset @ towards))
    radius = math.asin(min(system.outer_radius(body) / distance, 1.0))
    bend = solutions[body.name].geometry.max_refraction if body.name in solutions else 0.0
    return apart < radius + lights.source(star, system.eye).angular_radius + bend


def _bare_before(lights: SceneLights, star: Light, bodies: Sequence[Body]) -> Body | None:
    """Body without air that may stand before a star; None without one.

    Raises
    ------
    ConflictError
        If there are several.
    """
    found = [one for one in bodies if one.planet is None and _overlaps(lights, star, one, {})]
    if len(found) > 1:
        raise _undrawn(star.name, f"is behind both {found[0].name} and {found[1].name}")
    return found[0] if found else None


def _strips(camera: Camera) -> Iterator[Window]:
    """Windows of the frame that are rendered one after the other."""
    rows = min(max(1, _STRIP // camera.columns), camera.rows)
    for first in range(0, camera.rows, rows):
        yield camera.left, camera.top + first, camera.columns, min(rows, camera.rows - first)


def _is_seen(lights: SceneLights, camera: Camera, past: SeenPast, star: Light) -> bool:
    """Whether the disc of a star is visible in the centre of a pixel."""
    system, solutions = lights.system, lights.solutions
    towards, radius = star.towards(system.eye), lights.source(star, system.eye).angular_radius
    bend = max(one.geometry.max_refraction for one in solutions.values())
    window = (camera.left, camera.top, camera.columns, camera.rows)
    area = area_of(camera, system.camera_axes @ towards, radius + bend, window)
    if area is None or radius <= 0.0:
        return False
    first, above, width, height = area
    step = max(1, math.isqrt(width * height // _TRACED))
    x, y = (
        np.asarray(np.arange(start, start + size, step) + (edge + 0.5), np.float64)
        for start, size, edge in ((first, width, camera.left), (above, height, camera.top))
    )
    assert camera.field_of_view is not None
    field = math.radians(camera.field_of_view)
    rays = projected_rays(camera.projection, x, y, camera.width, camera.height, field)
    rays = rays.reshape(-1, 3)
    rays = rays[np.any(rays != 0.0, axis=-1)] @ system.camera_axes
    through, behind = past.behind(rays)
    near = behind @ towards > math.cos(radius)
    return bool((near & (through.max(axis=-1) > 0.0)).any())


def _undrawn(field: str, phrase: str) -> ConflictError:
    return ConflictError(field, f"{phrase}, which only the CPU draws")
