"""Catalogue of stars: brightness by the sun's own, colours, and known places."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.physics.spectra.sun import solar_irradiance
from airlight.scene.system.stars import Stars, color_temperatures, stars


def test_the_sun_as_a_star_has_its_irradiance() -> None:
    sun = Stars(np.array([[1.0, 0.0, 0.0]]), np.array([-26.74]), np.array([0.65]))
    assert_allclose(sun.irradiances([550.0])[0], solar_irradiance([550.0]), rtol=0.05)
    assert_allclose(color_temperatures(sun.colors), 5772.0, rtol=0.02)


def test_the_catalogue_is_whole() -> None:
    # The Yale catalogue has 9 096 stars to about the same magnitude; 5 000 to 6.0 is the textbook's
    # number of what an eye sees.
    catalogue = stars()
    assert 8_500 < catalogue.magnitudes.size < 9_500
    assert 4_700 < int((catalogue.magnitudes <= 6.0).sum()) < 5_300
    assert_allclose(np.linalg.norm(catalogue.directions, axis=1), 1.0, rtol=1e-12)
    assert np.all(np.diff(catalogue.magnitudes) >= 0.0)


@pytest.mark.parametrize(
    ("magnitude", "ascension", "declination", "red"),
    [(-1.44, 101.287, -16.716, False), (0.45, 88.793, 7.407, True), (1.97, 37.954, 89.264, False)],
    ids=["Sirius", "Betelgeuse", "Polaris"],
)
def test_known_stars(magnitude: float, ascension: float, declination: float, red: bool) -> None:
    a, d = np.radians([ascension, declination])
    towards = np.array([np.cos(d) * np.cos(a), np.cos(d) * np.sin(a), np.sin(d)])
    catalogue = stars()
    k = int(np.argmax(catalogue.directions @ towards))
    assert catalogue.directions[k] @ towards > np.cos(np.radians(0.02))
    assert catalogue.magnitudes[k] == pytest.approx(magnitude, abs=0.05)
    blue, far_red = catalogue.irradiances([440.0, 680.0])[k]
    assert (far_red > blue) == red
