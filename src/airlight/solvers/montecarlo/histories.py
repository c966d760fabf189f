"""Histories of light, followed backwards from the observer to the star.

A history starts at the observer and is forced to end its ray in an event: it scatters before the
ray leaves the air (weight 1 - T), or is reflected by the ground (weight A T, A the part of a beam
from there that is sent back); which of the two is drawn in proportion to these weights. Each event
sends its share of light from a random point of the star's disc (next-event estimation), then a new
direction is drawn from the phase function of a constituent chosen in proportion to what it scatters
there, or from Lambert's law, weighed by the ground's. Absorption lowers the weight.

Histories end by Russian roulette alone: once the weight is below ``KEEP`` of what it was after the
first event, a history goes on with probability weight/KEEP, and with a weight raised accordingly;
from event ``LONG`` on at most with probability 0.95. The expectation is that of the infinite
series; no order is cut off.

Geometry: straight rays between spheres, positions and directions as vectors; the star is at
infinity. Every angle is the local one; nothing is expanded or looked up but the air's extinction
over altitude (see ``rays``).
"""

from __future__ import annotations

from math import cos, exp, expm1, log1p, pi, sin, sqrt
from typing import Final

from airlight.geometry.shell import meets_ground
from airlight.kernel import compiled_loop, inlined
from airlight.optics.density_profile import relative_density
from airlight.optics.reflection import leaving_cosine, sky_factor, star_factor
from airlight.solvers.montecarlo.lit_air import density_in_light, place_in_light, weigh
from airlight.solvers.montecarlo.rays import place_at_depth, point_at, trace
from airlight.solvers.montecarlo.scattering_angles import lobe_value, random_cosine
from airlight.solvers.montecarlo.streams import uniform

#: Fraction of the weight after the first event below which roulette begins. [1]
KEEP: Final = 0.5
#: Event from which a history ends with a probability of at least 1/20.
LONG: Final = 100

_INVERSE_PI: Final = 1.0 / pi


@inlined
def _turned(x, y, z, cosine, azimuth):
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


@compiled_loop
def _from_star(r, mu, air, path):
    """Transmittance from a point to space; 0 if the planet blocks the ray. [1]"""
    if meets_ground(r, mu, air.extinction.bottom):
        return 0.0
    _, depth = trace(r, mu, False, air.extinction, path)
    return exp(-depth)


