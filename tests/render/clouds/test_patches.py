"""Patches in which a periodic field continues."""

import numpy as np
import pytest

from airlight.kernel import compiled_loop
from airlight.render.clouds.patches import WIDTH, displaced_patch, patch_edges

BOX = 25.6e3


@compiled_loop
def _every(east, north, sides, edges, out):
    for k in range(east.size):
        out[k, 0], out[k, 1], out[k, 2] = displaced_patch(
            east[k], north[k], sides[0], sides[1], edges
        )


def patches(east, north, sides=(BOX, BOX)):
    """Displacements and distances. [m]"""
    east, north = np.broadcast_arrays(east, north)
    out = np.empty((east.size, 3))
    places = np.ravel(east).astype(float), np.ravel(north).astype(float)
    _every(*places, sides, patch_edges(*sides), out)
    return out.reshape(*east.shape, 3)


def test_the_box_is_not_displaced():
    side = np.linspace(-0.5 * BOX, 0.5 * BOX, 301)
    assert np.all(patches(side[:, None], side)[..., :2] == 0.0)


def test_patches_beyond_have_displacements_of_their_own():
    """Those of 21 × 21 patches are even over the box; none is at its neighbour's place."""
    middles = np.arange(-10, 11) * WIDTH * BOX
    moved = patches(middles[:, None], middles)[..., :2] / BOX
    rest = moved.reshape(-1, 2)[np.arange(441) != 220]
    assert np.all((rest >= 0.0) & (rest < 1.0))
    np.testing.assert_allclose(rest.mean(axis=0), 0.5, atol=4.0 / np.sqrt(12.0 * 440.0))
    np.testing.assert_allclose(rest.std(axis=0), np.sqrt(1.0 / 12.0), rtol=0.12)
    assert abs(np.corrcoef(rest.T)[0, 1]) < 0.2
    for axis in (0, 1):
        apart = np.diff(moved, axis=axis) + WIDTH * np.eye(2)[axis]
        apart -= np.round(apart)
        assert np.quantile(np.hypot(apart[..., 0], apart[..., 1]), 0.05) > 0.05


@pytest.mark.parametrize("sides", [(BOX, BOX), (BOX, 0.4 * BOX)])
def test_a_patch_goes_as_far_as_it_says(sides):
    random = np.random.default_rng(5)
    start = random.uniform(-4.0, 4.0, (40_000, 2)) * sides
    here = patches(start[:, 0], start[:, 1], sides)
    turn = random.uniform(0.0, 2.0 * np.pi, len(start))
    there = start + here[:, 2:] * random.uniform(0.0, 1.0, (len(start), 1)) * np.stack(
        [np.cos(turn), np.sin(turn)], axis=1
    )
    np.testing.assert_array_equal(patches(there[:, 0], there[:, 1], sides)[:, :2], here[:, :2])
    # an edge is longer than the side of a square, and its cells and theirs on both sides are few
    assert np.mean(here[:, 2] <= 0.0) < 0.1
    assert np.mean(here[:, 2] > 0.05 * min(sides)) > 0.5


def test_edges_meet_at_the_sides_of_squares():
    """Beside the side of a square, a patch is the same but for cells that an edge crosses there."""
    east = np.arange(-0.5, 0.5, 1e-3) * WIDTH * BOX
    side = 0.5 * WIDTH * BOX
    left, right = (patches(side + step, east)[:, :2] for step in (-1e-3, 1e-3))
    assert np.mean(np.any(left != right, axis=1)) < 0.01
