"""Least squares: exact cases, laws of error bars, bounds, priors, outliers, refusals."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.studies.fit.least_squares import Data, difference, fit
from airlight.studies.fit.loss import LOSSES
from airlight.studies.fit.parameter import FitParameter, Prior


@dataclass(frozen=True)
class Curve:
    """Model of one formula, with derivatives by differences."""

    formula: Callable[[np.ndarray], np.ndarray]
    parameters: Sequence[FitParameter]

    def __call__(self, values: np.ndarray) -> np.ndarray:
        return self.formula(values)

    def derivative(self, values: np.ndarray, index: int, *, central: bool) -> np.ndarray:
        return difference(self, self.parameters[index], values, index, central=central)


def free(name: str, start: float = 1.0, low: float = -50.0, high: float = 50.0,
         prior: Prior | None = None) -> FitParameter:  # fmt: skip
    return FitParameter(name=name, start=start, low=low, high=high, least_step=0.01, prior=prior)


def data_of(values: np.ndarray, sigma: float = 0.1, *, known: bool = True) -> Data:
    n = values.size
    return Data(values=values, uncertainty=np.full(n, sigma), known=known,
                group=np.arange(n, dtype=np.int64) * 10 // n)  # fmt: skip


X = np.linspace(0.0, 2.0, 60)


def test_straight_line_has_the_normal_equations_solution_and_covariance() -> None:
    # An exact case: (AᵀA)⁻¹Aᵀy and σ²(AᵀA)⁻¹.
    matrix = np.stack([np.ones_like(X), X], axis=-1)
    y = matrix @ [0.7, -1.3] + 0.1 * np.random.default_rng(0).standard_normal(X.size)
    parameters = [free("a"), free("b")]
    found = fit(Curve(lambda v: matrix @ v, parameters), data_of(y), parameters)
    cov = 0.01 * np.linalg.inv(matrix.T @ matrix)
    # 3 % of an error bar may remain; differences of a line are exact.
    assert_allclose(found.values, cov @ matrix.T @ y / 0.01, atol=0.03 * np.sqrt(cov[0, 0]))
    assert_allclose(found.errors.standard, np.sqrt(np.diag(cov)), rtol=1e-6)
    assert_allclose(found.errors.correlation[0, 1],
                    cov[0, 1] / np.sqrt(cov[0, 0] * cov[1, 1]), rtol=1e-6)  # fmt: skip


def test_scans_left_out_are_predicted_by_the_fit_to_the_others() -> None:
    # A linear model: each of the ten fits to the others has a solution of normal equations.
    matrix = np.stack([np.ones_like(X), X], axis=-1)
    y = matrix @ [0.7, -1.3] + 0.1 * np.random.default_rng(3).standard_normal(X.size)
    parameters, data = [free("a"), free("b")], data_of(y, known=False)
    found = fit(Curve(lambda v: matrix @ v, parameters), data, parameters)
    expected = np.empty_like(y)
    for scan in range(10):
        out = data.group == scan
        expected[out] = matrix[out] @ np.linalg.lstsq(matrix[~out], y[~out], rcond=None)[0]
    assert found.left_out is not None
    assert_allclose(found.left_out, expected, atol=1e-9)
    four = Data(values=y, uncertainty=data.uncertainty, known=False, group=data.group % 4)
    assert fit(Curve(lambda v: matrix @ v, parameters), four, parameters).left_out is None


@pytest.mark.parametrize("start", [(0.05, 0.05), (30.0, 8.0), (1.0, -3.0)])
def test_decay_is_found_from_distant_starts(start: tuple[float, float]) -> None:
    # The truth is known: data made with it, without noise.
    parameters = [free("height", start[0]), free("rate", start[1], -5.0, 10.0)]
    model = Curve(lambda v: v[0] * np.exp(-v[1] * X), parameters)
    found = fit(model, data_of(model(np.array([3.0, 1.5])), 1e-3), parameters)
    assert_allclose(found.values, [3.0, 1.5], rtol=1e-4)


def test_error_bars_cover_the_truth_by_the_gaussian_law() -> None:
    # 300 draws of two parameters: 68.3 % ± 2.7 % are within one error bar, whether the noise is
    # known or estimated; three deviations are allowed.
    parameters = [free("height", 2.0), free("rate", 1.0)]
    model, truth = Curve(lambda v: v[0] * np.exp(-v[1] * X), parameters), np.array([3.0, 1.5])
    rng = np.random.default_rng(7)
    for known in (True, False):
        pulls = []
        for _ in range(300):
            y = model(truth) + 0.1 * rng.standard_normal(X.size)
            found = fit(model, data_of(y, known=known), parameters)
            pulls.append((found.values - truth) / found.errors.standard)
        assert_allclose((np.abs(pulls) < 1.0).mean(axis=0), 0.683, atol=0.081)


def test_error_bars_from_scans_hold_what_a_scan_has_in_common() -> None:
    # A law: a mean of G scans, each with an offset of its own of size s, errs by s/√G, not by the
    # noise of its values; the estimate from 40 offsets errs by a ninth: three ninths are allowed.
    rng = np.random.default_rng(3)
    offsets = 0.5 * rng.standard_normal(40)
    group = np.repeat(np.arange(40), 25)
    y = 2.0 + offsets[group] + 0.1 * rng.standard_normal(group.size)
    parameters = [free("mean", 1.0)]
    found = fit(
        Curve(lambda v: np.full(group.size, v[0]), parameters),
        Data(values=y, uncertainty=np.full(y.size, 0.1), known=True, group=group), parameters,
    )  # fmt: skip
    assert found.errors.by_scans is not None
    assert_allclose(found.errors.by_scans[0], offsets.std() / np.sqrt(40), rtol=0.34)
    assert_allclose(found.errors.standard[0], 0.1 / np.sqrt(y.size), rtol=1e-3)


def test_prior_is_weighted_with_the_data_by_their_variances() -> None:
    # An exact case: the weighted mean of two Gaussians.
    parameters = [free("mean", 1.0, prior=Prior(mean=5.0, sigma=0.02))]
    model = Curve(lambda v: np.full(X.size, v[0]), parameters)
    found = fit(model, data_of(np.full(X.size, 2.0)), parameters)
    weights = np.array([X.size / 0.01, 1.0 / 0.02**2])
    expected = (weights @ [2.0, 5.0]) / weights.sum()
    sigma = weights.sum() ** -0.5
    assert_allclose(found.values[0], expected, atol=0.03 * sigma)
    assert_allclose(found.errors.standard[0], sigma, rtol=1e-6)
    assert_allclose(found.errors.from_data[0], 0.1 / np.sqrt(X.size), rtol=1e-6)


def test_bound_holds_and_is_said() -> None:
    # The least of the squares lies beyond the bound, so that the nearest allowed value is best.
    parameters = [free("slope", 0.5, 0.0, 1.0), free("rest")]
    model = Curve(lambda v: v[0] * X + v[1], parameters)
    found = fit(model, data_of(2.0 * X), parameters)
    assert_allclose(found.values[0], 1.0, atol=1e-5)
    assert found.errors.at_bound.tolist() == [True, False]
    assert found.errors.standard[0] == 0.0


@pytest.mark.parametrize("loss", ["soft_l1", "huber", "cauchy"])
def test_robust_loss_holds_against_outliers(loss: str) -> None:
    # A tenth of the values is 5 too high: squares move by 0.5, a robust loss by no more than a
    # tenth of that.
    y = 2.0 + 0.1 * np.random.default_rng(5).standard_normal(200)
    y[::10] += 5.0
    parameters = [free("mean")]
    model = Curve(lambda v: np.full(200, v[0]), parameters)
    squares = fit(model, data_of(y), parameters).values[0]
    robust = fit(model, data_of(y), parameters, loss=loss).values[0]
    assert_allclose(squares, 2.5, atol=0.03)
    assert_allclose(robust, 2.0, atol=0.05)


@pytest.mark.parametrize("loss", list(LOSSES))
def test_losses_are_consistent_with_their_derivatives(loss: str) -> None:
    # Second method: differences of the loss itself; near 0 every loss is z.
    z = np.array([1e-9, 0.3, 0.9, 1.2, 4.0, 30.0])
    value, slope, bend = LOSSES[loss](z)
    h = 1e-5 * np.maximum(z, 1e-3)
    up, down = LOSSES[loss](z + h), LOSSES[loss](np.abs(z - h))
    assert_allclose(value[0], z[0], rtol=1e-6)
    assert_allclose(slope[1:], (up[0] - down[0])[1:] / (2.0 * h[1:]), rtol=1e-6)
    assert_allclose(bend[1:], (up[1] - down[1])[1:] / (2.0 * h[1:]), rtol=1e-5, atol=1e-9)


def test_parameter_that_nothing_depends_on_is_refused_by_name() -> None:
    # No data could say anything of it.
    parameters = [free("a"), free("idle")]
    model = Curve(lambda v: v[0] * X, parameters)
    with pytest.raises(
        ParameterError, match=r"idle is 1\.0; allowed: a parameter constrained by the data"
    ):
        fit(model, data_of(2.0 * X), parameters)


def test_parameters_that_cannot_be_told_apart_are_both_named() -> None:
    # Only their product enters.
    parameters = [free("a", 1.0, 0.1), free("b", 2.0, 0.1)]
    model = Curve(lambda v: v[0] * v[1] * X, parameters)
    with pytest.raises(ParameterError, match=r"degenerate with [ab]"):
        fit(model, data_of(3.0 * X), parameters)


def test_unknown_uncertainty_is_that_of_the_residuals() -> None:
    # The noise is known to be 0.3; of 400 values its estimate errs by 3.5 %.
    y = 1.0 + 0.3 * np.random.default_rng(2).standard_normal(400)
    parameters = [free("mean")]
    model = Curve(lambda v: np.full(400, v[0]), parameters)
    found = fit(model, data_of(y, 1.0, known=False), parameters)
    assert_allclose(found.sigma[0], 0.3, rtol=0.11)
    assert_allclose(found.errors.standard[0], 0.3 / 20.0, rtol=0.11)
