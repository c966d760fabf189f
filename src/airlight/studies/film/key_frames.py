"""Key frames: animation of one parameter of a scene or planet, and laws between its values."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import Any, Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.physics.units import quantity
from airlight.planets.parameters import MISSING, parameters
from airlight.planets.schema.field import Wavelengths, key
from airlight.planets.schema.measures import converted
from airlight.planets.schema.toml_model import TomlModel
from airlight.planets.schema.toml_table import LONGEST_LIST, TomlTable

FloatArray: TypeAlias = NDArray[np.float64]
#: ``law(at, values, where)``: keys (k,), values (k, m), query points (n,) to values (n, m).
Law: TypeAlias = Callable[[FloatArray, FloatArray, FloatArray], FloatArray]

_UNIT: Final = re.compile(r"\s*[-+.\d]+(?:[eE][-+]?\d+)?\s*(.*?)\s*")
_FORM: Final = "two or more numbers, as the file takes them: ['2 m', '400 km']"


def linear(at: FloatArray, values: FloatArray, where: FloatArray) -> FloatArray:
    """Linear interpolation, constant outside.

    Examples
    --------
    >>> linear(np.array([0.0, 1.0]), np.array([[2.0], [4.0]]), np.array([0.25])).item()
    2.5
    """
    return np.stack([np.interp(where, at, column) for column in values.T], axis=-1)


def smooth(at: FloatArray, values: FloatArray, where: FloatArray) -> FloatArray:
    r"""Monotone piecewise cubic interpolation with zero slope at both ends.

    The slope at an inner key is the weighted harmonic mean of the adjacent secants :math:`d`, or 0
    where their signs differ,

    .. math:: \frac{w_1 + w_2}{w_1 / d_{k-1} + w_2 / d_k}, \quad
              w_1 = 2 h_k + h_{k-1}, \quad w_2 = h_k + 2 h_{k-1},

    so that the interpolant does not overshoot.

    References
    ----------
    Fritsch & Butland (1984), SIAM J. Sci. Stat. Comput. 5, 300. doi:10.1137/0905021

    Examples
    --------
    >>> keys, values = np.array([0.0, 1.0]), np.array([[0.0], [1.0]])
    >>> smooth(keys, values, np.array([0.0, 0.25, 0.5])).ravel()  # 3 t² - 2 t³
    array([0.     , 0.15625, 0.5    ])
    """
    from scipy.interpolate import CubicHermiteSpline

    within = np.clip(where, at[0], at[-1])
    return np.asarray(CubicHermiteSpline(at, values, _slopes(at, values, ends=0.0))(within))


def smooth_value(at: Sequence[float], values: Sequence[float], time: float) -> float:
    """Result of ``smooth`` at one time, for one number."""
    found = smooth(np.array(at, float), np.array(values, float)[:, None], np.array([time]))
    return float(found[0, 0])


def _slopes(at: FloatArray, values: FloatArray, ends: float) -> FloatArray:
    """Slopes at the keys, shape (k, m)."""
    h = np.diff(at)[:, None]
    d = np.diff(values, axis=0) / h
    slopes = np.full(values.shape, ends)
    first, second = 2.0 * h[1:] + h[:-1], h[1:] + 2.0 * h[:-1]
    same = d[:-1] * d[1:] > 0.0
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        mean = (first + second) / (first / d[:-1] + second / d[1:])
    slopes[1:-1] = np.where(same, mean, 0.0)
    return slopes


def _of_logarithms(law: Law) -> Law:
    def run(at: FloatArray, values: FloatArray, where: FloatArray) -> FloatArray:
        return np.exp(law(at, np.log(values), where))

    run.__doc__ = f"Equal factors in equal times: ``{law.__name__}`` of the logarithm."
    return run


#: Law whose key frames of a view are joined by ``FlightPath``.
FLIGHT: Final = "flight"
#: Laws by name; that of a flight is of each number by itself what it is of all together.
LAWS: Final[dict[str, Law]] = {
    "linear": linear,
    "smooth": smooth,
    "exponential": _of_logarithms(linear),
    "smooth-exponential": _of_logarithms(smooth),
    FLIGHT: smooth,
}
#: Laws that take only values above 0.
LOGARITHMIC: Final = ("exponential", "smooth-exponential")


def _read_values(table: TomlTable, name: str, wavelengths: Wavelengths) -> Any:
    return table.required(name, _FORM)


@parameters
class KeyFrames(TomlModel):
    """Key frames of one parameter, and their interpolation.

    Parameters
    ----------
    path : str
        Path of the parameter: ``observer.altitude`` in a scene file, ``view.sun_zenith`` in a view,
        ``haze.particles.optical_depth`` in a planet file.
    values : list
        Numbers, or texts with a unit, as in the file; lists of them for a vector.
    at : tuple of float, optional
        Normalised times, ascending; evenly from 0 to 1 by default. [1]
    law : str
        Name from ``LAWS``.

    Examples
    --------
    >>> climb = KeyFrames(path="view.altitude", values=["1 m", "1 km"], law="exponential")
    >>> climb.value(0.0), climb.value(1 / 3)
    ('1.0 m', '10.0 m')
    """

    path: str = key(
        label="path",
        help="Animated number: `observer.altitude`, `view.sun_zenith`,"
        " `haze.particles.optical_depth`.",
        kind="text",
        range=(1, 200),
        example="observer.altitude",
    )
    values: Any = key(
        label="values",
        help="Values, with units as in the file; lists for a vector.",
        listed=True,
        read=_read_values,
        example="['2 m', '400 km']",
    )
    at: tuple[float, ...] | None = key(
        label="moments",
        help="Normalised time of each value, 0 to 1, ascending; default: equidistant.",
        range=(0.0, 1.0),
        listed=True,
        example="[0, 0.5, 1]",
        default=None,
    )
    law: str = key(
        label="law",
        help="Interpolation between the values.",
        kind="choice",
        choices=lambda: tuple(LAWS),
        default="linear",
    )

    def __post_init__(self) -> None:
        numbers, _ = self._numbers()
        if self.at is not None:
            if len(self.at) != len(numbers):
                raise ParameterError("at", self.at, f"{len(numbers)} times, as many as values")
            if any(b <= a for a, b in zip(self.at, self.at[1:], strict=False)):
                raise ParameterError("at", self.at, "ascending times")
        if self.law in LOGARITHMIC and not (numbers > 0.0).all():
            raise ParameterError("values", self.values, f"numbers above 0 by the law {self.law}")

    def value(self, time: float) -> Any:
        """Value at a time as in a file: number, text with unit, or list.

        Parameters
        ----------
        time : float
            Normalised time, 0 at the first frame and 1 at the last. [1]
        """
        numbers, unit = self._numbers()
        row = LAWS[self.law](self.times, numbers, np.array([time]))[0]
        # Fifteen digits: rounding errors of a law are not part of the value.
        texts = [float(f"{number:.15g}") for number in row]
        items = [f"{number!r} {unit}" if unit else number for number in texts]
        return items if isinstance(self._items()[0], list) else items[0]

    @property
    def times(self) -> FloatArray:
        """Normalised times of the values. [1]"""
        if self.at is not None:
            return np.array(self.at)
        return np.linspace(0.0, 1.0, len(self._items()))

    def numbers(self, unit: str) -> list[float]:
        """Values of one parameter in a unit, which numbers without one have."""
        numbers, given = self._numbers()
        return [converted(float(one), given or unit, unit) for one in numbers[:, 0]]

    def _items(self) -> list[Any]:
        if isinstance(self.values, str):
            items = [item.strip() for item in self.values.split(",")]
            unit = _unit_of(items[-1])  # 2, 400 km: the unit of the last value, as in other lists
            return [item if _unit_of(item) else f"{item} {unit}".strip() for item in items]
        return list(self.values) if isinstance(self.values, (list, tuple)) else [self.values]

    def _numbers(self) -> tuple[np.ndarray, str]:
        """Values as numbers, shape (k, m), and their unit or an empty text."""
        items = self._items()
        if not 2 <= len(items) <= LONGEST_LIST:
            shown = self.values if items else MISSING
            raise ParameterError("values", shown, _FORM)
        rows = [list(item) if isinstance(item, (list, tuple)) else [item] for item in items]
        if len({len(row) for row in rows}) > 1 or not rows[0]:
            raise ParameterError("values", self.values, "lists of equal length")
        unit = _unit_of(rows[0][0])
        numbers = [
            [_number(item, unit, f"values[{k}]") for item in row] for k, row in enumerate(rows)
        ]
        return np.array(numbers), unit


def _unit_of(item: Any) -> str:
    match = _UNIT.fullmatch(item) if isinstance(item, str) and len(item) < 100 else None
    return "" if match is None else match[1]


def _number(item: Any, unit: str, field: str) -> float:
    if bool(_unit_of(item)) != bool(unit):
        allowed = f"a number with a unit, such as {unit!r}" if unit else "a number without a unit"
        raise ParameterError(field, item, f"{allowed}, as the first")
    return quantity(item, unit or "1", field)
