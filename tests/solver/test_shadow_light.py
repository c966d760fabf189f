"""Light behind a planet: the umbra as published, its penumbra, and an independent quadrature."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

import airlight
from airlight.errors import ParameterError
from airlight.geometry.disc_overlap import visible_light
from airlight.solver.disc_light import disc_light
from airlight.solver.shadow_light import ShadowLight

MOON = 384_400e3
NM = (680.0, 600.0, 550.0, 440.0)


def earth(*kept: str) -> airlight.Planet:
    planet = airlight.load_planet("earth")
    return airlight.replace(
        planet, constituents=tuple(c for c in planet.constituents if c.name in kept)
    )


@pytest.fixture(scope="module")
def molecules() -> ShadowLight:
    return ShadowLight(airlight.solve(earth("air"), NM, quality="preview"), MOON)


@pytest.fixture(scope="module")
def whole() -> ShadowLight:
    return ShadowLight(airlight.solve(airlight.load_planet("earth"), NM, quality="preview"), MOON)


def test_the_centre_of_the_umbra_of_pure_air(molecules: ShadowLight) -> None:
    # Vollmer & Gedzelman (2008), doi:10.1364/AO.47.000H52: some 2400 times less, red, for clear
    # air of molecules without ozone. Their weight over the spectrum is not in the abstract; the
    # light of 600 nm stands for the eye's mean of what is red.
    left = molecules.at(0.0)[0]
    assert_allclose(1.0 / left[1], 2400.0, rtol=0.1)
    assert left[0] > 10.0 * left[2] > 100.0 * left[3]


def test_aerosol_and_ozone_dim_the_umbra_and_ozone_paints_its_rim(
    molecules: ShadowLight, whole: ShadowLight
) -> None:
    assert np.all(whole.at(0.0) < 0.2 * molecules.at(0.0))
    # Near the rim of the umbra light passes the ozone layer: 600 nm is fainter than 550 nm there,
    # the turquoise band; without ozone it is not.
    rim = 0.64
    assert whole.at(rim)[0, 1] < whole.at(rim)[0, 2]
    assert molecules.at(rim)[0, 1] > molecules.at(rim)[0, 2]


def test_published_umbra_lies_between_pure_air_and_hazy_air(
    molecules: ShadowLight, whole: ShadowLight
) -> None:
    # CosmoScout's map of the Earth (CC0): air with little aerosol, red channel.
    for separation, published in ((0.0, 7.72e-4), (0.486, 1.38e-3), (0.608, 2.27e-3)):
        assert whole.at(separation)[0, 0] < published < molecules.at(separation)[0, 0]


def test_the_penumbra_is_that_of_the_darkened_disc(whole: ShadowLight) -> None:
    for separation in (0.9, 1.05, 1.15):
        law = airlight.load_planet("earth").star.darkening
        assert law is not None
        bare = visible_light(np.degrees(whole.star_radius), [separation],
                             [np.degrees(whole.planet_radius)], darkening=law(NM))  # fmt: skip
        assert_allclose(whole.at(separation)[0], bare, atol=0.02)
    assert_allclose(whole.at(1.5)[0], 1.0, rtol=1e-9)


def test_light_goes_down_continuously_into_the_umbra(whole: ShadowLight) -> None:
    light = whole.at(np.linspace(0.5, 1.4, 60))
    assert np.all(np.diff(light, axis=0) > -1e-6)


def test_straight_light_leaves_a_dark_umbra() -> None:
    straight = airlight.replace(earth("air"), refraction="none")
    shadow = ShadowLight(airlight.solve(straight, NM, quality="preview"), MOON)
    assert shadow.at(0.2).max() == 0.0
    assert 0.0 < shadow.scattered(0.2).max() < 1e-5


def test_a_distance_inside_the_air_is_refused(whole: ShadowLight) -> None:
    solution = airlight.solve(airlight.load_planet("earth"), NM, quality="preview")
    with pytest.raises(ParameterError, match=r"distance is 6400000"):
        ShadowLight(solution, 6.4e6)
    with pytest.raises(ParameterError, match=r"separation is 100.0; allowed: 0 to 90 deg"):
        whole.at(100.0)


def test_the_light_of_a_whole_planet_without_air_is_lamberts() -> None:
    # Geometric albedo 2/3 of a white Lambert sphere, 1/π of it at the quarter.
    planet = airlight.load_planet("earth-atmosphere-plus")
    clear = airlight.replace(
        planet,
        constituents=tuple(
            airlight.replace(c, scattering=1e-12, absorption=0.0) for c in planet.constituents[:1]
        ),
        ground=airlight.replace(planet.ground, albedo=1.0, map=None),
        star=airlight.replace(planet.star, angular_radius=0.0),
    )
    solution = airlight.solve(clear, (550.0,), quality="preview", cache=False)
    assert_allclose(disc_light(solution, 0.0), 2.0 / 3.0, rtol=2e-3)
    assert_allclose(disc_light(solution, 90.0), 2.0 / 3.0 / np.pi, rtol=5e-3)
    with pytest.raises(ParameterError, match=r"phase is 181.0; allowed: 0 to 180 deg"):
        disc_light(solution, 181.0)
