"""Backward Monte Carlo histories, from the observer to the star.

Collisions are forced: each ray ends in a scattering event before it leaves the atmosphere (weight
1 - T) or in a reflection by the ground (weight A T, with the directional albedo A), drawn in
proportion to these weights. Each event contributes direct light from a random point of the star's
disc (next-event estimation); the new direction is drawn from the phase function of a constituent,
chosen in proportion to its scattering coefficient, or from Lambert's law, weighted by the actual
reflection law. Absorption lowers the weight.

Histories end only by Russian roulette (``events.roulette``), so that the expectation is that of the
infinite series of orders.

Polarised histories carry the product of phase matrices over phase functions (see ``stokes``);
events and directions are sampled as for scalar transfer.

A moon or rings in front of the star dim each contribution by what they hide from the event.

Clouds (``CloudCells``) end rays as the ground does: a collision with their particles is drawn
first, independently of the air's (of two exponential processes the nearer event is the first of
both), and the ray up to it either ends in a scattering event in the air (weight 1 - T) or at the
particle (weight T times single-scattering albedo). Without clouds none of this is compiled.

Geometry: straight rays between spheres, positions and directions as vectors; the star is at
infinity. Only extinction is tabulated, over altitude (see ``rays``). With refraction, radii are
optical ones, and point and direction are rotated at each event (see ``refracted_paths``).
"""

from __future__ import annotations

from math import exp, expm1, pi, sin, sqrt

from airlight.geometry.occulted_star import star_visible_fraction
from airlight.geometry.shell import meets_ground
from airlight.geometry.vectors import Vec3, dot, start_vectors
from airlight.kernel import compiled_loop, inlined
from airlight.physics.optics.reflection import (
    cos_reflected,
    diffuse_reflectance_at,
    direct_reflectance_at,
)
from airlight.solver.montecarlo.cloud_rays import FAR, cloud_depth
from airlight.solver.montecarlo.events import (
    MAX_BIASED_EVENTS,
    TracedRay,
    reflected_brdf,
    roulette,
    sample_collision,
    scattered_by,
    scattered_direction,
    scattered_phase,
    scattering_fractions,
    start_in_area,
    towards_star,
    trace_to_end,
    turned,
)
from airlight.solver.montecarlo.rays import trace_optical_depth
from airlight.solver.montecarlo.refracted_paths import (
    apparent_direction,
    refraction_on_path,
    rotated_with_ray,
)
from airlight.solver.montecarlo.stokes import (
    arriving,
    begin,
    carried_axis,
    crossed,
    depolarise,
    mixed_matrix,
    plane_turn,
    scatter,
    start_axis,
)
from airlight.solver.montecarlo.streams import uniform
from airlight.solver.montecarlo.sun_biased_sampling import sun_sampling_integral
from airlight.solver.tables.ring_shadow import ring_shade


@compiled_loop
def _transmittance_to_star(r, mu, air, path):
    """Transmittance from a point to space; 0 if the planet blocks the ray. [1]"""
    if meets_ground(r, mu, air.extinction.bottom):
        return 0.0
    _, depth = trace_optical_depth(r, mu, False, air.extinction, path)
    return exp(-depth)


@inlined
def _add_history(contribution, polarised, reached, sums):
    """Add a history's contributions by order, and their squares, to the sums; reset them."""
    whole = 0.0
    for k in range(2):
        value = polarised[k]
        sums[0, contribution.size + 1 + k] += value
        sums[1, contribution.size + 1 + k] += value * value
        polarised[k] = 0.0
    for k in range(reached):
        value = contribution[k]
        whole += value
        sums[0, k] += value
        sums[1, k] += value * value
        contribution[k] = 0.0
    sums[0, contribution.size] += whole
    sums[1, contribution.size] += whole * whole


