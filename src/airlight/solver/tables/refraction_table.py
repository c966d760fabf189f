"""Refraction table: apparent zenith cosine of a star, for ``geometry.refraction``."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.geometry.mappings.transmittance import radius_from_coordinate
from airlight.geometry.shell import distance_to_top, horizon_cosine
from airlight.kernel import vectorized
from airlight.physics.cubic_curves import cubic_curve, spline_slopes
from airlight.physics.optics.density_profile import DensitySegments
from airlight.solver.tables.columns import columns

FloatArray = NDArray[np.float64]

#: Rows in radius, and columns in true elevation above the horizon's true direction.
SHAPE: Final = (97, 129)
#: Directions at which the refraction angle is integrated, for each radius.
_DIRECTIONS: Final = 257
#: Empty table, without refraction.
NONE: Final[FloatArray] = np.zeros((0, 0, 2))


def refraction_angles(
    x: FloatArray,
    mu: FloatArray,
    bottom: float,
    top: float,
    density: DensitySegments,
    refraction_strength: float,
) -> FloatArray:
    """Refraction angle of rays from a point to space.

    Parameters
    ----------
    x, mu : array, shapes that broadcast to (...)
        Optical radius of the point [m] and cosine of the ray's zenith angle there [1]; the ray
        misses the ground.
    bottom, top : float
        Optical radii of the ground and of the top. [m]
    density : DensitySegments
        Profiles over optical altitude, that of the refraction column last.
    refraction_strength : float
        See ``RefractingShell``. [m⁻²]

    Returns
    -------
    array, shape (...)
        Angle towards the ground. [rad]
    """
    x, mu = (np.array(one) for one in np.broadcast_arrays(x, mu))
    length = vectorized(distance_to_top)(x, mu, top)
    last = DensitySegments(density.edges[-1:], density.coefficients[-1:])
    column = columns(x, mu, length, bottom, last)[..., 0]
    return np.asarray(
        refraction_strength * x * np.sqrt(np.maximum((1.0 - mu) * (1.0 + mu), 0.0)) * column
    )


def refraction_table(
    bottom: float, top: float, density: DensitySegments, refraction_strength: float
) -> FloatArray:
    """Table of a star's apparent less true zenith cosine, and of its disc's flattening.

    Parameters
    ----------
    bottom, top, density, refraction_strength :
        Arguments of ``refraction_angles``.

    Returns
    -------
    array, shape (rows, columns, 2)
        Apparent less true cosine, and d apparent/d true. Rows are even in the distance to the
        horizon, from the ground to the top; columns are even in the square root of the true cosine
        less that of the horizon's true direction, up to the zenith. [1]
    """
    x = vectorized(radius_from_coordinate)(np.linspace(0.0, 1.0, SHAPE[0]), bottom, top)
    # Slightly above the horizon, so that rounding does not direct the ray into the ground.
    steps = np.maximum(np.linspace(0.0, 1.0, _DIRECTIONS) ** 2, 1e-12)
    lowest = vectorized(horizon_cosine)(x, bottom)[:, None]
    seen = lowest + (1.0 - lowest) * steps
    angle = refraction_angles(x[:, None], seen, bottom, top, density, refraction_strength)
    true = np.cos(np.arccos(seen) + angle)
    sunken = np.diff(true, axis=1).min(axis=1) <= 0.0
    if sunken.any():
        raise ParameterError(
            "refraction",
            "bouguer",
            "'none' for this atmosphere: a star would have several apparent "
            f"elevations from {x[sunken.argmax()] - bottom:.3g} m",
        )
    return np.stack([_inverted(*row) for row in zip(true, seen, strict=True)])


def _inverted(true: FloatArray, seen: FloatArray) -> FloatArray:
    """Apparent less true cosines, and d apparent/d true, at the table's columns; (columns, 2)."""
    share = np.sqrt(np.maximum(true - true[0], 0.0) / (1.0 - true[0]))
    # Smooth in the cosine, which is even in its square root.
    y = seen - true
    m = spline_slopes(share, y, 0.0)
    at = np.linspace(0.0, 1.0, SHAPE[1])
    k = np.clip(np.searchsorted(share, at, side="right") - 1, 0, share.size - 2)
    h = share[k + 1] - share[k]
    t = (at - share[k]) / h
    rise = 6.0 * t * (1.0 - t) * (y[k + 1] - y[k]) / h
    rise += (3.0 * t - 1.0) * (t - 1.0) * m[k] + t * (3.0 * t - 2.0) * m[k + 1]
    curvature = (6.0 * (y[1] - y[0]) / share[1] - 2.0 * m[1]) / share[1]
    # d(seen - true)/d true = d raised/d share / (d true/d share), d true/d share = 2 share (1 - t0)
    slope = np.empty_like(at)
    slope[1:] = rise[1:] / (2.0 * at[1:] * (1.0 - true[0]))
    slope[0] = curvature / (2.0 * (1.0 - true[0]))
    raised = cubic_curve(share, y, m, at)
    return np.stack([raised, np.maximum(1.0 + slope, 0.0)], axis=-1)
