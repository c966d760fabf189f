"""Hills under a planet's air in pygfx.

pip install pygfx
airlight aerial earth --altitude 500m --sun-zenith 75deg -o air
python hills.py air hills.png
"""

import sys

import numpy as np
import pygfx
from air_pass import AirPass, picture, star_towards
from PIL import Image


def height(x, z):
    """Height above the sea of valleys nearby and ridges far away. [m]"""
    total, size, strength = np.zeros_like(x), 9000.0, 1.0
    for octave in range(7):
        turn = 2.1 * octave
        u, v = x * np.cos(turn) + z * np.sin(turn), z * np.cos(turn) - x * np.sin(turn)
        wave = np.sin(u / size + octave + np.cos(0.7 * v / size))
        total += strength * (1.0 - np.abs(wave))
        size, strength = 0.47 * size, 0.45 * strength
    away = np.clip((np.hypot(x, z) - 1500.0) / 40e3, 0.0, 1.0)
    return (60.0 + 2600.0 * away**0.8) * total + 100.0


def land(rings=260, spokes=900):
    """Ground from 30 m to 90 km around the camera, 500 m above the sea; y up. [m]"""
    away = 30.0 * (90e3 / 30.0) ** np.linspace(0.0, 1.0, rings)[:, None]
    angle = np.linspace(0.0, 2.0 * np.pi, spokes)
    x, z = away * np.sin(angle), -away * np.cos(angle)
    # the planet is round: the ground falls away by d²/2R
    y = height(x, z) - 500.0 - away**2 / (2.0 * 6.36e6)
    first = (np.arange(rings - 1)[:, None] * spokes + np.arange(spokes - 1)).ravel()
    a, b, c, d = first, first + 1, first + spokes + 1, first + spokes
    faces = np.concatenate([np.stack(one, axis=-1) for one in ((a, b, c), (a, c, d))])
    positions = np.stack([x, y, z], axis=-1).reshape(-1, 3).astype(np.float32)
    return pygfx.Geometry(
        positions=positions,
        indices=faces.astype(np.int32),
        normals=pygfx.utils.normals_from_vertices(positions, faces).astype(np.float32),
    )


if __name__ == "__main__":
    folder, file = sys.argv[1:]
    camera = pygfx.PerspectiveCamera(50, 16 / 9, depth_range=(10, 2e5))
    camera.local.euler_x = 0.03
    air = AirPass(folder, camera, star_towards(75.0, 40.0), exposure=2.5)
    sun = pygfx.DirectionalLight("#fff", np.pi)
    sun.local.position = air.star
    scene = pygfx.Scene()
    scene.add(sun, pygfx.AmbientLight("#bfd4ff", 0.35))
    scene.add(pygfx.Mesh(land(), pygfx.MeshPhongMaterial(color="#77706a", specular="#000")))
    Image.fromarray(picture(scene, camera, [air], 960, 540)[..., :3]).save(file)
