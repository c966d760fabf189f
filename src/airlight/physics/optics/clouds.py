"""Thin cloud layer above the ground: intersection with lines of sight, and effective reflectance.

Clouds are Lambertian. On the line of sight, the cover hides its fraction of the ground; on the
direct beam, it shadows its fraction, and transmits as diffuse light what it does not reflect.
"""

from __future__ import annotations

from math import sqrt
from typing import Final, NamedTuple

from airlight.kernel import kernel

#: Altitudes below which clouds that are only seen from space are absent, and above which they are
#: complete: no such cloud is between observer and ground, and a descent has no sudden change. [m]
ABSENT_BELOW: Final = 60e3
COMPLETE_ABOVE: Final = 100e3


class GroundFactors(NamedTuple):
    """Reflectance factors of the ground: radiance over that of a white Lambert ground.

    Attributes
    ----------
    star_diffuse, star_specular : float
        Of direct irradiance: factor to be multiplied by the albedo, and the rest. [1]
    sky_diffuse, sky_specular : float
        Of diffuse irradiance. [1]
    mirrored : float
        Factor of the mirrored sky. [1]
    """

    star_diffuse: float
    star_specular: float
    sky_diffuse: float
    sky_specular: float
    mirrored: float


@kernel
def clouds_shown(altitude, detailed, from_space):
    """Factor of the cloud cover in a picture. [1]

    Parameters
    ----------
    altitude : float
        Altitude of the observer. [m]
    detailed : bool
        Whether the ground has detail.
    from_space : bool
        Whether clouds are only seen from space: decoration of detailed ground.

    Examples
    --------
    >>> [round(clouds_shown(altitude, True, True), 6) for altitude in (2.0, 8e4, 4e5)]
    [0.0, 0.5, 1.0]
    >>> clouds_shown(2.0, False, False)  # clouds that are part of the planet
    1.0
    """
    if not from_space:
        return 1.0
    if not detailed:
        return 0.0
    part = (altitude - ABSENT_BELOW) / (COMPLETE_ABOVE - ABSENT_BELOW)
    part = min(max(part, 0.0), 1.0)
    return part * part * (3.0 - 2.0 * part)


@kernel
def layer_distance(cosine, bottom, altitude):
    r"""Distance from the ground to the layer along a straight line. [m]

    .. math:: s = \frac{h (2R + h)}{\sqrt{R^2\mu^2 + h (2R + h)} + R\mu}

    which is h/μ for a steep line and :math:`\sqrt{h (2R + h)}` for a horizontal one.

    Parameters
    ----------
    cosine : float
        Cosine μ of the line's zenith angle at the ground; 0 for a line from below. [1]
    bottom, altitude : float
        Radius R of the ground, and altitude h of the layer. [m]

    Examples
    --------
    >>> layer_distance(1.0, 6.36e6, 4e3)
    4000.0
    >>> round(layer_distance(0.0, 6.36e6, 4e3))  # of 4 km the horizon is 226 km away
    225601
    """
    level = bottom * max(cosine, 0.0)
    power = altitude * (2.0 * bottom + altitude)
    return power / max(sqrt(level * level + power) + level, 1e-6)


@kernel
def under_clouds(seen, shaded, albedo, ground):
    r"""Reflectance of the ground below clouds, from that of the same ground in clear sky.

    .. math:: L = c_v A (E_\star + E_s) + (1 - c_v) \left[ (1 - c_s) f_\star E_\star
              + f_s \left(E_s + c_s (1 - A) E_\star\right) \right]

    with the reflectance factors f of the ground under direct and under diffuse light. Multiple
    reflection between ground and cloud is neglected, as is the shadow of clouds in sky light:
    ground of albedo a below a mean cover c reflects c (1 - c) A a less than the solver's mean
    ground, at most 0.02 for the Earth's.

    Parameters
    ----------
    seen, shaded : float
        Cloud cover c_v on the line of sight, and c_s on the direct beam. [1]
    albedo : float
        Albedo A of the clouds. [1]
    ground : GroundFactors
        Factors of the ground in clear sky; the result has those with clouds. [1]

    Examples
    --------
    >>> white = GroundFactors(1.0, 0.0, 1.0, 0.0, 0.0)
    >>> tuple(under_clouds(1.0, 0.3, 0.6, white))  # nothing but the cloud
    (0.0, 0.6, 0.0, 0.6, 0.0)
    >>> tuple(under_clouds(0.0, 1.0, 0.75, white))  # in full shade
    (0.25, 0.0, 1.0, 0.0, 0.0)
    """
    clear, lit, diffused = 1.0 - seen, 1.0 - shaded, shaded * (1.0 - albedo)
    cloud = seen * albedo
    specular = lit * ground.star_specular + diffused * (ground.sky_specular + ground.mirrored)
    return GroundFactors(
        clear * (lit * ground.star_diffuse + diffused * ground.sky_diffuse),
        clear * specular + cloud,
        clear * ground.sky_diffuse,
        clear * ground.sky_specular + cloud,
        clear * ground.mirrored,
    )
