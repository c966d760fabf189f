"""The direct solver: laws, golden numbers, and the bookkeeping of orders."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import Cancelled, ConvergenceError, Medium, ParameterError, Planet, solve
from airlight.planets import Constituent, Ground, Star
from airlight.planets.matter.phases import Rayleigh
from airlight.planets.matter.profiles import Exponential, Uniform
from airlight.solver.direct.settings import ATMOSPHERE_PLUS, QUALITIES, DirectSettings
from airlight.solver.direct.solution import DirectSolution, alone
from airlight.solver.direct.solution import solve as solve_medium

RGB = (680.0, 550.0, 440.0)
COARSE = QUALITIES["preview"]
#: From the ground and from space, by day and at dusk. [m, deg, deg, deg]
WHERE = {
    "altitude": [0.0, 0.0, 0.0, 2000.0, 30e3, 400e3, 400e3],
    "sun_zenith": [20.0, 60.0, 88.0, 75.0, 92.0, 40.0, 80.0],
    "view_zenith": [50.0, 85.0, 30.0, 120.0, 80.0, 180.0, 109.0],
    "azimuth": [90.0, 10.0, 180.0, 45.0, 0.0, 0.0, 120.0],
}


def air(scattering: float, albedo: float, absorption: float = 0.0) -> Planet:
    """Gas alone in a shell of 60 km around a planet of Earth's size."""
    return Planet(
        name="gas",
        bottom_radius=6360e3,
        top_radius=6420e3,
        ground=Ground(albedo=albedo),
        star=Star(irradiance=1.0, angular_radius=0.0),
        constituents=(
            Constituent(
                name="gas",
                profile=Exponential(scale_height=8e3),
                scattering=scattering,
                absorption=absorption,
                phase_function=Rayleigh(),
            ),
        ),
    )


@cache
def solved(planet: Planet, settings: DirectSettings = COARSE) -> DirectSolution:
    return solve_medium(Medium.from_planet(planet, [550.0]), settings, cache=False)


def test_orders_add_up_to_the_whole() -> None:
    # The sum of all orders and the geometric rest; without a tail the rest is what is missing.
    solution = solved(air(2e-5, 0.3), replace(COARSE, tolerance=1e-4, tail=False))
    parts = sum(
        solution.radiance(**WHERE, order=k).values for k in range(1, solution.highest_order + 1)
    )
    # Logarithms of sums and sums of logarithms interpolate differently by the square of a step.
    assert_allclose(parts, solution.radiance(**WHERE).values, rtol=2e-3)
    tailed = solved(air(2e-5, 0.3), replace(COARSE, tolerance=2e-2))
    assert tailed.report.sweeps < solution.report.sweeps
    assert_allclose(tailed.radiance(**WHERE).values, solution.radiance(**WHERE).values, rtol=3e-3)


def test_each_order_goes_with_a_power_of_the_thickness() -> None:
    # In thin air over black ground order k is proportional to the k-th power of the coefficient.
    thin, thinner = (solved(air(x, 0.0), replace(COARSE, orders=3)) for x in (2e-8, 1e-8))
    for order in (1, 2, 3):
        ratio = (
            thin.radiance(**WHERE, order=order).values
            / thinner.radiance(**WHERE, order=order).values
        )
        assert_allclose(ratio, 2.0**order, rtol=5e-3)


def test_ground_without_air_is_lit_once() -> None:
    # A Lambert ground under a bare sky: albedo cos(60°)/π, and nothing of any other order.
    solution = solved(air(1e-13, 0.4))
    seen = {"altitude": 400e3, "sun_zenith": 60.0, "view_zenith": 180.0}
    assert_allclose(solution.radiance(**seen, order=1).values, 0.4 * 0.5 / np.pi, rtol=1e-6)
    assert float(solution.radiance(**seen, order=2).values[0]) < 1e-7


