"""Six square faces side by side, in the order and orientation that graphics interfaces expect."""

from __future__ import annotations

import numpy as np

from airlight.scene.projections.projection import FloatArray, Projection

#: For each face the camera-frame vectors (right, up, forward) of: the face's middle, the step
#: towards its right edge, the step towards its bottom edge. Order +x, -x, +y, -y, +z, -z with
#: x right, y up and z forward. [OpenGL 4.6 Core Profile specification, section 8.13]
_FACES = np.array(
    [
        [[1, 0, 0], [0, 0, -1], [0, -1, 0]],
        [[-1, 0, 0], [0, 0, 1], [0, -1, 0]],
        [[0, 1, 0], [1, 0, 0], [0, 0, 1]],
        [[0, -1, 0], [1, 0, 0], [0, 0, -1]],
        [[0, 0, 1], [1, 0, 0], [0, -1, 0]],
        [[0, 0, -1], [-1, 0, 0], [0, -1, 0]],
    ],
    dtype=np.float64,
)


def rays(x: FloatArray, y: FloatArray, width: int, height: int, field_of_view: float) -> FloatArray:
    """View vectors of a strip of six faces: right, left, up, down, ahead, behind.

    Parameters
    ----------
    x, y : array, shape (nx,) and (ny,)
        Pixel coordinates from the left and the top edge. [pixel]
    width, height : int
        Of the strip: six faces wide, one high. [pixel]
    field_of_view : float
        A full turn; nothing else is allowed. [rad]

    Returns
    -------
    array, shape (ny, nx, 3)
        Unit vectors (right, up, forward). [1]

    Examples
    --------
    >>> ahead = rays(np.array([4.5]), np.array([0.5]), 6, 1, 6.283185307179586)
    >>> [float(v) for v in ahead[0, 0]]
    [0.0, 0.0, 1.0]
    """
    face = np.clip(np.floor(x / height).astype(np.intp), 0, 5)
    across = 2.0 * (x / height - face) - 1.0
    down = 2.0 * y / height - 1.0
    middle, to_right, to_bottom = (_FACES[face, part] for part in range(3))
    out: FloatArray = (middle + across[:, np.newaxis] * to_right)[np.newaxis, :, :] + (
        down[:, np.newaxis, np.newaxis] * to_bottom[np.newaxis, :, :]
    )
    out /= np.sqrt(1.0 + across[np.newaxis, :] ** 2 + down[:, np.newaxis] ** 2)[..., np.newaxis]
    return out


def pixel_angle(width: int, height: int, field_of_view: float) -> float:
    """Angle of the middle pixel of a face. [rad]"""
    return 2.0 / height


CUBEMAP = Projection(
    name="cubemap",
    rays=rays,
    pixel_angle=pixel_angle,
    fits=lambda width, height: width == 6 * height,
    shape="six times as wide as high",
    field_of_view=360.0,
    field_of_view_limits=(360.0, 360.0),
    look_zenith=90.0,
)
