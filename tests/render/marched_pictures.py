"""Pictures by the CPU of which each pixel has one line of sight, at edges too."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from airlight.render.cpu_renderer import CpuRenderer
from airlight.render.gpu.device.device import Device
from airlight.render.pixels.scenes_by_light import scenes_by_light
from airlight.scene import Scene
from airlight.solver.moments.solution import MomentsSolution


def marched(
    solution: MomentsSolution, scene: Scene, device: Device, **options: Any
) -> NDArray[np.float32]:
    """Picture of ``render(..., exact=True)``; like a software GPU without samples of edges."""
    camera = scene.camera
    total = np.zeros((camera.height, camera.width, 3), np.float32)
    for seen, lit, _, _ in scenes_by_light(scene, solution):
        rgb = np.zeros_like(total)
        renderer = CpuRenderer(lit, seen, exact=True, edges=not device.software, **options)
        renderer.render_rows(0, camera.height, rgb)
        total += rgb
    return total


def centres(solution: MomentsSolution, scene: Scene, **options: Any) -> NDArray[np.float32]:
    """Picture of ``render`` whose pixels show their centres, as single lines of sight do."""
    rgb = np.zeros((scene.camera.height, scene.camera.width, 3), np.float32)
    renderer = CpuRenderer(solution, scene, edges=False, **options)
    renderer.fill_sky_view()
    renderer.render_rows(0, scene.camera.height, rgb)
    return rgb
