"""The dark Earth from space: towns, and the thin line of airglow."""

from __future__ import annotations

import numpy as np

from airlight import Camera, Scene, load_planet
from airlight.image.display import to_display
from airlight.image.xyz import luminance
from airlight.render import render
from airlight.solver.solve import solve


def test_the_dark_disc_is_towns_and_a_faint_line_of_airglow() -> None:
    # From 6000 km above midnight the sun is 31° or more below all horizons that are seen: there is
    # no twilight. Tangent lines through a layer of 10 km at 95 km have 35 times its zenith's
    # brightness (van Rhijn), 2e-4 cd/m², less than a tenth of the 0.085 cd/m² of large towns, and
    # continuum and the green line are nearly white: in photographs towns are white, the line grey.
    planet = load_planet("earth", {"ground.map": None})
    camera = Camera(width=320, height=180, field_of_view=100.0, look_zenith=180.0)
    scene = Scene(altitude=6e6, sun_zenith=175.0, latitude=40.0, longitude=12.0, camera=camera)
    frame = render(solve(planet, (440.0, 500.0, 560.0, 620.0), "preview"), scene)
    from_nadir = np.degrees(np.arccos(np.clip(-camera.directions()[..., 2], -1.0, 1.0)))
    limb = np.degrees(np.arcsin((6.371e6 + 9e4) / (6.371e6 + 6e6)))
    ring = np.abs(from_nadir - limb) < 0.4  # a pixel has 0.4°
    light = 2.0**frame.exposure * luminance(frame.rgb.astype(float))
    towns = np.quantile(light[from_nadir < limb - 2.0], 0.998)
    assert towns > 0.4
    assert 0.01 < np.median(light[ring]) < 0.1 * towns
    shown = to_display(frame.rgb, exposure=frame.exposure, eye=True, dither=False, **frame.lens)
    red, green, blue = np.median(shown[ring], axis=0)
    assert green >= max(red, blue)
    assert min(red, blue) > 0.6 * green  # pale


def test_the_sea_at_midnight_mirrors_no_twilight_of_the_limb() -> None:
    # As the Moon sees the Earth that eclipses the sun: the disc but for its rim is 18° and more
    # beyond the terminator, and its land and sea have the airglow alone, some 1e-7 W m⁻² sr⁻¹.
    planet = load_planet("earth", {"ground.lights": None})
    camera = Camera(width=64, height=36, field_of_view=4.0, look_zenith=180.0)
    scene = Scene(altitude=393e6, sun_zenith=179.5, longitude=-90.0, camera=camera)
    frame = render(solve(planet, (440.0, 500.0, 560.0, 620.0), "preview"), scene)
    from_nadir = np.degrees(np.arccos(np.clip(-camera.directions()[..., 2], -1.0, 1.0)))
    limb = np.degrees(np.arcsin(6.371e6 / (6.371e6 + 393e6)))
    assert luminance(frame.rgb.astype(float))[from_nadir < 0.93 * limb].max() < 1e-5
