"""City lights scattered by the air: published brightness of the night sky."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from PIL import Image

from airlight import Camera, Scene, load_planet
from airlight.image.xyz import luminance
from airlight.physics.constants import LUMINOUS_EFFICACY
from airlight.render import render
from airlight.scene.ground_overlay import TOWN_LUMINANCE, ground_overlay
from airlight.solver.solve import solve

NM = (440.0, 500.0, 560.0, 620.0)
#: Rows of the map; a texel at the equator is a square of 9.77 km.
ROWS = 2048
TEXEL = np.pi * 6371.0 / ROWS
#: Luminance of a dark sky of 21.9 mag per square arcsecond. [cd m⁻²]
NATURAL = 1.08e5 * 10.0 ** (-0.4 * 21.9)


@pytest.fixture
def sky(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., Callable[..., float]]:
    """Luminance of the sky over a map of lights; the camera looks east."""
    monkeypatch.chdir(tmp_path)

    def over(lights: np.ndarray) -> Callable[..., float]:
        ground_overlay.cache_clear()
        Image.fromarray(lights).save("lights.png")
        changes = {"ground.lights": "./lights.png", "ground.map": None}
        planet = load_planet("earth", {**changes, "airglow": "none"})
        solution = solve(planet, NM, "preview")

        def seen(
            zenith: float = 0.0, sun: float = 180.0, latitude: float = 0.0, longitude: float = 0.0
        ) -> float:
            camera = Camera(
                width=1, height=1, field_of_view=1.0, look_zenith=zenith, look_azimuth=180.0
            )
            scene = Scene(
                camera=camera,
                altitude=2.0,
                sun_zenith=sun,
                sun_azimuth=270.0,
                latitude=latitude,
                longitude=longitude,
            )
            return LUMINOUS_EFFICACY * float(luminance(render(solution, scene).rgb[0, 0]))

        return seen

    return over


def test_the_zenith_of_a_large_town_is_as_bright_as_measured(
    sky: Callable[..., Callable[..., float]],
) -> None:
    # Falchi et al. (2016), Science Advances 2, e1600377, and Kyba et al. (2015), Sci. Rep. 5, 8409:
    # 17 to 18.5 mag per square arcsecond above the centres of large towns.
    seen = sky(np.full((8, 16), 255, np.uint8))()
    assert 16.5 < 2.5 * np.log10(1.08e5 / seen) < 18.5


def test_the_sky_beside_a_town_obeys_walker_s_law(
    sky: Callable[..., Callable[..., float]],
) -> None:
    # Walker (1977), PASP 89, 405: 0.01 P r^-2.5 times the natural sky at 45° towards a town of P
    # inhabitants at r km; towns differ by factors of two to three (Garstang 1986). A texel of the
    # brightest towns has P inhabitants with 1000 lm each, of which 0.1275 are reflected upwards.
    # The mean over places of a town between the texels of mip levels, which differ as much.
    people = TOWN_LUMINANCE * np.pi * (1e3 * TEXEL) ** 2 / (1000.0 * 0.1275)
    places = [(1024 + 3, 2048 + 5), (1024 - 7, 2048 + 18), (1024 + 12, 2048 - 9)]
    lights = np.zeros((ROWS, 2 * ROWS), np.uint8)
    found = []
    for row, column in places:
        lights[:] = 0
        lights[row, column] = 255
        north, east = (ROWS // 2 - row - 0.5) * TEXEL, (column + 0.5 - ROWS) * TEXEL
        seen = sky(lights)
        for distance in (25.0, 50.0):
            place = {"latitude": np.degrees(north / 6371.0),
                     "longitude": np.degrees((east - distance) / 6371.0)}  # fmt: skip
            found.append(seen(45.0, **place) / (0.01 * people * distance**-2.5 * NATURAL))
    ratios = np.reshape(found, (-1, 2)).mean(axis=0)
    assert np.all((ratios > 0.33) & (ratios < 3.0)), ratios


def test_by_day_there_is_none(sky: Callable[..., Callable[..., float]]) -> None:
    # Not drawn, so that the picture is the same to the last bit.
    bright, dark = (sky(np.full((8, 16), one, np.uint8))(sun=60.0) for one in (255, 0))
    assert_array_equal(bright, dark)


@pytest.mark.parametrize(
    ("latitude", "longitude", "darkest", "brightest"),
    [
        # Puschnig, Posch & Uttenthaler (2014), JQSRT 139, 64: observatory of Vienna, clear nights
        # to 19.25; the map is good to a factor of two.
        (48.232, 16.334, 19.25, 18.25),
        # Jechow et al. (2016), JQSRT 181, 24: Lake Stechlin, 21.5 to 21.7 in clear nights, of which
        # stars and zodiacal light are a fifth at least.
        (53.14, 13.03, 22.2, 21.4),
    ],
)
def test_the_zenith_is_as_bright_as_measured(
    latitude: float, longitude: float, darkest: float, brightest: float
) -> None:
    solution = solve(load_planet("earth"), NM, "preview")
    camera = Camera(width=1, height=1, field_of_view=1.0, look_zenith=0.0)
    scene = Scene(
        camera=camera, altitude=2.0, sun_zenith=150.0, latitude=latitude, longitude=longitude
    )
    seen = LUMINOUS_EFFICACY * float(luminance(render(solution, scene).rgb[0, 0]))
    assert brightest < 2.5 * np.log10(1.08e5 / seen) < darkest
