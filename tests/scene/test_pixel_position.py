"""Pixels of directions, against the projections they invert."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.scene import Camera
from airlight.scene.pixel_position import pixel_positions


@pytest.mark.parametrize(
    ("projection", "width", "height"),
    [
        ("perspective", 64, 36),
        ("fisheye", 60, 60),
        ("equirectangular", 80, 40),
        ("cubemap", 96, 16),
        ("octahedral", 48, 48),
    ],
)
def test_positions_invert_the_projection(projection: str, width: int, height: int) -> None:
    camera = Camera(projection=projection, width=width, height=height, look_zenith=90.0)
    directions = camera.directions() @ camera.axes.T
    rows, columns = np.nonzero(np.any(directions != 0.0, axis=-1))
    some = slice(None, None, 7)
    x, y, solid = pixel_positions(camera, directions[rows, columns][some])
    assert_allclose(x, columns[some] + 0.5, atol=1e-4)
    assert_allclose(y, rows[some] + 0.5, atol=1e-4)
    assert np.all(solid > 0.0)


def test_what_the_picture_does_not_show_has_no_position() -> None:
    camera = Camera(width=40, height=20, field_of_view=30.0)
    x, y, _ = pixel_positions(
        camera, np.array([[0.0, 0.0, -1.0], [0.5, 0.0, 0.8], [0.0, 0.0, 1.0]])
    )
    assert np.isnan(x[:2]).all()
    assert np.isnan(y[:2]).all()
    assert x[2] == pytest.approx(20.0)


def test_solid_angles_of_a_panorama_add_up_to_the_sphere() -> None:
    camera = Camera(projection="equirectangular", width=40, height=20)
    _, _, solid = pixel_positions(camera, (camera.directions() @ camera.axes.T).reshape(-1, 3))
    assert solid.sum() == pytest.approx(4.0 * np.pi, rel=2e-3)
