"""Light in bent rays, against rays followed step by step through the air."""

from __future__ import annotations

from functools import cache
from itertools import pairwise
from math import acos, cos, exp, pi, radians, sin

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from airlight import load_planet, solve
from airlight.planets import Constituent, Ground, Planet, Star, replace
from airlight.planets.matter.gases import RefractiveScattering
from airlight.planets.matter.phases import HenyeyGreenstein, Rayleigh
from airlight.planets.matter.profiles import Exponential
from airlight.solver.moments.solution import MomentsSolution
from airlight.solver.montecarlo.refracted_paths import refraction_on_path
from airlight.solver.montecarlo.settings import MonteCarloSettings as MonteCarloSettings
from airlight.solver.montecarlo.solution import MonteCarloSolution
from airlight.solver.star_light import direct_irradiance

BOTTOM, THICK, HEIGHT, HAZE = 6371e3, 100e3, 8434.0, 1500.0
EXCESS, DENSITY, PARTICLES, ASYMMETRY = 2.78e-4, 2.5469e25, 20e-6, 0.6
TOP = BOTTOM + THICK
AIR = RefractiveScattering(refractivity=EXCESS, number_density=DENSITY)
GAS = float(AIR.coefficients([550.0])[0])
COEFFICIENTS = np.array([GAS, PARTICLES])


@pytest.fixture(scope="module")
def planet() -> Planet:
    return Planet(
        name="bent",
        bottom_radius=BOTTOM,
        top_radius=TOP,
        ground=Ground(albedo=0.0),
        star=Star(irradiance=1.0, angular_radius=0.0),
        refraction="bouguer",
        default_wavelengths=(550.0,),
        constituents=(
            Constituent(
                name="gas",
                profile=Exponential(scale_height=HEIGHT),
                scattering=AIR,
            ),
            Constituent(
                name="haze",
                profile=Exponential(scale_height=HAZE),
                scattering=PARTICLES,
                phase_function=HenyeyGreenstein(asymmetry=ASYMMETRY),
            ),
        ),
    )


def densities(r: float) -> np.ndarray:
    return np.array([exp(-(r - BOTTOM) / HEIGHT), exp(-(r - BOTTOM) / HAZE)])


def follow(r: float, theta: float, distances: np.ndarray | None = None):
    """The ray equation in the plane, d(n t)/ds = grad n: radius, angle at the centre, zenith
    angle and columns, to the top or to the ground. A second method: no invariant, no optical
    radius."""

    def change(_: float, y: np.ndarray) -> np.ndarray:
        rho = densities(y[0])
        rate = -EXCESS * rho[0] / HEIGHT / (1.0 + EXCESS * (rho[0] - exp(-THICK / HEIGHT)))
        return np.array(
            [cos(y[2]), sin(y[2]) / y[0], -sin(y[2]) * (1.0 / y[0] + rate), rho[0], rho[1]]
        )

    def left(_: float, y: np.ndarray) -> float:
        return y[0] - TOP

    def fell(_: float, y: np.ndarray) -> float:
        return y[0] - BOTTOM + 1e-3

    for event in (left, fell):
        event.terminal = True  # type: ignore[attr-defined]
    left.direction, fell.direction = 1.0, -1.0  # type: ignore[attr-defined]
    return solve_ivp(
        change, (0.0, 4e6), [r, 0.0, theta, 0.0, 0.0], method="DOP853", rtol=1e-10, atol=1e-7,
        events=(left, fell), dense_output=True,
    )  # fmt: skip


def true_zenith(r: float, seen: float) -> float:
    """Zenith angle of the star that is seen at a zenith angle; more than pi behind the ground."""
    ray = follow(r, seen)
    return ray.y[1, -1] + ray.y[2, -1] if ray.status == 1 and ray.t_events[0].size else 4.0


@cache
def starlight(r: float, zenith: float) -> tuple[float, float]:
    """Seen zenith angle of a star, and its light: transmittance times the squeeze."""
    horizon = pi - np.arcsin(min(1.0, (1 + EXCESS) * BOTTOM / r / (1 + EXCESS * densities(r)[0])))
    lowest = horizon - 1e-7
    if true_zenith(r, lowest) < zenith:
        return lowest, 0.0
    start = max(zenith - 0.05, 0.0)
    seen = brentq(lambda z: true_zenith(r, z) - zenith, start, min(zenith, lowest), xtol=1e-10)
    step = 2e-6
    slope = (cos(seen) - cos(seen - step)) / (
        cos(true_zenith(r, seen)) - cos(true_zenith(r, seen - step))
    )
    ray = follow(r, seen)
    return seen, slope * exp(-float(COEFFICIENTS @ ray.y[3:, -1]))


