"""Power mappings of altitude and cosines to [0, 1], finest at altitude or cosine 0.

A power of 1 is the linear mapping; 2 for altitude and 3 for cosines are the square root and the
cube roots of the first print. Source: Atmosphere Plus notes, second print, section 3.1.3.
"""

from __future__ import annotations

from airlight.kernel import kernel


@kernel
def altitude_coordinate(altitude, thickness, power):
    """Altitude to [0, 1]: 0 on the ground, 1 at the top of the shell. [1]

    .. math:: u = (h / H_a)^{1 / p}
    """
    return (max(altitude, 0.0) / thickness) ** (1.0 / power)


@kernel
def altitude_from_coordinate(u, thickness, power):
    """Inverse of ``altitude_coordinate``. [m]"""
    return max(u, 0.0) ** power * thickness


@kernel
def cosine_coordinate(cosine, power):
    """Cosine of a zenith angle to [0, 1], finest at the horizontal. [1]

    .. math:: v = (sign(c) |c|^{1 / p} + 1) / 2
    """
    root = abs(cosine) ** (1.0 / power)
    if cosine < 0.0:
        root = -root
    return 0.5 * (root + 1.0)


@kernel
def cosine_from_coordinate(v, power):
    """Inverse of ``cosine_coordinate``. [1]"""
    signed = 2.0 * v - 1.0
    cosine = abs(signed) ** power
    if signed < 0.0:
        return -cosine
    return cosine
