"""Reflectance of the surface of an airless body."""

from __future__ import annotations

from math import pi

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.sun_disc import mean_cosine
from airlight.kernel import vectorized
from airlight.physics.optics.moon_phase import moon_surface_factor
from airlight.scene.system.body import Body

FloatArray = NDArray[np.float64]


def surface_factor(
    body: Body,
    normal: FloatArray,
    to_light: FloatArray,
    to_eye: FloatArray,
    angular_radius: FloatArray,
) -> FloatArray:
    """Reflected radiance over irradiance and albedo. [sr⁻¹]

    Parameters
    ----------
    body : Body
        Airless body.
    normal, to_light, to_eye : array, shape (n, 3)
        Unit vectors: of the surface, towards the light, and towards the observer.
    angular_radius : array, shape (n,)
        Angular radius of the light; its disc sets gradually. [rad]

    Returns
    -------
    array, shape (n,)
        Factor, to be multiplied by ``Body.albedo``.

    Notes
    -----
    The Lommel-Seeliger law, L = E (2 p / π) μ₀/(μ₀ + μ), with geometric albedo p, makes the full
    disc uniform.
    """
    sine = np.einsum("nk,nk->n", normal, to_light)
    # For the light's disc; that of a limb is half below the horizon.
    lit = np.asarray(vectorized(mean_cosine)(np.arcsin(np.clip(sine, -1.0, 1.0)), sine,
                                             angular_radius))  # fmt: skip
    if body.reflection == "lambert":
        return lit / pi
    leaving = np.maximum(np.einsum("nk,nk->n", normal, to_eye), 0.0)
    shade = np.divide(lit, lit + leaving, out=np.zeros_like(lit), where=lit > 0.0)
    if body.reflection == "moon":
        phase = np.einsum("nk,nk->n", to_light, to_eye)
        shade = shade * moon_surface_factor(np.degrees(np.arccos(np.clip(phase, -1.0, 1.0))))
    return np.asarray(2.0 / pi * shade)
