"""Patches in which a periodic field continues."""

import numpy as np
import pytest

from airlight.geometry.vectors import Vec3
from airlight.kernel import compiled_loop
from airlight.render.background_compilation import empty_clouds
from airlight.render.clouds.cloud_place import beam_depth_at
from airlight.render.clouds.patches import (
    MIXED,
    WIDTH,
    displacements,
    patch_at,
    patch_edges,
)

BOX = 25.6e3
#: Columns of a field of which a few have clouds.
COVERED = np.random.default_rng(7).random((64, 64)) < 0.2


def edges(sides=(BOX, BOX)):
    return patch_edges(*sides)._replace(moved=displacements(COVERED, *sides))


@compiled_loop
def _every(east, north, sides, edges, out):
    for k in range(east.size):
        found = patch_at(east[k], north[k], sides[0], sides[1], edges)
        out[k, 0], out[k, 1], out[k, 2] = found.right, found.up, found.free
        out[k, 3], out[k, 4], out[k, 5] = found.share, found.other_right, found.other_up


def patches(east, north, sides=(BOX, BOX)):
    """``Patch`` at places."""
    east, north = np.broadcast_arrays(east, north)
    out = np.empty((east.size, 6))
    places = np.ravel(east).astype(float), np.ravel(north).astype(float)
    _every(*places, sides, edges(sides), out)
    return out.reshape(*east.shape, 6)


def test_the_box_is_not_displaced():
    side = np.linspace(-0.5 * BOX, 0.5 * BOX, 301)
    assert np.all(patches(side[:, None], side)[..., :2] == 0.0)


def test_patches_beyond_have_displacements_of_their_own():
    """Those of 42 × 42 patches are even over the box; none is at its neighbour's place."""
    middles = (np.arange(-20, 22) - 0.5) * WIDTH * BOX
    moved = patches(middles[:, None], middles)[..., :2] / BOX
    rest = moved[np.any(moved != 0.0, axis=2)]
    assert len(rest) == 42**2 - 4
    assert np.all((rest >= 0.0) & (rest < 1.0))
    np.testing.assert_allclose(rest.mean(axis=0), 0.5, atol=0.05)
    np.testing.assert_allclose(rest.std(axis=0), np.sqrt(1.0 / 12.0), rtol=0.12)
    for axis in (0, 1):
        apart = np.diff(moved, axis=axis) + WIDTH * np.eye(2)[axis]
        apart -= np.round(apart)
        assert np.quantile(np.hypot(apart[..., 0], apart[..., 1]), 0.05) > 0.05


def test_patches_have_the_cover_of_larger_scales():
    """A field cloudy in one quarter: the mean of patches is its own, and neighbours are alike."""
    covered = np.zeros((64, 64), bool)
    covered[:32, :32] = True
    moved = displacements(covered, BOX, BOX) / BOX
    places = (np.arange(64) - 0.5) * WIDTH
    inside = (np.arange(16) + 0.5) / 16.0 * WIDTH - 0.5 * WIDTH
    east = places[:, None] + inside - moved[..., 0][..., None]
    north = places[:, None, None] + inside - moved[..., 1][..., None]
    clouds = ((east + 0.5) % 1.0 < 0.5)[..., None, :] & ((north + 0.5) % 1.0 < 0.5)[..., None]
    cover = clouds.mean(axis=(2, 3))
    np.testing.assert_allclose(cover.mean(), 0.25, atol=0.02)
    assert cover.std() > 0.1
    assert np.corrcoef(cover[:, 1:].ravel(), cover[:, :-1].ravel())[0, 1] > 0.5


