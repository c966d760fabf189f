"""Weight of the ground below the air that an observer sees: by distance, beside other methods."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray

from airlight import Medium, load_planet, replace
from airlight.planets.matter.profiles import Exponential
from airlight.planets.planet import Planet
from airlight.scene.ground_weight import ground_distances

FloatArray = NDArray[np.float64]

SHARES = np.array([0.05, 0.25, 0.5, 0.75, 0.95])


def gas(bottom: float, thickness: float, height: float, scattering: float) -> Planet:
    """Planet of one gas that scatters as Rayleigh's law says and absorbs nothing."""
    air = load_planet("earth-atmosphere-plus").constituents[0]
    one = replace(air, profile=Exponential(scale_height=height), scattering=scattering)
    earth = load_planet("earth-atmosphere-plus")
    return replace(earth, bottom_radius=bottom, top_radius=bottom + thickness, constituents=(one,))


def medium(*numbers: float) -> Medium:
    return Medium.from_planet(gas(*numbers), [550.0])


def through(start: FloatArray, way: FloatArray, length: FloatArray, air: Planet) -> FloatArray:
    """Transmittance of straight lines by the trapezoidal rule, shape (n,)."""
    height = air.constituents[0].profile.scale_height
    parts = np.linspace(0.0, 1.0, 65)
    points = start[:, None] + way[:, None] * (length[:, None] * parts)[..., None]
    density = np.exp(-(np.linalg.norm(points, axis=2) - air.bottom_radius) / height)
    depth = length * np.trapezoid(density, parts, axis=1) * air.constituents[0].scattering
    return np.exp(-depth)


def to_sphere(start: FloatArray, way: FloatArray, radius: float, last: bool) -> FloatArray:
    """Distance along lines to a sphere, its far or near side; nan where there is none. [m]"""
    half = np.sum(start * way, axis=1)
    root = half * half - np.sum(start * start, axis=1) + radius * radius
    root = np.sqrt(np.where(root >= 0.0, root, np.nan))
    found = -half + (root if last else -root)
    return np.where(found > 0.0, found, np.nan)


def directions(random: np.random.Generator, count: int, lowest: float) -> FloatArray:
    """Directions even in solid angle whose cosine with the negative z is above ``lowest``."""
    z = -random.uniform(lowest, 1.0, count)
    azimuth = random.uniform(0.0, 2.0 * np.pi, count)
    flat = np.sqrt(1.0 - z * z)
    return np.stack([flat * np.cos(azimuth), flat * np.sin(azimuth), z], axis=1)


def traced(air: Planet, altitude: float, count: int) -> tuple[FloatArray, FloatArray]:
    """Distances [rad] and weights of ground points drawn at random, in three dimensions."""
    parts = [_traced(air, altitude, count // 10, seed) for seed in range(10)]
    distance, weight = zip(*parts, strict=True)
    return np.concatenate(distance), np.concatenate(weight)


def _traced(air: Planet, altitude: float, count: int, seed: int) -> tuple[FloatArray, FloatArray]:
    random = np.random.default_rng(seed)
    bottom, top = air.bottom_radius, air.top_radius
    start = np.tile([0.0, 0.0, bottom + altitude], (count, 1))
    outside = altitude > top - bottom
    lowest = np.sqrt(1.0 - (top / (bottom + altitude)) ** 2) if outside else -1.0
    way = directions(random, count, lowest)
    first = to_sphere(start, way, top, last=False) if outside else np.zeros(count)
    ground = to_sphere(start, way, bottom, last=False)
    last = np.where(np.isnan(ground), to_sphere(start, way, top, last=True), ground)
    share, power = random.uniform(size=count), 1.0 if outside else 3.0  # near the observer
    length = (last - first) * share**power
    entry = start + way * first[:, None]
    point = entry + way * length[:, None]
    height = np.linalg.norm(point, axis=1) - bottom
    weight = (last - first) * power * share ** (power - 1.0) * through(entry, way, length, air)
    weight *= np.exp(-height / air.constituents[0].profile.scale_height)
    down = directions(random, count, -1.0)
    fall = to_sphere(point, down, bottom, last=False)
    seen = ~np.isnan(fall) & ~np.isnan(weight)
    fall = np.where(seen, fall, 0.0)
    end = point + down * fall[:, None]
    weight = np.where(seen, weight * through(point, down, fall, air), 0.0)
    flat = np.hypot(end[:, 0], end[:, 1])
    return np.where(seen, np.arctan2(flat, end[:, 2]), 0.0), weight


@pytest.mark.parametrize(
    "altitude",
    [10e3, *(pytest.param(one, marks=pytest.mark.validation) for one in (2.0, 400e3))],
)
def test_the_weight_is_that_of_paths_drawn_at_random(altitude: float) -> None:
    # A second method: points and directions at random, in vectors. The tolerance is 4 times the
    # error of 200 000 paths of uneven weight, which are worth at least 10 000 even ones.
    air = gas(6.36e6, 1e5, 8e3, 1.2e-5)
    found = ground_distances(Medium.from_planet(air, [550.0]), altitude, SHARES)
    distance, weight = traced(air, altitude, 200_000)
    worth = weight.sum() ** 2 / np.square(weight).sum()
    assert worth > 1e4
    inside = np.array([weight[distance <= one].sum() for one in found]) / weight.sum()
    assert_allclose(inside, SHARES, rtol=0, atol=4.0 * 0.5 / np.sqrt(worth))


def test_thin_low_air_seen_from_far_away_weighs_the_disc_by_area() -> None:
    # An exact limit: a line of sight crosses 1/cos of a thin layer, and the disc shows cos of the
    # ground's area, so equal areas of the hemisphere weigh alike: the share is 1 - cos d. Of 64
    # lines in Gauss's rule none stands for more than 0.0245: half of that is the tolerance.
    found = ground_distances(medium(6.36e6, 1e3, 50.0, 1e-9), 1e12, SHARES)
    assert_allclose(1.0 - np.cos(found), SHARES, rtol=0, atol=0.0123)


def test_a_planet_of_twice_the_size_has_the_same_weight() -> None:
    # A law: with all lengths doubled and coefficients halved every optical depth is the same.
    once = ground_distances(medium(6.36e6, 1e5, 8e3, 1.2e-5), 2e3, SHARES)
    twice = ground_distances(medium(12.72e6, 2e5, 16e3, 0.6e-5), 4e3, SHARES)
    assert_allclose(twice, once, rtol=1e-6)


def test_thicker_air_sees_less_far() -> None:
    # Extinction acts on longer ways more than on shorter ones.
    clear, dense = (
        ground_distances(medium(6.36e6, 1e5, 8e3, k), 0.0, SHARES) for k in (1e-6, 1e-4)
    )
    assert (dense < clear).all()


def test_air_that_does_not_scatter_sees_the_ground_below_the_observer() -> None:
    # No light of the ground is sent back: any weight would do, that of one point is the simplest.
    assert_allclose(ground_distances(medium(6.36e6, 1e5, 8e3, 0.0), 0.0, SHARES), 0.0)
