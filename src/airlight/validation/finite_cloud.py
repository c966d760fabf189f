"""A finite cloud over a Lambertian plane without air, with radiances of Mitsuba 3."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_field import CloudField
from airlight.validation.reference_files import packaged_table

FloatArray = NDArray[np.float64]

#: File of this package with Mitsuba's radiances, made by ``builders/mitsuba_cloud.py``.
FILE: Final = "data/finite-cloud.csv"
#: Albedo of the plane, at altitude 0. [1]
GROUND_ALBEDO: Final = 0.3
#: Asymmetry of the Henyey-Greenstein phase function, and single-scattering albedo. [1]
ASYMMETRY, ALBEDO = 0.85, 1.0
#: Unit vector to the sun, 50° from the zenith in the azimuth of 30° north of east. [1]
SUN: Final = tuple(
    float(x)
    for x in (
        np.sin(np.radians(50.0)) * np.cos(np.radians(30.0)),
        np.sin(np.radians(50.0)) * np.sin(np.radians(30.0)),
        np.cos(np.radians(50.0)),
    )
)
#: Pixels per side of a view, and half its width. [m]
PIXELS: Final = 6
HALF_WIDTH: Final = 600.0
#: Base of the cloud, and width of its cells. [m]
_BASE, _CELL = 600.0, 100.0
#: Cells to the east, to the north and upwards.
_CELLS: Final = (12, 12, 6)
#: Largest extinction. [m⁻¹]
_DENSEST: Final = 0.06


class CloudView(NamedTuple):
    """Orthographic view of the centre of the cloud.

    Attributes
    ----------
    name : str
        Name.
    along : tuple of three float
        Direction in which the observer looks: east, north, up. [1]
    """

    name: str
    along: tuple[float, float, float]

    @property
    def axes(self) -> tuple[FloatArray, FloatArray]:
        """Unit vectors of columns and rows: horizontal, and perpendicular to it and to the view."""
        along = np.array(self.along)
        across = np.cross(along, [0.0, 0.0, 1.0])
        across = across / np.linalg.norm(across) if np.any(across) else np.array([1.0, 0.0, 0.0])
        return across, np.cross(across, along)

    def points(self, samples: int) -> FloatArray:
        """Points on the plane through the centre, (PIXELS, PIXELS, samples², 3), row by row. [m]

        Parameters
        ----------
        samples : int
            Points per side of a pixel.
        """
        places = HALF_WIDTH * ((np.arange(PIXELS * samples) + 0.5) * 2 / (PIXELS * samples) - 1)
        across, upwards = self.axes
        points = (
            np.array([0.0, 0.0, centre()])
            + places[:, None, None] * upwards
            + places[None, :, None] * across
        )
        split = points.reshape(PIXELS, samples, PIXELS, samples, 3).swapaxes(1, 2)
        return split.reshape(PIXELS, PIXELS, samples**2, 3)


_LOW: Final = float(np.sqrt(0.75))
#: Views from above, from both sides at 60°, and from below.
VIEWS: Final = (
    CloudView("nadir", (0.0, 0.0, -1.0)),
    CloudView("towards the sun", (_LOW, 0.0, -0.5)),
    CloudView("from the sun", (-_LOW, 0.0, -0.5)),
    CloudView("zenith", (0.0, 0.0, 1.0)),
)


def centre() -> float:
    """Altitude of the centre of the cloud. [m]"""
    return _BASE + 0.5 * _CELLS[2] * _CELL


def finite_cloud() -> CloudField:
    """Cloud of cells around an ellipsoid, denser upwards, of optical depth up to 20."""
    x, y, z = np.meshgrid(
        *(2.0 * (np.arange(count) + 0.5) / count - 1.0 for count in _CELLS), indexing="ij"
    )
    lumpy = 1.0 + 0.5 * np.sin(5.0 * x + 1.0) * np.sin(4.0 * y + 2.0)
    body = np.maximum(1.0 - x**2 - y**2 - 0.7 * z**2, 0.0)
    extinction = _DENSEST * np.minimum(lumpy * body * (0.6 + 0.4 * z), 1.0)
    return CloudField(
        extinction=np.maximum(extinction, 0.0).astype(np.float32),
        spacing=(_CELL, _CELL, _CELL),
        base=_BASE,
        interpolated=False,
    )


def reference() -> tuple[FloatArray, FloatArray]:
    """Mitsuba's radiances and standard errors per irradiance of the sun. [sr⁻¹]

    Returns
    -------
    radiance, error : array, shape (views, PIXELS, PIXELS)
        Means over pixels, in the order of ``CloudView.points``.
    """
    table = packaged_table(FILE)
    radiance, error = table[:, 3:5].T.reshape(2, len(VIEWS), PIXELS, PIXELS)
    return radiance, error
