"""Many wavelengths: their order, and guesses between those that are solved."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import load_planet, solve
from airlight.solvers.moments import iterate
from airlight.solvers.moments.between_wavelengths import Corrections, panels


@pytest.mark.parametrize("count", [1, 3, 8, 9, 16, 17, 24, 63, 64, 65, 129, 400])
@pytest.mark.parametrize("step", [1.0, -1.0, 40.0])
def test_each_wavelength_is_solved_once_and_eight_at_a_time(count, step):
    wavelengths = 900.0 + step * np.arange(count)
    blocks = [which for panel in panels(wavelengths) for which in panel]
    indices = [range(count)[which] for which in blocks]
    assert sorted(i for block in indices for i in block) == list(range(count))
    assert all(1 <= len(block) <= 8 for block in indices)


def test_the_ends_of_a_panel_come_first():
    (panel,) = panels(np.linspace(500.0, 563.0, 64))
    assert [which.start for which in panel] == [0, 7, 3, 1, 5, 2, 4, 6]


@pytest.mark.parametrize("wavelengths", [np.linspace(300.0, 1000.0, 40), np.array([600.0, 500.0])])
def test_wavelengths_far_apart_are_on_their_own(wavelengths):
    assert all(len(panel) == 1 for panel in panels(wavelengths))
    shuffled = np.array([500.0, 503.0, 501.0, 502.0] * 8)
    assert all(len(panel) == 1 for panel in panels(shuffled))
    assert all(len(panel) == 1 for panel in panels(np.linspace(500.0, 563.0, 64), clear=False))


def test_corrections_linear_in_wavelength_are_found_exactly():
    rng = np.random.default_rng(1)
    shape = (2, 3, 4, 8)
    base = rng.uniform(0.5, 1.0, shape).astype(np.float32)
    sky = rng.uniform(0.5, 1.0, (2, 3, 8)).astype(np.float32)

    def light(nm):
        lanes = np.resize(nm, 8).astype(np.float32)
        return base * (1.0 + 0.01 * lanes), sky * (1.0 + 0.02 * lanes)

    corrections = Corrections()
    known, wanted = np.array([0.0, 4.0]), np.array([1.0, 3.0, 5.0])
    assert corrections.corrected(wanted, (base, sky)) is None
    corrections.add(known, (base, sky), light(known))
    found = corrections.corrected(wanted, (base, sky))
    # A guess is corrected in proportion to its own mean radiance: here by the moments of lane 1,
    # whose correction at 4 nm is 4 % of them.
    share = 0.01 * base[..., 1:2] / base[:, :, :1, 1:2]
    by_hand = base[..., :3] + base[:, :, :1, :3] * share * wanted
    assert_allclose(found[0][..., :3], by_hand, rtol=1e-5)
    assert_allclose(found[1][..., :3], light(wanted)[1][..., :3], rtol=1e-5)


def test_wavelengths_in_between_need_fewer_sweeps_for_the_same_light(monkeypatch):
    nm = np.linspace(500.0, 523.0, 24)
    sweeps = []
    inner = iterate._iterate

    def watched(*arguments):
        result = inner(*arguments)
        sweeps.append(result[3])
        return result

    monkeypatch.setattr(iterate, "_iterate", watched)
    helped = solve(load_planet("earth"), nm, "preview", cache=False)
    assert sweeps[0] >= 2
    assert sweeps[2] == 1
    apart = [[slice(k, k + 8)] for k in range(0, 24, 8)]
    monkeypatch.setattr(iterate, "panels", lambda *_, **__: apart)
    alone = solve(load_planet("earth"), nm, "preview", cache=False)
    assert all(count >= 2 for count in sweeps[3:])
    given = {"altitude": 0.0, "sun_zenith": [30.0, 88.0], "view_zenith": 70.0, "azimuth": 40.0}
    # Both are within the tolerance of a preview, and most of it is not used.
    assert_allclose(helped.radiance(**given), alone.radiance(**given), rtol=1e-3)
