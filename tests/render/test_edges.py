"""Edges of a picture: how much of a pixel the planet covers."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight import Camera, Scene, load_planet, render, replace
from airlight.errors import ParameterError
from airlight.planets.planet import Planet
from airlight.solver.moments.solution import MomentsSolution

NM = (440.0, 550.0, 680.0)


def airless() -> Planet:
    """White ball without air to speak of: its ground is all light."""
    earth = load_planet("earth-atmosphere-plus", {"ground.albedo": 1.0})
    thin = [replace(one, scattering=1e-12, absorption=0.0) for one in earth.constituents[:1]]
    return replace(earth, constituents=tuple(thin))


@pytest.fixture(scope="module")
def ball(solved: Callable[..., MomentsSolution]) -> MomentsSolution:
    return solved(airless(), NM, "preview")


def limb(width: int, height: int, roll: float = 12.0) -> Scene:
    """Limb across the picture, the sun behind the observer."""
    camera = Camera(
        width=width, height=height, field_of_view=20.0, look_zenith=110.0, roll=roll,
    )  # fmt: skip
    return Scene(altitude=400e3, sun_zenith=20.0, camera=camera)


def coverage(scene: Scene, bottom: float, side: int) -> np.ndarray:
    """Share of each pixel in which the ground is seen, by a grid of samples."""
    total = np.zeros((scene.camera.height, scene.camera.width))
    steps = (np.arange(side) + 0.5) / side - 0.5
    lowest = -np.sqrt(1.0 - (bottom / (bottom + scene.altitude)) ** 2)
    for dx in steps:
        for dy in steps:
            total += scene.camera.directions(offset=(dx, dy))[..., 2] < lowest
    return total / side**2


def test_a_pixel_on_the_limb_has_the_light_of_the_covered_part(ball: MomentsSolution) -> None:
    # Geometry: the part of a pixel below the limb, by 32 x 32 samples. Nine samples that lie
    # aslant to the edge err by up to a sixth, and by 0.06 in the mean of squares; the limb is as
    # bright as the ground nearby, within 3 %.
    scene = limb(160, 90)
    rgb = render(ball, scene).rgb[..., 1].astype(float)
    covered = coverage(scene, ball.medium.bottom_radius, 32)
    bright = np.median(rgb[(covered == 1.0) & (np.roll(covered, 3, axis=0) < 1.0)])
    edge = (covered > 0.0) & (covered < 1.0)
    assert edge.sum() > 150
    error = rgb[edge] / bright - covered[edge]
    assert np.abs(error).max() < 1.0 / 6.0
    assert np.sqrt((error**2).mean()) < 0.06
    # without samples a pixel on the limb is black or white: a root mean square of 0.29 by chance
    assert ((rgb[edge] > 0.05 * bright) & (rgb[edge] < 0.95 * bright)).mean() > 0.6


def test_the_limb_of_a_far_planet_has_the_light_of_the_covered_part(ball: MomentsSolution) -> None:
    # As above, from the Moon's distance, where lines of sight to the limb are nearly vertical. The
    # sun is 30° high at the limb; within three pixels of 30 km the ground is up to a tenth
    # brighter, and the normals along the limb turn by 9° to either side.
    camera = Camera(width=60, height=34, field_of_view=0.3, look_zenith=179.095, roll=12.0)
    scene = Scene(altitude=393e6, sun_zenith=60.0, camera=camera)
    rgb = render(ball, scene).rgb[..., 1].astype(float)
    covered = coverage(scene, ball.medium.bottom_radius, 32)
    bright = np.median(rgb[(covered == 1.0) & (np.roll(covered, 2, axis=0) < 1.0)])
    edge = (covered > 0.0) & (covered < 1.0)
    assert edge.sum() > 50
    error = rgb[edge] / bright - covered[edge]
    assert np.sqrt((error**2).mean()) < 0.09
    assert ((rgb[edge] > 0.05 * bright) & (rgb[edge] < 0.95 * bright)).mean() > 0.6


@pytest.mark.parametrize("roll", [0.0, 0.5, -2.0, 90.0])
def test_a_level_horizon_is_smooth_in_nine_steps(ball: MomentsSolution, roll: float) -> None:
    # Samples in three rows show a pixel that the horizon creeps through in steps of a third: 0.095
    # in the mean of squares. In nine rows steps of a ninth leave 0.032.
    scene = limb(160, 90, roll)
    rgb = render(ball, scene).rgb[..., 1].astype(float)
    covered = coverage(scene, ball.medium.bottom_radius, 32)
    bright = np.median(rgb[covered == 1.0])
    edge = (covered > 0.0) & (covered < 1.0)
    assert edge.sum() > 80
    error = rgb[edge] / bright - covered[edge]
    assert np.sqrt((error**2).mean()) < 0.045


def test_the_limb_is_where_it_is(ball: MomentsSolution) -> None:
    # The sum over a column is the number of covered pixels, to the steps of nine samples: an edge
    # aslant averages them, so that all columns together agree within a fiftieth of a pixel each.
    scene = limb(160, 90)
    rgb = render(ball, scene).rgb[..., 1].astype(float)
    covered = coverage(scene, ball.medium.bottom_radius, 32)
    bright = np.median(rgb[covered == 1.0])
    edge = (covered > 0.0) & (covered < 1.0)
    there = (rgb / bright * edge).sum() - covered[edge].sum()
    assert abs(there) / 160 < 0.02 + 0.03 * edge.sum() / 160


def test_more_samples_are_the_mean_of_finer_pixels(ball: MomentsSolution) -> None:
    # A law of the grid: 2 x 2 samples of each pixel are the centres of pixels half the size, whose
    # own edges are left out of the comparison.
    scene, finer = limb(48, 27), limb(96, 54)
    got = render(ball, scene, exact=True, samples=2).rgb
    fine = render(ball, finer, exact=True).rgb
    wanted = fine.reshape(27, 2, 48, 2, 3).mean(axis=(1, 3))
    covered = coverage(scene, ball.medium.bottom_radius, 8)
    away = np.ones_like(covered, bool)
    for shift in (-1, 0, 1):
        for axis in (0, 1):
            away &= np.isin(np.roll(covered, shift, axis=axis), (0.0, 1.0))
    assert_allclose(got[away], wanted[away], rtol=1e-5, atol=1e-6 * fine.max())
    assert_array_equal(render(ball, scene, exact=True, samples=1).rgb,
                       render(ball, scene, exact=True).rgb)  # fmt: skip


@pytest.mark.parametrize("samples", [0, 17, 2.5, True])
def test_other_numbers_of_samples_are_refused(samples: object, ball: MomentsSolution) -> None:
    with pytest.raises(ParameterError, match=r"samples is .*; allowed: 1 to 16"):
        render(ball, limb(4, 3), samples=samples)  # type: ignore[arg-type]
