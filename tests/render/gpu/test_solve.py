"""Choice of the solver of a planet: the GPU where it can, the CPU where it cannot."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import load_planet
from airlight.planets import replace as planet_replace
from airlight.render.gpu.solver.solver import fields_on
from airlight.render.pixels.render_tables import MAX_CONSTITUENTS
from airlight.render.rendering_gpu import fits
from airlight.render.solve_planet import live_solver, solve_planet

NM = [450.0, 530.0, 600.0, 680.0]


@pytest.fixture
def fast(device):
    """The same device, declared to be a hardware GPU."""
    return replace(device, software=False)


def test_a_gpu_solves_a_clear_planet(fast):
    # Only the GPU leaves a field on the device; the tolerance between the two is 0.5 %.
    planet = load_planet("earth")
    solution = solve_planet(planet, NM, "preview", device=fast)
    assert fields_on(fast, solution) is not None
    assert solution.planet is planet
    other = solve_planet(planet, NM, "preview", cache=False)
    lines = {"altitude": 0.0, "sun_zenith": 60.0, "view_zenith": [0.0, 60.0, 85.0], "azimuth": 90.0}
    assert_allclose(solution.radiance(**lines), other.radiance(**lines), rtol=5e-3)


@pytest.mark.filterwarnings("ignore:Titan. absorption bands of CH4")
@pytest.mark.parametrize(
    ("name", "wavelengths"), [("titan", NM), ("earth", np.linspace(400.0, 700.0, 6))]
)
def test_what_has_no_room_or_is_thick_is_solved_by_the_cpu(fast, name, wavelengths):
    # Thick air is refused by the GPU's solver, and a texel has four wavelengths.
    solution = solve_planet(load_planet(name), wavelengths, "preview", device=fast, cache=False)
    assert fields_on(fast, solution) is None
    assert solution.moments.field.shape[-1] == len(wavelengths)


def test_a_cpu_that_plays_a_gpu_is_not_asked(device):
    # lavapipe runs on the CPU beside the CPU's solver, which is ten times faster.
    if not device.software:
        pytest.skip("this device is a GPU")
    solution = solve_planet(load_planet("earth"), NM, "preview", device=device, cache=False)
    assert fields_on(device, solution) is None


def test_without_wavelengths_a_device_gets_what_fits_a_texel(fast):
    # Sixteen on the CPU; on a device the four that reproduce colours best.
    earth = load_planet("earth")
    assert solve_planet(earth, quality="preview", device=fast).wavelengths.size == 4
    assert solve_planet(earth, quality="preview").wavelengths.size == 16


def test_who_asks_for_the_cpu_gets_it(fast):
    # The same device, the same planet: only "auto" and "gpu" leave a field on it.
    earth = load_planet("earth")

    def solved(choice):
        solver = live_solver(choice, fast)
        return solver(earth, np.array(NM), "preview", progress=lambda *_: None, cancel=None)

    assert fields_on(fast, solved("cpu")) is None
    assert fields_on(fast, solved("gpu")) is not None


def test_a_bent_planet_has_one_constituent_more():
    # Refraction takes one more row of the tables: where all are used, the GPU has no capacity.
    earth = load_planet("earth")
    room = MAX_CONSTITUENTS
    air = [planet_replace(earth.constituents[0], name=f"air {k}") for k in range(room)]
    full = planet_replace(earth, constituents=tuple(air), refraction="none")
    assert fits(full, 4)
    assert not fits(full, 5)
    assert not fits(planet_replace(full, refraction="bouguer"), 4)
