"""Phase functions of bodies without air, against integrals over the sphere and measured light."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.physics.optics.moon_phase import (
    MOON_ALBEDO,
    MOON_REDDENING,
    lambert_phase,
    lommel_seeliger_phase,
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


def test_the_full_moon_has_its_magnitude() -> None:
    # 0.1 to 0.13 are the published geometric albedos (Velikodsky et al. 2011); a full Moon gives
    # 4e5 times less light than the sun.
    assert 0.11 < MOON_ALBEDO < 0.13
    assert_allclose(1.0 / (MOON_ALBEDO * (1737.4 / 384400.0) ** 2), 4.0e5, rtol=0.02)


def test_the_moon_is_redder_than_the_sun() -> None:
    body = Body(name="moon", radius=1737.4e3, reflection="moon")
    blue, red = body.albedos([440.0, 680.0])
    assert 1.3 < red / blue < 1.8
    assert 0.8 < MOON_REDDENING < 1.3


def test_half_moon_is_a_tenth_of_the_full_one() -> None:
    # Known since antiquity as "a half Moon is a ninth to a twelfth": 2.6 mag by the law.
    assert_allclose(-2.5 * np.log10(float(moon_phase(90.0))), 2.60, atol=0.01)