@compiled_loop
def follow(
    count, start, hemisphere, first_order, lit_share, air, state, paths, workspace, sums
):  # fmt: skip
    """Follow histories and add their contributions, and the squares, to the sums of each order.

    Parameters
    ----------
    count : int
        Number of histories.
    start : tuple of float
        Radius [m], cosines of view zenith, star zenith and the angle between them [1].
    hemisphere : bool
        Whether to start in random directions of the upper hemisphere, for the irradiance of a
        level surface, rather than along the view.
    first_order : int
        Orders below this one are followed but not counted.
    lit_share : float
        Share of the points that is drawn where the star shines; see ``lit_air``. [1]
    air : HistoryOptics
    state : array, shape (1,)
        State of the stream of random numbers.
    paths : tuple
        Workspaces of the rays from the observer, between events and to the star, each a
        ``Trace``, and ``Lit`` for the first and the second.
    workspace : tuple of arrays
        Scattering by each constituent, shape (nc,), and contributions of a history to each order,
        shape (k,).
    sums : array, shape (2, k + 1)
        Sums and sums of squares of each order, the last order gathering all further ones, and
        then of all orders together.
    """
    start_r, start_mu, mu_s, nu = start
    first_path, next_path, star_path, first_lit, next_lit = paths
    scattered, brought = workspace
    bottom = air.extinction.bottom
    constituents = air.scattering.size
    orders = brought.size
    sine = sqrt(max((1.0 - start_mu) * (1.0 + start_mu), 0.0))
    sun_x, sun_z = sqrt(max((1.0 - mu_s) * (1.0 + mu_s), 0.0)), mu_s
    around = 1.0
    if sine * sun_x > 0.0:
        around = min(max((nu - start_mu * mu_s) / (sine * sun_x), -1.0), 1.0)
    view_x, view_y = sine * around, sine * sqrt(max((1.0 - around) * (1.0 + around), 0.0))
    disc = 2.0 * sin(0.5 * air.star_radius) ** 2
    # The disc is uniformly bright and has irradiance 1: its solid angle over its projected one.
    brightness = 2.0 * disc / sin(air.star_radius) ** 2 if disc > 0.0 else 1.0
    grounded = meets_ground(start_r, start_mu, bottom)
    first_count, first_depth = 0, 0.0
    if not hemisphere:
        first_count, first_depth = trace(start_r, start_mu, grounded, air.extinction, first_path)
    first_total = 0.0
    if lit_share > 0.0 and not hemisphere:
        first_total = weigh(
            start_r, start_mu, mu_s, nu, first_count, air.extinction, air.light, first_path,
            first_lit,
        )  # fmt: skip
    for _ in range(count):
        x, y, z = 0.0, 0.0, start_r
        u, v, w = view_x, view_y, start_mu
        r, mu = start_r, start_mu
        weight = 1.0
        if hemisphere:
            mu = sqrt(uniform(state))
            u, v, w = _turned(0.0, 0.0, 1.0, mu, 2.0 * pi * uniform(state))
            weight = pi
        reference = 0.0
        event = 0
        while True:
            if event == 0 and not hemisphere:
                to_ground, panels, depth = grounded, first_count, first_depth
            else:
                to_ground = meets_ground(r, mu, bottom)
                panels, depth = trace(r, mu, to_ground, air.extinction, next_path)
            caught = -expm1(-depth)
            leaving, returned, reflected = 0.0, 0.0, 0.0
            if to_ground:
                leaving = leaving_cosine(r, mu, bottom)
                returned = sky_factor(air.ground, 0, leaving)
                reflected = returned * exp(-depth)
            if not caught + reflected > 0.0:
                break
            weight *= caught + reflected
            event += 1
            on_ground = uniform(state) * (caught + reflected) < reflected
            if on_ground:
                along = -r * mu - sqrt(max((bottom - r) * (bottom + r) + r * r * mu * mu, 0.0))
                strength = 1.0
            else:
                at_start = event == 1 and not hemisphere
                path = first_path if at_start else next_path
                lit = first_lit if at_start else next_lit
                total = 0.0
                if lit_share > 0.0:
                    star_mu, turn = (x * sun_x + z * sun_z) / r, u * sun_x + w * sun_z
                    if at_start:
                        total = first_total
                    else:
                        total = weigh(
                            r, mu, star_mu, turn, panels, air.extinction, air.light, path, lit
                        )
                if total > 0.0 and uniform(state) < lit_share:
                    at, t, wanted = place_in_light(
                        uniform(state), uniform(state), panels, total, air.extinction, path, lit
                    )
                else:
                    wanted = min(-log1p(-uniform(state) * caught), depth)
                    at, t = place_at_depth(wanted, panels, air.extinction, path)
                along, strength, slope = point_at(path.panels[at], t, r, mu, air.extinction)
                if total > 0.0:
                    by_depth = slope * exp(-wanted) / caught
                    by_light = density_in_light(at, t, total, air.extinction, lit)
                    if not by_depth > 0.0:
                        break
                    weight /= (1.0 - lit_share) + lit_share * by_light / by_depth
            x, y, z = x + along * u, y + along * v, z + along * w
            r = sqrt(x * x + y * y + z * z)
            if on_ground:
                scale = bottom / r
                x, y, z, r = x * scale, y * scale, z * scale, bottom
            else:
                total = 0.0
                for i in range(constituents):
                    amount = 0.0
                    if air.lobes.kinds[i] > 0:
                        amount = air.scattering[i] * relative_density(
                            r - bottom, air.edges[i], air.coefficients[i]
                        )
                    scattered[i] = amount
                    total += amount
                if not (strength > 0.0 and total > 0.0):
                    break
                weight *= total / strength
                for i in range(constituents):
                    scattered[i] /= total
            if event >= first_order:
                a, b, c = sun_x, 0.0, sun_z
                if disc > 0.0:
                    cosine = 1.0 - disc * uniform(state)
                    a, b, c = _turned(a, b, c, cosine, 2.0 * pi * uniform(state))
                sun_mu = (x * a + y * b + z * c) / r
                share = 0.0
                if on_ground:
                    turn = min(max(u * a + v * b + w * c, -1.0), 1.0)
                    share = max(sun_mu, 0.0) * _INVERSE_PI
                    share *= star_factor(air.ground, 0, max(sun_mu, 0.0), leaving, turn) / returned
                else:
                    turn = min(max(u * a + v * b + w * c, -1.0), 1.0)
                    for i in range(constituents):
                        if scattered[i] > 0.0:
                            share += scattered[i] * lobe_value(air.lobes, i, turn)
                if share > 0.0:
                    light = _from_star(r, sun_mu, air, star_path)
                    brought[min(event, orders) - 1] += weight * share * brightness * light
            if event == 1:
                reference = weight
            survival = min(weight / (KEEP * reference), 1.0)
            if event >= LONG:
                survival = min(survival, 0.95)
            if survival < 1.0:
                if uniform(state) >= survival:
                    break
                weight /= survival
            if on_ground:
                cosine = sqrt(uniform(state))
                a, b, c = _turned(x / r, y / r, z / r, cosine, 2.0 * pi * uniform(state))
                turn = min(max(u * a + v * b + w * c, -1.0), 1.0)
                # Drawn by Lambert's law; any other reflection weights the direction.
                weight *= star_factor(air.ground, 0, cosine, leaving, turn) / returned
                u, v, w = a, b, c
            else:
                chosen = constituents - 1
                pick = uniform(state)
                for i in range(constituents):
                    pick -= scattered[i]
                    if pick < 0.0:
                        chosen = i
                        break
                while scattered[chosen] <= 0.0:  # rounding went past the last scatterer
                    chosen -= 1
                cosine = random_cosine(air.lobes, chosen, state)
                u, v, w = _turned(u, v, w, cosine, 2.0 * pi * uniform(state))
            mu = min(max((x * u + y * v + z * w) / r, -1.0), 1.0)
        whole = 0.0
        for k in range(min(event, orders)):
            value = brought[k]
            whole += value
            sums[0, k] += value
            sums[1, k] += value * value
            brought[k] = 0.0
        sums[0, orders] += whole
        sums[1, orders] += whole * whole
