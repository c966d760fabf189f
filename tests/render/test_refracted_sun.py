"""Setting sun under refraction: lifted and flattened, as in the almanac."""

from __future__ import annotations

from math import degrees, radians, sin, tan

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import Camera, Constituent, Planet, Scene, load_planet, replace, solve
from airlight.geometry.refraction import apparent_sun
from airlight.planets.matter.profiles import Tabulated
from airlight.render import render
from airlight.solver.moments.solution import MomentsSolution

#: U.S. Standard Atmosphere (1976), Table I: altitude [km] and density over that at sea level.
DENSITY = {
    0: 1.0, 1: 0.90748, 2: 0.82168, 3: 0.74225, 4: 0.66885, 5: 0.60117, 6: 0.53887, 7: 0.48165,
    8: 0.42921, 9: 0.38128, 10: 0.33756, 11: 0.29780, 12: 0.25464, 14: 0.18600, 16: 0.13589,
    18: 0.099302, 20: 0.072579, 25: 0.032722, 30: 0.015029, 35: 0.0069089, 40: 0.0032618,
    50: 0.00083827, 60: 0.00025280, 70: 0.000067616, 80: 0.000015068, 100: 4.575e-7,
}  # fmt: skip


def bennett1982(altitude: float) -> float:
    """Refraction at an apparent altitude [deg] in air of 15 °C and 1013.25 hPa. [deg]

    Bennett (1982), Journal of Navigation 35, 255: the formula with its second term, within 0.02'
    of the tables from which it was made, scaled to pressure and temperature as given there.
    """
    minutes = 1.0 / tan(radians(altitude + 7.31 / (altitude + 4.4)))
    minutes -= 0.06 * sin(radians(14.7 * minutes + 13.0))
    return minutes / 60.0 * (1013.25 / 1010.0) * (283.0 / 288.15)


@pytest.fixture(scope="module")
def sunset() -> MomentsSolution:
    earth = load_planet("earth")
    air = next(one for one in earth.constituents if one.name == "air")
    profile = Tabulated(
        altitudes=tuple(1e3 * h for h in DENSITY), densities=tuple(DENSITY.values())
    )
    standard: Constituent = replace(air, profile=profile)
    planet: Planet = replace(earth, constituents=(standard,), refraction="bouguer")
    return solve(planet, quality="preview", cache=False)


def lift(solution: MomentsSolution, seen: float) -> float:
    """Lift of a star seen from the ground. [deg]"""
    geometry = solution.geometry
    x = geometry.optical_radius(np.array([solution.medium.bottom_radius]))
    return degrees(float(geometry.refraction_angle(x, np.array([sin(radians(seen))]))[0]))


@pytest.mark.parametrize("seen", [0.0, 0.5, 1.0, 2.0, 5.0, 10.0, 30.0])
def test_the_sun_is_lifted_as_the_almanac_says(seen: float, sunset: MomentsSolution) -> None:
    # On the horizon the lapse rate matters, which differs between the almanac's air and US76: 3 %;
    # from 5° up only the density at the ground does.
    tolerance = 0.03 if seen < 5.0 else 0.007
    assert_allclose(lift(sunset, seen), bennett1982(seen), rtol=tolerance)


def test_squeeze_on_the_horizon_is_one_less_the_curvature_of_light(sunset: MomentsSolution) -> None:
    # An exact law: rays slightly above and below the horizontal are mirror images of each other
    # except for the bending between them (A. T. Young, Flattening of the setting sun): the squeeze
    # is 1 + (r/n) dn/dr at the observer, here from the optical radius beside the ground.
    shell = sunset.geometry.shell
    assert shell is not None
    step = np.diff(shell.optical)[0] / np.diff(shell.altitude)[0]
    _, squeeze, _ = apparent_sun(
        shell.bottom,
        -sin(radians(lift(sunset, 0.0))),
        shell.bottom,
        shell.top,
        sunset.geometry.refraction_table,
    )
    assert_allclose(squeeze, step, rtol=2e-3)


def test_the_sun_on_the_horizon_is_flattened_by_a_sixth(sunset: MomentsSolution) -> None:
    # Meeus (1998), Astronomical Algorithms, equations 16.3 (Bennett) and 16.4 (Sæmundsson): the sun
    # of 32' on the horizon is 26.9' high, 0.84 of its width; the lapse rate moves it by 0.015
    # (0.814 in isothermal air).
    geometry, width = sunset.geometry, 2.0 * 0.2665
    shell = geometry.shell
    assert shell is not None
    x = float(geometry.optical_radius(np.array([sunset.medium.bottom_radius]))[0])
    low = -lift(sunset, 0.0)
    limbs = [
        apparent_sun(x, sin(radians(true)), shell.bottom, shell.top, geometry.refraction_table)[0]
        for true in (low, low + width)
    ]
    height = degrees(np.arcsin(limbs[1]) - np.arcsin(limbs[0]))
    assert_allclose(height / width, 0.84, atol=0.02)
    # The lower limb appears on the horizon.
    assert_allclose(limbs[0], 0.0, atol=1e-6)


@pytest.mark.slow
def test_the_sun_in_a_picture_stands_where_it_is_seen_and_is_as_flat(
    sunset: MomentsSolution,
) -> None:
    # The picture against the two laws above: the sun is 0.2° below the horizon and appears above
    # it. Pixels of 0.01°: edges to one pixel.
    camera = Camera(width=120, height=120, field_of_view=1.2, look_zenith=89.6, look_azimuth=0.0)
    scene = Scene(altitude=2.0, sun_zenith=90.2, camera=camera)
    bright = render(sunset, scene).rgb[..., 0]
    disc = bright > 0.3 * bright.max()
    rows, columns = np.flatnonzero(disc.any(axis=1)), np.flatnonzero(disc.any(axis=0))
    assert_allclose(columns[-1] - columns[0] + 1, 2 * 0.2665 / 0.01, atol=2)
    seen = [0.4 - (edge - 60) * 0.01 for edge in (rows[-1] + 1, rows[0])]
    for altitude, true in zip(seen, (-0.2 - 0.2665, -0.2 + 0.2665), strict=True):
        assert_allclose(altitude - lift(sunset, altitude), true, atol=0.015)
