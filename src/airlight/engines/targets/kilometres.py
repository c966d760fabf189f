"""Parameters of formula planets in km and km⁻¹, the units of real-time programs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

from airlight.planets.constituent import Constituent
from airlight.planets.matter.profiles import Exponential
from airlight.planets.planet import RED_GREEN_BLUE
from airlight.planets.spectral import PerWavelength

#: Significant digits of a number: more than single precision has.
_DIGITS: Final = 8
#: Scale height written for a missing constituent. [km]
NO_HEIGHT: Final = 8.0


def rounded(value: float) -> float:
    """Number rounded to eight digits.

    Examples
    --------
    >>> rounded(0.123456789012)
    0.12345679
    """
    return float(f"{value:.{_DIGITS}g}")


def per_km(values: Any) -> list[float]:
    """Coefficients at red, green and blue. [km⁻¹]"""
    if isinstance(values, PerWavelength):
        return [rounded(1e3 * value) for value in values.values]
    return [rounded(1e3 * float(values))] * len(RED_GREEN_BLUE)


def per_metre(values: Sequence[float]) -> PerWavelength:
    """Coefficients at red, green and blue as a spectral parameter. [m⁻¹]

    Parameters
    ----------
    values : sequence of three floats
        Coefficients. [km⁻¹]
    """
    listed = tuple(1e-3 * float(one) for one in values)
    return PerWavelength(wavelengths=RED_GREEN_BLUE, values=listed)


def scale_height_km(part: Constituent | None) -> float:
    """Scale height of a constituent; ``NO_HEIGHT`` without one. [km]"""
    if part is None:
        return NO_HEIGHT
    assert isinstance(part.profile, Exponential)
    return rounded(part.profile.scale_height / 1e3)
