"""Display encodings of linear light, and their inverses."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, Final, NamedTuple

from numpy.typing import ArrayLike, NDArray

from airlight.errors import ParameterError
from airlight.image.floating import each
from airlight.kernel import kernel
from airlight.kernel.cube_root import cube_root


@kernel
def srgb_curve(linear):
    """Scalar form of ``srgb_encode``."""
    positive = linear if linear > 0.0 else 0.0
    if positive <= 0.0031308:
        return 12.92 * positive
    if positive > 1.0:
        return 1.055 * positive ** (1.0 / 2.4) - 0.055
    # The power 1/2.4 is 5/4 of the third: three times as fast.
    root = cube_root(positive)
    return 1.055 * root * math.sqrt(math.sqrt(root)) - 0.055


@kernel
def srgb_curve_inverse(encoded):
    """Scalar form of ``srgb_decode``."""
    positive = encoded if encoded > 0.0 else 0.0
    if positive <= 0.04045:
        return positive / 12.92
    return ((positive + 0.055) / 1.055) ** 2.4


@kernel
def gamma_curve(linear):
    """Scalar form of ``gamma_encode``."""
    positive = linear if linear > 0.0 else 0.0
    return positive ** (1.0 / 2.2)


@kernel
def gamma_curve_inverse(encoded):
    """Scalar form of ``gamma_decode``."""
    positive = encoded if encoded > 0.0 else 0.0
    return positive**2.2


@kernel
def encoded(which, linear):
    """Value encoded by index in ``ENCODINGS``. [1]"""
    if which == 0:
        return srgb_curve(linear)
    return gamma_curve(linear)


def srgb_encode(linear: ArrayLike) -> NDArray[Any]:
    r"""sRGB-encoded values of linear light.

    .. math:: v = 12.92\,x \ (x \le 0.0031308), \qquad v = 1.055\,x^{1/2.4} - 0.055

    Parameters
    ----------
    linear : array, shape (...)
        Linear light; 1 is the display's white, larger values continue, negative values count as 0.
        [1]

    Returns
    -------
    array, shape (...)
        Encoded values, same floating type. [1]

    References
    ----------
    IEC 61966-2-1:1999. Its two pieces differ by 3e-8 where they meet.

    Examples
    --------
    >>> srgb_encode([0.0, 0.18, 1.0]).round(4)
    array([0.    , 0.4614, 1.    ])
    """
    return each(srgb_curve, linear)


def srgb_decode(encoded: ArrayLike) -> NDArray[Any]:
    """Linear light from sRGB values: the inverse of ``srgb_encode``.

    Parameters
    ----------
    encoded : array, shape (...)
        Encoded values; 0 to 1 is the display's range. [1]

    Returns
    -------
    array, shape (...)
        Linear light, same floating type. [1]

    Examples
    --------
    >>> srgb_decode([0.0, 0.5, 1.0]).round(4)
    array([0.   , 0.214, 1.   ])
    """
    return each(srgb_curve_inverse, encoded)


def gamma_encode(linear: ArrayLike) -> NDArray[Any]:
    """Linear light to the power 1/2.2.

    Parameters
    ----------
    linear : array, shape (...)
        Linear light; negative values count as 0. [1]

    Returns
    -------
    array, shape (...)
        Encoded values, same floating type. [1]

    Examples
    --------
    >>> gamma_encode([0.0, 0.18, 1.0]).round(4)
    array([0.    , 0.4587, 1.    ])
    """
    return each(gamma_curve, linear)


def gamma_decode(encoded: ArrayLike) -> NDArray[Any]:
    """Linear light by the power 2.2: the inverse of ``gamma_encode``.

    Parameters
    ----------
    encoded : array, shape (...)
        Encoded values. [1]

    Returns
    -------
    array, shape (...)
        Linear light, same floating type. [1]
    """
    return each(gamma_curve_inverse, encoded)


class Encoding(NamedTuple):
    """Encoding and its inverse, functions of one array."""

    encode: Callable[[ArrayLike], NDArray[Any]]
    decode: Callable[[ArrayLike], NDArray[Any]]


#: Encodings by name.
ENCODINGS: Final[dict[str, Encoding]] = {
    "srgb": Encoding(srgb_encode, srgb_decode),
    "gamma": Encoding(gamma_encode, gamma_decode),
}


def encoding_named(name: str) -> Encoding:
    """Encoding by name.

    Raises
    ------
    ParameterError
        If there is no such encoding.
    """
    if name not in ENCODINGS:
        raise ParameterError("encoding", name, ", ".join(ENCODINGS))
    return ENCODINGS[name]
