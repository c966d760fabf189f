"""Reflection by the ground: one object for every solver, sweep and march.

A law of reflection gives the radiance of the ground along a line, relative to that of a white
Lambert surface in the same light: the reflectance factor, π times the BRDF (Nicodemus et al. 1977,
NBS Monograph 160). It is evaluated twice, because the ground's light has two parts: the star's
comes from one direction, the sky's from all.

A new law is a file of its own with its two factors, a number in ``LAWS``, and a branch in
``star_factor`` and ``sky_factor``; its parameters other than the albedo are fields of
``Reflection``.
"""

from __future__ import annotations

from math import sqrt
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop, inlined
from airlight.kernel.lanes import load

FloatArray = NDArray[np.float64]

#: Laws of reflection by name, with the numbers that kernels use.
LAWS: Final = {"lambert": 0}


class Reflection(NamedTuple):
    """Ground as an argument of kernels.

    Attributes
    ----------
    law : int
        Number of the law in ``LAWS``.
    albedo : array, shape (w,), or float
        Fraction of diffuse light that is reflected; wavelengths in the lanes, or one of them. [1]
    """

    law: Any
    albedo: Any


@inlined
def star_factor(ground, at, mu_s, leaving, nu):
    """Reflectance factor of the ground in the light of a star. [1]

    Parameters
    ----------
    ground : Reflection
    at : int
        Index of the first lane.
    mu_s : float
        Cosine of the star's zenith angle at the ground. [1]
    leaving : float
        Cosine of the zenith angle of the reflected light, towards the observer. [1]
    nu : float
        Cosine between the line of sight, as it arrives at the ground, and the star. [1]

    Returns
    -------
    lanes, or a float where ``ground`` is of one wavelength
    """
    return load(ground.albedo, at)


@inlined
def sky_factor(ground, at, leaving):
    """Reflectance factor of the ground under a uniform sky. [1]

    By reciprocity this is also the total reflected fraction of a beam from the direction
    ``leaving``.

    Parameters
    ----------
    ground : Reflection
    at : int
        Index of the first lane.
    leaving : float
        Cosine of the zenith angle of the reflected light, towards the observer. [1]

    Returns
    -------
    lanes, or a float where ``ground`` is of one wavelength
    """
    return load(ground.albedo, at)


@inlined
def leaving_cosine(r, mu, bottom):
    """Cosine of the zenith angle at which light leaves the ground along a straight line. [1]

    Parameters
    ----------
    r, mu : float
        Radius at which the line is seen [m], and its zenith cosine there, towards the ground [1].
    bottom : float
        Radius of the ground. [m]
    """
    sine = r / bottom * sqrt(max((1.0 - mu) * (1.0 + mu), 0.0))
    return sqrt(max((1.0 - sine) * (1.0 + sine), 0.0))


@inlined
def at_wavelength(ground, l):
    """Return the ground at one of its wavelengths."""
    return Reflection(ground.law, ground.albedo[l])


@compiled_loop
def star_factors(ground, mu_s, leaving, nu, out):
    """Write ``star_factor`` of n lines at all wavelengths to ``out``, shape (n, nl). [1]"""
    for k in range(mu_s.size):
        for l in range(out.shape[1]):
            out[k, l] = star_factor(at_wavelength(ground, l), 0, mu_s[k], leaving[k], nu[k])
