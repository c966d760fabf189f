"""Loss functions of a fit, from least squares to robust ones."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

#: A loss ρ(z) of squared residuals z, shape (n,), with its first and second derivatives: (3, n).
Loss = Callable[[FloatArray], FloatArray]


def linear(z: FloatArray) -> FloatArray:
    """Least squares: ρ = z."""
    return np.stack([z, np.ones_like(z), np.zeros_like(z)])


def soft_l1(z: FloatArray) -> FloatArray:
    """Smooth transition from squares to absolute values: ρ = 2 (√(1 + z) - 1)."""
    t = 1.0 + z
    return np.stack([2.0 * (np.sqrt(t) - 1.0), t**-0.5, -0.5 * t**-1.5])


def huber(z: FloatArray) -> FloatArray:
    """Huber loss: squares up to one standard deviation, absolute values beyond.

    References
    ----------
    Huber (1964), Robust Estimation of a Location Parameter, Ann. Math. Stat. 35, 73.
    """
    far = np.maximum(z, 1.0)
    inside = z <= 1.0
    return np.stack(
        [
            np.where(inside, z, 2.0 * np.sqrt(far) - 1.0),
            np.where(inside, 1.0, far**-0.5),
            np.where(inside, 0.0, -0.5 * far**-1.5),
        ]
    )


def cauchy(z: FloatArray) -> FloatArray:
    """Cauchy loss: ρ = ln(1 + z)."""
    t = 1.0 + z
    return np.stack([np.log(t), 1.0 / t, -1.0 / t**2])


#: Losses by name.
LOSSES: Final[dict[str, Loss]] = {
    "linear": linear,
    "soft_l1": soft_l1,
    "huber": huber,
    "cauchy": cauchy,
}


def of_data(loss: Loss, count: int) -> Loss:
    """Loss for residuals of which the first ``count`` are data, the others priors.

    Priors always count by their squares.
    """

    def mixed(z: FloatArray) -> FloatArray:
        return np.concatenate([loss(z[:count]), linear(z[count:])], axis=1)

    return mixed
