"""Floating types and finite ranges of arrays in the display chain."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import ParameterError
from airlight.kernel import kernel, vectorized

#: Upper limit of light: its square still fits single precision, so that no curve divides infinity
#: by infinity.
BRIGHTEST: Final = 1e18


@kernel
def physical_light(light):
    """Light clamped to 0 to ``BRIGHTEST``; negative values and NaN are black."""
    # By comparison, not max(): comparisons with a NaN are false.
    return min(light if light > 0.0 else 0.0, BRIGHTEST)


def floating(values: ArrayLike) -> NDArray[Any]:
    """float32 and float64 values unchanged, others as float64.

    Examples
    --------
    >>> floating([1, 2]).dtype, floating(np.float32(1)).dtype
    (dtype('float64'), dtype('float32'))
    """
    array = np.asarray(values)
    return array if array.dtype in (np.float32, np.float64) else array.astype(np.float64)


def physical(values: ArrayLike) -> NDArray[Any]:
    """Values clamped to 0 to ``BRIGHTEST``; negative values and NaN are black.

    Examples
    --------
    >>> physical([-1.0, np.nan, 0.5, np.inf])
    array([0.e+00, 0.e+00, 5.e-01, 1.e+18])
    """
    array = floating(values)
    return np.asarray(np.where(array > 0.0, np.minimum(array, BRIGHTEST), array.dtype.type(0.0)))


def each(scalar: Any, values: ArrayLike) -> NDArray[Any]:
    """Kernel of one argument applied to every element in float64, with the type restored."""
    array = floating(values)
    with np.errstate(all="ignore"):  # the kernels handle infinity and NaN
        return np.asarray(vectorized(scalar)(array)).astype(array.dtype, copy=False)


def each_pixel(loop: Any, rgb: ArrayLike, *parameters: float) -> NDArray[Any]:
    """Compiled loop over colours applied in float64, with the type restored.

    Parameters
    ----------
    loop : compiled loop
        ``loop(colors, out, *parameters)`` with colours of shape (n, 3).
    *parameters : float
        Further arguments of the loop.

    Raises
    ------
    ParameterError
        If the last axis has another length.
    """
    array = floating(rgb)
    if array.ndim == 0 or array.shape[-1] != 3:
        raise ParameterError("rgb", array.shape, "an array of shape (..., 3)")
    colors = np.ascontiguousarray(array).reshape(-1, 3)
    out = np.empty_like(colors)
    loop(colors, out, *parameters)
    return out.reshape(array.shape)
