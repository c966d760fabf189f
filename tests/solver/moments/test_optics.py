"""Optics of a medium without forward peaks, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.planets import Constituent, Ground, Planet, Star
from airlight.planets.matter.phases import HenyeyGreenstein
from airlight.planets.matter.profiles import Exponential
from airlight.planets.medium import Medium
from airlight.solver.moments.delta_m import MOST_PEAK, THIN, Optics
from airlight.solver.moments.settings import settings_for

G, SCALE_HEIGHT, ABSORBED = 0.7, 2e3, 0.25


def haze(depth: float) -> Medium:
    """Medium of one haze, whose vertical scattering depth is given, and which also absorbs."""
    planet = Planet(
        name="haze",
        bottom_radius=6360e3,
        top_radius=6460e3,
        ground=Ground(albedo=0.2),
        star=Star(irradiance=1.0, angular_radius=0.0),
        constituents=(
            Constituent(
                name="haze", profile=Exponential(scale_height=SCALE_HEIGHT),
                scattering=depth / SCALE_HEIGHT, absorption=ABSORBED * depth / SCALE_HEIGHT,
                phase_function=HenyeyGreenstein(asymmetry=G),
            ),
        ),
        default_wavelengths=(550.0,),
    )  # fmt: skip
    return Medium.from_planet(planet, planet.default_wavelengths)


@pytest.mark.parametrize("depth", [1e-3, 0.1, 3.0])
@pytest.mark.parametrize("degree", [2, 5])
def test_the_forward_peak_is_cut_as_delta_m_says(depth: float, degree: int) -> None:
    # Wiscombe (1977): f = g^(N+1), moments g^l - f, here faded in by 1 - exp(-(τ/THIN)²)
    optics = Optics(haze(depth), degree)
    weight = -np.expm1(-((depth / THIN) ** 2))
    f = min(G ** (degree + 1), MOST_PEAK) * weight
    sigma = depth / SCALE_HEIGHT
    air = optics.air(slice(None))
    # the column of the shell's 50 scale heights is one scale height; coefficients are float32
    assert_allclose(optics.peak_weight, weight, rtol=1e-6)
    assert_allclose(air.extinction, sigma * (1.0 + ABSORBED - f), rtol=1e-6)
    moments = sigma * (G ** np.arange(degree + 1) - f)
    assert_allclose(air.moments.reshape(degree + 1, -1), moments[:, None] * np.ones(8), rtol=1e-5)
    assert_allclose(optics.scattering_depth, depth * (1.0 - f), rtol=1e-6)
    assert_allclose(optics.transport_depth, depth * (1.0 + ABSORBED - G), rtol=1e-6)
    # all of the depth lies below the top, and the table of depths follows the exponential
    assert_allclose(optics.depths.scattering[-1], optics.scattering_depth[0], rtol=1e-3)


def test_the_degree_follows_the_thickness_of_a_haze() -> None:
    # a peak that is cut wholly needs more harmonics, and a thin one no more than clear air
    settings = settings_for("default")
    thin, thick = (Optics.chosen(haze(depth), settings).degree for depth in (1e-3, 3.0))
    assert thin == settings.degree
    assert thick == settings.thick_degree
