"""Monte Carlo histories through three-dimensional clouds."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal, assert_array_less

from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_layer import CloudLayer
from airlight.clouds.cloud_optics import CloudOptics
from airlight.errors import ConflictError, ParameterError
from airlight.kernel import compiled_loop
from airlight.planets import Constituent, Medium, Planet, load_planet, replace
from airlight.planets.matter.phases import HenyeyGreenstein
from airlight.planets.matter.profiles import Layered
from airlight.planets.matter.profiles.layered import Layer
from airlight.solver.montecarlo.cloud_cells import cloud_cells
from airlight.solver.montecarlo.cloud_rays import cloud_collision, cloud_depth
from airlight.solver.montecarlo.cloudy_air import Areas, CloudyAir
from airlight.solver.montecarlo.settings import MonteCarloSettings
from airlight.solver.montecarlo.solution import MonteCarloSolution
from airlight.solver.montecarlo.streams import stream
from airlight.validation.i3rc import Experiment
from airlight.validation.i3rc_monte_carlo import cloudy_experiment, every, result

BASE, DEPTH = 1000.0, 600.0


def optics(albedo: float = 1.0, asymmetry: float = 0.7) -> CloudOptics:
    """Optical properties at 550 nm."""
    return CloudOptics(
        wavelengths=np.array([550.0]),
        extinction=np.ones(1),
        albedo=np.array([albedo]),
        phase=HenyeyGreenstein(asymmetry=asymmetry),
    )


def field(extinction: np.ndarray, **keywords: object) -> CloudField:
    """Field of cells of 200, 300 and 150 m."""
    given = {"spacing": (200.0, 300.0, 150.0), "base": BASE, "beyond": "periodic", **keywords}
    return CloudField(extinction=np.asarray(extinction, np.float32), **given)  # type: ignore[arg-type]


def cloudy(
    planet: Planet, cloud: CloudField, error: float = 0.01, *, polarised: bool = False,
    **matter: float,
) -> CloudyAir:  # fmt: skip
    """The planet at 550 nm with a cloud."""
    settings = MonteCarloSettings(
        relative_error=error, polarisation=polarised, exact_first_order=False
    )
    solution = MonteCarloSolution(Medium.from_planet(planet, [550.0]), settings)
    return CloudyAir(solution, [CloudLayer(cloud, optics(**matter))])


@compiled_loop
def depths(points, directions, end, clouds, out):
    """Optical depths of rays."""
    for k in range(out.size):
        p, d = points[k], directions[k]
        out[k] = cloud_depth((p[0], p[1], p[2]), (d[0], d[1], d[2]), end, clouds)


@compiled_loop
def escapes(points, directions, end, clouds, count, state, out):
    """Fraction of rays without a collision."""
    for k in range(out.size):
        p, d = points[k], directions[k]
        for _ in range(count):
            hit, _ = cloud_collision((p[0], p[1], p[2]), (d[0], d[1], d[2]), end, clouds, state)
            out[k] += (hit < 0) / count


@pytest.mark.parametrize("beyond", ["clear", "periodic"])
@pytest.mark.parametrize("interpolated", [False, True])
@pytest.mark.parametrize("radius", [6.36e6, 6.36e9])
def test_rays_through_cells_obey_beer(radius: float, interpolated: bool, beyond: str) -> None:
    # A second method: the sum of ``CloudField.at`` over 40000 points of a ray; steps of 0.5 m over
    # faces at which extinction jumps by 2e-3 /m. Collisions: exp(-depth), 4.5 standard errors.
    rng = np.random.default_rng(1)
    cloud = field(2e-3 * rng.random((20, 12, 13)) ** 4, beyond=beyond, interpolated=interpolated)
    cells = cloud_cells([cloud], np.eye(3)[None], radius)
    n, end = 30, 20e3
    points = np.stack([*rng.uniform(-5e3, 5e3, (2, n)), np.full(n, radius)], axis=1)
    points *= ((radius + rng.uniform(0.0, 4e3, n)) / np.linalg.norm(points, axis=1))[:, None]
    directions = rng.normal(size=(n, 3))
    directions[4:12, 2] *= 0.05
    directions[0], directions[1], directions[2] = (0, 0, 1), -points[1], (1, 0, 0)
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    got, free = np.empty(n), np.zeros(n)
    depths(points, directions, end, cells, got)
    escapes(points, directions, end, cells, 10_000, stream(3), free)
    s = (np.arange(40_000) + 0.5) * (end / 40_000)
    expected = np.empty(n)
    for k in range(n):
        x, y, z = points[k][:, None] + s * directions[k][:, None]
        r = np.sqrt(x * x + y * y + z * z)
        expected[k] = cloud.at(radius * x / z, radius * y / z, r - radius).sum() * (s[1] - s[0])
    assert expected.max() > 0.2
    assert_allclose(got, expected, rtol=0, atol=2e-3)
    light = np.exp(-got)
    error = np.sqrt(np.maximum(light * (1.0 - light), 1e-3) / 10_000)
    assert_array_less(np.abs(free - light), 4.5 * error)


@pytest.mark.slow
def test_uniform_cloud_is_a_layer_of_the_atmosphere(
    one_air: Callable[..., Planet], tell: Callable[[str], None]
) -> None:
    # A second method: the same cloud as a constituent, spherical geometry, gas and ground; 3.5
    # combined standard errors of 1.5 %.
    clear = one_air(depth=0.3, albedo=0.3)
    coefficient = 4.0 / DEPTH
    layers = (
        Layer(width=BASE),
        Layer(width=DEPTH, constant_term=1.0),
        Layer(),
    )
    cloud = Constituent(
        name="cloud",
        profile=Layered(layers=layers),
        scattering=0.9 * coefficient,
        absorption=0.1 * coefficient,
        phase_function=HenyeyGreenstein(asymmetry=0.7),
    )
    layered = replace(clear, constituents=(*clear.constituents, cloud))
    settings = MonteCarloSettings(relative_error=0.015, polarisation=False, exact_first_order=False)
    judge = MonteCarloSolution(Medium.from_planet(layered, [550.0]), settings)
    altitude, view = np.array([0.0, 0.0, 1300.0, 300e3]), np.array([0.0, 65.0, 100.0, 140.0])
    known = judge.radiance(altitude=altitude, sun_zenith=50.0, view_zenith=view, azimuth=60.0)
    uniform = field(np.full((5, 4, 4), coefficient), latitude=40.0, longitude=20.0)
    got = cloudy(clear, uniform, 0.015, albedo=0.9).radiance(
        latitude=40.0, longitude=20.0, altitude=altitude, view_zenith=view, azimuth=150.0,
        sun_zenith=50.0, sun_azimuth=90.0,
    )  # fmt: skip
    off = got.total[:, 0] - known.values[:, 0]
    error = np.hypot(got.total_error[:, 0], known["standard_error"].values[:, 0])
    tell(f"uniform cloud and layer: {off / known.values[:, 0]} ± {error / known.values[:, 0]}")
    assert_array_less(error, 0.03 * known.values[:, 0])
    assert_array_less(np.abs(off), 3.5 * error)


def test_cloud_of_no_depth_changes_nothing(one_air: Callable[..., Planet]) -> None:
    # Optical depth 1e-6; 3.5 combined standard errors of 1 %.
    planet = one_air(depth=0.3, albedo=0.3)
    altitude, view = [0.0, 20e3], [70.0, 130.0]
    thin = cloudy(planet, field(np.full((2, 2, 2), 1e-6 / 300.0)))
    clear = thin.solution.radiance(
        altitude=altitude, view_zenith=view, sun_zenith=60.0, azimuth=0.0
    )
    got = thin.radiance(
        latitude=0.0, longitude=0.0, altitude=altitude, view_zenith=view, azimuth=90.0,
        sun_zenith=60.0, sun_azimuth=90.0,
    )  # fmt: skip
    error = np.hypot(got.total_error[:, 0], clear["standard_error"].values[:, 0])
    assert_array_less(error, 0.02 * clear.values[:, 0])
    assert_array_less(np.abs(got.total[:, 0] - clear.values[:, 0]), 3.5 * error)


@pytest.mark.parametrize("view", [65.0, 140.0, 180.0])
def test_polarisation_through_an_empty_box_is_that_of_clear_sky(
    view: float, one_air: Callable[..., Planet]
) -> None:
    # I, Q and U of the same air without a box, on both sides of the star and in a vertical line;
    # 4.5 combined standard errors, below 2 % of I. The last two are mirror images: U changes sign.
    planet, azimuth = one_air(depth=0.3, albedo=0.3), np.array([-100.0, -40.0, 40.0])
    altitude = 0.0 if view < 90.0 else 20e3
    thin = cloudy(planet, field(np.full((2, 2, 2), 1e-9), latitude=30.0), polarised=True)
    clear = thin.solution.radiance(
        altitude=altitude, view_zenith=view, sun_zenith=60.0, azimuth=azimuth, stokes=True
    )
    got = thin.radiance(
        latitude=30.0, longitude=0.0, altitude=altitude, view_zenith=view, azimuth=azimuth + 130.0,
        sun_zenith=60.0, sun_azimuth=130.0,
    )  # fmt: skip
    known, noise = clear.values[..., 0], clear["standard_error"].values[..., 0]
    found = np.concatenate([got.total, got.polarised[..., 0]], axis=1)
    error = np.hypot(np.concatenate([got.total_error, got.polarised_error[..., 0]], axis=1), noise)
    light = known[:, :1]
    assert_array_less(error, 0.02 * light + 0.0 * error)
    assert_array_less(np.abs(found - known), 4.5 * error)
    assert_array_less(8.0 * error[1:, 2], np.abs(found[1:, 2]))  # the sign of U is tested
    assert_allclose(found[1, 2], -found[2, 2], rtol=0, atol=4.5 * np.hypot(*error[1:, 2]))


def broken_cloud(interpolated: bool = False) -> CloudField:
    """Periodic field of optical depths 0 to about 12."""
    rng = np.random.default_rng(4)
    return field(0.02 * rng.random((6, 5, 4)) ** 2, interpolated=interpolated)


@pytest.mark.parametrize("interpolated", [False, True])
def test_conservative_cloud_keeps_energy(
    interpolated: bool, one_air: Callable[..., Planet], tell: Callable[[str], None]
) -> None:
    # R + T = 1 over a flat black ground without air; 3.5 standard errors of 1.5 %.
    cloud = broken_cloud(interpolated)
    air = cloudy(one_air(depth=0.0, bottom=6.36e9), cloud, 0.015)
    box, sun = Areas.box(cloud), {"sun_zenith": 50.0, "sun_azimuth": 200.0}
    up = air.irradiance_over(box, altitude=cloud.top, upward=True, **sun)
    down = air.irradiance_over(box, altitude=0.0, upward=False, **sun)
    direct = air.direct_over(box, altitude=0.0, **sun)
    total = float(up.total[0, 0] + down.total[0, 0] + direct[0, 0]) / np.cos(np.radians(50.0))
    error = float(np.hypot(up.total_error[0, 0], down.total_error[0, 0])) / 0.64
    tell(f"R + T of a conservative cloud: {total:.4f} ± {error:.4f}")
    assert error < 0.018
    assert_allclose(total, 1.0, rtol=0, atol=3.5 * error)


def test_light_goes_both_ways(one_air: Callable[..., Planet]) -> None:
    # Reciprocity of the mean reflected radiance: L over the cosine of the sun's zenith angle is
    # the same after sun and view have changed places; 3.5 combined standard errors of 1.5 %.
    cloud = broken_cloud()
    air = cloudy(one_air(depth=0.0, bottom=6.36e9, albedo=0.2), cloud, 0.015)
    ways = ((60.0, 40.0), (25.0, 170.0))
    found = []
    for (sun, sun_azimuth), (view, azimuth) in (ways, ways[::-1]):
        got = air.radiance_over(
            Areas.box(cloud), altitude=cloud.top, view_zenith=180.0 - view, azimuth=azimuth + 180.0,
            sun_zenith=sun, sun_azimuth=sun_azimuth,
        )  # fmt: skip
        found.append(np.array([got.total[0, 0], got.total_error[0, 0]]) / np.cos(np.radians(sun)))
    assert_allclose(found[0][0], found[1][0], rtol=0, atol=3.5 * np.hypot(found[0][1], found[1][1]))


def test_shadow_of_a_cloud_lies_opposite_the_sun(one_air: Callable[..., Planet]) -> None:
    # An opaque column 2 km north and 1 km high: at 63.4° its shadow falls on a sensor to the south
    # only from the north, and a view to the north finds it before the sky.
    opaque = np.zeros((1, 21, 4))
    opaque[0, 17] = 1.0
    cloud = field(
        opaque, beyond="clear", interpolated=False, latitude=-30.0, longitude=120.0,
        spacing=(300.0, 300.0, 150.0),
    )  # fmt: skip
    air = cloudy(one_air(depth=0.1), cloud, 0.05, albedo=0.0)
    direct = [
        float(
            air.direct_over(Areas.at(0.0, 0.0), altitude=0.0, sun_zenith=58.0, sun_azimuth=a)[0, 0]
        )
        for a in (0.0, 90.0, 180.0, 270.0)
    ]
    assert direct[0] < 1e-30
    assert_allclose(direct[1:], direct[1], rtol=1e-9)
    views = air.radiance(
        latitude=-30.0, longitude=120.0, altitude=0.0, view_zenith=58.0,
        azimuth=[0.0, 90.0, 180.0], sun_zenith=20.0, sun_azimuth=180.0,
    )  # fmt: skip
    assert_array_less(views.total[0, 0], 0.3 * views.total[1:, 0])


def test_results_repeat_and_differ_between_columns(one_air: Callable[..., Planet]) -> None:
    # Same seed, same numbers; columns of a uniform field have the same light but other errors.
    cloud = field(np.full((3, 1, 2), 5e-3))
    air = cloudy(one_air(depth=0.0, bottom=6.36e9), cloud, 0.05)
    sun = {"sun_zenith": 30.0, "sun_azimuth": 0.0}
    first, second = (
        air.irradiance_over(Areas.columns(cloud), altitude=0.0, upward=False, **sun).total
        for _ in range(2)
    )
    assert_array_equal(first, second)
    assert np.unique(first).size == 3


@pytest.mark.slow
def test_step_cloud_of_i3rc(tell: Callable[[str], None]) -> None:
    # The consensus of I3RC, case 1, experiment 2: three standard errors of 3 %, and 2 %.
    experiment = Experiment(1, 2)
    cloud = cloudy_experiment(experiment, 0.03)
    for quantity in ("R", "Id", "I602"):
        known = experiment.results[quantity][::8]
        got = result(cloud, experiment, quantity, every(Areas.columns(experiment.field), 8))
        tell(f"{experiment}, {quantity}: {np.round(got.value / known, 3)}")
        assert_array_less(np.abs(got.value - known), 3.0 * got.error + 0.02 * known)


def test_refraction_and_clouds_above_the_air_are_refused(one_air: Callable[..., Planet]) -> None:
    with pytest.raises(ParameterError, match="top of a cloud"):
        cloudy(one_air(thickness=1500.0), field(np.ones((1, 1, 4))))
    earth = load_planet("earth")
    if Medium.from_planet(earth, [550.0]).refracting_shell is None:
        pytest.skip("the preset does not refract")
    with pytest.raises(ConflictError, match="refraction"):
        cloudy(earth, field(np.ones((1, 1, 4))))
