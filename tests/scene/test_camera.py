"""The camera: handedness, seams, angles and what it refuses."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from airlight.errors import ParameterError
from airlight.scene.camera import Camera
from airlight.scene.directions import camera_axes, direction
from airlight.scene.projections import PROJECTIONS

#: Rounding of a handful of float64 operations on numbers of order 1.
ROUNDING = 1e-14

WHOLE_SPHERE = [
    Camera(projection="equirectangular", width=256, height=128),
    Camera(projection="cubemap", width=6 * 64, height=64),
    Camera(projection="octahedral", width=96, height=96),
]
EVERY_PROJECTION = [
    Camera(projection="perspective", width=64, height=36),
    Camera(projection="fisheye", width=64, height=64),
    *WHOLE_SPHERE,
    Camera(projection="orthographic", width=64, height=64, extent=14000e3),
]


def name(camera: Camera) -> str:
    return camera.projection


def angle(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return 2.0 * np.arcsin(0.5 * np.linalg.norm(a - b, axis=-1))


def test_every_projection_is_tested_here() -> None:
    assert {camera.projection for camera in EVERY_PROJECTION} == set(PROJECTIONS)


def test_azimuth_grows_clockwise_seen_from_above() -> None:
    # a compass: facing x (azimuth 0) with z up, the right hand is at x cross z = -y
    assert_allclose(direction(90.0, 90.0), np.cross([1, 0, 0], [0, 0, 1]), atol=ROUNDING)


def test_looking_at_the_sun_azimuth_plus_90_is_on_the_right() -> None:
    # a mirrored picture would put it on the left
    camera = Camera(width=101, height=51, field_of_view=90.0)
    view = camera.directions()
    right_hand = direction(90.0, 90.0)
    towards_right = view @ right_hand
    assert np.all(towards_right[:, 51:] > 0.0)
    assert np.all(towards_right[:, :50] < 0.0)
    assert_allclose(view[25, 50], [1.0, 0.0, 0.0], atol=ROUNDING)


def test_the_upper_half_looks_up() -> None:
    view = Camera(width=100, height=50).directions()
    assert np.all(view[:25, :, 2] > 0.0)
    assert np.all(view[25:, :, 2] < 0.0)


@given(
    zenith=st.floats(0.0, 180.0), azimuth=st.floats(-360.0, 360.0), roll=st.floats(-360.0, 360.0)
)
def test_camera_axes_are_a_rotation_that_keeps_right_hand_on_the_right(
    zenith: float, azimuth: float, roll: float
) -> None:
    right, up, forward = camera_axes(zenith, azimuth, roll)
    assert_allclose(
        np.stack([right, up, forward]) @ np.stack([right, up, forward]).T, np.eye(3), atol=ROUNDING
    )
    assert_allclose(np.cross(forward, up), right, atol=ROUNDING)
    assert_allclose(forward, direction(zenith, azimuth), atol=ROUNDING)


def test_roll_is_clockwise() -> None:
    # a camera turned clockwise by a quarter has its top where its right was
    level = camera_axes(70.0, 20.0, 0.0)
    rolled = camera_axes(70.0, 20.0, 90.0)
    assert_allclose(rolled[1], level[0], atol=ROUNDING)
    assert_allclose(rolled[0], -level[1], atol=ROUNDING)


@pytest.mark.parametrize("camera", EVERY_PROJECTION, ids=name)
def test_view_vectors_have_length_one_or_zero(camera: Camera) -> None:
    view = camera.directions()
    assert view.dtype == np.float64
    assert view.shape == (camera.height, camera.width, 3)
    length = np.linalg.norm(view, axis=-1)
    assert_allclose(length, np.where(length > 0.5, 1.0, 0.0), atol=ROUNDING)


@pytest.mark.parametrize("camera", [one for one in EVERY_PROJECTION if not one.parallel], ids=name)
def test_no_projection_is_mirrored(camera: Camera) -> None:
    # right cross down is forward
    width = camera.height if camera.projection == "cubemap" else camera.width
    view = camera.directions()[:, :width]
    across, down = np.diff(view, axis=1)[:-1], np.diff(view, axis=0)[:, :-1]
    turn = np.einsum("ijk,ijk->ij", view[:-1, :-1], np.cross(across, down))
    assert turn.min() > -ROUNDING
    assert turn.sum() > 0.1


@pytest.mark.parametrize("camera", EVERY_PROJECTION, ids=name)
def test_rows_by_blocks_are_the_whole_picture(camera: Camera) -> None:
    blocks = [camera.directions(slice(start, start + 7)) for start in range(0, camera.height, 7)]
    assert_array_equal(np.concatenate(blocks), camera.directions())


@pytest.mark.parametrize("camera", EVERY_PROJECTION, ids=name)
def test_an_offset_of_one_pixel_is_the_neighbour(camera: Camera) -> None:
    if camera.projection == "cubemap":  # one face: the next one is another plane
        face = slice(4 * camera.height, 5 * camera.height)
    else:
        face = slice(0, camera.width)
    shifted = camera.directions(offset=(1.0, 0.0))[:, face]
    assert_allclose(shifted[:, :-1], camera.directions()[:, face][:, 1:], atol=ROUNDING)


@pytest.mark.parametrize("camera", EVERY_PROJECTION, ids=name)
def test_pixel_angle_is_the_step_between_the_middle_pixels(camera: Camera) -> None:
    # second method: the angle between neighbours across the line of sight; the step is constant
    # to second order in its size
    half = camera.height // 2
    column = 4 * camera.height + half if camera.projection == "cubemap" else camera.width // 2
    view = camera.directions()
    step = angle(view[half - 1, column], view[half, column])
    assert_allclose(camera.pixel_angle, step, rtol=camera.pixel_angle**2)


@pytest.mark.parametrize("degrees", [1.0, 60.0, 120.0])
def test_perspective_field_of_view_is_between_the_edges(degrees: float) -> None:
    camera = Camera(width=64, height=3, field_of_view=degrees)
    left = camera.directions(slice(1, 2), offset=(-0.5, 0.0))[0, 0]
    right = camera.directions(slice(1, 2), offset=(0.5, 0.0))[0, -1]
    assert_allclose(math.degrees(angle(left, right)), degrees, rtol=1e-12)


def test_perspective_keeps_straight_lines_straight() -> None:
    # the horizon is one row of a level camera: all its view vectors lie in one plane
    view = Camera(width=64, height=9, field_of_view=120.0).directions(slice(4, 5))[0]
    assert_allclose(view[:, 2], 0.0, atol=ROUNDING)


def test_fisheye_is_equidistant() -> None:
    # the defining law of the projection: angle off the axis = distance · fov/2
    camera = Camera(projection="fisheye", width=64, height=64, field_of_view=220.0)
    view = camera.directions()
    x = (2 * np.arange(64) + 1 - 64) / 64
    distance = np.hypot(x[np.newaxis, :], x[:, np.newaxis])
    inside = distance <= 1.0
    off_axis = np.degrees(np.arctan2(np.hypot(view[..., 0], view[..., 1]), view[..., 2]))
    assert_allclose(off_axis[inside], 110.0 * distance[inside], rtol=1e-12)
    assert_array_equal(view[~inside], 0.0)


def test_dome_master_has_the_sun_side_at_the_bottom_and_azimuth_90_on_the_right() -> None:
    # the audience faces the bottom edge and looks up: azimuth 90 is at its right hand
    view = Camera(projection="fisheye", width=65, height=65).directions()
    assert_allclose(view[32, 32], [0.0, 0.0, 1.0], atol=ROUNDING)
    almost = math.sin(math.radians(90.0 * 64 / 65))
    assert_allclose(view[64, 32] @ direction(90.0, 0.0), almost, atol=ROUNDING)
    assert_allclose(view[32, 64] @ direction(90.0, 90.0), almost, atol=ROUNDING)


@pytest.mark.parametrize("camera", WHOLE_SPHERE, ids=name)
def test_whole_sphere_projections_show_all_directions_once(camera: Camera) -> None:
    # over the sphere the mean of v is 0 and the mean of v v^T is a third of the unit matrix;
    # weights: a pixel's solid angle at its centre, whose sum is off by O(pixel angle squared)
    view = camera.directions()
    if camera.projection == "octahedral":
        weight = np.full(view.shape[:2], 4.0 * math.pi / (camera.width * camera.height))
    elif camera.projection == "cubemap":
        weight = np.max(np.abs(view), axis=-1) ** 3 * camera.pixel_angle**2
    else:
        weight = np.hypot(view[..., 0], view[..., 1]) * camera.pixel_angle**2
    error = camera.pixel_angle**2
    assert_allclose(weight.sum(), 4.0 * math.pi, rtol=error)
    assert_allclose(np.einsum("ij,ijk->k", weight, view), 0.0, atol=1e-12)
    second = np.einsum("ij,ijk,ijl->kl", weight, view, view) / weight.sum()
    assert_allclose(second, np.eye(3) / 3.0, atol=error)


def test_panorama_meets_itself_behind_the_camera() -> None:
    # one step over the seam is as long as one step anywhere in the row
    view = Camera(projection="equirectangular", width=256, height=128).directions()
    over_the_seam = angle(view[:, -1], view[:, 0])
    elsewhere = angle(view[:, 100], view[:, 101])
    assert_allclose(over_the_seam, elsewhere, rtol=1e-10)


def test_panorama_middle_looks_ahead_and_right_quarter_at_azimuth_90() -> None:
    camera = Camera(projection="equirectangular", width=64, height=32)
    half_pixel = (-0.5, -0.5)
    view = camera.directions(offset=half_pixel)
    assert_allclose(view[16, 32], [1.0, 0.0, 0.0], atol=ROUNDING)
    assert_allclose(view[16, 48], direction(90.0, 90.0), atol=ROUNDING)


def test_cube_faces_are_right_left_up_down_ahead_behind() -> None:
    # OpenGL 4.6 Core Profile specification, section 8.13: +x -x +y -y +z -z
    view = Camera(projection="cubemap", width=18, height=3).directions(slice(1, 2))[0]
    middles = view[1::3]
    expected = [
        direction(90.0, 90.0),
        direction(90.0, -90.0),
        direction(0.0, 0.0),
        direction(180.0, 0.0),
        direction(90.0, 0.0),
        direction(90.0, 180.0),
    ]
    assert_allclose(middles, expected, atol=ROUNDING)


def test_each_cube_pixel_is_where_opengl_looks_it_up() -> None:
    # second method: OpenGL 4.6 Core Profile specification, section 8.13, from a direction to face,
    # s and t; its t counts from the first row that is stored
    size = 5
    camera = Camera(projection="cubemap", width=6 * size, height=size)
    rx, ry, rz = (camera.directions() @ camera.axes.T).transpose(2, 0, 1)
    table = [
        (rx, -rz, -ry),
        (-rx, rz, -ry),
        (ry, rx, rz),
        (-ry, rx, -rz),
        (rz, rx, -ry),
        (-rz, -rx, -ry),
    ]
    major = np.stack([ma for ma, _, _ in table])
    face = major.argmax(axis=0)
    ma = major.max(axis=0)
    sc = np.choose(face, [sc for _, sc, _ in table])
    tc = np.choose(face, [tc for _, _, tc in table])
    column = (face + 0.5 * (sc / ma + 1.0)) * size - 0.5
    row = 0.5 * (tc / ma + 1.0) * size - 0.5
    expected_row, expected_column = np.mgrid[:size, : 6 * size]
    assert_allclose(column, expected_column, atol=1e-12)
    assert_allclose(row, expected_row, atol=1e-12)


def test_cube_faces_meet_their_neighbours_within_a_pixel() -> None:
    # every pixel on the border of a face has one of another face at most a pixel away
    size = 16
    view = Camera(projection="cubemap", width=6 * size, height=size).directions()
    faces = view.reshape(size, 6, size, 3).transpose(1, 0, 2, 3)
    for index in range(6):
        face = faces[index]
        border = np.concatenate([face[0], face[-1], face[:, 0], face[:, -1]])
        others = np.delete(faces, index, axis=0).reshape(-1, 3)
        nearest = np.arccos(np.clip(border @ others.T, -1.0, 1.0)).min(axis=1)
        assert nearest.max() < 2.0 / size


@pytest.mark.parametrize(
    ("changes", "field", "allowed"),
    [
        ({"projection": "mercator"}, "camera.projection", "perspective, fisheye"),
        ({"width": 0}, "camera.width", "1 to 65536 pixels"),
        ({"height": 720.0}, "camera.height", "1 to 65536 pixels"),
        ({"height": True}, "camera.height", "1 to 65536 pixels"),
        ({"width": 60000, "height": 60000}, "camera.size", "at most"),
        ({"projection": "equirectangular"}, "camera.size", "twice as wide as high"),
        ({"projection": "cubemap"}, "camera.size", "six times as wide as high"),
        ({"field_of_view": 0.0}, "camera.field_of_view", "0.001 to 170 deg"),
        ({"field_of_view": 180.0}, "camera.field_of_view", "0.001 to 170 deg"),
        ({"field_of_view": math.nan}, "camera.field_of_view", "0.001 to 170 deg"),
        ({"field_of_view": "60"}, "camera.field_of_view", "0.001 to 170 deg"),
        (
            {"projection": "cubemap", "width": 6, "height": 1, "field_of_view": 90.0},
            "camera.field_of_view",
            "360 deg",
        ),
        ({"look_zenith": 181.0}, "camera.look_zenith", "0 to 180 deg"),
        ({"look_azimuth": math.inf}, "camera.look_azimuth", "-360 to 360 deg"),
        ({"roll": None}, "camera.roll", "-360 to 360 deg"),
    ],
)
def test_an_impossible_camera_is_refused_with_field_and_range(
    changes: dict[str, object], field: str, allowed: str
) -> None:
    with pytest.raises(ParameterError) as refusal:
        Camera(**changes)  # type: ignore[arg-type]
    assert refusal.value.field == field
    assert allowed in refusal.value.allowed
    assert "\n" not in str(refusal.value)


def test_the_largest_pictures_are_allowed() -> None:
    # 8192² of features.md R2, and the cube map with faces of that size
    Camera(projection="fisheye", width=8192, height=8192)
    Camera(projection="cubemap", width=6 * 8192, height=8192)
