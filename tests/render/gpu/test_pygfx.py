"""The pass of the example for pygfx, by its own files, against the look-ups in Python."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.engines.composition.aerial_files import write_aerial
from airlight.engines.composition.aerial_perspective import AerialPerspective
from airlight.image.encoding import srgb_encode
from airlight.render.gpu.device.device import Device

EXAMPLE = Path(__file__).parents[2] / "examples" / "engines" / "pygfx"
WIDTH, HEIGHT = 96, 54


def test_a_wall_and_the_sky_behind(
    device: Device,
    aerial: AerialPerspective,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    import pygfx

    monkeypatch.syspath_prepend(str(EXAMPLE))
    import air_pass

    write_aerial(tmp_path / "air", aerial)
    camera = pygfx.PerspectiveCamera(50, WIDTH / HEIGHT, depth_range=(10, 1e5))
    camera.local.euler_x = 0.05
    star = air_pass.star_towards(75.0, 60.0)
    shown = air_pass.AirPass(tmp_path / "air", camera, star, exposure=2.0)
    scene = pygfx.Scene()
    # half of the picture: a wall of reflectance 0.2158 (128/255), 20 km to the north
    wall = pygfx.Mesh(
        pygfx.plane_geometry(40e3, 80e3), pygfx.MeshBasicMaterial(color=(128 / 255,) * 3)
    )
    wall.local.position = (-20e3, 0.0, -20e3)
    scene.add(wall)
    seen = air_pass.picture(scene, camera, [shown], WIDTH, HEIGHT)[..., :3].astype(float)

    inverse = camera.projection_matrix_inverse
    x, y = (np.arange(WIDTH) + 0.5) / WIDTH, (np.arange(HEIGHT) + 0.5) / HEIGHT
    clip = np.stack(np.broadcast_arrays(2 * x - 1, 1 - 2 * y[:, None], 0.5, 1.0), axis=-1)
    point = clip @ inverse.T
    ray = (point[..., :3] / point[..., 3:]) @ camera.world.matrix[:3, :3].T
    ray /= np.linalg.norm(ray, axis=-1, keepdims=True)
    level = np.array([star[0], 0.0, star[2]]) / np.hypot(star[0], star[2])
    rows = np.stack([level, np.cross([0.0, 1.0, 0.0], level), [0.0, 1.0, 0.0]])
    unit = (ray @ rows.T).reshape(-1, 3)
    away = 20e3 / -ray[..., 2].ravel()
    radiance, transmittance = aerial.air(unit, away)
    grey = ((128 / 255 + 0.055) / 1.055) ** 2.4
    covered = (ray[..., 0] < 0.0).ravel()
    light = np.where(
        covered[:, None], grey * transmittance + radiance, aerial.sky(unit, pixel=1e-2)
    )
    wanted = 255.0 * srgb_encode(1.0 - np.exp(-2.0 * light)).reshape(HEIGHT, WIDTH, 3)
    inner = np.ones(WIDTH, bool)
    inner[WIDTH // 2 - 1 : WIDTH // 2 + 1] = False  # the wall's edge
    # pygfx encodes by a power of 1/2.2
    assert_allclose(seen[:, inner], wanted[:, inner], atol=2.0)


@pytest.mark.skipif(sys.platform == "win32", reason="a path of the shell")
def test_the_example_draws_hills(device: Device, aerial: AerialPerspective, tmp_path: Path) -> None:
    import subprocess

    from PIL import Image

    write_aerial(tmp_path / "air", aerial)
    made = [sys.executable, str(EXAMPLE / "hills.py"), str(tmp_path / "air"), "hills.png"]
    subprocess.run(made, cwd=tmp_path, check=True, timeout=300, capture_output=True)
    picture = np.asarray(Image.open(tmp_path / "hills.png").convert("RGB")).astype(float)
    # sky bluer than the ground, and far hills paler than near ground
    assert picture[40, 200, 2] > 1.3 * picture[40, 200, 0]
    assert picture[-20, 480].mean() < picture[235, 480].mean()
