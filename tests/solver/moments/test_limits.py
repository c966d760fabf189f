"""Air at and beyond the limits of the moments solver: it is solved, or refused with the limit."""

from __future__ import annotations

from collections import deque
from itertools import pairwise

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_less

from airlight import solve
from airlight.errors import ConvergenceError, ParameterError
from airlight.planets import Constituent, Ground, Planet, Star, replace
from airlight.planets.matter.phases import HenyeyGreenstein
from airlight.planets.matter.profiles import Exponential
from airlight.planets.medium import Medium
from airlight.solver.moments import iterate
from airlight.solver.moments.limits import diffusion_lengths
from airlight.solver.moments.settings import settings_for
from airlight.solver.moments.setup import Setup
from airlight.solver.moments.stopping import PATIENCE, Iteration, Stopping
from airlight.solver.refracted_geometry import RefractedGeometry


def haze(asymmetry: float, depth: float, *, kept: float = 1.0, thickness: float = 60e3) -> Planet:
    """Particles over a ground of albedo 0.3; ``kept`` is the albedo of a scattering."""
    extinction = 8.0 * depth / thickness
    return Planet(
        name="haze", bottom_radius=6360e3, top_radius=6360e3 + thickness,
        ground=Ground(albedo=0.3), star=Star(irradiance=1.0, angular_radius=0.0),
        constituents=(
            Constituent(
                name="haze", profile=Exponential(scale_height=thickness / 8.0),
                scattering=kept * extinction, absorption=(1.0 - kept) * extinction,
                phase_function=HenyeyGreenstein(asymmetry=asymmetry),
            ),
        ),
        default_wavelengths=(550.0,),
    )  # fmt: skip


def setup_of(planet: Planet, quality: str = "preview") -> Setup:
    medium = Medium.from_planet(planet, planet.default_wavelengths)
    return Setup(geometry=RefractedGeometry.of(medium), settings=settings_for(quality))


def medium_of(planet: Planet) -> tuple[Medium, np.ndarray]:
    """Medium of a planet, and mean cosines of its scattering."""
    optics = setup_of(planet).optics
    return optics.medium, optics.phases[..., 1]


@pytest.mark.filterwarnings("ignore:energy is not conserved")  # that it converges counts
@pytest.mark.parametrize(
    ("asymmetry", "depth"), [(-0.9, 1.0), (-0.97, 10.0), (-0.999, 0.3), (0.999, 100.0), (0.99, 1e3)]
)
def test_peaks_of_either_direction_converge(asymmetry: float, depth: float) -> None:
    # Backward peaks diverged (400 sweeps, changes of 2e2) while azimuths confused orders m and
    # 2B - m; forward ones where a cap left 2 % of the peak in the moments.
    solution = solve(haze(asymmetry, depth), quality="preview", cache=False)
    assert solution.report.sweeps < 20
    mean = solution.moments.field[:, :, 0]
    assert np.isfinite(mean).all()
    assert mean.min() > -1e-6 * mean.max()


def test_orders_of_azimuth_that_scattering_keeps_are_told_apart() -> None:
    # Of B midpoints cos mφ and -cos (2B - m)φ are the same numbers; up to m = B - 1 none are.
    setup = setup_of(haze(-0.9, 1.0))
    azimuths = setup.azimuths
    count = azimuths.cosines.size
    assert count == setup.degree + 1
    products = azimuths.multiples @ azimuths.multiples.T * (count / (2.0 * np.pi) ** 2)
    assert_allclose(products, np.diag([1.0] + [0.5] * setup.degree), atol=1e-6)
    # Without their peak forward particles keep little of them, and need no more azimuths.
    assert setup_of(haze(0.9, 1.0)).azimuths.cosines.size == 4


@pytest.mark.parametrize(
    ("planet", "field", "allowed"),
    [
        (haze(0.0, 1000.0), "depth of scattering", "0 to 500"),
        (haze(0.6, 100.0, thickness=6360e3), "depth of scattering", "or stronger absorption"),
        (haze(-0.98, 2.0), "g of scattering by haze", "-0.97 or more"),
    ],
)
def test_what_no_iteration_ends_is_refused_at_once(
    planet: Planet, field: str, allowed: str
) -> None:
    with pytest.raises(ParameterError) as refused:
        solve(planet, quality="preview", cache=False)
    assert field in str(refused.value)
    assert allowed in str(refused.value)


@pytest.mark.filterwarnings("ignore:energy is not conserved")  # that it converges counts
def test_deeper_air_that_absorbs_a_little_in_each_scattering_is_solved() -> None:
    # Light diffuses through 1/sqrt(3 · 0.1) of a depth: it does not know how deep the air is.
    solution = solve(haze(0.0, 1000.0, kept=0.9), quality="preview", cache=False)
    assert solution.report.sweeps < 60


def test_diffusion_lengths_of_even_air_are_those_of_its_whole_depth() -> None:
    # sqrt(3(1 - ϖ)(1 - ϖg)) of a depth is the same at all altitudes: 1000 sqrt(3 · 0.1 · 0.55).
    planet = haze(0.5, 1000.0, kept=0.9)
    medium = Medium.from_planet(planet, planet.default_wavelengths)
    lengths = diffusion_lengths(medium, np.full((1, 1), 0.5))
    assert_allclose(lengths, 1e3 * np.sqrt(3.0 * 0.1 * 0.55), rtol=1e-3)


