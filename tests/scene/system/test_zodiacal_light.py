"""Zodiacal light: published brightness and symmetry."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray

from airlight.physics.spectra.sun import solar_irradiance
from airlight.scene.system.milky_way import Sun, milky_way_radiance, starlight
from airlight.scene.system.zodiacal_light import ECLIPTIC_POLE, zodiacal_light

POLE = np.array(ECLIPTIC_POLE)
#: The March equinox, and the directions 90° from it along the ecliptic.
SUN = np.array([1.0, 0.0, 0.0])
EAST = np.cross(POLE, SUN)


def towards(longitude: float, latitude: float) -> NDArray[np.float64]:
    """Direction of a longitude from the sun and an ecliptic latitude. [deg]"""
    a, d = np.radians([longitude, latitude])
    return np.asarray(np.cos(d) * (np.cos(a) * SUN + np.sin(a) * EAST) + np.sin(d) * POLE)


@pytest.mark.parametrize(
    ("longitude", "latitude", "published"),
    # Leinert et al. (1998), Table 16, in S10; half a unit of its last digit and the conversion.
    [(90.0, 0.0, 202.0), (180.0, 0.0, 180.0), (0.0, 90.0, 60.0), (60.0, 30.0, 143.0)],
)
def test_it_has_the_published_brightness(
    longitude: float, latitude: float, published: float
) -> None:
    # Symmetric to the ecliptic and to the sun's meridian.
    for one, other in ((1, 1), (-1, 1), (1, -1)):
        place = towards(one * longitude, other * latitude)[None]
        assert_allclose(zodiacal_light(place, SUN), published, rtol=0.01)


def test_it_falls_with_the_distance_from_the_sun() -> None:
    # Leinert et al. (1998), section 8.3: as the distance to the power of -2.3.
    place = towards(120.0, 10.0)[None]
    far = zodiacal_light(place, SUN, 1.52)
    assert_allclose(far, 1.52**-2.3 * zodiacal_light(place, SUN), rtol=1e-12)


def test_it_is_added_to_starlight_in_sunlight() -> None:
    # Leinert et al. (1998), Table 19: 2.6e-9 W m⁻² sr⁻¹ nm⁻¹ at 500 nm, 90° from the sun. The map
    # adds it to the stars beyond the catalogue.
    place, sun = towards(90.0, 0.0)[None], Sun(*SUN.tolist(), 1.0)
    nm = np.array([500.0, 440.0, 640.0])
    light = (milky_way_radiance(place, nm, sun) - milky_way_radiance(place, nm))[0]
    assert_allclose(light[0], 2.6e-9, rtol=0.1)
    # of the sun's colour, a little redder
    shape = light[2] / light[1] / (solar_irradiance(640.0) / solar_irradiance(440.0))
    assert 1.0 < shape < 1.35
    added = starlight(place, sun) - starlight(place)
    assert_allclose(added, zodiacal_light(place, SUN), rtol=2e-3)
