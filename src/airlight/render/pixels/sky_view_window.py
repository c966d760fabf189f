"""Window of the sky-view LUT that a camera needs, and resolution of the LUT."""

from __future__ import annotations

from dataclasses import replace
from math import ceil, floor, sqrt
from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.mappings.sky_view import row_from_angle, row_from_impact
from airlight.render.pixels.sky_view_lut import Observer
from airlight.scene.projections.projected import projected_rays

if TYPE_CHECKING:
    from airlight.scene import Camera

FloatArray = NDArray[np.float64]

#: Azimuths from 0 to π, and rows of each half, of the coarsest LUT.
COARSEST: Final = (192, 192)
#: Largest refinement factor per axis.
_FINEST: Final = 4.0
#: Target pixels per texel; and fewest pixels per texel for which a LUT is worthwhile.
_PIXELS_A_TEXEL: Final = 48
_FEWEST_PIXELS_A_TEXEL: Final = 2
#: Deepest angle below the horizon of the lines of sight to the ground before hills on it. [rad]
_BEFORE_HILLS: Final = 0.09
#: Largest angle of hills above the horizon. [rad]
_HILLS: Final = 0.05
#: Sampling step over the frame. [pixel]
_STEP: Final = 8


class SkyViewWindow(NamedTuple):
    """Window of the sky-view LUT.

    Attributes
    ----------
    columns, rows : int
        Azimuths of the whole LUT from 0 to π, and rows of each half.
    first_column, column_count : int
        First azimuth, and number of azimuths.
    first_sky, sky_count, first_ground, ground_count : int
        Rows of each half, counted from the horizon.
    """

    columns: int
    rows: int
    first_column: int
    column_count: int
    first_sky: int
    sky_count: int
    first_ground: int
    ground_count: int

    @classmethod
    def whole(cls, columns: int, rows: int) -> SkyViewWindow:
        """Window of the complete LUT.

        Parameters
        ----------
        columns, rows : int
            Azimuths from 0 to π, and rows of each half.
        """
        return cls(columns, rows, 0, columns, 0, rows, 0, rows)

    @property
    def texels(self) -> int:
        """Number of texels of sky and ground, without those of the mirrored sky."""
        return (self.sky_count + self.ground_count) * self.column_count


def sky_view_window(
    camera: Camera, observer: Observer, bottom: float, top: float
) -> SkyViewWindow | None:
    """Window of the sky-view LUT that a camera needs.

    The LUT is refined while there are many more pixels than texels.

    Parameters
    ----------
    camera : Camera
        Camera of the scene.
    observer : Observer
        Observer and star.
    bottom, top : float
        Radii of the ground and of the shell's top. [m]

    Returns
    -------
    SkyViewWindow or None
        Window; None where marching every pixel is faster.
    """
    # cropped frames use the same texels as the whole frame
    seen = _seen_ranges(replace(camera, crop=None), observer, bottom, top)
    coarse = _window(COARSEST, *seen)
    pixels = camera.width * camera.height
    if coarse.texels * _FEWEST_PIXELS_A_TEXEL > pixels:
        return None
    finer = min(max(sqrt(pixels / (_PIXELS_A_TEXEL * coarse.texels)), 1.0), _FINEST)
    shape = (round(finer * COARSEST[0]), round(finer * COARSEST[1]))
    if camera.crop is not None:
        seen = _seen_ranges(camera, observer, bottom, top)
    return _window(shape, *seen[:2], _with_hills(*seen[1:], observer))


def coarse_window(
    camera: Camera, observer: Observer, bottom: float, top: float, shape: tuple[int, int]
) -> SkyViewWindow:
    """Window that a camera needs of a table with fewer directions.

    Parameters
    ----------
    camera, observer, bottom, top :
        Arguments of ``sky_view_window``.
    shape : tuple of two int
        Azimuths from 0 to π, and rows of each half.
    """
    seen = _seen_ranges(replace(camera, crop=None), observer, bottom, top)
    return _window(shape, *seen[:2], _with_hills(*seen[1:], observer))


