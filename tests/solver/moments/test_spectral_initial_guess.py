"""Many wavelengths: their order, and guesses between those that are solved."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import load_planet, replace, solve
from airlight.planets import Constituent
from airlight.planets.matter.profiles import Exponential
from airlight.planets.spectral import PerWavelength
from airlight.solver.moments import iterate
from airlight.solver.moments.settings import QUALITIES
from airlight.solver.moments.spectral_initial_guess import SpectralGuess, wavelength_batches


@pytest.mark.parametrize("count", [1, 3, 8, 9, 16, 17, 24, 63, 64, 65, 129, 400])
@pytest.mark.parametrize("step", [1.0, -1.0, 40.0])
def test_each_wavelength_is_solved_once_and_eight_at_a_time(count, step):
    wavelengths = 900.0 + step * np.arange(count)
    batches = [which for batch in wavelength_batches(wavelengths) for which in batch]
    indices = [range(count)[which] for which in batches]
    assert sorted(i for batch in indices for i in batch) == list(range(count))
    assert all(1 <= len(batch) <= 8 for batch in indices)


def test_the_ends_of_a_batch_come_first():
    (batch,) = wavelength_batches(np.linspace(500.0, 563.0, 64))
    assert [which.start for which in batch] == [0, 7, 3, 1, 5, 2, 4, 6]


@pytest.mark.parametrize("wavelengths", [np.linspace(300.0, 1000.0, 40), np.array([600.0, 500.0])])
def test_wavelengths_far_apart_are_on_their_own(wavelengths):
    assert all(len(batch) == 1 for batch in wavelength_batches(wavelengths))
    shuffled = np.array([500.0, 503.0, 501.0, 502.0] * 8)
    assert all(len(batch) == 1 for batch in wavelength_batches(shuffled))
    assert all(
        len(batch) == 1 for batch in wavelength_batches(np.linspace(500.0, 563.0, 64), clear=False)
    )


def test_corrections_linear_in_wavelength_are_found_exactly():
    rng = np.random.default_rng(1)
    shape = (2, 3, 4, 8)
    base = rng.uniform(0.5, 1.0, shape).astype(np.float32)
    sky = rng.uniform(0.5, 1.0, (2, 3, 8)).astype(np.float32)

    def light(nm):
        lanes = np.resize(nm, 8).astype(np.float32)
        return base * (1.0 + 0.01 * lanes), sky * (1.0 + 0.02 * lanes)

    spectral = SpectralGuess()
    known, wanted = np.array([0.0, 4.0]), np.array([1.0, 3.0, 5.0])
    assert spectral.corrected(wanted, (base, sky)) is None
    spectral.add(known, (base, sky), light(known))
    found = spectral.corrected(wanted, (base, sky))
    # A guess is corrected in proportion to its own mean radiance: here by the moments of lane 1,
    # whose correction at 4 nm is 4 % of them.
    share = 0.01 * base[..., 1:2] / base[:, :, :1, 1:2]
    by_hand = base[..., :3] + base[:, :, :1, :3] * share * wanted
    assert_allclose(found[0][..., :3], by_hand, rtol=1e-5)
    assert_allclose(found[1][..., :3], light(wanted)[1][..., :3], rtol=1e-5)


def test_what_sweeps_would_change_follows_from_what_one_changed():
    # A straight line from 0 to 4 misses a parabola x² by x (4 - x): 4 in the middle, 3 beside it.
    shape = (2, 3, 4, 8)
    ones = np.ones(shape, np.float32), np.ones(shape[:2] + shape[3:], np.float32)
    spectral = SpectralGuess()
    spectral.add(np.array([0.0, 4.0]), ones, (1.02 * ones[0], 1.02 * ones[1]))
    asked = np.array([1.0, 2.0, 5.0])
    assert_allclose(spectral.expected(asked, ones), np.inf)  # nothing was seen
    spectral.check(np.array([2.0]), np.array([4e-3]))
    assert_allclose(spectral.expected(asked, ones), [3e-3, 4e-3, np.inf])
    # A line of the air's own: the guess is e times lower, the correction of 2 % may be another.
    band = ones[0] * np.where(np.arange(8) == 1, np.exp(-1.0), 1.0).astype(np.float32), ones[1]
    assert_allclose(spectral.expected(asked, band), [3e-3, 4e-3 + 0.02, np.inf], rtol=1e-5)


@pytest.fixture
def sweeps(monkeypatch):
    """Numbers of sweeps of the batches that are solved, as they come."""
    found = []
    inner = iterate._iterate

    def watched(*arguments):
        result = inner(*arguments)
        found.append(result[3])
        return result

    monkeypatch.setattr(iterate, "_iterate", watched)
    return found


SEEN = {"altitude": 0.0, "sun_zenith": [30.0, 88.0, 95.0], "view_zenith": 70.0, "azimuth": 40.0}


@pytest.mark.parametrize("planet", ["earth", "mars"])
def test_wavelengths_in_between_need_fewer_sweeps_for_the_same_light(planet, sweeps, monkeypatch):
    # The limit of many sweeps; alone, wavelengths are no nearer to it, and both by the tolerance.
    nm, made, quality = np.arange(500.0, 524.0), load_planet(planet), QUALITIES["preview"]
    helped = solve(made, nm, quality, cache=False).radiance(**SEEN)
    alike, sweeps[:] = list(sweeps), []
    apart = [[slice(k, k + 8)] for k in range(0, 24, 8)]
    monkeypatch.setattr(iterate, "wavelength_batches", lambda *_, **__: apart)
    alone = solve(made, nm, quality, cache=False).radiance(**SEEN)
    assert alike[0] == max(sweeps) >= 2  # the first has no help, and wavelengths of all three
    assert alike[-1] <= 1
    assert all(many >= 2 for many in sweeps)
    limit = replace(quality, tolerance=quality.tolerance / 50.0, max_sweeps=400)
    wanted = solve(made, nm, limit, cache=False).radiance(**SEEN)
    off, before = (float(np.abs(one / wanted - 1.0).max()) for one in (helped, alone))
    assert off < max(1.01 * before, 1e-5)
    assert off < quality.tolerance


def test_the_dusk_of_thin_air_where_guesses_are_negative_is_not_corrected_by_their_ratio(sweeps):
    # The second path: each eight wavelengths alone.
    nm, pluto = np.linspace(390.0, 720.0, 16), load_planet("pluto")
    helped = solve(pluto, nm, cache=False).radiance(**SEEN)
    assert max(sweeps) <= 5
    for first in (0, 8):
        alone = solve(pluto, nm[first : first + 8], cache=False).radiance(**SEEN)
        assert_allclose(helped[..., first : first + 8], alone, rtol=2e-3)


def test_wavelengths_close_to_others_need_no_sweep(sweeps):
    # The second path: each eight wavelengths alone, which are batches without help.
    nm = np.linspace(540.0, 571.0, 64)
    earth = load_planet("earth")
    clear = solve(earth, nm, "preview", cache=False)
    assert sweeps[-5:] == [0] * 5
    for first in (0, 32):
        alone = solve(earth, nm[first : first + 32 : 4], "preview", cache=False)
        wanted = alone.radiance(**SEEN)
        assert_allclose(clear.radiance(**SEEN)[..., first : first + 32 : 4], wanted, rtol=2e-4)


def test_an_absorption_line_between_two_wavelengths_is_swept(sweeps):
    # A line 0.3 nm wide, of vertical depth 3: no wavelength solved before it has it.
    nm = np.linspace(540.0, 571.0, 64)
    middle, scale = 553.3, 8000.0
    line = 3.0 / scale * np.exp(-0.5 * ((nm - middle) / 0.3) ** 2)
    values = PerWavelength(wavelengths=tuple(nm), values=tuple(line))
    gas = Constituent(name="gas", profile=Exponential(scale_height=scale), absorption=values)
    earth = load_planet("earth")
    planet = replace(earth, constituents=(*earth.constituents, gas))
    found = solve(planet, nm, "preview", cache=False).radiance(**SEEN)
    (batch,) = wavelength_batches(nm)
    inside = np.flatnonzero(np.abs(nm - middle) < 0.6)
    assert inside.size >= 2
    for which, count in zip(batch, sweeps, strict=True):
        if set(range(64)[which]) & set(inside):
            assert count >= 1
    alone = solve(planet, nm[inside], "preview", cache=False).radiance(**SEEN)
    assert_allclose(found[..., inside], alone, rtol=2e-4)


def test_progress_ends_at_the_whole_where_the_last_wavelengths_need_no_sweep(sweeps):
    reported = []
    solve(
        load_planet("earth"), np.linspace(540.0, 571.0, 64), "preview", cache=False,
        progress=lambda done, of, _: reported.append((done, of)),
    )  # fmt: skip
    assert sweeps[-1] == 0
    assert reported[-1] == (6400, 6400)
    assert reported == sorted(reported)
