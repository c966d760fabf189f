"""Ground of the region around an observer, for which the air is solved."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from PIL import Image

from airlight import Medium, load_planet, local_ground, replace, solve
from airlight.errors import ParameterError
from airlight.physics.optics.water import mean_specular
from airlight.planets.planet import Planet
from airlight.scene.local_ground import _STEP, ring_mean
from airlight.scene.surface_map import from_pixels, surface_map

#: sRGB value and its linear one, IEC 61966-2-1.
GREY, LINEAR = 118, 0.1812
NM = [680.0, 550.0, 440.0]


def mapped(path: Path, pixels: np.ndarray, albedo: float, **ground: object) -> Planet:
    """Earth of a given albedo with the map of these pixels, (h, w) or (h, w, 3)."""
    Image.fromarray(pixels).convert("RGB").save(path)
    earth = load_planet("earth-atmosphere-plus")
    return replace(earth, ground=replace(earth.ground, albedo=albedo, map=str(path), **ground))


def halves(height: int = 64) -> np.ndarray:
    """White from 0° to 180° E, grey in the west."""
    pixels = np.full((height, 2 * height), GREY, np.uint8)
    pixels[:, height:] = 255
    return pixels


def albedo(planet: Planet, **where: float) -> float:
    return float(local_ground(planet, **where).ground.albedos([550.0])[0])


def test_a_planet_without_a_map_is_itself() -> None:
    # There is nothing to look up: the same object, hence the same solution to the last bit.
    earth = load_planet("earth-atmosphere-plus")
    assert local_ground(earth, latitude=10.0, longitude=20.0) is earth


def test_an_even_map_changes_nothing(tmp_path: Path) -> None:
    # Any mean of a constant is the constant, but for the step of the means, 0.001 of 0.1812.
    planet = mapped(tmp_path / "even.png", np.full((32, 64), GREY, np.uint8), 0.3)
    for altitude in (0.0, 4e5, 1e9):
        found = albedo(planet, latitude=-33.0, longitude=151.0, altitude=altitude)
        assert_allclose(found, 0.3, rtol=0.5 * _STEP / LINEAR)


def test_half_a_planet_of_snow_by_where_the_observer_is(tmp_path: Path) -> None:
    # The file's albedo is the planet's mean, of which the halves have the map's shares: 1 and
    # 0.1812 over their mean. On the border each counts half, by symmetry; from far away only the
    # visible hemisphere does.
    planet = mapped(tmp_path / "halves.png", halves(), 0.1)
    white, grey = (0.1 * one / (0.5 + 0.5 * LINEAR) for one in (1.0, LINEAR))
    step = _STEP / LINEAR
    assert_allclose(albedo(planet, latitude=0.0, longitude=90.0), white, rtol=step)
    assert_allclose(albedo(planet, latitude=0.0, longitude=-90.0), grey, rtol=step)
    assert_allclose(albedo(planet, latitude=20.0, longitude=0.0), 0.1, rtol=0.01)
    far = {"latitude": 0.0, "altitude": 1e11}
    assert_allclose(albedo(planet, longitude=90.0, **far), white, rtol=0.01)
    assert_allclose(albedo(planet, longitude=0.0, **far), 0.1, rtol=0.01)


def test_the_mean_over_all_observers_is_that_of_the_map() -> None:
    # A law: the weight depends on the distance alone and its integral is 1, so that observers even
    # over the sphere see its mean. Rings of 20 to 60°, 2000 points even over the sphere.
    pixels = np.random.default_rng(2).integers(0, 256, (6, 12, 3), dtype=np.uint8)
    shown = from_pixels("patches", pixels.repeat(8, axis=0).repeat(8, axis=1))
    n = np.arange(2000)
    latitude = np.degrees(np.arcsin(1.0 - (2.0 * n + 1.0) / n.size))
    longitude = np.degrees(n * np.pi * (3.0 - np.sqrt(5.0)))
    distances = np.radians(np.linspace(20.0, 60.0, 12))
    means = [
        ring_mean(shown, lat, lon, distances) for lat, lon in zip(latitude, longitude, strict=True)
    ]
    assert_allclose(np.mean(means, axis=0)[:3], shown.mean_rgb, rtol=5e-3)


def test_the_map_is_read_where_the_observer_is() -> None:
    # Places that nobody confuses: a small ring around each has the map's colour and water there.
    earth = surface_map("earth")
    for latitude, longitude in ((72.0, -40.0), (23.0, 5.0), (0.0, -25.0), (-33.9, 18.7)):
        near = ring_mean(earth, latitude, longitude, np.array([1e-5, 2e-5]))
        assert_allclose(near, earth.sample(latitude, longitude), atol=0.02)


def test_the_sea_mirrors_as_much_as_its_share_of_water() -> None:
    # Mid-Atlantic: all water for thousands of kilometres, so the sea's colour in the map and what
    # it mirrors of a uniform sky, 0.056 at 5 m/s.
    earth = load_planet("earth")
    sea = local_ground(earth, latitude=0.0, longitude=-25.0)
    assert sea.ground.local is not None
    assert_allclose(sea.ground.local.here.water, 1.0, atol=_STEP)
    below = surface_map("earth").sample(0.0, -25.0)[1]
    assert_allclose(sea.ground.albedos([550.0]), below + mean_specular(5.0), atol=0.01)
    snow = local_ground(earth, latitude=72.0, longitude=-40.0)
    assert snow.ground.albedos([550.0]) > 0.5


def test_no_albedo_exceeds_that_of_the_law(tmp_path: Path) -> None:
    planet = mapped(tmp_path / "bright.png", halves(), 0.9)
    assert albedo(planet, latitude=0.0, longitude=90.0) == 1.0


def test_clouds_count_where_they_are(tmp_path: Path) -> None:
    # Full cover in the eastern half: there it is 1, in the west 0, on the border and in the mean ½.
    clouds = tmp_path / "clouds.png"
    Image.fromarray(np.where(halves() == 255, 255, 0).astype(np.uint8)).save(clouds)
    earth = load_planet("earth-atmosphere-plus")
    planet = replace(earth, ground=replace(earth.ground, clouds=str(clouds)))
    for longitude, cover in ((90.0, 1.0), (-90.0, 0.0), (0.0, 0.5)):
        there = local_ground(planet, latitude=0.0, longitude=longitude)
        assert_allclose(there.ground.reflection.cover, cover, atol=0.01)
        assert_array_equal(there.ground.albedos(NM), planet.ground.albedos(NM))
    assert_allclose(planet.ground.reflection.cover, 0.5, atol=1e-6)


def test_solutions_are_kept_by_the_ground_they_were_solved_for(tmp_path: Path) -> None:
    # The fingerprint names a solution on disk: another ground, another name; the same one within
    # the same sea.
    planet = mapped(tmp_path / "halves.png", halves(), 0.1)

    def name(longitude: float) -> str:
        there = local_ground(planet, latitude=0.0, longitude=longitude)
        return Medium.from_planet(there, NM).fingerprint()

    whole = Medium.from_planet(planet, NM).fingerprint()
    assert len({name(90.0), name(-90.0), whole}) == 3
    assert name(90.0) == name(95.0)


def test_the_report_of_a_solution_says_which_ground_it_has(tmp_path: Path) -> None:
    planet = mapped(tmp_path / "halves.png", halves(), 0.1)
    there = local_ground(planet, latitude=-10.0, longitude=-90.0, altitude=1500.0)
    reported = str(solve(there, quality="preview", cache=False).report)
    assert "ground of 10°S 90°W, seen by the air of an observer at 1500 m" in reported
    assert "albedo 0.0308 at 550 nm, planet 0.1" in reported  # 0.1 · 0.182 / 0.5906
    assert "ground of" not in str(solve(planet, quality="preview", cache=False).report)


@pytest.mark.parametrize("word", ["latitude", "longitude", "altitude"])
def test_a_coordinate_out_of_range_is_refused_by_name(word: str) -> None:
    where = {"latitude": 0.0, "longitude": 0.0, word: -1e4}
    with pytest.raises(ParameterError, match=rf"^{word} is -10000.0; allowed: "):
        local_ground(load_planet("earth"), **where)
