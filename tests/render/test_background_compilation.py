"""Loops compiled before there is a solution: those, and for the types, that pictures then use."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from functools import partial
from typing import Any

import numba
import numpy as np
import pytest

from airlight import Camera, Scene, load_planet
from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_optics import CloudOptics, droplets
from airlight.render.background_compilation import (
    _arguments,
    _cloudy_arguments,
    cloudy_loops,
    empty_clouds,
)
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
#: The same of the light of clouds, and nothing that it does not run.
LIGHT = """
import sys
from numba.core.dispatcher import Dispatcher
from airlight import Scene, load_planet, solve
from airlight.clouds import planet_clouds
from airlight.kernel.compiling import name_of, reached
from airlight.render.clouds import clouds_around
from airlight.render.clouds.cloud_light import FIRST
from airlight.render.clouds.lit_clouds import LitClouds
from airlight.render.clouds.loops import LOOPS


def used():
    return {name_of(one) for name, module in list(sys.modules.items())
            if name.startswith("airlight.")
            for one in vars(module).values() if isinstance(one, Dispatcher) and one.signatures}


clouds_around.Box = lambda **place: planet_clouds.Box(**place, size=3200.0, spacing=200.0, levels=8)
planet = load_planet("earth-atmosphere-plus", {"clouds": [{"kind": "cumulus"}]})
solution = solve(planet.without_clouds, [680, 550, 440], "preview", cache=False)
scene = Scene(altitude=2.0)
around = clouds_around.CloudsAround.of(planet, scene, cache=False)
before = used()
LitClouds.solve(around, planet, solution, scene, detail=FIRST)
found, known = used() - before, {name_of(one) for one in LOOPS}
print(len(known & found), *sorted((found - set(reached(LOOPS))) | (known - found)))
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
    assert all(numba.typeof(one) == numba.typeof(real.layers[0]) for one in empty_clouds(3).layers)
    # the table of the air, also in the light of the mean layer, for one set of types
    *_, lines, fill = cloudy_loops()
    for loop, arguments in zip((lines, fill), _cloudy_arguments()[1:], strict=True):
        loop(*arguments)
        assert len(loop.signatures) == 1


@pytest.mark.parametrize("program", [SOLVE, LIGHT], ids=["solution", "clouds"])
def test_the_count_of_a_solve_knows_the_loops_that_it_runs(program: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    known, *unknown = done.stdout.split()
    assert int(known) > 10
    assert unknown == []
