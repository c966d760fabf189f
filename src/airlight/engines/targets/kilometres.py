"""Parameters of formula planets in km and km⁻¹, the units of real-time programs."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, Final

from airlight.planets.constituent import Constituent
from airlight.planets.ground import Ground
from airlight.planets.matter.phases import PhaseFunction
from airlight.planets.matter.profiles import Exponential
from airlight.planets.planet import RED_GREEN_BLUE, Planet
from airlight.planets.spectral import PerWavelength
from airlight.planets.star import Star

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


def per_km(part: Constituent | None, coefficient: str) -> list[float]:
    """Coefficients at red, green and blue, zeros if there is no such part. [km⁻¹]

    Parameters
    ----------
    part : Constituent, optional
        Constituent of ``formula_planet``.
    coefficient : str
        ``scattering`` or ``absorption``.
    """
    values: Any = 0.0 if part is None else getattr(part, coefficient)
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


def exponential_layer(
    name: str,
    height: float,
    scattering: float | PerWavelength,
    absorption: float | PerWavelength = 0.0,
    phase: PhaseFunction | None = None,
) -> Constituent:
    """Constituent of an exponential density, by its scale height [m] and coefficients [m⁻¹]."""
    return Constituent(
        name=name,
        profile=Exponential(scale_height=height),
        scattering=scattering,
        absorption=absorption,
        phase_function=phase,
    )


def planet_of(
    name: str, star: Star, radii: tuple[float, float], albedo: Any, parts: Iterable[Constituent]
) -> Planet:
    """Planet of constituents at red, green and blue, in a shell of these radii. [m]"""
    return Planet(
        name=name,
        bottom_radius=radii[0],
        top_radius=radii[1],
        ground=Ground(albedo=albedo),
        star=star,
        constituents=tuple(parts),
        default_wavelengths=RED_GREEN_BLUE,
    )
