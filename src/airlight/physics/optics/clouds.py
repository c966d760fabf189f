r"""Flat cloud layer above the ground: intersection with lines of sight, and light of both together.

A cover c is a fraction of clouds of the layer's optical depth (``droplet_layer``); the rest is
clear. Of a beam from the direction μ the layer lets through

.. math:: T_0 = 1 - c + c e^{-\tau'/\mu}, \quad T = c (1 - A(\mu) - e^{-\tau'/\mu})

as direct and as diffuse light; light that comes diffusely from the ground returns to it with the
layer's spherical albedo s. With the reflectance factors f of the ground under direct, and g under
diffuse light, and a for diffuse light that goes on diffusely, layer and ground together have

.. math::
    R &= c_v R_l + T_0^s T_0^v f + T^s T_0^v g + (T_0^s + T^s)\, a\, (T^v + b\, u) \\
    R' &= c_v A(\mu_v) + (1 - c_s s) (T_0^v g + a T^v + a b u), \quad
    u = T_0^v g + T^v a, \quad b = \frac{c_s s}{1 - a c_s s}

for the star's light and for a uniform sky: the geometric series of light between ground and cloud.
The star's way and the line of sight meet covers of their own, c_s and c_v.
"""

from __future__ import annotations

from math import acos, exp, pi, sqrt
from typing import Final, NamedTuple

from airlight.kernel import inlined, kernel
from airlight.kernel.lanes import lane_view
from airlight.physics.optics.droplet_layer import LEAST_COSINE

#: Altitudes below which clouds that are only seen from space are absent, and above which they are
#: complete: no such cloud is between observer and ground, and a descent has no sudden change. [m]
ABSENT_BELOW: Final = 60e3
COMPLETE_ABOVE: Final = 100e3


#: Cosine at which ground and water have their reflectance for diffuse light that goes on diffusely:
#: the mean of a uniform radiance, 2 ∫ μ² dμ. [1]
DIFFUSE_COSINE: Final = 2.0 / 3.0


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


class LayerReflectance(NamedTuple):
    """Reflectance factor of a cloud layer, at all wavelengths.

    Attributes
    ----------
    single : float
        That of single scattering over the phase function. [sr]
    angle : float
        Scattering angle over π. [1]
    multiple : float
        That of multiple scattering. [1]
    """

    single: float
    angle: float
    multiple: float


class LayerPassage(NamedTuple):
    """Light that passes a cloud layer, down from the star and up along a line of sight.

    Attributes
    ----------
    seen, seen_albedo : float
        Cover c_v on the line of sight, and the same times the plane albedo. [1]
    star_direct, star_diffuse : float
        Direct and diffuse transmittance of the star's light, through the cover c_s. [1]
    view_direct, view_diffuse : float
        Of the line of sight. [1]
    back : float
        Spherical albedo of the layer above the ground, c_s s. [1]
    """

    seen: float
    seen_albedo: float
    star_direct: float
    star_diffuse: float
    view_direct: float
    view_diffuse: float
    back: float


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
def node_before(place, count):
    """Node before a place between the ends 0 and 1 of even nodes, and the fraction of a step."""
    step = min(max(place, 0.0), 1.0) * (count - 1)
    node = min(int(step), count - 2)
    return node, step - node


@inlined
def plane_albedo(cosine, layer):
    """Plane albedo of a ``DropletLayer``: what it reflects of a beam. [1]

    Parameters
    ----------
    cosine : float
        Cosine of the zenith angle of the beam. [1]
    """
    plane = layer.layer_plane
    node, part = node_before(sqrt(max(cosine, 0.0)), plane.shape[0])
    return plane[node] + part * (plane[node + 1] - plane[node])


@inlined
def multiple_reflectance(mu_s, mu_r, nu, layer):
    """Reflectance factor of multiple scattering by a ``DropletLayer``. [1]

    Parameters
    ----------
    mu_s, mu_r, nu : float
        Cosines as in ``reflection.direct_reflectance``. [1]
    """
    table = layer.layer_multiple
    level = sqrt(max((1.0 - mu_s * mu_s) * (1.0 - mu_r * mu_r), 1e-12))
    turn = sqrt(max(0.5 - 0.5 * (nu + mu_s * mu_r) / level, 0.0))
    i, e = node_before(sqrt(max(mu_s, 0.0)), table.shape[0])
    j, f = node_before(sqrt(max(mu_r, 0.0)), table.shape[1])
    k, g = node_before(turn, table.shape[2])
    total = 0.0
    for a in range(2):
        x = e if a == 1 else 1.0 - e
        for b in range(2):
            y = f if b == 1 else 1.0 - f
            low, high = table[i + a, j + b, k], table[i + a, j + b, k + 1]
            total += x * y * (low + g * (high - low))
    return total


