"""Camera: size, projection and orientation, which determine the direction of each pixel."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ConflictError, ParameterError
from airlight.physics.units import Measured, measured, values_in
from airlight.scene.directions import camera_axes, camera_frame, rolled
from airlight.scene.limits import HIGHEST_ALTITUDE
from airlight.scene.projections import PROJECTIONS, Projection
from airlight.scene.projections.projected import projected_rays
from airlight.scene.scene_fields import (
    DEHAZE,
    EXTENT,
    FIELD_OF_VIEW,
    LOOK_AZIMUTH,
    LOOK_ZENITH,
    POLARISER,
    ROLL,
    within_range,
)

#: Longest side of a picture: a strip of six 8192² faces fits. [pixel]
LONGEST_SIDE = 65536
#: Largest number of pixels of a picture: that strip.
MOST_PIXELS = 6 * 8192 * 8192
_ANGLES: Final = {
    "look_zenith": LOOK_ZENITH,
    "look_azimuth": LOOK_AZIMUTH,
    "roll": ROLL,
    "polariser": POLARISER,
}


def _is_whole(value: object) -> bool:
    return isinstance(value, (int, np.integer)) and not isinstance(value, bool)


@dataclass(frozen=True, kw_only=True)
class Camera:
    """Size, projection and orientation of the camera.

    Angles are in the observer's local frame: the azimuth is 0 on the sun's side and increases
    clockwise seen from above, so that a camera directed at the sun's azimuth has azimuth +90° on
    the right half of its picture. They are numbers, text with a unit, or
    quantities.

    Parameters
    ----------
    projection : str
        Name of the projection: ``perspective``, ``fisheye`` (equidistant, a dome master),
        ``equirectangular`` (a panorama of the whole sphere), ``cubemap`` (a strip of six faces:
        right, left, up, down, ahead, behind), ``octahedral`` (the whole sphere on a square of equal
        solid angles) or ``orthographic`` (parallel lines of sight: the disc of a planet).
    width, height : int
        Size of the frame: a panorama is twice as wide as high, a cube strip six times, an
        octahedral one square. [pixel]
    field_of_view : float, optional
        Angle between the left and the right edge for perspective, default 60; across the circle for
        a fisheye, default 180. Other projections show the whole sphere; for an orthographic camera
        it follows from ``extent``. [deg]
    look_zenith : float, optional
        Zenith angle of the line of sight, default 90 (fisheye: 0; orthographic: 180). [deg]
    look_azimuth : float
        Azimuth of the line of sight. [deg]
    roll : float
        Clockwise rotation of the camera about its line of sight. [deg]
    polariser : float, optional
        Ideal polarising filter: angle of its axis, counterclockwise from the camera's up; no filter
        by default. It halves unpolarised radiance. [deg]
    dehaze : float
        Fraction of the haze over sunlit ground that a picture from more than 60 km leaves out, see
        ``airlight.render.pixels.haze_removal``: the frame is then no radiance. Default 0. [1]
    extent : float, optional
        Length between the left and the right edge, required for an orthographic camera; see
        ``airlight.scene.projections.orthographic.disc_extent``. [m]
    crop : (int, int, int, int), optional
        Rendered window of the frame: left and top edge, width and height. Its pixels are identical
        to those of the whole frame. [pixel]

    Raises
    ------
    ParameterError
        With the field, the value and the allowed range.

    Examples
    --------
    >>> camera = Camera(width=3, height=1, field_of_view=90.0)
    >>> camera.directions(slice(0, 1))[0, 1].round(12) + 0.0  # the centre looks to the sun's side
    array([1., 0., 0.])
    """

    projection: str = "perspective"
    width: int = 1280
    height: int = 720
    field_of_view: Measured[float | None] = measured(None)
    look_zenith: Measured[float | None] = measured(None)
    look_azimuth: Measured[float] = measured(0.0)
    roll: Measured[float] = measured(0.0)
    polariser: Measured[float | None] = measured(None)
    dehaze: float = 0.0
    extent: Measured[float | None] = measured(None)
    crop: tuple[int, int, int, int] | None = None

    def __post_init__(self) -> None:
        if self.projection not in PROJECTIONS:
            raise ParameterError("camera.projection", self.projection, ", ".join(PROJECTIONS))
        form = self._form
        for side in ("width", "height"):
            value = getattr(self, side)
            if not _is_whole(value) or not 1 <= value <= LONGEST_SIDE:
                raise ParameterError(f"camera.{side}", value, f"1 to {LONGEST_SIDE} pixels")
        size = f"{self.width}x{self.height}"
        if self.crop is not None:
            object.__setattr__(self, "crop", self._checked_crop(size))
        if self.columns * self.rows > MOST_PIXELS:
            raise ParameterError("camera.size", size, f"at most {MOST_PIXELS} pixels in all")
        if not form.fits(self.width, self.height):
            raise ParameterError("camera.size", size, f"{form.shape} for {form.name}")
        self._check_parallel()
        object.__setattr__(self, "dehaze", within_range("camera.dehaze", self.dehaze, DEHAZE))
        defaults = {"field_of_view": form.field_of_view, "look_zenith": form.look_zenith}
        field_of_view = replace(FIELD_OF_VIEW, range=form.field_of_view_limits)
        for name, declared in {**_ANGLES, "field_of_view": field_of_view}.items():
            value = getattr(self, name)
            if value is None:
                value = defaults.get(name)
            if value is not None or name != "polariser":
                value = within_range(f"camera.{name}", value, declared)
            object.__setattr__(self, name, value)

    def _checked_crop(self, size: str) -> tuple[int, int, int, int]:
        allowed = f"left, top, width and height of a window inside {size} pixels"
        crop = self.crop
        if not isinstance(crop, (tuple, list)) or len(crop) != 4 or not all(map(_is_whole, crop)):
            raise ParameterError("camera.crop", crop, allowed)
        left, top, width, height = (int(one) for one in crop)
        inside = 0 <= left <= self.width - width and 0 <= top <= self.height - height
        if not inside or width < 1 or height < 1:
            raise ParameterError("camera.crop", crop, allowed)
        return left, top, width, height

    def _check_parallel(self) -> None:
        """Validate the parameters of an orthographic camera, and set its field of view."""
        name, given = self.projection, self.field_of_view
        if not self.parallel:
            if self.extent is not None:
                raise ConflictError("camera.extent", f"does not apply to {name}")
            return
        form = f"a length from left to right, such as '14000 km', for {name}"
        if self.extent is None:
            raise ParameterError("camera.extent", None, form)
        extent = within_range("camera.extent", self.extent, EXTENT)
        angle = math.degrees(2.0 * math.asin(0.5 * extent / HIGHEST_ALTITUDE))
        if given is not None and values_in(given, "deg", "camera.field_of_view") != angle:
            raise ConflictError("camera.field_of_view", f"does not apply to {name}: use extent")
        zenith = self.look_zenith
        if zenith is not None and values_in(zenith, "deg", "camera.look_zenith") != 180.0:
            allowed = f"180 deg for {name}, which looks at the planet's centre"
            raise ParameterError("camera.look_zenith", zenith, allowed)
        object.__setattr__(self, "extent", extent)
        object.__setattr__(self, "field_of_view", angle)

    @property
    def parallel(self) -> bool:
        """Whether lines of sight are parallel."""
        return self._form.parallel

    @property
    def left(self) -> int:
        """First rendered column. [pixel]"""
        return 0 if self.crop is None else self.crop[0]

    @property
    def top(self) -> int:
        """First rendered row. [pixel]"""
        return 0 if self.crop is None else self.crop[1]

    @property
    def columns(self) -> int:
        """Number of rendered columns. [pixel]"""
        return self.width if self.crop is None else self.crop[2]

    @property
    def rows(self) -> int:
        """Number of rendered rows. [pixel]"""
        return self.height if self.crop is None else self.crop[3]

    @property
    def _form(self) -> Projection:
        return PROJECTIONS[self.projection]

    @property
    def _field_of_view_radians(self) -> float:
        assert self.field_of_view is not None  # filled in when the camera was made
        return math.radians(self.field_of_view)

    @property
    def pixel_angle(self) -> float:
        """Angle of a pixel on the optical axis. [rad]"""
        return self._form.pixel_angle(self.width, self.height, self._field_of_view_radians)

    @property
    def glare_angle(self) -> float:
        """Pixel angle for glare; 0 for projections with disconnected neighbours. [rad]"""
        return self.pixel_angle if self._form.connected else 0.0

    @property
    def circle(self) -> tuple[int, int] | None:
        """Frame size of a projection with an image circle; None for others. [pixel]"""
        return (self.width, self.height) if self._form.circular else None

    @property
    def filter_axis(self) -> NDArray[np.float64]:
        """Axis of the polarising filter in the local frame, shape (3,); zero without filter. [1]"""
        if self.polariser is None:
            return np.zeros(3)
        assert self.look_zenith is not None  # filled in when the camera was made
        right, up, _ = camera_frame(self.look_zenith, self.look_azimuth, self.roll)
        return np.array(rolled(up, right, self.polariser))

    @property
    def axes(self) -> NDArray[np.float64]:
        """Right, up and forward of the camera in the local frame as rows, shape (3, 3). [1]"""
        assert self.look_zenith is not None  # filled in when the camera was made
        return camera_axes(self.look_zenith, self.look_azimuth, self.roll)

    def directions(
        self, rows: slice | None = None, *, offset: tuple[float, float] = (0.0, 0.0)
    ) -> NDArray[np.float64]:
        """Viewing directions of rows of pixels.

        Parameters
        ----------
        rows : slice, optional
            Rendered rows from the top; by default all.
        offset : (float, float)
            Offset to the right of and below each pixel's centre, for several samples per pixel.
            [pixel]

        Returns
        -------
        array, shape (rows, columns, 3)
            Unit vectors in the observer's local frame (x to the sun's side, y left of it, z to
            the zenith); zero outside the projection, as outside a fisheye circle. [1]
        """
        chosen = np.arange(self.rows, dtype=np.float64)[rows if rows is not None else slice(None)]
        x = np.arange(self.columns, dtype=np.float64) + (self.left + 0.5 + offset[0])
        y = chosen + (self.top + 0.5 + offset[1])
        rays = projected_rays(
            self.projection, x, y, self.width, self.height, self._field_of_view_radians
        )
        return np.asarray(rays @ self.axes)
