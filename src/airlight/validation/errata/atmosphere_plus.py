"""Errata of the Atmosphere Plus notes and of the walk through Bruneton's transmittance."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Final

import numpy as np

from airlight.geometry.shell import distance_to_top, radius_along
from airlight.kernel import vectorized
from airlight.kernel.threads import Progress
from airlight.mappings.weighted_power import (
    DEFAULT_LOWER_WEIGHT,
    DEFAULT_SURFACE_OFFSET,
    DEFAULT_SURFACE_SLOPE,
    lower_weight,
    surface_weight,
)
from airlight.optics.density_profile import segment_density
from airlight.optics.legendre import phase_integral
from airlight.optics.phase_functions import INV_4PI, rayleigh_modified
from airlight.optics.rayleigh import cross_section
from airlight.planets import Medium, load_planet
from airlight.solvers.direct.settings import Settings
from airlight.solvers.direct.solution import solve
from airlight.validation.errata.erratum import Erratum, floats

#: Number density of the first notes, as printed and with its digits in order. [m⁻³]
PRINTED_DENSITY: Final = 2.454e25
DENSITY: Final = 2.545e25
#: Wavelengths of the first notes [nm], refractivity, planet's radius [m] and scale height [m].
AP1_WAVELENGTHS: Final = (650.0, 510.0, 475.0)
AP1_REFRACTIVITY: Final = 3e-4
AP1_RADIUS: Final = 6.371e6
SCALE_HEIGHT: Final = 8e3
#: Albedo of the ground for the order-by-order sums, and a table coarse enough to fill in a second:
#: both sums are 0.4 % too low or too high together, so that their ratio is unaffected.
_GROUND: Final = 0.3
_COARSE: Final = Settings(
    radii=10, views=12, sun_angles=16, scatter_angles=6, zenith_steps=6, azimuth_steps=12, steps=12,
    pass_steps=8, orders=12, keep_orders=False,
)  # fmt: skip
#: Radii of the later notes and of Bruneton. [m]
BOTTOM: Final = 6.36e6
TOP: Final = 6.46e6


def first_notes() -> list[Erratum]:
    """The rows of AP1."""
    return [
        _number_density(),
        Erratum(
            source="AP1 1a §1.6, 1b §1.8",
            printed="N_M undefined",
            here="particles by coefficients, size distribution or turbidity",
            remark="no number follows from β_M = 4π N_M α_M",
        ),
        _modified_rayleigh(),
        _lost_minus(),
        _lost_dot(),
    ]


def later_notes(progress: Progress | None = None) -> list[Erratum]:
    """The rows of AP2; the order-by-order row solves a planet."""
    return [
        _aerosol_absorption(),
        _ground_light(),
        _orders(progress),
        _weights(),
    ]


def bruneton_walk() -> list[Erratum]:
    """The rows of BT."""
    return [_root(), _zenith_angle()]


def _number_density() -> Erratum:
    def coefficients(density: float) -> tuple[float, ...]:
        sigma = cross_section(AP1_WAVELENGTHS, AP1_REFRACTIVITY, density)
        return floats(1e6 * density * sigma)

    return Erratum(
        source="AP1 1a §1.6, 1b §1.8",
        printed="N_R = 2.454e25",
        here="N_R = 2.545e25 m⁻³",
        quantity="β_R at 650, 510, 475 nm, n = 1.0003",
        unit="1e-6 m⁻¹",
        as_printed=coefficients(PRINTED_DENSITY),
        as_here=coefficients(DENSITY),
        remark="two digits swapped: the notes' own 6.55, 17.3, 23.0 follow from 2.545e25",
    )


def _modified_rayleigh() -> Erratum:
    def printed(nu: np.ndarray) -> np.ndarray:
        return np.asarray(0.8 * INV_4PI * (1.4 + 0.5 * nu * nu))

    ends = np.array([1.0, -1.0])
    here = vectorized(rayleigh_modified)
    both = [floats([*(phase(ends) / INV_4PI), phase_integral(phase)]) for phase in (printed, here)]
    return Erratum(
        source="AP1 1a §1.5, 1b §1.7",
        printed="F_R = 8/10 (7/5 + 1/2 cos²θ)",
        here="8/10 (7/5 + 1/2 cos θ), an option of figures only",
        quantity="F_R straight on, straight back, and its mean over the sphere",
        as_printed=both[0],
        as_here=both[1],
        remark="neither has the mean 1: both make light",
    )


def _lost_minus() -> Erratum:
    height = 1e3
    product = (AP1_RADIUS + height) * AP1_RADIUS
    return Erratum(
        source="AP1 1b",
        printed="h(P) = |P| R_p, P = P₁ + s(P₂ P₁)",
        here="|P| - R_p, P₁ + s(P₂ - P₁), as 1a prints",
        quantity="relative density 1 km up, H = 8 km",
        as_printed=(segment_density(product, 1.0, -1.0 / SCALE_HEIGHT, 0.0, 0.0),),
        as_here=(segment_density(height, 1.0, -1.0 / SCALE_HEIGHT, 0.0, 0.0),),
        remark="minus signs lost in print",
    )


def _lost_dot() -> Erratum:
    apart = math.radians(60.0)
    view, sun = np.array([1.0, 0.0]), np.array([math.cos(apart), math.sin(apart)])
    determinant = float(view[0] * sun[1] - view[1] * sun[0])
    return Erratum(
        source="AP1 1b",
        printed="cos ω = det(proj V, proj -L)",
        here="dot, as 1a prints",
        quantity="azimuth of a view 60° beside the sun",
        unit="deg",
        as_printed=(math.degrees(math.acos(determinant)),),
        as_here=(math.degrees(math.acos(float(view @ sun))),),
    )


def _aerosol_absorption() -> Erratum:
    def values(name: str) -> tuple[float, ...]:
        medium = Medium.from_planet(load_planet(name), [550.0])
        return floats([medium.single_scattering_albedo[1, 0], medium.vertical_optical_depth[1, 0]])

    return Erratum(
        source="AP2 §1.7",
        printed="β_M^a = 4.40e-6",
        here="β_M^a = 0.444e-6 m⁻¹",
        quantity="aerosol: single-scattering albedo, vertical optical depth",
        as_printed=values("earth-atmosphere-plus-literal"),
        as_here=values("earth-atmosphere-plus"),
        remark="a misprint of the extinction 4.44e-6; presets earth-atmosphere-plus-literal and "
        "earth-atmosphere-plus",
    )


def _ground_light() -> Erratum:
    albedo = 0.1
    normal = np.array([0.0, 1.0])
    zenith = math.radians(60.0)
    to_sun = np.array([math.sin(zenith), math.cos(zenith)])
    return Erratum(
        source="AP2 §2.2",
        printed="D = C·dot(N, L)·I·T, L from the sun",
        here="albedo/π · max(0, N·sun) E₀ T",
        quantity="ground's radiance over E₀T, albedo 0.1, sun 60° from the zenith",
        unit="sr⁻¹",
        as_printed=(albedo * float(normal @ -to_sun),),
        as_here=(albedo / math.pi * max(0.0, float(normal @ to_sun)),),
        remark="L points away from the sun; the notes bring 1/π later, in H",
    )


def _orders(progress: Progress | None) -> Erratum:
    planet = load_planet("earth-atmosphere-plus", {"ground.albedo": _GROUND})
    medium = Medium.from_planet(planet, [440.0])

    def zenith(literal: str) -> float:
        settings = replace(_COARSE, literal=literal)
        solution = solve(medium, settings, cache=False, progress=progress)
        return float(solution.radiance(altitude=0.0, sun_zenith=30.0, view_zenith=0.0).values[0])

    return Erratum(
        source="AP2 §2.4",
        printed="H⁽¹⁾ = S⁽¹⁾, H⁽²⁾ = S⁽²⁾ + D·T/π, H⁽ᵏ⁾ = S⁽ᵏ⁾ + A⁽ᵏ⁾·T/π for k > 2",
        here="H⁽¹⁾ = S⁽¹⁾ + D·T, H⁽ᵏ⁾ = S⁽ᵏ⁾ + A⁽ᵏ⁾·T for k ≥ 2, albedo/π inside",
        quantity=f"radiance of the zenith at 440 nm, sun at 30°, ground of albedo {_GROUND:g}",
        unit="W m⁻² sr⁻¹ nm⁻¹",
        as_printed=(zenith("atmosphere-plus-2"),),
        as_here=(zenith(""),),
        remark="D joins one order late and A⁽²⁾ never lights the air",
    )


def _weights() -> Erratum:
    def top(slope: float, offset: float) -> tuple[float, ...]:
        lower, surface = lower_weight(1.0, DEFAULT_LOWER_WEIGHT), surface_weight(1.0, slope, offset)
        return floats([surface, 1.0 - lower - surface])

    ends = (DEFAULT_SURFACE_SLOPE + DEFAULT_SURFACE_OFFSET, DEFAULT_SURFACE_OFFSET)
    return Erratum(
        source="AP2 §3.1.4",
        printed="w_S = w_S¹u + w_S⁰ with w_S¹, w_S⁰ = 4/32, 4/32",
        here="slope and offset, the same as from 4/32 to 8/32; never mixed",
        quantity="w_S and w_U at the top, if the ends are taken for slope and offset",
        as_printed=top(*ends),
        as_here=top(DEFAULT_SURFACE_SLOPE, DEFAULT_SURFACE_OFFSET),
        remark="that reading leaves the sky no room",
    )


def _root() -> Erratum:
    r, zenith = BOTTOM, math.radians(60.0)
    mu, sine = math.cos(zenith), math.sin(zenith)
    return Erratum(
        source="BT",
        printed="d = -rμ + √(r_top² - r² sin θ)",
        here="r² sin²θ",
        quantity="from the ground to the top, 60° from the zenith",
        unit="km",
        as_printed=(1e-3 * (-r * mu + math.sqrt(TOP * TOP - r * r * sine)),),
        as_here=(1e-3 * distance_to_top(r, mu, TOP),),
    )


def _zenith_angle() -> Erratum:
    r, mu, distance = BOTTOM, math.cos(math.radians(80.0)), 200e3
    at_q = (r * mu + distance) / radius_along(r, mu, distance)
    return Erratum(
        source="BT",
        printed="μ_d: the zenith angle at p",
        here="at q, the point at distance d",
        quantity="zenith angle 200 km along a ray that leaves the ground at 80°",
        unit="deg",
        as_printed=(math.degrees(math.acos(mu)),),
        as_here=(math.degrees(math.acos(at_q)),),
    )