def _with_hills(
    sky: tuple[float, float], ground: tuple[float, float], observer: Observer
) -> tuple[float, float]:
    """Range of ground rows of a frame, with those before hills that rise above its lower edge."""
    highest, lowest = (
        float(row_from_angle(one, observer.horizon_mu)) for one in (_HILLS, -_BEFORE_HILLS)
    )
    if observer.outside or sky[0] > highest or ground[0] > 0.0:
        return ground
    return 0.0, max(ground[1], lowest)


def is_always_read(camera: Camera) -> bool:
    """Whether frames of this size always use a sky-view LUT, for any observer and direction."""
    texels = 2 * COARSEST[0] * COARSEST[1]
    return texels * _FEWEST_PIXELS_A_TEXEL <= camera.width * camera.height


def _window(
    shape: tuple[int, int],
    azimuths: tuple[float, float],
    sky: tuple[float, float],
    ground: tuple[float, float],
) -> SkyViewWindow:
    """Window around ranges of azimuth over π and of row coordinates."""
    ends: list[int] = []
    for (low, high), count in zip(
        (azimuths, sky, ground), (shape[0], shape[1], shape[1]), strict=True
    ):
        first = min(max(floor(low * (count - 1)), 0), count - 2)
        last = min(max(ceil(high * (count - 1)), first + 1), count - 1)
        ends += [first, last - first + 1]
    return SkyViewWindow(*shape, *ends)


def _sampled(first: int, count: int, side: int) -> FloatArray:
    """Sample positions along a side, with a margin of two steps. [pixel]"""
    low, high = max(first - 2 * _STEP, 0), min(first + count + 2 * _STEP, side)
    return np.linspace(low, high, max(2, -(-(high - low) // _STEP) + 1))


def _seen_ranges(
    camera: Camera, observer: Observer, bottom: float, top: float
) -> tuple[tuple[float, float], tuple[float, float], tuple[float, float]]:
    """Ranges of azimuth over π and of row coordinates in both halves, over all pixels. [1]"""
    assert camera.field_of_view is not None
    x = _sampled(camera.left, camera.columns, camera.width)
    y = _sampled(camera.top, camera.rows, camera.height)
    fov = np.radians(camera.field_of_view)
    rays = projected_rays(camera.projection, x, y, camera.width, camera.height, fov)
    rays = rays @ camera.axes
    rays = rays[np.any(rays != 0.0, axis=-1)]
    margin = _STEP * camera.pixel_angle  # no pixel is farther from a sample
    zenith = np.arctan2(np.hypot(rays[:, 0], rays[:, 1]), rays[:, 2])
    azimuth = np.abs(np.arctan2(rays[:, 1], rays[:, 0]))
    if observer.outside:
        lowest = np.clip(zenith + margin, 0.5 * np.pi, np.pi)
        passes = observer.r * np.sin(lowest) < top
        zenith, azimuth = zenith[passes], azimuth[passes]
    if zenith.size == 0:
        return (0.0, 0.0), (0.0, 0.0), (0.0, 0.0)
    around = np.sin(min(margin, 0.5 * np.pi)) / np.maximum(np.sin(zenith), 1e-9)
    turn = np.where(around < 1.0, np.arcsin(np.minimum(around, 1.0)), np.pi)
    azimuths = (
        float(np.clip((azimuth - turn) / np.pi, 0.0, 1.0).min()),
        float(np.clip((azimuth + turn) / np.pi, 0.0, 1.0).max()),
    )
    high, low = float(zenith.min()) - margin, float(zenith.max()) + margin
    if observer.outside:
        # The line's smallest distance decreases from the horizontal down.
        farthest, nearest = (
            observer.r * float(np.sin(np.clip(angle, 0.5 * np.pi, np.pi))) for angle in (high, low)
        )
        sky = (max(nearest, bottom), min(max(farthest, bottom), top))
        ground = (min(farthest, bottom), min(nearest, bottom))
        ends = ((row_from_impact(one, bottom, top) for one in half) for half in (sky, ground))
        rows = [float(one) for half in ends for one in half]
    else:
        horizon = float(np.arctan2(observer.horizon_sine, observer.horizon_mu))
        up, down = horizon - high, horizon - low
        angles = (max(down, 0.0), max(up, 0.0), min(up, 0.0), min(down, 0.0))
        rows = [float(row_from_angle(one, observer.horizon_mu)) for one in angles]
    return azimuths, (rows[0], rows[1]), (rows[2], rows[3])
