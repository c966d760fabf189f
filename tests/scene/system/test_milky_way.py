"""Milky Way: published brightness, and known places in the sky."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray

from airlight.physics.constants import LUMINOUS_EFFICACY
from airlight.physics.spectra.sun import solar_irradiance
from airlight.scene.system.milky_way import galactic_axes, milky_way_radiance, starlight
from airlight.scene.system.stars import stars


def equatorial(ascension: float, declination: float) -> NDArray[np.float64]:
    """Direction of right ascension and declination."""
    a, d = np.radians([ascension, declination])
    return np.array([np.cos(d) * np.cos(a), np.cos(d) * np.sin(a), np.sin(d)])


def galactic(longitude: float, latitude: float) -> NDArray[np.float64]:
    """Direction of galactic coordinates."""
    return np.asarray(equatorial(longitude, latitude) @ galactic_axes())


def surface_brightness(direction: NDArray[np.float64], radius: float = 1.5) -> float:
    """Mean of a disc, V per square second of arc. [mag]"""
    offsets = np.random.default_rng(2).normal(0.0, np.radians(radius) / 2.0, (400, 3))
    around = direction + offsets
    around /= np.linalg.norm(around, axis=-1, keepdims=True)
    return float(27.78 - 2.5 * np.log10(starlight(around).mean()))


@pytest.mark.parametrize(
    ("place", "magnitude", "tolerance"),
    [
        # The large Sagittarius cloud and the pole are what the map was scaled by; clouds of the
        # band are 21 to 21.5, its faint parts about 22 (Leinert et al. 1998, A&AS 127, 1, section
        # 10).
        ((1.5, -4.0), 20.8, 0.15),
        ((27.0, -3.0), 21.3, 0.4),
        ((287.0, -1.0), 21.2, 0.4),
        ((180.0, 0.0), 22.2, 0.4),
        ((0.0, 90.0), 24.15, 0.1),
    ],
)
def test_the_milky_way_has_its_brightness(
    place: tuple[float, float], magnitude: float, tolerance: float
) -> None:
    assert surface_brightness(galactic(*place)) == pytest.approx(magnitude, abs=tolerance)


def test_starlight_adds_up_to_the_sky_s() -> None:
    # Roach & Gordon (1973): 105 S10 on average, with the stars that the catalogue has.
    points = np.random.default_rng(3).normal(size=(40_000, 3))
    points /= np.linalg.norm(points, axis=-1, keepdims=True)
    bright = 1e4 * (10.0 ** (-0.4 * stars().magnitudes)).sum() / 41_253.0
    assert_allclose(starlight(points).mean() + bright, 105.0, rtol=0.02)


def test_clouds_are_where_they_are() -> None:
    # The Large Magellanic Cloud and the Carina nebula stand out; the mirrored sky has neither.
    for ascension, declination in ((80.9, -69.8), (161.3, -59.9)):
        there = surface_brightness(equatorial(ascension, declination))
        assert there < surface_brightness(equatorial(-ascension, declination)) - 0.5


def test_radiance_is_that_of_sunlike_stars() -> None:
    # V = 21 per square second of arc is 10.8e4 · 10^(-0.4 · 21) cd/m² (Garstang 1986): the map's
    # brightness there, as a luminance by the eye's weights within 10 %.
    nm = np.arange(400.0, 701.0, 10.0)
    direction = galactic(1.5, -4.0)[None]
    weight = np.exp(-0.5 * ((nm - 559.0) / 42.0) ** 2)  # close to the photopic curve
    radiance = milky_way_radiance(direction, nm)[0]
    seen = LUMINOUS_EFFICACY * 10.0 * float(radiance @ weight)
    magnitude = 27.78 - 2.5 * np.log10(starlight(direction)[0])
    assert_allclose(seen, 10.8e4 * 10.0 ** (-0.4 * magnitude), rtol=0.1)
    sun = solar_irradiance(nm)
    assert radiance[-1] / radiance[0] > 1.2 * sun[-1] / sun[0]
