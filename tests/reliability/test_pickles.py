"""Planets, solutions and scenes go to other processes, by fork and by spawn, and mean the same."""

from __future__ import annotations

import multiprocessing
import pickle
import sys
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from airlight import Camera, Scene, load_planet, render, solve


def made() -> tuple[Any, Any, Any]:
    planet = load_planet("earth-openspace")
    solution = solve(planet, [680, 550, 440], "preview")
    return planet, solution, Scene(altitude=2.0, sun_zenith=60.0, camera=Camera(width=8, height=6))


def answers(planet: Any, solution: Any, scene: Any) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Numbers that depend on all of each object."""
    light = solution.radiance(altitude=2.0, sun_zenith=60.0, view_zenith=[0.0, 80.0], azimuth=90.0)
    again = solve(planet, [680, 550, 440], "preview")
    sky = again.radiance(altitude=2.0, sun_zenith=60.0, view_zenith=[0.0, 80.0], azimuth=90.0)
    return np.asarray(light), np.asarray(sky), render(solution, scene).rgb


def sent(content: bytes, pipe: Any) -> None:
    pipe.send(answers(*pickle.loads(content)))
    pipe.close()


@pytest.mark.parametrize("how", ["fork", "spawn"])
def test_another_process_gives_equal_numbers(how: str) -> None:
    if how not in multiprocessing.get_all_start_methods():
        pytest.skip(f"no {how} on {sys.platform}")
    objects = made()
    here = answers(*objects)
    context = multiprocessing.get_context(how)
    mine, other = context.Pipe(duplex=False)
    process = context.Process(target=sent, args=(pickle.dumps(objects), other))
    process.start()
    other.close()
    try:
        assert mine.poll(300.0)
        there = mine.recv()
    finally:
        process.join(10.0)
        process.kill()
    for one, same in zip(here, there, strict=True):
        assert_array_equal(same, one)
