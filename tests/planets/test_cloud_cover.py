"""Cover of clouds: its mean over the sphere, its file, and the mean ground that solvers have."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose
from PIL import Image

from airlight.errors import FileError
from airlight.physics.optics.reflection import direct_reflectances
from airlight.planets import Medium, load_planet
from airlight.planets.cloud_cover import cloud_pixels, mean_cover

NM = [440.0, 550.0, 680.0]
Draws = Callable[[np.ndarray], str]


@pytest.fixture
def draws(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Draws:
    """Write a picture of clouds, and give its name."""
    monkeypatch.chdir(tmp_path)  # a name has at most 100 letters
    mean_cover.cache_clear()

    def draw(pixels: np.ndarray) -> str:
        name = "./clouds.png"
        Image.fromarray(pixels.astype(np.uint8)).save(name)
        return name

    return draw


def cap(value: int) -> np.ndarray:
    """Cover of the cap north of 30°, a quarter of the sphere."""
    pixels = np.zeros((60, 120))
    pixels[:20] = value
    return pixels


def test_the_mean_weighs_a_polar_cap_by_its_area(draws: Draws) -> None:
    # Archimedes: (1 - sin 30°)/2 of the sphere; the cover is linear, 51/255 a fifth.
    assert_allclose(mean_cover(draws(cap(51))), 0.05, rtol=1e-12)


def test_full_cover_is_one(draws: Draws) -> None:
    assert_allclose(mean_cover(draws(np.full((90, 180), 255))), 1.0, rtol=1e-14)


def test_of_a_coloured_picture_the_brightness_counts(draws: Draws) -> None:
    # ITU-R 601: grey of red is 0.299, as Pillow's L.
    red = np.zeros((4, 8, 3))
    red[..., 0] = 255
    assert_allclose(cloud_pixels(draws(red)), 76)


def test_solvers_have_the_mean_of_clouds_and_ground(draws: Draws) -> None:
    # c R + (1 - c) a at every wavelength, with the ground below full cover for R.
    line = [np.array([x]) for x in (0.5, 0.3, 0.1)]
    found = []
    for pixels in (cap(255), np.full((90, 180), 255)):
        mean_cover.cache_clear()
        changes = {"ground.albedo": 0.1, "ground.clouds": draws(pixels)}
        medium = Medium.from_planet(load_planet("earth-atmosphere-plus", changes), NM)
        out = np.empty((1, 3))
        direct_reflectances(medium.ground, *line, out)
        found.append(out)
    assert_allclose(found[0], 0.25 * found[1] + 0.75 * 0.1, rtol=1e-7)
    assert found[1].min() > 0.5


def test_only_cover_and_depth_of_clouds_identify_a_solution(draws: Draws) -> None:
    # The solver sees the mean of clouds and ground; the altitude matters to pictures alone.
    def fingerprint(changes: dict[str, object]) -> str:
        planet = load_planet("earth-atmosphere-plus", changes)
        return Medium.from_planet(planet, NM).fingerprint()

    clouds = {"ground.clouds": draws(cap(255))}
    plain = fingerprint({})
    assert (
        fingerprint({"ground.cloud_optical_depth": 1.0, "ground.cloud_altitude": "1 km"}) == plain
    )
    covered = fingerprint(clouds)
    assert len({plain, covered, fingerprint(clouds | {"ground.cloud_optical_depth": 1.0})}) == 3
    assert fingerprint(clouds | {"ground.cloud_altitude": "1 km"}) == covered
    mean_cover.cache_clear()
    draws(cap(128))
    mean_cover.cache_clear()
    assert fingerprint(clouds) != covered


@pytest.mark.parametrize(
    ("pixels", "said"),
    [(None, "does not exist"), ((10, 10), "twice as wide as high")],
)
def test_a_file_that_is_no_map_is_one_line(
    draws: Draws, pixels: tuple[int, int] | None, said: str
) -> None:
    name = "./nothing.png" if pixels is None else draws(np.zeros(pixels))
    with pytest.raises(FileError, match=said) as refused:
        load_planet("earth-atmosphere-plus", {"ground.clouds": name})
    assert "\n" not in str(refused.value)
    assert Path(name).name in str(refused.value)


def test_the_defaults_are_within_what_their_sources_say() -> None:
    # ISCCP's clouds of medium thickness have 3.6 to 23; tops at 680 to 440 hPa by the standard
    # atmosphere, 44331 m (1 - (p/1013.25 hPa)^0.1903). The spherical albedo is that of van de
    # Hulst's asymptotic formula, 1 - 1/(0.75 (1 - g) τ + 1.07).
    ground = load_planet("earth-atmosphere-plus").ground
    assert 3.6 < ground.cloud_optical_depth < 23.0
    passes = 1.0 / (0.75 * (1.0 - 0.864) * ground.cloud_optical_depth + 1.07)
    assert_allclose(1.0 - passes, 0.6, atol=5e-3)
    low, high = 44331.0 * (1.0 - (np.array([680.0, 440.0]) / 1013.25) ** 0.1903)
    assert low < ground.cloud_altitude < high


def test_the_handbook_has_the_keys_of_clouds() -> None:
    # test_documentation.py compares the page with the declarations
    page = Path(__file__).parents[2] / "docs" / "planet-files.md"
    text = page.read_text(encoding="utf-8")
    assert text.count("| `cloud_altitude` |") == 1
