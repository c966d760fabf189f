"""Who solves a planet: the GPU where it can, the CPU where it cannot."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import load_planet
from airlight.gpu.solver.solve import solve_planet
from airlight.gpu.solver.solver import fields_on

NM = [450.0, 530.0, 600.0, 680.0]


@pytest.fixture
def fast(device):
    """The same device, said to be a GPU."""
    return replace(device, software=False)


def test_a_gpu_solves_a_clear_planet(fast):
    # Only the GPU leaves a field on the device; the bar between the two is 0.5 %.
    planet = load_planet("earth")
    solution = solve_planet(fast, planet, NM, "preview")
    assert fields_on(fast, solution) is not None
    assert solution.planet is planet
    other = solve_planet(replace(fast, software=True), planet, NM, "preview")
    sight = {"altitude": 0.0, "sun_zenith": 60.0, "view_zenith": [0.0, 60.0, 85.0], "azimuth": 90.0}
    assert_allclose(solution.radiance(**sight), other.radiance(**sight), rtol=5e-3)


@pytest.mark.parametrize(
    ("name", "wavelengths"), [("titan", NM), ("earth", np.linspace(400.0, 700.0, 6))]
)
def test_what_has_no_room_or_is_thick_is_solved_by_the_cpu(fast, name, wavelengths):
    # Thick air is refused by the GPU's solver, and a texel has four wavelengths.
    solution = solve_planet(fast, load_planet(name), wavelengths, "preview")
    assert fields_on(fast, solution) is None
    assert solution.moments.field.shape[-1] == len(wavelengths)


def test_a_processor_that_plays_a_gpu_is_not_asked(device):
    # lavapipe shares the processor with the CPU's solver, which is ten times quicker.
    if not device.software:
        pytest.skip("this device is a GPU")
    solution = solve_planet(device, load_planet("earth"), NM, "preview")
    assert fields_on(device, solution) is None
