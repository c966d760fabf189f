"""Delta-M scaled coefficients of the cloud and of the air in a box."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_optics import CloudOptics
from airlight.errors import ParameterError
from airlight.solver.boxes.light import BoxAir

FloatArray = NDArray[np.float64]


class BoxOptics(NamedTuple):
    """Scaled coefficients; those of the cloud are per extinction at 550 nm.

    Attributes
    ----------
    cloud : array, shape (w,)
        Extinction κ(1 - ϖf) of the cloud. [1]
    cloud_source : array, shape (degree + 1, w)
        Scattering κϖ(1 - f) times scaled phase moments (χ - f)/(1 - f). [1]
    cloud_single : array, shape (w,)
        Unscaled scattering κϖ. [1]
    air, air_source, air_single : array, shapes (levels, w), (levels, degree + 1, w), (levels, w)
        The same of the air. [m⁻¹]
    """

    cloud: FloatArray
    cloud_source: FloatArray
    cloud_single: FloatArray
    air: FloatArray
    air_source: FloatArray
    air_single: FloatArray


def scaled_optics(
    optics: CloudOptics, air: BoxAir | None, edges: FloatArray, degree: int
) -> BoxOptics:
    """Scaled coefficients by Wiscombe (1977), J. Atmos. Sci. 34, 1408 (delta-M).

    Parameters
    ----------
    edges : array, shape (levels + 1,)
        Altitudes of the edges of the levels. [m]
    degree : int
        Highest degree of the source; the truncated fraction f is the moment of the next one.
    """
    count = np.size(optics.wavelengths)
    moments = np.asarray(optics.phase.moments(optics.wavelengths, degree + 1), np.float64)
    moments = moments / moments[:, :1]
    extinction, albedo = np.asarray(optics.extinction), np.asarray(optics.albedo)
    cloud, source = _scaled(extinction, albedo, moments)
    levels = edges.size - 1
    if air is None:
        nothing = np.zeros((levels, count))
        none = np.zeros((levels, degree + 1, count))
        return BoxOptics(cloud, source.T, extinction * albedo, nothing, none, nothing)
    if air.extinction.shape[1] != count:
        raise ParameterError("air.extinction", air.extinction.shape, f"{count} wavelengths")
    known = np.zeros((*air.extinction.shape, degree + 2))
    given = air.moments[..., : degree + 2]
    known[..., : given.shape[-1]] = given
    own, own_source = _scaled(air.extinction, air.albedo, known)
    shares = overlap(air.edges, edges)
    return BoxOptics(
        cloud,
        source.T,
        extinction * albedo,
        shares @ own,
        np.einsum("kn,nwl->klw", shares, own_source),
        shares @ (air.extinction * air.albedo),
    )


def _scaled(
    extinction: FloatArray, albedo: FloatArray, moments: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Scaled extinction (...), and source coefficients (..., degree + 1), of moments with f."""
    truncated = np.clip(moments[..., -1], 0.0, 1.0)
    kept = moments[..., :-1] - truncated[..., None]
    return extinction * (1.0 - albedo * truncated), (extinction * albedo)[..., None] * kept


def overlap(inner: FloatArray, outer: FloatArray) -> FloatArray:
    """Share of each outer layer that each inner layer fills, shape (outer, inner). [1]"""
    low = np.maximum(outer[:-1, None], inner[None, :-1])
    high = np.minimum(outer[1:, None], inner[None, 1:])
    return np.asarray(np.maximum(high - low, 0.0) / np.diff(outer)[:, None])