@cache
def once_scattered(altitude: float, view: float, sun: float, azimuth: float) -> float:
    """Radiance per irradiance of the light scattered once, with the true angle at each point."""
    ray = follow(BOTTOM + altitude, radians(view))
    nodes, weights = np.polynomial.legendre.leggauss(8)
    length = ray.t[-1]
    # Panels that grow away from the observer, where the air thins.
    edges = length * np.array([0.0, 0.02, 0.08, 0.25, 0.55, 1.0])
    star = np.array([sin(radians(sun)) * cos(radians(azimuth)), 0.0, cos(radians(sun))])
    across = sin(radians(sun)) * sin(radians(azimuth))
    total = 0.0
    for low, high in pairwise(edges):
        for x, w in zip(nodes, weights, strict=True):
            s = 0.5 * (low + high) + 0.5 * (high - low) * x
            r, psi, theta, *column = ray.sol(s)
            up = star[2] * cos(psi) + star[0] * sin(psi)
            along = star[0] * cos(psi) - star[2] * sin(psi)
            zenith = acos(up)
            seen, light = starlight(r, zenith)
            if light == 0.0:
                continue
            level = np.hypot(along, across)
            nu = cos(theta) * cos(seen) + sin(theta) * sin(seen) * along / level
            rho = densities(r)
            rayleigh = 3.0 / (16.0 * pi) * (1.0 + nu * nu)
            lobe = (1 - ASYMMETRY**2) / (4 * pi * (1 + ASYMMETRY**2 - 2 * ASYMMETRY * nu) ** 1.5)
            source = GAS * rho[0] * rayleigh + PARTICLES * rho[1] * lobe
            transmittance = exp(-float(COEFFICIENTS @ np.asarray(column)))
            total += 0.5 * (high - low) * w * source * transmittance * light
    return total


#: Altitude [m], zenith angles of view and star and azimuth [deg]: by day, along the horizon, into
#: the setting sun, in the twilight, from a balloon; all lines end in space, and no shadow's edge
#: crosses one of the panels above.
SIGHTS = [
    (0.0, 60.0, 30.0, 90.0),
    (0.0, 88.0, 88.0, 0.0),
    (0.0, 89.5, 89.9, 1.0),
    (0.0, 80.0, 91.0, 0.0),
    (10e3, 92.0, 89.0, 10.0),
    (0.0, 85.0, 95.0, 0.0),
]


@pytest.fixture(scope="module")
def bent(planet: Planet) -> MomentsSolution:
    return solve(planet, quality="default", cache=False)


@pytest.mark.parametrize(
    "line", [SIGHTS[0], *(pytest.param(one, marks=pytest.mark.slow) for one in SIGHTS[1:])]
)
def test_light_scattered_once_follows_rays_traced_step_by_step(
    line: tuple[float, float, float, float], bent: MomentsSolution
) -> None:
    # A second method, the ray equation in small steps: straight rays are off by up to 18 % here.
    # The march takes one scattering angle for the whole line, that at the observer: 0.2 %.
    altitude, view, sun, azimuth = line
    ours = bent.radiance(
        altitude=altitude, view_zenith=view, sun_zenith=sun, azimuth=azimuth, order=1
    )
    assert_allclose(ours.item(), once_scattered(*line), rtol=4e-3)


@pytest.mark.parametrize("view", [0.0, 75.0, 89.0, 90.0])
def test_transmittance_to_space_and_over_a_distance_is_that_of_the_traced_ray(
    view: float, bent: MomentsSolution
) -> None:
    # The same second method: the columns of the whole ray, and of its first 30 km.
    ray = follow(BOTTOM, radians(view) - (1e-7 if view == 90.0 else 0.0))
    for distance, columns in ((None, ray.y[3:, -1]), (30e3, ray.sol(30e3)[3:])):
        ours = bent.transmittance(altitude=0.0, view_zenith=view, distance=distance)
        assert_allclose(ours.item(), exp(-float(COEFFICIENTS @ columns)), rtol=1e-4)


@pytest.mark.parametrize("sun", [20.0, 85.0, 89.5, 90.2])
def test_the_ground_gets_the_light_of_the_lifted_and_squeezed_star(
    sun: float, bent: MomentsSolution
) -> None:
    # The traced ray again; the star is a point, seen at the cosine that the ray has at the ground.
    seen, light = starlight(BOTTOM, radians(sun))
    ours = bent.irradiance(altitude=0.0, sun_zenith=sun)["direct"]
    assert_allclose(ours.item(), light * cos(seen), rtol=5e-3)


