"""Scene by Blender for docs/compose.md: ``python builders/compose_scene.py FOLDER``.

It needs bpy (``pip install bpy``, Python 3.11), which is no dependency of airlight. It writes
FOLDER/render.exr and FOLDER/camera.json as the script in docs/compose.md does; then

    airlight compose FOLDER/render.exr --camera FOLDER/camera.json -o FOLDER/composed.png

Ridges at 1.5 to 60 km and three balls of 30, 90 and 400 m at 0.4, 2 and 10 km, all of one grey, by
a white sun without any sky: everything else in the picture is the air's.
"""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path

import bpy
import numpy as np

#: Size of the picture [pixel], and samples of a pixel.
SIZE = (960, 540)
SAMPLES = 24
#: Distances and heights of the ridges. [m]
RIDGES = ((1.5e3, 60.0), (5e3, 250.0), (13e3, 800.0), (30e3, 2200.0), (60e3, 4400.0))
#: Balls: position and radius. [m]
BALLS = (((-70.0, 400.0, 45.0), 15.0), ((330.0, 2000.0, 150.0), 45.0),
         ((-1500.0, 10e3, 900.0), 200.0))  # fmt: skip


def ridge(distance: float, height: float, seed: int) -> None:
    """Add a strip of hills across the view, seen to 40° on both sides."""
    random = np.random.default_rng(seed)
    across = np.linspace(-0.85 * distance, 0.85 * distance, 600)
    along = distance * np.linspace(-0.12, 0.12, 60)
    profile = np.zeros((along.size, across.size))
    for octave in range(2, 9):
        turn = random.uniform(0.0, 2.0 * np.pi, 2)
        waves = 2.0**octave / distance
        profile += 2.0**-octave * np.abs(
            np.sin(
                waves * across[None, :] + turn[0] + 2.0 * np.sin(waves * along[:, None] + turn[1])
            )
        )
    shape = 4.0 * profile * np.cos(0.5 * np.pi * along / along[-1])[:, None]
    x, y = np.meshgrid(across, distance + along)
    z = height * shape - 20.0
    points = np.stack([x, y, z], axis=-1).reshape(-1, 3)
    first = (np.arange(along.size - 1)[:, None] * across.size + np.arange(across.size - 1)).ravel()
    faces = np.stack([first, first + 1, first + across.size + 1, first + across.size], axis=-1)
    mesh = bpy.data.meshes.new("ridge")
    mesh.from_pydata(points.tolist(), [], faces.tolist())
    bpy.context.collection.objects.link(bpy.data.objects.new("ridge", mesh))


def main(folder: Path) -> None:
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()
    scene = bpy.context.scene
    for seed, (distance, height) in enumerate(RIDGES):
        ridge(distance, height, seed)
    for place, radius in BALLS:
        bpy.ops.mesh.primitive_uv_sphere_add(
            radius=radius, location=place, segments=64, ring_count=32
        )
        bpy.ops.object.shade_smooth()
    bpy.ops.mesh.primitive_plane_add(size=160e3, location=(0.0, 0.0, 0.0))
    grey = bpy.data.materials.new("grey")
    grey.use_nodes = True
    grey.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0.2, 0.2, 0.2, 1)
    grey.node_tree.nodes["Principled BSDF"].inputs["Roughness"].default_value = 1.0
    for one in scene.objects:
        one.data.materials.append(grey)
    # irradiance pi: a white surface that faces the sun is 1
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy, sun.data.angle = math.pi, math.radians(0.53)
    sun.rotation_euler = (math.radians(66.0), 0.0, math.radians(70.0))
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location, camera.rotation_euler = (0.0, 0.0, 60.0), (math.radians(94.0), 0.0, 0.0)
    camera.data.clip_end, camera.data.angle = 1e6, math.radians(50.0)
    for one in (sun, camera):
        scene.collection.objects.link(one)
    scene.camera = camera
    scene.world = bpy.data.worlds.new("black")
    scene.world.color = (0.0, 0.0, 0.0)
    scene.render.engine, scene.cycles.samples = "CYCLES", SAMPLES
    scene.cycles.use_denoising = False
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    write(folder, sun)


def write(folder: Path, sun: bpy.types.Object) -> None:
    """Render to FOLDER, as the script in docs/compose.md."""
    scene, camera = bpy.context.scene, bpy.context.scene.camera
    bpy.context.view_layer.use_pass_z = scene.render.film_transparent = True
    scene.render.image_settings.media_type = "MULTI_LAYER_IMAGE"
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    scene.render.filepath = str(folder / "render.exr")
    bpy.ops.render.render(write_still=True)
    width, height = scene.render.resolution_x, scene.render.resolution_y
    lens = camera.calc_matrix_camera(bpy.context.evaluated_depsgraph_get(), x=width, y=height)
    to_sun = sun.matrix_world.col[2]
    data = {
        "w": width, "h": height,
        "fl_x": lens[0][0] * width / 2, "fl_y": lens[1][1] * height / 2,
        "cx": (1 - lens[0][2]) * width / 2, "cy": (1 + lens[1][2]) * height / 2,
        "transform_matrix": [list(row) for row in camera.matrix_world],
        "airlight": {
            "planet": "earth", "lat": 46.6, "lon": 8.0, "alt": 500.0, "heading": 0.0,
            "metres_per_unit": scene.unit_settings.scale_length,
            "sun_zenith": math.degrees(math.acos(to_sun.z)),
            "sun_azimuth": math.degrees(math.atan2(to_sun.x, to_sun.y)),
        },
    }  # fmt: skip
    (folder / "camera.json").write_text(json.dumps(data, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve())
