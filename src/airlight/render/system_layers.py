"""Layers of a scene without air: discs of stars, and bodies with their maps and shadows."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.render.bare_bodies import body_map, light_uniforms, place_uniforms
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.device.flat import flat_texture, packed_texture
from airlight.render.gpu.picture.bands import Window, area_of
from airlight.render.gpu.picture.display_passes import LINEAR, PictureLayer
from airlight.render.gpu.picture.gpu_renderer import GpuRenderer
from airlight.render.gpu.picture.shaders import Shader, body_shader, disc_shader, small_disc_shader
from airlight.render.gpu.picture.sky_views import DiscTables
from airlight.render.gpu.picture.uniforms import FRAME
from airlight.render.pixels.scenes_by_light import SceneForLight
from airlight.render.pixels.star_disc import SMALL
from airlight.render.planet_renderer import scene_of_light, zenith_above
from airlight.render.scene_lights import SceneLights
from airlight.scene.directions import level_axes
from airlight.scene.light_position import LightPosition
from airlight.scene.system.body import Body
from airlight.scene.system.light import Light

if TYPE_CHECKING:
    from airlight.scene import Camera

FloatArray = NDArray[np.float64]
Uniforms = dict[str, float]

#: Choices that are bound as constants in the shader of a body.
_CHOICES: Final = (
    "body_hides",
    "body_law",
    "body_samples",
    "body_behind",
    "body_mapped",
    "shaded",
    "projection",
    "outside",
)
#: Irradiance fraction of the strongest light below which a body is not lit. [1]
_FAINTEST: Final = 1e-12
#: Margin around a body or star. [pixel]
_MARGIN: Final = 3.0


class BackgroundLayers:
    """Layers of stars and of bodies without air.

    They are refracted by the air of a planet, whose renderer runs them.

    Parameters
    ----------
    device : Device
        Device from ``open_device``.
    """

    def __init__(self, device: Device) -> None:
        self.device = device
        self._maps: dict[str, Any] = {}

    def star(
        self,
        lights: SceneLights,
        camera: Camera,
        star: Light,
        air: Body,
        renderer: GpuRenderer,
        window: Window,
        *,
        samples: int,
        hidden_by: Body | None,
    ) -> PictureLayer | None:
        """PictureLayer of the disc of a star, attenuated by air; None if it is not in the window.

        Parameters
        ----------
        air, renderer : Body, GpuRenderer
            Planet with air before the star, and its renderer.
        window : (int, int, int, int)
            Part of the frame. [pixel]
        samples : int
            Samples per side of a pixel.
        hidden_by : Body, optional
            Body without air before it.
        """
        system, solution = lights.system, lights.solutions[air.name]
        source, towards = lights.source(star, system.eye), star.towards(system.eye)
        radius = source.angular_radius
        area = _area(camera, system.camera_axes @ towards, radius, solution, window)
        if area is None or radius <= 0.0:
            return None
        lit = solution.with_light(source, secondary=True)
        uniforms, local = self._frame(lights, camera, air, renderer, window, towards, lit)
        uniforms |= {"body_samples": samples, "body_hides": float(hidden_by is not None)}
        if hidden_by is not None:
            uniforms |= place_uniforms(system, hidden_by, local)
        law = DiscTables.of(lit)
        texture = flat_texture(self.device, law.texels, "disc")
        textures = {**renderer.textures.textures, "disc": texture}
        key = ("star", star.name)
        renderer.passes.read(textures, {**renderer.textures.places, **law.places}, key)
        small = radius < SMALL * camera.pixel_angle and hidden_by is None
        shader = (
            small_disc_shader(FRAME.fixed(uniforms)) if small else disc_shader(_fixed(uniforms))
        )
        contents = renderer.passes.packed(uniforms, key).tobytes(), law.texels.tobytes()
        part = _pass(renderer, shader, uniforms, area, key)
        return PictureLayer([part], self.clear, contents, covers=True)

    def body(
        self,
        lights: SceneLights,
        camera: Camera,
        body: Body,
        air: Body,
        renderer: GpuRenderer,
        window: Window,
        *,
        samples: int,
        behind: bool,
        weights: FloatArray | None,
    ) -> PictureLayer | None:
        """PictureLayer of a body without air; None if it is not in the window.

        Parameters
        ----------
        air, renderer, window :
            See ``star``.
        samples : int
            Samples per side of a pixel on the limb.
        behind : bool
            Whether the air is before the body.
        weights : array, shape (nl, 3), optional
            Linear sRGB per radiance.
        """
        system, solution = lights.system, lights.solutions[air.name]
        offset = body.centre - system.eye
        distance = float(np.linalg.norm(offset))
        angle = float(np.arcsin(min(system.radius(body) / distance, 1.0)))
        area = _area(camera, system.camera_axes @ offset / distance, angle, solution, window)
        if area is None:
            return None
        uniforms, local = self._frame(lights, camera, air, renderer, window)
        uniforms |= place_uniforms(system, body, local)
        uniforms |= {"body_samples": samples, "body_behind": float(behind)}
        textures = dict(renderer.textures.textures)
        if body.map is not None:
            textures["ground"] = self._map(lights, body)
        cover = (body.name, "")
        renderer.passes.read(textures, renderer.textures.places, cover)
        parts, keys, strongest = [], [], 0.0
        for light in lights.on(body):
            own, left = light_uniforms(lights, body, light, local, weights)
            brightness = abs(own["body_color_y"])
            strongest = max(strongest, brightness)
            if brightness <= _FAINTEST * strongest:
                continue
            if camera.polariser is not None:
                own |= {name: 0.5 * value for name, value in own.items() if "body_color" in name}
            seen, places, key = (
                {**uniforms, **own},
                dict(renderer.textures.places),
                _key(body, light),
            )
            if left is not None:
                laid, more = FRAME.laid_out({"shade_table": left})
                shade = flat_texture(self.device, laid["shade"], "shade")
                renderer.passes.read({**textures, "shade": shade}, {**places, **more}, key)
            else:
                renderer.passes.read(textures, places, key)
            shader = body_shader(False, _fixed(seen))
            parts.append(_pass(renderer, shader, seen, area, key))
            table = b"" if left is None else left.tobytes()
            keys.append((renderer.passes.packed(seen, key).tobytes(), table))
        covering = _pass(renderer, body_shader(True, _fixed(uniforms)), uniforms, area, cover)
        if not parts:
            parts.append(self.clear)
            keys.append((renderer.passes.packed(uniforms, cover).tobytes(), b""))
        return PictureLayer(parts, covering, (body.map, samples, tuple(keys)), covers=True)

    def uploaded(self, rgb: NDArray[np.float32]) -> Any:
        """Texture of linear sRGB, shape (rows, columns, 3). [W m⁻² sr⁻¹]"""
        import wgpu

        rows, columns = rgb.shape[:2]
        use = wgpu.TextureUsage.TEXTURE_BINDING | wgpu.TextureUsage.COPY_DST
        size = (columns, rows, 1)
        texture = self.device.device.create_texture(size=size, format=LINEAR, usage=use)
        texels = np.ones((rows, columns, 4), np.float32)
        texels[..., :3] = rgb
        layout = {"bytes_per_row": 16 * columns, "rows_per_image": rows}
        self.device.device.queue.write_texture({"texture": texture}, texels, layout, size)
        return texture

    def clear(self, view: Any, target_format: str) -> None:
        """Fill a target with zeros."""
        encoder = self.device.device.create_command_encoder()
        attachment = {
            "view": view,
            "load_op": "clear",
            "clear_value": (0.0, 0.0, 0.0, 0.0),
            "store_op": "store",
        }
        encoder.begin_render_pass(color_attachments=[attachment]).end()
        self.device.device.queue.submit([encoder.finish()])

    def _frame(
        self,
        lights: SceneLights,
        camera: Camera,
        air: Body,
        renderer: GpuRenderer,
        window: Window,
        towards: FloatArray | None = None,
        lit: Any = None,
    ) -> tuple[Uniforms, FloatArray]:
        """Uniforms of the frame above a planet, and axes of its frame as rows."""
        system = lights.system
        towards = lights.stars[0].towards(system.eye) if towards is None else towards
        local = level_axes(zenith_above(system, air), towards)
        scene = scene_of_light(lights, camera, air, towards, local)
        given = lights.solutions[air.name] if lit is None else lit
        one = SceneForLight(scene, given, True, LightPosition(zenith=scene.sun_zenith))
        uniforms = renderer.uniforms(one, (camera.width, camera.height), disc=True)
        more = {"detailed": 0.0, "edges": 0.0, "first_column": window[0], "first_row": window[1]}
        return {**uniforms, **more}, local

    def _map(self, lights: SceneLights, body: Body) -> Any:
        """Texture of the map of a body."""
        picture = body_map(lights.system, body)
        assert picture is not None
        if picture.name not in self._maps:
            self._maps[picture.name] = packed_texture(self.device, picture.flat, "map of a body")
        return self._maps[picture.name]


def _area(
    camera: Camera, towards: FloatArray, radius: float, solution: Any, window: Window
) -> Window | None:
    """Part of the window with the pixels near a body or star, refracted or not."""
    reach = radius + solution.geometry.max_refraction + _MARGIN * camera.pixel_angle
    return area_of(camera, towards, reach, window)


def _pass(
    renderer: GpuRenderer, shader: Shader, uniforms: Uniforms, area: Window, key: Hashable
) -> Callable[[Any, str], None]:
    """Function that renders a part of a target."""

    def draw(view: Any, target_format: str) -> None:
        renderer.passes.run(shader, uniforms, [view], (target_format,), area, light=key)

    return draw


def _fixed(uniforms: Uniforms) -> tuple[tuple[str, int | bool], ...]:
    """Choices of a body that are bound as constants."""
    return tuple(one for one in FRAME.fixed(uniforms) if one[0] in _CHOICES)


def _key(body: Body, light: Light) -> Hashable:
    return body.name, light.body or light.name
