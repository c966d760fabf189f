"""Every sampler against its own phase function: χ² over equal shares of the scattered light."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.stats import chisquare

from airlight.geometry.quadrature import gauss_legendre
from airlight.kernel import compiled_loop, kernel
from airlight.planets import Medium, Planet
from airlight.planets.matter.phases import (
    CornetteShanks,
    DoubleHenyeyGreenstein,
    FormulaPhase,
    HenyeyGreenstein,
    Rayleigh,
    TabulatedPhase,
)
from airlight.planets.parameters import parameters
from airlight.planets.schema.field import Field
from airlight.solver.montecarlo.scattering_angles import (
    EXACT,
    henyey_greenstein_cosine,
    lobe_value,
    lobes,
    random_cosine,
    rayleigh_cosine,
)
from airlight.solver.montecarlo.streams import stream

SAMPLES, BINS = 400_000, 60


@kernel
def tilted(nu, tilt):
    """(1 + tilt ν)/(4π), which no sampler knows. [sr⁻¹]"""
    return (1.0 + tilt * nu) / (4.0 * 3.141592653589793)


@parameters
class Tilted(FormulaPhase):
    keyword = "tilted"
    formula = staticmethod(tilted)

    tilt: Annotated[float, Field(label="tilt", help="-", range=(-1.0, 1.0), spectral=True)]


def table(wavelengths: tuple[float, ...] = ()) -> TabulatedPhase:
    """Coarse angles, a peak of four decades, a stretch of zeros; normalised here."""
    angles = np.array([0.0, 0.2, 1.0, 3.0, 8.0, 20.0, 45.0, 90.0, 120.0, 130.0, 150.0, 180.0])
    rows = []
    for power in (1.0, 0.6)[: max(1, len(wavelengths))]:
        values = (1e4 / (1.0 + (angles / 0.5) ** 2)) ** power + 0.02
        values[8:10] = 0.0
        first, second = angles[:-1], angles[1:]
        rule = gauss_legendre(40)
        theta = first[:, None] + (second - first)[:, None] * rule.nodes
        low, high = values[:-1, None], values[1:, None]
        logarithmic = (low > 0.0) & (high > 0.0)
        safe = np.where(logarithmic, low, 1.0), np.where(logarithmic, high, 1.0)
        p = np.where(
            logarithmic, safe[0] * (safe[1] / safe[0]) ** rule.nodes,
            low + (high - low) * rule.nodes,
        )  # fmt: skip
        ring = np.radians(second - first)[:, None] * np.sin(np.radians(theta)) * p
        rows.append(tuple(values / (2.0 * np.pi * (ring @ rule.weights).sum())))
    return TabulatedPhase(angles=tuple(angles), rows=tuple(rows), wavelengths=wavelengths)


PHASES = {
    "rayleigh": Rayleigh(),
    "rayleigh, rods": Rayleigh(depolarisation=0.5),
    "henyey-greenstein 0": HenyeyGreenstein(asymmetry=0.0),
    "henyey-greenstein 1e-9": HenyeyGreenstein(asymmetry=1e-9),
    "henyey-greenstein 0.8": HenyeyGreenstein(asymmetry=0.8),
    "henyey-greenstein 0.99": HenyeyGreenstein(asymmetry=0.99),
    "henyey-greenstein -0.5": HenyeyGreenstein(asymmetry=-0.5),
    "double": DoubleHenyeyGreenstein(asymmetry_1=0.889, asymmetry_2=-0.3, weight=0.743),
    "cornette-shanks 0.8": CornetteShanks(asymmetry=0.8),
    "cornette-shanks -0.3": CornetteShanks(asymmetry=-0.3),
    "a formula without a sampler": Tilted(tilt=0.8),
    "table": table(),
    "two tables mixed": table((500.0, 700.0)),
}


@compiled_loop
def draw(lobes, state, out):
    for k in range(out.size):
        out[k] = random_cosine(lobes, 0, state)


@compiled_loop
def values(lobes, nu, out):
    for k in range(out.size):
        out[k] = lobe_value(lobes, 0, nu[k])


def cumulative(phase: Any, angles: np.ndarray) -> np.ndarray:
    """Light scattered by less than each angle [rad], by fine quadrature of the public values."""
    corners = np.radians(getattr(phase, "angles", ()))
    edges = np.unique(np.concatenate([angles, corners[corners <= angles[-1]]]))
    rule = gauss_legendre(12)
    width = np.diff(edges)[:, None]
    theta = edges[:-1, None] + width * rule.nodes
    p = phase.values(np.cos(theta), [600.0])[..., 0]
    pieces = 2.0 * np.pi * (p * np.sin(theta) * width) @ rule.weights
    return np.interp(angles, edges, np.concatenate([[0.0], np.cumsum(pieces)]))


@pytest.fixture
def medium_of(one_air: Callable[..., Planet]) -> Callable[[Any], Medium]:
    return lambda phase: Medium.from_planet(one_air(phase=phase), [600.0])


@pytest.mark.parametrize("name", list(PHASES))
def test_cosines_follow_the_phase_function(
    name: str, medium_of: Callable[[Any], Medium], tell: Callable[[str], None]
) -> None:
    # The law that the sampler is made for; χ² of 60 bins that hold equal light by a quadrature of
    # the public phase function. Fixed seed: p > 0.001, which a right sampler misses once in 1000.
    phase = PHASES[name]
    grid = np.pi * np.linspace(0.0, 1.0, 20_001) ** 3
    light = cumulative(phase, grid)
    assert_allclose(light[-1], 1.0, atol=1e-3)
    light /= light[-1]
    edges = np.interp(np.linspace(0.0, 1.0, BINS + 1), light, grid)
    drawn = np.empty(SAMPLES)
    draw(lobes(medium_of(phase), 0), stream(11, len(name)), drawn)
    assert np.abs(drawn).max() <= 1.0
    counts, _ = np.histogram(np.arccos(drawn), edges)
    expected = np.diff(np.interp(edges, grid, light)) * SAMPLES
    result = chisquare(counts, expected * counts.sum() / expected.sum())
    tell(f"cosines, {name}: chi² {result.statistic:.0f} of {BINS - 1}, p {result.pvalue:.3f}")
    assert counts.sum() > 0.999 * SAMPLES
    assert result.pvalue > 1e-3


@pytest.mark.parametrize("name", list(PHASES))
def test_values_are_the_planet_s_own(name: str, medium_of: Callable[[Any], Medium]) -> None:
    # A second way to the same function; tables are normalised here to better than 0.001.
    medium = medium_of(PHASES[name])
    nu = np.cos(np.linspace(0.0, np.pi, 500))
    got = np.empty(nu.size)
    values(lobes(medium, 0), nu, got)
    # a formula without a sampler of its own comes as a table that is good to 1e-5
    rtol = 1e-6 if PHASES[name].keyword in (*EXACT, "tabulated") else 2e-5
    assert_allclose(got, medium.phase_function(nu)[:, 0, 0], rtol=rtol, atol=1e-12)


def test_closed_forms_invert_the_distribution_functions() -> None:
    # ∫ from -1 to ν of the phase functions has closed forms; u must come back.
    u = np.linspace(0.0, 1.0, 101)
    for delta in (0.0, 0.03, 0.5):
        nu = np.array([rayleigh_cosine(x, delta) for x in u])
        gamma = delta / (2.0 - delta)
        a, b = 1.0 + 3.0 * gamma, 1.0 - gamma
        back = 0.5 + (a * nu + b * nu**3 / 3.0) / (2.0 * (a + b / 3.0))
        assert_allclose(back, u, atol=1e-12)
    for g in (0.3, -0.7, 0.95):
        nu = np.array([henyey_greenstein_cosine(x, g) for x in u])
        root = np.sqrt(1.0 + g * g - 2.0 * g * nu)
        back = (1.0 - g * g) / (2.0 * g) * (1.0 / root - 1.0 / (1.0 + g))
        assert_allclose(back, u, atol=1e-11)


def test_a_constituent_that_does_not_scatter_has_no_lobe(
    reference_earth: Callable[..., Planet],
) -> None:
    # Ozone only absorbs.
    medium = Medium.from_planet(reference_earth(albedo=0.0), [550.0])
    assert lobes(medium, 0).kinds.tolist() == [1, 4, 0]