@inlined
def layer_reflectance(mu_s, mu_r, nu, layer):
    """``LayerReflectance`` of full cover.

    Parameters
    ----------
    mu_s, mu_r, nu : float
        Cosines as in ``reflection.direct_reflectance``. [1]
    layer : DropletLayer
        Layer.
    """
    down, up = max(mu_s, LEAST_COSINE), max(mu_r, LEAST_COSINE)
    once = (1.0 - exp(-layer.layer_depth * (1.0 / down + 1.0 / up))) / (down + up)
    return LayerReflectance(
        pi * layer.layer_gain * once,
        acos(min(max(nu, -1.0), 1.0)) / pi,
        multiple_reflectance(down, up, nu, layer),
    )


@inlined
def layer_passage(mu_s, mu_r, seen, shaded, layer):
    """``LayerPassage`` of a line of sight.

    Parameters
    ----------
    mu_s, mu_r : float
        Cosines as in ``reflection.direct_reflectance``. [1]
    seen, shaded : float
        Cover c_v on the line of sight, and c_s on the star's way. [1]
    layer : DropletLayer
        Layer of full cover.
    """
    down, up = max(mu_s, LEAST_COSINE), max(mu_r, LEAST_COSINE)
    depth = layer.layer_depth
    star, view = plane_albedo(down, layer), plane_albedo(up, layer)
    star_clear, view_clear = exp(-depth / down), exp(-depth / up)
    return LayerPassage(
        seen,
        seen * view,
        1.0 - shaded + shaded * star_clear,
        shaded * max(1.0 - star - star_clear, 0.0),
        1.0 - seen + seen * view_clear,
        seen * max(1.0 - view - view_clear, 0.0),
        shaded * layer.layer_albedo,
    )


@inlined
def reflected_lanes(light, layer, at):
    """Reflectance factor R_l of the layer, at the lanes from ``at`` on. [1]

    Parameters
    ----------
    light, layer : LayerReflectance, DropletLayer
        Reflectance and layer.
    """
    phase = lane_view(layer.layer_phase, at)
    node, part = node_before(light.angle, layer.layer_phase.shape[0])
    low = phase[node]
    once = low + (phase[node + 1] - low) * part
    return once * light.single + light.multiple


@inlined
def reflected_at(light, layer, l):
    """``reflected_lanes`` at wavelength l, in double precision. [1]"""
    node, part = node_before(light.angle, layer.layer_phase.shape[0])
    low, high = layer.layer_phase[node, l], layer.layer_phase[node + 1, l]
    return (low + part * (high - low)) * light.single + light.multiple


@inlined
def mean_reflected(light, layer):
    """Reflectance factor of full cover whose light leaves evenly in azimuth: A(μ_s) A(μ_v)/s. [1]

    It has the layer's plane and spherical albedo, and is reciprocal.

    Parameters
    ----------
    light, layer : LayerPassage, DropletLayer
        Light that passes full cover, and the layer.
    """
    star = 1.0 - light.star_direct - light.star_diffuse
    return star * light.seen_albedo / max(layer.layer_albedo, 1e-9)


@inlined
def under_star(light, reflected, direct, diffuse, spread):
    """Reflectance factor of layer and ground in the star's light, R of the module. [1]

    Parameters
    ----------
    light : LayerPassage
        Light that passes the layer.
    reflected : lanes or float
        Reflectance factor R_l. [1]
    direct, diffuse, spread : lanes or float
        Reflectance factors f, g and a of the ground. [1]
    """
    up = diffuse * light.view_direct + spread * light.view_diffuse
    again = up * light.back / (1.0 - spread * light.back)
    total = reflected * light.seen + direct * (light.star_direct * light.view_direct)
    total = total + diffuse * (light.star_diffuse * light.view_direct)
    return total + spread * (again + light.view_diffuse) * (light.star_direct + light.star_diffuse)


@inlined
def under_sky(light, diffuse, spread):
    """Reflectance factor of layer and ground under a uniform sky, R' of the module. [1]

    Parameters
    ----------
    light, diffuse, spread :
        Arguments of ``under_star``.
    """
    up = diffuse * light.view_direct + spread * light.view_diffuse
    again = spread * up * light.back / (1.0 - spread * light.back)
    return (up + again) * (1.0 - light.back) + light.seen_albedo
