"""Loops compiled before there is a solution: those, and for the types, that pictures then use."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from functools import partial
from typing import Any

import numba
import numpy as np

from airlight import Camera, Scene, load_planet
from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_optics import CloudOptics, droplets
from airlight.render.background_compilation import _arguments, empty_clouds
from airlight.render.clouds.cloud_deck import CloudDeck
from airlight.render.clouds.cloud_tables import new_cloud_work
from airlight.render.clouds.clouds_around import CloudsAround
from airlight.render.cpu_renderer import CpuRenderer
from airlight.solver.moments.march_tables import new_workspace

#: Solves, and names the functions that Python has called and that no loop of the count leads to.
SOLVE = """
import sys
from numba.core.dispatcher import Dispatcher
from airlight import load_planet, solve
from airlight.kernel.compiling import name_of, reached
from airlight.solver.moments.loops import LOOPS
solve(load_planet("earth-atmosphere-plus"), [680, 550, 440], "preview", cache=False)
known = reached(LOOPS)
used = {name_of(one) for name, module in list(sys.modules.items()) if name.startswith("airlight.")
        for one in vars(module).values() if isinstance(one, Dispatcher) and one.signatures}
print(len(used & set(known)), *sorted(used - set(known)))
"""


def test_empty_arguments_have_the_types_of_a_picture(solved: Callable[..., Any]) -> None:
    solution = solved(load_planet("earth"), quality="preview")
    camera = Camera(width=320, height=180, look_zenith=100.0)
    renderer = CpuRenderer(solution, Scene(altitude=400e3, camera=camera))
    renderer.fill_sky_view()
    fill, mirrored, draw, _ = _arguments()
    points = np.zeros(4)
    frame, work = renderer._frame(renderer._view), new_workspace(renderer._tables)
    real = points, points, frame, work, renderer._weights
    for made, one in zip(draw[:5], real, strict=True):
        assert numba.typeof(made) == numba.typeof(one)
    read = frame.window, frame.observer, frame.tables, work
    for made in (fill, mirrored):
        assert [numba.typeof(one) for one in made[2:6]] == [numba.typeof(one) for one in read]


def test_empty_clouds_have_the_types_of_a_picture(solved: Callable[..., Any]) -> None:
    solution = solved(load_planet("earth"), quality="preview")
    scene = Scene(altitude=2.0, camera=Camera(width=320, height=180))
    field = CloudField(
        extinction=np.full((4, 4, 8), 0.01, np.float32), spacing=(500.0, 500.0, 62.5), base=1e3
    )
    deck = CloudDeck(field, partial(CloudOptics.of_particles, droplets(10e-6, 0.1)))
    around = CloudsAround((deck,))
    renderer = CpuRenderer(solution, scene, clouds=around.lit(solution, scene))
    renderer.fill_sky_view()
    real, made = renderer._clouds, empty_clouds()
    assert real is not None
    assert numba.typeof(made) == numba.typeof(real)
    assert numba.typeof(new_cloud_work(made)) == numba.typeof(new_cloud_work(real))


def test_the_count_of_a_solve_knows_the_loops_that_it_runs() -> None:
    done = subprocess.run([sys.executable, "-c", SOLVE], capture_output=True, text=True, check=True)
    known, *unknown = done.stdout.split()
    assert int(known) > 10
    assert unknown == []
