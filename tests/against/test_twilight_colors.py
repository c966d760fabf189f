"""The colours of twilight that people have seen: Earth's blue zenith, Mars's blue sunset."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import Planet, load_planet, replace
from airlight.image.spectral import default_wavelengths, rgb_weights
from airlight.image.xyz import chromaticity, rgb_to_xyz
from airlight.physics.spectra.ozone import ozone_cross_section
from airlight.solver.moments.solution import MomentsSolution

Solved = Callable[..., MomentsSolution]
#: Daylight's white, CIE standard illuminant D65.
WHITE = (0.3127, 0.3290)


def zenith(solution: MomentsSolution, sun_altitude: float) -> np.ndarray:
    sky = solution.radiance(
        altitude=0.0, sun_zenith=90.0 - sun_altitude, view_zenith=0.0, azimuth=0.0
    )
    return sky.to_numpy().ravel()


def without_ozone() -> Planet:
    earth = load_planet("earth")
    kept = tuple(one for one in earth.constituents if one.name != "ozone")
    assert len(kept) == len(earth.constituents) - 1
    return replace(earth, constituents=kept)


def test_ozone_makes_the_zenith_of_twilight_blue(
    solved: Solved, tell: Callable[[str], None]
) -> None:
    # Hulburt (1953), JOSA 43, 113: of the blue of the zenith after sunset two thirds come from
    # ozone, one third from the molecules; without it the zenith would be greyish. Adams, Plass &
    # Kattawar (1974), JAS 31, 1662, computed the same.
    nm = tuple(default_wavelengths(12).tolist())
    colors = []
    for planet in (load_planet("earth"), without_ozone()):
        solution = solved(planet, nm, "preview")
        weights = rgb_weights(solution.wavelengths, planet.star.irradiances)
        colors.append(chromaticity(rgb_to_xyz(zenith(solution, -4.0) @ weights)))
    blue, grey = np.array(colors)
    # Grey: within 0.02 of white, ten steps that an eye can tell (MacAdam 1942: about 0.002)
    assert np.hypot(*(grey - WHITE)) < 0.02
    # ... and with ozone bluer by more than 0.05 in x and in y
    assert (blue - grey < -0.05).all()
    tell(f"zenith, sun at -4 degrees: xy {grey.round(4)} without ozone, {blue.round(4)} with it")
    # Hulburt's two thirds, of the way from white to the blue that is seen
    share = np.hypot(*(blue - grey)) / np.hypot(*(blue - WHITE))
    assert share > 2.0 / 3.0


def test_what_ozone_takes_from_the_zenith_of_twilight_follows_its_cross_section(
    solved: Solved,
) -> None:
    # Beer's law, a second path: light that reaches the zenith has crossed the ozone layer far
    # away, so that ln(without/with) is the cross-section times one slant column
    nm = (500.0, 540.0, 580.0, 620.0)
    with_ozone, without = (
        zenith(solved(planet, nm, "preview"), -4.0)
        for planet in (load_planet("earth"), without_ozone())
    )
    slant = np.log(without / with_ozone) / ozone_cross_section(nm)
    # 5 %: each colour is scattered at a slightly different height
    assert_allclose(slant / slant.mean(), 1.0, rtol=0, atol=0.05)
    # The air masses of a level ray, 35 for gas: less from the ground, up to twice as many where the
    # ray grazes the layer and crosses it twice. 345 DU are 9.27e22 /m^2.
    assert 10.0 < slant.mean() / 9.27e22 < 70.0


@pytest.mark.parametrize("sun_altitude", [0.0, 1.0, 2.0])
def test_the_sunset_of_mars_is_blue_near_the_sun_and_red_away_from_it(
    sun_altitude: float, solved: Solved, tell: Callable[[str], None]
) -> None:
    # Pathfinder, Opportunity and Curiosity photographed it; Ehlers, Chakrabarty & Moosmüller
    # (2014), Applied Optics 53, 1808, found the reason: dust scatters blue into a narrow forward
    # lobe, and hematite absorbs it. Each wavelength is taken over the star's own light, so that
    # a white screen in the sun above the air would have ratio 1.
    solution = solved(load_planet("mars"), (680.0, 550.0, 440.0), "preview")
    sun = 90.0 - sun_altitude
    views = [(sun - d, 0.0) for d in (1.0, 2.0, 3.0, 4.0)]
    views += [(sun - 40.0, 0.0), (sun - 60.0, 0.0), (85.0, 40.0), (85.0, 90.0), (60.0, 180.0)]
    view_zenith, azimuth = np.array(views).T
    sky = solution.radiance(
        altitude=0.0, sun_zenith=sun, view_zenith=view_zenith, azimuth=azimuth
    ).to_numpy()
    relative = sky / solution.medium.solar_irradiance
    blue_to_red = relative[:, 2] / relative[:, 0]
    assert (blue_to_red[:4] > 1.0).all(), blue_to_red
    assert (blue_to_red[4:] < 1.0).all(), blue_to_red
    tell(f"Mars, sun at {sun_altitude:g} degrees: blue over red {blue_to_red.round(2)}")
