"""``GpuSystemRenderer``: frames of several planets with air on the GPU.

Planets are layers, drawn from the farthest to the nearest: the light of each is added to what its
air transmits of those behind, then the frame is displayed. Lines of sight, order and lights are
those of ``render_system``.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ConflictError, ParameterError
from airlight.image.display_settings import DisplaySettings
from airlight.image.white_balance import White, star_white
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.device.flat import read_texture
from airlight.render.gpu.picture.display_passes import LINEAR, DisplayPasses, PlanetLayer
from airlight.render.gpu.picture.gpu_renderer import SKY_VIEW_SIZE, GpuRenderer
from airlight.render.pixels.scenes_by_light import SceneForLight
from airlight.render.pixels.view_uniforms import display_uniforms
from airlight.render.planet_renderer import body_lights
from airlight.render.render_system import system_frame
from airlight.render.scene_lights import SceneLights
from airlight.scene import Camera
from airlight.scene.frame import Frame
from airlight.scene.light_position import LightPosition
from airlight.scene.pixel_position import pixel_positions
from airlight.scene.system import System
from airlight.scene.system.body import Body
from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]


class GpuSystemRenderer:
    """Renderer of planets with air, for any observer and camera among them.

    Parameters
    ----------
    device : Device
        Device from ``open_device``.
    sky_view_size : (int, int)
        See ``GpuRenderer``.
    """

    def __init__(self, device: Device, sky_view_size: tuple[int, int] = SKY_VIEW_SIZE) -> None:
        self.device, self._sky_view_size = device, sky_view_size
        self._solutions: Mapping[str, MomentsSolution] = {}
        self._weights: FloatArray | None = None
        self._renderers: dict[str, GpuRenderer] = {}
        self._display = DisplayPasses(device)

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
        self._display.rendered = None
        self._solutions, self._weights = dict(solutions), weights
        for name in self._renderers.keys() - solutions.keys():
            del self._renderers[name]
        for name, solution in solutions.items():
            if name not in self._renderers:
                like = next(iter(self._renderers.values()), None)
                self._renderers[name] = GpuRenderer(self.device, self._sky_view_size, like=like)
            self._renderers[name].set_solution(solution, weights)

    def render(self, system: System, *, width: int = 1280, height: int = 720) -> Frame:
        """Render a frame of linear radiance.

        Parameters
        ----------
        system : System
            Bodies, lights, observer and camera.
        width, height : int
            Size of the frame. [pixel]

        Raises
        ------
        ConflictError
            If the scene has what only ``render_system`` draws.
        """
        import wgpu

        lights, camera = self._lights(system), system.view.camera(width, height, None)
        for number, light in enumerate(system.lights):
            if light.star is not None:
                towards = system.camera_axes @ light.towards(system.eye)
                if np.isfinite(pixel_positions(camera, towards[None])[0][0]):
                    raise _undrawn(f"lights[{number}]", "is in the picture")
        use = wgpu.TextureUsage.RENDER_ATTACHMENT | wgpu.TextureUsage.COPY_SRC
        target = self.device.device.create_texture(
            size=(width, height, 1), format=LINEAR, usage=use
        )
        layers = self._layers(lights, camera)
        self._display.add_layers(layers, target.create_view(), (width, height), LINEAR)
        rgb = read_texture(self.device, target)[..., :3]
        target.destroy()
        return system_frame(lights, camera, rgb, self._weights, device=self.device.name)

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
    ) -> None:
        """Render and display into a texture, without the discs of stars.

        Parameters
        ----------
        system : System
            Bodies, lights, observer and camera.
        view, target_format, size, exposure, settings, scene_white :
            See ``GpuRenderer.display``.
        """
        lights, camera = self._lights(system), system.view.camera(*size, None)
        self._display.render(self._layers(lights, camera), size)
        white = star_white(lights.source(lights.stars[0], system.eye).spectrum)
        values = {
            **display_uniforms(exposure, settings or DisplaySettings(), white, scene_white),
            "circle": camera.circle is not None,
        }
        self._display.display(values, camera.glare_angle, view, target_format)

    def _lights(self, system: System) -> SceneLights:
        """Lights of a scene, which has nothing that the GPU does not draw."""
        for number, body in enumerate(system.bodies):
            if body.planet is None:
                raise _undrawn(f"bodies[{number}]", "has no air")
            if system.planets[body.name].clouds:
                raise _undrawn(f"bodies[{number}]", "has three-dimensional clouds")
            if body.name not in self._solutions:
                raise ParameterError("bodies", body.name, "bodies with a solution")
        if system.stars or any(light.corona for light in system.lights):
            raise _undrawn("scene", "has stars or a corona")
        if system.view.polariser is not None:
            raise _undrawn("camera", "has a polariser")
        nm = next(iter(self._solutions.values())).wavelengths
        return SceneLights(system, nm, self._solutions)

    def _layers(self, lights: SceneLights, camera: Camera) -> list[PlanetLayer]:
        """Layers from the farthest to the nearest."""
        system = lights.system
        return [
            self._layer(lights, camera, body)
            for body in sorted(system.bodies, key=system.power, reverse=True)
        ]

    def _layer(self, lights: SceneLights, camera: Camera, body: Body) -> PlanetLayer:
        scenes = [
            SceneForLight(one.scene, one.solution, True, LightPosition(zenith=one.scene.sun_zenith))
            for one in body_lights(lights, camera, body)
        ]
        size = camera.width, camera.height
        return self._renderers[body.name].layer(scenes, size, disc=False)


def _undrawn(field: str, phrase: str) -> ConflictError:
    return ConflictError(field, f"{phrase}: the GPU draws planets with air alone")
