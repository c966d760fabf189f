"""Promises of a Monte Carlo solution: stops, seeds, threads, orders, clear refusals."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal, assert_array_less

from airlight import Cancelled, ParameterError, Planet, Scene, render, solve
from airlight.solver.montecarlo.settings import QUALITIES, MonteCarloSettings, settings_for

WHERE: dict[str, Any] = {
    "altitude": [0.0, 0.0, 500e3],
    "sun_zenith": [40.0, 92.0, 60.0],
    "view_zenith": [60.0, 75.0, 150.0],
    "azimuth": 60.0,
}
QUICK = MonteCarloSettings(relative_error=0.01, most_histories=60_000)


@pytest.fixture(scope="module")
def earth(reference_earth: Callable[..., Planet]) -> Planet:
    return reference_earth(albedo=0.1)


def test_one_thread_and_two_give_the_same_bits(
    earth: Planet, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Blocks have streams of their own and are added in their order: a law of the design.
    results = []
    for threads in ("1", "2"):
        monkeypatch.setenv("AIRLIGHT_THREADS", threads)
        results.append(solve(earth, [680.0, 440.0], QUICK, solver="montecarlo").estimate(**WHERE))
    for name in results[0]:
        assert_array_equal(results[0][name].values, results[1][name].values)


def test_the_same_question_has_the_same_answer_in_any_company(earth: Planet) -> None:
    # Streams belong to the query: alone, or in a list and beside another wavelength.
    many = solve(earth, [680.0, 440.0], QUICK, solver="montecarlo").estimate(**WHERE)
    alone = solve(earth, [440.0], QUICK, solver="montecarlo").estimate(
        altitude=0.0, sun_zenith=92.0, view_zenith=75.0, azimuth=60.0
    )
    second = many["order_radiance"].sel(order=2).values
    # coefficients may differ in their last bit; other random numbers would differ by 1e-2
    assert_allclose(alone["order_radiance"].sel(order=2).values[0], second[1, 1], rtol=1e-12)
    # the quadrature of the first order refines its panels for all wavelengths together: 1e-6
    assert_allclose(alone["radiance"].values[0], many["radiance"].values[1, 1], rtol=1e-6)


@pytest.mark.slow
def test_seeds_give_independent_answers_with_honest_errors(earth: Planet) -> None:
    # Twelve seeds: the scatter of the answers is the standard error, by its definition; χ² with
    # eleven degrees of freedom is between 1.8 and 33 with a probability of 0.999.
    answers, errors = [], []
    for seed in range(12):
        settings = MonteCarloSettings(relative_error=1.0, most_histories=16_384, seed=seed)
        data = solve(earth, [440.0], settings, solver="montecarlo").estimate(**WHERE)
        answers.append(data["radiance"].values[0, 0])
        errors.append(data["standard_error"].values[0, 0])
    scatter = np.square((np.array(answers) - np.mean(answers)) / np.mean(errors)).sum()
    assert 1.8 < scatter < 33.0


def test_it_stops_at_the_error_asked_for(earth: Planet) -> None:
    # The promise of the settings: every line and wavelength within it, and not far below.
    solution = solve(
        earth, [680.0, 440.0], MonteCarloSettings(relative_error=0.002), solver="montecarlo"
    )
    data = solution.estimate(**WHERE)
    relative = (data["standard_error"] / data["radiance"]).values
    assert_array_less(relative, 0.002)
    assert relative.max() > 0.0005
    assert data["reached"].values.all()
    assert solution.report.unreached == 0
    assert_allclose(max(solution.report.residual), relative.max(), rtol=1e-12)
    # a line of sight that is easy gets fewer histories than twilight
    assert data["histories"].values[0, 0] < data["histories"].values[1, 1]


def test_what_is_not_reached_is_said(earth: Planet) -> None:
    # Far too few histories for twilight: the bound holds and the report names the failure.
    solution = solve(
        earth,
        [440.0],
        MonteCarloSettings(relative_error=1e-4, most_histories=20_000),
        solver="montecarlo",
    )
    data = solution.estimate(**WHERE)
    assert data["histories"].values.max() <= 20_000
    assert not data["reached"].values.any()
    assert "3 of 3 lines of sight NOT within the requested error" in str(solution.report)
    assert data.attrs["solver"] == solution.report.provenance


def test_orders_add_up_to_the_radiance(earth: Planet) -> None:
    # By definition; the kept ones, one by one, and all further ones together.
    settings = MonteCarloSettings(relative_error=0.01, kept_orders=3)
    solution = solve(earth, [440.0], settings, solver="montecarlo")
    data = solution.estimate(**WHERE)
    orders = data["order_radiance"]
    assert orders.dims == ("case", "order", "wavelength")
    assert_array_equal(orders["order"].values, [1, 2, 3])
    assert (data["higher_radiance"].values > 0.0).all()
    total = orders.sum("order") + data["higher_radiance"]
    assert_allclose(total.values, data["radiance"].values, rtol=1e-12)
    assert_array_equal(data["order_standard_error"].sel(order=1).values, 0.0)  # by quadrature
    assert (data["order_standard_error"].sel(order=2).values > 0.0).all()
    assert solution.highest_order == 3
    second = solution.radiance(**WHERE, order=2)
    bound = 4.0 * np.hypot(data["order_standard_error"].sel(order=2), 0.01 * second).values
    assert_array_less(np.abs(second - orders.sel(order=2)).values, bound)
    with pytest.raises(ParameterError, match="order is 4; allowed: 1 to 3"):
        solution.radiance(**WHERE, order=4)


def test_a_line_that_misses_the_air_costs_nothing(earth: Planet) -> None:
    # There is nothing there.
    data = solve(earth, [550.0], QUICK, solver="montecarlo").estimate(
        altitude=500e3, sun_zenith=30.0, view_zenith=20.0
    )
    assert_array_equal(data["radiance"].values, 0.0)
    assert_array_equal(data["histories"].values, 0)
    assert data["reached"].values.all()


@pytest.mark.slow
def test_sky_irradiance_is_the_integral_of_the_sky(earth: Planet) -> None:
    # A second way: 8 x 8 directions of the radiance itself; 3 standard errors.
    from airlight.geometry.quadrature import gauss_legendre

    solution = solve(earth, [550.0], QUICK, solver="montecarlo")
    diffuse = float(solution.irradiance(altitude=0.0, sun_zenith=70.0)["diffuse"].values[0])
    error = max(solution.report.residual) * diffuse
    rule = gauss_legendre(8)
    around = (np.arange(8) + 0.5) * 22.5
    mu, azimuth = np.meshgrid(rule.nodes, around, indexing="ij")
    data = solution.estimate(
        altitude=0.0, sun_zenith=70.0, view_zenith=np.degrees(np.arccos(mu)), azimuth=azimuth
    )
    share = 2.0 * np.pi * rule.weights * rule.nodes
    flux = float(share @ data["radiance"].values[..., 0].mean(axis=1))
    # the aureole of the aerosol is between the directions: 2 %
    assert_allclose(diffuse, flux, rtol=0.02, atol=3.0 * error)


def test_progress_is_told_and_cancel_is_heard(earth: Planet) -> None:
    # The contract of long work.
    reported: list[tuple[int, int, str]] = []
    solution = solve(
        earth, [550.0], QUICK, solver="montecarlo", progress=lambda *one: reported.append(one)
    )
    solution.radiance(**WHERE)
    done = [one[0] for one in reported if one[2] == "histories"]
    assert done == sorted(done)
    assert done[-1] == reported[-1][1]
    stopped = solve(earth, [550.0], QUICK, solver="montecarlo", cancel=lambda: True)
    with pytest.raises(Cancelled):
        stopped.radiance(**WHERE)


def test_a_solver_is_chosen_by_name(earth: Planet) -> None:
    # One line that names what is allowed.
    with pytest.raises(ParameterError, match=r"solver is 'magic'; allowed: moments, .*montecarlo"):
        solve(earth, solver="magic")
    with pytest.raises(ParameterError, match="quality is 'best'; allowed: preview, default, fine"):
        solve(earth, quality="best", solver="montecarlo")
    assert settings_for("fine") is QUALITIES["fine"]


@pytest.mark.parametrize(
    ("field", "value"),
    [("relative_error", 0.0), ("relative_error", 2.0), ("relative_error", float("nan")),
     ("most_histories", 10), ("seed", -1), ("seed", 1.5), ("kept_orders", 0)],
)  # fmt: skip
def test_impossible_settings_are_refused(field: str, value: Any) -> None:
    # Name, value and range in one line.
    with pytest.raises(ParameterError, match=field):
        MonteCarloSettings(**{field: value})


def test_a_picture_needs_the_moments(earth: Planet) -> None:
    # A picture marches the moments: another solution is refused in words.
    solution = solve(earth, [680.0, 550.0, 440.0], QUICK, solver="montecarlo")
    with pytest.raises(ParameterError, match=r"solution is 'montecarlo'; allowed: .*moments"):
        render(solution, Scene())  # type: ignore[arg-type]
