"""Optical depths along rays, and points drawn from them, against quadrature of the profiles."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.stats import kstest

from airlight.geometry.path import ray_length
from airlight.geometry.shell import meets_ground
from airlight.kernel import compiled_loop
from airlight.planets import Medium, Planet, load_planet
from airlight.planets.matter.profiles import Exponential, Layer, Layered, Tabulated, Tent, Uniform
from airlight.solver.montecarlo.history_optics import HistoryOptics, history_optics, jump_altitudes
from airlight.solver.montecarlo.rays import (
    new_trace,
    place_at_depth,
    point_at,
    trace_optical_depth,
)
from airlight.solver.montecarlo.streams import stream, uniform
from airlight.solver.montecarlo.sun_biased_sampling import (
    new_sampling_density,
    sample_sun_biased,
    sun_biased_density,
    sun_sampling_integral,
)
from airlight.solver.refracted_geometry import RefractedGeometry
from airlight.solver.tables.columns import columns

CLOUD = Layered(
    layers=(
        Layer(width=2e3, constant_term=0.05),
        Layer(width=1e3, constant_term=1.0),
        Layer(constant_term=0.0, exp_term=0.3, exp_scale=-1.25e-4),
    )
)
PROFILES: dict[str, Any] = {
    "exponential": Exponential(scale_height=8e3),
    "low haze": Exponential(scale_height=1.2e3),
    "tent": Tent(center=25e3, half_width=15e3),
    "cloud with edges": CLOUD,
    "uniform": Uniform(),
    "table": Tabulated(
        altitudes=(0.0, 5e3, 20e3, 60e3, 100e3), densities=(1.0, 0.6, 0.1, 1e-3, 0.0)
    ),
}
#: Altitude [m] and zenith angle [deg]: up, level, down to the ground, past the ground.
RAYS = [(0.0, 0.0), (0.0, 89.5), (12e3, 90.0), (2.5e3, 70.0), (30e3, 120.0), (60e3, 97.0)]


@compiled_loop
def draw(depth, count, extinction, path, r, mu, state, out):
    collision_probability = 1.0 - np.exp(-depth)
    for k in range(out.size):
        wanted = -np.log(1.0 - uniform(state) * collision_probability)
        at, t = place_at_depth(min(wanted, depth), count, extinction, path)
        out[k] = point_at(path.panels[at], t, r, mu, extinction)[0]


@compiled_loop
def draw_in_light(count, total, air, path, lit, r, mu, state, distances, densities, depths):
    for k in range(distances.size):
        at, t, depths[k] = sample_sun_biased(
            uniform(state), uniform(state), count, total, air.extinction, path, lit
        )
        distances[k], _, slope = point_at(path.panels[at], t, r, mu, air.extinction)
        # per optical depth rather than per the panel's own variable
        densities[k] = sun_biased_density(at, t, total, air.extinction, lit) / slope


def traced(medium: Medium, air: HistoryOptics, altitude: float, angle: float) -> tuple[Any, ...]:
    r, mu = medium.bottom_radius + altitude, float(np.cos(np.radians(angle)))
    ground = bool(meets_ground(r, mu, medium.bottom_radius))
    length = ray_length(r, mu, medium.bottom_radius, medium.top_radius)
    path = new_trace(air.extinction)
    count, depth = trace_optical_depth(r, mu, ground, air.extinction, path)
    return r, mu, length, path, count, depth


@pytest.mark.parametrize("profile", list(PROFILES))
@pytest.mark.parametrize("vertical", [0.1, 40.0])
def test_places_follow_the_exact_distribution(
    profile: str, vertical: float, one_air: Callable[..., Planet], tell: Callable[[str], None]
) -> None:
    # The distribution function of a forced collision is (1 - e^{-τ(s)})/(1 - e^{-τ(L)}); τ by the
    # quadrature of the column tables' own test. Kolmogorov-Smirnov with 20 000 points a ray, fixed
    # seed, p > 0.001 for each of 72 rays: one right sampler in 14 would need another seed.
    planet = one_air(depth=vertical, profile=PROFILES[profile])
    medium = Medium.from_planet(planet, [550.0])
    air = history_optics(RefractedGeometry.of(medium), 0, polarised=False)
    for at, (altitude, angle) in enumerate(RAYS):
        r, mu, length, path, count, depth = traced(medium, air, altitude, angle)
        if depth <= 0.0:
            continue
        out = np.empty(20_000)
        draw(depth, count, air.extinction, path, r, mu, stream(5, at, len(profile)), out)
        assert out.min() >= -1e-6
        assert out.max() <= length * (1.0 + 1e-9)

        def exact(s: np.ndarray, r: float = r, mu: float = mu, length: float = length) -> Any:
            fine = {"nodes": 24, "panels": 12}
            way = columns(
                r, mu, np.clip(s, 0.0, length), medium.bottom_radius, medium.density, **fine
            )
            whole = columns(r, mu, length, medium.bottom_radius, medium.density, **fine)
            tau, all_of_it = way @ medium.extinction[:, 0], whole @ medium.extinction[:, 0]
            return np.expm1(-tau) / np.expm1(-all_of_it)

        result = kstest(out, exact)
        ray = f"{altitude / 1e3:g} km {angle:g}°"
        tell(f"points, {profile}, depth {vertical:g}, {ray}: p {result.pvalue:.3f}")
        assert result.pvalue > 1e-3


@pytest.mark.parametrize("name", ["earth", "earth-atmosphere-plus", "earth-bruneton", "mars"])
def test_optical_depths_meet_the_quadrature_of_the_profiles(
    name: str, tell: Callable[[str], None]
) -> None:
    # A second method, good to 1e-6; the bound is three times what the choice of the rule promises
    # for its own rays, since these are others; on average the error must vanish to 1e-4.
    planet = load_planet(name)
    geometry = RefractedGeometry.of(Medium.from_planet(planet, [680.0, 440.0]))
    medium = geometry.medium  # over optical radius, where light is bent
    generator = np.random.default_rng(4)
    errors = []
    for wavelength in range(2):
        air = history_optics(geometry, wavelength, polarised=False)
        for _ in range(150):
            altitude = medium.thickness * 0.9 * generator.random() ** 3
            angle = np.degrees(np.arccos(generator.uniform(-0.3, 1.0)))
            r, mu, length, _, _, depth = traced(medium, air, altitude, angle)
            column = columns(r, mu, length, medium.bottom_radius, medium.density, panels=8)
            exact = float(column @ medium.extinction[:, wavelength])
            if exact > 0.0:
                errors.append((np.exp(-depth) - np.exp(-exact)) / -np.expm1(-exact))
    size, mean = np.abs(errors).max(), np.mean(errors)
    tell(f"light lost along rays, {name}: largest error {size:.1e}, mean {mean:+.1e}")
    assert len(errors) > 250
    assert size < 3e-3
    assert abs(mean) < 1e-4


def test_jumps_are_found_and_corners_are_none(one_air: Callable[..., Planet]) -> None:
    # The cloud has two edges, a tent and a table are continuous.
    def jumps(name: str) -> list[float]:
        medium = Medium.from_planet(one_air(profile=PROFILES[name]), [550.0])
        return jump_altitudes(medium.density).tolist()

    assert_allclose(jumps("cloud with edges"), [2e3, 3e3])
    assert jumps("tent") == jumps("exponential") == jumps("table") == jumps("uniform") == []


def test_places_in_light_have_the_density_that_is_said(
    reference_earth: Callable[..., Planet],
) -> None:
    # Importance sampling: the mean of f/p over points drawn from p is ∫ f, here of e^{-τ} dτ over
    # the part of a ray that the star lights; four standard errors of 20 000 points.
    medium = Medium.from_planet(reference_earth(albedo=0.0), [440.0])
    air = history_optics(RefractedGeometry.of(medium), 0, polarised=False)
    r, mu, _, path, count, _ = traced(medium, air, 0.0, 60.0)
    mu_s, nu = np.cos(np.radians(95.0)), 0.3
    lit = new_sampling_density(air.extinction)
    total = sun_sampling_integral(
        r, mu, mu_s, nu, count, air.extinction, air.star_transmittance, path, lit
    )
    assert total > 0.0
    distances, densities, depths = np.empty((3, 20_000))
    draw_in_light(count, total, air, path, lit, r, mu, stream(9), distances, densities, depths)
    way = columns(r, mu, distances, medium.bottom_radius, medium.density) @ medium.extinction[:, 0]
    # exact to the accuracy of the rays' rule
    assert_allclose(np.exp(-depths), np.exp(-way), atol=2e-4)
    edge, far = 80e3, 150e3  # a stretch well inside the light
    inside = (distances > edge) & (distances < far)
    estimate = np.where(inside, np.exp(-depths) / densities, 0.0)
    ends = columns(r, mu, np.array([edge, far]), medium.bottom_radius, medium.density)
    before, after = np.exp(-(ends @ medium.extinction[:, 0]))
    error = estimate.std() / np.sqrt(estimate.size)
    assert error < 0.02 * (before - after)
    assert_allclose(estimate.mean(), before - after, rtol=0, atol=4.0 * error)
