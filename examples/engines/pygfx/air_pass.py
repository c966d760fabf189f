"""Aerial perspective of `airlight aerial` as an effect pass of pygfx."""

import json
from pathlib import Path
from typing import ClassVar

import numpy as np
import pygfx
import wgpu
from pygfx.renderers.wgpu import EffectPass
from pygfx.renderers.wgpu.engine.effectpasses import FullQuadPass

WGSL = """
@fragment
fn fs_main(varyings: Varyings) -> @location(0) vec4<f32> {
    let at = vec2i(varyings.position.xy);
    let size = vec2f(textureDimensions(colorTex));
    let depth = textureLoad(depthTex, at, 0);
    let place = varyings.position.xy / size;
    let point = u_effect.from_clip * vec4f(2.0 * place.x - 1.0, 1.0 - 2.0 * place.y, depth, 1.0);
    let away = point.xyz / point.w;
    let distance = length(away);
    let d = (u_effect.to_local * vec4f(away / distance, 0.0)).xyz;
    var light = sky_radiance(d.x, d.y, d.z, u_effect.pixel_angle / size.y).rgb;
    if (depth < 1.0) {
        light = textureLoad(colorTex, at, 0).rgb
            * air_transmittance(d.x, d.y, d.z, distance).rgb
            + air_radiance(d.x, d.y, d.z, distance).rgb;
    }
    return vec4f(1.0 - exp(-u_effect.exposure * light), 1.0);
}
"""


class AirPass(EffectPass):
    """Air before the surfaces of a picture, and the sky behind.

    Parameters
    ----------
    folder : str
        Folder of `airlight aerial`.
    camera : pygfx.PerspectiveCamera
        Camera; its position is that of the tables. A unit is a metre.
    star : array, shape (3,)
        Direction towards the star, in the scene. [1]
    up : array, shape (3,)
        Direction of the zenith. [1]
    exposure : float
        Factor of the light: a value x is shown as 1 - exp(-x).
    """

    USES_DEPTH = True
    uniform_type: ClassVar = dict(
        EffectPass.uniform_type,
        from_clip="4x4xf4",
        to_local="4x4xf4",
        pixel_angle="f4",
        exposure="f4",
    )

    def __init__(self, folder, camera, star, up=(0.0, 1.0, 0.0), exposure=1.0):
        super().__init__()
        self.about = json.loads((Path(folder) / "manifest.json").read_text())
        self.wgsl = (Path(folder) / "air.wgsl").read_text() + WGSL
        self.camera, self.star, self.up, self.exposure = camera, star, up, exposure
        self._textures = {
            name: _texture(self._device, Path(folder), one).create_view()
            for name, one in self.about["textures"].items()
        }

    def render(self, command_encoder, color_tex, depth_tex, target_tex):
        up = np.asarray(self.up, float) / np.linalg.norm(self.up)
        level = np.asarray(self.star, float) - np.dot(self.star, up) * up
        if np.linalg.norm(level) < 1e-6:
            level = np.cross(up, np.roll(up, 1))
        level /= np.linalg.norm(level)
        to_local = np.eye(4)
        to_local[:3, :3] = np.stack([level, np.cross(up, level), up])
        to_local[:3, :3] = to_local[:3, :3] @ self.camera.world.matrix[:3, :3]
        # matrices of a shader are given by columns
        self._uniform_data["from_clip"] = self.camera.projection_matrix_inverse.T
        self._uniform_data["to_local"] = to_local.T
        self._uniform_data["pixel_angle"] = 2.0 / self.camera.projection_matrix[1, 1]
        self._uniform_data["exposure"] = self.exposure
        FullQuadPass.render(
            self, command_encoder, colorTex=color_tex, depthTex=depth_tex, **self._textures,
            targetTex=target_tex,
        )  # fmt: skip


def _texture(device, folder, about):
    (file,) = about["files"]
    size = (about["width"], about["height"], 1)
    texture = device.create_texture(
        size=size,
        format=wgpu.TextureFormat.rgba16float,
        usage=wgpu.TextureUsage.TEXTURE_BINDING | wgpu.TextureUsage.COPY_DST,
    )
    device.queue.write_texture(
        {"texture": texture}, (folder / file).read_bytes(),
        {"bytes_per_row": 8 * about["width"]}, size,
    )  # fmt: skip
    return texture


def star_towards(zenith, azimuth):
    """Unit vector to a star; y up, azimuth from -z towards +x. [deg]"""
    zenith, azimuth = np.radians([zenith, azimuth])
    level = np.sin(zenith)
    return np.array([level * np.sin(azimuth), np.cos(zenith), -level * np.cos(azimuth)])


def picture(scene, camera, passes, width, height):
    """Draw a scene offscreen, shape (height, width, 4). [1/255]"""
    from rendercanvas.offscreen import RenderCanvas

    canvas = RenderCanvas(size=(width, height), pixel_ratio=1)
    renderer = pygfx.renderers.WgpuRenderer(canvas, pixel_scale=1, ppaa="none")
    renderer.effect_passes = passes
    canvas.request_draw(lambda: renderer.render(scene, camera))
    return np.asarray(canvas.draw())
