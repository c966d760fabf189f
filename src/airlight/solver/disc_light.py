"""Disc-integrated reflectance of a planet: its phase curve, for planetshine."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.geometry.quadrature import gauss_legendre
from airlight.solver.lines_of_sight import enter_shell
from airlight.solver.solution import Solution

FloatArray = NDArray[np.float64]

#: Points in impact parameter over the ground's disc and over the atmospheric limb; of half a turn.
_DISC: Final = 40
_RIM: Final = 16
_TURN: Final = 24
#: Distance of the observer over the planet's radius: far, so that lines of sight are parallel.
_AWAY: Final = 1e5


def disc_light(solution: Solution, phase: float) -> FloatArray:
    r"""Geometric albedo times phase function of a planet with its atmosphere.

    A planet of ground radius R under the irradiance E gives at the distance d the irradiance
    E p Φ (R/d)²:

    .. math:: p \, \Phi(\alpha) = \frac{1}{R^2} \iint \frac{L}{E} \, b \, db \, d\varphi

    Parameters
    ----------
    phase : float
        Phase angle between star and observer, seen from the planet, 0 to 180. [deg]

    Returns
    -------
    array, shape (nl,)
        p Φ. [1]
    """
    if not 0.0 <= phase <= 180.0:
        raise ParameterError("phase", phase, "0 to 180 deg")
    medium = solution.medium
    bottom, top = medium.bottom_radius, medium.top_radius
    disc, rim, turn = gauss_legendre(_DISC), gauss_legendre(_RIM), gauss_legendre(_TURN)
    # b = R sqrt(1 - c²): b db = R² c dc, and the limb is not crowded by the root.
    impact = np.concatenate(
        [
            bottom * np.sqrt((1.0 - disc.nodes) * (1.0 + disc.nodes)),
            bottom + (top - bottom) * rim.nodes**2,
        ]
    )
    weight = np.concatenate(
        [
            bottom**2 * disc.nodes * disc.weights,
            impact[_DISC:] * 2.0 * rim.nodes * rim.weights * (top - bottom),
        ]
    )
    far = _AWAY * bottom
    sine = np.repeat(impact / far, _TURN)
    azimuth = np.tile(np.pi * turn.nodes, impact.size)
    mu = -np.sqrt((1.0 - sine) * (1.0 + sine))
    angle = np.radians(phase)
    mu_s = np.full(sine.size, np.cos(angle))
    nu = mu * mu_s + sine * np.sin(angle) * np.cos(azimuth)
    lines = enter_shell(np.full(sine.size, far), mu, sine, mu_s, nu, bottom, top)
    radiance = solution.relative_radiance(lines)
    solid_angles = np.repeat(weight, _TURN) * np.tile(2.0 * np.pi * turn.weights, impact.size)
    return np.asarray(solid_angles @ radiance) / bottom**2
