"""Error bars of fitted parameters: from noise, and from differences between scans."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.studies.fit.loss import Loss

FloatArray = NDArray[np.float64]

#: Smallest number of scans from whose differences error bars are estimated.
FEWEST_SCANS: Final = 5


@dataclass(frozen=True, kw_only=True, eq=False)
class ErrorBars:
    """Error bars of p parameters.

    Attributes
    ----------
    standard : array, shape (p,)
        Standard errors from the noise of the data; 0 for a parameter at its bound.
    by_scans : array, shape (p,), or None
        Standard errors from differences between scans, which include errors common to a scan; None
        with fewer than five scans.
    from_data : array, shape (p,)
        Standard errors without priors.
    correlation : array, shape (p, p)
        Correlations; 0 with a parameter at its bound.
    at_bound : array of bool, shape (p,)
        Whether a parameter is at a bound.
    groups : int
        Number of scans.
    chi_square : float
        Sum of the squared residuals of the data. [1]
    freedom : int
        Degrees of freedom.
    """

    standard: FloatArray
    by_scans: FloatArray | None
    from_data: FloatArray
    correlation: FloatArray
    at_bound: NDArray[np.bool_]
    groups: int
    chi_square: float
    freedom: int

    @property
    def largest(self) -> FloatArray:
        """Larger of the two error bars, shape (p,)."""
        return self.standard if self.by_scans is None else np.maximum(self.standard, self.by_scans)

    @property
    def reduced(self) -> float:
        """Reduced chi-square: sum of squares over the degrees of freedom. [1]"""
        return self.chi_square / max(self.freedom, 1)


def errors_of(
    jacobian: FloatArray,
    residuals: FloatArray,
    loss: Loss,
    *,
    group: NDArray[np.int64],
    at_bound: NDArray[np.bool_],
    robust: bool,
) -> ErrorBars:
    r"""Error bars from derivatives and residuals at the minimum.

    .. math:: C = (J^T J)^{-1}, \qquad C_\rho = H^{-1} \Big(\sum_i s_i s_i^T\Big) H^{-1}, \qquad
              C_g = \frac{G}{G-1} H^{-1} \Big(\sum_g s_g s_g^T\Big) H^{-1}

    for least squares, a robust loss, and differences between scans, with the scores :math:`s_i =
    \rho'(r_i^2) r_i J_i` and :math:`s_g` their sums over a scan.

    Parameters
    ----------
    jacobian : array, shape (n + m, p)
        Derivatives of the residuals, n of data and m of priors.
    residuals : array, shape (n + m,)
        Residuals over their standard deviations. [1]
    loss : callable
        See ``airlight.studies.fit.loss``.
    group : array of int, shape (n,)
        Scans of the data.
    at_bound : array of bool, shape (p,)
        Parameters at a bound, treated as known.
    robust : bool
        Whether the loss is not least squares.

    References
    ----------
    Huber (1967), The behavior of maximum likelihood estimates under nonstandard conditions; Liang
    & Zeger (1986), Biometrika 73, 13 (sums over groups).
    """
    count, parameters = group.size, at_bound.size
    free = np.flatnonzero(~at_bound)
    used = jacobian[:, free]
    _, slope, bend = loss(np.square(residuals))
    # Second derivative of ρ(r²)/2; a robust loss is concave far from 0, where it counts as flat.
    curvature = np.maximum(slope + 2.0 * bend * np.square(residuals), 0.0)
    inverse = _inverse(used.T @ (curvature[:, None] * used))
    scores = (slope * residuals)[:, None] * used
    whole = inverse @ (scores.T @ scores) @ inverse if robust else inverse
    data_only = _inverse((used[:count].T * curvature[:count]) @ used[:count])
    standard, alone = np.zeros(parameters), np.zeros(parameters)
    standard[free] = np.sqrt(np.maximum(np.diag(whole), 0.0))
    alone[free] = np.sqrt(np.maximum(np.diag(data_only), 0.0))
    correlation = np.eye(parameters)
    scale = np.where(standard[free] > 0.0, standard[free], np.inf)
    correlation[np.ix_(free, free)] = whole / np.outer(scale, scale)
    np.fill_diagonal(correlation, 1.0)
    return ErrorBars(
        standard=standard,
        by_scans=_by_scans(scores, inverse, group, free, parameters),
        from_data=alone,
        correlation=correlation,
        at_bound=at_bound,
        groups=int(group.max()) + 1,
        chi_square=float(np.square(residuals[:count]).sum()),
        freedom=count - free.size,
    )


def _by_scans(
    scores: FloatArray,
    inverse: FloatArray,
    group: NDArray[np.int64],
    free: NDArray[np.int64],
    parameters: int,
) -> FloatArray | None:
    groups = int(group.max()) + 1
    if groups < max(FEWEST_SCANS, free.size + 1):
        return None
    sums = np.zeros((groups, free.size))
    np.add.at(sums, group, scores[: group.size])
    spread = inverse @ (sums.T @ sums) @ inverse * groups / (groups - 1.0)
    out = np.zeros(parameters)
    out[free] = np.sqrt(np.maximum(np.diag(spread), 0.0))
    return out


def _inverse(matrix: FloatArray) -> FloatArray:
    """Inverse of a badly scaled symmetric matrix."""
    root = np.sqrt(np.diag(matrix))
    root = np.where(root > 0.0, root, 1.0)
    scale = np.outer(root, root)
    return np.asarray(np.linalg.pinv(matrix / scale, hermitian=True) / scale)
