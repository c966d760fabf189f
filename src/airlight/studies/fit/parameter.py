"""Parameter of a fit: start, bounds, prior, and step of finite differences."""

from __future__ import annotations

import math
from dataclasses import dataclass

from airlight.errors import ParameterError
from airlight.physics.units import Measure, quantity
from airlight.planets.schema.measures import DOBSON, column_of_gas, converted


@dataclass(frozen=True, kw_only=True)
class Prior:
    """Gaussian prior of a parameter.

    Attributes
    ----------
    mean, sigma : float
        Mean and standard deviation, in the parameter's unit.
    """

    mean: float
    sigma: float


@dataclass(frozen=True, kw_only=True)
class FitParameter:
    """Parameter of a fit.

    Attributes
    ----------
    name : str
        Name: ``aerosol.optical_depth``, ``scale``.
    unit : str
        Unit of all numbers here; ``1`` for none.
    start : float
        Initial value, within the bounds.
    low, high : float
        Bounds.
    least_step : float
        Smallest step of a finite difference: larger than the solver's rounding, smaller than the
        parameter's scale.
    prior : Prior, optional
        Prior.
    """

    name: str
    unit: str = "1"
    start: float
    low: float
    high: float
    least_step: float
    prior: Prior | None = None

    def __post_init__(self) -> None:
        if not self.low < self.high:
            raise ParameterError(
                f"bounds of {self.name}", f"{self.low:g}..{self.high:g}", "low below high"
            )
        if not self.low <= self.start <= self.high:
            raise ParameterError(f"start of {self.name}", self.start, self.range_text)

    def number(self, value: Measure, field: str) -> float:
        """Value as a number in the parameter's unit.

        Examples
        --------
        >>> height = FitParameter(name="h", unit="km", start=1.0, low=0.5, high=9.0, least_step=0.1)
        >>> height.number("1200 m", "start of h"), height.number(1.2, "start of h")
        (1.2, 1.2)
        """
        if isinstance(value, (int, float)) or self.unit != DOBSON:
            return quantity(value, self.unit, field, bare=True)
        return converted(column_of_gas(value, field), "1/m^2", DOBSON)

    @property
    def range_text(self) -> str:
        """Bounds in words.

        Examples
        --------
        >>> height = FitParameter(name="h", unit="km", start=1.0, low=0.5, high=9.0, least_step=0.1)
        >>> height.range_text
        '0.5 to 9 km'
        """
        return f"{self.low:g} to {self.high:g} {self.unit.removeprefix('1')}".rstrip()

    @property
    def unit_text(self) -> str:
        """Unit with a leading space; empty for a pure number."""
        return "" if self.unit == "1" else f" {self.unit}"

    def step(self, value: float) -> float:
        """Step of a difference at a value: 2 % of it, at least ``least_step``, within the bounds.

        Negative if the upper bound would be exceeded.

        Examples
        --------
        >>> one = FitParameter(name="albedo", start=0.1, low=0.0, high=1.0, least_step=0.005)
        >>> one.step(0.1), one.step(1.0)
        (0.005, -0.02)
        """
        size = min(max(0.02 * abs(value), self.least_step), 0.5 * (self.high - self.low))
        return size if value + size <= self.high else -size

    def sigmas_from_prior(self, value: float) -> float:
        """Distance from the prior's mean in standard deviations; 0 without a prior."""
        return 0.0 if self.prior is None else (value - self.prior.mean) / self.prior.sigma

    @property
    def width(self) -> float:
        """Standard deviation of the uniform distribution between the bounds."""
        return (self.high - self.low) / math.sqrt(12.0)