def test_printed_bookkeeping_agrees_over_black_ground_and_loses_light_over_white() -> None:
    # The printed orders differ from the corrected ones in ground light alone: D joins one order
    # late, and A⁽²⁾ never lights the air, which then is darker.
    for albedo in (0.0, 0.8):
        right = solved(air(3e-5, albedo)).radiance(**WHERE).values
        printed = solved(air(3e-5, albedo), replace(COARSE, literal="atmosphere-plus-2"))
        got = printed.radiance(**WHERE).values
        if albedo == 0.0:
            assert_allclose(got, right, rtol=1e-12)
        else:
            assert (got < right * (1.0 - 1e-4)).all()
            assert (got > 0.8 * right).all()


@pytest.mark.slow
def test_first_notes_are_the_sum_of_planets_of_one_constituent(
    reference_earth: Callable[..., Planet],
) -> None:
    # Each constituent gathers and attenuates itself only. The haze no longer dims the gas, so the
    # whole is too bright by day, by the haze's optical depth or so.
    medium = Medium.from_planet(reference_earth(albedo=0.0, ozone=False), RGB)
    printed = solve_medium(medium, replace(COARSE, literal="atmosphere-plus-1"), cache=False)
    parts = sum(
        solve_medium(alone(medium, i), COARSE, cache=False).radiance(**WHERE).values for i in (0, 1)
    )
    assert_allclose(printed.radiance(**WHERE).values, parts, rtol=1e-12)
    right = solve_medium(medium, COARSE, cache=False).radiance(**WHERE).values
    assert (printed.radiance(**WHERE).values[:2] > 1.005 * right[:2]).all()


@pytest.mark.parametrize(
    "mapping",
    [
        pytest.param("linear", marks=pytest.mark.slow),
        "power",
        pytest.param("weighted-power", marks=pytest.mark.slow),
        pytest.param("bruneton", marks=pytest.mark.slow),
    ],
)
def test_the_notes_tables_give_the_sky_within_their_error(mapping: str) -> None:
    # Against the angle mapping of the same solver, over the table's own azimuth. The notes' steps
    # of 3 km and equal directions leave ten per cent, the linear mapping more near the horizon.
    reference = solved(air(1.2e-5, 0.1), QUALITIES["default"])
    views = np.array([0.0, 30.0, 60.0, 75.0, 85.0])
    seen = {"altitude": 0.0, "sun_zenith": 50.0, "view_zenith": views, "azimuth": 0.0}
    if mapping == "bruneton":
        settings = replace(COARSE, mapping=mapping, views=64, scatter_angles=8)
    else:
        settings = replace(ATMOSPHERE_PLUS, mapping=mapping)
    error = solved(air(1.2e-5, 0.1), settings).radiance(**seen).values / (
        reference.radiance(**seen).values
    )
    assert_allclose(error, 1.0, atol=0.02 if mapping == "bruneton" else 0.15)


@pytest.mark.slow
def test_flux_in_equals_flux_out() -> None:
    # Conservative air over white ground: what the ground receives it sends back, and nothing is
    # lost on the way. Net flux at the ground is 0 by the albedo; at the top it must be as well.
    solution = solved(air(2e-5, 1.0), QUALITIES["default"])
    top = solution.medium.top_radius
    mu, weights = np.polynomial.legendre.leggauss(24)
    around = (np.arange(24) + 0.5) * np.pi / 12.0
    # All that leaves upwards through the top of a sphere under parallel light: the planet's disc
    # receives π R² E, so the mean over sun zeniths counts; 32 suns by Gauss.
    suns, sun_weights = np.polynomial.legendre.leggauss(32)
    leaving = np.zeros(1)
    for mu_s, weight in zip(suns, sun_weights, strict=True):
        up = -0.5 * (mu - 1.0)
        zenith = np.degrees(np.arccos(up))
        light = solution.radiance(
            altitude=top - solution.medium.bottom_radius, sun_zenith=np.degrees(np.arccos(mu_s)),
            view_zenith=(180.0 - zenith)[:, None], azimuth=np.degrees(around)[None],
        ).values[..., 0]  # fmt: skip
        flux = (0.5 * weights[:, None] * up[:, None] * light).sum() * np.pi / 12.0
        leaving += 2.0 * np.pi * weight * flux
    # Light that enters: the disc of the shell less what passes the planet without being scattered.
    angle = (np.arange(400) + 0.5) / 400.0
    impact = solution.medium.bottom_radius + angle * 60e3
    dip = np.degrees(np.arcsin(impact / top))
    transmittance = solution.transmittance(altitude=60e3, view_zenith=180.0 - dip).values[:, 0]
    taken = (
        np.pi * (solution.medium.bottom_radius / top) ** 2
        + (2.0 * np.pi * impact / top**2 * (1.0 - transmittance) * 60e3 / 400.0).sum()
    )
    assert_allclose(leaving, taken, rtol=5e-3)


