"""Bounded least squares with finite differences, and error bars."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final, Protocol

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ConvergenceError, ParameterError
from airlight.studies.fit.covariance import FEWEST_SCANS, ErrorBars, errors_of
from airlight.studies.fit.loss import LOSSES, Loss, of_data
from airlight.studies.fit.parameter import FitParameter

FloatArray = NDArray[np.float64]

#: Largest step, relative to every error bar, at which the fit ends after fresh derivatives. [1]
SMALL_STEP: Final = 0.05
#: The same relative to the parameter's magnitude, for data almost without noise. [1]
_SMALL_SHARE: Final = 1e-4
#: Decrease of the sum of squares, a small part of what an error bar makes, that ends a
#: round; the sum itself is about the number of values. [1]
_LEAST_GAIN: Final = 1e-5
#: Most rounds.
_MOST_ROUNDS: Final = 12
#: Initial guess of an unknown relative uncertainty. [1]
_FIRST_UNCERTAINTY: Final = 0.05
#: Smallest uncertainty estimated from residuals: the rounding error of the solver. [1]
_LEAST_UNCERTAINTY: Final = 1e-6
#: Response to a parameter's whole range, relative to the largest value, that counts as none. [1]
_NO_RESPONSE: Final = 1e-7
#: Smallest singular value of derivatives scaled to unit length, relative to the largest. [1]
_SINGULAR: Final = 1e-4


class Model(Protocol):
    """Model of measured values."""

    def __call__(self, values: FloatArray) -> FloatArray:
        """Predicted values, shape (n,), for parameters of shape (p,)."""
        ...

    def derivative(self, values: FloatArray, index: int, *, central: bool) -> FloatArray:
        """Derivative of the predicted values by a parameter, shape (n,)."""
        ...


@dataclass(frozen=True, eq=False)
class Data:
    """Measured values to which a model is fitted.

    Attributes
    ----------
    values : array, shape (n,)
        Measured values.
    uncertainty : array, shape (n,)
        Standard deviations; only relative if ``known`` is False.
    known : bool
        Whether the uncertainties are absolute.
    group : array of int, shape (n,)
        Scan of each value, from 0.
    """

    values: FloatArray
    uncertainty: FloatArray
    known: bool
    group: NDArray[np.int64]


@dataclass(frozen=True, kw_only=True, eq=False)
class FitResult:
    """Result of a fit.

    Attributes
    ----------
    parameters : tuple of FitParameter
        Parameters of the fit.
    values : array, shape (p,)
        Fitted values.
    errors : ErrorBars
        Error bars and correlations.
    predicted : array, shape (n,)
        Model at the fitted values.
    sigma : array, shape (n,)
        Standard deviations, estimated from the residuals if unknown.
    rounds : int
        Number of restarts of the trust region.
    last_step : array, shape (p,)
        Newton step with the final derivatives, over the error bars.
    left_out : array, shape (n,), or None
        Prediction of each scan by the fit to the others; None with fewer than five scans.
    """

    parameters: tuple[FitParameter, ...]
    values: FloatArray
    errors: ErrorBars
    predicted: FloatArray
    sigma: FloatArray
    rounds: int
    last_step: FloatArray
    left_out: FloatArray | None

    def index(self, name: str) -> int:
        """Number of a parameter by its name."""
        return [one.name for one in self.parameters].index(name)

    def value(self, name: str) -> float:
        """Fitted value of a parameter by its name."""
        return float(self.values[self.index(name)])

    def error(self, name: str) -> float:
        """Standard error of a parameter by its name."""
        return float(self.errors.standard[self.index(name)])


def fit(
    model: Model,
    data: Data,
    parameters: Sequence[FitParameter],
    loss: str = "linear",
    start: FloatArray | None = None,
) -> FitResult:
    """Fit parameters of a model to data.

    Bounded trust-region steps (``scipy.optimize.least_squares``); derivatives are recomputed where
    a step exceeds the range of the differences. The fit has converged when a Newton step with new
    central differences is below ``SMALL_STEP`` error bars for all parameters, or below one error
    bar without gain, and an estimated uncertainty has converged.

    Parameters
    ----------
    loss : str
        Name from ``airlight.studies.fit.loss.LOSSES``.
    start : array, shape (p,), optional
        Initial values, instead of those of the parameters.

    References
    ----------
    Branch, Coleman & Li (1999), SIAM J. Sci. Comput. 21, 1: the trust region.
    """
    if loss not in LOSSES:
        raise ParameterError("loss", loss, ", ".join(LOSSES))
    problem = _Problem(model, data, tuple(parameters), LOSSES[loss])
    x = np.array([one.start for one in parameters]) if start is None else start
    problem.check_response(problem.slopes(x, central=False))
    for number in range(1, _MOST_ROUNDS + 1):
        # One-sided differences are cheaper; with large residuals their least is elsewhere.
        x = problem.minimised(x, central=number > 1 or start is not None)
        rescaled = problem.rescaled(x)
        slopes = problem.slopes(x, central=True)
        problem.check_rank(slopes, x)
        errors = problem.errors(x, slopes)
        step = problem.newton_step(x, slopes)
        share = _over(np.abs(step), errors.largest)
        small = (share <= SMALL_STEP) | (np.abs(step) <= _SMALL_SHARE * problem.sizes(x))
        # A step that would gain nothing is one within the rounding of the model.
        least = small.all() or (share.max() < 1.0 and problem.cost(x + step) >= problem.cost(x))
        if least and rescaled < 0.01:
            return FitResult(
                parameters=problem.parameters,
                values=x,
                errors=errors,
                predicted=model(x),
                sigma=problem.sigma,
                rounds=number,
                last_step=share,
                left_out=problem.left_out(x, slopes),
            )
    worst = int(share.argmax())
    raise ConvergenceError(
        f"the fit has not converged in {_MOST_ROUNDS} rounds: {parameters[worst].name} still "
        f"changes by {share[worst]:.2g} of its error bar"
    )


class _Problem:
    """Residuals and their derivatives."""

    def __init__(
        self, model: Model, data: Data, parameters: tuple[FitParameter, ...], loss: Loss
    ) -> None:
        self.model, self.data, self.parameters = model, data, parameters
        self.loss = of_data(loss, data.values.size)
        self.robust = LOSSES["linear"] is not loss
        self.low = np.array([one.low for one in parameters])
        self.high = np.array([one.high for one in parameters])
        self.scale = 1.0 if data.known else _FIRST_UNCERTAINTY
        self._at: FloatArray | None = None
        self._slopes, self._central = np.empty(0), False

    @property
    def sigma(self) -> FloatArray:
        """Standard deviations of the data."""
        return np.asarray(self.scale * self.data.uncertainty)

    def sizes(self, x: FloatArray) -> FloatArray:
        """Scales of the parameters, above 0."""
        steps = np.array([50.0 * one.least_step for one in self.parameters])
        return np.asarray(np.maximum(np.abs(x), steps))

    def residuals(self, x: FloatArray) -> FloatArray:
        """Differences over their standard deviations, data then priors."""
        residual = (self.model(x) - self.data.values) / self.sigma
        pairs = zip(self.parameters, x, strict=True)
        priors = [one.sigmas_from_prior(value) for one, value in pairs if one.prior is not None]
        return np.concatenate([residual, np.array(priors)])

    def cost(self, x: FloatArray) -> float:
        """Loss at the parameters."""
        return float(self.loss(np.square(self.residuals(x)))[0].sum())

    def slopes(self, x: FloatArray, *, central: bool) -> FloatArray:
        """Derivatives of the predicted values, shape (n, p), recomputed if necessary."""
        if not self._good(x, central):
            count = len(self.parameters)
            columns = [self.model.derivative(x, k, central=central) for k in range(count)]
            self._at, self._slopes, self._central = x.copy(), np.stack(columns, axis=-1), central
        return self._slopes

    def _good(self, x: FloatArray, central: bool) -> bool:
        """Whether the derivatives are valid within the range of the differences."""
        if self._at is None or (central and not self._central):
            return False
        pairs = zip(self.parameters, self._at, strict=True)
        reach = np.array([abs(one.step(float(value))) for one, value in pairs])
        return bool((np.abs(x - self._at) <= reach).all())

    def with_priors(self, slopes: FloatArray) -> FloatArray:
        """Derivatives of the residuals, data then priors."""
        priors = [
            np.eye(len(self.parameters))[k] / one.prior.sigma
            for k, one in enumerate(self.parameters)
            if one.prior is not None
        ]
        return np.concatenate(
            [slopes / self.sigma[:, None], np.reshape(priors, (-1, len(self.parameters)))]
        )

    def minimised(self, x: FloatArray, *, central: bool) -> FloatArray:
        """Parameters at the minimum of the loss."""
        from scipy.optimize import least_squares

        scale = self.sizes(x)
        keywords: dict[str, Any] = {"loss": self.loss} if self.robust else {}
        found = least_squares(
            lambda u: self.residuals(u * scale),
            x / scale,
            jac=lambda u: self.with_priors(self.slopes(u * scale, central=central)) * scale,
            bounds=(self.low / scale, self.high / scale),
            x_scale="jac",
            ftol=_LEAST_GAIN / self.data.values.size,
            xtol=1e-7,
            gtol=1e-10,
            max_nfev=60,
            **keywords,
        )
        return np.asarray(np.clip(found.x * scale, self.low, self.high))

    def rescaled(self, x: FloatArray) -> float:
        """Estimate an unknown uncertainty from the residuals, and return its relative change."""
        if self.data.known:
            return 0.0
        residual = (self.model(x) - self.data.values) / self.data.uncertainty
        if self.robust:
            scale = 1.4826 * float(np.median(np.abs(residual)))  # of a Gaussian: its deviation
        else:
            freedom = max(residual.size - len(self.parameters), 1)
            scale = float(np.sqrt(np.square(residual).sum() / freedom))
        before, self.scale = self.scale, max(scale, _LEAST_UNCERTAINTY)
        return abs(self.scale / before - 1.0)

    def errors(self, x: FloatArray, slopes: FloatArray) -> ErrorBars:
        """Error bars and correlations at the parameters."""
        return errors_of(
            self.with_priors(slopes),
            self.residuals(x),
            self.loss,
            group=self.data.group,
            at_bound=self._held(x),
            robust=self.robust,
        )

    def _held(self, x: FloatArray) -> NDArray[np.bool_]:
        """Whether each parameter is at a bound."""
        near = 1e-6 * self.sizes(x)
        return np.asarray((x - self.low <= near) | (self.high - x <= near))

    def newton_step(
        self, x: FloatArray, slopes: FloatArray, kept: NDArray[np.bool_] | None = None
    ) -> FloatArray:
        """Newton step of the linear model, 0 for parameters at a bound, shape (p,).

        Parameters
        ----------
        kept : array of bool, shape (n,), optional
            Values that count; default: all.
        """
        residual = self.residuals(x)
        weights = self.loss(np.square(residual))[1]
        if kept is not None:
            weights[: kept.size] *= kept
        free = ~self._held(x)
        step = np.zeros_like(x)
        root = np.sqrt(weights)[:, None]
        if free.any():
            jacobian = self.with_priors(slopes)[:, free]
            step[free] = np.linalg.lstsq(root * jacobian, -root[:, 0] * residual, rcond=None)[0]
        return np.clip(x + step, self.low, self.high) - x

    def left_out(self, x: FloatArray, slopes: FloatArray) -> FloatArray | None:
        """Prediction of each scan by the fit to the others, shape (n,).

        The linear model, exact for a linear one: one Newton step from the fit to all scans.
        """
        group = self.data.group
        if int(group.max()) + 1 < FEWEST_SCANS:
            return None
        found = self.model(x).copy()
        for one in np.unique(group):
            seen = group == one
            found[seen] += slopes[seen] @ self.newton_step(x, slopes, ~seen)
        return found

    def check_response(self, slopes: FloatArray) -> None:
        """Raise an error for a parameter without effect on predicted values."""
        largest = np.abs(self.data.values).max()
        for one, column in zip(self.parameters, slopes.T, strict=True):
            reach = np.abs(column).max() * (one.high - one.low)
            if one.prior is None and reach <= _NO_RESPONSE * largest:
                raise ParameterError(
                    one.name,
                    one.start,
                    "a parameter constrained by the data; no predicted value depends on it",
                )

    def check_rank(self, slopes: FloatArray, x: FloatArray) -> None:
        """Raise an error for parameters that are degenerate given the data and the priors."""
        free = np.flatnonzero(~self._held(x))
        jacobian = self.with_priors(slopes)[:, free]
        lengths = np.linalg.norm(jacobian, axis=0)
        if free.size < 2 or not lengths.all():
            return
        _, singular, rows = np.linalg.svd(jacobian / lengths, full_matrices=False)
        if singular[-1] > _SINGULAR * singular[0]:
            return
        first, second, *_ = free[np.argsort(-np.abs(rows[-1]))]
        one, other = self.parameters[first], self.parameters[second]
        raise ParameterError(
            one.name,
            float(x[first]),
            f"a parameter constrained by the data; it is degenerate with {other.name}",
        )


def _over(steps: FloatArray, errors: FloatArray) -> FloatArray:
    """Steps over error bars; 0 for parameters at a bound."""
    return np.divide(steps, errors, out=np.zeros_like(steps), where=errors > 0.0)


def difference(
    predict: Callable[[FloatArray], FloatArray],
    one: FitParameter,
    values: FloatArray,
    index: int,
    *,
    central: bool,
) -> FloatArray:
    """Derivative of predicted values by a parameter, by differences within its bounds.

    Parameters
    ----------
    predict : callable
        Predicted values, shape (n,), for parameters of shape (p,).
    one : FitParameter
        Parameter by which the derivative is taken.
    values : array, shape (p,)
        Values of the parameters, shape (p,).
    central : bool
        Whether to use central differences, where the bounds allow.
    """
    step = np.zeros_like(values)
    step[index] = one.step(float(values[index]))
    ahead = predict(values + step)
    other = values - step
    if central and one.low <= other[index] <= one.high:
        return np.asarray((ahead - predict(other)) / (2.0 * step[index]))
    return np.asarray((ahead - predict(values)) / step[index])
