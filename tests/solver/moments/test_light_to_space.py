"""Light that leaves thick and dusty air to space: no point, no sun between two nodes loses any."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import load_planet, solve
from airlight.geometry.quadrature import gauss_legendre
from airlight.solver.moments.grid import sun_indices
from airlight.solver.moments.march_tables import quadratures
from airlight.solver.moments.settings import QUALITIES
from airlight.solver.moments.solution import MomentsSolution
from airlight.validation.published import rayleigh_sphere as sphere

NM = (550.0,)


def lines_from_space(suns: np.ndarray) -> dict[str, np.ndarray]:
    """Lines of sight from 400 km to the ground, near the nadir to near the limb."""
    view, sun, azimuth = np.meshgrid([178.0, 150.0, 125.0], suns, [0.0, 90.0, 180.0])
    return {
        "altitude": np.full(view.size, 400e3),
        "view_zenith": view.ravel(),
        "sun_zenith": sun.ravel(),
        "azimuth": azimuth.ravel(),
    }


@pytest.mark.parametrize("name", ["mars-standard", "earth-atmosphere-plus"])
def test_more_points_on_a_line_lose_no_light(
    name: str, solved: Callable[..., MomentsSolution], tell: Callable[[str], None]
) -> None:
    # The same integral by six times the points: both quadratures are good to 5e-4, so that what a
    # line leaves out must not grow with the number of its points. 0.1 % is a third of the 0.3 %
    # that light from space may err.
    solution = solved(load_planet(name), NM, "preview")
    lines, _ = solution.lines_of_sight(**lines_from_space(np.array([0.0, 40.0, 65.0])))
    few = solution.tables._replace(rules=quadratures((20,) * 4), panels=2)
    many = few._replace(rules=quadratures((28,) * 4), panels=8)
    of_few, of_many = (
        solution.radiance_per_irradiance(lines, 0, tables=light) for light in (few, many)
    )
    loss = 100.0 * (of_many / of_few - 1.0)
    tell(f"{name}: by six times the points {loss.mean():+.3f} %, at most {np.abs(loss).max():.3f}")
    assert_allclose(of_many, of_few, rtol=1e-3)


def test_suns_by_day_are_as_good_as_three_times_as_many(tell: Callable[[str], None]) -> None:
    # Second method: a grid of suns whose interpolation errs by a ninth of that. Both grids share
    # radii, directions and degree, so nothing else differs; the observers look at suns between
    # their nodes. With 10° from node to node near the zenith it was 0.23 %.
    coarse = replace(QUALITIES["preview"], sun_angles=56, march_panels=2)
    solutions = [
        solve(load_planet("mars-standard"), NM, settings, cache=False)
        for settings in (coarse, replace(coarse, sun_angles=166))
    ]
    lines, _ = solutions[0].lines_of_sight(**lines_from_space(np.linspace(0.5, 60.0, 40)))
    high = np.degrees(np.arcsin((lines.r * lines.mu_s + lines.length * lines.nu) / 3389.5e3)) > 30.0
    got, truth = (one.radiance_per_irradiance(lines, 0)[high] for one in solutions)
    error = 100.0 * (got / truth - 1.0)
    tell(f"suns of Mars: mean {error.mean():+.3f} %, at most {np.abs(error).max():.3f} %")
    assert_allclose(error.mean(), 0.0, atol=0.03)
    assert_allclose(error, 0.0, atol=0.15)


@pytest.mark.parametrize("dip", [0.03, 10.0, 36.0])
def test_suns_are_dense_at_dusk_and_never_far_apart_by_day(dip: float) -> None:
    # By the definition of the density: at the terminator a node's width is 0.6 of the dip times a
    # constant k, by day at most 45° times k, and in the shadow they are sparser than without day.
    elevation, index = sun_indices(dip, 56)
    assert elevation[0] == -90.0
    assert elevation[-1] == 90.0
    assert index[0] == 0.0
    assert_allclose(index[-1], 55.0)
    assert (np.diff(index) > 0.0).all()
    slope = np.diff(elevation) / np.diff(index)
    middle = 0.5 * (elevation[1:] + elevation[:-1])
    k = np.interp(-0.3 * dip, middle, slope) / (0.6 * dip)
    assert (slope[middle > dip] <= 45.0 * k * (1.0 + 1e-6)).all()
    deep = np.interp(-3.3 * dip, middle, slope)
    if dip < 20.0:  # the shadow's thinning ends above the nadir
        assert_allclose(deep / (0.6 * dip * np.hypot(1.0, 3.0 / 0.6) * k), 1.0 / 0.2, rtol=1e-3)


def chandrasekhar(view: np.ndarray, sun: float, azimuth: float) -> np.ndarray:
    """Radiance over irradiance of gas without end: Chandrasekhar (1950), section 44, eq. 51."""
    rule = gauss_legendre(60)
    mu, weights = rule.nodes, rule.weights
    sine2 = 1.0 - mu**2
    kinds = (3.0 / 16.0 * (3.0 - mu**2), 0.375 * mu**2 * sine2, 3.0 / 32.0 * sine2**2)
    at_nodes = [sphere.h_function(mu, weights, psi) for psi in kinds]
    c = float(sphere.rayleigh_constant(mu, weights, at_nodes[0]).mean())

    def h(kind: int, x: np.ndarray) -> np.ndarray:
        psi, known = kinds[kind], at_nodes[kind]
        rest = np.sqrt(max(1.0 - 2.0 * float(weights @ psi), 0.0))
        return 1.0 / (rest + (mu * psi * known * weights / (mu + x[:, None])).sum(axis=1))

    s = np.array([sun])
    sines = np.sqrt((1.0 - view**2) * (1.0 - sun**2))
    scattered = h(0, view) * h(0, s) * (3.0 - c * (view + sun) + view * sun)
    scattered -= 4.0 * view * sun * sines * h(1, view) * h(1, s) * np.cos(azimuth)
    scattered += sines**2 * h(2, view) * h(2, s) * np.cos(2.0 * azimuth)
    return np.asarray(3.0 / (32.0 * np.pi) * sun / (view + sun) * scattered)


def test_gas_without_end_reflects_what_chandrasekhar_says(
    solved: Callable[..., MomentsSolution], tell: Callable[[str], None]
) -> None:
    # An exact solution, at a sun on a node and half way to the next one.
    solution = solved(sphere.rayleigh_planet(), NM, "preview", polarisation=False)
    suns = solution.moments.grid.sun_cosines
    view = np.array([0.2, 0.5, 0.8, 0.98])
    worst = {}
    for wanted in (0.3, 0.6, 0.9):
        j = int(np.abs(suns[:-1] - wanted).argmin())
        for where, sun in (("on", float(suns[j])), ("between", 0.5 * float(suns[j] + suns[j + 1]))):
            for azimuth in (0.0, 90.0, 180.0):
                got = solution.radiance(
                    altitude=solution.medium.thickness, sun_zenith=np.degrees(np.arccos(sun)),
                    view_zenith=180.0 - np.degrees(np.arccos(view)), azimuth=azimuth,
                ).values[:, 0]  # fmt: skip
                error = got / chandrasekhar(view, sun, np.radians(azimuth)) - 1.0
                worst[where] = max(worst.get(where, 0.0), float(np.abs(error).max()))
    tell(f"gas without end, preview: {100 * worst['on']:.2f} % on nodes, between "
         f"{100 * worst['between']:.2f} %")  # fmt: skip
    # A per cent is what `preview` may err; what interpolation adds is at most as much again.
    assert worst["on"] < 0.01
    assert worst["between"] < 0.02


def test_a_sphere_of_gas_is_as_bright_as_exactly(
    solved: Callable[..., MomentsSolution], tell: Callable[[str], None]
) -> None:
    # Chandrasekhar's solution integrated over the disc, 0.7518; the bar of light from space. In
    # polarised light 0.798 (Prather 1974) or, by Monte Carlo, 0.796 (Schmid et al. 2006, table 3).
    for polarisation, known, bar in ((False, sphere.exact_albedo(), 0.3), (True, 0.797, 0.4)):
        solution = solved(sphere.rayleigh_planet(), NM, "default", polarisation=polarisation)
        ours = float(sphere.geometric_albedo(solution)[0])
        error = 100.0 * (ours / known - 1.0)
        tell(f"sphere of gas: geometric albedo {ours:.4f}, {error:+.2f} %")
        assert abs(error) < bar
