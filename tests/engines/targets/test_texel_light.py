"""Fit of two tables along the angle to the sun."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose

from airlight.engines.targets.fits.texel_light import STEP, TexelFit
from airlight.engines.targets.fits.weighted_lobe import hat_functions
from airlight.kernel import vectorized
from airlight.physics.optics.phase_functions import cornette_shanks, rayleigh

ANGLES, G = 8, 0.7
FINE = np.linspace(-1.0, 1.0, STEP * (ANGLES - 1) + 1)


def fit() -> TexelFit:
    """Fit of light without particles that are scattered once."""
    return TexelFit(G, ANGLES, lambda nu: np.zeros((0, nu.size, 1)))


def light(tables: np.ndarray, nu: np.ndarray) -> np.ndarray:
    """Light of tables (n, 2·angles) at angles, by the formula of the look-up."""
    hats = hat_functions(nu, ANGLES)
    even, lobe = vectorized(rayleigh)(nu, 0.0), vectorized(cornette_shanks)(nu, G)
    return np.asarray(tables @ np.hstack([hats * even[:, None], hats * lobe[:, None]]).T)


def test_light_of_the_look_up_s_own_form_is_met() -> None:
    # an exact limit: S and M are not unique, the light is; the start weighs 1e-5
    tables = np.random.default_rng(2).uniform(0.5, 2.0, (20, 2 * ANGLES))
    even = vectorized(rayleigh)(FINE, 0.0)
    smooth = (light(tables, FINE) / even)[..., None]
    found = fit().fitted(smooth, [], np.ones((20, 2 * ANGLES, 1)), signed=np.full(20, True))
    # ahead of the last but one of the fine angles the light is read linearly in the angle
    behind = FINE[FINE < 0.7]
    assert_allclose(light(found[..., 0], behind), light(tables, behind), rtol=5e-3)
    held = fit().fitted(smooth, [], np.ones((20, 2 * ANGLES, 1)), signed=np.full(20, False))
    assert held.min() >= 0.0


def test_a_glow_between_the_angles_is_nearer_than_by_the_angles_alone() -> None:
    # least squares of relative errors: never worse than the start, at the angles that are fitted
    even = vectorized(rayleigh)(FINE, 0.0)
    glow = 1.0 + 4.0 * np.exp(-(((np.degrees(np.arccos(FINE)) - 25.0) / 12.0) ** 2))
    smooth = (glow / even)[None, :, None]
    start = np.zeros((1, 2 * ANGLES, 1))
    start[0, :ANGLES, 0] = smooth[0, ::STEP, 0]
    found = fit().fitted(smooth, [], start, signed=np.array([True]))
    errors = [np.abs(light(one[..., 0], FINE[:-1])[0] / glow[:-1] - 1.0) for one in (start, found)]
    assert np.sqrt((errors[1] ** 2).mean()) < 0.5 * np.sqrt((errors[0] ** 2).mean())
