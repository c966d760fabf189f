"""The comparison of solvers: who agrees by hand-made answers, and two real solvers that do."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.errors import Cancelled
from airlight.planets import Medium, load_planet
from airlight.validation import solvers as module
from airlight.validation.agreement import Agreement, Result, agreements
from airlight.validation.cases import Case
from airlight.validation.planets import with_point_star
from airlight.validation.solvers import finite_disc, solvers
from airlight.validation.suite import SuiteRun

pytest.importorskip("matplotlib")

FOUR = (
    Case(0.0, 30.0, 0.0),
    Case(0.0, 60.0, 60.0),
    Case(10e3, 80.0, 90.0),
    Case("top", 0.0, 180.0),
)


def answer(name: str, radiance: list[float], error: float = 0.0) -> Result:
    values = np.repeat(np.array(radiance)[:, None], 3, axis=1)
    return Result(name, "by hand", values, np.full_like(values, error) * values, 1.0)


def test_values_disagree_only_beyond_one_per_cent_and_three_standard_errors() -> None:
    # By hand, noise 0.5 %: 0.9 % off agrees, 1.4 % is 2.8 errors and agrees, 2 % is four and does
    # not; below 1e-6 nobody judges.
    truth = answer("montecarlo", [1.0, 1.0, 1.0, 1e-7], 0.005)
    ours = answer("moments", [1.009, 1.014, 0.98, 2e-7])
    (pair,) = agreements([ours, truth])
    assert_array_equal(pair.disagree[:, 0], [False, False, True, False])
    assert_allclose(pair.relative[:3, 0], [0.009, 0.014, -0.02], rtol=1e-9)
    assert_allclose(pair.in_errors[:3, 0], [1.8, 2.8, -4.0], rtol=1e-9)


def test_without_noise_one_per_cent_decides_and_nothing_is_no_agreement() -> None:
    pair = Agreement(
        answer("moments", [1.009, 1.011, float("nan"), 1.0]),
        answer("direct", [1.0, 1.0, 1.0, 1.0]),
        np.ones((4, 3), bool),
    )
    assert_array_equal(pair.disagree[:, 1], [False, True, True, False])


def test_three_solvers_make_three_pairs() -> None:
    given = [answer(name, [1.0]) for name in ("moments", "direct", "montecarlo")]
    names = [pair.name for pair in agreements(given)]
    assert names == ["moments - direct", "moments - montecarlo", "direct - montecarlo"]


def test_a_wrong_answer_fails_the_suite_and_stands_in_the_table(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    # One value 3 % off, in a suite whose answers are made by hand.
    def made(*_: object, **__: object) -> list[Result]:
        return [answer("moments", [1.0, 1.03, 1.0, 1.0]), answer("montecarlo", [1.0] * 4, 1e-3)]

    monkeypatch.setattr(module, "results", made)
    suite = solvers(SuiteRun(), planets=["earth-atmosphere-plus"], cases=FOUR)
    assert [threshold.result for threshold in suite.thresholds] == [1]
    assert not suite.passed
    worst = next(part for part in suite.parts if "worst" in part.title)
    assert worst.rows[0][1] == "0 km, view 60°, sun 60°, azimuth 0°"
    assert worst.rows[0][5] == "+3.00"
    assert worst.marks[0] == "fail"
    everything = next(part for part in suite.parts if "all values" in part.title)
    assert list(everything.marks).count("fail") == 3


def test_two_real_solvers_agree_on_a_few_lines_of_sight() -> None:
    # A second method: Monte Carlo. Daylight, so that 1 % or three standard errors is fair.
    from airlight.solver.montecarlo.settings import MonteCarloSettings

    monte_carlo = MonteCarloSettings(relative_error=0.005, most_histories=400_000)
    suite = solvers(
        SuiteRun(),
        solvers=(("moments", "default"), ("montecarlo", monte_carlo)),
        planets=["earth-atmosphere-plus"],
        cases=FOUR,
    )
    assert [threshold.name for threshold in suite.thresholds if not threshold.passed] == []


def test_too_few_bright_cases_fail_the_suite(monkeypatch: pytest.MonkeyPatch) -> None:
    # In the dark nobody disagrees; that must not count as agreement.
    def dark(*_: object, **__: object) -> list[Result]:
        return [answer("moments", [1e-9] * 4), answer("montecarlo", [1e-9] * 4, 1e-3)]

    monkeypatch.setattr(module, "results", dark)
    assert not solvers(SuiteRun(), planets=["earth-atmosphere-plus"], cases=FOUR).passed


def test_a_point_has_no_disc_and_a_high_sun_needs_none() -> None:
    # By definition; and by day the air in front of the disc is the same all over it.
    planet = load_planet("earth-atmosphere-plus")
    point = Medium.from_planet(with_point_star(planet), [550.0])
    disc = Medium.from_planet(planet, [550.0])
    assert point.star_angular_radius == 0.0 < disc.star_angular_radius
    assert_allclose(point.solar_irradiance, disc.solar_irradiance, rtol=1e-12)
    table = finite_disc(SuiteRun(), "earth-atmosphere-plus", FOUR)
    differences = [float(cell) for row in table.rows for cell in row[1:]]
    assert_allclose(differences, 0.0, atol=0.1)  # in per cent


def test_solvers_stop_when_asked() -> None:
    with pytest.raises(Cancelled):
        solvers(SuiteRun(cancel=lambda: True), cases=FOUR)
