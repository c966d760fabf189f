"""Light of clouds under the sun of their own place, over that under the sun of the box."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import sqrt
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_field import CloudField
from airlight.geometry.vectors import dot
from airlight.kernel import inlined
from airlight.kernel.lanes import lane_view
from airlight.solver.boxes.solution import BoxSolution

FloatArray = NDArray[np.float64]

#: Zenith angles of the sun at which small boxes are solved. [deg]
ZENITHS: Final = (0.0, 30.0, 50.0, 65.0, 75.0, 82.0, 86.0, 89.0, 92.0, 95.0)
#: Largest number of columns along x and y of such a box.
_COLUMNS: Final = 64


class LocalSun(NamedTuple):
    """Light of clouds by the height of the sun.

    Attributes
    ----------
    sines : array, shape (n,)
        Sines of the sun's height, ascending; one if they do not matter. [1]
    light : array, shape (n, levels, w)
        Mean higher orders of levels over the irradiance of the horizontal top. [sr⁻¹]
    depth : array, shape (n,)
        Optical depth towards the sun whose transmittance is the mean of the cloud's. [1]
    """

    sines: FloatArray
    light: FloatArray
    depth: FloatArray

    def light_over(self, sines: FloatArray, own: float) -> FloatArray:
        """Light of sines over that of one, shape (m, levels, w). [1]"""
        found = np.apply_along_axis(
            lambda one: np.interp(sines, self.sines, one) / np.interp(own, self.sines, one),
            0,
            np.maximum(self.light, 1e-30),
        )
        return np.asarray(found)

    def depth_over(self, sines: FloatArray, own: float) -> FloatArray:
        """Depth of sines over that of one, shape (m,). [1]"""
        known = np.log(np.maximum(self.depth, 1e-6))
        difference = np.interp(sines, self.sines, known) - np.interp(own, self.sines, known)
        return np.asarray(np.exp(difference))


def same_everywhere(levels: int, wavelengths: int) -> LocalSun:
    """Light that only follows the irradiance."""
    return LocalSun(np.zeros(1), np.ones((1, levels, wavelengths)), np.ones(1))


def local_suns(
    coarse: CloudField,
    towards: tuple[float, float, float],
    solved: Callable[[CloudField, tuple[float, float, float]], tuple[BoxSolution, FloatArray]],
) -> LocalSun:
    """Light of small boxes of joined cells under suns at ``ZENITHS``.

    Parameters
    ----------
    coarse : CloudField
        Cells of the box.
    towards : tuple of three float
        Unit vector to the sun, of which the azimuth counts. [1]
    solved : callable
        Light of a field under a sun, and irradiance of the horizontal top at its wavelengths.
    """
    field = _joined(coarse)
    across = max(float(np.hypot(towards[0], towards[1])), 1e-9)
    azimuth = (towards[0] / across, towards[1] / across) if across > 1e-6 else (1.0, 0.0)
    amount = field.extinction / max(float(field.extinction.sum()), 1e-30)
    each = np.maximum(amount.sum(axis=(0, 1)), 1e-30)
    sines, light, depth = [], [], []
    for zenith in reversed(ZENITHS):
        up, out = float(np.cos(np.radians(zenith))), float(np.sin(np.radians(zenith)))
        box, irradiance = solved(field, (out * azimuth[0], out * azimuth[1], up))
        mean = np.einsum("xyk,xykw->kw", amount, box.moments[:, :, box.below :, 0])
        sines.append(up)
        light.append(mean / each[:, None] / irradiance)
        seen = float((amount * np.exp(-box.depth[..., box.below :].astype(np.float64))).sum())
        depth.append(-np.log(max(seen, 1e-30)))
    return LocalSun(np.array(sines), np.array(light), np.array(depth))


def _joined(field: CloudField) -> CloudField:
    """Field of at most ``_COLUMNS`` columns along each axis, if they can be joined."""
    shape, spacing = field.extinction.shape, field.spacing
    parts = [1, 1]
    for axis in range(2):
        while shape[axis] // parts[axis] > _COLUMNS and shape[axis] % (2 * parts[axis]) == 0:
            parts[axis] *= 2
    x, y = parts
    cells = field.extinction.reshape(shape[0] // x, x, shape[1] // y, y, shape[2])
    return replace(
        field,
        extinction=cells.mean(axis=(1, 3), dtype=np.float32),
        spacing=(spacing[0] * x, spacing[1] * y, spacing[2]),
    )


@inlined
def sun_place(point, layer):
    """Place of the sun's height at a point among the angles of a layer, and the share beyond it.

    Parameters
    ----------
    point : Vec3
        From the centre, in the observer's frame. [m]
    layer : LayerTables
        Clouds.
    """
    height = dot(point, layer.sun) / sqrt(dot(point, point))
    angle = (height - layer.beam_low) / (layer.beam_high - layer.beam_low)
    angle = min(max(angle, 0.0), 1.0) * (layer.slant.shape[0] - 1)
    low = min(int(angle), layer.slant.shape[0] - 2)
    return low, angle - low


@inlined
def local_slant(point, layer):
    """Optical depth towards the sun of a point over that towards the sun of the box. [1]"""
    low, share = sun_place(point, layer)
    return (1.0 - share) * layer.slant[low] + share * layer.slant[low + 1]


@inlined
def local_light(height, low, share, layer):
    """Light of a place over that under the sun of the box, at solved wavelengths, twice. [1]

    Parameters
    ----------
    height : float
        Height in the box over its depth. [1]
    low, share : int, float
        Result of ``sun_place``.
    layer : LayerTables
        Clouds.
    """
    light = lane_view(layer.local)
    levels = layer.local.shape[1]
    place = min(max(height * levels - 0.5, 0.0), levels - 1.0)
    k = int(place)
    g, e = np.float32(place - k), np.float32(share)
    above = min(k + 1, levels - 1)
    f, h = np.float32(1.0) - g, np.float32(1.0) - e
    return h * (f * light[low, k] + g * light[low, above]) + e * (
        f * light[low + 1, k] + g * light[low + 1, above]
    )
