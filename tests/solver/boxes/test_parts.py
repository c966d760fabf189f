"""Parts of the solver of boxes: harmonics, beam, forward peak and lanes."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.clouds.cloud_optics import CloudOptics
from airlight.kernel import compiled_loop
from airlight.planets.matter.phases.formulas import HenyeyGreenstein
from airlight.solver.boxes.beam import BeamCells, centred, depth_towards, middle_of_exponential
from airlight.solver.boxes.directions import directions, harmonics, parities
from airlight.solver.boxes.forward_peak import ANGLES, LARGEST_ROOT, ROOTS, peak_table


def test_harmonics_are_orthonormal():
    # Gauss rules of enough points integrate products of harmonics of degree 4 exactly.
    vectors, weights = directions(8, 12)
    functions = harmonics(vectors.reshape(-1, 3), 4)
    product = np.einsum("n,na,nb->ab", weights.ravel(), functions, functions)
    assert_allclose(product, np.eye(25), atol=1e-12)


def test_harmonics_change_their_sign_between_octants_by_their_class():
    way, kinds = np.array([0.48, -0.6, 0.64]), parities(5)
    for axis, odd in ((0, kinds % 2), (1, kinds // 2)):
        mirrored = np.where(np.arange(3) == axis, -way, way)
        assert_allclose(harmonics(mirrored, 5), np.where(odd, -1.0, 1.0) * harmonics(way, 5))


def test_first_harmonics_are_direction_cosines():
    way = np.array([0.48, -0.6, 0.64])
    expected = np.sqrt(0.75 / np.pi) * way[[1, 2, 0]]
    assert_allclose(harmonics(way, 1)[1:], expected, rtol=1e-12)


@compiled_loop
def _depth(point, direction, cells):
    return depth_towards(point, direction, cells)


@pytest.mark.parametrize("periodic", [True, False])
@pytest.mark.parametrize("interpolated", [True, False])
def test_depth_along_a_line_is_the_sum_of_small_steps(periodic, interpolated):
    from airlight.clouds.cloud_field import CloudField

    cells = np.random.default_rng(1).random((5, 4, 6)).astype(np.float32) * 0.01
    field = CloudField(
        extinction=cells,
        spacing=(30.0, 20.0, 25.0),
        base=100.0,
        beyond="periodic" if periodic else "clear",
        interpolated=interpolated,
    )
    grid = BeamCells(
        np.ascontiguousarray(cells.transpose(2, 1, 0)),
        100.0 + 25.0 * np.arange(7.0),
        (field.west, field.south),
        (30.0, 20.0),
        periodic,
        0,
        interpolated,
        0.0,
    )
    way = np.array([0.7, -0.5, 0.0])
    way[2] = np.sqrt(1.0 - way @ way)
    start = np.array([-12.0, 7.0, 61.0])  # below the field
    steps = (np.arange(40_000) + 0.5) * 0.01
    points = start[:, None] + way[:, None] * steps
    expected = field.at(*points).sum() * 0.01
    # Two points a cell for the interpolated field, which bends in the middle of cells.
    found = _depth(tuple(start), tuple(way), grid)
    assert_allclose(found, expected, rtol=0.02 if interpolated else 1e-3)


def test_middle_of_an_exponential():
    # ½ - ∫ s exp(-ds) ds / ∫ exp(-ds) ds, by sums; both ends, and the series' limit.
    s = (np.arange(100_000) + 0.5) / 100_000
    for depth in (1e-3, 0.02, 1.0, 30.0):
        weights = np.exp(-depth * s)
        expected = 0.5 - (s * weights).sum() / weights.sum()
        assert_allclose(middle_of_exponential(depth), expected, rtol=1e-4, atol=1e-6)


def test_centring_keeps_light_and_its_optical_centre():
    # A thick cell below an empty one: the light moves to depth 0 so that its mean depth is kept.
    amounts = np.array([1.0, 0.0]).reshape(2, 1, 1, 1) * np.ones((1, 1, 1, 4), np.float32)
    offset = np.zeros((2, 1, 1, 3, 4), np.float32)
    offset[0, ..., 2, :] = 0.4
    extinction = np.array([2.0, 0.0], np.float32).reshape(2, 1, 1)
    found = centred(amounts.astype(np.float32), extinction, offset, True)
    assert_allclose(found.sum(axis=0), 1.0, rtol=1e-6)
    # Half of the cell's depth of 2 times what stays, against 0.1 of it below its upper face.
    assert_allclose(found[0] * 1.0, 0.1 * 2.0, rtol=1e-5)


def test_the_forward_peak_only_adds_what_it_scatters():
    # Of the table with e^-x p: integrals e^-x + (1 - e^-x)(1 - f) + f (1 - e^-x (1 + x))/x.
    optics = CloudOptics(
        wavelengths=np.array([550.0]),
        extinction=np.ones(1),
        albedo=np.ones(1),
        phase=HenyeyGreenstein(asymmetry=0.85),
    )
    table = peak_table(optics, 5)[..., 0]
    angles = np.pi * np.linspace(0.0, 1.0, ANGLES + 1) ** 1.5
    x = np.linspace(0.0, LARGEST_ROOT, ROOTS)[1:] ** 2
    f = 0.85**6
    rings = 2.0 * np.pi * table[:, 1:] * np.sin(angles)[:, None]
    found = np.trapezoid(rings, angles, axis=0)
    expected = (1.0 - np.exp(-x)) * (1.0 - f) + f * (1.0 - np.exp(-x) * (1.0 + x)) / x
    assert_allclose(found, expected, rtol=5e-3)
