"""Events of a history: sampled points, next-event estimation, and directions after scattering.

All functions are inlined into ``histories.trace_paths``; random numbers are drawn in the order
written here.
"""

from __future__ import annotations

from math import cos, exp, log1p, pi, sin, sqrt
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop, inlined
from airlight.physics.optics.density_profile import relative_density
from airlight.physics.optics.reflection import direct_reflectance_at
from airlight.solver.montecarlo.cloud_rays import FAR, cloud_collision
from airlight.solver.montecarlo.rays import (
    place_at_depth,
    point_at,
    trace_optical_depth,
    trace_part,
)
from airlight.solver.montecarlo.scattering_angles import lobe_value, random_cosine
from airlight.solver.montecarlo.streams import uniform
from airlight.solver.montecarlo.sun_biased_sampling import sample_sun_biased, sun_biased_density

#: Fraction of the weight after the first event below which roulette begins. [1]
KEEP: Final = 0.5
#: Event from which a history ends with a probability of at least 1/1000. Light at the ground of
#: Venus has been scattered thousands of times; shorter histories with weights that grow faster than
#: radiance falls would have a variance that no sample reveals.
LONG: Final = 10_000
#: Largest probability of survival from that event on. [1]
LONG_SURVIVAL: Final = 0.999

#: Last event with sun-biased sampling. Each biased draw doubles the weight of a point in the
#: shadow, and in thick media twilight is scattered by many of those.
MAX_BIASED_EVENTS: Final = 6

_INVERSE_PI: Final = 1.0 / pi


@inlined
def turned(x, y, z, cosine, azimuth):
    """Rotate the direction (x, y, z) by an angle away from it and by an azimuth around it."""
    sine = sqrt(max((1.0 - cosine) * (1.0 + cosine), 0.0))
    a, b = sine * cos(azimuth), sine * sin(azimuth)
    # An orthonormal frame without a square root: Duff et al. (2017), JCGT 6(1), 1.
    sign = 1.0 if z >= 0.0 else -1.0
    p = -1.0 / (sign + z)
    q = x * y * p
    u = cosine * x + a * (1.0 + sign * x * x * p) + b * q
    v = cosine * y + a * sign * q + b * (sign + y * y * p)
    w = cosine * z - a * sign * x - b * y
    scale = 1.0 / sqrt(u * u + v * v + w * w)
    return u * scale, v * scale, w * scale


class TracedRay(NamedTuple):
    """Ray after ``trace_optical_depth``.

    Attributes
    ----------
    r, mu : float
        Start of the ray. [m], [1]
    panels, depth : int, float
        Result of ``trace_optical_depth``.
    collision_probability : float
        Collision probability on the ray, 1 - exp(-depth). [1]
    """

    r: float
    mu: float
    panels: int
    depth: float
    collision_probability: float


class HistoryStart(NamedTuple):
    """Start of the histories of a line of sight.

    Attributes
    ----------
    r, mu, mu_s, nu : float
        Radius [m], cosines of view zenith, star zenith and the angle between them [1].
    hemisphere : int
        1 or -1 to start in random directions of the upper or lower hemisphere, for horizontal
        irradiance; 0 to start along the view.
    first_order : int
        Lowest order that is counted.
    sun_sampling_fraction : float
        Fraction of sun-biased points; see ``sun_biased_sampling``. [1]
    area : array, shape (2, 3)
        Sides of the area from which histories start, about the start in the frame of
        ``vectors.start_vectors``; used with clouds. [m]
    """

    r: float
    mu: float
    mu_s: float
    nu: float
    hemisphere: int
    first_order: int
    sun_sampling_fraction: float
    area: NDArray[np.float64]


@inlined
def start_in_area(r, area, state):
    """Sampled point of an area around the start of histories, at its radius. [m]"""
    a, b = uniform(state) - 0.5, uniform(state) - 0.5
    x, y = a * area[0, 0] + b * area[1, 0], a * area[0, 1] + b * area[1, 1]
    z = r + a * area[0, 2] + b * area[1, 2]
    scale = r / sqrt(x * x + y * y + z * z)
    return x * scale, y * scale, z * scale


@inlined
def sample_collision(ray, total, sun_sampling_fraction, air, path, sampling, state):
    """Sampled point of a scattering event on a traced ray.

    Parameters
    ----------
    ray : TracedRay
        The ray.
    total, sun_sampling_fraction : float
        Result of ``sun_sampling_integral``, 0 without sun-biased sampling; and fraction of points
        sampled with bias. [1]
    air, path, sampling, state :
        See ``trace_paths``.

    Returns
    -------
    along, strength : float
        Distance along the ray [m] and extinction there [m⁻¹].
    mixture : float
        Sampling density of the mixture over that of exponential attenuation; 0 for an unusable
        point. [1]
    """
    r, mu, panels, depth, collision_probability = ray
    if total > 0.0 and uniform(state) < sun_sampling_fraction:
        at, t, target_depth = sample_sun_biased(
            uniform(state), uniform(state), panels, total, air.extinction, path, sampling
        )
    else:
        target_depth = min(-log1p(-uniform(state) * collision_probability), depth)
        at, t = place_at_depth(target_depth, panels, air.extinction, path)
    along, strength, slope = point_at(path.panels[at], t, r, mu, air.extinction)
    mixture = 1.0
    if total > 0.0:
        by_depth = slope * exp(-target_depth) / collision_probability
        by_light = sun_biased_density(at, t, total, air.extinction, sampling)
        mixture = 0.0
        if by_depth > 0.0:
            mixture = (1.0 - sun_sampling_fraction) + sun_sampling_fraction * by_light / by_depth
    return along, strength, mixture