@pytest.mark.parametrize("sides", [(BOX, BOX), (BOX, 0.4 * BOX)])
def test_a_patch_goes_as_far_as_it_says(sides):
    random = np.random.default_rng(5)
    start = random.uniform(-4.0, 4.0, (40_000, 2)) * sides
    here = patches(start[:, 0], start[:, 1], sides)
    turn = random.uniform(0.0, 2.0 * np.pi, len(start))
    there = start + here[:, 2:3] * random.uniform(0.0, 1.0, (len(start), 1)) * np.stack(
        [np.cos(turn), np.sin(turn)], axis=1
    )
    np.testing.assert_array_equal(patches(there[:, 0], there[:, 1], sides)[:, :2], here[:, :2])
    # bands beside two edges, which are longer than the sides of a square, and their cells
    assert 4.0 * MIXED < np.mean(here[:, 2] <= 0.0) < 6.0 * MIXED
    assert np.mean(here[:, 2] > 0.025 * min(sides)) > 0.4


def test_edges_meet_at_the_sides_of_squares():
    """Beside the side of a square, a patch is the same but for cells that an edge crosses there."""
    east = np.arange(-0.5, 0.5, 1e-3) * WIDTH * BOX
    side = 0.5 * WIDTH * BOX
    left, right = (patches(side + step, east)[:, :2] for step in (-1e-3, 1e-3))
    assert np.mean(np.any(left != right, axis=1)) < 0.01


def test_patches_mix_beside_an_edge():
    """Across an edge both have a half, and the field is continuous; elsewhere there is one."""
    way = np.arange(0.0, 6.0, 2e-6) * WIDTH * BOX
    found = patches(way, 0.3 * BOX)
    assert found[:, 3].max() <= 0.5
    one, other = found[:-1], found[1:]
    (edge,) = np.nonzero(np.any(one[:, :2] != other[:, :2], axis=1))
    assert len(edge) >= 4
    np.testing.assert_allclose(one[edge, 3], 0.5, atol=1e-3)
    np.testing.assert_array_equal(one[edge, 4:], other[edge, :2])
    np.testing.assert_array_equal(other[edge, 4:], one[edge, :2])
    assert np.all(found[found[:, 2] > 0.0, 3] == 0.0)
    steps = np.abs(np.diff(found[:, 3]))
    assert np.quantile(steps, 0.999) < 5.0 * 2e-6 / MIXED


@compiled_loop
def _depths(places, layer, out):
    for k in range(out.size):
        point = Vec3(places[k, 0], places[k, 1], places[k, 2])
        out[k] = beam_depth_at(point, 0, layer)


@pytest.mark.parametrize("height", [-500.0, 500.0])
def test_shadows_are_continuous_across_edges(height):
    """Below the base and within the clouds: at most what cells and bands change in a metre."""
    cells, radius = 8, 6.36e6
    random = np.random.default_rng(2)
    depth = random.uniform(0.0, 5.0, (4, cells, cells)).astype(np.float32)
    layer = empty_clouds().layers[0]
    layer = layer._replace(
        radius=radius, base=radius + 1000.0, top=radius + 2000.0,
        corner_x=-0.5 * BOX, corner_y=-0.5 * BOX,
        step_x=BOX / cells, step_y=BOX / cells, step_z=250.0,
        periodic=True, east=Vec3(1.0, 0.0, 0.0), north=Vec3(0.0, 1.0, 0.0),
        sun=Vec3(0.0, 0.0, 1.0), edges=edges(),
        levels=np.array([[cells, cells, 0]]), depth=depth, base_depth=depth[0],
    )  # fmt: skip
    east = np.arange(0.0, 2.0 * WIDTH * BOX)
    places = np.stack([east, np.full_like(east, 0.3 * BOX), np.full_like(east, radius)], axis=1)
    places *= (radius + 1000.0 + height) / np.linalg.norm(places, axis=1)[:, None]
    found = np.empty(east.size)
    _depths(places, layer, found)
    assert np.ptp(found) > 2.0
    assert np.abs(np.diff(found)).max() < 5.0 * (2.0 / (BOX / cells) + 0.5 / (MIXED * WIDTH * BOX))