def test_without_refractivity_nothing_is_bent(planet: Planet) -> None:
    # The limit n = 1: the two programs must give the same light.
    straight = replace(planet, refraction="none")
    faint = replace(AIR, refractivity=EXCESS * 1e-9, king_factor=1.0)
    thin = replace(planet.constituents[0], scattering=faint)
    given = Constituent(
        name="given", profile=thin.profile, scattering=GAS, phase_function=Rayleigh()
    )
    bent_hardly = replace(planet, constituents=(*planet.constituents[1:], given, thin))
    where = {"altitude": 0.0, "sun_zenith": [60.0, 89.0, 95.0], "view_zenith": 80.0}
    expected = solve(straight, quality="preview", cache=False).radiance(**where)
    ours = solve(bent_hardly, quality="preview", cache=False).radiance(**where)
    assert_allclose(np.asarray(ours), np.asarray(expected), rtol=2e-3)


@pytest.fixture(scope="module")
def histories(planet: Planet) -> MonteCarloSolution:
    settings = MonteCarloSettings(relative_error=3e-3)
    return solve(planet, quality=settings, solver="montecarlo")


@pytest.mark.parametrize("view", [90.0 - 1e-5, 85.0, 30.0])
def test_histories_are_bent_as_the_traced_ray_is(
    view: float, histories: MonteCarloSolution
) -> None:
    # The ray equation: the bending of a whole ray is the change of its direction in space; on the
    # horizon it is the astronomical refraction, 36.2' in this air.
    ray = follow(BOTTOM, radians(view))
    whole = ray.y[1, -1] + ray.y[2, -1] - radians(view)
    air = histories.airs[0]
    bottom, top = air.extinction.bottom, air.extinction.top
    mu = cos(radians(view))
    along = -bottom * mu + np.sqrt((top - bottom) * (top + bottom) + (bottom * mu) ** 2)
    found = refraction_on_path(bottom, mu, along, bottom, top - bottom, air.refraction)
    assert_allclose(found, whole, rtol=1e-4)


@pytest.mark.parametrize(
    "line", [SIGHTS[0], *(pytest.param(one, marks=pytest.mark.slow) for one in SIGHTS[1:])]
)
def test_histories_scatter_bent_light(
    line: tuple[float, float, float, float],
    histories: MonteCarloSolution,
    bent: MomentsSolution,
) -> None:
    # The first order is sampled along bent rays, and must be that of the ray equation; the sum of
    # all orders that of the moments solver, whose default is good to 0.5 % here. Three errors.
    altitude, view, sun, azimuth = line
    where = {"altitude": altitude, "view_zenith": view, "sun_zenith": sun, "azimuth": azimuth}
    found = histories.estimate(**where)
    first, error = (
        found[name].values.ravel()[0] for name in ("order_radiance", "order_standard_error")
    )
    assert abs(first - once_scattered(*line)) < 3.0 * error
    all_orders = bent.radiance(**where).item()
    allowed = 3.0 * found["standard_error"].item() + 5e-3 * all_orders
    assert abs(found["radiance"].item() - all_orders) < allowed


@pytest.mark.parametrize("sun", [20.0, 85.0, 89.5, 90.2])
def test_histories_ground_gets_the_light_of_the_lifted_and_squeezed_star(
    sun: float, histories: MonteCarloSolution
) -> None:
    # The traced ray, as for the moments solver above.
    seen, light = starlight(BOTTOM, radians(sun))
    mu_s = np.cos(np.radians([sun]))
    ours = histories.relative_direct_irradiance(np.array([BOTTOM]), mu_s)
    assert_allclose(ours.item(), light * cos(seen), rtol=5e-3)


def test_the_direct_solver_draws_straight_and_says_so(planet: Planet) -> None:
    # Light that goes straight is that of the planet without refraction; its report says nothing.
    straight = solve(replace(planet, refraction="none"), quality="preview", solver="direct")
    solution = solve(planet, quality="preview", solver="direct")
    assert "; refraction is ignored" in str(solution.report)
    assert "straight" not in str(straight.report)
    where = {"altitude": 0.0, "sun_zenith": [60.0, 89.0], "view_zenith": 80.0}
    assert_allclose(solution.radiance(**where), straight.radiance(**where), rtol=1e-12)


def test_the_setting_sun_s_disc_lights_the_ground_strip_by_strip() -> None:
    # A second method for straight light: the mean over seven strips of the disc, each through its
    # own air. Taking the disc's middle is off by up to 46 %; two points of its visible part by 1 %.
    planet = load_planet("earth", {"refraction": "none"})
    gas = tuple(one for one in planet.constituents if "aerosol" not in one.name)
    clear = replace(planet, constituents=gas)
    solution = solve(clear, quality="default", cache=False)
    mu_s = np.cos(np.radians([89.0, 89.8, 90.0, 90.15]))
    r = np.full(mu_s.size, clear.bottom_radius)
    strips = direct_irradiance(solution.medium, r, mu_s)
    assert_allclose(solution.relative_direct_irradiance(r, mu_s), strips, rtol=0.015)