@inlined
def scattering_fractions(altitude, air, shares):
    """Scattering coefficient at an altitude [m⁻¹]; ``shares`` receives each constituent's."""
    total = 0.0
    for i in range(shares.size):
        amount = 0.0
        if air.lobes.kinds[i] > 0:
            amount = air.scattering[i] * relative_density(
                altitude, air.edges[i], air.coefficients[i]
            )
        shares[i] = amount
        total += amount
    if total > 0.0:
        for i in range(shares.size):
            shares[i] /= total
    return total


@compiled_loop
def trace_to_end(point, direction, to_ground, extinction, clouds, path, state):
    """Trace of a ray through the air up to a collision with a cloud's particle, or to its end.

    Parameters
    ----------
    to_ground, extinction, path :
        Arguments of ``trace_optical_depth``.
    point, direction, clouds, state :
        Arguments of ``cloud_collision``.

    Returns
    -------
    field, distance : int, float
        Result of ``cloud_collision``. [m]
    count, depth : int, float
        Result of ``trace_optical_depth`` for the air up to there. [1]
    """
    x, y, z = point
    u, v, w = direction
    r = sqrt(x * x + y * y + z * z)
    rise = x * u + y * v + z * w
    mu = min(max(rise / r, -1.0), 1.0)
    end = FAR
    if to_ground:
        end = -rise - sqrt(
            max((extinction.bottom - r) * (extinction.bottom + r) + rise * rise, 0.0)
        )
    field, distance = cloud_collision(point, direction, end, clouds, state)
    if field < 0:
        count, depth = trace_optical_depth(r, mu, to_ground, extinction, path)
    else:
        last = sqrt(r * r + distance * (distance + 2.0 * rise))
        last = min(max(last, extinction.bottom), extinction.top)
        rises = mu >= 0.0 or distance > -rise
        count, depth = trace_part(r, mu, rises, last, extinction, path)
    return field, distance, count, depth


@inlined
def scattered_by(cloud, clouds, shares):
    """Set ``shares`` to the particles of a cloud, whose phase functions are the last."""
    for i in range(shares.size):
        shares[i] = 0.0
    if clouds is not None:
        shares[shares.size - clouds.albedo.size + cloud] = 1.0


@inlined
def towards_star(sun_x, sun_z, disc, state):
    """Sampled direction to the star's disc, ``disc`` being 1 - cos of its angular radius. [1]"""
    a, b, c = sun_x, 0.0, sun_z
    if disc > 0.0:
        cosine = 1.0 - disc * uniform(state)
        a, b, c = turned(a, b, c, cosine, 2.0 * pi * uniform(state))
    return a, b, c


@inlined
def scattered_phase(turn, air, shares):
    """Phase function of next-event estimation at a scattering event. [sr⁻¹]"""
    phase = 0.0
    for i in range(shares.size):
        if shares[i] > 0.0:
            phase += shares[i] * lobe_value(air.lobes, i, turn)
    return phase


@inlined
def reflected_brdf(mu_s, mu_r, turn, returned, air):
    """BRDF factor of next-event estimation at a reflection by the ground. [sr⁻¹]"""
    lambertian = max(mu_s, 0.0) * _INVERSE_PI
    reflected = direct_reflectance_at(air.ground, 0, max(mu_s, 0.0), mu_r, turn)
    return lambertian * (reflected / returned)


@inlined
def roulette(weight, reference, event, state):
    """Russian roulette: weight of a surviving history, 0 of a terminated one.

    Below ``KEEP`` of ``reference`` the survival probability is weight/(KEEP reference), and the
    weight is divided by it; from event ``LONG`` on it is at most ``LONG_SURVIVAL``.
    """
    survival = min(weight / (KEEP * reference), 1.0)
    if event >= LONG:
        survival = min(survival, LONG_SURVIVAL)
    if survival < 1.0:
        if uniform(state) >= survival:
            return 0.0
        weight /= survival
    return weight


@inlined
def scattered_direction(u, v, w, air, shares, state):
    """Sampled direction after scattering, by a constituent drawn from ``shares``. [1]"""
    chosen = shares.size - 1
    pick = uniform(state)
    for i in range(shares.size):
        pick -= shares[i]
        if pick < 0.0:
            chosen = i
            break
    while shares[chosen] <= 0.0:  # rounding went past the last scatterer
        chosen -= 1
    cosine = random_cosine(air.lobes, chosen, state)
    return turned(u, v, w, cosine, 2.0 * pi * uniform(state))