@pytest.mark.validation
def test_sky_irradiance_is_the_integral_of_the_sky(reference_earth: Callable[..., Planet]) -> None:
    # The moments solver, a second method with irradiance from its own sweep.
    planet = reference_earth(albedo=0.1)
    asked = {"altitude": [0.0, 0.0, 5e3], "sun_zenith": [30.0, 75.0, 60.0]}
    direct = solve(planet, RGB[::2], solver="direct", cache=False).irradiance(**asked)
    moments = solve(planet, RGB[::2], cache=False).irradiance(**asked)
    assert_allclose(direct["direct"].values, moments["direct"].values, rtol=2e-3)
    assert_allclose(direct["diffuse"].values, moments["diffuse"].values, rtol=1e-2)


def test_one_order_on_the_notes_table_takes_less_than_a_minute(
    reference_earth: Callable[..., Planet], tell: Callable[[str], None]
) -> None:
    # The bar: 32 x 64 x 32 texels, 12 x 24 directions, on two cores.
    from time import perf_counter

    medium = Medium.from_planet(reference_earth(albedo=0.1), RGB)
    settings = replace(ATMOSPHERE_PLUS, orders=1)
    solve_medium(medium, replace(settings, radii=4), cache=False)  # compiles
    started = perf_counter()
    solve_medium(medium, settings, cache=False)
    seconds = perf_counter() - started
    tell(f"direct solver: an order of 32 x 64 x 32 texels, 12 x 24 directions: {seconds:.1f} s")
    assert seconds < 60.0


def test_cache_gives_the_same_back() -> None:
    planet = air(1.1e-5, 0.2)
    first = solve(planet, [550.0], COARSE, solver="direct")
    second = solve(planet, [550.0], COARSE, solver="direct")
    assert first.report.seconds > 0.0
    assert second.report.seconds == 0.0
    # The same tables; where an array lies in memory decides how a sum is put into lanes.
    assert_allclose(second.radiance(**WHERE).values, first.radiance(**WHERE).values, rtol=1e-14)
    assert second.highest_order == first.highest_order


def test_cancelling_stops_at_once() -> None:
    with pytest.raises(Cancelled):
        solve_medium(
            Medium.from_planet(air(1e-5, 0.1), [550.0]), COARSE, cache=False, cancel=lambda: True
        )


def test_what_does_not_fall_is_an_error() -> None:
    # Conservative air of optical depth 6 over white ground: each order is nearly the one before.
    planet = Planet(
        name="milk",
        bottom_radius=6360e3,
        top_radius=6420e3,
        ground=Ground(albedo=1.0),
        star=Star(irradiance=1.0, angular_radius=0.0),
        constituents=(
            Constituent(name="milk", profile=Uniform(), scattering=1e-4, phase_function=Rayleigh()),
        ),
    )
    with pytest.raises(ConvergenceError, match="do not decrease"):
        solved(planet, replace(COARSE, orders=12))


@pytest.mark.parametrize(
    ("field", "value"),
    [("mapping", "cubic"), ("views", 31), ("radii", 1), ("power", 0.5), ("literal", "openspace"),
     ("tolerance", 0.0), ("azimuth", 200.0), ("scatter_angles", 0)],
)  # fmt: skip
def test_bad_settings_name_the_field(field: str, value: object) -> None:
    with pytest.raises(ParameterError, match=field):
        replace(COARSE, **{field: value})
    with pytest.raises(ParameterError, match="order"):
        solved(air(1e-5, 0.1)).radiance(**WHERE, order=99)
