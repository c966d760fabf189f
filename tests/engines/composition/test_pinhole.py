"""Cameras from files: the same view from each of the forms in which it is kept."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import ParameterError
from airlight.engines.composition.pinhole import Pinhole, camera_from_json, camera_from_matrices
from airlight.errors import AirlightError

from .views import looking

MATRIX = np.eye(4).tolist()
PLAIN = {"w": 40, "h": 30, "fl_x": 50.0, "transform_matrix": MATRIX}


def written(folder: Path, data: Any) -> Path:
    path = folder / "camera.json"
    path.write_text(data if isinstance(data, str) else json.dumps(data), encoding="utf-8")
    return path


def test_an_angle_and_a_focal_length_are_one_camera(tmp_path: Path) -> None:
    # fl = w/2 / tan(angle/2), as radiance-field tools define it
    by_angle = {
        "w": 40,
        "h": 30,
        "camera_angle_x": 2.0 * math.atan(0.4),
        "transform_matrix": MATRIX,
    }
    cameras = [camera_from_json(written(tmp_path, one))[0] for one in (PLAIN, by_angle)]
    for camera in cameras:
        assert_allclose([camera.focal_x, camera.focal_y, *camera.centre], [50, 50, 20, 15])
    # +X right, +Y up, -Z ahead: the identity looks down along -Z
    assert_allclose(cameras[0].axes, [[1, 0, 0], [0, 1, 0], [0, 0, -1]], atol=1e-12)


def test_the_frame_of_the_picture_s_name_is_taken(tmp_path: Path) -> None:
    moved = np.eye(4)
    moved[0, 3] = 7.0
    frames = [{"file_path": "images/one.png", "transform_matrix": MATRIX},
              {"file_path": "images/two.png", "transform_matrix": moved.tolist()}]  # fmt: skip
    data = {"w": 40, "h": 30, "fl_x": 50.0, "frames": frames, "airlight": {"lat": 5.0}}
    camera, place = camera_from_json(written(tmp_path, data), "renders/two.exr")
    assert_allclose(camera.position, [7.0, 0.0, 0.0])
    assert place == {"lat": 5.0}
    with pytest.raises(ParameterError, match=r"2 frames .*a frame named 'three'"):
        camera_from_json(written(tmp_path, data), "three.exr")


def test_matrices_of_openexr_are_the_same_camera() -> None:
    # worldToCamera looks along +Z, worldToNDC goes from 0 to 1 down the picture; both take rows
    base = looking(30.0, -12.0, 50.0, size=(40, 30))
    wanted = Pinhole(
        width=40, height=30, focal_x=50.0, focal_y=45.0, centre_x=18.0, centre_y=16.0,
        to_world=base.to_world,
    )  # fmt: skip
    to_camera = np.diag([1.0, 1.0, -1.0, 1.0]) @ np.linalg.inv(wanted.to_world)
    project = np.array([
        [50.0 / 40, 0.0, 18.0 / 40, 0.0], [0.0, -45.0 / 30, 16.0 / 30, 0.0],
        [0.0, 0.0, 1.0, -0.1], [0.0, 0.0, 1.0, 0.0],
    ])  # fmt: skip
    got = camera_from_matrices(to_camera.T, (project @ to_camera).T, 40, 30)
    assert_allclose([got.focal_x, got.focal_y, *got.centre], [50.0, 45.0, 18.0, 16.0], rtol=1e-9)
    assert_allclose(got.to_world, wanted.to_world, atol=1e-9)


def test_a_camera_of_another_size_sees_the_same() -> None:
    small = looking(0.0, 0.0, size=(40, 30))
    large = small.sized(80, 60)
    assert_allclose(large.rays_at(np.array([80.0]), np.array([60.0])),
                    small.rays_at(np.array([40.0]), np.array([30.0])))  # fmt: skip
    with pytest.raises(ParameterError, match=r"camera.size is '40x30'; allowed: the shape"):
        small.sized(80, 30)


@pytest.mark.parametrize(
    ("data", "words"),
    [
        ("{", "cannot be read as JSON"),
        ("[]", "is not a JSON object"),
        ({"w": 4, "h": 3, "transform_matrix": MATRIX}, "camera_angle_x is 'missing'"),
        (PLAIN | {"fl_x": "wide"}, "fl_x is 'wide'; allowed: a finite number"),
        (PLAIN | {"fl_x": -1.0}, "camera.focal_x is -1.0; allowed: a number above 0"),
        (PLAIN | {"k1": 0.1}, "k1 is 0.1; allowed: 0: lens distortion"),
        (PLAIN | {"camera_model": "OPENCV_FISHEYE"}, "allowed: OPENCV, PINHOLE"),
        (PLAIN | {"transform_matrix": [[1, 2], [3, 4]]}, "allowed: a 4 x 4 matrix"),
        (PLAIN | {"transform_matrix": np.diag([1, 1, -1, 1]).tolist()}, "perpendicular axes"),
        (PLAIN | {"transform_matrix": np.triu(np.ones((4, 4))).tolist()}, "perpendicular axes"),
        (PLAIN | {"airlight": 3}, "airlight is 3; allowed: an object"),
    ],
)
def test_a_bad_camera_gets_one_line_with_its_file(tmp_path: Path, data: Any, words: str) -> None:
    path = written(tmp_path, data)
    with pytest.raises(AirlightError) as raised:
        camera_from_json(path)
    assert words in str(raised.value)
    assert str(path) in str(raised.value)
    assert "\n" not in str(raised.value)