@compiled_loop
def trace_paths(count, start, air, clouds, occulted, rings, state, paths, workspace, sums):
    """Trace histories; add their contributions by order, and the squares, to the sums.

    Parameters
    ----------
    start : HistoryStart
        Start of the histories.
    clouds : CloudCells or None
        Clouds, in the frame of ``start_vectors``; their phase functions are the last of ``air``.
    occulted : OccultedStar
        Moon in front of the star, in the frame of ``start_vectors``; without lanes for none.
    rings : RingShadow or None
        Rings in front of the star, in that frame.
    state : array, shape (1,)
        State of the stream of random numbers.
    paths : tuple
        Workspaces of the rays from the observer, between events and to the star, each a
        ``Trace``, and ``SamplingDensity`` for the first and the second.
    workspace : tuple of arrays
        Scattering by each constituent, shape (nc,); contributions of a history to each order,
        shape (k,), and to Q and U of all, shape (2,); the product of ``stokes``, shape (3, 4).
    sums : array, shape (2, k + 3)
        Sums and sums of squares of each order, the last including all further ones; then of all
        orders together, and of their Q and U.
    """
    start_r, start_mu, mu_s, nu, hemisphere, first_order, sun_sampling_fraction, area = start
    first_path, next_path, star_path, first_sampling, next_sampling = paths
    shares, contribution, polarised, importance = workspace
    bottom, top = air.extinction.bottom, air.extinction.top
    refraction = air.refraction
    orders = contribution.size
    view_x, view_y, sun_x = start_vectors(start_mu, mu_s, nu)
    disc = 2.0 * sin(0.5 * air.star_radius) ** 2
    # The disc is uniformly bright and has irradiance 1: its solid angle over its projected one.
    brightness = 2.0 * disc / sin(air.star_radius) ** 2 if disc > 0.0 else 1.0
    grounded = meets_ground(start_r, start_mu, bottom)
    first_count, first_depth, first_total = 0, 0.0, 0.0
    if not hemisphere:
        first_count, first_depth = trace_optical_depth(
            start_r, start_mu, grounded, air.extinction, first_path
        )
        if sun_sampling_fraction > 0.0:
            first_total = sun_sampling_integral(
                start_r, start_mu, mu_s, nu, first_count, air.extinction, air.star_transmittance,
                first_path, first_sampling,
            )  # fmt: skip
    for _ in range(count):
        x, y, z = 0.0, 0.0, start_r
        u, v, w = view_x, view_y, start_mu
        r, mu = start_r, start_mu
        weight = 1.0
        if hemisphere:
            mu = sqrt(uniform(state))
            u, v, w = turned(0.0, 0.0, 1.0, mu, 2.0 * pi * uniform(state))
            mu, w = hemisphere * mu, hemisphere * w
            weight = pi
        if clouds is not None:
            x, y, z = start_in_area(start_r, area, state)
            mu = min(max((x * u + y * v + z * w) / r, -1.0), 1.0)
        a1, a2, a3 = 0.0, 0.0, 0.0
        if air.polarised:
            begin(importance, hemisphere)
            a1, a2, a3 = start_axis(u, v, w)
        reference = 0.0
        event = 0
        while True:
            at_start = event == 0 and not hemisphere
            cloud, cloud_distance = -1, 0.0
            if clouds is not None:
                at_start = False
            if at_start:
                to_ground, panels, depth = grounded, first_count, first_depth
            else:
                to_ground = meets_ground(r, mu, bottom)
                if clouds is None:
                    panels, depth = trace_optical_depth(r, mu, to_ground, air.extinction, next_path)
                else:
                    cloud, cloud_distance, panels, depth = trace_to_end(
                        Vec3(x, y, z), Vec3(u, v, w), to_ground, air.extinction, clouds,
                        next_path, state,
                    )  # fmt: skip
            collision_probability = -expm1(-depth)
            mu_r, returned, reflected = 0.0, 0.0, 0.0
            if cloud >= 0:
                if clouds is not None:
                    reflected = clouds.albedo[cloud] * exp(-depth)
            elif to_ground:
                mu_r = cos_reflected(r, mu, bottom)
                returned = diffuse_reflectance_at(air.ground, 0, mu_r)
                reflected = returned * exp(-depth)
            if not collision_probability + reflected > 0.0:
                break
            weight *= collision_probability + reflected
            event += 1
            at_end = uniform(state) * (collision_probability + reflected) < reflected
            on_ground = at_end and cloud < 0
            from_r, from_mu = r, mu
            if on_ground:
                along = -r * mu - sqrt(max((bottom - r) * (bottom + r) + r * r * mu * mu, 0.0))
                x, y, z = x + along * u, y + along * v, z + along * w
                scale = bottom / sqrt(x * x + y * y + z * z)
                x, y, z, r = x * scale, y * scale, z * scale, bottom
            elif at_end:
                along = cloud_distance
                x, y, z = x + along * u, y + along * v, z + along * w
                r = sqrt(x * x + y * y + z * z)
                scattered_by(cloud, clouds, shares)
            else:
                path = first_path if at_start else next_path
                sampling = first_sampling if at_start else next_sampling
                total = first_total if at_start else 0.0
                if sun_sampling_fraction > 0.0 and event <= MAX_BIASED_EVENTS and not at_start:
                    star_mu, turn = (x * sun_x + z * mu_s) / r, u * sun_x + w * mu_s
                    total = sun_sampling_integral(
                        r,
                        mu,
                        star_mu,
                        turn,
                        panels,
                        air.extinction,
                        air.star_transmittance,
                        path,
                        sampling,
                    )
                ray = TracedRay(r, mu, panels, depth, collision_probability)
                along, strength, mixture = sample_collision(
                    ray, total, sun_sampling_fraction, air, path, sampling, state
                )
                if not mixture > 0.0:
                    break
                weight /= mixture
                x, y, z = x + along * u, y + along * v, z + along * w
                r = sqrt(x * x + y * y + z * z)
                scattering = scattering_fractions(r - bottom, air, shares)
                if not (strength > 0.0 and scattering > 0.0):
                    break
                weight *= scattering / strength
            if refraction.strength > 0.0:
                angle = refraction_on_path(from_r, from_mu, along, bottom, top - bottom, refraction)
                p, q, s = u, v, w
                x, y, z, u, v, w = rotated_with_ray(x, y, z, u, v, w, angle)
                a1, a2, a3 = carried_axis(a1, a2, a3, p, q, s, u, v, w)
            if on_ground and air.polarised:
                depolarise(importance)
            if event >= first_order:
                a, b, c = towards_star(sun_x, mu_s, disc, state)
                a, b, c, sun_mu, refraction_jacobian = apparent_direction(
                    Vec3(x, y, z), r, Vec3(a, b, c), bottom, top, refraction
                )
                turn = min(max(u * a + v * b + w * c, -1.0), 1.0)
                first, second, third = 1.0, 0.0, 0.0
                if on_ground:
                    angular_pdf = reflected_brdf(sun_mu, mu_r, turn, returned, air)
                elif not air.polarised:
                    angular_pdf = scattered_phase(turn, air, shares)
                else:
                    angular_pdf, f12, _, _, _, _ = mixed_matrix(turn, air, shares)
                    cosine, sine, _, _, _ = plane_turn(u, v, w, a, b, c, a1, a2, a3)
                    first = arriving(importance, 0, cosine, sine, f12)
                    second = arriving(importance, 1, cosine, sine, f12)
                    third = arriving(importance, 2, cosine, sine, f12)
                if on_ground and air.polarised:
                    first, second, third = importance[0, 0], importance[1, 0], importance[2, 0]
                if occulted.lanes > 0:
                    angular_pdf *= star_visible_fraction(x, y, z, occulted)
                if rings is not None:
                    height = dot(Vec3(x, y, z), rings.pole)
                    sun_height = dot(Vec3(a, b, c), rings.pole)
                    sunward = r * sun_mu
                    angular_pdf *= ring_shade(
                        r * r, sunward, height, sun_height, 0.0, 0.0, rings.rings
                    )
                if angular_pdf > 0.0:
                    light = _transmittance_to_star(r, sun_mu, air, star_path)
                    if clouds is not None and light > 0.0:
                        point, direction = Vec3(x, y, z), Vec3(a, b, c)
                        light *= exp(-cloud_depth(point, direction, FAR, clouds))
                    value = weight * angular_pdf * brightness * refraction_jacobian * light
                    contribution[min(event, orders) - 1] += value * first
                    polarised[0] += value * second
                    polarised[1] += value * third
            if event == 1:
                reference = weight
            weight = roulette(weight, reference, event, state)
            if not weight > 0.0:
                break
            if on_ground:
                cosine = sqrt(uniform(state))
                a, b, c = turned(x / r, y / r, z / r, cosine, 2.0 * pi * uniform(state))
                turn = min(max(u * a + v * b + w * c, -1.0), 1.0)
                # Drawn by Lambert's law; any other reflection weights the direction.
                weight *= direct_reflectance_at(air.ground, 0, cosine, mu_r, turn) / returned
                u, v, w = a, b, c
                a1, a2, a3 = start_axis(u, v, w)
            else:
                a, b, c = scattered_direction(u, v, w, air, shares, state)
                if air.polarised:
                    turn = min(max(u * a + v * b + w * c, -1.0), 1.0)
                    _, f12, f22, f33, f34, f44 = mixed_matrix(turn, air, shares)
                    cosine, sine, p, q, s = plane_turn(u, v, w, a, b, c, a1, a2, a3)
                    scatter(importance, cosine, sine, f12, f22, f33, f34, f44)
                    a1, a2, a3 = crossed(p, q, s, a, b, c)
                u, v, w = a, b, c
            mu = min(max((x * u + y * v + z * w) / r, -1.0), 1.0)
        _add_history(contribution, polarised, min(event, orders), sums)
