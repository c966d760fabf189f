"""Pinhole camera of another renderer's image, and readers of camera files."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import FileError, ParameterError
from airlight.files.input_files import read_text
from airlight.physics.units import values_in

FloatArray = NDArray[np.float64]

#: Camera models in a file that are a pinhole.
_MODELS: Final = ("OPENCV", "PINHOLE", "SIMPLE_PINHOLE")
#: Keys of lens distortion, which is not rendered.
_DISTORTION: Final = ("k1", "k2", "k3", "k4", "p1", "p2")
#: Largest deviation of a camera's axes from orthogonality. [1]
_SKEW: Final = 1e-3
#: Largest relative difference of the aspect ratios of a picture and its camera.
_SHAPE: Final = 0.01
_MATRIX: Final = "a 4 x 4 matrix of finite numbers"


@dataclass(frozen=True, kw_only=True, eq=False)
class Pinhole:
    """Pinhole camera in scene coordinates.

    Parameters
    ----------
    width, height : int
        Size of the image. [pixel]
    focal_x, focal_y : float
        Focal lengths. [pixel]
    centre_x, centre_y : float, optional
        Principal point from the left and the top edge; by default the image centre. [pixel]
    to_world : array, shape (4, 4)
        Camera-to-scene matrix: columns are right, up and backward of the camera, which looks along
        -Z, and its position in scene units.

    Raises
    ------
    ParameterError
        With the field, the value and the allowed range.

    Examples
    --------
    >>> camera = Pinhole(width=4, height=2, focal_x=2.0, focal_y=2.0, to_world=np.eye(4))
    >>> camera.rays(slice(0, 1))[0, 0]  # right, up and forward of the left upper pixel
    array([-0.75,  0.25,  1.  ])
    """

    width: int
    height: int
    focal_x: float
    focal_y: float
    to_world: FloatArray
    centre_x: float | None = None
    centre_y: float | None = None

    def __post_init__(self) -> None:
        for name in ("width", "height"):
            value = getattr(self, name)
            if not isinstance(value, (int, np.integer)) or isinstance(value, bool) or value < 1:
                raise ParameterError(f"camera.{name}", value, "a whole number of pixels")
        x, y = self.centre
        for name, value in (
            ("focal_x", self.focal_x),
            ("focal_y", self.focal_y),
            ("centre_x", x),
            ("centre_y", y),
        ):
            sound = isinstance(value, (int, float, np.number)) and math.isfinite(value)
            if not sound or (name.startswith("focal") and value <= 0.0):
                allowed = "a number above 0" if name.startswith("focal") else "a finite number"
                raise ParameterError(f"camera.{name}", value, f"{allowed}, in pixels")
        matrix = values_in(self.to_world, "1", "camera.transform_matrix", allowed=_MATRIX)
        if matrix.shape != (4, 4) or not np.isfinite(matrix).all():
            raise ParameterError("camera.transform_matrix", self.to_world, _MATRIX)
        axes = matrix[:3, :3]
        length = np.linalg.norm(axes, axis=0)
        if not (length > 0.0).all() or abs(np.linalg.det(axes / length) - 1.0) > _SKEW:
            allowed = "perpendicular axes: +X right, +Y up, looking along -Z"
            raise ParameterError("camera.transform_matrix", axes.round(4).tolist(), allowed)
        object.__setattr__(self, "to_world", matrix)

    @property
    def axes(self) -> FloatArray:
        """Right, up and forward in the scene's coordinates as rows, shape (3, 3). [1]"""
        # The nearest rotation, so that rays keep their length.
        u, _, v = np.linalg.svd(
            self.to_world[:3, :3] / np.linalg.norm(self.to_world[:3, :3], axis=0)
        )
        rotation = u @ v
        return np.asarray((rotation * [1.0, 1.0, -1.0]).T)

    @property
    def position(self) -> FloatArray:
        """Position in scene units, shape (3,)."""
        return np.asarray(self.to_world[:3, 3])

    def rays(self, rows: slice) -> FloatArray:
        """Rays of rows of pixels, with forward component 1.

        Parameters
        ----------
        rows : slice
            Rows from the top.

        Returns
        -------
        array, shape (rows, width, 3)
            Right, up and forward; their length is distance over planar depth. [1]
        """
        x, y = np.arange(self.width, dtype=float), np.arange(self.height, dtype=float)[rows]
        return self.rays_at(np.add(x, 0.5), np.add(y, 0.5))

    def rays_at(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Rays of a grid of image positions, shape (ny, nx, 3). [1]

        Parameters
        ----------
        x, y : array, shape (nx,) and (ny,)
            Positions from the left and the top edge. [pixel]
        """
        centre_x, centre_y = self.centre
        out = np.ones((y.size, x.size, 3))
        out[..., 0] = (x - centre_x) / self.focal_x
        out[..., 1] = (centre_y - y[:, None]) / self.focal_y
        return out

    @property
    def centre(self) -> tuple[float, float]:
        """Principal point from the left and the top edge. [pixel]"""
        x = 0.5 * self.width if self.centre_x is None else self.centre_x
        return x, 0.5 * self.height if self.centre_y is None else self.centre_y

    def sized(self, width: int, height: int) -> Pinhole:
        """Camera with another image size and the same view.

        Parameters
        ----------
        width, height : int
            Size of the image. [pixel]

        Raises
        ------
        ParameterError
            If the aspect ratio differs.
        """
        if (width, height) == (self.width, self.height):
            return self
        x, y = width / self.width, height / self.height
        if abs(x / y - 1.0) > _SHAPE:
            allowed = f"the shape of the picture, {width}x{height}"
            raise ParameterError("camera.size", f"{self.width}x{self.height}", allowed)
        centre_x, centre_y = self.centre
        return Pinhole(
            width=width,
            height=height,
            focal_x=x * self.focal_x,
            focal_y=y * self.focal_y,
            centre_x=x * centre_x,
            centre_y=y * centre_y,
            to_world=self.to_world,
        )


def camera_from_json(
    path: str | Path, picture: str = "", *, size: tuple[int, int] | None = None
) -> tuple[Pinhole, dict[str, Any]]:
    """Camera from ``transforms.json`` of radiance-field tools.

    Parameters
    ----------
    path : str or Path
        JSON with ``fl_x``, ``fl_y``, ``cx``, ``cy`` or ``camera_angle_x`` [rad], ``w`` and ``h``
        [pixel], and ``transform_matrix``, at the same level or in one of ``frames``.
    picture : str
        Path of the image; selects the frame whose ``file_path`` has this name.
    size : (int, int), optional
        Width and height of the image, if not in the file. [pixel]

    Returns
    -------
    camera : Pinhole
        Camera.
    place : dict
        Block ``airlight`` of the file, unvalidated; empty without one.
    """
    try:
        data = json.loads(read_text(path))
    except (ValueError, RecursionError) as error:
        raise FileError(path, f"cannot be read as JSON: {error}") from error
    if not isinstance(data, dict):
        raise FileError(path, "is not a JSON object")
    try:
        place = data.get("airlight", {})
        if not isinstance(place, dict):
            raise ParameterError("airlight", place, "an object")
        return _camera(data | _frame(data, picture), size), place
    except ParameterError as error:
        raise error.in_file(path) from None


def _frame(data: Mapping[str, Any], picture: str) -> dict[str, Any]:
    frames = data.get("frames")
    if frames is None:
        return {}
    if not isinstance(frames, list) or not all(isinstance(one, dict) for one in frames):
        raise ParameterError("frames", frames, "a list of objects")
    if len(frames) == 1:
        return dict(frames[0])
    stem = Path(picture).stem
    found = [one for one in frames if Path(str(one.get("file_path", ""))).stem == stem]
    if len(found) != 1:
        names = ", ".join(str(one.get("file_path")) for one in frames[:5])
        raise ParameterError("frames", f"{len(frames)} frames ({names})", f"a frame named {stem!r}")
    return dict(found[0])


def _camera(data: Mapping[str, Any], size: tuple[int, int] | None) -> Pinhole:
    model = data.get("camera_model", "PINHOLE")
    if model not in _MODELS:
        raise ParameterError("camera_model", model, ", ".join(_MODELS))
    for key in _DISTORTION:
        if data.get(key, 0.0) != 0.0:
            raise ParameterError(key, data[key], "0: lens distortion is not supported")
    width, height = (
        _number(data, key, None if size is None else size[i]) for i, key in enumerate(("w", "h"))
    )
    if "fl_x" in data:
        focal_x = _number(data, "fl_x")
        focal_y = _number(data, "fl_y", focal_x)
    else:
        focal_x = _focal(width, _number(data, "camera_angle_x"))
        focal_y = focal_x
        if "camera_angle_y" in data:
            focal_y = _focal(height, _number(data, "camera_angle_y"))
    if "transform_matrix" not in data:
        raise ParameterError("transform_matrix", "missing", "a 4 x 4 matrix")
    return Pinhole(
        width=round(width),
        height=round(height),
        focal_x=focal_x,
        focal_y=focal_y,
        centre_x=_number(data, "cx", 0.5 * width),
        centre_y=_number(data, "cy", 0.5 * height),
        to_world=data["transform_matrix"],
    )


def _focal(side: float, angle: float) -> float:
    if not 0.0 < angle < math.pi:
        raise ParameterError("camera_angle_x", angle, "between 0 and pi")
    return 0.5 * side / math.tan(0.5 * angle)


def _number(data: Mapping[str, Any], key: str, otherwise: float | None = None) -> float:
    value = data.get(key, otherwise)
    if value is None:
        raise ParameterError(key, "missing", "a number")
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
        raise ParameterError(key, value, "a finite number")
    return float(value)


def camera_from_matrices(
    world_to_camera: ArrayLike, world_to_ndc: ArrayLike, width: int, height: int
) -> Pinhole:
    """Camera from the standard attributes of an OpenEXR file.

    Parameters
    ----------
    world_to_camera, world_to_ndc : array, shape (4, 4)
        ``worldToCamera``, whose camera looks along +Z with X to the right and Y up, and
        ``worldToNDC``, 0 to 1 across the image from its upper left corner; for row vectors.
    width, height : int
        Size of the image. [pixel]

    References
    ----------
    OpenEXR, *Standard attributes*: "Camera and Scene".
    """
    try:
        to_camera, to_ndc = (
            np.asarray(one, float).reshape(4, 4) for one in (world_to_camera, world_to_ndc)
        )
        to_world = np.linalg.inv(to_camera)
        points = np.array([[0.0, 0.0, 1.0, 1.0], [1.0, 0.0, 1.0, 1.0], [0.0, 1.0, 1.0, 1.0]])
        seen = points @ to_world @ to_ndc
        x, y = (seen[:, :2] / seen[:, 3:]).T
    except (ValueError, np.linalg.LinAlgError):
        raise ParameterError("worldToCamera", world_to_camera, "a matrix with an inverse") from None
    focal_x, focal_y = width * (x[1] - x[0]), height * (y[0] - y[2])
    # Rows to columns, and from a camera that looks along +Z to one that looks along -Z.
    return Pinhole(
        width=width,
        height=height,
        focal_x=float(focal_x),
        focal_y=float(focal_y),
        centre_x=float(width * x[0]),
        centre_y=float(height * y[0]),
        to_world=to_world.T @ np.diag([1.0, 1.0, -1.0, 1.0]),
    )
