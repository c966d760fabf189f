"""Belts and zones: the map of a cloud deck, in pictures."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose
from PIL import Image

from airlight import Camera, Scene, load_planet, replace
from airlight.errors import ParameterError
from airlight.image.encoding import srgb_encode
from airlight.planets import Ground, Medium
from airlight.render import render
from airlight.render.pixels.deck import deck_altitude, full_disc_mean
from airlight.scene.surface_map import surface_map
from airlight.solver.moments.solution import MomentsSolution

Decked = Callable[[Path | str | None], MomentsSolution]
#: Equator of the planet from five radii, north up, the sun behind the observer.
FAR = Scene(
    altitude=3e7, sun_zenith=10.0, sun_azimuth=90.0,
    camera=Camera(width=24, height=24, field_of_view=22.0, look_zenith=180.0),
).north_up()  # fmt: skip


@pytest.fixture
def decked(lit: Callable[..., MomentsSolution]) -> Decked:
    """Solution of the Earth's air under a map of its deck, solved once without."""
    planet = load_planet("earth-atmosphere-plus")
    plain = lit(planet)

    def make(deck: Path | str | None) -> MomentsSolution:
        ground = Ground(albedo=planet.ground.albedo, deck=None if deck is None else str(deck))
        medium = Medium.from_planet(replace(planet, ground=ground), plain.wavelengths)
        solution = MomentsSolution(medium, plain.settings, plain.moments, 0.0)
        solution.planet = replace(planet, ground=ground)
        return solution

    return make


def saved(path: Path, linear: np.ndarray) -> Path:
    """Picture of linear values between 0 and 1, shape (h, w, 3), without loss but 8 bits."""
    Image.fromarray(np.uint8(255.0 * srgb_encode(linear) + 0.5)).save(path)
    return path


def test_an_even_deck_changes_nothing(decked: Decked, tmp_path: Path) -> None:
    # A map over its own mean is 1, whatever its level.
    grey = saved(tmp_path / "grey.png", np.full((8, 16, 3), 0.3))
    assert_allclose(render(decked(grey), FAR).rgb, render(decked(None), FAR).rgb, rtol=1e-5)


def test_a_bright_north_is_seen_in_the_north(decked: Decked, tmp_path: Path) -> None:
    # Halves of 0.6 and 0.2 have the mean 0.4 over the disc: factors of 1.5 and 0.5; 8 bits are
    # good to 0.3 %. Pixels of the equator, and those that miss the deck, are left out.
    halves = np.full((64, 128, 3), 0.2)
    halves[:32] = 0.6
    seen = render(decked(saved(tmp_path / "halves.png", halves)), FAR).rgb.astype(float)
    even = render(decked(None), FAR).rgb.astype(float)
    disc = even[:, 12, 1] > 0.5 * even[12, 12, 1]
    ratio = seen[disc, 12] / even[disc, 12]
    assert len(ratio) > 10
    assert_allclose(ratio[1:4], 1.5, rtol=0.01)
    assert_allclose(ratio[-4:-1], 0.5, rtol=0.01)


def test_the_mean_is_that_of_the_full_disc(tmp_path: Path) -> None:
    # A map of 1 in the tropics below 30 degrees: integral of cos^3 from 0 to 30 degrees,
    # sin - sin^3/3 = 11/24, over that to the pole, 2/3.
    tropics = np.zeros((180, 360, 3))
    tropics[60:120] = 1.0
    mean = full_disc_mean(surface_map(str(saved(tmp_path / "tropics.png", tropics))))
    assert_allclose(mean, 11.0 / 16.0, rtol=1e-4)


def test_lines_that_do_not_meet_the_deck_from_above_are_unchanged(
    decked: Decked, tmp_path: Path
) -> None:
    # From below the deck, and upwards.
    halves = np.full((64, 128, 3), 0.1)
    halves[:32] = 0.6
    there, without = decked(saved(tmp_path / "half.png", halves)), decked(None)
    camera = Camera(width=4, height=4, field_of_view=20.0, look_zenith=100.0)
    below = Scene(altitude=10.0, latitude=40.0, sun_zenith=60.0, camera=camera)
    above = replace(below, altitude=3e4, camera=replace(camera, look_zenith=70.0))
    for scene in (below, above):
        assert_allclose(render(there, scene).rgb, render(without, scene).rgb, rtol=1e-6)


def test_the_deck_is_where_a_horizontal_line_has_an_optical_depth_of_one() -> None:
    # Rayleigh air of scale height H: beta sqrt(2 pi R H) exp(-h/H) = 1, within a step of the
    # altitudes and the curvature that the formula leaves out.
    planet = load_planet("earth-openspace")
    only = replace(planet, constituents=planet.constituents[:1])
    medium = Medium.from_planet(only, (550.0,))
    extinction = float(medium.extinction[0, 0])
    scale = float(medium.columns[0])
    expected = scale * np.log(extinction * np.sqrt(2.0 * np.pi * planet.bottom_radius * scale))
    assert_allclose(deck_altitude(medium), expected, atol=0.02 * scale)


def test_a_deck_beside_a_map_of_the_ground_is_refused() -> None:
    with pytest.raises(ParameterError, match="deck is 'saturn'; allowed: one of deck and map"):
        Ground(albedo=0.3, map="earth", deck="saturn")


def test_the_great_red_spot_is_at_its_latitude() -> None:
    # The reddest large place of Jupiter's map between 10 and 35 degrees south; 22.4 degrees
    # planetographic, the spot's usual latitude, are 19.8 from the centre.
    level = surface_map("jupiter").levels[4].astype(float)
    rows = 90.0 - 180.0 * (np.arange(len(level)) + 0.5) / len(level)
    south = (rows < -10.0) & (rows > -35.0)
    redness = np.where(south[:, None], level[..., 0] / level[..., 2], 0.0)
    row = np.unravel_index(redness.argmax(), redness.shape)[0]
    assert abs(rows[row] + 19.8) < 3.0