def test_what_absorbs_below_deep_air_does_not_make_it_shallow() -> None:
    # The same absorption, where the air is, ends light on its way; at the ground it does not.
    even = haze(0.0, 1000.0, kept=0.9999)
    scattering, absorption = haze(0.0, 1000.0).constituents[0], even.constituents[0].absorption
    below = Constituent(
        name="soot", profile=Exponential(scale_height=100.0),
        scattering=0.0, absorption=75.0 * absorption,
    )  # fmt: skip
    assert diffusion_lengths(*medium_of(even)) > 10.0
    planet = replace(even, constituents=(scattering, below))
    assert diffusion_lengths(*medium_of(planet)) < 4.0
    with pytest.raises(ParameterError, match=r"times 1 - g, at 550 nm is 999\.7"):
        solve(planet, quality="preview", cache=False)


def test_air_that_scatters_nothing_and_no_air_are_solved() -> None:
    for planet in (haze(0.5, 50.0, kept=0.0), haze(0.5, 0.0), haze(0.5, 1e-8)):
        solution = solve(planet, quality="preview", cache=False)
        assert np.isfinite(solution.moments.field).all()
    grounds = replace(haze(0.5, 0.0), ground=Ground(albedo=1.0))
    light = solve(grounds, quality="preview", cache=False)
    # A white ground under no air sends back what it receives, over all directions alike.
    up = light.radiance(altitude=0.0, sun_zenith=60.0, view_zenith=180.0, azimuth=0.0)
    assert_allclose(up.values, 0.5 / np.pi, rtol=1e-5)


def test_a_diverging_iteration_falls_back_to_another_scheme_and_says_so(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    # Acceleration that adds four times too much diverges; successive orders have the same limit.
    planet = haze(0.6, 1.0)
    sound = solve(planet, quality="preview", cache=False)
    assert not sound.report.note
    apply = iterate.SyntheticAcceleration.apply

    def too_much(self, field, sky, light=None):
        all_field, all_sky = apply(self, field, sky, light)
        return field + 4.0 * (all_field - field), sky + 4.0 * (all_sky - sky)

    monkeypatch.setattr(iterate.SyntheticAcceleration, "apply", too_much)
    diverged = solve(planet, quality="preview", cache=False)
    assert "iteration diverged" in str(diverged.report)
    field, known = diverged.moments.field, sound.moments.field
    bright = known[:, :, 0] > 1e-2 * known[:, :, 0].max()
    assert_allclose(field[:, :, 0][bright], known[:, :, 0][bright], rtol=0.02)


def iteration(settings: str = "preview") -> Iteration:
    return Iteration(Stopping.of_sweeps(settings_for(settings)), np.zeros(1), 1)


def update(one: Iteration, values: deque[float]) -> None:
    """Update an iteration by the steps from each value to the next."""
    for before, after in zip(list(values)[:-1], list(values)[1:], strict=True):
        one.update(np.full((2, 1, 1), before, np.float32), np.full((2, 1, 1), after, np.float32))


def test_divergence_is_noticed_within_ten_orders() -> None:
    one = iteration()
    update(one, deque([1.0, 1.5, 1.2]))
    assert not one.diverging
    update(one, deque([1.0, 2.0] * (PATIENCE // 2 + 1)))
    assert one.diverging
    assert one.sweeps < 10
    one.restart(accelerated=True)
    assert not one.diverging


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_light_that_is_not_finite_ends_the_iteration_at_once(value: float) -> None:
    with pytest.raises(ConvergenceError, match="order 2 is not a finite number"):
        update(iteration(), deque([1.0, 1.1, value]))


def test_slow_plain_orders_are_counted_to_their_end_or_given_up() -> None:
    # Of orders with 0.9 of the one before nine times the last follow.
    one = iteration()
    one.restart(accelerated=False)
    sums = deque(np.cumsum(0.9 ** np.arange(30.0)))
    update(one, sums)
    assert_allclose(one.remaining_error, 9.0 * 0.9**29 / sums[-1], rtol=0.1)
    assert one.unfinished()
    # With 0.9999 of it, tens of thousands would be needed: more than preview allows.
    slow = iteration()
    slow.restart(accelerated=False)
    update(slow, deque(100.0 + np.cumsum(0.9999 ** np.arange(30.0))))
    with pytest.raises(ConvergenceError, match="each order of scattering is still"):
        slow.unfinished()
    assert_array_less(slow.tolerance, slow.remaining_error)


def test_plain_orders_that_shrink_ever_more_slowly_are_given_up() -> None:
    # Changes of 1/n fall below any tolerance, and their sum has no end.
    one = iteration()
    one.restart(accelerated=False)
    sums = 2.0 + 0.2 * np.cumsum(1.0 / np.arange(10.0, 200.0))
    with pytest.raises(ConvergenceError, match="remaining error"):
        for before, after in pairwise(sums):
            update(one, deque([before, after]))
            assert one.unfinished()
    assert one.sweeps < 20
