"""Texels against the projections that they are of."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight import ParameterError
from airlight.engines.environment.texels import MAPS, texel_positions, texel_solid_angles, texels_of
from airlight.scene import Camera
from airlight.scene.projections import PROJECTIONS

CAMERAS = [
    Camera(projection="equirectangular", width=80, height=40, look_azimuth=70.0),
    Camera(projection="octahedral", width=40, height=40, look_azimuth=-20.0),
    Camera(projection="fisheye", width=40, height=40, look_azimuth=40.0, look_zenith=15.0),
]


@pytest.mark.parametrize("camera", CAMERAS, ids=lambda camera: camera.projection)
def test_positions_invert_the_projection(camera: Camera) -> None:
    directions = camera.directions()
    rows, columns = np.nonzero(np.any(directions != 0.0, axis=-1))
    x, y = texel_positions(camera, directions[rows, columns])
    assert_allclose(x, columns + 0.5, atol=1e-9)
    assert_allclose(y, rows + 0.5, atol=1e-9)
    row, column = texels_of(camera, directions[rows, columns])
    assert_array_equal(row, rows)
    assert_array_equal(column, columns)


@pytest.mark.parametrize("camera", CAMERAS, ids=lambda camera: camera.projection)
def test_solid_angles_add_up_to_what_the_map_shows(camera: Camera) -> None:
    total = np.broadcast_to(texel_solid_angles(camera), (camera.height, camera.width)).sum()
    if camera.projection == "fisheye":  # its rim is a staircase of texels
        assert_allclose(total, 2.0 * np.pi, rtol=0.01)
    else:
        assert_allclose(total, 4.0 * np.pi, rtol=1e-12)


def test_what_a_fisheye_does_not_reach_has_no_texel() -> None:
    camera = Camera(projection="fisheye", width=40, height=40)
    row, column = texels_of(camera, np.array([[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]]))
    assert_array_equal(row, [-1, 20])
    assert_array_equal(column, [-1, 20])


@pytest.mark.parametrize("projection", sorted(set(PROJECTIONS) - set(MAPS)))
def test_a_projection_that_is_no_map_is_refused(projection: str) -> None:
    # Any unknown one used to be taken for the equidistant fisheye.
    sizes = {"cubemap": (48, 8), "orthographic": (8, 8)}
    width, height = sizes.get(projection, (16, 9))
    extent = 1e7 if projection == "orthographic" else None
    camera = Camera(projection=projection, width=width, height=height, extent=extent)
    for reads in (texel_solid_angles, lambda one: texel_positions(one, np.eye(3))):
        with pytest.raises(ParameterError, match=f"camera.projection is '{projection}'"):
            reads(camera)
