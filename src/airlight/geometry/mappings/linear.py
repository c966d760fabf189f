"""Linear mappings of altitude and cosines to [0, 1].

Source: Atmosphere Plus notes, second print, section 3.1.2.
"""

from __future__ import annotations

from airlight.kernel import kernel


@kernel
def altitude_coordinate(altitude, thickness):
    """Altitude to [0, 1]: 0 on the ground, 1 at the top of the shell. [1]"""
    return altitude / thickness


@kernel
def altitude_from_coordinate(u, thickness):
    """Inverse of ``altitude_coordinate``. [m]"""
    return u * thickness


@kernel
def cosine_coordinate(cosine):
    """Cosine of a zenith angle to [0, 1]: 0 straight down, 1 straight up. [1]"""
    return 0.5 * (cosine + 1.0)


@kernel
def cosine_from_coordinate(v):
    """Inverse of ``cosine_coordinate``. [1]"""
    return 2.0 * v - 1.0
