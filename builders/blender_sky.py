"""Light a small scene in Blender by a map of ``airlight sky``, check it, and draw a picture.

In an environment with ``bpy`` (PyPI, 374 MB; Python 3.11), which is no dependency of airlight:

    airlight sky earth --for blender --sun-zenith 60 --sun-azimuth 230 --size 2048 -o sky.exr
    python builders/blender_sky.py sky.exr docs/images/blender-sky.jpg

A layer of ``airlight sky --for usd`` (``sky.usda``) is read by Blender's importer instead, and not
drawn if no picture is named.

It checks the radiance of a grey plate against the irradiance that the JSON beside the map says, and
that the shadow of a pole falls where the JSON's direction of the sun throws it; and prints both.
"""

from __future__ import annotations

import argparse
import json
import math
import tempfile
from pathlib import Path

import bpy
import numpy as np

ALBEDO, POLE, RADIUS = 0.4, 2.0, 0.03
#: Largest error of the plate's radiance, and of the shadow's direction [deg].
PLATE_BAR, SHADOW_BAR = 0.02, 0.5


def material(name: str, colour: tuple[float, float, float], **inputs: float) -> bpy.types.Material:
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*colour, 1.0)
    shader.inputs["Specular IOR Level"].default_value = 0.0
    for key, value in inputs.items():
        shader.inputs[key.replace("_", " ").title()].default_value = value
    return made


def give(made: bpy.types.Material) -> None:
    bpy.context.object.data.materials.append(made)


def scene_with(map_: Path, sidecar: dict) -> bpy.types.Scene:
    bpy.ops.wm.read_factory_settings()
    for one in list(bpy.data.objects):
        bpy.data.objects.remove(one)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device, scene.cycles.seed = "CPU", 1
    scene.cycles.sample_clamp_indirect = scene.cycles.sample_clamp_direct = 0.0
    world = scene.world
    if map_.suffix == ".usda":
        bpy.ops.wm.usd_import(filepath=str(map_))
    else:
        world.use_nodes = True
        tree = world.node_tree
        texture = tree.nodes.new("ShaderNodeTexEnvironment")
        texture.image = bpy.data.images.load(str(map_))
        tree.links.new(texture.outputs["Color"], tree.nodes["Background"].inputs["Color"])
        tree.nodes["Background"].inputs["Strength"].default_value = 1.0 / sidecar["scale"]
    world.cycles.sampling_method, world.cycles.sample_map_resolution = "MANUAL", 4096
    bpy.ops.mesh.primitive_plane_add(size=20e3)
    give(material("grey", (ALBEDO,) * 3, roughness=1.0))
    bpy.ops.mesh.primitive_cylinder_add(
        radius=RADIUS, depth=POLE, location=(0.0, 0.0, 0.5 * POLE), vertices=32
    )
    give(material("pole", (0.7, 0.1, 0.05), roughness=0.6))
    return scene


def drawn(scene: bpy.types.Scene, camera: bpy.types.Object, size: tuple[int, int], samples: int):
    """Linear light of what the camera sees, shape (height, width, 3), the lowest row first."""
    scene.camera = camera
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.cycles.samples = samples
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth = "OPEN_EXR", "32"
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = str(Path(folder) / "light.exr")
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(scene.render.filepath)
        pixels = np.array(image.pixels[:], np.float64).reshape(size[1], size[0], 4)[..., :3]
        bpy.data.images.remove(image)
    return pixels


def looking_down(width: float, x: float, y: float) -> bpy.types.Object:
    data = bpy.data.cameras.new("above")
    data.type, data.ortho_scale = "ORTHO", width
    camera = bpy.data.objects.new("above", data)
    camera.location = (x, y, 50.0)
    bpy.context.collection.objects.link(camera)
    return camera


def checked(scene: bpy.types.Scene, sidecar: dict) -> None:
    scene.cycles.use_denoising = False
    plate = drawn(scene, looking_down(1.0, 60.0, -60.0), (16, 16), 2048).mean(axis=(0, 1))
    wanted = ALBEDO / math.pi * np.array(sidecar["horizontal_irradiance_of_map_W_m2"])
    error = plate / wanted - 1.0
    print("plate", plate.round(3), "by the JSON", wanted.round(3), "error", error.round(4))
    assert np.abs(error).max() < PLATE_BAR, error
    direction = np.array(sidecar["lights"][0]["direction"])
    east, north, up = (direction @ sidecar["frame"][axis] for axis in ("east", "north", "up"))
    width, side = 10.0, 200
    light = drawn(scene, looking_down(width, 0.0, 0.0), (side, side), 64).mean(axis=-1)
    at = (np.arange(side) + 0.5) / side * width - 0.5 * width
    x, y = np.meshgrid(at, at)  # x east, y north
    dark = (light < 0.5 * np.median(light)) & (np.hypot(x, y) > 0.3)
    towards = math.degrees(math.atan2(x[dark].mean(), y[dark].mean())) % 360.0
    thrown = math.degrees(math.atan2(-east, -north)) % 360.0
    length, wanted_length = np.hypot(x, y)[dark].max(), POLE * math.hypot(east, north) / up
    print(f"shadow to bearing {towards:.2f}°, by the JSON {thrown:.2f}°; {length:.2f} m long, "
          f"by the JSON {wanted_length:.2f} m")  # fmt: skip
    assert abs(math.remainder(towards - thrown, 360.0)) < SHADOW_BAR
    assert abs(length / wanted_length - 1.0) < 0.05


def pictured(scene: bpy.types.Scene, sidecar: dict, output: Path) -> None:
    bpy.ops.mesh.primitive_uv_sphere_add(
        radius=0.7, location=(1.6, 1.2, 0.7), segments=96, ring_count=48
    )
    bpy.ops.object.shade_smooth()
    give(material("mirror", (0.9, 0.9, 0.9), metallic=1.0, roughness=0.02))
    bpy.ops.mesh.primitive_uv_sphere_add(
        radius=0.5, location=(-1.5, 0.6, 0.5), segments=96, ring_count=48
    )
    bpy.ops.object.shade_smooth()
    give(material("white", (0.8, 0.8, 0.8), roughness=1.0))
    data = bpy.data.cameras.new("camera")
    data.lens, data.clip_end = 28.0, 1e5
    camera = bpy.data.objects.new("camera", data)
    camera.location, camera.rotation_euler = (0.3, -5.2, 1.7), (math.radians(83.0), 0.0, 0.0)
    bpy.context.collection.objects.link(camera)
    scene.camera = camera
    scene.cycles.samples, scene.cycles.use_denoising = 192, True
    scene.render.resolution_x, scene.render.resolution_y = 800, 450
    scene.view_settings.view_transform = "AgX"
    grey = ALBEDO / math.pi * sidecar["horizontal_irradiance_of_map_W_m2"][1]
    scene.view_settings.exposure = math.log2(0.3 / grey)
    settings = scene.render.image_settings
    settings.file_format, settings.quality = "JPEG", 88
    scene.render.filepath = str(output.resolve())
    bpy.ops.render.render(write_still=True)
    print(output, output.stat().st_size)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("map", type=Path)
    parser.add_argument("picture", type=Path, nargs="?")
    words = parser.parse_args()
    sidecar = json.loads(words.map.with_suffix(".json").read_text(encoding="utf-8"))
    scene = scene_with(words.map.resolve(), sidecar)
    checked(scene, sidecar)
    if words.picture is not None:
        pictured(scene, sidecar, words.picture)


if __name__ == "__main__":
    main()
