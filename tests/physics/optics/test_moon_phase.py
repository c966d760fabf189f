"""Phase functions of bodies without air, against integrals over the sphere and measured light."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.kernel import vectorized
from airlight.physics.optics.moon_phase import (
    MOON_ALBEDO,
    MOON_REDDENING,
    earthlight,
    lambert_phase,
    lommel_seeliger_phase,
    measured_phase,
    moon_phase,
)
from airlight.scene.system.body import Body

WHOLE = {"lambert": lambert_phase, "lommel-seeliger": lommel_seeliger_phase, "moon": moon_phase}


@pytest.mark.parametrize("law", list(WHOLE))
@pytest.mark.parametrize("phase", [0.0, 30.0, 90.0, 140.0])
def test_the_surface_adds_up_to_the_sphere(law: str, phase: float) -> None:
    # Second method: the picture's own radiance, summed over the disc that the observer sees.
    n = 600
    grid = (np.arange(n) + 0.5) / n * 2.0 - 1.0
    x, y = (one.ravel() for one in np.meshgrid(grid, grid))
    seen = x * x + y * y < 1.0
    normal = np.stack([x[seen], y[seen], np.sqrt(1.0 - x[seen] ** 2 - y[seen] ** 2)], axis=-1)
    angle = np.radians(phase)
    light = np.broadcast_to([np.sin(angle), 0.0, np.cos(angle)], normal.shape)
    eye = np.broadcast_to([0.0, 0.0, 1.0], normal.shape)
    body = Body(name="x", radius=1.0, albedo=1.0, reflection=law)
    factor = body.surface_factor(normal, light, eye, np.zeros(len(normal)))
    total = factor.sum() * (2.0 / n) ** 2
    assert_allclose(total, body.brightness([550.0], phase)[0], rtol=4e-3)


#: Geometric albedo at 0 of Krisciunas & Schaefer's law: -12.73 mag, the sun -26.74 mag (Cox 2000).
MEASURED = 10.0 ** (-0.4 * (26.74 - 12.73)) * (384_400.0 / 1737.4) ** 2


def magnitudes(phase: np.ndarray) -> np.ndarray:
    """Hapke's disc less the measured law. [mag]"""
    ratio = MOON_ALBEDO * moon_phase(phase) / (MEASURED * vectorized(measured_phase)(phase))
    return np.asarray(-2.5 * np.log10(ratio))


def test_hapke_s_moon_is_as_bright_as_the_measured_one() -> None:
    # Krisciunas & Schaefer (1991) within 0.16 mag over four magnitudes, on average within 0.01 up
    # to half Moon; grains and roughness are orbiters' (Sato et al. 2014), so nothing but the level
    # is fitted.
    off = magnitudes(np.array([5.0, 10.0, 20.0, 30.0, 45.0, 60.0, 90.0, 120.0, 140.0]))
    assert np.abs(off).max() < 0.16
    assert abs(magnitudes(np.arange(10.0, 91.0, 5.0)).mean()) < 0.01


def test_the_opposition_surge_is_a_quarter() -> None:
    # Buratti, Hillier & Wang (1996), Icarus 124, 490, Clementine: more than 40 % from 4° to 0°, of
    # single places; Krisciunas & Schaefer: up to 35 % above their law below 7°.
    full, one, four = moon_phase([0.0, 1.0, 4.0])
    assert 1.25 < full / four < 1.45
    assert 1.15 < one / four < 1.35
    assert -0.33 < magnitudes(np.array([0.0]))[0] < -0.2


def test_the_full_moon_has_its_albedo() -> None:
    # Sato et al. (2014): 0.17 at opposition; without a surge 0.11 to 0.13 (Velikodsky et al. 2011).
    assert 0.14 < MOON_ALBEDO < 0.18
    assert 0.11 < MOON_ALBEDO * moon_phase(5.0) < 0.13


def test_earthshine_is_a_hundred_times_fainter_than_a_fifth_of_full_moon() -> None:
    # Danjon; Goode et al. (2001), GRL 28, 1671: the dark side is 1e-4 of the bright one's radiance
    # at new Moon, where the Earth is full: E' = p (R/d)² E with p = 0.43 (Mallama et al. 2017).
    assert_allclose(earthlight(180.0), 0.434 * (6371.0 / 384_400.0) ** 2, rtol=1e-12)
    assert 0.15 < earthlight(90.0) / earthlight(180.0) < 0.3


def test_the_moon_is_redder_than_the_sun() -> None:
    body = Body(name="moon", radius=1737.4e3, reflection="moon")
    blue, red = body.albedos([440.0, 680.0])
    assert 1.3 < red / blue < 1.8
    assert 0.8 < MOON_REDDENING < 1.3


def test_half_moon_is_a_twelfth_of_the_full_one() -> None:
    # Known since antiquity as "a half Moon is a ninth to a twelfth"; by the measured law 2.6 mag.
    assert_allclose(-2.5 * np.log10(measured_phase(90.0)), 2.60, atol=0.01)
    assert 9.0 < moon_phase(5.0) / moon_phase(90.0) < 12.0 < 1.0 / moon_phase(90.0) < 13.0
